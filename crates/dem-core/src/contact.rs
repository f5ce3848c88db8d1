mod act;

use glam::DVec3;
use pendular_contact::NormalContact;

use crate::lane::Lane;
use crate::limit;
use crate::pairs::{Columns, Geometry, Loads, Pairs};
use crate::{Class, Encounter, Load, Pair, PairTerm, Resist};
use act::{Acting, act};

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

impl<M: Copy> Spring<M> {
    /// A spring stretched by ξ m, with the normal law's memory.
    #[must_use]
    pub fn new(stretch: DVec3, memory: M) -> Self {
        Self { stretch, memory }
    }

    /// Stretch ξ of the tangential spring, m.
    #[must_use]
    pub fn stretch(&self) -> DVec3 {
        self.stretch
    }

    /// What the normal law remembers.
    #[must_use]
    pub fn memory(&self) -> M {
        self.memory
    }
}

/// The forces of one contact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ContactForces {
    /// Repulsion, N.
    pub normal: f64,
    /// Friction on the first body, N.
    pub tangential: DVec3,
    /// Torque of rolling friction on the first body, N m.
    pub rolling: DVec3,
    /// Power that the dashpot takes, W.
    pub normal_power: f64,
    /// Power that sliding takes, W; what the tangential spring stores is not counted.
    pub tangential_power: f64,
    /// Power that rolling friction takes, W.
    pub rolling_power: f64,
}

type Rule<N> = Box<dyn Fn(u16, Partner) -> PairContact<N> + Send + Sync>;

#[derive(Clone, Copy)]
enum Partner {
    Class(u16),
    Wall(u8),
}

fn partner(encounter: &Encounter, second: u16) -> Partner {
    match encounter.second {
        crate::Partner::Particle(_) => Partner::Class(second),
        crate::Partner::Wall(_) => Partner::Wall(second as u8),
    }
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
    heaviest: usize,
    between: Table<N>,
    walls: Vec<PairContact<N>>,
    rolls: bool,
    /// Whether loads hold dashpot and rolling friction too.
    resists: bool,
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
        let mass = |k: &usize| classes[*k].mass();
        let heaviest = (0..classes.len()).max_by(|a, b| mass(a).total_cmp(&mass(b))).unwrap_or(0);
        let materials = usize::from(materials);
        Self {
            classes: classes.len(),
            materials,
            heaviest,
            between: table,
            walls,
            rolls,
            resists: true,
        }
    }

    #[inline]
    fn law(&self, first: u16, second: Partner) -> PairContact<N> {
        let row = usize::from(first);
        match (second, &self.between) {
            (Partner::Wall(m), _) => self.walls[row * self.materials + usize::from(m)],
            (Partner::Class(b), Table::Dense(dense)) => dense[row * self.classes + usize::from(b)],
            (_, Table::OnDemand(rule)) => rule(first, second),
        }
    }

    fn acting(&self) -> Acting {
        Acting { rolls: self.rolls && self.resists, dashpot: self.resists }
    }

    #[inline]
    fn law_of(&self, pair: &Pair) -> PairContact<N> {
        self.law(pair.first_class, partner(&pair.encounter, pair.second_class))
    }

    /// What acts in a contact, part by part: for budgets and reports, not for the step.
    #[must_use]
    pub fn forces(&self, pair: &Pair, spring: &Spring<N::Memory>) -> ContactForces
    where
        N::Memory: PartialEq,
    {
        let (overlap, mut column) = (-pair.encounter.gap, *spring);
        if overlap <= 0.0 {
            return ContactForces::default();
        }
        let law = self.law_of(pair);
        let all = Acting { rolls: self.rolls, dashpot: true };
        let load = act((), [&law], all, &Geometry::of(pair), &mut &mut column).single();
        let elastic = law.normal.force(overlap, 0.0, &mut spring.memory.clone());
        let slides = load.shear.length() >= (1.0 - 1e-9) * law.friction * load.tension.abs();
        let dashpot = law.tangential_damping * pair.slip.length_squared();
        ContactForces {
            normal: -load.tension,
            tangential: load.shear,
            rolling: load.rolling,
            normal_power: (elastic + load.tension) * pair.separation_speed,
            tangential_power: if slides { -load.shear.dot(pair.slip) } else { dashpot },
            rolling_power: -load.rolling.dot(pair.spin),
        }
    }

    fn strongest(&self, class: usize, radius: f64) -> limit::Load {
        let first = class as u16;
        // Among very many classes the heaviest partner stands for those not looked at.
        let others = (0..self.classes.min(DENSE)).chain([self.heaviest]);
        let others = others.map(|b| Partner::Class(b as u16));
        let walls = (0..self.materials).map(|m| Partner::Wall(m as u8));
        // A nonlinear law is read at an overlap of 2 % of the radius.
        let overlap = 0.02 * radius;
        others.chain(walls).map(|other| self.law(first, other)).fold(
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
        if size_of::<N::Memory>() > 0 {
            if idle {
                *column = Spring::default();
            }
        } else {
            // Bits, so that no branch comes of it: no processor foresees which pairs touch.
            let keep = u64::from(!idle).wrapping_neg();
            let kept = |stretch: f64| f64::from_bits(stretch.to_bits() & keep);
            let DVec3 { x, y, z } = column.stretch;
            column.stretch = DVec3::new(kept(x), kept(y), kept(z));
        }
        idle
    }

    const SETTLES: bool = false;
    const LANES: bool = true;
    const ACTS_IN_OVERLAP: bool = true;
    const COUPLES: bool = false;

    #[inline(always)]
    fn load(&self, pair: &Pair, mut column: &mut Self::Column) -> Load {
        let law = self.law_of(pair);
        act((), [&law], self.acting(), &Geometry::of(pair), &mut column).single()
    }

    #[inline(always)]
    fn load_lanes<L: Lane>(
        &self,
        pairs: &Pairs<'_, L>,
        columns: &mut impl Columns<Self::Column>,
    ) -> Loads<L> {
        // An idle spring is at rest.
        if pairs.apart {
            return Loads::none(pairs.permit);
        }
        match &self.between {
            Table::Dense(dense) => {
                let laws = L::each(|k| {
                    let [first, second] = pairs.classes(k);
                    &dense[usize::from(first) * self.classes + usize::from(second)]
                });
                act(pairs.permit, laws, self.acting(), pairs.geometry, columns)
            }
            Table::OnDemand(rule) => {
                let laws = L::each(|k| {
                    let [first, second] = pairs.classes(k);
                    rule(first, Partner::Class(second))
                });
                act(pairs.permit, L::each(|k| &laws[k]), self.acting(), pairs.geometry, columns)
            }
        }
    }

    #[inline(always)]
    fn live(&self, column: &Self::Column) -> bool {
        *column != Spring::default()
    }

    fn rolls(&self) -> bool {
        self.rolls && self.resists
    }

    fn leave_resistance(&mut self) {
        self.resists = false;
    }

    #[inline(always)]
    fn resist(&self, pair: &Pair, column: &Self::Column, _: f64) -> Resist {
        let overlap = -pair.encounter.gap;
        if overlap <= 0.0 {
            return Resist::default();
        }
        let law = self.law_of(pair);
        let repulsion = law.normal.force(overlap, 0.0, &mut column.memory.clone()).max(0.0);
        Resist {
            dashpot: law.normal.damping(overlap),
            pull: if law.normal.may_pull() { f64::INFINITY } else { repulsion },
            rolling: law.rolling_friction * repulsion,
            ..Resist::default()
        }
    }

    #[inline(always)]
    fn resist_lanes<L: Lane>(
        &self,
        pairs: &Pairs<'_, L>,
        columns: &mut impl Columns<Self::Column>,
        _: L,
    ) -> Resist<L> {
        let (permit, none) = (pairs.permit, Resist::none(pairs.permit));
        if pairs.apart {
            return none;
        }
        let laws = L::each(|k| {
            let [first, second] = pairs.classes(k);
            self.law(first, Partner::Class(second))
        });
        let overlap = -pairs.geometry.gap;
        let (overlaps, zero) = (overlap.unpack(), L::splat(permit, 0.0));
        let mut memories = L::each(|k| columns.column(k).memory);
        let normal = L::each(|k| &laws[k].normal);
        let [repulsion, ..] = N::side_by_side(&normal, overlap, zero, &mut memories);
        let repulsion = repulsion.most(zero);
        let damping = L::each(|k| laws[k].normal.damping(overlaps[k]));
        let strongest =
            L::pack(permit, &laws, |law| if law.normal.may_pull() { f64::INFINITY } else { 0.0 });
        Resist {
            dashpot: L::pack(permit, &damping, |damping| *damping),
            pull: strongest.most(repulsion),
            rolling: L::pack(permit, &laws, |law| law.rolling_friction) * repulsion,
            ..none
        }
    }

    fn wall_materials(&self) -> Option<usize> {
        Some(self.materials)
    }

    fn stability(&self, classes: &[Class]) -> Vec<limit::Load> {
        classes.iter().enumerate().map(|(i, class)| self.strongest(i, class.radius())).collect()
    }

    fn load_on_limit(&self, pair: &Pair, _: &Self::Column) -> limit::Load {
        let overlap = -pair.encounter.gap;
        if overlap <= 0.0 {
            return limit::Load::default();
        }
        let law = self.law_of(pair);
        limit::Load {
            normal_stiffness: law.normal.stiffness(overlap),
            tangential_stiffness: law.normal.tangential_stiffness(overlap),
            normal_damping: law.normal.damping(overlap),
            tangential_damping: law.tangential_damping,
            ..limit::Load::default()
        }
    }
}
