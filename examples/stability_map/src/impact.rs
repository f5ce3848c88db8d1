//! One impact: two equal dry spheres head on.

use pendular::contact::Linear;
use pendular::dem::DVec3;

use crate::case::Outcome;
use crate::edge::{self, Edge};
use crate::rig::{Fault, Matter, Start, mass};

/// Radius of both spheres, m.
pub(crate) const RADIUS: f64 = 1e-3;
/// Speed at which they meet, m/s.
pub(crate) const SPEED: f64 = 0.2;
/// Where within a step the contact begins: so many runs, evenly spread.
pub(crate) const OFFSETS: u32 = 16;
/// Overlap of the pressed pair whose disturbance is watched, m, and the disturbance over it.
pub(crate) const PRESSED: f64 = 1e-6;
pub(crate) const NOISE: f64 = 1e-4;
/// Steps over which a disturbance may grow.
pub(crate) const WATCH: u64 = 1500;

/// The edge: the pair pressed together, one sphere pushed a little in all directions and turned.
pub(crate) fn edge(matter: &Matter) -> Result<Edge, Fault> {
    let pressed = |h: f64, noise: f64| {
        let speed = noise * PRESSED * (matter.stiffness / mass(RADIUS)).sqrt();
        let push = speed * DVec3::new(0.6, 0.64, -0.48);
        let turn = speed / RADIUS * DVec3::new(-0.3, 0.8, 0.5);
        let centre = DVec3::X * (2.0 * RADIUS - PRESSED);
        let still = (0, DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
        let start = Start {
            radii: vec![RADIUS],
            spheres: vec![still, (0, centre, push, turn)],
            press: Some(matter.stiffness * PRESSED),
            ..Start::default()
        };
        start.scene(matter, h)
    };
    edge::find(|h| pressed(h, 0.0), |h| pressed(h, NOISE), WATCH)
}

/// Error: the largest deviation of the energy after the impact from e² times that before, over that
/// before, of sixteen offsets. State: the mean restitution.
pub(crate) fn run(matter: &Matter, h: f64) -> Result<Outcome, Fault> {
    let reduced = 0.5 * mass(RADIUS);
    let law = Linear::from_restitution(matter.stiffness, matter.restitution, reduced)?;
    let time = law.contact_time(reduced)?;
    over_offsets(matter, |offset| {
        let gap = (f64::from(offset) + 0.5) / f64::from(OFFSETS) * SPEED * h;
        let half = DVec3::X * 0.5 * SPEED;
        let start = Start {
            radii: vec![RADIUS],
            spheres: vec![
                (0, DVec3::ZERO, half, DVec3::ZERO),
                (0, DVec3::X * (2.0 * RADIUS + gap), -half, DVec3::ZERO),
            ],
            ..Start::default()
        };
        let mut scene = start.scene(matter, h)?;
        scene.advance((4.0 * time / h).ceil() as u64 + 4)?;
        let speed = |id| scene.particles().get(id).map_or(f64::NAN, |p| p.velocity.x);
        Ok((speed(1) - speed(0)) / SPEED)
    })
}

/// Collects restitutions over the offsets.
pub(crate) fn over_offsets(
    matter: &Matter,
    restitution: impl Fn(u32) -> Result<f64, Fault>,
) -> Result<Outcome, Fault> {
    let all: Vec<f64> = (0..OFFSETS).map(restitution).collect::<Result<_, _>>()?;
    let off = |e: &f64| (e * e - matter.restitution.powi(2)).abs();
    let error = all.iter().map(off).fold(0.0, f64::max);
    Ok(Outcome { error, state: all.iter().sum::<f64>() / f64::from(OFFSETS) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rig::Drag;

    #[test]
    fn the_edge_of_one_contact_is_the_formula_of_a_lagged_dashpot() {
        for restitution in [0.98, 0.5, 0.1] {
            let matter = Matter { stiffness: 1e4, restitution, liquid: None, drag: Drag::Explicit };
            let reduced = 0.5 * mass(RADIUS);
            let omega = (matter.stiffness / reduced).sqrt();
            let damping = crate::rig::dashpot(&matter, reduced).unwrap();
            let zeta = damping / (2.0 * (matter.stiffness * reduced).sqrt());
            // h ω = 2 (√(1 + ζ²) − ζ) along the normal; across it 3.5 k_t/m* = ω², undamped.
            let expected = 2.0 * ((1.0 + zeta * zeta).sqrt() - zeta) / omega;
            let found = edge(&matter).unwrap();
            assert!((found.edge / expected - 1.0).abs() < 0.01, "{restitution}: {found:?}");
            assert!((found.limit / expected - 0.9).abs() < 1e-9, "{restitution}: {found:?}");
            assert!(found.holds());
        }
    }

    #[test]
    fn a_fine_step_gives_the_restitution_and_a_coarse_one_an_error() {
        let matter =
            Matter { stiffness: 1e4, restitution: 0.5, liquid: None, drag: Drag::Explicit };
        let limit = edge(&matter).unwrap().limit;
        let fine = run(&matter, 0.02 * limit).unwrap();
        assert!((fine.state - 0.5).abs() < 0.01 && fine.error < 0.02, "{fine:?}");
        let coarse = run(&matter, limit).unwrap();
        assert!(coarse.error > 10.0 * fine.error, "{coarse:?}");
    }
}
