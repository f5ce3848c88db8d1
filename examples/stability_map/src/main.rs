//! Where the time step is stable, how far from there the library's limit lies, and what accuracy
//! costs: maps of four scenes over stiffness, restitution, viscosity and integrator, and the error
//! of a small wet screening against its cost.

mod case;
mod chain;
mod column;
mod edge;
mod impact;
mod maps;
mod pair;
mod pareto;
mod plain;
mod rig;
mod row;
mod runs;
mod screen;
mod tables;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use clap::Parser;

use crate::case::{Case, Kind, Line};
use crate::column::Column;
use crate::rig::Fault;

/// Maps of stability over the time step, and error against cost of whole runs.
///
/// Writes a CSV table and an SVG drawing for each scene, `summary.csv` with every limit and edge,
/// and `runs.csv`. Exit code 3 if a predicted limit lies outside the stable region or farther than
/// a factor of 2 from its edge.
#[derive(Debug, Parser)]
#[command(name = "stability_map", version)]
struct Cli {
    /// Folder for tables and drawings; made if it is not there
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// A few lines and short runs only: a look in seconds
    #[arg(long)]
    quick: bool,
    /// Cases at a time
    #[arg(long, value_name = "N", default_value_t = 2)]
    jobs: usize,
}

fn main() -> ExitCode {
    match run(&Cli::parse()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(3),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Says whether no limit is unsafe.
fn run(cli: &Cli) -> Result<bool, Fault> {
    std::fs::create_dir_all(&cli.out)?;
    let (side, layers) = if cli.quick { (3, 8) } else { (5, 40) };
    let column = Column::settled(side, layers, [1e-3, 1.1e-3])?;
    let cases = case::all(cli.quick);
    // The long ones first, so that no worker waits for them at the end.
    let order: Vec<usize> = (0..cases.len()).rev().collect();
    let lines = parallel(&order, cli.jobs, |&k| cases[k].run(&column, cli.quick))?;
    let lines: Vec<Line> = lines.into_iter().rev().collect();
    write(&cli.out, &lines)?;
    let holds = report(&cases, &lines);
    let plan = runs::plan(cli.quick);
    let runs = parallel(&plan, cli.jobs, |(axis, way)| runs::run(*axis, way, cli.quick))?;
    tables::runs(&cli.out.join("runs.csv"), &runs)?;
    std::fs::write(cli.out.join("runs.svg"), pareto::draw(&runs))?;
    for run in &runs {
        let [retained, on_walls, restitution] = run.values();
        println!(
            "{:<10} {:<18} {:>8.2} s  retained {retained:.4}  on walls {on_walls:.4}  \
             restitution {restitution:.4}",
            run.axis.name(),
            run.label(),
            run.found.cost,
        );
    }
    Ok(holds)
}

/// Does all of `work`, `jobs` at a time; results in its order.
fn parallel<W: Sync, R: Send>(
    work: &[W],
    jobs: usize,
    one: impl Fn(&W) -> Result<R, Fault> + Sync,
) -> Result<Vec<R>, Fault> {
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..jobs.max(1) {
            scope.spawn(|| {
                while let Some((k, work)) = {
                    let k = next.fetch_add(1, Ordering::Relaxed);
                    work.get(k).map(|work| (k, work))
                } {
                    let result = one(work);
                    done.lock()
                        .unwrap_or_else(std::sync::PoisonError::into_inner)
                        .push((k, result));
                }
            });
        }
    });
    let mut all = done.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    all.sort_by_key(|(k, _)| *k);
    all.into_iter().map(|(_, result)| result).collect()
}

fn write(out: &Path, lines: &[Line]) -> Result<(), Fault> {
    for kind in Kind::ALL {
        let title = match kind {
            Kind::Impact => "One impact of two equal spheres",
            Kind::Pair => "A wet pair that bounces in its bridge",
            Kind::Chain => "A sphere runs into two that touch, all wet",
            Kind::Column => "A column of wet spheres",
        };
        tables::map(&out.join(format!("{}.csv", kind.name())), kind, lines)?;
        if let Some(svg) = maps::draw(kind, title, lines) {
            std::fs::write(out.join(format!("{}.svg", kind.name())), svg)?;
        }
    }
    tables::summary(&out.join("summary.csv"), lines)
}

/// Prints edge over limit, line by line, and says whether none is unsafe.
fn report(cases: &[Case], lines: &[Line]) -> bool {
    println!(
        "scene   integrator     drag     k_n N/m     e   eta Pa s  edge/limit  edge/limit before the run"
    );
    let mut all = true;
    for (case, line) in cases.iter().zip(lines) {
        let matter = &case.matter;
        let ratio = |limit: f64| line.edge.edge / limit;
        let unsafe_limit = line.verdict() == Some(false) && ratio(line.edge.limit) < 1.0;
        let verdict = match line.verdict() {
            Some(true) => "",
            Some(false) if unsafe_limit => "  UNSAFE",
            Some(false) => "  safe by more than 2",
            None => "  not ours",
        };
        all &= !unsafe_limit;
        println!(
            "{:<7} {:<14} {:<8} {:>7e}  {:>4}  {:>8}  {:>10.3}  {:>10.3}{verdict}",
            case.kind.name(),
            case.integrator.name(),
            matter.drag.name(),
            matter.stiffness,
            matter.restitution,
            case.viscosity(),
            ratio(line.edge.limit),
            ratio(line.edge.packed),
        );
    }
    let ours = lines.iter().filter(|line| line.verdict().is_some());
    let (low, high) = ours
        .map(|line| line.edge.edge / line.edge.limit)
        .fold((f64::INFINITY, 0.0_f64), |(low, high), r| (low.min(r), high.max(r)));
    println!("edge/limit of the library: {low:.3} to {high:.3}; 1 to 2 is asked for");
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quick_look_writes_everything_and_the_limits_hold() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("maps");
        let cli = Cli { out: out.clone(), quick: true, jobs: 2 };
        assert!(run(&cli).unwrap(), "a limit does not hold");
        for name in ["impact", "pair", "chain", "column", "runs"] {
            let rows = csv::Reader::from_path(out.join(format!("{name}.csv"))).unwrap();
            assert!(rows.into_records().count() > 4, "{name}");
            let svg = std::fs::read_to_string(out.join(format!("{name}.svg"))).unwrap();
            assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
        }
        let mut rows = csv::Reader::from_path(out.join("summary.csv")).unwrap();
        let cases = case::all(true);
        assert_eq!(rows.records().count(), cases.len());
    }

    #[test]
    fn work_done_side_by_side_keeps_its_order() {
        let work: Vec<u64> = (0..50).collect();
        assert_eq!(parallel(&work, 3, |k| Ok(k * k)).unwrap()[7], 49);
        let failed = parallel(&work, 3, |k| if *k == 9 { Err("no".into()) } else { Ok(*k) });
        assert!(failed.is_err());
    }
}
