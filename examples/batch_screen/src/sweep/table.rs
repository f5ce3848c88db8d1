//! The table of a sweep: a row per run, written anew after each, so that it is always whole.

use std::path::{Path, PathBuf};

use serde_json::Value;

use super::plan::{Plan, Planned};
use crate::error::RunError;
use crate::replace::replace;

/// How a run of a sweep stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Status {
    Waiting,
    Interrupted,
    Finished,
    Failed,
}

impl Status {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Waiting => "waiting",
            Self::Interrupted => "interrupted",
            Self::Finished => "finished",
            Self::Failed => "failed",
        }
    }
}

/// Columns that come from a run's summary, and where they stand in it.
const RESULTS: [(&str, &str); 9] = [
    ("time_s", "/time_s"),
    ("retained", "/fraction_retained/total"),
    ("cut_size_mm", "/partition/cut_size_mm"),
    ("imperfection", "/partition/imperfection"),
    ("liquid_imbalance", "/liquid_imbalance"),
    ("largest_overlap", "/largest_overlap"),
    ("escaped", "/escaped"),
    ("steps", "/steps"),
    ("wall_time_s", "/wall_time_s"),
];

/// Columns that tell how a run went.
const OUTCOME: [&str; 4] = ["status", "exit", "folder", "message"];

fn is_result(column: &str) -> bool {
    RESULTS.iter().any(|(name, _)| *name == column) || column.starts_with("retained ")
}

/// The summary in the folder of a run; null where there is none.
pub(super) fn summary(folder: &Path) -> Value {
    let text = std::fs::read(folder.join("summary.json")).unwrap_or_default();
    serde_json::from_slice(&text).unwrap_or_default()
}

/// `sweep.csv`.
pub(crate) struct Sheet {
    path: PathBuf,
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
    planned: usize,
}

impl Sheet {
    /// The table of a plan; rows of an earlier one that the plan has no more stay below.
    pub(crate) fn new(folder: &Path, plan: &Plan) -> Result<Self, RunError> {
        let path = folder.join("sweep.csv");
        let mut columns = vec!["run".to_owned()];
        // A seed that a row sets stands where every run's seed does.
        columns.extend(plan.keys.iter().filter(|key| *key != "seed").cloned());
        columns.extend(["seed", "status", "exit", "folder"].map(str::to_owned));
        columns.extend(RESULTS[..2].iter().map(|(name, _)| (*name).to_owned()));
        columns.extend(plan.classes.iter().map(|class| format!("retained {class}")));
        columns.extend(RESULTS[2..].iter().map(|(name, _)| (*name).to_owned()));
        columns.push("message".to_owned());
        let mut sheet = Self { path, columns, rows: Vec::new(), planned: plan.runs.len() };
        let (header, old) = sheet.earlier()?;
        for name in &header {
            if !sheet.columns.contains(name) {
                sheet.columns.push(name.clone());
            }
        }
        let found = |row: &csv::StringRecord, name: &str| {
            let column = header.iter().position(|known| known == name);
            column.and_then(|k| row.get(k)).unwrap_or_default().to_owned()
        };
        for (row, run) in plan.runs.iter().enumerate() {
            sheet.rows.push(vec![String::new(); sheet.columns.len()]);
            sheet.describe(row, run);
            if let Some(before) = old.iter().find(|row| row.get(0) == Some(&run.name)) {
                sheet.recall(row, |name| found(before, name));
            }
        }
        for row in &old {
            if !plan.runs.iter().any(|run| row.get(0) == Some(&run.name)) {
                sheet.rows.push(sheet.columns.iter().map(|name| found(row, name)).collect());
            }
        }
        Ok(sheet)
    }

    /// Header and rows of the table as it is on disk; none where there is no table.
    fn earlier(&self) -> Result<(Vec<String>, Vec<csv::StringRecord>), RunError> {
        let fail = |e: csv::Error| RunError::Table {
            path: self.path.clone(),
            source: std::io::Error::other(e.to_string()),
        };
        if !self.path.exists() {
            return Ok((Vec::new(), Vec::new()));
        }
        let mut reader = csv::Reader::from_path(&self.path).map_err(fail)?;
        let header: Vec<String> =
            reader.headers().map_err(fail)?.iter().map(str::to_owned).collect();
        if header.first().map(String::as_str) != Some("run") {
            let source = std::io::Error::other("it is no table of a sweep: move it away");
            return Err(RunError::Table { path: self.path.clone(), source });
        }
        let rows = reader.records().collect::<Result<_, _>>().map_err(fail)?;
        Ok((header, rows))
    }

    fn put(&mut self, row: usize, name: &str, text: impl Into<String>) {
        if let Some(column) = self.columns.iter().position(|known| known == name) {
            self.rows[row][column] = text.into();
        }
    }

    fn describe(&mut self, row: usize, run: &Planned) {
        self.put(row, "run", &run.name);
        for set in &run.sets {
            let text = match &set.value {
                toml::Value::String(text) => text.clone(),
                other => other.to_string(),
            };
            self.put(row, &set.key, text);
        }
        self.put(row, "seed", run.seed.to_string());
        self.put(row, "status", Status::Waiting.name());
    }

    /// Takes over from an earlier table that a run has failed: its folder may not tell. What it
    /// failed with must still be set; results are read from the folder anew.
    fn recall(&mut self, row: usize, before: impl Fn(&str) -> String) {
        let is_set = |name: &&String| !(OUTCOME.contains(&name.as_str()) || is_result(name));
        let same =
            self.columns.iter().filter(is_set).all(|name| before(name) == self.cell(row, name));
        if same && before("status") == Status::Failed.name() {
            OUTCOME.iter().for_each(|name| self.put(row, name, before(name)));
        }
    }

    /// Notes how a run stands, with the results in its folder.
    pub(crate) fn note(
        &mut self,
        row: usize,
        folder: &Path,
        status: Status,
        exit: Option<u8>,
        message: &str,
    ) {
        self.put(row, "status", status.name());
        self.put(row, "exit", exit.map_or(String::new(), |code| code.to_string()));
        self.put(row, "folder", folder.to_string_lossy());
        self.put(row, "message", message.split_whitespace().collect::<Vec<_>>().join(" "));
        let results =
            self.columns.iter().zip(&mut self.rows[row]).filter(|(name, _)| is_result(name));
        results.for_each(|(_, cell)| cell.clear());
        let summary = summary(folder);
        // What a folder holds of a run that failed may be of another one, or up to the failure.
        if matches!(status, Status::Waiting | Status::Failed) || summary.is_null() {
            return;
        }
        for (name, pointer) in RESULTS {
            let value = summary.pointer(pointer).filter(|value| !value.is_null());
            self.put(row, name, value.map_or(String::new(), Value::to_string));
        }
        if let Some(classes) = summary["fraction_retained"]["by_class"].as_object() {
            for (class, value) in classes {
                self.put(row, &format!("retained {class}"), value.to_string());
            }
        }
    }

    /// A cell of a row by the column's name.
    pub(crate) fn cell(&self, row: usize, name: &str) -> &str {
        let column = self.columns.iter().position(|known| known == name);
        column.and_then(|k| self.rows.get(row)?.get(k)).map_or("", String::as_str)
    }

    /// Planned runs of a status.
    pub(crate) fn count(&self, status: Status) -> usize {
        (0..self.planned).filter(|&row| self.cell(row, "status") == status.name()).count()
    }

    /// Writes the table beside its place and moves it there.
    pub(crate) fn write(&self) -> Result<(), RunError> {
        let fail = |source| RunError::Write { path: self.path.clone(), source };
        let mut writer = csv::Writer::from_writer(Vec::new());
        let all = std::iter::once(&self.columns).chain(&self.rows);
        for row in all {
            writer.write_record(row).map_err(|e| fail(std::io::Error::other(e.to_string())))?;
        }
        let text = writer.into_inner().map_err(|e| fail(e.into_error()))?;
        replace(&self.path, &text).map_err(fail)
    }
}
