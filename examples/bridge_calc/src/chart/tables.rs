//! The chart's CSV files.

use std::fmt::Write as _;
use std::io::{self, Write};

use super::grid::{GAPS, ZONES};
use super::measure::{METHODS, RUPTURES, Sample};
use super::stats::Stats;
use super::summary::{BODIES, ForceErrors, bodies, map_ratio, worst};
use super::{ChartError, Measured, Target};
use crate::rupture::RuptureChoice;
use pendular_capillary::CapillaryLaw;

pub(crate) fn write(
    target: &Target<'_>,
    laws: &[Measured],
    samples: &[Sample],
) -> Result<(), ChartError> {
    target.write("cost_accuracy.csv", &cost_accuracy(laws))?;
    target.write("error_vs_gap.csv", &error_vs_gap(laws))?;
    for measured in laws {
        let name = format!("error_map_{}.csv", measured.law);
        target.write(&name, &error_map(measured, samples))?;
    }
    target.write("rupture_errors.csv", &rupture_errors(samples))?;
    target.write("transfer_errors.csv", &transfer_errors(samples))
}

/// Three statistics as cells; nothing where there are none.
fn cells(stats: Option<Stats>) -> String {
    stats.map_or(",,".to_owned(), |s| format!("{:.3e},{:.3e},{:.3e}", s.median, s.most, s.worst))
}

const GROUPS: [&str; 3] = ["inside", "outside", "unequal_inside"];

fn groups(measured: &Measured) -> [&ForceErrors; 3] {
    [&measured.inside, &measured.outside, &measured.unequal]
}

/// One row per law.
fn cost_accuracy(laws: &[Measured]) -> String {
    let mut text = "law,ns_force,ns_curve,ns_curve_first,ns_one_shot".to_owned();
    for group in GROUPS {
        let _ = write!(text, ",{group}_bridges,{group}_refused");
        for (zone, ..) in ZONES {
            let _ = write!(text, ",{group}_{zone}_median,{group}_{zone}_p95,{group}_{zone}_worst");
        }
    }
    for measured in laws {
        let c = measured.cost;
        let _ = write!(text, "\n{},{:.2},{:.1}", measured.law, c.force, c.curve);
        let _ = write!(text, ",{:.0},{:.1}", c.first, c.one_shot);
        for errors in groups(measured) {
            let _ = write!(text, ",{},{}", errors.bridges, errors.refused);
            for zone in errors.zones {
                let _ = write!(text, ",{}", cells(zone));
            }
        }
    }
    text + "\n"
}

/// One row per law, group and gap.
fn error_vs_gap(laws: &[Measured]) -> String {
    let mut text = "law,group,gap_over_rupture_distance,median,p95,worst\n".to_owned();
    for measured in laws {
        for (group, errors) in GROUPS.iter().zip(groups(measured)) {
            for (share, stats) in GAPS.iter().zip(errors.gaps) {
                let _ = writeln!(text, "{},{group},{share},{}", measured.law, cells(stats));
            }
        }
    }
    text
}

/// One row per bridge of a law's map: the worst error in each zone of gaps.
fn error_map(measured: &Measured, samples: &[Sample]) -> String {
    let mut text = "v_star,theta_deg,radius_ratio,in_range".to_owned();
    for (zone, ..) in ZONES {
        let _ = write!(text, ",{zone}");
    }
    text.push('\n');
    let ratio = map_ratio(measured.law);
    for sample in samples.iter().filter(|s| s.pair.equal && s.pair.ratio == ratio) {
        let inside = measured.law.validity().check(&sample.bridge).is_ok();
        let [angle, _] = sample.pair.degrees();
        let _ = write!(text, "{:.6e},{angle},{ratio},{inside}", sample.bridge.v_star());
        for (_, low, high) in ZONES {
            match &sample.force[measured.index] {
                Some(errors) => {
                    let _ = write!(text, ",{:.3e}", worst(errors, low, high));
                }
                None => text.push(','),
            }
        }
        text.push('\n');
    }
    text
}

/// Mean of signed errors.
fn bias(errors: &[f64]) -> f64 {
    errors.iter().sum::<f64>() / errors.len() as f64
}

/// Rows of one law or method over all groups of bodies.
fn rows(
    text: &mut String,
    name: &str,
    samples: &[Sample],
    pick: impl Fn(&Sample) -> Option<f64> + Copy,
) {
    for (label, low, high) in BODIES {
        for (angles, equal) in [("equal", true), ("unequal", false)] {
            let members = bodies(samples, (low, high), equal);
            let errors: Vec<f64> = members.clone().filter_map(pick).collect();
            let _ = write!(text, "{name},{label},{angles},{}", members.count());
            match Stats::of(errors.iter().copied()) {
                Some(stats) => {
                    let (bias, cells) = (bias(&errors), cells(Some(stats)));
                    let _ = writeln!(text, ",{},{bias:.3e},{cells}", stats.count);
                }
                None => text.push_str(",0,,,,\n"),
            }
        }
    }
}

fn rupture_errors(samples: &[Sample]) -> String {
    let mut text = "law,bodies,angles,bridges,answered,mean,median,p95,worst\n".to_owned();
    for (index, law) in RuptureChoice::all().into_iter().enumerate().take(RUPTURES) {
        rows(&mut text, law.name(), samples, |sample| sample.rupture[index]);
    }
    text
}

fn transfer_errors(samples: &[Sample]) -> String {
    let mut text = "method,bodies,angles,bridges,answered,mean,median,p95,worst\n".to_owned();
    for (index, method) in METHODS.into_iter().enumerate() {
        rows(&mut text, method.name(), samples, |sample| sample.share[index]);
    }
    text
}

/// The short form of `cost_accuracy.csv` for people.
pub(crate) fn say(laws: &[Measured], out: &mut impl Write) -> io::Result<()> {
    writeln!(
        out,
        "law                          ns/force   ns/curve    median       95 %      worst"
    )?;
    for measured in laws {
        let cost = measured.cost;
        write!(out, "{:<26} {:>10.1} {:>10.0}", measured.law, cost.force, cost.curve)?;
        match measured.inside.all() {
            Some(s) => writeln!(out, " {:>9.1e} {:>10.1e} {:>10.1e}", s.median, s.most, s.worst)?,
            None => writeln!(out)?,
        }
    }
    writeln!(out, "Relative error of the force inside each law's range, gaps to 0.98 of rupture.")
}
