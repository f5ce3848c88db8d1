//! A sweep file: a base scene and what is to be varied in it.

use std::path::{Path, PathBuf};

use serde::Deserialize;
use toml::{Table, Value};

use crate::document::{self, Set};
use crate::error::SceneError;
use crate::place::Origin;
use crate::scene::Scene;
use crate::{builtin, commands};

/// More runs are taken for a mistake.
const MOST: usize = 10_000;
/// Longest name of a run that is made from its values.
const LONGEST: usize = 120;

/// The file as it is written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SweepFile {
    /// Base scene: a file, relative to this one, or the name of a built-in scene.
    scene: String,
    /// Simulated time of every run, s; the scene's where it is left out.
    #[serde(default)]
    time: Option<f64>,
    /// Seeds of every run; the scene's where they are left out.
    #[serde(default)]
    seeds: Vec<u64>,
    /// Lists of values by dotted key: every combination is a run.
    #[serde(default)]
    grid: Table,
    /// Runs one by one: values by dotted key, and a `name` if wanted.
    #[serde(default)]
    rows: Vec<Table>,
}

/// One run of a sweep.
#[derive(Debug, Clone)]
pub(crate) struct Planned {
    /// Name of its folder and of its row.
    pub(crate) name: String,
    pub(crate) sets: Vec<Set>,
    pub(crate) seed: u64,
    pub(crate) time: f64,
    /// Text of its scene.
    pub(crate) text: String,
}

/// All runs of a sweep.
#[derive(Debug)]
pub(crate) struct Plan {
    /// Base scene as `run` takes it.
    pub(crate) scene: String,
    /// Name of the sweep: that of its file.
    pub(crate) name: String,
    /// Keys that are varied, in the order of the table's columns.
    pub(crate) keys: Vec<String>,
    /// Size classes of the base scene.
    pub(crate) classes: Vec<String>,
    pub(crate) runs: Vec<Planned>,
}

/// A name, if it was given one, and what it sets.
type Variant = (Option<String>, Vec<Set>);

impl Plan {
    /// Reads a sweep file and checks every scene that follows from it.
    pub(crate) fn read(path: &Path) -> Result<Self, SceneError> {
        let unreadable = |source| SceneError::Unreadable { file: path.to_path_buf(), source };
        let text = std::fs::read_to_string(path).map_err(unreadable)?;
        let origin = Origin::new(path, &text);
        let file: SweepFile = document::read(&text, &origin)?;
        let scene = base(&file.scene, path);
        let text = commands::text(&scene).map_err(|source| {
            let (place, key) = (origin.place("scene"), "scene".to_owned());
            SceneError::At { place, key, source: Box::new(source) }
        })?;
        let first = Scene::parse(&text, Path::new(&scene))?;
        let variants = variants(&file, &origin)?;
        let mut keys: Vec<String> = Vec::new();
        for set in variants.iter().flat_map(|(_, sets)| sets) {
            if !keys.contains(&set.key) {
                keys.push(set.key.clone());
            }
        }
        let mut plan = Self {
            name: path.file_stem().map_or("sweep".into(), |s| s.to_string_lossy().into_owned()),
            classes: first.classes.iter().map(|class| class.name.clone()).collect(),
            scene,
            keys,
            runs: Vec::new(),
        };
        for (name, sets) in variants {
            plan.add(&text, &file, &origin, name, &sets)?;
        }
        Ok(plan)
    }

    /// Adds the runs of one variant, one a seed.
    fn add(
        &mut self,
        text: &str,
        file: &SweepFile,
        sweep: &Origin,
        name: Option<String>,
        sets: &[Set],
    ) -> Result<(), SceneError> {
        let mut origin = Origin::new(Path::new(&self.scene), text);
        let text = document::with(text, &mut origin, sets)?;
        if file.time.is_some() {
            origin.give("time", sweep.place("time"));
        }
        let mut scene = Scene::read(&text, origin)?;
        scene.time = file.time.unwrap_or(scene.time);
        crate::check::check(&scene)?;
        let own = [scene.seed];
        let seeds = if file.seeds.is_empty() { &own[..] } else { &file.seeds };
        for &seed in seeds {
            let name = named(name.as_deref(), sets, (!file.seeds.is_empty()).then_some(seed));
            if self.runs.iter().any(|run| run.name == name) {
                let key = if file.rows.is_empty() { "seeds" } else { "rows" };
                let (place, key) = (sweep.place(key), key.to_owned());
                let allowed = "runs that differ".to_owned();
                let value = format!("a second run `{name}`");
                return Err(SceneError::Value { place, key, value, allowed });
            }
            let (sets, text, time) = (sets.to_vec(), text.clone(), scene.time);
            self.runs.push(Planned { name, sets, seed, time, text });
        }
        Ok(())
    }
}

/// The base scene as `run` takes it: built-in, or a path that holds from here.
fn base(scene: &str, sweep: &Path) -> String {
    if builtin::find(scene).is_some() {
        return scene.to_owned();
    }
    let folder = sweep.parent().map(Path::to_path_buf).unwrap_or_default();
    folder.join(PathBuf::from(scene)).to_string_lossy().into_owned()
}

fn wrong(origin: &Origin, key: &str, value: &str, allowed: &str) -> SceneError {
    let (value, allowed) = (value.to_owned(), allowed.to_owned());
    SceneError::Value { place: origin.place(key), key: key.to_owned(), value, allowed }
}

/// What the grid and the rows ask for, in that order.
fn variants(file: &SweepFile, origin: &Origin) -> Result<Vec<Variant>, SceneError> {
    let mut all = Vec::new();
    if !file.grid.is_empty() || file.rows.is_empty() {
        all.extend(grid(&file.grid, origin)?.into_iter().map(|sets| (None, sets)));
    }
    for (k, row) in file.rows.iter().enumerate() {
        all.push(one_row(row, &format!("rows[{k}]"), origin)?);
    }
    once(file, &all)?;
    let runs = all.len() * file.seeds.len().max(1);
    if runs > MOST {
        let key = if file.rows.is_empty() { "grid" } else { "rows" };
        return Err(wrong(origin, key, &format!("{runs} runs"), &format!("up to {MOST}")));
    }
    Ok(all)
}

/// What the file sets for all runs cannot be varied too: the run would not be what its name says.
fn once(file: &SweepFile, variants: &[Variant]) -> Result<(), SceneError> {
    let top = |key: &str| match key {
        "time" => file.time.map(|_| "time"),
        "seed" => (!file.seeds.is_empty()).then_some("seeds"),
        _ => None,
    };
    let twice = |set: &Set| top(&set.key).map(|other| (set.clone(), other));
    match variants.iter().flat_map(|(_, sets)| sets).find_map(twice) {
        None => Ok(()),
        Some((Set { key, value, place }, other)) => {
            let allowed = format!("only where `{other}` at the top of the file is left out");
            Err(SceneError::Value { place, key, value: value.to_string(), allowed })
        }
    }
}

/// Every combination of the lists of a grid, the last key the fastest.
fn grid(table: &Table, origin: &Origin) -> Result<Vec<Vec<Set>>, SceneError> {
    let mut combinations: Vec<Vec<Set>> = vec![Vec::new()];
    for (key, value) in flat("", table) {
        let at = format!("grid.{key}");
        let list = match value {
            Value::Array(list) if !list.is_empty() => list,
            other => {
                let allowed = "a list of at least one value";
                return Err(wrong(origin, &at, &other.to_string(), allowed));
            }
        };
        if combinations.len() * list.len() > MOST {
            return Err(wrong(origin, &at, "this list", &format!("up to {MOST} runs in all")));
        }
        let set = |(k, value): (usize, &Value)| Set {
            key: key.clone(),
            value: value.clone(),
            place: origin.place(&format!("{at}[{k}]")),
        };
        let sets: Vec<Set> = list.iter().enumerate().map(set).collect();
        combinations = combinations
            .iter()
            .flat_map(|before| {
                sets.iter().map(|one| [before.as_slice(), std::slice::from_ref(one)].concat())
            })
            .collect();
    }
    Ok(combinations)
}

fn one_row(row: &Table, at: &str, origin: &Origin) -> Result<Variant, SceneError> {
    let mut row = row.clone();
    let name = match row.remove("name") {
        None => None,
        Some(Value::String(name)) if allowed_name(&name) => Some(name),
        Some(other) => {
            let allowed = "letters, digits and . _ = , + -, but not `beds`";
            return Err(wrong(origin, &format!("{at}.name"), &other.to_string(), allowed));
        }
    };
    let set = |(key, value): (String, Value)| {
        let place = origin.place(&format!("{at}.{key}"));
        Set { key, value, place }
    };
    Ok((name, flat("", &row).into_iter().map(set).collect()))
}

/// Tables inside a table, as dotted keys.
fn flat(prefix: &str, table: &Table) -> Vec<(String, Value)> {
    let one = |(key, value): (&String, &Value)| {
        let key = if prefix.is_empty() { key.clone() } else { format!("{prefix}.{key}") };
        match value {
            Value::Table(inner) => flat(&key, inner),
            value => vec![(key, value.clone())],
        }
    };
    table.iter().flat_map(one).collect()
}

fn is_plain(c: char) -> bool {
    c.is_ascii_alphanumeric() || "._=,+-".contains(c)
}

fn allowed_name(name: &str) -> bool {
    !name.is_empty()
        && !name.starts_with(['.', '-'])
        && name.chars().all(is_plain)
        && name != "beds"
}

/// A run's name: the given one, or one made of its values, so that the same values have the same
/// name when the sweep grows.
fn named(given: Option<&str>, sets: &[Set], seed: Option<u64>) -> String {
    let value = |set: &Set| match &set.value {
        Value::String(text) => text.clone(),
        Value::Array(list) => list.iter().map(Value::to_string).collect::<Vec<_>>().join(","),
        other => other.to_string(),
    };
    let of_sets = || {
        let parts: Vec<String> = sets.iter().map(|s| format!("{}={}", s.key, value(s))).collect();
        if parts.is_empty() { "base".to_owned() } else { parts.join("_") }
    };
    let mut name = given.map_or_else(of_sets, str::to_owned);
    if let Some(seed) = seed {
        name += &format!("_seed={seed}");
    }
    let exact = name.clone();
    name = name.replace('[', ".").chars().filter(|&c| is_plain(c)).collect();
    if name.len() > LONGEST || (name.len() + 8 < exact.len()) {
        name.truncate(LONGEST - 9);
        name += &format!("_{:08x}", crc32fast::hash(exact.as_bytes()));
    }
    name
}
