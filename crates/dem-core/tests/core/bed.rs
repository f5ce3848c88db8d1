//! Bodies and walls that the tests share.

use pendular_contact::Linear;
use pendular_dem_core::{
    Boundary, Class, Contact, DVec3, PairContact, Particles, Settings, Simulation, Touch,
};
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// Contact parameters of every pair in a test.
#[derive(Clone, Copy)]
pub(crate) struct Rub {
    pub(crate) stiffness: f64,
    pub(crate) restitution: f64,
    pub(crate) friction: f64,
    pub(crate) rolling: f64,
    /// Tangential dashpot, N s/m.
    pub(crate) sliding: f64,
}

pub(crate) const RUB: Rub =
    Rub { stiffness: 1e4, restitution: 0.8, friction: 0.4, rolling: 0.0, sliding: 0.0 };

pub(crate) fn contact(classes: &[Class], rub: Rub) -> Contact<Linear> {
    let law = move |mass: f64| PairContact {
        normal: Linear::from_restitution(rub.stiffness, rub.restitution, mass)
            .unwrap()
            .with_tangential_ratio(2.0 / 7.0)
            .unwrap(),
        friction: rub.friction,
        rolling_friction: rub.rolling,
        tangential_damping: rub.sliding,
    };
    let between = move |a: &Class, b: &Class| law(a.mass() * b.mass() / (a.mass() + b.mass()));
    Contact::new(classes, 1, between, move |a, _| law(a.mass()))
}

/// A box of half-spaces that may be shaken: floor, and four sides if `half` is given.
#[derive(Debug, Clone)]
pub(crate) struct Tray {
    pub(crate) half: Option<f64>,
    pub(crate) amplitude: f64,
    pub(crate) frequency: f64,
    pub(crate) height: f64,
    pub(crate) speed: f64,
}

impl Tray {
    pub(crate) fn still(half: Option<f64>) -> Self {
        Self { half, amplitude: 0.0, frequency: 0.0, height: 0.0, speed: 0.0 }
    }

    /// Normal and offset of a part.
    pub(crate) fn plane(&self, part: u32) -> (DVec3, f64) {
        let half = self.half.unwrap_or(0.0);
        match part {
            0 => (DVec3::Z, self.height),
            1 => (DVec3::X, -half),
            2 => (DVec3::NEG_X, -half),
            3 => (DVec3::Y, -half),
            _ => (DVec3::NEG_Y, -half),
        }
    }
}

impl Boundary for Tray {
    fn move_to(&mut self, time: f64, velocity_time: f64) {
        let w = std::f64::consts::TAU * self.frequency;
        self.height = self.amplitude * (w * time).sin();
        self.speed = self.amplitude * w * (w * velocity_time).cos();
    }

    fn velocity(&self, part: u32) -> DVec3 {
        if part == 0 { self.speed * DVec3::Z } else { DVec3::ZERO }
    }

    fn speed_bound(&self) -> f64 {
        self.amplitude * std::f64::consts::TAU * self.frequency
    }

    fn material(&self, _: u32) -> u8 {
        0
    }

    fn materials(&self) -> usize {
        1
    }

    fn is_present(&self, _: u32) -> bool {
        true
    }

    fn near(&self, centre: DVec3, reach: f64, parts: &mut Vec<u32>) {
        parts.clear();
        let count = if self.half.is_some() { 5 } else { 1 };
        parts.extend((0..count).filter(|&part| {
            let (normal, offset) = self.plane(part);
            centre.dot(normal) - offset <= reach
        }));
    }

    fn candidates(&self, _: u32, _: DVec3, _: f64, elements: &mut Vec<u32>) -> bool {
        elements.clear();
        true
    }

    fn touches(&self, part: u32, _: &[u32], x: DVec3, r: f64, reach: f64, out: &mut Vec<Touch>) {
        out.clear();
        let (normal, offset) = self.plane(part);
        let gap = x.dot(normal) - offset - r;
        if gap <= reach {
            out.push(Touch { element: 0, gap, normal: -normal });
        }
    }
}

pub(crate) fn uniform(random: &mut Pcg64, low: f64, high: f64) -> f64 {
    low + (high - low) * (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

/// A loose block of spheres of two sizes with random velocities and spins.
pub(crate) fn block(side: u32, speed: f64, seed: u64) -> Particles {
    let classes =
        vec![Class::new(1e-3, 2500.0, 0).unwrap(), Class::new(1.4e-3, 2000.0, 0).unwrap()];
    let mut particles = Particles::new(classes).unwrap();
    let mut random = Pcg64::seed_from_u64(seed);
    for k in 0..side.pow(3) {
        let at = DVec3::new(
            f64::from(k % side),
            f64::from(k / side % side),
            f64::from(k / side / side) + 0.5,
        );
        let mut any = |s: f64| {
            DVec3::new(
                uniform(&mut random, -s, s),
                uniform(&mut random, -s, s),
                uniform(&mut random, -s, s),
            )
        };
        let x = 3.0e-3 * (at - 0.5 * f64::from(side - 1) * DVec3::new(1.0, 1.0, 0.0));
        let (jitter, v, w) = (any(5e-5), any(speed), any(speed / 1e-3));
        particles.push((k % 2) as u16, x + jitter, v, w).unwrap();
    }
    particles
}

/// A block of spheres in a shaken box.
pub(crate) fn shaken(
    side: u32,
    change: impl FnOnce(&mut Settings),
    rub: Rub,
) -> Simulation<Contact<Linear>, Tray> {
    let particles = block(side, 0.3, 5);
    let tray = Tray {
        half: Some(1.6e-3 * f64::from(side)),
        amplitude: 1e-3,
        frequency: 100.0,
        height: 0.0,
        speed: 0.0,
    };
    let contact = contact(particles.classes(), rub);
    let mut settings = Settings::new(5e-6);
    change(&mut settings);
    Simulation::new(particles, contact, tray, settings).unwrap()
}
