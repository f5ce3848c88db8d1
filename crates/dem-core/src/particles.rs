use glam::DVec3;

use crate::ParticleError;
use crate::error::FARTHEST;

/// What a kind of particle is: its radius, its density, its material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Class {
    radius: f64,
    density: f64,
    material: u8,
    mass: f64,
    inertia: f64,
}

impl Class {
    /// A class of solid spheres: `radius` m, `density` kg/m³, `material` the caller's index.
    ///
    /// # Errors
    /// [`ParticleError::Class`] unless radius and density are positive and finite.
    pub fn new(radius: f64, density: f64, material: u8) -> Result<Self, ParticleError> {
        for (quantity, value) in [("radius", radius), ("density", density)] {
            if !(value > 0.0 && value < f64::INFINITY) {
                return Err(ParticleError::Class { quantity, value });
            }
        }
        let mass = 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3) * density;
        Ok(Self { radius, density, material, mass, inertia: 0.4 * mass * radius * radius })
    }

    /// Radius, m.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Density, kg/m³.
    #[must_use]
    pub fn density(&self) -> f64 {
        self.density
    }

    /// The caller's index of the material.
    #[must_use]
    pub fn material(&self) -> u8 {
        self.material
    }

    /// Mass 4/3 π r³ ρ, kg.
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Moment of inertia 2/5 m r², kg m².
    #[must_use]
    pub fn inertia(&self) -> f64 {
        self.inertia
    }
}

/// Position and radius, the column that every neighbour reads.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(32))]
pub(crate) struct Place {
    pub(crate) x: DVec3,
    pub(crate) r: f64,
}

impl Place {
    #[inline(always)]
    pub(crate) fn row(&self) -> [f64; 4] {
        [self.x.x, self.x.y, self.x.z, self.r]
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, [x, y, z, r]: [f64; 4]) {
        *self = Self { x: DVec3 { x, y, z }, r };
    }
}

/// Velocity and spin, half a step behind the positions.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))] // one cache line
pub(crate) struct Velocity {
    pub(crate) v: Row,
    pub(crate) w: Row,
}

impl Velocity {
    pub(crate) fn new(v: DVec3, w: DVec3) -> Self {
        Self { v: Row::new(v), w: Row::new(w) }
    }
}

/// A vector and a zero behind it, which make one register or half of one.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(32))]
pub(crate) struct Row(pub(crate) [f64; 4]);

impl Row {
    #[inline(always)]
    pub(crate) fn new(v: DVec3) -> Self {
        Self([v.x, v.y, v.z, 0.0])
    }

    #[inline(always)]
    pub(crate) fn vector(&self) -> DVec3 {
        let [x, y, z, _] = self.0;
        DVec3 { x, y, z }
    }

    #[inline(always)]
    pub(crate) fn add(&mut self, other: [f64; 4]) {
        let [a, b, c, d] = &mut self.0;
        (*a, *b, *c, *d) = (*a + other[0], *b + other[1], *c + other[2], *d + other[3]);
    }

    #[inline(always)]
    pub(crate) fn take(&mut self, other: [f64; 4]) {
        let [a, b, c, d] = &mut self.0;
        (*a, *b, *c, *d) = (*a - other[0], *b - other[1], *c - other[2], *d - other[3]);
    }
}

/// One particle, as seen from outside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Particle {
    /// Its number, kept for life; numbers start at 0 in the order of insertion.
    pub id: u32,
    /// Index of its class.
    pub class: u16,
    /// Centre, m.
    pub position: DVec3,
    /// Velocity, m/s, half a time step earlier than the position (leapfrog).
    pub velocity: DVec3,
    /// Spin (angular velocity), rad/s, half a time step earlier than the position.
    pub spin: DVec3,
}

/// The spheres of a scene.
///
/// They are kept in an order of the core's choosing (near ones near in memory); the `id` stays.
#[derive(Debug, Clone)]
pub struct Particles {
    classes: Vec<Class>,
    pub(crate) places: Vec<Place>,
    pub(crate) velocities: Vec<Velocity>,
    pub(crate) class: Vec<u16>,
    pub(crate) id: Vec<u32>,
    pub(crate) created: u32,
}

impl Particles {
    /// No particles yet, of the given classes.
    ///
    /// # Errors
    /// [`ParticleError::TooMany`] above 65,536 classes.
    pub fn new(classes: Vec<Class>) -> Result<Self, ParticleError> {
        let allowed = usize::from(u16::MAX) + 1;
        if classes.len() > allowed {
            return Err(ParticleError::TooMany { what: "classes", allowed });
        }
        let (places, velocities) = (Vec::new(), Vec::new());
        Ok(Self { classes, places, velocities, class: Vec::new(), id: Vec::new(), created: 0 })
    }

    /// Adds a sphere and returns its id: `position` m, `velocity` m/s, `spin` rad/s.
    ///
    /// # Errors
    /// [`ParticleError`] if the class does not exist or a value is not finite.
    pub fn push(
        &mut self,
        class: u16,
        position: DVec3,
        velocity: DVec3,
        spin: DVec3,
    ) -> Result<u32, ParticleError> {
        let id = self.created;
        let classes = self.classes.len();
        let kind = self.classes.get(usize::from(class));
        let r = kind.ok_or(ParticleError::UnknownClass { class, classes })?.radius;
        for (quantity, value) in [("position", position), ("velocity", velocity), ("spin", spin)] {
            if !value.is_finite() {
                return Err(ParticleError::NotFinite { quantity, id });
            }
        }
        let distance = position.abs().max_element();
        if distance > FARTHEST {
            return Err(ParticleError::Far { id, distance });
        }
        if id == u32::MAX {
            return Err(ParticleError::TooMany { what: "particles", allowed: u32::MAX as usize });
        }
        self.created += 1;
        self.places.push(Place { x: position, r });
        self.velocities.push(Velocity::new(velocity, spin));
        self.class.push(class);
        self.id.push(id);
        Ok(id)
    }

    /// How many particles are in the scene.
    #[must_use]
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Whether no particle is in the scene.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// How many particles have ever been added; every id is below it.
    #[must_use]
    pub fn created(&self) -> u32 {
        self.created
    }

    /// The classes.
    #[must_use]
    pub fn classes(&self) -> &[Class] {
        &self.classes
    }

    /// All particles in the scene, in the core's own order.
    pub fn iter(&self) -> impl Iterator<Item = Particle> + '_ {
        (0..self.len()).map(|slot| self.particle(slot))
    }

    /// The particle with number `id`, if it is in the scene. Looks through all of them.
    #[must_use]
    pub fn get(&self, id: u32) -> Option<Particle> {
        self.id.iter().position(|&i| i == id).map(|slot| self.particle(slot))
    }

    /// Translational and rotational kinetic energy, J, of the half-step velocities.
    #[must_use]
    pub fn kinetic_energy(&self) -> f64 {
        let one = |p: Particle| {
            let class = &self.classes[usize::from(p.class)];
            let (v2, w2) = (p.velocity.length_squared(), p.spin.length_squared());
            0.5 * (class.mass * v2 + class.inertia * w2)
        };
        self.iter().map(one).sum()
    }

    pub(crate) fn particle(&self, slot: usize) -> Particle {
        let Velocity { v, w } = self.velocities[slot];
        let position = self.places[slot].x;
        let (velocity, spin) = (v.vector(), w.vector());
        Particle { id: self.id[slot], class: self.class[slot], position, velocity, spin }
    }

    /// Puts the particles into the order `slots` (old slot of each new one), dropping the others.
    pub(crate) fn arrange(&mut self, slots: &[u32]) {
        fn take<V: Copy>(column: &mut Vec<V>, slots: &[u32]) {
            *column = slots.iter().map(|&s| column[s as usize]).collect();
        }
        take(&mut self.places, slots);
        take(&mut self.velocities, slots);
        take(&mut self.class, slots);
        take(&mut self.id, slots);
    }
}
