//! The tables of a run, written and flushed row by row.

use std::fs::File;
use std::path::{Path, PathBuf};

use crate::build::Derived;
use crate::error::RunError;
use crate::run::Tally;
use crate::scene::Scene;

/// A CSV file whose rows are on disk as soon as they are written.
struct Table {
    path: PathBuf,
    writer: csv::Writer<File>,
}

impl Table {
    fn create(path: PathBuf, header: &[String]) -> Result<Self, RunError> {
        let file =
            File::create(&path).map_err(|source| RunError::Write { path: path.clone(), source })?;
        let mut table = Self { path, writer: csv::Writer::from_writer(file) };
        table.line(header)?;
        Ok(table)
    }

    fn line(&mut self, cells: &[String]) -> Result<(), RunError> {
        let write = self.writer.write_record(cells).map_err(std::io::Error::from);
        let done = write.and_then(|()| self.writer.flush());
        done.map_err(|source| RunError::Write { path: self.path.clone(), source })
    }
}

/// The files of one run.
pub(crate) struct Output {
    retained: Table,
    liquid: Option<Table>,
    masses: Vec<f64>,
    density: f64,
    initial: Option<(f64, Vec<f64>)>,
    groups: Vec<(String, Vec<usize>)>,
}

impl Output {
    /// Creates the folder and the tables with their headers.
    pub(crate) fn create(
        folder: &Path,
        scene: &Scene,
        derived: &Derived,
        parts: &[String],
    ) -> Result<Self, RunError> {
        std::fs::create_dir_all(folder)
            .map_err(|source| RunError::Write { path: folder.to_path_buf(), source })?;
        let names: Vec<String> = scene.classes.iter().map(|class| class.name.clone()).collect();
        let mut header = vec!["time_s".to_owned(), "total".to_owned()];
        header.extend(names.iter().cloned());
        header.push("particles_above".to_owned());
        let retained = Table::create(folder.join("retained.csv"), &header)?;
        let groups = groups(parts);
        let liquid = match &scene.liquid {
            None => None,
            Some(_) => {
                let mut header = vec!["time_s".to_owned()];
                header.extend(names.iter().map(|name| format!("above {name} [m3]")));
                header.push("fines [m3]".to_owned());
                header.extend(groups.iter().map(|(name, _)| format!("{name} [m3]")));
                header.push("bridges [m3]".to_owned());
                header.push("total [m3]".to_owned());
                header.push("bridges alive".to_owned());
                Some(Table::create(folder.join("liquid.csv"), &header)?)
            }
        };
        Ok(Self {
            retained,
            liquid,
            masses: derived.masses.clone(),
            density: scene.liquid.as_ref().map_or(0.0, |liquid| liquid.density),
            initial: None,
            groups,
        })
    }

    /// Writes one row of each table.
    pub(crate) fn row(&mut self, tally: &Tally) -> Result<(), RunError> {
        let now = masses(tally, &self.masses, self.density);
        let (total, classes) = self.initial.get_or_insert_with(|| now.clone());
        let share = |now: f64, initial: f64| if initial > 0.0 { now / initial } else { 0.0 };
        let mut cells = vec![seconds(tally.time), number(share(now.0, *total))];
        cells.extend(now.1.iter().zip(classes).map(|(m, m0)| number(share(*m, *m0))));
        cells.push(tally.above.iter().sum::<u64>().to_string());
        self.retained.line(&cells)?;
        let Some(liquid) = &mut self.liquid else { return Ok(()) };
        let mut cells = vec![seconds(tally.time)];
        cells.extend(tally.film.iter().map(|v| number(*v)));
        cells.push(number(tally.fines));
        for (_, parts) in &self.groups {
            cells.push(number(parts.iter().map(|&k| tally.parts[k]).sum()));
        }
        cells.push(number(tally.bridges));
        let walls: f64 = tally.parts.iter().sum();
        let films: f64 = tally.film.iter().sum();
        cells.push(number(films + tally.fines + walls + tally.bridges));
        cells.push((tally.counts.formed - tally.counts.ruptured).to_string());
        liquid.line(&cells)
    }
}

/// Mass not in the collecting bin (E18 eq. 44: particles and all liquid but the fines') and that of
/// each class above the screen with its films (E18 eq. 45), kg.
pub(crate) fn masses(tally: &Tally, solid: &[f64], density: f64) -> (f64, Vec<f64>) {
    let classes: Vec<f64> = (0..solid.len())
        .map(|k| tally.above[k] as f64 * solid[k] + density * tally.film[k])
        .collect();
    let held: f64 = tally.parts.iter().sum::<f64>() + tally.bridges;
    (classes.iter().sum::<f64>() + density * held, classes)
}

/// Fractions retained Y and Y_i at one moment against another.
pub(crate) fn retained(now: &Tally, first: &Tally, solid: &[f64], density: f64) -> (f64, Vec<f64>) {
    let (total, classes) = masses(now, solid, density);
    let (total0, classes0) = masses(first, solid, density);
    let share = |m: f64, m0: f64| if m0 > 0.0 { m / m0 } else { 0.0 };
    (share(total, total0), classes.iter().zip(&classes0).map(|(m, m0)| share(*m, *m0)).collect())
}

/// Wall parts whose names differ by a trailing number count as one group.
pub(crate) fn groups(parts: &[String]) -> Vec<(String, Vec<usize>)> {
    let mut groups: Vec<(String, Vec<usize>)> = Vec::new();
    for (k, part) in parts.iter().enumerate() {
        let name = if part.starts_with("wire-") { "wires" } else { part };
        match groups.iter_mut().find(|(known, _)| known == name) {
            Some((_, members)) => members.push(k),
            None => groups.push((name.to_owned(), vec![k])),
        }
    }
    groups
}

fn seconds(time: f64) -> String {
    format!("{time:.6}")
}

fn number(value: f64) -> String {
    format!("{value:.9e}")
}
