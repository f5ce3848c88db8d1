use std::sync::OnceLock;

use pendular_pair::{Bridge, Mate};

use super::chebyshev;
use super::folded::{Folded, OUTPUTS};
use crate::young_laplace::SolveError;

/// V* of the table.
pub(super) const V_STAR: (f64, f64) = (1e-6, 0.5);

/// Largest contact angle of the table, rad.
pub(super) const ANGLE: f64 = std::f64::consts::FRAC_PI_3;

/// Nodes in ln V*, θ and m. The angle needs most: the pitchfork overtakes the fold on its way.
const SHAPE: [usize; 3] = [12, 25, 12];

/// The table's file: coefficients in the order of [`rows`], each with all outputs, as f32, little
/// endian. Written by the example `make_table`.
static FILE: &[u8] = include_bytes!("table.bin");

/// A bridge's place in the table, each coordinate in [0, 1]: ln V*, θ and
/// m = ∛(1 − r_small/r_large).
///
/// m = 0 are equal spheres, m = 1 sphere and plane. The cube root makes the unfolding of the
/// pitchfork smooth, which goes like the cube root of the asymmetry.
fn place(bridge: &Bridge) -> [f64; 3] {
    let asymmetry = 1.0 - 1.0 / bridge.radius_ratio();
    let angle = bridge.mean_contact_angle() / ANGLE;
    [volume_place(bridge.v_star()), angle, asymmetry.cbrt()]
}

/// Place of V* between the ends of the table, in its logarithm.
pub(super) fn volume_place(v_star: f64) -> f64 {
    (v_star / V_STAR.0).ln() / (V_STAR.1 / V_STAR.0).ln()
}

/// V* at a place.
pub(super) fn volume_at(place: f64) -> f64 {
    V_STAR.0 * (place * (V_STAR.1 / V_STAR.0).ln()).exp()
}

/// The bridge on a unit sphere of given V*, angles and r_small/r_large (0: a plane).
pub(super) fn bridge_of(v_star: f64, angles: [f64; 2], ratio: f64) -> Option<Bridge> {
    let mate = if ratio > 0.0 { Mate::Sphere { radius: 1.0 / ratio } } else { Mate::PLANE };
    let scale = Bridge::new(1.0, mate, 1.0, angles, 1.0).ok()?.harmonic_radius();
    Bridge::new(1.0, mate, v_star * scale.powi(3), angles, 1.0).ok()
}

/// Rows of the table: degrees in ln V* and θ, and how many degrees in m are kept with them.
///
/// Kept is what lies under the plane through the three largest degrees: the corners beyond it add
/// nothing that can be seen.
fn rows() -> impl Iterator<Item = (usize, usize, usize)> {
    let [a, b, c] = SHAPE;
    let kept = move |i: usize, j: usize| {
        let room = (a * b).checked_sub(i * b + j * a)?;
        Some((c * room / (a * b) + 1).min(c))
    };
    (0..a).flat_map(move |i| (0..b).filter_map(move |j| Some((i, j, kept(i, j)?))))
}

fn table() -> &'static [[f32; OUTPUTS]] {
    static TABLE: OnceLock<Vec<[f32; OUTPUTS]>> = OnceLock::new();
    TABLE.get_or_init(|| {
        let (numbers, _) = FILE.as_chunks::<4>();
        let numbers: Vec<f32> = numbers.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect();
        numbers.as_chunks().0.to_vec()
    })
}

/// The folded bridge of equal contact angles from the table; the share is the smaller body's.
pub(super) fn look_up(bridge: &Bridge) -> Folded {
    let [volume, angle, m] = place(bridge);
    let volumes: [f64; SHAPE[0]] = chebyshev::polynomials(volume);
    let angles: [f64; SHAPE[1]] = chebyshev::polynomials(angle);
    let ms: [f64; SHAPE[2]] = chebyshev::polynomials(m);
    let mut out = [0.0; OUTPUTS];
    let mut rest = table();
    for (i, j, count) in rows() {
        let (row, after) = rest.split_at(count.min(rest.len()));
        rest = after;
        let mut sum = [0.0; OUTPUTS];
        for (entry, t) in row.iter().zip(ms) {
            for (s, &c) in sum.iter_mut().zip(entry) {
                *s += t * f64::from(c);
            }
        }
        let weight = volumes[i] * angles[j];
        for (total, s) in out.iter_mut().zip(sum) {
            *total += weight * s;
        }
    }
    Folded::from_array(out)
}

/// Solves the exact bridge at every node and returns the bytes of the table's file.
///
/// It takes some seconds. The example `make_table` writes the result to the place from which it is
/// compiled in; nothing else needs it.
///
/// # Errors
/// [`SolveError`] if a node has no stable bridge.
pub fn generate() -> Result<Vec<u8>, SolveError> {
    let [a, b, c] = SHAPE;
    let mut values = Vec::with_capacity(a * b * c * OUTPUTS);
    for index in 0..a * b * c {
        let (i, j, k) = (index / (b * c), index / c % b, index % c);
        let theta = (ANGLE * chebyshev::node(j, b)).min(ANGLE);
        let m = chebyshev::node(k, c);
        let v_star = volume_at(chebyshev::node(i, a));
        let lost = SolveError::NoStableBridge { v_star, contact_angles: [theta; 2] };
        let bridge = bridge_of(v_star, [theta; 2], 1.0 - m * m * m).ok_or(lost)?;
        values.extend(Folded::exact(&bridge)?.to_array());
    }
    for (axis, stride) in [b * c * OUTPUTS, c * OUTPUTS, OUTPUTS].into_iter().enumerate() {
        transform(&mut values, SHAPE[axis], stride);
    }
    let start = |i: usize, j: usize| (i * b + j) * c * OUTPUTS;
    let kept = rows().flat_map(|(i, j, n)| values[start(i, j)..start(i, j) + n * OUTPUTS].to_vec());
    Ok(kept.flat_map(|value| (value as f32).to_le_bytes()).collect())
}

/// Values to Chebyshev coefficients along one axis of a dense array.
fn transform(values: &mut [f64], count: usize, stride: usize) {
    for base in (0..values.len()).filter(|base| (base / stride).is_multiple_of(count)) {
        let line: Vec<f64> = (0..count).map(|k| values[base + k * stride]).collect();
        for (k, value) in chebyshev::coefficients(&line).into_iter().enumerate() {
            values[base + k * stride] = value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_file_holds_all_rows_and_no_more() {
        let entries: usize = rows().map(|(_, _, count)| count).sum();
        assert_eq!(FILE.len(), entries * OUTPUTS * size_of::<f32>());
        assert_eq!(table().len(), entries);
        assert!(FILE.len() < 150_000);
    }

    #[test]
    fn the_file_is_what_the_generator_makes() {
        let made = generate().unwrap();
        assert_eq!(made.len(), FILE.len());
        let numbers = |bytes: &[u8]| -> Vec<f32> {
            bytes.as_chunks().0.iter().map(|b| f32::from_le_bytes(*b)).collect()
        };
        for (a, b) in numbers(&made).into_iter().zip(numbers(FILE)) {
            assert!((a - b).abs() < 1e-6, "{a} {b}");
        }
    }

    #[test]
    fn places_go_there_and_back() {
        for v_star in [1e-6, 1e-3, 0.5] {
            let bridge = bridge_of(v_star, [0.3; 2], 0.7).unwrap();
            assert!((bridge.v_star() / v_star - 1.0).abs() < 1e-12);
            let [volume, angle, m] = place(&bridge);
            assert!((volume_at(volume) / v_star - 1.0).abs() < 1e-12);
            assert!((angle * ANGLE - 0.3).abs() < 1e-15 && (m * m * m - 0.3).abs() < 1e-15);
        }
        assert_eq!(place(&bridge_of(0.1, [0.0; 2], 0.0).unwrap())[2], 1.0);
    }
}
