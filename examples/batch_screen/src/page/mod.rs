//! Pages that show runs: one HTML file each, with its data, styles and program inside, for any
//! browser without a network.

mod embed;
mod error;
mod folder;
mod replay;
mod svg;
mod table;

use std::path::{Path, PathBuf};

use serde_json::json;

use self::embed::{html, script_json};
pub(crate) use self::error::PageError;
use self::folder::{Run, TABLES};
use crate::replace::replace;

/// Bytes that a page may take; moments of the replay are left out beyond it.
const PAGE: usize = 12_000_000;

/// Tables that a comparison overlays.
const COMPARED: [&str; 3] = ["liquid", "bridges", "partition"];

const STYLE: &str = include_str!("style.css");
const PROGRAM: [&str; 7] = [
    include_str!("text.js"),
    include_str!("chart.js"),
    include_str!("stack.js"),
    include_str!("replay.js"),
    include_str!("scene.js"),
    include_str!("report.js"),
    include_str!("compare.js"),
];

/// Makes `report.html` in a run's folder from the tables there, and gives its path.
///
/// # Errors
///
/// Where `summary.json` or `retained.csv` is missing, a file is broken before its last line, or the
/// page cannot be written.
pub(crate) fn report(folder: &Path) -> Result<PathBuf, PageError> {
    let mut run = Run::read(folder, &TABLES)?.with_replay(folder)?;
    if let Some(mut replay) = run.replay.take() {
        let rest = page("report", "", &[&run]).len();
        replay.thin(PAGE.saturating_sub(rest + 50_000));
        if replay.len() < replay.found {
            let (kept, found) = (replay.len(), replay.found);
            run.note(format!(
                "The replay shows {kept} of the {found} moments of replay.csv, to keep this page small."
            ));
        }
        run.replay = Some(replay);
    }
    let title = run.summary.get("title").and_then(serde_json::Value::as_str);
    let title = title.unwrap_or(&run.name).to_owned();
    let path = folder.join("report.html");
    write(&path, &page("report", &title, &[&run]))?;
    Ok(path)
}

/// Makes one page at `out` that lays the runs of several folders over one another.
///
/// # Errors
///
/// Where there is no folder, one lacks `summary.json` or `retained.csv`, a file is broken before its
/// last line, or the page cannot be written.
pub(crate) fn compare(folders: &[PathBuf], out: &Path) -> Result<(), PageError> {
    let runs = several(folders)?;
    let runs: Vec<&Run> = runs.iter().collect();
    write(out, &page("compare", &format!("Comparison of {} runs", runs.len()), &runs))
}

/// Draws one column of `retained.csv` of several runs over time as a plain SVG at `out`.
///
/// # Errors
///
/// As [`compare`], and where a run has no such column.
pub(crate) fn drawing(folders: &[PathBuf], column: &str, out: &Path) -> Result<(), PageError> {
    let runs = several(folders)?;
    let mut lines = Vec::new();
    for (run, folder) in runs.iter().zip(folders) {
        let missing = || PageError::Column {
            path: folder.join("retained.csv"),
            column: column.to_owned(),
            allowed: run.shares().join(", "),
        };
        let (x, y) = run.retained_over_time(column).ok_or_else(missing)?;
        lines.push(svg::Line { name: &run.name, x, y });
    }
    let of = if column == "total" { String::new() } else { format!(" of {column}") };
    write(out, &svg::draw(&lines, &format!("retained{of}, %")))
}

/// Reads several runs, each with a name of its own.
fn several(folders: &[PathBuf]) -> Result<Vec<Run>, PageError> {
    if folders.is_empty() {
        return Err(PageError::Nothing);
    }
    let mut runs = Vec::new();
    for folder in folders {
        runs.push(Run::read(folder, &COMPARED)?);
    }
    // Folders of the same name are told apart by their paths.
    let names: Vec<String> = runs.iter().map(|run| run.name.clone()).collect();
    for ((run, folder), name) in runs.iter_mut().zip(folders).zip(&names) {
        if names.iter().filter(|other| *other == name).count() > 1 {
            run.name = folder.display().to_string();
        }
    }
    Ok(runs)
}

fn page(kind: &str, title: &str, runs: &[&Run]) -> String {
    let data = json!({
        "kind": kind,
        "title": title,
        "program": format!("{} {}", env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION")),
        "runs": runs.iter().map(|run| run.json()).collect::<Vec<_>>(),
    });
    let data = script_json(&data.to_string());
    let (title, program) = (html(title), PROGRAM.concat());
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
         style-src 'unsafe-inline'; script-src 'unsafe-inline'; base-uri 'none'; form-action 'none'\">\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
         <main id=\"page\"><h1>{title}</h1>\n\
         <noscript><p>The charts of this page are drawn by a small program inside it: let scripts run \
         to see them. The numbers are in the tables beside this file.</p></noscript></main>\n\
         <script type=\"application/json\" id=\"data\">{data}</script>\n\
         <script>\n(() => {{\n'use strict';\n{program}}})();\n</script>\n</body>\n</html>\n"
    )
}

fn write(path: &Path, text: &str) -> Result<(), PageError> {
    let wrong = |source| PageError::Write { path: path.to_path_buf(), source };
    replace(path, text.as_bytes()).map_err(wrong)
}
