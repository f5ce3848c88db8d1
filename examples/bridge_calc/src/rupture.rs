//! `rupture`: the gap at which a bridge breaks.

use std::io::{Read, Write};
use std::str::FromStr;

use pendular_capillary::young_laplace::{self, YoungLaplace};
use pendular_capillary::{CapillaryLaw, tabulated};
use pendular_pair::{Bridge, Range, Validity};
use pendular_transfer::{AnyRupture, RuptureLaw, TransferError};

use crate::status::{Answer, Trouble, Trust};
use crate::table::{TableError, answer_bridges, bridge};

/// A rupture law: a published formula, the end of the exact bridge, or the table of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RuptureChoice {
    Formula(AnyRupture),
    Tabulated,
    YoungLaplace,
}

impl RuptureChoice {
    /// How many there are.
    pub(crate) const COUNT: usize = AnyRupture::ALL.len() + 1;

    /// Every law, the exact one last.
    pub(crate) fn all() -> [Self; Self::COUNT] {
        let mut all = [Self::YoungLaplace; Self::COUNT];
        for (place, law) in all.iter_mut().zip(AnyRupture::ALL) {
            *place = match law {
                AnyRupture::Tabulated => Self::Tabulated,
                law => Self::Formula(law),
            };
        }
        all
    }

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Formula(law) => law.name(),
            Self::Tabulated => "tabulated",
            Self::YoungLaplace => "young-laplace",
        }
    }

    pub(crate) fn validity(self) -> Validity {
        match self {
            Self::Formula(law) => law.validity(),
            Self::Tabulated => tabulated::Tabulated.validity(),
            Self::YoungLaplace => YoungLaplace.validity(),
        }
    }

    pub(crate) fn source(self) -> &'static str {
        match self {
            Self::Formula(law) => law.source(),
            Self::Tabulated => "a table of the exact bridge's end",
            Self::YoungLaplace => "end of the stable branch: fold or pitchfork, whichever is first",
        }
    }

    /// Rupture distance, m.
    pub(crate) fn distance(self, bridge: &Bridge, strict: bool) -> Answer {
        match self {
            Self::Formula(law) => formula(law, bridge, strict),
            Self::Tabulated | Self::YoungLaplace => {
                let trust = match self.validity().check(bridge) {
                    Ok(()) => Trust::Ok,
                    Err(_) if strict => return Err(Trouble::OutOfRange),
                    Err(_) => Trust::Extrapolated,
                };
                let distance = if self == Self::Tabulated {
                    tabulated::rupture_distance(bridge).map_err(|_| Trouble::NoBridge)?
                } else {
                    young_laplace::rupture(bridge)?.distance
                };
                Ok((distance, trust))
            }
        }
    }
}

/// Mikami's law has a range of its own for walls: only the law itself knows.
fn formula(law: AnyRupture, bridge: &Bridge, strict: bool) -> Answer {
    if let Ok(distance) = law.distance(bridge, Range::Strict) {
        return Ok((distance, Trust::Ok));
    }
    let distance = law.distance(bridge, Range::Extrapolate).map_err(|_| Trouble::NoValue)?;
    if strict { Err(Trouble::OutOfRange) } else { Ok((distance, Trust::Extrapolated)) }
}

impl FromStr for RuptureChoice {
    type Err = TransferError;

    fn from_str(name: &str) -> Result<Self, TransferError> {
        match name {
            "tabulated" => Ok(Self::Tabulated),
            "young-laplace" => Ok(Self::YoungLaplace),
            _ => name.parse().map(Self::Formula),
        }
    }
}

pub(crate) fn run(
    law: RuptureChoice,
    strict: bool,
    input: impl Read,
    output: impl Write,
) -> Result<(), TableError> {
    answer_bridges(input, output, "rupture_distance", |row| law.distance(&bridge(row)?, strict))
}
