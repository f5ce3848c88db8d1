//! What all scenes are made of: spheres, one contact law, one liquid, walls.

use std::f64::consts::PI;

use pendular::capillary::AnyCapillary;
use pendular::contact::{Linear, NormalContact};
use pendular::dem::{
    Class, Contact, DVec3, Encounter, Implicit, Impulse, Limit, Load, Pair, PairContact, PairTerm,
    Particle, Particles, Settings, Simulation, SimulationError, Snapshot, Spring, StabilityLoad,
};
use pendular::lubrication::{
    AnyNormalDrag, AnyTangentialDrag, NormalModel, Regularisation, TangentialModel,
};
use pendular::pair::Range;
use pendular::transfer::{AnyRupture, Dynamic};
use pendular::walls::{Part, Shape, Walls};
use pendular::{
    Bodies, Hold, Liquid, MeshWalls, PairLaws, SplitMethod, WallElement, Wet, WetState,
};

/// Whatever stops the program.
pub(crate) type Fault = Box<dyn std::error::Error + Send + Sync>;
/// The liquid with laws chosen by name.
pub(crate) type Water = Wet<AnyCapillary, AnyNormalDrag, AnyTangentialDrag>;
/// Contact, liquid if there is any, pressing force if there is any.
pub(crate) type Term = (Contact<Linear>, (Option<Water>, Option<Press>));

/// How drag and dashpots are integrated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Drag {
    /// With the velocity of half a step before.
    Explicit,
    /// Solved for at the end of the step.
    Implicit,
}

impl Drag {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Explicit => "explicit",
            Self::Implicit => "implicit",
        }
    }
}

/// A scene that runs.
pub(crate) enum Scene {
    Explicit(Box<Simulation<Term, MeshWalls>>),
    Implicit(Box<Simulation<Implicit<Term>, MeshWalls>>),
}

macro_rules! either {
    ($scene:expr, $simulation:ident => $does:expr) => {
        match $scene {
            Scene::Explicit($simulation) => $does,
            Scene::Implicit($simulation) => $does,
        }
    };
}

impl Scene {
    pub(crate) fn advance(&mut self, steps: u64) -> Result<(), SimulationError> {
        either!(self, simulation => simulation.advance(steps))
    }

    pub(crate) fn particles(&self) -> &Particles {
        either!(self, simulation => simulation.particles())
    }

    pub(crate) fn gravity(&self) -> DVec3 {
        either!(self, simulation => simulation.settings().gravity)
    }

    pub(crate) fn step(&self) -> u64 {
        either!(self, simulation => simulation.step())
    }

    pub(crate) fn limit(&self) -> Limit {
        either!(self, simulation => simulation.limit())
    }

    pub(crate) fn limit_now(&self) -> Limit {
        either!(self, simulation => simulation.limit_now())
    }

    fn term(&self) -> &Term {
        match self {
            Self::Explicit(simulation) => simulation.term(),
            Self::Implicit(simulation) => simulation.term().inner(),
        }
    }

    pub(crate) fn water(&self) -> Option<&Water> {
        self.term().1.0.as_ref()
    }

    /// All that acts at this moment, with spring and bridge.
    fn survey(&self, mut see: impl FnMut(&Pair, &Spring<()>, &Hold)) {
        match self {
            Self::Explicit(simulation) => {
                simulation.survey(|pair, (spring, (hold, ()))| see(pair, spring, hold));
            }
            Self::Implicit(simulation) => {
                simulation.survey(|pair, ((spring, (hold, ())), _)| see(pair, spring, hold));
            }
        }
    }
}

/// Density of all spheres, kg/m³.
pub(crate) const DENSITY: f64 = 2500.0;
/// Tangential over normal stiffness.
pub(crate) const RATIO: f64 = 2.0 / 7.0;
const FRICTION: f64 = 0.3;
/// Sides of the box that a scene with a bottom has, m.
const FAR: f64 = 10.0;

/// A constant force that presses every pair together, N.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Press(pub(crate) f64);

impl PairTerm for Press {
    type Column = ();
    const SETTLES: bool = false;

    fn reach(&self) -> f64 {
        1e-3
    }

    fn idle(&self, _: &Encounter, (): &mut ()) -> bool {
        false
    }

    fn load(&self, _: &Pair, (): &mut ()) -> Load {
        Load { tension: self.0, ..Load::default() }
    }

    fn live(&self, (): &()) -> bool {
        false
    }

    fn stability(&self, classes: &[Class]) -> Vec<StabilityLoad> {
        vec![StabilityLoad::default(); classes.len()]
    }
}

/// What spheres and liquid are made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Matter {
    /// Normal stiffness k_n, N/m.
    pub(crate) stiffness: f64,
    /// Dry restitution.
    pub(crate) restitution: f64,
    /// The liquid, if there is any.
    pub(crate) liquid: Option<Film>,
    /// How drag and dashpots are integrated.
    pub(crate) drag: Drag,
}

/// A liquid on spheres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Film {
    /// Viscosity η, Pa s.
    pub(crate) viscosity: f64,
    /// Capillary law.
    pub(crate) law: AnyCapillary,
    /// Liquid on a sphere over the sphere's volume.
    pub(crate) share: f64,
}

impl Film {
    /// Bridges of V* near 1e-3 between equal spheres, Lambert's law.
    pub(crate) fn thin(viscosity: f64) -> Self {
        Self { viscosity, law: AnyCapillary::Lambert, share: 2.5e-3 }
    }
}

/// A sphere at the start: class, place, velocity, spin.
pub(crate) type Sphere = (u16, DVec3, DVec3, DVec3);

/// A scene before it runs.
#[derive(Debug, Clone, Default)]
pub(crate) struct Start {
    /// Radii of the classes, m.
    pub(crate) radii: Vec<f64>,
    /// The spheres.
    pub(crate) spheres: Vec<Sphere>,
    /// Walls, at rest or not.
    pub(crate) walls: Vec<Part>,
    /// Gravity along −z, m/s².
    pub(crate) gravity: f64,
    /// Force that presses pairs together, N.
    pub(crate) press: Option<f64>,
    /// Height below which a sphere leaves the scene, m.
    pub(crate) bottom: Option<f64>,
}

impl Start {
    /// The scene with a time step, which may be above the limit.
    pub(crate) fn scene(&self, matter: &Matter, time_step: f64) -> Result<Scene, Fault> {
        let (particles, walls, term) = self.parts(matter)?;
        let settings = self.settings(time_step);
        Ok(match matter.drag {
            Drag::Explicit => {
                Scene::Explicit(Box::new(Simulation::new(particles, term, walls, settings)?))
            }
            Drag::Implicit => {
                let term = Implicit::new(term);
                Scene::Implicit(Box::new(Simulation::new(particles, term, walls, settings)?))
            }
        })
    }

    fn settings(&self, time_step: f64) -> Settings {
        Settings {
            gravity: DVec3::NEG_Z * self.gravity,
            domain: self.bottom.map(|z| (DVec3::new(-FAR, -FAR, z), DVec3::splat(FAR))),
            allow_unstable: true,
            ..Settings::new(time_step)
        }
    }

    fn parts(&self, matter: &Matter) -> Result<(Particles, MeshWalls, Term), Fault> {
        let classes: Result<Vec<_>, _> =
            self.radii.iter().map(|radius| Class::new(*radius, DENSITY, 0)).collect();
        let mut particles = Particles::new(classes?)?;
        for (class, x, v, w) in &self.spheres {
            particles.push(*class, *x, *v, *w)?;
        }
        let walls = Walls::new(self.walls.clone())?;
        let contact = contact(particles.classes(), matter)?;
        let water = matter.liquid.map(|film| water(&particles, &walls, &film)).transpose()?;
        let term = (contact, (water, self.press.map(Press)));
        Ok((particles, MeshWalls(walls), term))
    }
}

/// A scene brought to a stop, with its bridges and tangential springs: to go on at any time step.
#[derive(Debug, Clone)]
pub(crate) struct Rest {
    pub(crate) start: Start,
    snapshot: Snapshot<(Spring<()>, Option<u32>)>,
    water: Option<WetState>,
}

impl Rest {
    /// Runs a scene with explicit drag for `steps` and stops everything.
    pub(crate) fn after(
        start: &Start,
        matter: &Matter,
        time_step: f64,
        steps: u64,
    ) -> Result<Self, Fault> {
        let (particles, walls, term) = start.parts(matter)?;
        let mut simulation = Simulation::new(particles, term, walls, start.settings(time_step))?;
        simulation.advance(steps)?;
        let plain = |(spring, (hold, ())): (Spring<()>, (Hold, ()))| (spring, hold.bridge());
        let mut snapshot = simulation.snapshot().map(plain);
        snapshot.step = 0;
        for particle in &mut snapshot.particles {
            (particle.velocity, particle.spin) = (DVec3::ZERO, DVec3::ZERO);
        }
        let water = simulation.term().1.0.as_ref().map(Water::state);
        Ok(Self { start: start.clone(), snapshot, water })
    }

    /// The scene at another time step, with other dashpots and viscosity if need be; `push` may
    /// disturb its particles.
    pub(crate) fn scene(
        &self,
        matter: &Matter,
        time_step: f64,
        mut push: impl FnMut(&mut Particle),
    ) -> Result<Scene, Fault> {
        let (particles, walls, mut term) = self.start.parts(matter)?;
        if let (Some(water), Some(state)) = (&mut term.1.0, &self.water) {
            water.resume(state.clone())?;
        }
        let mut missing = None;
        let water = term.1.0.as_ref();
        let seated = |(spring, bridge): (Spring<()>, Option<u32>)| {
            let hold = water.map_or(Ok(Hold::default()), |water| water.column(bridge));
            (
                spring,
                (
                    hold.unwrap_or_else(|error| {
                        missing = Some(error);
                        Hold::default()
                    }),
                    (),
                ),
            )
        };
        let mut snapshot = self.snapshot.clone().map(seated);
        if let Some(error) = missing {
            return Err(error.into());
        }
        snapshot.particles.iter_mut().for_each(&mut push);
        let settings = self.start.settings(time_step);
        Ok(match matter.drag {
            Drag::Explicit => Scene::Explicit(Box::new(Simulation::restore(
                particles, term, walls, settings, snapshot,
            )?)),
            Drag::Implicit => {
                let snapshot = snapshot.map(|column| (column, Impulse::NONE));
                let term = Implicit::new(term);
                Scene::Implicit(Box::new(Simulation::restore(
                    particles, term, walls, settings, snapshot,
                )?))
            }
        })
    }
}

fn contact(classes: &[Class], matter: &Matter) -> Result<Contact<Linear>, Fault> {
    let law = |mass: f64| -> Result<PairContact<Linear>, Fault> {
        let normal = Linear::from_restitution(matter.stiffness, matter.restitution, mass)?
            .with_tangential_ratio(RATIO)?;
        let (friction, rolling_friction, tangential_damping) = (FRICTION, 0.0, 0.0);
        Ok(PairContact { normal, friction, rolling_friction, tangential_damping })
    };
    let reduced = |a: &Class, b: &Class| a.mass() * b.mass() / (a.mass() + b.mass());
    let row = |a: &Class| classes.iter().map(|b| law(reduced(a, b))).collect::<Result<Vec<_>, _>>();
    let table = classes.iter().map(row).collect::<Result<Vec<_>, _>>()?;
    let walls = classes.iter().map(|a| law(a.mass())).collect::<Result<Vec<_>, _>>()?;
    let own = classes.to_vec();
    let find = move |class: &Class| own.iter().position(|c| c == class).unwrap_or(0);
    let at_wall = find.clone();
    let between = move |a: &Class, b: &Class| table[find(a)][find(b)];
    Ok(Contact::new(classes, 1, between, move |a, _| walls[at_wall(a)]))
}

fn water(particles: &Particles, walls: &Walls, film: &Film) -> Result<Water, Fault> {
    let near = Regularisation::default();
    let laws = PairLaws {
        capillary: film.law,
        normal: NormalModel::Pitois2000.with(near),
        tangential: TangentialModel::Popov2010.with(near),
        rupture: AnyRupture::Lian,
        dynamic: Dynamic::None,
    };
    let angles = vec![0.5];
    let (surface_tension, density) = (0.07, 1000.0);
    let (particle_angles, wall_angles) = (angles.clone(), angles);
    let viscosity = film.viscosity;
    let liquid = Liquid { surface_tension, viscosity, density, particle_angles, wall_angles };
    let volume = |class: u16| {
        film.share * 4.0 / 3.0 * PI * particles.classes()[usize::from(class)].radius().powi(3)
    };
    let mut films = vec![0.0; particles.len()];
    particles.iter().for_each(|p| films[p.id as usize] = volume(p.class));
    let bodies = bodies(particles, walls);
    let (split, range) = (SplitMethod::Half, Range::Extrapolate);
    Ok(Wet::new(liquid, laws, laws, split, range, bodies, films)?)
}

fn bodies(particles: &Particles, walls: &Walls) -> Bodies {
    let classes = particles.classes();
    let mut class = vec![0; particles.len()];
    particles.iter().for_each(|p| class[p.id as usize] = p.class);
    let parts = walls.parts();
    let element = |shape: &Shape, k| WallElement { area: shape.element_area(k).unwrap_or(1.0) };
    Bodies {
        class,
        radii: classes.iter().map(Class::radius).collect(),
        materials: vec![0; classes.len()],
        half_sides: parts.iter().map(|part| part.half_side).collect(),
        wall_materials: vec![0; parts.len()],
        first_elements: (0..parts.len() as u32).map(|k| walls.first_element(k)).collect(),
        elements: parts
            .iter()
            .flat_map(|p| (0..p.shape.element_count()).map(|k| element(&p.shape, k)))
            .collect(),
    }
}

/// Mass of a sphere, kg.
pub(crate) fn mass(radius: f64) -> f64 {
    4.0 / 3.0 * PI * radius.powi(3) * DENSITY
}

/// Elastic and capillary energy, J, of all that acts at this moment.
pub(crate) fn stored(scene: &Scene) -> f64 {
    let mut sum = 0.0;
    let (contact, (water, _)) = scene.term();
    scene.survey(|pair, spring, hold| {
        let overlap = (-pair.encounter.gap).max(0.0);
        let law = contact.load_on_limit(pair, spring);
        let stretch = spring.stretch().length_squared();
        sum += 0.5 * law.normal_stiffness * overlap * overlap
            + 0.5 * law.tangential_stiffness * stretch;
        if let Some((bridge, water)) = hold.bridge().zip(water.as_ref()) {
            sum += water.energy_of(bridge, pair.encounter.gap).unwrap_or(0.0);
        }
    });
    sum
}

/// Dashpot of a contact, N s/m.
pub(crate) fn dashpot(matter: &Matter, reduced_mass: f64) -> Result<f64, Fault> {
    let law = Linear::from_restitution(matter.stiffness, matter.restitution, reduced_mass)?;
    Ok(law.damping(0.0))
}
