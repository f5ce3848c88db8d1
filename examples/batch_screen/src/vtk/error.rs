//! What can be wrong with a ParaView series.

use std::path::PathBuf;

/// Why a frame or a series cannot be written.
#[derive(Debug, thiserror::Error)]
pub(crate) enum VtkError {
    #[error("cannot read {}: {source}", path.display())]
    Read { path: PathBuf, source: std::io::Error },
    #[error("cannot write {}: {source}", path.display())]
    Write { path: PathBuf, source: std::io::Error },
    #[error("{}, line {line}: `{text}` is not a line of a series that this program wrote", path.display())]
    Series { path: PathBuf, line: usize, text: String },
    #[error("{array}, entry {index}, is {value}; allowed: a finite number within ±3.4e38")]
    Value { array: &'static str, index: usize, value: f64 },
    #[error("triangle {triangle} of the walls names point {point}; allowed: below {points}")]
    Triangle { triangle: usize, point: u32, points: usize },
    #[error("{films} film thicknesses for {triangles} triangles of the walls; allowed: one each")]
    Films { films: usize, triangles: usize },
    #[error("time {time} s of a frame; allowed: finite and after {last} s, the last frame's")]
    Time { time: f64, last: f64 },
}
