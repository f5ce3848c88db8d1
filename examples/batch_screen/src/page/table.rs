//! Tables of a run as columns of numbers. A last line without its end, as a killed run leaves it,
//! is left out.

use std::path::Path;

use serde_json::{Value, json};

use super::embed::base64;
use super::error::PageError;

/// A CSV file, cut after its last whole line.
pub(crate) struct Source<'a> {
    path: &'a Path,
    bytes: Vec<u8>,
    /// Whether a broken last line was cut off.
    pub(crate) cut: bool,
}

impl<'a> Source<'a> {
    /// Reads a file; nothing where there is none.
    ///
    /// # Errors
    ///
    /// Where there is a file and it cannot be read.
    pub(crate) fn open(path: &'a Path) -> Result<Option<Self>, PageError> {
        let mut bytes = match std::fs::read(path) {
            Ok(bytes) => bytes,
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(source) => return Err(PageError::Read { path: path.to_path_buf(), source }),
        };
        let whole = bytes.iter().rposition(|b| *b == b'\n').map_or(0, |end| end + 1);
        let cut = whole < bytes.len();
        bytes.truncate(whole);
        Ok(Some(Self { path, bytes, cut }))
    }

    /// Names of the columns.
    ///
    /// # Errors
    ///
    /// Where there is no header, or it is not UTF-8.
    pub(crate) fn header(&self) -> Result<Vec<String>, PageError> {
        let mut reader = csv::Reader::from_reader(self.bytes.as_slice());
        let header = reader.headers().map_err(|e| self.csv(&e))?;
        if header.is_empty() {
            return Err(self.at(1, "no header".into()));
        }
        Ok(header.iter().map(str::to_owned).collect())
    }

    /// Gives each row after the header to `each`; what that says is told with the row's line.
    ///
    /// # Errors
    ///
    /// Where a row has another number of cells than the header, is not UTF-8, or `each` says so.
    pub(crate) fn rows(
        &self,
        mut each: impl FnMut(&csv::StringRecord) -> Result<(), String>,
    ) -> Result<(), PageError> {
        let mut reader = csv::Reader::from_reader(self.bytes.as_slice());
        let mut record = csv::StringRecord::new();
        while reader.read_record(&mut record).map_err(|e| self.csv(&e))? {
            each(&record).map_err(|message| self.at(self.line(record.position()), message))?;
        }
        Ok(())
    }

    /// An error at a line of this file.
    pub(crate) fn at(&self, line: u64, message: String) -> PageError {
        PageError::Csv { path: self.path.to_path_buf(), line, message }
    }

    /// The line of a record: what the reader gives may be an empty line before it.
    fn line(&self, position: Option<&csv::Position>) -> u64 {
        let start = position.map_or(0, |p| p.byte() as usize).min(self.bytes.len());
        let empty = self.bytes[start..].iter().take_while(|b| matches!(b, b'\n' | b'\r')).count();
        let ends = self.bytes[..start + empty].iter().filter(|b| **b == b'\n');
        1 + ends.count() as u64
    }

    fn csv(&self, error: &csv::Error) -> PageError {
        let line = self.line(error.position());
        let message = match error.kind() {
            csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
                format!("{len} cells; allowed: {expected_len}, as in the header")
            }
            csv::ErrorKind::Utf8 { .. } => "not UTF-8".to_owned(),
            other => format!("{other:?}"),
        };
        self.at(line, message)
    }
}

/// Index of a class from a cell: its name, or its number.
pub(crate) fn class(cell: &str, classes: &[String]) -> Result<usize, String> {
    let known = classes.iter().position(|name| name == cell);
    let known = known.or_else(|| cell.parse().ok().filter(|k| *k < classes.len()));
    known.ok_or_else(|| format!("class `{cell}`; allowed: {}", classes.join(", ")))
}

/// A number; an empty cell is one that is not defined.
pub(crate) fn number(cell: &str, column: &str) -> Result<f64, String> {
    match cell.trim() {
        "" => Ok(f64::NAN),
        text => {
            text.parse().map_err(|_| format!("`{cell}` in column `{column}`; allowed: a number"))
        }
    }
}

/// Columns of numbers.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Table {
    pub(crate) names: Vec<String>,
    pub(crate) columns: Vec<Vec<f64>>,
    /// Rows of the file, of which `columns` may hold fewer after `thin`.
    pub(crate) rows: usize,
}

impl Table {
    /// Reads all rows; a column called `class` becomes indices into `classes`.
    ///
    /// # Errors
    ///
    /// Where a cell is not what its column holds.
    pub(crate) fn read(source: &Source, classes: &[String]) -> Result<Self, PageError> {
        let names = source.header()?;
        let mut columns: Vec<Vec<f64>> = vec![Vec::new(); names.len()];
        source.rows(|record| {
            for ((cell, name), column) in record.iter().zip(&names).zip(&mut columns) {
                column.push(match name.as_str() {
                    "class" => class(cell, classes)? as f64,
                    _ => number(cell, name)?,
                });
            }
            Ok(())
        })?;
        let rows = columns.first().map_or(0, Vec::len);
        Ok(Self { names, columns, rows })
    }

    /// Keeps at most about `most` rows, evenly spaced, the first and the last among them.
    pub(crate) fn thin(&mut self, most: usize) {
        let step = self.rows.div_ceil(most.max(1)).max(1);
        if step == 1 {
            return;
        }
        let last = self.rows - 1;
        for column in &mut self.columns {
            let mut row = 0..;
            column
                .retain(|_| row.next().is_some_and(|k: usize| k.is_multiple_of(step) || k == last));
        }
    }

    /// Names, and the columns one after the other as 32-bit floats.
    pub(crate) fn json(&self) -> Value {
        let rows = self.columns.first().map_or(0, Vec::len);
        let bytes: Vec<u8> =
            self.columns.iter().flatten().flat_map(|v| (*v as f32).to_le_bytes()).collect();
        json!({ "names": self.names, "rows": rows, "data": base64(&bytes) })
    }

    /// A column by name.
    pub(crate) fn column(&self, name: &str) -> Option<&[f64]> {
        let k = self.names.iter().position(|known| known == name)?;
        self.columns.get(k).map(Vec::as_slice)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<(Table, bool), PageError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.csv");
        std::fs::write(&path, text).unwrap();
        let source = Source::open(&path)?.unwrap();
        let classes = ["5 mm".to_owned(), "7".to_owned()];
        Ok((Table::read(&source, &classes)?, source.cut))
    }

    #[test]
    fn columns_by_name_with_empty_cells_and_classes() {
        let (table, cut) = read("time_s,class,d\n0.5,5 mm,\n1,7,2e-3\n1.5,0,1\n").unwrap();
        assert!(!cut);
        assert_eq!(table.column("time_s").unwrap(), [0.5, 1.0, 1.5]);
        // A name wins over a number: class `7` is the second one.
        assert_eq!(table.column("class").unwrap(), [0.0, 1.0, 0.0]);
        let d = table.column("d").unwrap();
        assert!(d[0].is_nan() && d[1..] == [2e-3, 1.0]);
        assert!(table.column("x").is_none());
    }

    #[test]
    fn broken_last_lines_are_left_out() {
        for tail in ["1", "1.0,", "1.0,2", "\"1"] {
            let (table, cut) = read(&format!("a,b\n0,1\n{tail}")).unwrap();
            assert!(cut, "{tail}");
            assert_eq!(table.columns, [[0.0], [1.0]], "{tail}");
        }
        let (table, _) = read("a,b\n").unwrap();
        assert_eq!((table.rows, table.columns.len()), (0, 2));
    }

    #[test]
    fn what_is_broken_is_told_with_its_line() {
        let cases = [
            ("", "line 1: no header"),
            ("a,b", "line 1: no header"),
            ("a,b\n1,2\n3\n", "line 3: 1 cells; allowed: 2, as in the header"),
            ("a,b\n1,2\n\n3,x\n", "line 4: `x` in column `b`; allowed: a number"),
            ("class\n9 mm\n", "line 2: class `9 mm`; allowed: 5 mm, 7"),
        ];
        for (text, told) in cases {
            let error = read(text).unwrap_err().to_string();
            assert!(error.ends_with(told), "{text:?}: {error}");
        }
    }

    #[test]
    fn thinning_keeps_both_ends_and_its_limit() {
        for (rows, most) in [(10, 3), (100, 7), (1000, 999), (5, 5), (5, 0), (0, 3)] {
            let column: Vec<f64> = (0..rows).map(f64::from).collect();
            let mut table =
                Table { names: vec!["t".into()], columns: vec![column], rows: rows as usize };
            table.thin(most);
            let kept = &table.columns[0];
            assert!(kept.len() <= most.max(1) + 1, "{rows} to {most}: {kept:?}");
            assert_eq!(kept.first().copied(), (rows > 0).then_some(0.0));
            assert_eq!(kept.last().copied(), (rows > 0).then(|| f64::from(rows - 1)));
        }
    }

    #[test]
    fn floats_go_column_by_column() {
        let table = Table {
            names: vec!["a".into(), "b".into()],
            columns: vec![vec![1.0], vec![-2.0]],
            rows: 1,
        };
        // 1.0 is 3f800000 and -2.0 is c0000000 in IEEE 754 single precision, little-endian here.
        let json = table.json();
        assert_eq!(json["data"], base64(&[0, 0, 0x80, 0x3f, 0, 0, 0, 0xc0]));
        assert_eq!((json["rows"].as_u64(), json["names"][1].as_str()), (Some(1), Some("b")));
    }
}
