//! The scenes: POM spheres of 3, 5 and 7 mm settled in a box or over a screen, with one linear
//! contact for all pairs, shaken at 50.6 Hz; wet with 5 % of water.

use std::error::Error;
use std::f64::consts::FRAC_PI_2;
use std::path::Path;

use pendular::capillary::Lambert2008;
use pendular::contact::{ContactError, Dashpot, Linear, dashpot};
use pendular::dem::{Class, Contact, DVec3, PairContact, Particles, Settings};
use pendular::lubrication::{Pitois2000, Popov2010, Regularisation};
use pendular::pair::Range;
use pendular::transfer::{AnyRupture, Dynamic, film};
use pendular::walls::build::{Fit, Prism};
use pendular::walls::{Frame, Harmonic, Motion, Part, Plane, Shape, WallError, Walls, Wire};
use pendular::{Bodies, Liquid, MeshWalls, PairLaws, SplitMethod, WallElement, Wet, WetError};

const STIFFNESS: f64 = 1e5;
const TANGENTIAL_RATIO: f64 = 2.0 / 7.0;
const RESTITUTION: f64 = 0.8;
const FRICTION: f64 = 0.3725;
const TIME_STEP: f64 = 1.5e-6;
const AMPLITUDE: f64 = 1e-3;
const FREQUENCY: f64 = 50.6;
const MOISTURE: f64 = 0.05;
const APERTURE: f64 = 5.6e-3;
const WIRE: f64 = 1.6e-3;
const PIPE: f64 = 0.1;

const COLUMNS: [&str; 6] = ["id", "x", "y", "z", "radius", "density"];

/// Settled spheres.
pub(crate) struct Bed {
    pub(crate) particles: Particles,
    class: Vec<u16>,
    widest: f64,
}

impl Bed {
    /// Reads a bed; every pair of radius and density is a class.
    pub(crate) fn read(path: &Path) -> Result<Self, Box<dyn Error>> {
        let mut reader = csv::Reader::from_path(path)?;
        let header = reader.headers()?;
        if !header.iter().map(str::trim).eq(COLUMNS) {
            let (found, asked) = (header.iter().collect::<Vec<_>>().join(","), COLUMNS.join(","));
            return Err(format!("line 1: the header is `{found}`, it must be `{asked}`").into());
        }
        let mut kinds: Vec<[f64; 2]> = Vec::new();
        let mut rows: Vec<(u16, DVec3)> = Vec::new();
        for record in reader.records() {
            let record = record?;
            let line = record.position().map_or(0, csv::Position::line);
            let number = |k: usize| {
                let text = record.get(k).unwrap_or("").trim();
                let failed = |_| format!("line {line}: {:?} is no {}", text, COLUMNS[k]);
                text.parse::<f64>().map_err(failed)
            };
            let kind = [number(4)?, number(5)?];
            let class = kinds.iter().position(|k| *k == kind).unwrap_or_else(|| {
                kinds.push(kind);
                kinds.len() - 1
            });
            rows.push((class as u16, DVec3::new(number(1)?, number(2)?, number(3)?)));
        }
        if rows.is_empty() {
            return Err("there is no sphere in it".into());
        }
        let classes: Result<Vec<_>, _> =
            kinds.iter().map(|[radius, density]| Class::new(*radius, *density, 0)).collect();
        let mut particles = Particles::new(classes?)?;
        let mut widest = 0.0_f64;
        for (class, x) in &rows {
            particles.push(*class, *x, DVec3::ZERO, DVec3::ZERO)?;
            widest = widest.max(x.x.abs() + kinds[usize::from(*class)][0]);
        }
        Ok(Self { particles, class: rows.iter().map(|row| row.0).collect(), widest })
    }

    /// The bed side by side with copies of itself, in boxes of the given half side.
    pub(crate) fn tiled(self, [nx, ny]: [u32; 2], half: f64) -> Result<Self, Box<dyn Error>> {
        let mut particles = Particles::new(self.particles.classes().to_vec())?;
        let mut class = Vec::new();
        for k in 0..nx * ny {
            let place = |k: u32, n: u32| (2.0 * f64::from(k) - f64::from(n - 1)) * half;
            let shift = DVec3::new(place(k % nx, nx), place(k / nx, ny), 0.0);
            for particle in self.particles.iter() {
                let x = particle.position + shift;
                particles.push(particle.class, x, DVec3::ZERO, DVec3::ZERO)?;
                class.push(particle.class);
            }
        }
        Ok(Self { particles, class, widest: self.widest })
    }

    /// Half side of the box that holds the bed: the spheres' extent, to a tenth of a millimetre.
    pub(crate) fn half(&self) -> f64 {
        (self.widest * 2e4).round() / 2e4
    }
}

/// A vertical shake that starts at rest and at its lowest point.
fn shake() -> Motion {
    let amplitude = DVec3::Z * AMPLITUDE;
    Motion::harmonic(Harmonic { amplitude, frequency: FREQUENCY, phase: -FRAC_PI_2 })
}

/// The box with its vibrating floor, or the pipe with its vibrating screen; `half` are the half
/// sides of the box along x and y, m.
pub(crate) fn walls(screen: bool, mesh: Option<u32>, half: DVec3) -> Result<MeshWalls, WallError> {
    let mut parts = Vec::new();
    if screen {
        let frame = Frame::new(DVec3::Z * -0.1, DVec3::Z * 0.3, PIPE, [36, 16])?;
        parts.push(Part::new("pipe", Shape::Frame(frame)));
        parts.push(plane("pan", DVec3::Z * -0.1, DVec3::Z)?);
        parts.extend(wires(mesh)?);
    } else {
        let floor = plane("floor", DVec3::Z * AMPLITUDE, DVec3::Z)?;
        parts.push(floor.with_motion(shake()));
        for (name, normal) in
            [("west", DVec3::X), ("east", -DVec3::X), ("south", DVec3::Y), ("north", -DVec3::Y)]
        {
            parts.push(plane(name, -half * normal, normal)?);
        }
    }
    Ok(MeshWalls(Walls::new(parts)?))
}

fn plane(name: &str, point: DVec3, normal: DVec3) -> Result<Part, WallError> {
    Ok(Part::new(name, Shape::Plane(Plane::new(point, normal, 0.04)?)))
}

/// Straight wires in two touching layers; those along x with their axes at z = 0.
fn wires(mesh: Option<u32>) -> Result<Vec<Part>, WallError> {
    let pitch = APERTURE + WIRE;
    let most = ((PIPE - 0.5 * WIRE) / pitch + 0.5).floor() as i32;
    let mut parts = Vec::new();
    for (along, across, z) in [(DVec3::X, DVec3::Y, 0.0), (DVec3::Y, DVec3::X, -WIRE)] {
        for k in -most..most {
            let offset = (f64::from(k) + 0.5) * pitch;
            if offset.abs() >= PIPE - 0.5 * WIRE {
                continue;
            }
            let half = (PIPE * PIPE - offset * offset).sqrt() + 1e-3;
            // The shake starts at its lowest point; the screen then lies where the bed settled.
            let middle = across * offset + DVec3::Z * (z + AMPLITUDE);
            let ends = [middle - along * half, middle + along * half];
            let segments = (2.0 * half / pitch).ceil() as u32;
            let shape = match mesh {
                None => Shape::Wire(Wire::new(ends[0], ends[1], 0.5 * WIRE, segments)?),
                Some(sides) => {
                    let pieces = (2.0 * half / 0.02).ceil() as u32;
                    let (up, radius, fit) = (DVec3::Z, 0.5 * WIRE, Fit::Inscribed);
                    let prism =
                        Prism { ends, up, radius, sides, fit, segments: pieces, closed: false };
                    Shape::Mesh(prism.mesh()?)
                }
            };
            let name = format!("wire-{}-{}", if along == DVec3::X { "x" } else { "y" }, k + most);
            let part = Part::new(name, shape).with_motion(shake());
            parts.push(part.with_half_side(0.5 * WIRE));
        }
    }
    Ok(parts)
}

/// One linear spring and dashpot that may pull, for all pairs and walls.
pub(crate) fn contact(classes: &[Class]) -> Result<Contact<Linear>, ContactError> {
    let law = |mass: f64| -> Result<PairContact<Linear>, ContactError> {
        let damping = dashpot(STIFFNESS, RESTITUTION, mass)?;
        let normal = Linear::new(STIFFNESS, damping)?
            .with_dashpot(Dashpot::MayPull)
            .with_tangential_ratio(TANGENTIAL_RATIO)?;
        let (friction, rolling_friction, tangential_damping) = (FRICTION, 0.0, 0.0);
        Ok(PairContact { normal, friction, rolling_friction, tangential_damping })
    };
    let reduced = |a: &Class, b: &Class| a.mass() * b.mass() / (a.mass() + b.mass());
    let table: Vec<Vec<_>> = classes
        .iter()
        .map(|a| classes.iter().map(|b| law(reduced(a, b))).collect())
        .collect::<Result<_, _>>()?;
    let walls: Vec<_> = classes.iter().map(|a| law(a.mass())).collect::<Result<_, _>>()?;
    let own = classes.to_vec();
    let find = move |class: &Class| own.iter().position(|c| c == class).unwrap_or(0);
    let find_wall = find.clone();
    Ok(Contact::new(
        classes,
        1,
        move |a, b| table[find(a)][find(b)],
        move |a, _| walls[find_wall(a)],
    ))
}

/// Step, gravity, threads.
pub(crate) fn settings(threads: usize) -> Settings {
    Settings { threads, ..Settings::new(TIME_STEP) }
}

/// Viscosity of water, Pa s.
pub(crate) const VISCOSITY: f64 = 1e-3;

/// The liquid term of the wet scenes.
pub(crate) type Water = Wet<Lambert2008, Pitois2000, Popov2010>;

/// Water of 5 % of the solid mass as a film of one thickness on every sphere.
pub(crate) fn wet(bed: &Bed, walls: &Walls, viscosity: f64) -> Result<Water, WetError> {
    let classes = bed.particles.classes();
    let near = Regularisation::default();
    let laws = PairLaws {
        capillary: Lambert2008,
        normal: Pitois2000 { near },
        tangential: Popov2010 { near },
        rupture: AnyRupture::Lian,
        dynamic: Dynamic::None,
    };
    let angle = 40_f64.to_radians();
    let liquid = Liquid {
        surface_tension: 0.07275,
        viscosity,
        density: 1000.0,
        particle_angles: vec![angle],
        wall_angles: vec![angle],
    };
    let parts = walls.parts();
    let element = |shape: &Shape, k| WallElement { area: shape.element_area(k).unwrap_or(1.0) };
    let bodies = Bodies {
        class: bed.class.clone(),
        radii: classes.iter().map(Class::radius).collect(),
        materials: vec![0; classes.len()],
        half_sides: parts.iter().map(|part| part.half_side).collect(),
        wall_materials: vec![0; parts.len()],
        first_elements: (0..parts.len() as u32).map(|k| walls.first_element(k)).collect(),
        elements: parts
            .iter()
            .flat_map(|p| (0..p.shape.element_count()).map(|k| element(&p.shape, k)))
            .collect(),
    };
    let of = |class: &u16| &classes[usize::from(*class)];
    let mass: f64 = bed.class.iter().map(|c| of(c).mass()).sum();
    let area: f64 =
        bed.class.iter().map(|c| 4.0 * std::f64::consts::PI * of(c).radius().powi(2)).sum();
    let thickness = MOISTURE * mass / 1000.0 / area;
    let films = bed.class.iter().map(|c| film::volume(of(c).radius(), thickness).unwrap_or(0.0));
    let films = films.collect();
    let (split, range) = (SplitMethod::Parabola, Range::Extrapolate);
    Wet::new(liquid, laws, laws, split, range, bodies, films)
}
