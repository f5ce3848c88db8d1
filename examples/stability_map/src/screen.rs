//! A small wet screening: 155 spheres of two sizes over a shaken screen of crossed wires.

use std::f64::consts::FRAC_PI_2;

use cpu_time::ThreadTime;
use pendular::capillary::AnyCapillary;
use pendular::dem::DVec3;
use pendular::walls::build::{Fit, Prism};
use pendular::walls::{Harmonic, Motion, Part, Plane, Shape, Wire};

use crate::rig::{Drag, Fault, Film, Matter, Scene, Start};

const RADII: [f64; 2] = [1.5e-3, 3.5e-3];
const APERTURE: f64 = 5e-3;
const WIRE: f64 = 1.5e-3;
/// Apertures each way.
const APERTURES: u32 = 4;
const VISCOSITY: f64 = 0.01;
/// Looks at the screening, evenly spread over its time.
const LOOKS: u32 = 40;
/// Sub-step offsets of the lone impact.
const OFFSETS: u32 = 8;
const SPEED: f64 = 0.5;

/// One way to run it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Way {
    /// Time step over the limit before the run.
    pub(crate) share: f64,
    /// Capillary law.
    pub(crate) law: AnyCapillary,
    /// Faces of a wire's prism; `None` for an exact cylinder.
    pub(crate) sides: Option<u32>,
    /// How drag is integrated.
    pub(crate) drag: Drag,
}

/// What a run came to, and what it cost.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Screened {
    /// Undersize still on the screen, mean over the run.
    pub(crate) retained: f64,
    /// Share of the liquid on walls, mean over the run.
    pub(crate) on_walls: f64,
    /// Restitution of a lone wet sphere on a wire, mean over offsets.
    pub(crate) restitution: f64,
    /// Processor time of the screening, s.
    pub(crate) cost: f64,
}

fn matter(way: &Way) -> Matter {
    let liquid = Some(Film { viscosity: VISCOSITY, law: way.law, share: 0.02 });
    Matter { stiffness: 1e4, restitution: 0.7, liquid, drag: way.drag }
}

fn pitch() -> f64 {
    APERTURE + WIRE
}

fn shape(ends: [DVec3; 2], sides: Option<u32>) -> Result<Shape, Fault> {
    let radius = 0.5 * WIRE;
    Ok(match sides {
        None => Shape::Wire(Wire::new(ends[0], ends[1], radius, 2 * APERTURES)?),
        Some(sides) => {
            let (up, fit, segments) = (DVec3::Z, Fit::Inscribed, 2);
            let prism = Prism { ends, up, radius, sides, fit, segments, closed: false };
            Shape::Mesh(prism.mesh()?)
        }
    })
}

/// The box, its walls at rest, and the shaken wires.
fn walls(sides: Option<u32>) -> Result<Vec<Part>, Fault> {
    let half = 0.5 * f64::from(APERTURES) * pitch();
    let amplitude = 1e-3 * DVec3::Z;
    // From rest at the lowest point.
    let shake = Motion::harmonic(Harmonic { amplitude, frequency: 50.0, phase: -FRAC_PI_2 });
    let mut parts = Vec::new();
    for (name, normal) in
        [("west", DVec3::X), ("east", -DVec3::X), ("south", DVec3::Y), ("north", -DVec3::Y)]
    {
        let plane = Plane::new(-half * normal, normal, 1e-3)?;
        parts.push(Part::new(name, Shape::Plane(plane)));
    }
    for (along, across) in [(DVec3::X, DVec3::Y), (DVec3::Y, DVec3::X)] {
        for k in 0..=APERTURES {
            let middle = across * (f64::from(k) * pitch() - half);
            let ends = [middle - along * (half + WIRE), middle + along * (half + WIRE)];
            let part = Part::new(format!("wire-{}", parts.len()), shape(ends, sides)?);
            parts.push(part.with_half_side(0.5 * WIRE).with_motion(shake.clone()));
        }
    }
    Ok(parts)
}

fn start(way: &Way) -> Result<Start, Fault> {
    let mut spheres = Vec::new();
    let mut lattice = |class: u16, side: u32, layers: u32, pitch: f64, bottom: f64| {
        for k in 0..side * side * layers {
            let cell = DVec3::new(f64::from(k % side), f64::from(k / side % side), 0.0);
            let middle = 0.5 * f64::from(side - 1) * DVec3::new(1.0, 1.0, 0.0);
            let height = bottom + f64::from(k / side / side) * pitch;
            // Layers are shifted a little against each other.
            let shift = 0.03 * pitch * f64::from(k / side / side % 3) * DVec3::new(1.0, 0.6, 0.0);
            let x = (cell - middle) * pitch + shift + height * DVec3::Z;
            spheres.push((class, x, DVec3::ZERO, DVec3::ZERO));
        }
    };
    lattice(1, 3, 3, 7.3e-3, 5e-3);
    lattice(0, 8, 2, 3.15e-3, 26e-3);
    let walls = walls(way.sides)?;
    let bottom = Some(-0.02);
    Ok(Start { radii: RADII.to_vec(), spheres, walls, gravity: 9.81, press: None, bottom })
}

/// Runs the screening for `time` s, and the lone impact.
pub(crate) fn run(way: &Way, time: f64) -> Result<Screened, Fault> {
    let (start, matter) = (start(way)?, matter(way));
    let small = start.spheres.iter().filter(|sphere| sphere.0 == 0).count() as f64;
    let h = way.share * start.scene(&matter, 1e-9)?.limit().time_step;
    let mut scene = start.scene(&matter, h)?;
    let stride = (time / h / f64::from(LOOKS)).ceil() as u64;
    let clock = ThreadTime::now();
    let mut found = Screened::default();
    for look in 1..=LOOKS {
        // Looks are at the same times whatever the step.
        let to = (f64::from(look) * time / f64::from(LOOKS) / h).round() as u64;
        scene.advance(to.saturating_sub(scene.step()).min(2 * stride))?;
        let left = scene.particles().iter().filter(|p| p.class == 0).count() as f64;
        found.retained += left / small / f64::from(LOOKS);
        found.on_walls += on_walls(&scene) / f64::from(LOOKS);
    }
    found.cost = clock.elapsed().as_secs_f64();
    found.restitution = impact(way, &matter, h)?;
    Ok(found)
}

/// Share of the liquid in films of walls.
fn on_walls(scene: &Scene) -> f64 {
    scene.water().map_or(0.0, |water| {
        let ledger = water.ledger();
        ledger.walls().iter().sum::<f64>() / ledger.total()
    })
}

/// A small wet sphere falls on the middle of a wire at rest: speed after over speed before.
fn impact(way: &Way, matter: &Matter, h: f64) -> Result<f64, Fault> {
    let ends = [-0.02 * DVec3::X, 0.02 * DVec3::X];
    let mut sum = 0.0;
    for offset in 0..OFFSETS {
        // Film first: it is 0.02 r/3 thick.
        let gap = 0.02 * RADII[0] + (f64::from(offset) + 0.5) / f64::from(OFFSETS) * SPEED * h;
        let at = DVec3::Z * (RADII[0] + 0.5 * WIRE + gap);
        let part = Part::new("wire", shape(ends, way.sides)?).with_half_side(0.5 * WIRE);
        let start = Start {
            radii: vec![RADII[0]],
            spheres: vec![(0, at, -SPEED * DVec3::Z, DVec3::ZERO)],
            walls: vec![part],
            ..Start::default()
        };
        let mut scene = start.scene(matter, h)?;
        scene.advance((6e-3 / h) as u64)?;
        sum += scene.particles().get(0).map_or(f64::NAN, |p| p.velocity.z) / SPEED;
    }
    Ok(sum / f64::from(OFFSETS))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn undersize_falls_through_and_liquid_goes_to_the_wires() {
        let way = Way { share: 1.0, law: AnyCapillary::Lambert, sides: None, drag: Drag::Explicit };
        let found = run(&way, 0.3).unwrap();
        assert!(found.retained < 1.0 && found.retained > 0.3, "{found:?}");
        assert!(found.on_walls > 1e-4 && found.on_walls < 0.5, "{found:?}");
        assert!(found.restitution > 0.2 && found.restitution < 0.7, "{found:?}");
        assert!(found.cost > 0.0);
    }
}
