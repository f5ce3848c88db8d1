//! One `.vtp` file: points, cells of one kind, and their columns.

use std::io::Write;
use std::path::Path;

use super::array::Array;

/// Kinds of cells a file can hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Cells {
    Verts,
    Lines,
    Polys,
}

impl Cells {
    fn tag(self) -> &'static str {
        match self {
            Self::Verts => "Verts",
            Self::Lines => "Lines",
            Self::Polys => "Polys",
        }
    }

    /// Corners of one cell.
    fn corners(self) -> usize {
        match self {
            Self::Verts => 1,
            Self::Lines => 2,
            Self::Polys => 3,
        }
    }
}

/// Poly data of one moment: all cells of one kind, with the same number of corners.
pub(crate) struct Poly {
    pub(crate) points: Array,
    pub(crate) cells: Cells,
    /// Points of the cells, one cell after the other.
    pub(crate) connectivity: Vec<i64>,
    pub(crate) point_data: Vec<Array>,
    pub(crate) cell_data: Vec<Array>,
}

impl Poly {
    /// The whole file.
    ///
    /// # Errors
    ///
    /// What the compressor reports.
    pub(crate) fn file(&self, time: f64) -> std::io::Result<Vec<u8>> {
        let corners = self.cells.corners();
        let count = self.connectivity.len() / corners;
        let points = self.points.bytes.len() / 12;
        let connectivity = Array::int64("connectivity", self.connectivity.iter().copied());
        let offsets = Array::int64("offsets", (1..=count).map(|k| (k * corners) as i64));
        let mut data = Vec::new();
        let mut place = |array: &Array| -> std::io::Result<String> {
            let element = array.element(data.len());
            data.extend_from_slice(&array.encode()?);
            Ok(element)
        };
        let mut section = |tag: &str, arrays: &[&Array]| -> std::io::Result<String> {
            let inner: std::io::Result<String> = arrays.iter().map(|array| place(array)).collect();
            Ok(format!("<{tag}>\n{}</{tag}>\n", inner?))
        };
        let body = [
            section("PointData", &self.point_data.iter().collect::<Vec<_>>())?,
            section("CellData", &self.cell_data.iter().collect::<Vec<_>>())?,
            section("Points", &[&self.points])?,
            section(self.cells.tag(), &[&connectivity, &offsets])?,
        ]
        .concat();
        let number = |kind: Cells| if kind == self.cells { count } else { 0 };
        let head = format!(
            "<?xml version=\"1.0\"?>\n\
             <VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" \
             header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<PolyData>\n\
             <FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" \
             format=\"ascii\">{time:?}</DataArray>\n</FieldData>\n\
             <Piece NumberOfPoints=\"{points}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" \
             NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n{body}</Piece>\n</PolyData>\n\
             <AppendedData encoding=\"raw\">\n_",
            number(Cells::Verts),
            number(Cells::Lines),
            number(Cells::Polys),
        );
        let mut file = head.into_bytes();
        file.extend_from_slice(&data);
        file.extend_from_slice(b"\n</AppendedData>\n</VTKFile>\n");
        Ok(file)
    }
}

/// Writes a file beside its place and moves it there: whoever reads sees the old or the new one.
///
/// # Errors
///
/// What the file system reports.
pub(crate) fn replace(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let mut beside = path.as_os_str().to_owned();
    beside.push(".part");
    let mut file = std::fs::File::create(&beside)?;
    file.write_all(bytes)?;
    drop(file);
    std::fs::rename(&beside, path)
}
