use pendular_dem_core::{ContactForces, Pair, Partner};

use crate::BridgeForces;

/// What acts between two bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Acting {
    /// Repulsion of a contact, its dashpot included.
    NormalContact,
    /// Friction of a contact.
    TangentialContact,
    /// Rolling friction; its impulse is that of the torque over the first body's radius.
    RollingFriction,
    /// Capillary tension of a bridge.
    Capillary,
    /// Viscous force along the line of centres.
    ViscousNormal,
    /// Viscous force and torque across it.
    ViscousTangential,
    /// All forces of those bridges that live beyond their static rupture distance, which
    /// [`crate::transfer::Dynamic`] allows; also counted above.
    DynamicRupture,
}

impl Acting {
    /// Everything that may act.
    pub const ALL: [Self; 7] = [
        Self::NormalContact,
        Self::TangentialContact,
        Self::RollingFriction,
        Self::Capillary,
        Self::ViscousNormal,
        Self::ViscousTangential,
        Self::DynamicRupture,
    ];

    /// Its name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::NormalContact => "normal contact",
            Self::TangentialContact => "tangential contact",
            Self::RollingFriction => "rolling friction",
            Self::Capillary => "capillary force",
            Self::ViscousNormal => "viscous normal",
            Self::ViscousTangential => "viscous tangential",
            Self::DynamicRupture => "dynamic rupture",
        }
    }
}

/// The second body of a pair, as a budget tells them apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Against {
    /// Another particle.
    Particles,
    /// A wall.
    Walls,
}

/// What one kind of force has done.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Share {
    /// Sum of the force's magnitude over pairs and time, N s.
    pub impulse: f64,
    /// Energy it took from the motion, J.
    pub energy: f64,
    /// Pairs in which it was seen to act, summed over the looks.
    pub seen: u64,
}

/// Which forces did how much: sums over looks at all pairs, each of them standing for the time since
/// the last one.
///
/// A force whose share of the impulse is small can be left out or simplified without changing much;
/// what it changes in the end only a run without it tells.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Budget {
    shares: [[Share; 2]; 7],
    looks: u64,
}

impl Budget {
    /// Counts one look at all pairs.
    pub fn look(&mut self) {
        self.looks += 1;
    }

    /// Looks so far.
    #[must_use]
    pub fn looks(&self) -> u64 {
        self.looks
    }

    /// Adds a contact that stands for `time` s.
    pub fn contact(&mut self, pair: &Pair, forces: &ContactForces, time: f64) {
        let torque = forces.rolling.length() / pair.radii[0];
        self.add(Acting::NormalContact, pair, forces.normal.abs(), forces.normal_power, time);
        let tangential = forces.tangential.length();
        self.add(Acting::TangentialContact, pair, tangential, forces.tangential_power, time);
        self.add(Acting::RollingFriction, pair, torque, forces.rolling_power, time);
    }

    /// Adds a bridge that stands for `time` s. What capillary tension takes is not in its power but
    /// in [`crate::Wet::capillary_loss`].
    pub fn bridge(&mut self, pair: &Pair, forces: &BridgeForces, time: f64) {
        let normal = forces.viscous_normal.abs();
        let tangential = forces.viscous_tangential.length();
        self.add(Acting::Capillary, pair, forces.capillary.abs(), 0.0, time);
        self.add(Acting::ViscousNormal, pair, normal, forces.normal_power, time);
        self.add(Acting::ViscousTangential, pair, tangential, forces.tangential_power, time);
        if forces.stretched {
            let all = forces.capillary.abs() + normal + tangential;
            self.add(Acting::DynamicRupture, pair, all, 0.0, time);
        }
    }

    fn add(&mut self, acting: Acting, pair: &Pair, force: f64, power: f64, time: f64) {
        let against = match pair.encounter.second {
            Partner::Particle(_) => Against::Particles,
            Partner::Wall(_) => Against::Walls,
        };
        let share = &mut self.shares[acting as usize][against as usize];
        share.impulse += force * time;
        share.energy += power * time;
        share.seen += u64::from(force != 0.0);
    }

    /// What a force has done against particles or walls.
    #[must_use]
    pub fn share(&self, acting: Acting, against: Against) -> Share {
        self.shares[acting as usize][against as usize]
    }

    /// Its share of the whole impulse, 0 to 1; against both kinds of bodies.
    #[must_use]
    pub fn of_impulse(&self, acting: Acting) -> f64 {
        let of = |acting: Acting| -> f64 {
            self.shares[acting as usize].iter().map(|share| share.impulse).sum()
        };
        // Dynamic rupture is a part of the others.
        let all = Acting::ALL.iter().filter(|&&one| one != Acting::DynamicRupture);
        let whole: f64 = all.map(|&one| of(one)).sum();
        if whole > 0.0 { of(acting) / whole } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pendular_dem_core::{DVec3, Encounter};

    fn pair(second: Partner) -> Pair {
        Pair {
            encounter: Encounter { first: 0, second, element: 0, nearest: true, gap: -1e-6 },
            first_class: 0,
            second_class: 0,
            radii: [1e-3, 1e-3],
            normal: DVec3::X,
            half_step_normal: DVec3::X,
            separation_speed: 0.1,
            slip: DVec3::Y,
            spin: DVec3::ZERO,
            expected_spin: DVec3::ZERO,
            rolling_inertia: 0.0,
            levers: [1e-3, 1e-3],
            time_step: 1e-6,
        }
    }

    #[test]
    fn shares_of_the_impulse_add_up_and_a_stretched_bridge_is_not_counted_twice() {
        let mut budget = Budget::default();
        let contact = ContactForces { normal: 3.0, normal_power: 2.0, ..Default::default() };
        budget.contact(&pair(Partner::Wall(0)), &contact, 0.5);
        let stretched = true;
        let bridge = BridgeForces { capillary: 1.0, stretched, ..Default::default() };
        budget.bridge(&pair(Partner::Particle(1)), &bridge, 0.5);
        assert_eq!(budget.of_impulse(Acting::NormalContact), 0.75);
        assert_eq!(budget.of_impulse(Acting::Capillary), 0.25);
        assert_eq!(budget.of_impulse(Acting::DynamicRupture), 0.25);
        let wall = budget.share(Acting::NormalContact, Against::Walls);
        assert_eq!((wall.impulse, wall.energy, wall.seen), (1.5, 1.0, 1));
        assert_eq!(budget.share(Acting::NormalContact, Against::Particles), Share::default());
    }
}
