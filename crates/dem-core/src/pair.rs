use glam::DVec3;

/// The second body of a pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Partner {
    /// A particle, by its id.
    Particle(u32),
    /// A wall part, by its index.
    Wall(u32),
}

/// Two bodies near each other, before anything but their distance is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Encounter {
    /// Id of the first particle.
    pub first: u32,
    /// The second body.
    pub second: Partner,
    /// Element of the wall part that is nearest; 0 between particles.
    pub element: u32,
    /// Whether this is the nearest touch of the particle with the wall part; always so between
    /// particles. A sphere in a corner of one part touches it twice, but has one bridge with it.
    pub nearest: bool,
    /// Gap S of the surfaces, m; negative in overlap.
    pub gap: f64,
}

/// A pair of bodies in one step: geometry at the step's start, velocities half a step before,
/// taken with the half-step normal (right at any size ratio: Vyas et al. 2025).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// Who meets whom, and how near.
    pub encounter: Encounter,
    /// Class of the first particle.
    pub first_class: u16,
    /// Class of the second particle, or material of the wall.
    pub second_class: u16,
    /// Radii, m; the second is `f64::INFINITY` for a wall.
    pub radii: [f64; 2],
    /// Unit vector from the first body to the second.
    pub normal: DVec3,
    /// Unit vector from the first body to the second half a step before.
    pub half_step_normal: DVec3,
    /// dS/dt, m/s; negative while the bodies approach.
    pub separation_speed: f64,
    /// Slip u: velocity of the first surface relative to the second across the line of centres,
    /// `v_t + (l_i ω_i + l_j ω_j) × n`, m/s.
    pub slip: DVec3,
    /// Relative spin ω_i − ω_j, rad/s.
    pub spin: DVec3,
    /// Relative spin expected at the end of the step without rolling friction, rad/s; zero unless
    /// a term asks for it ([`crate::PairTerm::rolls`]).
    pub expected_spin: DVec3,
    /// Moment of inertia that this contact may brake without braking a particle more than once,
    /// `1/(z_i/I_i + z_j/I_j)` with z contacts on each, kg m²; zero unless a term asks for it.
    pub rolling_inertia: f64,
    /// Lever arms l_i = r_i + S/2, l_j = r_j + S/2, m: the contact lies in the middle of the gap, and
    /// l_i + l_j is the distance of the centres. Against a wall r_i and 0.
    pub levers: [f64; 2],
    /// Time step, s.
    pub time_step: f64,
}

/// What acts within a pair.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Load {
    /// Force along the normal, N, positive when the bodies attract each other.
    pub tension: f64,
    /// Force on the first body across the normal, N; acts at the contact, so that it turns both.
    pub shear: DVec3,
    /// Torque on the first body, N m; the second gets the opposite.
    pub couple: DVec3,
    /// Torque of rolling friction on the first body, N m; the second gets the opposite.
    pub rolling: DVec3,
    /// Whether the pair wants [`crate::PairTerm::settle`] to look at it after this read.
    pub attention: bool,
}

impl std::ops::Add for Load {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        Self {
            tension: self.tension + other.tension,
            shear: self.shear + other.shear,
            couple: self.couple + other.couple,
            rolling: self.rolling + other.rolling,
            attention: self.attention | other.attention,
        }
    }
}
