//! The tables that come with the crate.

use std::sync::OnceLock;

use pendular_pair::Mate;

use super::{Kind, Pair, TransferTable};
use crate::{TableFault, TransferError};

/// The pairs of Elskamp & Kruggel-Emden (2018): what each column of [`RATIOS`] is.
const PAIRS: &str = include_str!("../../tables/e18_pairs.csv");
/// Their transfer ratios, written by `cargo run -p pendular-transfer --example make_tables`.
const RATIOS: &str = include_str!("../../tables/e18_ratios.csv");

/// The columns of a table of pairs.
const PAIR_COLUMNS: [&str; 5] =
    ["pair", "kind", "size_ratio", "contact_angle_i_deg", "contact_angle_j_deg"];

/// A pair of a table file: its name and its shape (first radius 1 m).
pub type NamedPair = (String, Pair);

/// The pairs for which tables are shipped.
///
/// # Errors
/// None with the files that are shipped; [`TransferError`] as [`read_pairs`].
pub fn pairs() -> Result<Vec<NamedPair>, TransferError> {
    read_pairs(PAIRS)
}

/// The table shipped for a pair, if there is one.
pub(super) fn find(pair: &Pair) -> Result<Option<TransferTable>, TransferError> {
    static ALL: OnceLock<Result<Vec<(Pair, Nodes)>, TransferError>> = OnceLock::new();
    let all = ALL.get_or_init(|| read(PAIRS, RATIOS)).as_ref().map_err(Clone::clone)?;
    let stored = |pair: &Pair| all.iter().find(|(p, _)| p.similar(pair));
    let table = |nodes: &Nodes| {
        TransferTable::from_nodes(pair, nodes)
            .map_err(|reason| TransferError::Table { line: 0, reason })
    };
    if let Some((_, nodes)) = stored(pair) {
        return table(nodes).map(Some);
    }
    match pair.swapped().as_ref().and_then(stored) {
        Some((_, nodes)) => Ok(Some(table(nodes)?.swapped())),
        None => Ok(None),
    }
}

type Nodes = Vec<(f64, f64)>;

/// Reads a CSV list of pairs: `pair,kind,size_ratio,contact_angle_i_deg,contact_angle_j_deg`.
///
/// `kind` is `sphere`, `large_wall` or `small_wall`; `size_ratio` is r_j/r_i (r_w/r_i for a small
/// wall, ignored for a large one). Lines that begin with `#` are comments.
///
/// # Errors
/// [`TransferError::Table`] with the line; [`TransferError::OutOfRange`] as [`Pair::new`].
pub fn read_pairs(text: &str) -> Result<Vec<NamedPair>, TransferError> {
    let mut reader = reader(text);
    let expected = reader.headers().is_ok_and(|found| found.iter().eq(PAIR_COLUMNS));
    if !expected {
        return Err(TransferError::Table { line: 1, reason: TableFault::Columns });
    }
    let mut pairs = Vec::new();
    for record in reader.records() {
        let (record, line) = checked(record)?;
        let number = |k: usize| number(&record[k], line);
        let ratio = number(2)?;
        let mate = match Kind::from_name(&record[1]) {
            Some(Kind::Sphere) => Mate::Sphere { radius: ratio },
            Some(Kind::LargeWall) => Mate::PLANE,
            Some(Kind::SmallWall) => Mate::Wall { half_side: ratio },
            None => return Err(TransferError::Table { line, reason: TableFault::Kind }),
        };
        let angles = [number(3)?.to_radians(), number(4)?.to_radians()];
        pairs.push((record[0].to_owned(), Pair::new(1.0, mate, angles)?));
    }
    Ok(pairs)
}

/// Reads the ratios of pairs: a column `v_star`, then one for each pair; empty where unsolved.
fn read(pairs: &str, ratios: &str) -> Result<Vec<(Pair, Nodes)>, TransferError> {
    let pairs = read_pairs(pairs)?;
    let mut reader = reader(ratios);
    let names = ["v_star"].into_iter().chain(pairs.iter().map(|(name, _)| name.as_str()));
    let expected = reader.headers().is_ok_and(|found| found.iter().eq(names));
    if !expected {
        return Err(TransferError::Table { line: 1, reason: TableFault::Columns });
    }
    let mut nodes = vec![Nodes::new(); pairs.len()];
    for record in reader.records() {
        let (record, line) = checked(record)?;
        let v_star = number(&record[0], line)?;
        for (column, cell) in nodes.iter_mut().zip(record.iter().skip(1)) {
            if !cell.is_empty() {
                column.push((v_star, number(cell, line)?));
            }
        }
    }
    Ok(pairs.into_iter().map(|(_, pair)| pair).zip(nodes).collect())
}

fn reader(text: &str) -> csv::Reader<&[u8]> {
    csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(text.as_bytes())
}

fn checked(
    record: Result<csv::StringRecord, csv::Error>,
) -> Result<(csv::StringRecord, u64), TransferError> {
    let line_of = |position: Option<&csv::Position>| position.map_or(0, csv::Position::line);
    match record {
        Ok(record) => {
            let line = line_of(record.position());
            Ok((record, line))
        }
        Err(error) => {
            let line = line_of(error.position());
            Err(TransferError::Table { line, reason: TableFault::Columns })
        }
    }
}

fn number(cell: &str, line: u64) -> Result<f64, TransferError> {
    let fault = TransferError::Table { line, reason: TableFault::Number };
    cell.parse().ok().filter(|value: &f64| value.is_finite()).ok_or(fault)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::split::parabola;

    #[test]
    fn shipped_entries_are_the_solver_s() {
        let all = read(PAIRS, RATIOS).unwrap();
        assert_eq!(all.len(), 28);
        for (pair, nodes) in &all {
            let computed = TransferTable::compute(pair).unwrap();
            assert_eq!(nodes.len(), computed.nodes().count(), "{pair:?}");
            for (v_star, ratio) in nodes.iter().step_by(7) {
                let solved = parabola::split(pair, pair.volume(*v_star)).unwrap();
                assert!((solved.transfer_ratio() - ratio).abs() < 1e-9, "{pair:?} {v_star}");
            }
        }
    }

    #[test]
    fn a_shipped_pair_is_found_either_way_round() {
        let angles = [40f64.to_radians(); 2];
        let there = Pair::new(5e-3, Mate::Sphere { radius: 3.5e-3 }, angles).unwrap();
        let back = there.swapped().unwrap();
        let v = there.volume(0.02);
        let one = find(&there).unwrap().unwrap().at_volume(v).unwrap().transfer_ratio();
        let two = find(&back).unwrap().unwrap().at_volume(v).unwrap().transfer_ratio();
        assert!(one > 0.5 && (one + two - 1.0).abs() < 1e-14);
        let computed = TransferTable::compute(&there).unwrap().at_volume(v).unwrap();
        assert!((computed.transfer_ratio() - one).abs() < 1e-9);
        let other = Pair::new(5e-3, Mate::PLANE, [0.5, 0.6]).unwrap();
        assert_eq!(find(&other).unwrap(), None);
    }

    #[test]
    fn broken_files_are_typed_errors() {
        let fault = |pairs: &str, ratios: &str| match read(pairs, ratios).unwrap_err() {
            TransferError::Table { line, reason } => (line, reason),
            other => panic!("{other}"),
        };
        let pairs =
            "pair,kind,size_ratio,contact_angle_i_deg,contact_angle_j_deg\na,sphere,1,40,40\n";
        assert_eq!(fault("pair,kind\n", ""), (1, TableFault::Columns));
        assert_eq!(fault(&pairs.replace("sphere", "plane"), ""), (2, TableFault::Kind));
        assert_eq!(fault(&pairs.replace("40\n", "x\n"), ""), (2, TableFault::Number));
        assert_eq!(fault(pairs, "v_star,b\n"), (1, TableFault::Columns));
        assert_eq!(fault(pairs, "# c\nv_star,a\n0.1,0.5\n0.2,nan\n"), (4, TableFault::Number));
        assert_eq!(fault(pairs, "v_star,a\n0.1\n"), (2, TableFault::Columns));
        let pair = read_pairs(pairs).unwrap()[0].1;
        let nodes = |n: &[(f64, f64)]| TransferTable::from_nodes(&pair, n).unwrap_err();
        assert_eq!(nodes(&[(0.1, 0.5)]), TableFault::TooShort);
        assert_eq!(nodes(&[(0.1, 0.5), (0.1, 0.5)]), TableFault::Order);
        assert_eq!(nodes(&[(0.1, 0.5), (0.2, 1.5)]), TableFault::Ratio);
    }
}
