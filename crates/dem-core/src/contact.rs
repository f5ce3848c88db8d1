use glam::DVec3;
use pendular_contact::NormalContact;

use crate::limit;
use crate::{Class, Encounter, Load, Pair, PairTerm};

/// A contact law of one pair of classes, or of a class and a wall material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairContact<N> {
    /// The normal law, its constants folded.
    pub normal: N,
    /// Coulomb friction coefficient μ_c, at least 0.
    pub friction: f64,
    /// Rolling friction μ_roll, m, at least 0: the rolling torque is at most μ_roll |F_n|.
    pub rolling_friction: f64,
    /// Tangential dashpot, N s/m, at least 0.
    pub tangential_damping: f64,
}

/// What a contact remembers: the tangential spring and the normal law's own memory.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Spring<M> {
    stretch: DVec3,
    memory: M,
}

type Rule<N> = Box<dyn Fn(u16, Partner) -> PairContact<N> + Send + Sync>;

#[derive(Clone, Copy)]
enum Partner {
    Class(u16),
    Wall(u8),
}

enum Table<N> {
    Dense(Vec<PairContact<N>>),
    OnDemand(Rule<N>),
}

/// Above this many classes pairs are computed when they touch instead of being tabulated.
const DENSE: usize = 256;

/// Dry contact: a normal law, a tangential spring limited by Coulomb friction, rolling friction.
///
/// The spring stretches with the slip, turns with the contact and is trimmed when it slides.
/// Coulomb's limit takes the contact's own repulsion, not what a bridge adds. Rolling friction is
/// a bounded implicit impulse: it stops a rolling sphere exactly and never drives it.
pub struct Contact<N> {
    classes: usize,
    materials: usize,
    between: Table<N>,
    walls: Vec<PairContact<N>>,
    rolls: bool,
}

impl<N> std::fmt::Debug for Contact<N> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Contact({} classes, {} wall materials)", self.classes, self.materials)
    }
}

impl<N: NormalContact + Send + Sync + 'static> Contact<N> {
    /// The contacts of all pairs of `classes` and of each class with `materials` wall materials.
    ///
    /// `between` gives the law of two particles, `with_wall` that of a particle and a wall
    /// material.
    pub fn new(
        classes: &[Class],
        materials: u8,
        between: impl Fn(&Class, &Class) -> PairContact<N> + Send + Sync + 'static,
        with_wall: impl Fn(&Class, u8) -> PairContact<N>,
    ) -> Self {
        let own = classes.to_vec();
        let walls: Vec<_> = own
            .iter()
            .flat_map(|class| (0..materials).map(move |m| (class, m)))
            .map(|(class, m)| with_wall(class, m))
            .collect();
        let mut rolls = walls.iter().any(|pair| pair.rolling_friction > 0.0);
        let table = if own.len() <= DENSE {
            let pairs = own.iter().flat_map(|a| own.iter().map(move |b| (a, b)));
            let dense: Vec<_> = pairs.map(|(a, b)| between(a, b)).collect();
            rolls |= dense.iter().any(|pair| pair.rolling_friction > 0.0);
            Table::Dense(dense)
        } else {
            rolls = true;
            Table::OnDemand(Box::new(move |a, b| match b {
                Partner::Class(b) => between(&own[usize::from(a)], &own[usize::from(b)]),
                Partner::Wall(_) => between(&own[usize::from(a)], &own[usize::from(a)]),
            }))
        };
        let materials = usize::from(materials);
        Self { classes: classes.len(), materials, between: table, walls, rolls }
    }

    #[inline(always)]
    fn of(&self, first: u16, second: Partner) -> PairContact<N> {
        match (second, &self.between) {
            (Partner::Wall(m), _) => {
                self.walls[usize::from(first) * self.materials + usize::from(m)]
            }
            (Partner::Class(b), Table::Dense(dense)) => {
                dense[usize::from(first) * self.classes + usize::from(b)]
            }
            (_, Table::OnDemand(rule)) => rule(first, second),
        }
    }

    #[inline(always)]
    fn law(&self, pair: &Pair) -> PairContact<N> {
        match pair.encounter.second {
            crate::Partner::Particle(_) => {
                self.of(pair.first_class, Partner::Class(pair.second_class))
            }
            crate::Partner::Wall(_) => {
                self.of(pair.first_class, Partner::Wall(pair.second_class as u8))
            }
        }
    }

    fn strongest(&self, class: usize, radius: f64) -> limit::Load {
        let first = class as u16;
        let others = (0..self.classes.min(DENSE)).map(|b| Partner::Class(b as u16));
        let walls = (0..self.materials).map(|m| Partner::Wall(m as u8));
        // A nonlinear law is read at an overlap of 2 % of the radius.
        let overlap = 0.02 * radius;
        others.chain(walls).map(|other| self.of(first, other)).fold(
            limit::Load::default(),
            |most, law| limit::Load {
                normal_stiffness: most.normal_stiffness.max(law.normal.stiffness(overlap)),
                tangential_stiffness: most
                    .tangential_stiffness
                    .max(law.normal.tangential_stiffness(overlap)),
                normal_damping: most.normal_damping.max(law.normal.damping(overlap)),
                tangential_damping: most.tangential_damping.max(law.tangential_damping),
                ..most
            },
        )
    }
}

impl<N: NormalContact + Send + Sync + 'static> PairTerm for Contact<N>
where
    N::Memory: PartialEq,
{
    type Column = Spring<N::Memory>;

    fn reach(&self) -> f64 {
        0.0
    }

    #[inline(always)]
    fn idle(&self, encounter: &Encounter, column: &mut Self::Column) -> bool {
        let idle = encounter.gap >= 0.0;
        if idle {
            *column = Spring::default();
        }
        idle
    }

    #[inline(always)]
    fn load(&self, pair: &Pair, column: &mut Self::Column) -> Load {
        let overlap = -pair.encounter.gap;
        if overlap <= 0.0 {
            return Load::default();
        }
        let law = self.law(pair);
        let repulsion = law.normal.force(overlap, -pair.separation_speed, &mut column.memory);
        let shear = if law.friction > 0.0 {
            tangential(&law, pair, overlap, repulsion, &mut column.stretch)
        } else {
            DVec3::ZERO
        };
        let rolling = if law.rolling_friction > 0.0 && pair.rolling_inertia > 0.0 {
            rolling(law.rolling_friction * repulsion.max(0.0), pair)
        } else {
            DVec3::ZERO
        };
        Load { tension: -repulsion, shear, rolling, ..Load::default() }
    }

    #[inline(always)]
    fn live(&self, column: &Self::Column) -> bool {
        *column != Spring::default()
    }

    fn rolls(&self) -> bool {
        self.rolls
    }

    fn stability(&self, classes: &[Class]) -> Vec<limit::Load> {
        classes.iter().enumerate().map(|(i, class)| self.strongest(i, class.radius())).collect()
    }
}

/// F_t = −k_t ξ − γ_t u, at most μ |F_n|; ξ follows the slip and the turning contact plane.
#[inline(always)]
fn tangential<N: NormalContact>(
    law: &PairContact<N>,
    pair: &Pair,
    overlap: f64,
    repulsion: f64,
    stretch: &mut DVec3,
) -> DVec3 {
    let stiffness = law.normal.tangential_stiffness(overlap);
    let half = pair.half_step_normal;
    let before = *stretch - stretch.dot(half) * half + pair.time_step * pair.slip;
    let now = before - before.dot(pair.normal) * pair.normal;
    let dashpot = law.tangential_damping * pair.slip;
    let trial = -stiffness * now - dashpot;
    let limit = law.friction * repulsion.abs();
    let size2 = trial.length_squared();
    if size2 > limit * limit {
        let force = trial * (limit / size2.sqrt());
        *stretch = -(force + dashpot) / stiffness.max(f64::MIN_POSITIVE);
        force
    } else {
        *stretch = now;
        trial
    }
}

/// The torque that would stop the expected relative rolling in this step, at most `limit` (N m).
#[inline(always)]
fn rolling(limit: f64, pair: &Pair) -> DVec3 {
    let spin = pair.expected_spin;
    let rolling = spin - spin.dot(pair.normal) * pair.normal;
    let stopping = -(pair.rolling_inertia / pair.time_step) * rolling;
    let size2 = stopping.length_squared();
    if size2 > limit * limit { stopping * (limit / size2.sqrt()) } else { stopping }
}
