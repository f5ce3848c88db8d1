//! What can be wrong with a page or the folder behind it.

use std::path::PathBuf;

/// Why a page cannot be made.
#[derive(Debug, thiserror::Error)]
pub(crate) enum PageError {
    #[error("cannot read {}: {source}", path.display())]
    Read { path: PathBuf, source: std::io::Error },
    #[error("cannot write {}: {source}", path.display())]
    Write { path: PathBuf, source: std::io::Error },
    #[error("{}, line {line}, column {column}: not JSON: {source}", path.display())]
    Json { path: PathBuf, line: usize, column: usize, source: serde_json::Error },
    #[error("{}, line 1: allowed: an object, found {found}", path.display())]
    Summary { path: PathBuf, found: &'static str },
    #[error("{}, line {line}: {message}", path.display())]
    Csv { path: PathBuf, line: u64, message: String },
    #[error("{}: no column `{column}` to draw; allowed: {allowed}", path.display())]
    Column { path: PathBuf, column: String, allowed: String },
    #[error("a comparison needs at least one folder")]
    Nothing,
}
