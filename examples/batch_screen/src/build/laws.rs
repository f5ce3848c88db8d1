//! The laws of a scene, with their parameters for every pair of bodies.

use pendular::capillary::AnyCapillary;
use pendular::contact::Linear;
use pendular::dem::{Class, Contact, PairContact};
use pendular::lubrication::{
    AnyNormalDrag, AnyTangentialDrag, Gap, NormalModel, Regularisation, TangentialModel,
};
use pendular::pair::Range;
use pendular::transfer::{AnyRupture, Dynamic, film};
use pendular::walls::Walls;
use pendular::{Bodies, Liquid, PairLaws, SplitMethod, WallElement, Wet};

use super::{Derived, WetTerm};
use crate::error::SceneError;
use crate::scene::{DynamicRupture, LiquidSpec, OutsideRange, Scene, Transfer};

/// The pair of materials, as numbers for the contact law.
#[derive(Debug, Clone, Copy)]
struct Surfaces {
    friction: f64,
    rolling_friction: f64,
    restitution: f64,
    tangential_ratio: f64,
}

fn surfaces(scene: &Scene, a: &str, b: &str) -> Surfaces {
    let found = scene.contacts.iter().find(|pair| {
        let [x, y] = &pair.between;
        (x == a && y == b) || (x == b && y == a)
    });
    let (m, n) = (&scene.materials[a], &scene.materials[b]);
    // k_t/k_n of Mindlin for two materials; (1 − ν)/(1 − ν/2) when they are the same.
    let shear = |m: &crate::scene::Material| m.youngs_modulus / (2.0 * (1.0 + m.poisson_ratio));
    let sum = |share: f64| {
        (1.0 - share * m.poisson_ratio) / shear(m) + (1.0 - share * n.poisson_ratio) / shear(n)
    };
    let ratio = scene.contact.tangential_ratio.unwrap_or(sum(1.0) / sum(0.5));
    Surfaces {
        friction: found.map_or(0.0, |pair| pair.friction),
        rolling_friction: found.map_or(0.0, |pair| pair.rolling_friction),
        restitution: found.map_or(1.0, |pair| pair.restitution),
        tangential_ratio: ratio,
    }
}

/// The dry contact of all pairs of classes and of each class with each material.
pub(crate) fn contact(scene: &Scene, classes: &[Class]) -> Result<Contact<Linear>, SceneError> {
    let names: Vec<&String> = scene.materials.keys().collect();
    let n = names.len();
    let table: Vec<Surfaces> = (0..n * n)
        .map(|k| {
            let (a, b) = (names[k / n], names[k % n]);
            surfaces(scene, a, b)
        })
        .collect();
    let stiffness = scene.contact.stiffness;
    let law = move |s: Surfaces, reduced_mass: f64| {
        let normal = Linear::from_restitution(stiffness, s.restitution, reduced_mass)?
            .with_tangential_ratio(s.tangential_ratio)?;
        Ok::<_, pendular::contact::ContactError>(PairContact {
            normal,
            friction: s.friction,
            rolling_friction: s.rolling_friction,
            tangential_damping: 0.0,
        })
    };
    let pairs: Vec<Vec<PairContact<Linear>>> = classes
        .iter()
        .map(|a| {
            let other = |b: &Class| {
                let reduced = a.mass() * b.mass() / (a.mass() + b.mass());
                law(table[usize::from(a.material()) * n + usize::from(b.material())], reduced)
            };
            classes.iter().map(other).collect::<Result<_, _>>()
        })
        .collect::<Result<_, _>>()?;
    let walls: Vec<Vec<PairContact<Linear>>> = classes
        .iter()
        .map(|a| (0..n).map(|m| law(table[usize::from(a.material()) * n + m], a.mass())).collect())
        .collect::<Result<_, _>>()?;
    let own = classes.to_vec();
    let find = {
        let own = own.clone();
        move |class: &Class| own.iter().position(|c| c == class).unwrap_or(0)
    };
    let find_wall = find.clone();
    Ok(Contact::new(
        classes,
        n as u8,
        move |a, b| pairs[find(a)][find(b)],
        move |a, m| walls[find_wall(a)][usize::from(m)],
    ))
}

/// The liquid on the particles and its laws.
pub(crate) fn wet(
    scene: &Scene,
    spec: &LiquidSpec,
    classes: &[Class],
    derived: &Derived,
    walls: &Walls,
) -> Result<WetTerm, SceneError> {
    let angles: Vec<f64> =
        scene.materials.values().map(|m| m.contact_angle_deg.to_radians()).collect();
    let liquid = Liquid {
        surface_tension: spec.surface_tension,
        viscosity: spec.viscosity,
        density: spec.density,
        particle_angles: angles.clone(),
        wall_angles: angles,
    };
    let elements = |part: &pendular::walls::Part| {
        let shape = part.shape.clone();
        (0..shape.element_count())
            .map(move |k| WallElement { area: shape.element_area(k).unwrap_or(f64::NAN) })
            .collect::<Vec<_>>()
    };
    let parts = walls.parts();
    let bodies = Bodies {
        class: derived.class.clone(),
        radii: classes.iter().map(Class::radius).collect(),
        materials: classes.iter().map(Class::material).collect(),
        half_sides: parts.iter().map(|part| part.half_side).collect(),
        wall_materials: parts.iter().map(|part| part.material).collect(),
        first_elements: (0..parts.len() as u32).map(|k| walls.first_element(k)).collect(),
        elements: parts.iter().flat_map(elements).collect(),
    };
    let film_of = |class: &u16| {
        let radius = classes[usize::from(*class)].radius();
        film::volume(radius, derived.film).unwrap_or(0.0)
    };
    let films = derived.class.iter().map(film_of).collect();
    let split = match spec.transfer {
        Transfer::Exact => SplitMethod::Exact,
        Transfer::Parabola => SplitMethod::Parabola,
        Transfer::Half => SplitMethod::Half,
    };
    let range = match spec.outside_range {
        OutsideRange::Refuse => Range::Strict,
        OutsideRange::Extrapolate => Range::Extrapolate,
    };
    let between = laws(spec, &spec.capillary, &spec.tangential_drag, &spec.rupture);
    let with_walls =
        laws(spec, &spec.capillary_wall, &spec.tangential_drag_wall, &spec.rupture_wall);
    Ok(Wet::new(liquid, between, with_walls, split, range, bodies, films)?)
}

type Laws = PairLaws<AnyCapillary, Option<AnyNormalDrag>, Option<AnyTangentialDrag>>;

/// The laws by their names, which the scene's check has found to be known.
fn laws(spec: &LiquidSpec, capillary: &str, tangential: &str, rupture: &str) -> Laws {
    let gap = Gap::RelativeRoughness { fraction: spec.roughness_share };
    let near = Regularisation::from(gap);
    let dynamic = match spec.dynamic_rupture {
        // What is left open has been decided by now.
        DynamicRupture::None | DynamicRupture::Auto => Dynamic::None,
        DynamicRupture::Pitois => Dynamic::Pitois2001 { viscosity: spec.viscosity },
        DynamicRupture::Grohn => Dynamic::Grohn2022,
    };
    PairLaws {
        capillary: capillary.parse().unwrap_or(AnyCapillary::Lambert),
        // The scene's check has left no other name than `none`.
        normal: spec.normal_drag.parse().ok().map(|model: NormalModel| model.with(near)),
        tangential: tangential.parse().ok().map(|model: TangentialModel| model.with(near)),
        rupture: rupture.parse().unwrap_or(AnyRupture::Willett),
        dynamic,
    }
}
