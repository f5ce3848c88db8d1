//! Stops a run whose state cannot be: cheap looks at every batch of steps, none per pair.

use glam::DVec3;
use pendular::dem::{Boundary, Partner, Simulation, SimulationError};
use pendular::pair::OutOfRange;
use pendular::{MeshWalls, WetError};

use crate::build::apparatus::{collection, group};
use crate::makeup::Makeup;
use crate::scene::{Escapes, Scene};
use crate::screening::{Passage, Screening, displacement};

/// A sphere may be this many times faster than a free fall through the whole apparatus and the
/// fastest wall can make it: light spheres are flung by heavy ones.
const SPARE: f64 = 3.0;
/// No scene is so calm that less than this is a sign of trouble, m/s.
const CALM: f64 = 1.0;
/// A sphere this much wider than the aperture cannot pass it.
const WIDER: f64 = 1.05;

/// What a run's state is held against.
#[derive(Debug, Clone)]
pub(crate) struct Guard {
    overlap_share: f64,
    speed: f64,
    escapes: Escapes,
    /// Inner radius of the frame, m, where the frame is the built-in one.
    frame: Option<f64>,
    /// Side of the apertures, m, where the wires are the built-in ones.
    aperture: Option<f64>,
    names: Vec<String>,
    class: Vec<u16>,
    /// Names of the parts.
    parts: Vec<String>,
    /// Capillary and rupture law between spheres, and with walls.
    laws: [String; 2],
}

/// What is wrong with a state: what and who, and what to do.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Fault {
    pub(crate) time: f64,
    pub(crate) what: String,
    pub(crate) advice: &'static str,
}

const STEP: &str = "a shorter time step or a higher contact.stiffness is the usual cure; where the \
                    state is meant, raise the key";
const OUTSIDE: &str = "a bridge outside a law's range goes on with liquid.outside_range = \
                       \"extrapolate\"";
const HOLE: &str = "close the gap in the walls or raise screen.height_mm, or take a shorter time \
                    step; guard.escapes = \"count\" goes on";

impl Guard {
    /// The guard of a scene. `class` is that of each particle, by id.
    pub(crate) fn new(scene: &Scene, walls: &MeshWalls, class: &[u16]) -> Self {
        let (low, _) = collection(scene);
        let height = 1e-3 * (scene.screen.height_mm + 50.0) - low;
        let fall = (2.0 * DVec3::from_array(scene.gravity).length() * height).sqrt();
        let explained = (SPARE * (fall + 2.0 * walls.speed_bound())).max(CALM);
        let built_in = |name: &str| scene.parts.iter().all(|part| part.name != name);
        Self {
            overlap_share: scene.guard.overlap_share,
            speed: scene.guard.speed.unwrap_or(explained),
            escapes: scene.guard.escapes,
            frame: built_in("frame").then_some(0.5e-3 * scene.screen.diameter_mm),
            aperture: built_in("wires").then_some(1e-3 * scene.screen.aperture_mm),
            names: scene.classes.iter().map(|class| class.name.clone()).collect(),
            class: class.to_vec(),
            parts: walls.0.parts().iter().map(|part| part.name.clone()).collect(),
            laws: laws(scene),
        }
    }

    /// Largest speed that passes, m/s.
    pub(crate) fn speed(&self) -> f64 {
        self.speed
    }

    fn who(&self, id: u32) -> String {
        if id == u32::MAX {
            // A sum over all of them has told.
            return "a particle".into();
        }
        let class = self.class.get(id as usize).and_then(|&k| self.names.get(usize::from(k)));
        format!("particle {id} ({})", class.map_or("of no class", String::as_str))
    }

    /// A body in words.
    pub(crate) fn body(&self, body: Partner) -> String {
        match body {
            Partner::Particle(id) => self.who(id),
            Partner::Wall(part) => {
                self.parts.get(part as usize).map_or("a wall", |name| group(name)).to_owned()
            }
        }
    }

    /// An error of the simulation, as a fault.
    pub(crate) fn broken(&self, error: &SimulationError, now: f64) -> Fault {
        match error {
            SimulationError::NotFinite { id, time } => Fault {
                time: *time,
                what: format!("position or velocity of {} is not finite", self.who(*id)),
                advice: STEP,
            },
            SimulationError::Term { time, source } => {
                let wet = source.downcast_ref();
                let what = wet.map_or_else(|| source.to_string(), |wet| self.refused(wet));
                Fault { time: *time, what, advice: OUTSIDE }
            }
            other => Fault { time: now, what: other.to_string(), advice: OUTSIDE },
        }
    }

    /// A bridge that a law has refused.
    fn refused(&self, error: &WetError) -> String {
        let (first, second, volume) = match error {
            WetError::Law { first, second, volume, .. }
            | WetError::Transfer { first, second, volume, .. } => (*first, *second, *volume),
            other => return other.to_string(),
        };
        let bridge = format!(
            "a bridge of {:.3e} mm3 between {} and {}",
            1e9 * volume,
            self.who(first),
            self.body(second)
        );
        match error {
            WetError::Law { source, .. } => {
                let laws = &self.laws[usize::from(matches!(second, Partner::Wall(_)))];
                format!("{bridge} lies outside the range of its laws, {laws}: {}", degrees(source))
            }
            WetError::Transfer { source, .. } => format!("{bridge}: {source}; key liquid.transfer"),
            _ => bridge,
        }
    }

    /// Looks at all particles.
    pub(crate) fn look<T: Makeup>(
        &self,
        simulation: &Simulation<T, MeshWalls>,
        screening: &Screening,
    ) -> Result<(), Fault> {
        let fault = |what, advice| Fault { time: simulation.time(), what, advice };
        let overlap = simulation.largest_overlap();
        if overlap > self.overlap_share {
            return Err(fault(self.overlapping(simulation, overlap), STEP));
        }
        let shift = displacement(simulation);
        let walls = self.frame.filter(|_| self.escapes == Escapes::Stop);
        for one in simulation.particles().iter() {
            let speed = one.velocity.length();
            if speed > self.speed {
                let (who, x) = (self.who(one.id), place(one.position));
                let what = format!(
                    "{who} at {x} moves at {speed:.3} m/s; allowed: up to {:.3} m/s, key \
                     guard.speed",
                    self.speed
                );
                return Err(fault(what, STEP));
            }
            let off = (one.position - shift).truncate().length();
            if walls.is_some_and(|radius| off > radius) && !screening.is_through(one.id) {
                let (who, x) = (self.who(one.id), place(one.position));
                return Err(fault(format!("{who} has left through the frame at {x}"), HOLE));
            }
        }
        Ok(())
    }

    fn overlapping<T: Makeup>(
        &self,
        simulation: &Simulation<T, MeshWalls>,
        overlap: f64,
    ) -> String {
        let most = format!(
            "an overlap has reached {:.1} % of a radius; allowed: up to {:.1} %, key \
             guard.overlap_share",
            100.0 * overlap,
            100.0 * self.overlap_share
        );
        let Some((now, pair)) = simulation.deepest() else { return most };
        let second = self.body(pair.second);
        let at = simulation.particles().iter().find(|one| one.id == pair.first);
        let at = at.map_or(String::new(), |one| format!(" at {}", place(one.position)));
        let now = 100.0 * now;
        format!("{most}; deepest now: {}{at} and {second}, {now:.1} %", self.who(pair.first))
    }

    /// Looks at those who have just passed the screen: none may be too wide for it.
    pub(crate) fn passed(&self, passages: &[Passage], radii: &[f64]) -> Result<(), Fault> {
        let Some(aperture) = self.aperture.filter(|_| self.escapes == Escapes::Stop) else {
            return Ok(());
        };
        let wide = |one: &&Passage| 2.0 * radii[usize::from(one.particle.class)] > WIDER * aperture;
        passages.iter().find(wide).map_or(Ok(()), |one| {
            let (who, x) = (self.who(one.particle.id), place(one.particle.position));
            let what = format!("{who} has left through the wires at {x}, wider than an aperture");
            Err(Fault { time: one.time, what, advice: HOLE })
        })
    }

    /// A particle that has left in another way than into the collecting bin.
    pub(crate) fn escaped(&self, id: u32, position: DVec3, time: f64) -> Result<(), Fault> {
        match self.escapes {
            Escapes::Count => Ok(()),
            Escapes::Stop => {
                let what =
                    format!("{} has left the apparatus at {}", self.who(id), place(position));
                Err(Fault { time, what, advice: HOLE })
            }
        }
    }
}

fn laws(scene: &Scene) -> [String; 2] {
    let Some(liquid) = &scene.liquid else { return Default::default() };
    [
        format!("capillary {}, rupture {}", liquid.capillary, liquid.rupture),
        format!("capillary_wall {}, rupture_wall {}", liquid.capillary_wall, liquid.rupture_wall),
    ]
}

/// What is out of range, its angles in degrees as in scenes.
fn degrees(wrong: &OutOfRange) -> String {
    if !wrong.quantity.contains("angle") {
        return wrong.to_string();
    }
    let [value, low, high] = [wrong.value, wrong.allowed.0, wrong.allowed.1].map(f64::to_degrees);
    format!("{} = {value:.1} degrees; allowed: {low:.1} to {high:.1} degrees", wrong.quantity)
}

fn place(x: DVec3) -> String {
    format!("({:.4}, {:.4}, {:.4}) m", x.x, x.y, x.z)
}
