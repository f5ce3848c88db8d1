//! The longest stable time step of a packing.

use glam::DVec3;

use crate::Class;
use crate::held::Held;

/// Contacts that a sphere of the smallest class is taken to have (fcc packing).
const CONTACTS: f64 = 12.0;
/// Share of the formula's limit that holds for springs and dashpots in every packing measured.
const SAFETY: f64 = 0.9;
/// The same where explicit viscous drag prevails.
const SAFETY_VISCOUS: f64 = 0.7;

/// Steps towards the limit of springs and damping together.
const CLOSER: u32 = 4;

/// The strongest pair that a class can be part of.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Load {
    /// Normal stiffness k_n, N/m.
    pub normal_stiffness: f64,
    /// Tangential stiffness k_t, N/m.
    pub tangential_stiffness: f64,
    /// Normal damping c_n of dashpots, N s/m.
    pub normal_damping: f64,
    /// Tangential damping c_t of dashpots, N s/m.
    pub tangential_damping: f64,
    /// Normal viscous drag, N s/m.
    pub normal_drag: f64,
    /// Tangential viscous drag, N s/m.
    pub tangential_drag: f64,
}

impl Load {
    /// What is left of it where dashpots and drags are solved for at the end of the step
    /// ([`crate::Implicit`]): they limit nothing then. A drag without a value still allows no step.
    #[must_use]
    pub fn resisted_implicitly(self) -> Self {
        let left = |drag: f64| if drag.is_finite() { 0.0 } else { f64::INFINITY };
        Self {
            normal_damping: left(self.normal_damping),
            normal_drag: left(self.normal_drag),
            tangential_drag: left(self.tangential_drag),
            ..self
        }
    }
}

impl std::ops::Add for Load {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            normal_stiffness: self.normal_stiffness + other.normal_stiffness,
            tangential_stiffness: self.tangential_stiffness + other.tangential_stiffness,
            normal_damping: self.normal_damping + other.normal_damping,
            tangential_damping: self.tangential_damping + other.tangential_damping,
            normal_drag: self.normal_drag + other.normal_drag,
            tangential_drag: self.tangential_drag + other.tangential_drag,
        }
    }
}

/// The longest time step and what sets it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// Longest time step, s, safety included; `f64::INFINITY` if nothing limits it.
    pub time_step: f64,
    /// Index of the class that limits it.
    pub class: usize,
    /// `contact springs and dashpots` or `viscous drag`.
    pub term: &'static str,
}

impl Limit {
    const NONE: Self = Self { time_step: f64::INFINITY, class: 0, term: "nothing" };

    /// The limit of a packing in which every sphere has twelve contacts of its strongest kind.
    ///
    /// ```text
    /// Λ_K = 2 (z/m) max((k_n + 2 k_t)/3, 5 k_t/3)   likewise Λ_C;   h = (√(Λ_C² + 4 Λ_K) − Λ_C)/Λ_K
    /// ```
    ///
    /// An isotropic neighbourhood of z contacts makes the eigenvalue bound of a sphere's own stiffness
    /// block explicit; it lies within 10 % of the exact limit of real packings where formulas for one
    /// pair are 1.4 to 2.4 times too large.
    #[must_use]
    pub fn packing(classes: &[Class], loads: &[Load]) -> Self {
        Self::least(packed(classes, loads).map(|(class, mass, sums)| sums.limit(mass, class)))
    }

    /// The same, term by term: springs alone, with their dashpots, viscous drag alone. Terms that
    /// are not there have no row.
    #[must_use]
    pub fn table(classes: &[Class], loads: &[Load]) -> Vec<Self> {
        let alone = |term, keep: fn(Sums) -> Sums, safety: f64| {
            let one = |(class, mass, sums): (usize, f64, Sums)| {
                let time_step = safety * keep(sums).longest(mass);
                Self { time_step, class, term }
            };
            Self::least(packed(classes, loads).map(one))
        };
        let rows = [
            alone("contact springs", |s| Sums { dashpot: [0.0; 2], drag: [0.0; 2], ..s }, SAFETY),
            alone("contact springs and dashpots", |s| Sums { drag: [0.0; 2], ..s }, SAFETY),
            alone("viscous drag", |s| Sums { drag: s.drag, ..Sums::default() }, SAFETY_VISCOUS),
        ];
        rows.into_iter().filter(|row| row.time_step.is_finite()).collect()
    }

    /// The smallest of several.
    pub(crate) fn least(limits: impl Iterator<Item = Self>) -> Self {
        limits.fold(
            Self::NONE,
            |least, one| if one.time_step < least.time_step { one } else { least },
        )
    }
}

/// Every class with its mass and the sums of twelve contacts.
fn packed<'a>(
    classes: &'a [Class],
    loads: &'a [Load],
) -> impl Iterator<Item = (usize, f64, Sums)> + 'a {
    classes.iter().zip(loads).enumerate().map(|(class, (kind, load))| {
        let mut sums = Sums::default();
        sums.add(load);
        (class, kind.mass(), sums.times(CONTACTS))
    })
}

/// Sums over the pairs of one sphere: normal and tangential each.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    stiffness: [f64; 2],
    dashpot: [f64; 2],
    drag: [f64; 2],
}

impl Sums {
    fn add(&mut self, load: &Load) {
        let both = [
            (&mut self.stiffness, [load.normal_stiffness, load.tangential_stiffness]),
            (&mut self.dashpot, [load.normal_damping, load.tangential_damping]),
            (&mut self.drag, [load.normal_drag, load.tangential_drag]),
        ];
        for (sum, [normal, tangential]) in both {
            sum[0] += normal;
            sum[1] += tangential;
        }
    }

    fn times(self, z: f64) -> Self {
        let times = |sum: [f64; 2]| sum.map(|one| z * one);
        let Self { stiffness, dashpot, drag } = self;
        Self { stiffness: times(stiffness), dashpot: times(dashpot), drag: times(drag) }
    }

    /// Safety included.
    fn limit(&self, mass: f64, class: usize) -> Limit {
        let [stiff, dashpot, drag] = self.lambdas(mass);
        limit(stiff, dashpot + drag, drag, class)
    }

    fn longest(&self, mass: f64) -> f64 {
        let [stiff, dashpot, drag] = self.lambdas(mass);
        longest(stiff, dashpot + drag)
    }

    fn lambdas(&self, mass: f64) -> [f64; 3] {
        [self.stiffness, self.dashpot, self.drag]
            // What is no number holds without a limit.
            .map(|[n, t]| [n, t].map(|c| if c.is_nan() { f64::INFINITY } else { c }))
            .map(|[n, t]| 2.0 / mass * ((n + 2.0 * t) / 3.0).max(5.0 * t / 3.0))
    }
}

/// Limit from the fastest spring, the strongest damping and the strongest drag among it.
fn limit(stiff: f64, damp: f64, drag: f64, class: usize) -> Limit {
    let (safety, term) = safety(stiff, drag);
    Limit { time_step: safety * longest(stiff, damp), class, term }
}

/// Share of the limit that holds, and what it is called.
fn safety(stiff: f64, drag: f64) -> (f64, &'static str) {
    if drag * drag > 4.0 * stiff {
        (SAFETY_VISCOUS, "viscous drag")
    } else {
        (SAFETY, "contact springs and dashpots")
    }
}

/// What holds one sphere in a packing as it is.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Hold {
    stiffness: Held,
    damping: Held,
    drag: Held,
}

impl Hold {
    /// Adds a pair: its `normal` from this sphere outwards, this sphere's mass and the other's
    /// (infinite for a wall), kg, and how fast the `other` is, over how fast this one is.
    ///
    /// Springs between two bodies obey `(a − b)² ≤ (1 + t) a² + (1 + 1/t) b²`, so blocks weighted in
    /// that way bound the whole packing, whatever t. With t = √(m_i/m_j) one pair of equal spheres
    /// and a sphere at a wall are exact, and a large sphere does not pay for the small ones around
    /// it; times how fast they are, a sphere that is held by many does not count twice.
    pub(crate) fn add(&mut self, load: &Load, normal: DVec3, masses: [f64; 2], other: f64) {
        let weight = (1.0 + (masses[0] / masses[1]).sqrt() * other) / masses[0];
        self.stiffness.add(
            normal,
            weight * load.normal_stiffness,
            weight * load.tangential_stiffness,
        );
        let (along, across) = (weight * load.normal_drag, weight * load.tangential_drag);
        self.drag.add(normal, along, across);
        let along = along + weight * load.normal_damping;
        self.damping.add(normal, along, across + weight * load.tangential_damping);
    }

    /// Safety included.
    pub(crate) fn limit(&self, class: usize) -> Limit {
        let [stiff, damp, drag] = [self.stiffness, self.damping, self.drag].map(Held::largest);
        limit(stiff, damp, drag, class)
    }

    /// The same with springs and damping in the directions in which they are strong together, which
    /// is never less: what comes nearer to the limit from below.
    pub(crate) fn finer(&self, coarse: Limit) -> Limit {
        let [stiff, drag] = [self.stiffness, self.drag].map(Held::largest);
        let safety = safety(stiff, drag).0;
        let mut h = coarse.time_step / safety;
        for _ in 0..CLOSER {
            // Twice the step is at most four times the matrix.
            let fastest = self.stiffness.times(h * h).plus(&self.damping.times(2.0 * h)).largest();
            if fastest > 0.0 {
                h *= (4.0 / fastest).sqrt().max(1.0);
            }
        }
        Limit { time_step: safety * h, ..coarse }
    }
}

/// h with h² Λ_K + 2 h Λ_C = 4, written without cancellation where damping prevails.
fn longest(stiff: f64, damp: f64) -> f64 {
    if stiff == 0.0 && damp == 0.0 {
        return f64::INFINITY;
    }
    4.0 / ((damp * damp + 4.0 * stiff).sqrt() + damp)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pom_example_of_twelve_contacts() {
        // POM, d = 3 mm, k_n = 1e5 N/m, k_t/k_n = 0.788: 4.9e-6 s undamped, before safety.
        let class = Class::new(1.5e-3, 1357.0, 0).unwrap();
        let load = Load { normal_stiffness: 1e5, tangential_stiffness: 0.788e5, ..Load::default() };
        let limit = Limit::packing(&[class], &[load]).time_step / SAFETY;
        assert!((limit - 4.9e-6).abs() < 0.1e-6, "{limit:e}");
    }

    #[test]
    fn damping_alone_and_stiffness_alone() {
        assert!((longest(4.0, 0.0) - 1.0).abs() < 1e-15);
        assert!((longest(0.0, 4.0) - 0.5).abs() < 1e-15);
        assert_eq!(longest(0.0, 0.0), f64::INFINITY);
    }

    #[test]
    fn viscous_drag_is_named() {
        let class = Class::new(1.5e-3, 1357.0, 0).unwrap();
        let dry = Load { normal_stiffness: 1e5, ..Load::default() };
        let wet = Load { normal_drag: 100.0, ..dry };
        assert_eq!(Limit::packing(&[class], &[dry]).term, "contact springs and dashpots");
        assert_eq!(Limit::packing(&[class], &[wet]).term, "viscous drag");
    }
}
