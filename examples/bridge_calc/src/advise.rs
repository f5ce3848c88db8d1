//! `advise`: the cheapest law that is good enough.

use std::io::{self, Write};
use std::str::FromStr;

use clap::Args;
use pendular_capillary::advise::{Advice, AdviseError, BridgeRange, advise};

/// Two numbers with a comma between them, or one for both ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Span(f64, f64);

impl FromStr for Span {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (low, high) = text.split_once(',').unwrap_or((text, text));
        let number = |word: &str| {
            word.trim().parse::<f64>().map_err(|_| format!("`{word}` is not a number"))
        };
        let (low, high) = (number(low)?, number(high)?);
        if low <= high { Ok(Self(low, high)) } else { Err(format!("{low} is above {high}")) }
    }
}

/// A range of radius ratios, or `plane`.
fn ratio(text: &str) -> Result<Span, String> {
    if text == "plane" { Ok(Span(f64::INFINITY, f64::INFINITY)) } else { text.parse() }
}

/// The bridges that a law is wanted for. Each range is `LO,HI`, or one value.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct Question {
    /// Volumes V/R³, R the harmonic radius (2 r on a plane): inside 1e-8 to 0.5
    #[arg(long, value_name = "LO,HI")]
    v_star: Span,
    /// Contact angles of both bodies, degrees: inside 0 to 60
    #[arg(long, value_name = "LO,HI")]
    theta_deg: Span,
    /// Greatest difference of a bridge's two angles, degrees; 0 if they are always equal. Without it
    /// any two angles of the range may meet
    #[arg(long, value_name = "DEG")]
    theta_difference_deg: Option<f64>,
    /// Larger over smaller radius, 1 to 100 (`1,inf` includes planes), or `plane`
    #[arg(long, value_name = "LO,HI|plane", value_parser = ratio)]
    ratio: Span,
    /// Gap over the rupture distance: inside 0 to 0.98
    #[arg(long, value_name = "LO,HI")]
    gap: Span,
    /// Largest relative error of the force
    #[arg(long, value_name = "X")]
    tolerance: f64,
}

impl Question {
    fn range(&self) -> BridgeRange {
        let Span(least, most) = self.theta_deg;
        // 60° in radians and back must not leave the range by a rounding.
        let radians = |angle: f64| {
            let exact = angle.to_radians();
            if angle <= 60.0 { exact.min(LARGEST) } else { exact }
        };
        BridgeRange {
            v_star: (self.v_star.0, self.v_star.1),
            contact_angle: (radians(least), radians(most)),
            angle_difference: radians(self.theta_difference_deg.unwrap_or(most - least)),
            radius_ratio: (self.ratio.0, self.ratio.1),
            gap: (self.gap.0, self.gap.1),
        }
    }
}

/// 60°, rad.
const LARGEST: f64 = std::f64::consts::FRAC_PI_3;

/// Says which law it is, or that there is none.
///
/// # Errors
/// The outer one if the answer cannot be written, the inner one if the question cannot be answered.
pub(crate) fn run(question: &Question, mut out: impl Write) -> io::Result<Result<(), AdviseError>> {
    let range = question.range();
    let tolerance = question.tolerance;
    match advise(&range, tolerance) {
        Ok(advice) => writeln!(out, "{}", words(&advice))?,
        Err(AdviseError::NoLaw { best, .. }) => {
            let best = words(&best);
            writeln!(out, "none: no law stays under {tolerance} there; the best is {best}")?;
        }
        Err(error) => return Ok(Err(error)),
    }
    Ok(Ok(()))
}

fn words(advice: &Advice) -> String {
    let Advice { law, error, nanoseconds, curve_nanoseconds } = advice;
    format!(
        "{law}: worst relative error {error:.2e}, {nanoseconds:.1} ns per force, \
         {curve_nanoseconds:.0} ns per curve"
    )
}
