//! The order of particles in memory: along a Morton curve, cut into chunks of fixed size.

use crate::particles::Particles;

/// Slots per chunk. A function of the number of particles alone: it decides the order of sums.
///
/// All chunks are of one size and, up to some millions of particles, even in number, so that two threads have the same to do.
pub(crate) fn chunk_size(particles: usize) -> usize {
    let about = match particles {
        0..4_000 => 512,
        4_000..12_000 => 1024,
        _ => 2048,
    };
    if particles <= about {
        return about;
    }
    let halves = (particles + about) / (2 * about);
    particles.div_ceil(2 * halves)
}

/// Slots in the order of a Morton curve over cells of the largest diameter.
pub(crate) fn morton(particles: &Particles) -> Vec<u32> {
    let places = &particles.places;
    let low = places.iter().fold(glam::DVec3::INFINITY, |low, p| low.min(p.x));
    let cell = 2.0 * places.iter().fold(0.0_f64, |r, p| r.max(p.r));
    let key = |slot: u32| {
        let at = (places[slot as usize].x - low) / cell;
        // `as` saturates: whatever is far out shares the last cell.
        let spread = |v: f64| interleave((v as u32).min((1 << 21) - 1));
        (spread(at.x) | spread(at.y) << 1 | spread(at.z) << 2, particles.id[slot as usize])
    };
    let mut slots: Vec<u32> = (0..places.len() as u32).collect();
    slots.sort_by_cached_key(|&slot| key(slot));
    slots
}

/// Spreads the low 21 bits of `v` to every third bit.
fn interleave(v: u32) -> u64 {
    let mut x = u64::from(v) & 0x1f_ffff;
    x = (x | x << 32) & 0x1f_0000_0000_ffff;
    x = (x | x << 16) & 0x1f_0000_ff00_00ff;
    x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}

#[cfg(test)]
mod tests {
    use super::{chunk_size, interleave};

    #[test]
    fn chunks_are_alike_and_even_in_number() {
        assert_eq!([chunk_size(0), chunk_size(1), chunk_size(512)], [512; 3]);
        for particles in (513..5_000).chain((5_000..1_000_000).step_by(997)) {
            let size = chunk_size(particles);
            assert!((256..4096).contains(&size), "{particles}: {size}");
            let last = particles - (particles - 1) / size * size;
            assert!(2 * last > size, "{particles}: {last} of {size}");
            assert_eq!(particles.div_ceil(size) % 2, 0, "{particles}");
        }
    }

    #[test]
    fn bits_lie_three_apart() {
        for bit in 0..21 {
            assert_eq!(interleave(1 << bit), 1_u64 << (3 * bit));
        }
        assert_eq!(interleave(0x1f_ffff), 0x1249_2492_4924_9249);
    }
}
