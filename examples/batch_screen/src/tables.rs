//! The tables of a run, written and flushed row by row.

use std::fs::File;
use std::io::{Seek, SeekFrom};
use std::path::{Path, PathBuf};

use pendular::dem::Particle;

use crate::build::Derived;
use crate::build::apparatus::group;
use crate::error::RunError;
use crate::scene::Scene;
use crate::screening::{Passage, partition};
use crate::tally::Tally;

/// Masses at the start, kg: in all, and by class.
pub(crate) type Start = (f64, Vec<f64>);

/// A CSV file whose rows are on disk as soon as they are written.
struct Table {
    path: PathBuf,
    writer: csv::Writer<File>,
}

impl Table {
    fn create(folder: &Path, name: &str, header: &[String]) -> Result<Self, RunError> {
        let path = folder.join(name);
        let file =
            File::create(&path).map_err(|source| RunError::Write { path: path.clone(), source })?;
        let mut table = Self { path, writer: csv::Writer::from_writer(file) };
        table.lines([header.to_vec()])?;
        Ok(table)
    }

    /// Opens a table that holds at least `length` bytes; nothing is changed yet.
    fn reopen(folder: &Path, name: &str, length: u64) -> Result<Self, RunError> {
        let path = folder.join(name);
        let open = || -> std::io::Result<File> {
            let file = File::options().read(true).write(true).open(&path)?;
            if file.metadata()?.len() < length {
                return Err(std::io::Error::other("it is shorter than at the checkpoint"));
            }
            Ok(file)
        };
        let file = open().map_err(|source| RunError::Table { path: path.clone(), source })?;
        Ok(Self { path, writer: csv::Writer::from_writer(file) })
    }

    /// Forgets what came after the first `length` bytes.
    fn cut(&mut self, length: u64) -> Result<(), RunError> {
        let cut = || -> std::io::Result<()> {
            self.writer.get_ref().set_len(length)?;
            let mut file = self.writer.get_ref();
            file.seek(SeekFrom::Start(length)).map(|_| ())
        };
        cut().map_err(|source| RunError::Write { path: self.path.clone(), source })
    }

    /// Bytes on disk.
    fn length(&self) -> Result<u64, RunError> {
        let length = std::fs::metadata(&self.path).map(|data| data.len());
        length.map_err(|source| RunError::Write { path: self.path.clone(), source })
    }

    fn lines(&mut self, rows: impl IntoIterator<Item = Vec<String>>) -> Result<(), RunError> {
        let write = || -> std::io::Result<()> {
            for row in rows {
                self.writer.write_record(&row)?;
            }
            self.writer.flush()
        };
        write().map_err(|source| RunError::Write { path: self.path.clone(), source })
    }
}

const PASSAGES: [&str; 7] = ["time_s", "id", "class", "diameter_m", "film_m3", "x_m", "y_m"];
const REPLAY: [&str; 7] = ["time_s", "id", "class", "x_m", "y_m", "z_m", "film_m"];
const BRIDGES: [&str; 7] =
    ["time_s", "formed", "ruptured", "alive", "alive_wall", "mean_v_star", "extrapolated"];

const ENERGY: [&str; 5] = ["time_s", "kinetic_J", "potential_J", "capillary_J", "capillary_loss_J"];

/// A header cell after another, by name.
fn header(cells: impl IntoIterator<Item = impl Into<String>>) -> Vec<String> {
    cells.into_iter().map(Into::into).collect()
}

/// The files of one run.
pub(crate) struct Tables {
    retained: Table,
    partition: Table,
    pegging: Table,
    energy: Table,
    passages: Table,
    replay: Table,
    liquid: Option<Table>,
    shared: Option<Table>,
    bridges: Option<Table>,
    names: Vec<String>,
    diameters: Vec<f64>,
    initial: Vec<u64>,
    masses: Vec<f64>,
    density: f64,
    start: Start,
    groups: Vec<(String, Vec<usize>)>,
}

impl Tables {
    /// Creates the folder and the tables with their headers; `first` is the state at the start.
    pub(crate) fn create(
        folder: &Path,
        scene: &Scene,
        derived: &Derived,
        parts: &[String],
        first: &Tally,
    ) -> Result<Self, RunError> {
        std::fs::create_dir_all(folder)
            .map_err(|source| RunError::Write { path: folder.to_path_buf(), source })?;
        crate::folder::clear(folder)?;
        let create = |name: &str, cells: Vec<String>| Table::create(folder, name, &cells);
        let mut tables = Self::open(scene, derived, parts, create)?;
        tables.start = masses(first, &tables.masses, tables.density);
        Ok(tables)
    }

    /// Goes on with the tables of a folder from their lengths at a checkpoint.
    pub(crate) fn resume(
        folder: &Path,
        scene: &Scene,
        derived: &Derived,
        parts: &[String],
        lengths: &[u64],
        start: Start,
    ) -> Result<Self, RunError> {
        let mut known = lengths.iter().copied();
        let reopen = |name: &str, _| Table::reopen(folder, name, known.next().unwrap_or(u64::MAX));
        let mut tables = Self::open(scene, derived, parts, reopen)?;
        // All are there and long enough: only now is anything cut.
        for (table, length) in tables.all_mut().zip(lengths) {
            table.cut(*length)?;
        }
        tables.start = start;
        Ok(tables)
    }

    /// Bytes of each table, in the order in which they are opened.
    pub(crate) fn lengths(&self) -> Result<Vec<u64>, RunError> {
        let dry = [
            &self.retained,
            &self.partition,
            &self.pegging,
            &self.energy,
            &self.passages,
            &self.replay,
        ];
        let wet = [&self.liquid, &self.shared, &self.bridges].into_iter().flatten();
        dry.into_iter().chain(wet).map(Table::length).collect()
    }

    /// Every table, in the order in which they are opened.
    fn all_mut(&mut self) -> impl Iterator<Item = &mut Table> {
        let dry = [
            &mut self.retained,
            &mut self.partition,
            &mut self.pegging,
            &mut self.energy,
            &mut self.passages,
            &mut self.replay,
        ];
        let wet = [&mut self.liquid, &mut self.shared, &mut self.bridges];
        dry.into_iter().chain(wet.into_iter().flatten())
    }

    /// Masses at the start.
    pub(crate) fn start(&self) -> Start {
        self.start.clone()
    }

    /// Opens every table with its header, in a fixed order.
    fn open(
        scene: &Scene,
        derived: &Derived,
        parts: &[String],
        mut table: impl FnMut(&str, Vec<String>) -> Result<Table, RunError>,
    ) -> Result<Self, RunError> {
        let names: Vec<String> = scene.classes.iter().map(|class| class.name.clone()).collect();
        let groups = groups(parts);
        let by_class = |first: &[&str], last: &[&str]| {
            let mut cells = header(first.iter().copied());
            cells.extend(names.iter().cloned());
            cells.extend(header(last.iter().copied()));
            cells
        };
        let volumes = |last: &[&str]| {
            let mut cells = header(["time_s"]);
            cells.extend(names.iter().map(|name| format!("above {name} [m3]")));
            cells.extend(names.iter().map(|name| format!("fines {name} [m3]")));
            cells.extend(groups.iter().map(|(name, _)| format!("{name} [m3]")));
            cells.extend(header(last.iter().copied()));
            cells
        };
        let retained = table("retained.csv", by_class(&["time_s", "total"], &["particles_above"]))?;
        let partition =
            table("partition.csv", by_class(&["time_s"], &["cut_size_mm", "imperfection"]))?;
        let pegging = table("pegging.csv", by_class(&["time_s", "apertures", "blocked"], &[]))?;
        let energy = table("energy.csv", header(ENERGY))?;
        let passages = table("passages.csv", header(PASSAGES))?;
        let replay = table("replay.csv", header(REPLAY))?;
        let mut wet = |name: &str, cells: Vec<String>| match &scene.liquid {
            Some(_) => table(name, cells).map(Some),
            None => Ok(None),
        };
        Ok(Self {
            retained,
            partition,
            pegging,
            energy,
            passages,
            replay,
            liquid: wet("liquid.csv", volumes(&["bridges [m3]", "total [m3]"]))?,
            shared: wet("liquid_shared.csv", volumes(&["total [m3]"]))?,
            bridges: wet("bridges.csv", header(BRIDGES))?,
            diameters: scene.classes.iter().map(|class| class.diameter_mm).collect(),
            initial: derived.counts.clone(),
            masses: derived.masses.clone(),
            density: scene.liquid.as_ref().map_or(0.0, |liquid| liquid.density),
            start: Start::default(),
            names,
            groups,
        })
    }

    /// Writes one row of each table; `blocked` holds the apertures by class, out of `apertures`.
    pub(crate) fn row(
        &mut self,
        tally: &Tally,
        blocked: &[u64],
        apertures: u64,
    ) -> Result<(), RunError> {
        let time = seconds(tally.time);
        self.retained_row(tally, &time)?;
        let passed: Vec<f64> = tally
            .passed
            .iter()
            .zip(&self.initial)
            .map(|(&n, &all)| n as f64 / all.max(1) as f64)
            .collect();
        let (cut, imperfection) = partition(&self.diameters, &passed);
        let optional = |value: Option<f64>| value.map_or(String::new(), number);
        let mut cells = vec![time.clone()];
        cells.extend(passed.iter().copied().map(number));
        cells.extend([optional(cut), optional(imperfection)]);
        self.partition.lines([cells])?;
        let mut cells = vec![time.clone(), apertures.to_string()];
        cells.push(blocked.iter().sum::<u64>().to_string());
        cells.extend(blocked.iter().map(u64::to_string));
        self.pegging.lines([cells])?;
        let energies =
            [tally.kinetic, tally.potential, tally.capillary, tally.capillary_loss].map(number);
        self.energy.lines([[time.clone()].into_iter().chain(energies).collect()])?;
        self.liquid_rows(tally, &time)
    }

    fn retained_row(&mut self, tally: &Tally, time: &str) -> Result<(), RunError> {
        let now = masses(tally, &self.masses, self.density);
        let (total, classes) = &self.start;
        let share = |now: f64, initial: f64| if initial > 0.0 { now / initial } else { 0.0 };
        let mut cells = vec![time.to_owned(), number(share(now.0, *total))];
        cells.extend(now.1.iter().zip(classes).map(|(m, m0)| number(share(*m, *m0))));
        cells.push(tally.above.iter().sum::<u64>().to_string());
        self.retained.lines([cells])
    }

    fn liquid_rows(&mut self, tally: &Tally, time: &str) -> Result<(), RunError> {
        let groups = &self.groups;
        let row = |films: &[f64], parts: &[f64], rest: &[f64]| {
            let mut cells = vec![time.to_owned()];
            let on_parts = groups.iter().map(|(_, ks)| ks.iter().map(|&k| parts[k]).sum::<f64>());
            let all: Vec<f64> = films
                .iter()
                .chain(&tally.fines)
                .copied()
                .chain(on_parts)
                .chain(rest.iter().copied())
                .collect();
            cells.extend(all.iter().copied().map(number));
            cells.push(number(all.iter().sum()));
            cells
        };
        if let Some(table) = &mut self.liquid {
            table.lines([row(&tally.film, &tally.parts, &[tally.bridges])])?;
        }
        if let Some(table) = &mut self.shared {
            table.lines([row(&tally.film_shared, &tally.parts_shared, &[])])?;
        }
        if let Some(table) = &mut self.bridges {
            let cells = vec![
                time.to_owned(),
                tally.counts.formed.to_string(),
                tally.counts.ruptured.to_string(),
                tally.alive().to_string(),
                tally.wall_bridges.to_string(),
                number(tally.mean_v_star),
                tally.counts.extrapolated.to_string(),
            ];
            table.lines([cells])?;
        }
        Ok(())
    }

    /// Writes who has passed the screen; `film` gives the volume on a particle, m³.
    pub(crate) fn passages(
        &mut self,
        passages: &[Passage],
        film: impl Fn(u32) -> f64,
    ) -> Result<(), RunError> {
        if passages.is_empty() {
            return Ok(());
        }
        let row = |passage: &Passage| {
            let Particle { id, class, position, .. } = passage.particle;
            let class = usize::from(class);
            vec![
                seconds(passage.time),
                id.to_string(),
                self.names[class].clone(),
                number(1e-3 * self.diameters[class]),
                number(film(id)),
                number(position.x),
                number(position.y),
            ]
        };
        self.passages.lines(passages.iter().map(row).collect::<Vec<_>>())
    }

    /// Writes one frame of the replay, by ascending id; `film` gives the thickness, m.
    pub(crate) fn frame(
        &mut self,
        time: f64,
        particles: &[Particle],
        film: impl Fn(u32) -> f64,
    ) -> Result<(), RunError> {
        let row = |p: &Particle| {
            let mut cells = vec![seconds(time), p.id.to_string(), p.class.to_string()];
            cells.extend(p.position.to_array().map(|x| format!("{x:.5}")));
            cells.push(format!("{:.3e}", film(p.id)));
            cells
        };
        self.replay.lines(particles.iter().map(row).collect::<Vec<_>>())
    }
}

/// Mass not in the collecting bin (E18 eq. 44: particles and all liquid but the fines') and that of
/// each class with its films (E18 eq. 45), kg. What escaped is in no bin: it counts as retained.
pub(crate) fn masses(tally: &Tally, solid: &[f64], density: f64) -> (f64, Vec<f64>) {
    let classes: Vec<f64> = (0..solid.len())
        .map(|k| tally.retained(k) as f64 * solid[k] + density * tally.film_shared[k])
        .collect();
    let held: f64 = tally.parts_shared.iter().sum();
    (classes.iter().sum::<f64>() + density * held, classes)
}

/// Fractions retained Y and Y_i against the masses at the start.
pub(crate) fn retained(now: &Tally, start: &Start, solid: &[f64], density: f64) -> (f64, Vec<f64>) {
    let (total, classes) = masses(now, solid, density);
    let share = |m: f64, m0: f64| if m0 > 0.0 { m / m0 } else { 0.0 };
    let by_class = classes.iter().zip(&start.1).map(|(m, m0)| share(*m, *m0)).collect();
    (share(total, start.0), by_class)
}

/// The wall parts of each group of the results.
pub(crate) fn groups(parts: &[String]) -> Vec<(String, Vec<usize>)> {
    let mut groups: Vec<(String, Vec<usize>)> = Vec::new();
    for (k, part) in parts.iter().enumerate() {
        let name = group(part);
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

/// Nothing is `0`, never `-0`: the sum of no numbers is the latter.
pub(crate) fn number(value: f64) -> String {
    format!("{:.9e}", value + 0.0)
}
