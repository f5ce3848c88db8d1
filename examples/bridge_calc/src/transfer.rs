//! `transfer`: who gets the liquid at rupture.

use std::io::{Read, Write};

use clap::ValueEnum;
use pendular_capillary::young_laplace::{self, YoungLaplace};
use pendular_capillary::{CapillaryLaw, tabulated};
use pendular_pair::{Bridge, Validity};
use pendular_transfer::TransferError;
use pendular_transfer::split::{Pair, parabola};

use crate::status::{Answer, Trouble, Trust};
use crate::table::{TableError, answer_bridges, bridge};

/// How the share is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Method {
    /// Parabolic profile at Willett's rupture distance (Pepin et al. 2000; Shi & McCarthy 2008)
    Parabola,
    /// At the neck of the last stable Young-Laplace bridge
    Exact,
    /// A table of `exact`
    Tabulated,
}

impl Method {
    pub(crate) const ALL: [Self; 3] = [Self::Parabola, Self::Exact, Self::Tabulated];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Parabola => "parabola",
            Self::Exact => "exact",
            Self::Tabulated => "tabulated",
        }
    }

    pub(crate) fn source(self) -> &'static str {
        match self {
            Self::Parabola => {
                "Pepin, Rossetti, Iveson, Simons (2000), J. Colloid Interface Sci. 232, 289; \
                 Shi, McCarthy (2008), Powder Technol. 184, 64"
            }
            Self::Exact => "neck of the last stable Young-Laplace bridge",
            Self::Tabulated => "a table of `exact`",
        }
    }

    /// The parabola has no stated range: it answers wherever it has a solution.
    pub(crate) fn validity(self) -> Validity {
        match self {
            Self::Parabola => Validity::ALL,
            Self::Exact => YoungLaplace.validity(),
            Self::Tabulated => tabulated::Tabulated.validity(),
        }
    }

    /// Share of the first body.
    pub(crate) fn share(self, bridge: &Bridge, strict: bool) -> Answer {
        let trust = match self.validity().check(bridge) {
            Ok(()) => Trust::Ok,
            Err(_) if strict => return Err(Trouble::OutOfRange),
            Err(_) => Trust::Extrapolated,
        };
        let share = match self {
            Self::Parabola => parabola_share(bridge)?,
            Self::Exact => young_laplace::rupture(bridge)?.share,
            Self::Tabulated => tabulated::transfer_ratio(bridge).map_err(|_| Trouble::NoBridge)?,
        };
        Ok((share, trust))
    }
}

fn parabola_share(bridge: &Bridge) -> Result<f64, Trouble> {
    match parabola::split(&Pair::of(bridge), bridge.volume()) {
        Ok(split) => Ok(split.transfer_ratio()),
        Err(TransferError::NoSolution { .. }) => Err(Trouble::NoSolution),
        Err(_) => Err(Trouble::NoValue),
    }
}

pub(crate) fn run(
    method: Method,
    strict: bool,
    input: impl Read,
    output: impl Write,
) -> Result<(), TableError> {
    answer_bridges(input, output, "transfer_ratio", |row| method.share(&bridge(row)?, strict))
}
