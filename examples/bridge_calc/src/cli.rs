//! The command line.

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Parser, Subcommand};
use pendular_capillary::AnyCapillary;

use crate::advise::Question;
use crate::contact::Model;
use crate::rupture::RuptureChoice;
use crate::transfer::Method;

const BRIDGES: &str = "\
Reads CSV on stdin with the header
  r1,r2,theta1_deg,theta2_deg,gamma,volume,gap
in SI units (m, degrees, N/m, m³); an empty r2 or `inf` is a plane. Writes the same rows with the
results behind them, numbers with 17 significant digits, and a status:

  ok            inside the law's stated range
  extrapolated  outside of it, or beyond rupture; refused with --strict
  out-of-range  refused because of --strict
  not-a-number  a field cannot be read as a number
  invalid       a value that no bridge has (negative, not finite, an angle of 180° or more)
  no-value      the law's formula has no value there
  no-bridge     no stable bridge of this volume exists
  ruptured      the gap is beyond the exact rupture distance
  no-solution   the transfer model's equations have no solution
  lost          the exact solver failed

With any status but the first two the result is empty. A malformed file (wrong header, wrong number
of fields) ends the run with its line number and exit code 2.";

const CONTACT: &str = "\
Reads CSV on stdin with the header
  e_star,r_star,yield_pressure,displacement_max,steps
(effective modulus Pa, reduced radius m, yield pressure Pa, m). Writes every row `steps` + 1 times
for loading and `steps` + 1 times for unloading, with branch, displacement (m), force (N, positive
pushes apart) and status behind it. The elastic model does not read yield_pressure.";

const CHART: &str = "\
Build with --release, and leave the machine alone while it runs (about a minute). Writes
  cost_accuracy.csv     one row per law: ns per force, per curve, per first curve of a new pair of
                        angles, per one-shot call; median, 95th percentile and worst relative error
                        near contact, in the middle, near rupture and over all gaps, inside and
                        outside the law's stated range, and for unequal angles inside of it
  error_vs_gap.csv      the same errors per share of the exact rupture distance
  error_map_<law>.csv   worst error over V* and contact angle
  rupture_errors.csv    relative error of every rupture law
  transfer_errors.csv   error of the transfer ratio
and figures (SVG) of these. The grid: V* 1e-6 to 0.5, contact angles 0 to 60 degrees, radius ratios 1
to 100 and planes, 19 gaps from contact to rupture.";

/// Every law of wet contacts on CSV tables: stdin to stdout.
#[derive(Debug, Parser)]
#[command(version, about, arg_required_else_help = true)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Capillary force at a gap, N, tension positive: adds force,status
    #[command(after_help = BRIDGES)]
    Force {
        /// Law of the force; `bridge_calc laws` says more about each
        #[arg(long, value_name = "NAME", value_parser = capillary())]
        law: AnyCapillary,
        /// Refuse bridges outside the law's stated range
        #[arg(long)]
        strict: bool,
    },
    /// Rupture distance, m: adds rupture_distance,status (the gap is ignored)
    #[command(after_help = BRIDGES)]
    Rupture {
        /// Law of the rupture distance
        #[arg(long, value_name = "NAME", value_parser = rupture())]
        law: RuptureChoice,
        /// Refuse bridges outside the law's stated range
        #[arg(long)]
        strict: bool,
    },
    /// Share of the liquid that body 1 keeps at rupture: adds transfer_ratio,status (the gap is ignored)
    #[command(after_help = BRIDGES)]
    Transfer {
        /// Parabola of Pepin et al., neck of the last stable Young-Laplace bridge, or its table
        #[arg(long, value_enum, default_value_t = Method::Parabola)]
        method: Method,
        /// Refuse bridges outside the method's stated range
        #[arg(long)]
        strict: bool,
    },
    /// Loading and unloading curves of a dry contact: adds branch,displacement,force,status
    #[command(after_help = CONTACT)]
    Contact {
        /// Contact law
        #[arg(long, value_enum, value_name = "NAME")]
        model: Model,
    },
    /// List every law as CSV: command, name, kind, ranges, source
    Laws,
    /// Name the cheapest law whose measured error stays under a tolerance
    ///
    /// Errors and costs are those measured when the table in the crate was made (`make_advice`);
    /// every law is taken inside its own stated range.
    Advise(Question),
    /// Measure every law's cost and its error against the exact bridge: CSV tables and SVG figures
    #[command(after_help = CHART)]
    Chart {
        /// Directory to write to; made if it is not there
        #[arg(long, value_name = "DIR")]
        out: PathBuf,
    },
}

fn capillary() -> impl TypedValueParser<Value = AnyCapillary> {
    let names = AnyCapillary::ALL.map(AnyCapillary::name);
    PossibleValuesParser::new(names).try_map(|name| name.parse::<AnyCapillary>())
}

fn rupture() -> impl TypedValueParser<Value = RuptureChoice> {
    let names = RuptureChoice::all().map(RuptureChoice::name);
    PossibleValuesParser::new(names).try_map(|name| name.parse::<RuptureChoice>())
}
