//! Time per force evaluation of every law, per bridge formed, and per step of a small block.
#![allow(missing_docs)] // criterion's macros make undocumented functions

use std::hint::black_box;

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use pendular::capillary::{AnyCapillary, CapillaryLaw, ForceCurve};
use pendular::contact::Linear;
use pendular::dem::{
    Class, Contact, DVec3, NoWalls, PairContact, PairTerm, Particles, Settings, Simulation,
};
use pendular::lubrication::{NormalCurve, NormalDrag, Pitois2000, Popov2010};
use pendular::lubrication::{TangentialCurve, TangentialDrag};
use pendular::pair::Range;

/// The force of each law at an open gap, its curve folded before.
fn forces(bench: &mut Criterion) {
    for law in AnyCapillary::ALL {
        let Some(bridge) = law.examples().first().copied() else { continue };
        let Ok(curve) = law.curve(&bridge, Range::Strict) else { continue };
        let gap = 0.1 * bridge.volume().cbrt();
        bench.bench_function(&format!("force/{law}"), |b| {
            b.iter(|| black_box(&curve).force(black_box(gap)));
        });
    }
}

/// Folding a bridge, as it happens when one forms.
fn folds(bench: &mut Criterion) {
    let cheap = |law: &AnyCapillary| *law != AnyCapillary::YoungLaplace;
    for law in AnyCapillary::ALL.into_iter().filter(cheap) {
        let Some(bridge) = law.examples().first().copied() else { continue };
        bench.bench_function(&format!("fold/{law}"), |b| {
            b.iter(|| black_box(law).curve(black_box(&bridge), Range::Strict).is_ok());
        });
    }
}

/// The drags at an open gap and in overlap.
fn drags(bench: &mut Criterion) {
    let Some(bridge) = AnyCapillary::Lambert.examples().first().copied() else { return };
    let normal = Pitois2000::default().curve(&bridge, 1e-3);
    let tangential = Popov2010::default().curve(&bridge, 1e-3);
    let (Ok(normal), Ok(tangential)) = (normal, tangential) else { return };
    for (name, gap) in [("open", 1e-5), ("overlap", -1e-7)] {
        bench.bench_function(&format!("drag/pitois/{name}"), |b| {
            b.iter(|| black_box(&normal).coefficient(black_box(gap)));
        });
        bench.bench_function(&format!("drag/popov/{name}"), |b| {
            b.iter(|| black_box(&tangential).resistance(black_box(gap)));
        });
    }
}

/// A lattice of touching spheres with a little motion.
fn lattice() -> Option<Particles> {
    let mut particles = Particles::new(vec![Class::new(1e-3, 2500.0, 0).ok()?]).ok()?;
    for k in 0..1000_u32 {
        let at = DVec3::new(f64::from(k % 10), f64::from(k / 10 % 10), f64::from(k / 100));
        let velocity = 1e-3 * DVec3::new(at.y.sin(), at.z.sin(), at.x.sin());
        particles.push(0, 1.9999e-3 * at, velocity, 10.0 * velocity / 1e-3).ok()?;
    }
    Some(particles)
}

fn contact(particles: &Particles) -> Option<Contact<Linear>> {
    let mass = particles.classes()[0].mass();
    let normal = Linear::from_restitution(1e5, 0.8, 0.5 * mass).ok()?;
    let (friction, rolling_friction, tangential_damping) = (0.4, 0.0, 0.0);
    let law = PairContact { normal, friction, rolling_friction, tangential_damping };
    Some(Contact::new(particles.classes(), 0, move |_, _| law, move |_, _| law))
}

/// Ten steps of 1000 spheres with 2700 contacts: dry, and with a term that is absent.
fn steps(bench: &mut Criterion) {
    fn run<T: PairTerm>(bench: &mut Criterion, name: &str, term: impl Fn(&Particles) -> Option<T>) {
        let settings = Settings { gravity: DVec3::ZERO, ..Settings::new(1e-6) };
        let start = || {
            let particles = lattice()?;
            let term = term(&particles)?;
            Simulation::new(particles, term, NoWalls, settings).ok()
        };
        bench.bench_function(name, |b| {
            b.iter_batched(
                start,
                |mut simulation| {
                    if let Some(simulation) = &mut simulation {
                        black_box(simulation.advance(10).is_ok());
                    }
                    simulation
                },
                BatchSize::LargeInput,
            );
        });
    }
    run(bench, "ten steps/contact", contact);
    run(bench, "ten steps/contact and ()", |p| Some((contact(p)?, ())));
    run(bench, "ten steps/contact and none", |p| Some((contact(p)?, None::<Contact<Linear>>)));
}

criterion_group!(benches, forces, folds, drags, steps);
criterion_main!(benches);
