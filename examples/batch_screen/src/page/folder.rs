//! A run's folder, read for its page.

use std::path::Path;

use serde_json::{Map, Value, json};

use super::error::PageError;
use super::replay::Replay;
use super::table::{Source, Table};

/// Tables of a run besides `retained.csv`; any of them may be missing.
pub(crate) const TABLES: [&str; 6] =
    ["liquid", "bridges", "partition", "pegging", "energy", "passages"];

/// Rows of a table that a chart can show; more are left out evenly.
const ROWS: usize = 3_000;
/// Passages are counted on the page: none may be left out below this number.
const PASSAGES: usize = 60_000;

/// What a page shows of a run.
pub(crate) struct Run {
    pub(crate) name: String,
    pub(crate) summary: Map<String, Value>,
    classes: Vec<String>,
    diameters: Vec<Option<f64>>,
    tables: Vec<(&'static str, Table)>,
    pub(crate) replay: Option<Replay>,
    notes: Vec<String>,
    /// Rows of `liquid_final.csv`: division, place, volume, in bridges, share.
    divisions: Vec<(String, String, f64, f64, f64)>,
    /// Every key of `scene.toml` with its value; older runs have no such file.
    scene: Option<Vec<(String, Value)>>,
}

impl Run {
    /// Reads a folder: `summary.json` and `retained.csv`, and of the other tables those in `wanted`
    /// that are there.
    ///
    /// # Errors
    ///
    /// Where a needed file is missing, or a file is broken before its last line.
    pub(crate) fn read(folder: &Path, wanted: &[&'static str]) -> Result<Self, PageError> {
        let name = folder.canonicalize().unwrap_or_else(|_| folder.to_path_buf());
        let name = name.file_name().map_or("run".into(), |n| n.to_string_lossy().into_owned());
        let summary = summary(&folder.join("summary.json"))?;
        let mut run = Self {
            name,
            summary,
            classes: Vec::new(),
            diameters: Vec::new(),
            tables: Vec::new(),
            replay: None,
            notes: Vec::new(),
            divisions: divisions(&folder.join("liquid_final.csv")),
            scene: None,
        };
        run.scene(&folder.join("scene.toml"))?;
        run.retained(&folder.join("retained.csv"))?;
        for name in TABLES.into_iter().filter(|name| wanted.contains(name)) {
            run.table(&folder.join(format!("{name}.csv")), name)?;
        }
        run.find_diameters();
        Ok(run)
    }

    /// Reads `replay.csv` too, where there is one.
    ///
    /// # Errors
    ///
    /// Where the file is broken before its last line.
    pub(crate) fn with_replay(mut self, folder: &Path) -> Result<Self, PageError> {
        let path = folder.join("replay.csv");
        if let Some(source) = Source::open(&path)? {
            self.replay = Some(Replay::read(&source, &self.classes)?);
            self.note_cut(&source, "replay.csv");
        }
        Ok(self)
    }

    /// Says something about the page itself.
    pub(crate) fn note(&mut self, text: String) {
        self.notes.push(text);
    }

    fn note_cut(&mut self, source: &Source, file: &str) {
        if source.cut {
            self.note(format!("The last line of {file} is not whole and was left out."));
        }
    }

    fn scene(&mut self, path: &Path) -> Result<(), PageError> {
        let text = match std::fs::read_to_string(path) {
            Ok(text) => text,
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(()),
            Err(source) => return Err(PageError::Read { path: path.to_path_buf(), source }),
        };
        match text.parse::<toml::Table>() {
            Ok(table) => {
                let mut all = Vec::new();
                leaves("", &toml::Value::Table(table), &mut all);
                self.scene = Some(all);
            }
            Err(_) => self.note("scene.toml is no TOML and was left out.".to_owned()),
        }
        Ok(())
    }

    /// The table that names the classes.
    fn retained(&mut self, path: &Path) -> Result<(), PageError> {
        let missing = || PageError::Read {
            path: path.to_path_buf(),
            source: std::io::ErrorKind::NotFound.into(),
        };
        let source = Source::open(path)?.ok_or_else(missing)?;
        let names = source.header()?;
        let ends = ["time_s", "total", "particles_above"];
        let found = (names.first(), names.get(1), names.last());
        if names.len() < 3
            || found != (Some(&ends[0].into()), Some(&ends[1].into()), Some(&ends[2].into()))
        {
            let message = "the header; allowed: time_s,total,<classes>,particles_above".to_owned();
            return Err(source.at(1, message));
        }
        self.classes = names[2..names.len() - 1].to_vec();
        self.keep(&source, "retained", ROWS)
    }

    fn table(&mut self, path: &Path, name: &'static str) -> Result<(), PageError> {
        let Some(source) = Source::open(path)? else { return Ok(()) };
        let names = source.header()?;
        if !names.iter().any(|known| known == "time_s") {
            return Err(source.at(1, "no column `time_s`".into()));
        }
        self.keep(&source, name, if name == "passages" { PASSAGES } else { ROWS })
    }

    fn keep(&mut self, source: &Source, name: &'static str, most: usize) -> Result<(), PageError> {
        let mut table = Table::read(source, &self.classes)?;
        self.note_cut(source, &format!("{name}.csv"));
        let before = table.rows;
        table.thin(most);
        let kept = table.columns.first().map_or(0, Vec::len);
        if kept < before {
            self.note(format!("{name}.csv has {before} rows, of which {kept} are on this page."));
        }
        self.tables.push((name, table));
        Ok(())
    }

    /// Diameters of the classes, mm: from the summary, else from the first passage of each.
    fn find_diameters(&mut self) {
        let listed = self.summary.get("classes").and_then(Value::as_array);
        let passages = self.tables.iter().find(|(name, _)| *name == "passages").map(|(_, t)| t);
        let find = |(k, name): (usize, &String)| {
            let listed = listed.into_iter().flatten();
            let entry = listed.into_iter().find(|c| c["name"].as_str() == Some(name));
            let known = entry.and_then(|class| class["diameter_mm"].as_f64());
            known.or_else(|| {
                let (class, diameter) =
                    (passages?.column("class")?, passages?.column("diameter_m")?);
                let row = class.iter().position(|c| *c == k as f64)?;
                diameter.get(row).map(|d| 1e3 * d)
            })
        };
        self.diameters = self.classes.iter().enumerate().map(find).collect();
    }

    /// The columns of `retained.csv` that are shares: the total and every class.
    pub(crate) fn shares(&self) -> Vec<&str> {
        std::iter::once("total").chain(self.classes.iter().map(String::as_str)).collect()
    }

    /// Times, s, and one of those shares.
    pub(crate) fn retained_over_time(&self, column: &str) -> Option<(&[f64], &[f64])> {
        let (_, table) = self.tables.iter().find(|(name, _)| *name == "retained")?;
        self.shares().contains(&column).then_some(())?;
        Some((table.column("time_s")?, table.column(column)?))
    }

    /// Everything for the page's program.
    pub(crate) fn json(&self) -> Value {
        let classes: Vec<Value> = self
            .classes
            .iter()
            .zip(&self.diameters)
            .map(|(name, diameter)| json!({ "name": name, "diameter_mm": diameter }))
            .collect();
        let tables: Map<String, Value> =
            self.tables.iter().map(|(name, table)| ((*name).to_owned(), table.json())).collect();
        let replay = self.replay.as_ref().filter(|replay| replay.len() > 0);
        json!({
            "name": self.name,
            "summary": self.summary,
            "classes": classes,
            "tables": tables,
            "replay": replay.map(|replay| replay.json(self.classes.len())),
            "liquid_final": self.divisions,
            "scene": self.scene,
            "notes": self.notes,
        })
    }
}

/// Every single value and list of them, by a key such as `classes[0].count`.
fn leaves(key: &str, value: &toml::Value, all: &mut Vec<(String, Value)>) {
    match value {
        toml::Value::Table(table) => {
            for (name, inner) in table {
                let key = if key.is_empty() { name.clone() } else { format!("{key}.{name}") };
                leaves(&key, inner, all);
            }
        }
        toml::Value::Array(list) if list.iter().any(toml::Value::is_table) => {
            list.iter().enumerate().for_each(|(k, one)| leaves(&format!("{key}[{k}]"), one, all));
        }
        other => all.push((key.to_owned(), json!(other))),
    }
}

/// The liquid at the end; nothing where a run has not come to it, or the table is not whole.
fn divisions(path: &Path) -> Vec<(String, String, f64, f64, f64)> {
    let rows = |mut reader: csv::Reader<std::fs::File>| reader.deserialize().collect();
    csv::Reader::from_path(path).and_then(rows).unwrap_or_default()
}

fn summary(path: &Path) -> Result<Map<String, Value>, PageError> {
    let text = std::fs::read(path)
        .map_err(|source| PageError::Read { path: path.to_path_buf(), source })?;
    let path = path.to_path_buf();
    let value: Value = match serde_json::from_slice(&text) {
        Ok(value) => value,
        Err(source) => {
            let (line, column) = (source.line(), source.column());
            return Err(PageError::Json { path, line, column, source });
        }
    };
    let found = match value {
        Value::Object(map) => return Ok(map),
        Value::Null => "null",
        Value::Bool(_) => "true or false",
        Value::Number(_) => "a number",
        Value::String(_) => "a text",
        Value::Array(_) => "a list",
    };
    Err(PageError::Summary { path, found })
}
