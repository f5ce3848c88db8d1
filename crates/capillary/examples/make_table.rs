//! Builds the table of the law `tabulated` from the exact solver, writes it, and prints the law's
//! errors on bridges that are not in it.
//!
//! `cargo run --release -p pendular-capillary --example make_table -- [FILE]` from the repository's
//! root. FILE defaults to the place from which the table is compiled in; the errors printed are
//! those of the table that was compiled in before, so run it twice after a change.

use std::error::Error;

use pendular_capillary::tabulated::{self, Tabulated};
use pendular_capillary::young_laplace::ExactBridge;
use pendular_capillary::{Bridge, CapillaryLaw, ForceCurve, Mate, Range};

const FILE: &str = "crates/capillary/src/tabulated/table.bin";

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).unwrap_or_else(|| FILE.to_owned());
    let bytes = tabulated::generate()?;
    std::fs::write(&file, &bytes)?;
    println!("{file}: {} bytes", bytes.len());
    for (name, unequal) in [("equal angles", false), ("unequal angles", true)] {
        println!("{name}: relative errors of force and S_rup, error of the share");
        print_errors(unequal, 2000)?;
    }
    Ok(())
}

fn print_errors(unequal: bool, count: usize) -> Result<(), Box<dyn Error>> {
    let mut random = Random(20_240_229);
    let (mut force, mut rupture, mut share) = (Vec::new(), Vec::new(), Vec::new());
    let mut pair = ([0.0; 2], Mate::PLANE);
    for k in 0..count {
        // Twenty volumes per pair of bodies, as a scene would have.
        if !unequal || k % 20 == 0 {
            pair = random.pair(unequal);
        }
        let v_star = 1e-6 * 0.5e6_f64.powf(random.next());
        let scale = Bridge::new(1.0, pair.1, 1.0, pair.0, 1.0)?.harmonic_radius();
        let bridge = Bridge::new(1.0, pair.1, v_star * scale.powi(3), pair.0, 1.0)?;
        let exact = ExactBridge::new(&bridge)?;
        let curve = Tabulated.curve(&bridge, Range::Strict)?;
        let end = exact.rupture();
        for part in 0..=14 {
            let gap = 0.07 * f64::from(part) * end.distance;
            force.push((curve.force(gap) / exact.force(gap)? - 1.0).abs());
        }
        rupture.push((tabulated::rupture_distance(&bridge)? / end.distance - 1.0).abs());
        share.push((tabulated::transfer_ratio(&bridge)? - end.share).abs());
    }
    for (name, mut errors) in [("force", force), ("S_rup", rupture), ("share", share)] {
        errors.sort_by(f64::total_cmp);
        let at = |part: f64| errors[(part * (errors.len() - 1) as f64) as usize];
        let (median, most, worst) = (at(0.5), at(0.95), at(1.0));
        println!("  {name}: median {median:.1e}, 95 % {most:.1e}, worst {worst:.1e}");
    }
    Ok(())
}

/// A small generator of numbers in [0, 1) (xorshift), so that the run repeats itself.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Contact angles and mate: a fifth planes, a fifth equal, a fifth nearly equal spheres.
    fn pair(&mut self, unequal: bool) -> ([f64; 2], Mate) {
        let third = std::f64::consts::FRAC_PI_3;
        let first = third * self.next();
        let second = if unequal { third * self.next() } else { first };
        let (kind, size) = (self.next(), self.next());
        let mate = match kind {
            k if k < 0.2 => Mate::PLANE,
            k if k < 0.4 => Mate::Sphere { radius: 1.0 },
            k if k < 0.6 => Mate::Sphere { radius: 1.0 + 0.05 * size.powi(3) },
            _ => Mate::Sphere { radius: 100.0_f64.powf(2.0 * size - 1.0) },
        };
        ([first, second], mate)
    }
}
