//! `force`: the capillary force at a gap.

use std::io::{Read, Write};

use pendular_capillary::young_laplace::ExactBridge;
use pendular_capillary::{AnyCapillary, Bridge, CapillaryLaw, ForceCurve, Range, tabulated};

use crate::status::{Answer, Trouble, Trust};
use crate::table::{TableError, answer_bridges, bridge, gap};

pub(crate) fn run(
    law: AnyCapillary,
    strict: bool,
    input: impl Read,
    output: impl Write,
) -> Result<(), TableError> {
    // Rows of one bridge at several gaps follow each other: solve it once.
    let mut solved: Option<ExactBridge> = None;
    answer_bridges(input, output, "force", |row| {
        let (bridge, gap) = (bridge(row)?, gap(row)?);
        match law {
            AnyCapillary::YoungLaplace => exact(&mut solved, &bridge, gap, strict),
            AnyCapillary::Tabulated => table(&bridge, gap, strict),
            _ => formula(law, &bridge, gap, strict),
        }
    })
}

/// A law's own force: strictly where it may, extrapolated where that is allowed. Beyond the exact
/// rupture distance, where one is known, there is no bridge left to speak of.
fn formula(law: AnyCapillary, bridge: &Bridge, gap: f64, strict: bool) -> Answer {
    let trust = trust(law, bridge, strict)?;
    let curve = law.curve(bridge, Range::Extrapolate).map_err(|_| Trouble::NoValue)?;
    let broken = tabulated::rupture_distance(bridge).is_ok_and(|end| gap > end);
    match (broken, strict) {
        (true, true) => Err(Trouble::Ruptured),
        (true, false) => Ok((curve.force(gap), Trust::Extrapolated)),
        (false, _) => Ok((curve.force(gap), trust)),
    }
}

/// The table's force; beyond its rupture distance the force that fades out is an extrapolation.
fn table(bridge: &Bridge, gap: f64, strict: bool) -> Answer {
    let law = AnyCapillary::Tabulated;
    let trust = trust(law, bridge, strict)?;
    let end = tabulated::rupture_distance(bridge).map_err(|_| Trouble::NoBridge)?;
    if gap > end && strict {
        return Err(Trouble::Ruptured);
    }
    let curve = law.curve(bridge, Range::Extrapolate).map_err(|_| Trouble::NoBridge)?;
    Ok((curve.force(gap), if gap > end { Trust::Extrapolated } else { trust }))
}

/// The exact force: there is none beyond rupture.
fn exact(solved: &mut Option<ExactBridge>, bridge: &Bridge, gap: f64, strict: bool) -> Answer {
    let trust = trust(AnyCapillary::YoungLaplace, bridge, strict)?;
    let known = solved.take().filter(|exact| exact.bridge() == bridge);
    let exact = match known {
        Some(exact) => exact,
        None => ExactBridge::new(bridge)?,
    };
    let force = solved.insert(exact).force(gap)?;
    Ok((force, trust))
}

fn trust(law: AnyCapillary, bridge: &Bridge, strict: bool) -> Result<Trust, Trouble> {
    match law.validity().check(bridge) {
        Ok(()) => Ok(Trust::Ok),
        Err(_) if strict => Err(Trouble::OutOfRange),
        Err(_) => Ok(Trust::Extrapolated),
    }
}
