//! `chart`: what every law costs and how wrong it is, in one run.

mod cost;
mod figures;
mod grid;
mod measure;
mod stats;
mod summary;

mod tables;

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use pendular_capillary::young_laplace::SolveError;
use pendular_capillary::{AnyCapillary, OutOfRange};

use self::cost::Cost;
use self::measure::Sample;
use self::summary::{ForceErrors, Group};

/// Why there is no chart.
#[derive(Debug, thiserror::Error)]
pub(crate) enum ChartError {
    #[error("a bridge of the grid: {0}")]
    Bridge(#[from] OutOfRange),
    #[error("the exact bridge: {0}")]
    Solve(#[from] SolveError),
    #[error("a thread of the measurement stopped")]
    Thread,
    #[error("{path}: {source}")]
    Write { path: PathBuf, source: io::Error },
    #[error("writing: {0}")]
    Say(#[from] io::Error),
}

/// A law with all that was measured of it.
pub(crate) struct Measured {
    pub(crate) law: AnyCapillary,
    /// Place in [`AnyCapillary::ALL`] and so in a [`Sample`].
    pub(crate) index: usize,
    pub(crate) cost: Cost,
    pub(crate) inside: ForceErrors,
    pub(crate) outside: ForceErrors,
    pub(crate) unequal: ForceErrors,
}

/// Measures, writes tables and figures to a directory and says what came out.
pub(crate) fn run(out: &Path, mut say: impl Write) -> Result<(), ChartError> {
    let start = std::time::Instant::now();
    // Alone on the machine as far as we can help it: the grid uses all cores, later.
    let costs = cost::measure();
    let samples = measure::measure()?;
    let laws = summarise(&samples, &costs);
    let target = Target { directory: out };
    std::fs::create_dir_all(out).map_err(|source| target.failed("", source))?;
    tables::write(&target, &laws, &samples)?;
    figures::write(&target, &laws, &samples)?;
    tables::say(&laws, &mut say)?;
    let seconds = start.elapsed().as_secs_f64();
    writeln!(say, "{} bridges, {seconds:.0} s, written to {}", samples.len(), out.display())?;
    Ok(())
}

/// Costs and errors by law.
fn summarise(samples: &[Sample], costs: &[Option<Cost>]) -> Vec<Measured> {
    let measured = |(index, law)| {
        let of = |group| summary::force_errors(samples, index, law, group);
        let [inside, outside, unequal] =
            [Group::Inside, Group::Outside, Group::UnequalInside].map(of);
        let cost = (*costs.get(index)?)?;
        Some(Measured { law, index, cost, inside, outside, unequal })
    };
    AnyCapillary::ALL.into_iter().enumerate().filter_map(measured).collect()
}

/// Where the files go.
pub(crate) struct Target<'a> {
    directory: &'a Path,
}

impl Target<'_> {
    pub(crate) fn write(&self, name: &str, text: &str) -> Result<(), ChartError> {
        std::fs::write(self.directory.join(name), text).map_err(|source| self.failed(name, source))
    }

    fn failed(&self, name: &str, source: io::Error) -> ChartError {
        ChartError::Write { path: self.directory.join(name), source }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use grid::Pair;

    /// A small grid goes through every table and figure.
    #[test]
    fn every_file_is_written() {
        let pair =
            |ratio, places: [usize; 2]| Pair { ratio, places, equal: places[0] == places[1] };
        let pairs = [pair(1.0, [4, 4]), pair(1.0, [1, 3]), pair(f64::INFINITY, [4, 4])];
        let samples: Vec<Sample> =
            pairs.iter().flat_map(|pair| measure::of_pair(pair).unwrap()).collect();
        let cost = Some(Cost { force: 5.0, curve: 50.0, first: 60.0, one_shot: 40.0 });
        let laws = summarise(&samples, &[cost; AnyCapillary::ALL.len()]);
        let folder = tempfile::tempdir().unwrap();
        let target = Target { directory: folder.path() };
        tables::write(&target, &laws, &samples).unwrap();
        figures::write(&target, &laws, &samples).unwrap();
        let mut names = Vec::new();
        for entry in std::fs::read_dir(folder.path()).unwrap() {
            let path = entry.unwrap().path();
            let text = std::fs::read_to_string(&path).unwrap();
            assert!(!text.contains("NaN") && !text.contains("\"inf"), "{}", path.display());
            if path.extension().is_some_and(|ending| ending == "svg") {
                assert!(text.starts_with("<svg ") && text.ends_with("</svg>\n"));
                assert_eq!(text.matches("<text").count(), text.matches("</text>").count());
            } else {
                let columns = |line: &str| line.matches(',').count();
                let first = text.lines().next().map(columns);
                assert!(
                    text.lines().all(|line| Some(columns(line)) == first),
                    "{}",
                    path.display()
                );
                assert!(text.lines().count() > 2);
            }
            names.push(path.file_name().unwrap().to_string_lossy().into_owned());
        }
        assert_eq!(names.len(), 4 + AnyCapillary::ALL.len() + 6, "{names:?}");
    }

    /// 2 π R σ cos θ of two equal spheres is Lambert's contact force; the exact one lies below.
    #[test]
    fn errors_are_relative_to_the_exact_force() {
        let pair = Pair { ratio: 1.0, places: [0, 0], equal: true };
        let samples = measure::of_pair(&pair).unwrap();
        let lambert = AnyCapillary::ALL.iter().position(|l| *l == AnyCapillary::Lambert).unwrap();
        // Contact deficit of 1.1 % at V* = 1e-6, as the crate's own reference has it.
        let error = samples[0].force[lambert].unwrap()[0];
        assert!((error - 0.0113).abs() < 2e-4, "{error}");
    }
}
