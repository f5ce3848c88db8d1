//! How high spheres rest over an aperture of a shaken sieve, and how much prisms change that.
//!
//! `cargo run -p pendular-walls --example resting_height`

use pendular_walls::build::Fit;
use pendular_walls::glam::DVec3;
use pendular_walls::{FrameKind, Harmonic, Motion, Sieve, WallError, Walls, Wires};

fn sieve(wires: Wires) -> Result<Walls, WallError> {
    let sieve = Sieve {
        aperture: 8e-3,
        wire_diameter: 2e-3,
        frame_radius: 0.1,
        frame_bottom: -0.01,
        frame_top: 0.05,
        wires,
        frame: FrameKind::Cylinder { patches: [12, 4] },
        element_length: 10e-3,
    };
    let amplitude = DVec3::new(1e-4, 0.0, 9e-4);
    let shake = Motion::harmonic(Harmonic { amplitude, frequency: 50.6, phase: 0.0 });
    let parts = sieve.parts()?.into_iter().map(|part| part.with_motion(shake.clone()));
    Walls::new(parts.collect())
}

/// Smallest gap between a sphere and all walls near it, m.
fn gap(walls: &Walls, centre: DVec3, radius: f64) -> f64 {
    let (mut near, mut candidates, mut touches) = (Vec::new(), Vec::new(), Vec::new());
    let reach = 1e-3;
    walls.near(centre, radius + reach, &mut near);
    let mut least = f64::INFINITY;
    for part in near {
        walls.candidates(part, centre, radius + reach, &mut candidates);
        walls.touches(part, &candidates, centre, radius, reach, &mut touches);
        least = least.min(touches.first().map_or(f64::INFINITY, |touch| touch.gap));
    }
    least
}

/// Height over the wire axes at which a sphere rests over the middle aperture, m.
fn resting_height(walls: &Walls, radius: f64) -> f64 {
    let middle = walls.displacement(0);
    let (mut low, mut high) = (0.0, 3.0 * radius);
    for _ in 0..60 {
        let height = 0.5 * (low + high);
        let free = gap(walls, middle + DVec3::Z * height, radius) > 0.0;
        if free { high = height } else { low = height }
    }
    high
}

fn main() -> Result<(), WallError> {
    let mut wires = vec![("cylinders".to_string(), Wires::Cylinders)];
    for sides in [8, 16, 32] {
        let prisms = Wires::Prisms { sides, fit: Fit::Circumscribed };
        wires.push((format!("{sides}-sided prisms"), prisms));
    }
    println!("{:18} {:>8} {:>8} {:>8}  height over the axes, mm", "d, mm:", 9, 10, 12);
    for (name, wires) in wires {
        let mut walls = sieve(wires)?;
        // Any moment will do: the sphere is placed over the moving aperture.
        walls.move_to(1.234, 1.234);
        let height = |d: f64| 1e3 * resting_height(&walls, 0.5e-3 * d);
        println!("{name:18} {:8.4} {:8.4} {:8.4}", height(9.0), height(10.0), height(12.0));
    }
    Ok(())
}
