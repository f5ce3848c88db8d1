//! Wet spheres in a row: what the pair and the chain share.

use pendular::dem::DVec3;

use crate::edge::{self, Edge};
use crate::impact::{NOISE, RADIUS, WATCH};
use crate::rig::{Fault, Matter, Rest, Scene, Sphere, Start, mass, stored};

/// Gap at which films touch from the start, m.
pub(crate) const NEAR: f64 = 1e-6;

/// Equal spheres along x with the same gap between neighbours, at rest.
pub(crate) fn row(count: u32, gap: f64) -> Vec<Sphere> {
    let place = |k| DVec3::X * f64::from(k) * (2.0 * RADIUS + gap);
    (0..count).map(|k| (0, place(k), DVec3::ZERO, DVec3::ZERO)).collect()
}

pub(crate) fn scene(spheres: Vec<Sphere>, matter: &Matter, h: f64) -> Result<Scene, Fault> {
    Start { radii: vec![RADIUS], spheres, ..Start::default() }.scene(matter, h)
}

/// Capillary force of touching spheres, N.
pub(crate) fn pull(matter: &Matter) -> Result<f64, Fault> {
    let mut scene = scene(row(2, NEAR), matter, 1e-12)?;
    scene.advance(1)?;
    let water = scene.water().ok_or("no liquid")?;
    let bridge = water.bridges().next().ok_or("no bridge")?;
    Ok(water.tension(&bridge, 0.0)?)
}

/// The edge of a row that its bridges hold together, the last sphere pushed and turned a little.
pub(crate) fn edge(count: u32, matter: &Matter) -> Result<Edge, Fault> {
    let overlap = pull(matter)? / matter.stiffness;
    let speed = NOISE * overlap * (matter.stiffness / mass(RADIUS)).sqrt();
    let start = Start { radii: vec![RADIUS], spheres: row(count, -overlap), ..Start::default() };
    // In so short a step bridges form and nothing moves.
    let rest = Rest::after(&start, matter, 1e-15, 1)?;
    let held = |h: f64, noise: f64| {
        rest.scene(matter, h, |particle| {
            if particle.id == count - 1 {
                particle.velocity = noise * DVec3::new(0.6, 0.64, -0.48);
                particle.spin = noise / RADIUS * DVec3::new(-0.3, 0.8, 0.5);
            }
        })
    };
    edge::find(|h| held(h, 0.0), |h| held(h, speed), WATCH)
}

/// Runs for `steps` and finds the largest rise of the total energy over its lowest so far, J.
pub(crate) fn rise(scene: &mut Scene, steps: u64) -> Result<f64, Fault> {
    let speeds = |scene: &Scene| {
        let mut all: Vec<_> =
            scene.particles().iter().map(|p| (p.id, p.velocity, p.spin)).collect();
        all.sort_by_key(|p| p.0);
        all
    };
    let (mut lowest, mut most) = (f64::INFINITY, 0.0_f64);
    for _ in 0..steps {
        let potential = stored(scene);
        let before = speeds(scene);
        scene.advance(1)?;
        // Velocities at the time of the positions are the mean of two half steps.
        let pairs = before.iter().zip(speeds(scene));
        let kinetic: f64 = pairs
            .map(|(a, b)| {
                let (v, w) = (0.5 * (a.1 + b.1), 0.5 * (a.2 + b.2));
                let turn = 0.4 * RADIUS * RADIUS * w.length_squared();
                0.5 * mass(RADIUS) * (v.length_squared() + turn)
            })
            .sum();
        let energy = potential + kinetic;
        lowest = lowest.min(energy);
        most = most.max(energy - lowest);
    }
    Ok(most)
}
