//! One contact along a line, integrated here: what other readings of the dashpot do to the limit.
//!
//! With S the gap, u = dS/dt of half a step before and m the reduced mass:
//!
//! ```text
//! lagged         F = k δ − γ u(n−½)                       as the core, and common velocity Verlet
//! extrapolated   F = k δ − γ (3 u(n−½) − u(n−3/2))/2      second order, half the damping limit
//! semi-implicit  F = k δ − γ (u(n−½) + u(n+½))/2          the dashpot sets no limit
//! ```

use pendular::contact::Linear;

use crate::case::Outcome;
use crate::edge::Edge;
use crate::impact::{self, NOISE, OFFSETS, PRESSED, RADIUS, SPEED, WATCH};
use crate::rig::{Fault, Matter, dashpot, mass};

/// How the dashpot reads the speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Damper {
    /// Half a step before; the core does so, and the tests hold this program against it.
    #[cfg_attr(not(test), expect(dead_code, reason = "the core itself is on the map"))]
    Lagged,
    /// Extrapolated to the time of the positions.
    Extrapolated,
    /// The mean of before and after.
    Mean,
}

/// Two spheres along a line.
struct Line {
    stiffness: f64,
    damping: f64,
    mass: f64,
    press: f64,
    damper: Damper,
    gap: f64,
    speed: f64,
    before: f64,
}

impl Line {
    fn new(matter: &Matter, damper: Damper, [gap, speed]: [f64; 2]) -> Result<Self, Fault> {
        let mass = 0.5 * mass(RADIUS);
        let damping = dashpot(matter, mass)?;
        let (stiffness, press, before) = (matter.stiffness, 0.0, speed);
        Ok(Self { stiffness, damping, mass, press, damper, gap, speed, before })
    }

    /// One step; the first kick is half.
    fn step(&mut self, h: f64, kick: f64) {
        let spring = (-self.gap).max(0.0) * self.stiffness;
        let damping = if self.gap < 0.0 { self.damping } else { 0.0 };
        let lagged = match self.damper {
            Damper::Lagged | Damper::Mean => self.speed,
            Damper::Extrapolated => 1.5 * self.speed - 0.5 * self.before,
        };
        let push = (spring - damping * lagged).max(0.0) - self.press;
        let mut next = self.speed + kick * push / self.mass;
        if self.damper == Damper::Mean {
            let half = 0.5 * kick * damping / self.mass;
            let free = self.speed * (1.0 - half) + kick * (spring - self.press) / self.mass;
            // No pull at separation.
            next = (free / (1.0 + half)).max(self.speed - kick * self.press / self.mass);
        }
        (self.before, self.speed) = (self.speed, next);
        self.gap += h * next;
    }
}

/// As [`impact::edge`], with the same predicted limit: that of the core.
pub(crate) fn edge(matter: &Matter, damper: Damper) -> Result<Edge, Fault> {
    let core = impact::edge(matter)?;
    let stable = |h: f64| -> Result<bool, Fault> {
        let omega = (matter.stiffness / (0.5 * mass(RADIUS))).sqrt();
        let mut line = Line::new(matter, damper, [-PRESSED, NOISE * PRESSED * omega])?;
        line.press = matter.stiffness * PRESSED;
        let most = 10.0 * NOISE * PRESSED * omega;
        for step in 0..WATCH {
            line.step(h, if step == 0 { 0.5 * h } else { h });
            // Ten times the speed is a hundred times the energy, as for the other scenes.
            if line.speed.is_nan() || line.speed.abs() >= most {
                return Ok(false);
            }
        }
        Ok(true)
    };
    let (mut low, mut high) = (0.1 * core.limit, 8.0 * core.limit);
    for _ in 0..12 {
        let middle = (low * high).sqrt();
        if stable(middle)? {
            low = middle;
        } else {
            high = middle;
        }
    }
    Ok(Edge { edge: low, ..core })
}

/// As [`impact::run`].
pub(crate) fn run(matter: &Matter, damper: Damper, h: f64) -> Result<Outcome, Fault> {
    let reduced = 0.5 * mass(RADIUS);
    let law = Linear::from_restitution(matter.stiffness, matter.restitution, reduced)?;
    let steps = (4.0 * law.contact_time(reduced)? / h).ceil() as u64 + 4;
    impact::over_offsets(matter, |offset| {
        let gap = (f64::from(offset) + 0.5) / f64::from(OFFSETS) * SPEED * h;
        let mut line = Line::new(matter, damper, [gap, -SPEED])?;
        for step in 0..steps {
            line.step(h, if step == 0 { 0.5 * h } else { h });
        }
        Ok(line.speed / SPEED)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rig::Drag;

    fn zeta(matter: &Matter) -> (f64, f64) {
        let reduced = 0.5 * mass(RADIUS);
        let damping = dashpot(matter, reduced).unwrap();
        let omega = (matter.stiffness / reduced).sqrt();
        (damping / (2.0 * (matter.stiffness * reduced).sqrt()), omega)
    }

    #[test]
    fn limits_of_the_three_dashpots() {
        for restitution in [0.8, 0.5, 0.2, 0.05] {
            let matter = Matter { stiffness: 1e5, restitution, liquid: None, drag: Drag::Explicit };
            let (zeta, omega) = zeta(&matter);
            // Spectral radius 1: a lagged dashpot counts twice, an extrapolated one four times.
            let formula = |z: f64| 2.0 * ((1.0 + z * z).sqrt() - z) / omega;
            for (damper, expected) in [
                (Damper::Lagged, formula(zeta)),
                (Damper::Extrapolated, formula(2.0 * zeta)),
                (Damper::Mean, 2.0 / omega),
            ] {
                let found = edge(&matter, damper).unwrap().edge;
                let off = found / expected - 1.0;
                assert!(off.abs() < 0.01, "{damper:?} e {restitution}: {off}");
            }
        }
    }

    #[test]
    fn the_lagged_one_is_the_core() {
        let matter =
            Matter { stiffness: 1e4, restitution: 0.6, liquid: None, drag: Drag::Explicit };
        let h = 0.3 * impact::edge(&matter).unwrap().limit;
        let (core, plain) = (impact::run(&matter, h), run(&matter, Damper::Lagged, h));
        let (core, plain) = (core.unwrap(), plain.unwrap());
        assert!((core.state - plain.state).abs() < 1e-9, "{core:?} {plain:?}");
        assert!((core.error - plain.error).abs() < 1e-9, "{core:?} {plain:?}");
    }
}
