//! CSV in, CSV out, row by row.

use std::io::{self, Read, Write};

use csv::{ErrorKind, StringRecord};
use pendular_pair::{Bridge, Mate, OutOfRange};

use crate::status::{Answer, Trouble, columns};

/// The columns that describe a bridge and its gap.
pub(crate) const BRIDGE: [&str; 7] =
    ["r1", "r2", "theta1_deg", "theta2_deg", "gamma", "volume", "gap"];

/// Why a table could not be worked off.
#[derive(Debug, thiserror::Error)]
pub(crate) enum TableError {
    #[error("line {line}: the header must be {expected}, not {found}")]
    Header { line: u64, expected: String, found: String },
    #[error("line {line}: {found} fields where the header has {expected}")]
    Fields { line: u64, found: u64, expected: u64 },
    #[error("line {line}: the text is not UTF-8")]
    Text { line: u64 },
    #[error("reading: {0}")]
    Read(csv::Error),
    #[error("writing: {0}")]
    Write(io::Error),
}

impl TableError {
    /// Whether the input is to blame.
    pub(crate) fn is_malformed(&self) -> bool {
        !matches!(self, Self::Read(_) | Self::Write(_))
    }

    /// The error of a write.
    pub(crate) fn writing(error: csv::Error) -> Self {
        match error.into_kind() {
            ErrorKind::Io(error) => Self::Write(error),
            other => Self::Write(io::Error::other(format!("{other:?}"))),
        }
    }
}

impl From<csv::Error> for TableError {
    fn from(error: csv::Error) -> Self {
        let at = |pos: &Option<csv::Position>| pos.as_ref().map_or(0, csv::Position::line);
        match error.kind() {
            ErrorKind::UnequalLengths { pos, expected_len, len } => {
                Self::Fields { line: at(pos), found: *len, expected: *expected_len }
            }
            ErrorKind::Utf8 { pos, .. } => Self::Text { line: at(pos) },
            _ => Self::Read(error),
        }
    }
}

/// A table that is being answered.
pub(crate) struct Table<R, W: Write> {
    reader: csv::Reader<R>,
    writer: csv::Writer<W>,
}

impl<R: Read, W: Write> Table<R, W> {
    /// Reads and checks the header, and writes it with `added` columns.
    pub(crate) fn new(
        input: R,
        output: W,
        header: &[&str],
        added: &[&str],
    ) -> Result<Self, TableError> {
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(input);
        let found = reader.headers()?.clone();
        if found != *header {
            return Err(TableError::Header {
                line: found.position().map_or(1, csv::Position::line).max(1),
                expected: header.join(","),
                found: found.iter().collect::<Vec<_>>().join(","),
            });
        }
        let mut table = Self { reader, writer: csv::Writer::from_writer(output) };
        table.write(&found, added)?;
        Ok(table)
    }

    /// The next row; `None` at the end.
    pub(crate) fn read(&mut self) -> Result<Option<StringRecord>, TableError> {
        let mut row = StringRecord::new();
        Ok(self.reader.read_record(&mut row)?.then_some(row))
    }

    /// Writes a row with more fields behind it.
    pub(crate) fn write<S: AsRef<str>>(
        &mut self,
        row: &StringRecord,
        added: &[S],
    ) -> Result<(), TableError> {
        let fields = row.iter().chain(added.iter().map(AsRef::as_ref));
        self.writer.write_record(fields).map_err(TableError::writing)
    }

    /// Hands on what is still in the buffer.
    pub(crate) fn finish(mut self) -> Result<(), TableError> {
        self.writer.flush().map_err(TableError::Write)
    }
}

/// Answers every bridge of a table; `named` is the result's column.
pub(crate) fn answer_bridges(
    input: impl Read,
    output: impl Write,
    named: &str,
    mut answer: impl FnMut(&StringRecord) -> Answer,
) -> Result<(), TableError> {
    let mut table = Table::new(input, output, &BRIDGE, &[named, "status"])?;
    while let Some(row) = table.read()? {
        table.write(&row, &columns(answer(&row)))?;
    }
    table.finish()
}

/// A field as a number.
pub(crate) fn number(row: &StringRecord, column: usize) -> Result<f64, Trouble> {
    row.get(column).and_then(|field| field.parse().ok()).ok_or(Trouble::NotANumber)
}

/// The bridge of a row; the gap is not looked at.
pub(crate) fn bridge(row: &StringRecord) -> Result<Bridge, Trouble> {
    let mate = match row.get(1) {
        Some("") => f64::INFINITY,
        _ => number(row, 1)?,
    };
    let mate = if mate == f64::INFINITY { Mate::PLANE } else { Mate::Sphere { radius: mate } };
    let angles = [number(row, 2)?.to_radians(), number(row, 3)?.to_radians()];
    let (radius, tension, volume) = (number(row, 0)?, number(row, 4)?, number(row, 5)?);
    Bridge::new(radius, mate, volume, angles, tension).map_err(|_: OutOfRange| Trouble::Invalid)
}

/// The gap of a row, m.
pub(crate) fn gap(row: &StringRecord) -> Result<f64, Trouble> {
    let gap = number(row, 6)?;
    if gap.is_finite() { Ok(gap) } else { Err(Trouble::Invalid) }
}
