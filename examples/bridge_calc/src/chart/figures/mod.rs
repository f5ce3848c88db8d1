//! The chart's figures.

mod dots;
mod forces;
mod maps;
mod pareto;

use super::measure::Sample;
use super::{ChartError, Measured, Target};

pub(crate) fn write(
    target: &Target<'_>,
    laws: &[Measured],
    samples: &[Sample],
) -> Result<(), ChartError> {
    target.write("pareto.svg", &pareto::draw(laws))?;
    target.write("error_maps.svg", &maps::draw(laws, samples))?;
    for (name, bridge) in forces::cases()? {
        target.write(&format!("forces_{name}.svg"), &forces::draw(&name, &bridge)?)?;
    }
    target.write("rupture_errors.svg", &dots::rupture(samples))?;
    target.write("transfer_errors.svg", &dots::transfer(samples))
}
