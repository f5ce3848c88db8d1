//! A column of wet spheres of two sizes in a square pipe, settled under its weight.

use pendular::dem::DVec3;
use pendular::walls::{Part, Plane, Shape};
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

use crate::case::Outcome;
use crate::edge::{self, Edge};
use crate::rig::{Drag, Fault, Film, Matter, Rest, Scene, Sphere, Start, mass, stored};

const GRAVITY: f64 = 9.81;
/// Speed of the disturbance, m/s.
const NOISE: f64 = 1e-4;
/// Steps over which it is watched.
const WATCH: u64 = 1200;
/// Seconds that dry spheres fall and come to rest in.
const SETTLE: f64 = 0.16;
/// Seconds that the wet bed has to find its new rest in, at most so many limits.
const RELAX: f64 = 0.01;
const RELAX_LIMITS: f64 = 3000.0;

/// A column of dry spheres at rest.
#[derive(Debug, Clone)]
pub(crate) struct Column(Start);

impl Column {
    /// `layers` of `side` × `side` spheres with the given radii in turn, m, settled in a pipe.
    pub(crate) fn settled(side: u32, layers: u32, radii: [f64; 2]) -> Result<Self, Fault> {
        let pitch = 2.15 * radii[0].max(radii[1]);
        let mut random = Pcg64::seed_from_u64(6);
        let mut any = || (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64 - 0.5;
        let mut spheres = Vec::new();
        for k in 0..side * side * layers {
            let cell = DVec3::new(
                f64::from(k % side) + 0.5,
                f64::from(k / side % side) + 0.5,
                f64::from(k / side / side) + 0.5,
            );
            let jitter = 0.1 * radii[0].min(radii[1]) * DVec3::new(any(), any(), any());
            let class = u16::from(k % 2 == 1 || radii[0] == radii[1] && k % 3 == 0);
            spheres.push((class, cell * pitch + jitter, DVec3::ZERO, DVec3::ZERO));
        }
        let wide = f64::from(side) * pitch;
        let wall = |name: &str, point: DVec3, normal: DVec3| -> Result<Part, Fault> {
            let area = wide * wide * f64::from(layers);
            Ok(Part::new(name, Shape::Plane(Plane::new(point, normal, area)?)))
        };
        let far = DVec3::new(wide, wide, 0.0);
        let walls = vec![
            wall("floor", DVec3::ZERO, DVec3::Z)?,
            wall("west", DVec3::ZERO, DVec3::X)?,
            wall("south", DVec3::ZERO, DVec3::Y)?,
            wall("east", far, -DVec3::X)?,
            wall("north", far, -DVec3::Y)?,
        ];
        let start =
            Start { radii: radii.to_vec(), spheres, walls, gravity: GRAVITY, ..Start::default() };
        let falling =
            Matter { stiffness: 1e4, restitution: 0.3, liquid: None, drag: Drag::Explicit };
        let h = 0.5 * start.scene(&falling, 1e-9)?.limit().time_step;
        let mut scene = start.scene(&falling, h)?;
        scene.advance((SETTLE / h) as u64)?;
        Ok(Self(Start { spheres: at_rest(&scene), ..start }))
    }

    /// The same column of other matter, come to rest again: at each spring's own overlap.
    pub(crate) fn relaxed(&self, matter: &Matter) -> Result<Bed, Fault> {
        // A thin liquid and a strong dashpot come to rest soonest, and rest does not know them.
        let thin = matter.liquid.map(|film| Film { viscosity: film.viscosity.min(0.1), ..film });
        let soon = Matter { restitution: 0.2, liquid: thin, ..*matter };
        let h = 0.5 * self.0.scene(&soon, 1e-9)?.limit().time_step;
        let steps = (RELAX / h).min(RELAX_LIMITS) as u64;
        Ok(Bed(Rest::after(&self.0, &soon, h, steps)?))
    }
}

/// A column of some matter at rest.
#[derive(Debug, Clone)]
pub(crate) struct Bed(Rest);

impl Bed {
    fn radius(&self, class: u16) -> f64 {
        self.0.start.radii[usize::from(class)]
    }

    /// Every sphere pushed and turned a little.
    fn disturbed(&self, matter: &Matter, h: f64) -> Result<Scene, Fault> {
        let mut random = Pcg64::seed_from_u64(17);
        let mut any = || (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0;
        self.0.scene(matter, h, |particle| {
            particle.velocity = NOISE * DVec3::new(any(), any(), any());
            let turn = NOISE / self.radius(particle.class);
            particle.spin = turn * DVec3::new(any(), any(), any());
        })
    }

    /// Weight times radius of all spheres, J.
    fn scale(&self) -> f64 {
        let one = |sphere: &Sphere| {
            let radius = self.radius(sphere.0);
            mass(radius) * GRAVITY * radius
        };
        self.0.start.spheres.iter().map(one).sum()
    }
}

fn at_rest(scene: &Scene) -> Vec<Sphere> {
    let mut all: Vec<_> = scene.particles().iter().collect();
    all.sort_by_key(|p| p.id);
    all.iter().map(|p| (p.class, p.position, DVec3::ZERO, DVec3::ZERO)).collect()
}

/// The edge of the column at rest, every sphere pushed and turned a little.
pub(crate) fn edge(bed: &Bed, matter: &Matter) -> Result<Edge, Fault> {
    edge::find(|h| bed.0.scene(matter, h, |_| ()), |h| bed.disturbed(matter, h), WATCH)
}

/// Error: the largest rise of the total energy over its lowest so far, over weight times radius of
/// all spheres. State: rise of the centre of mass over the first radius.
pub(crate) fn run(bed: &Bed, matter: &Matter, h: f64, limit: f64) -> Result<Outcome, Fault> {
    let bad = Outcome { error: f64::INFINITY, state: f64::INFINITY };
    let mut scene = bed.disturbed(matter, h)?;
    if scene.advance(1).is_err() {
        return Ok(bad);
    }
    let height = |scene: &Scene| -> f64 {
        let of = |class: u16| mass(bed.radius(class));
        scene.particles().iter().map(|p| of(p.class) * p.position.z).sum()
    };
    let whole: f64 = scene.particles().iter().map(|p| mass(bed.radius(p.class))).sum();
    let first = height(&scene);
    let energy = |scene: &Scene| {
        scene.particles().kinetic_energy() + stored(scene) + GRAVITY * height(scene)
    };
    let (mut lowest, mut most) = (f64::INFINITY, 0.0_f64);
    let looks = 40;
    let stride = ((0.5 * WATCH as f64 * limit / h / f64::from(looks)).ceil() as u64).max(1);
    for _ in 0..looks {
        let now = energy(&scene);
        lowest = lowest.min(now);
        most = most.max(now - lowest);
        if scene.advance(stride).is_err() {
            return Ok(bad);
        }
    }
    let error = most / bed.scale();
    Ok(Outcome { error, state: (height(&scene) - first) / whole / bed.radius(0) })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Dry, wet and of two sizes: what the library predicts lies inside the stable region and
    /// within a factor of 2 of its edge.
    #[test]
    fn predicted_limits_of_small_packings_hold() {
        let mut wrong = String::new();
        for radii in [[1e-3, 1.05e-3], [1.6e-3, 0.4e-3]] {
            let column = Column::settled(4, 4, radii).unwrap();
            for (restitution, viscosity) in
                [(0.9, None), (0.3, None), (0.8, Some(1e-3)), (0.8, Some(1.0)), (0.5, Some(10.0))]
            {
                let liquid = viscosity.map(Film::thin);
                let drag = Drag::Explicit;
                let matter = Matter { stiffness: 1e4, restitution, liquid, drag };
                let bed = column.relaxed(&matter).unwrap();
                let found = edge(&bed, &matter).unwrap();
                let ratio = found.edge / found.limit;
                println!("{radii:?} e {restitution} eta {viscosity:?}: {ratio:.3} {found:?}");
                if !found.holds() {
                    wrong += &format!("{radii:?} {matter:?}: edge/limit {ratio:.3}, {found:?}\n");
                }
            }
        }
        assert!(wrong.is_empty(), "{wrong}");
    }
}
