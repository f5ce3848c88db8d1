//! Static rupture distances, one published law per file.

mod lian_1993;
mod mikami_1998;
mod tabulated;
mod willett_2000;
mod willett_unequal_2000;

pub use lian_1993::Lian1993;
pub use mikami_1998::Mikami1998;
pub use tabulated::Tabulated;
pub use willett_2000::Willett2000;
pub use willett_unequal_2000::WillettUnequal2000;

use pendular_pair::OutOfRange;

/// A distance, if it is one: finite and not negative.
fn distance(value: f64) -> Result<f64, OutOfRange> {
    OutOfRange::within("rupture distance", value, (0.0, f64::MAX))?;
    Ok(value)
}
