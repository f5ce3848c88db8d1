//! Time series for ParaView: `particles.pvd`, `bridges.pvd` and `walls.pvd`, each a list of
//! compressed `.vtp` files with their physical times.
//!
//! Format: VTK XML, appended raw data, zlib blocks (VTK file formats, "XML file formats").

mod array;
mod error;
mod poly;

use std::path::{Path, PathBuf};

use self::array::Array;
pub(crate) use self::error::VtkError;
use self::poly::{Cells, Poly, replace};

/// A particle at one moment; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ParticleRow {
    pub(crate) id: i64,
    /// Index of the size class.
    pub(crate) class: i32,
    /// Centre, m.
    pub(crate) position: [f64; 3],
    /// m.
    pub(crate) radius: f64,
    /// m/s.
    pub(crate) velocity: [f64; 3],
    /// Film thickness, m.
    pub(crate) film: f64,
}

/// A liquid bridge at one moment; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BridgeRow {
    /// The two ends of the line that stands for it, m.
    pub(crate) ends: [[f64; 3]; 2],
    /// m³.
    pub(crate) volume: f64,
    /// N, tension positive.
    pub(crate) force: f64,
    /// Surface to surface, m.
    pub(crate) gap: f64,
}

/// The walls at one moment.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct WallMesh {
    /// m.
    pub(crate) points: Vec<[f64; 3]>,
    /// Corners of each triangle, as indices into `points`.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Film thickness on each triangle, m.
    pub(crate) film: Vec<f64>,
}

/// Everything of one moment. Each list may be empty.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Frame {
    /// s.
    pub(crate) time: f64,
    pub(crate) particles: Vec<ParticleRow>,
    pub(crate) bridges: Vec<BridgeRow>,
    pub(crate) walls: WallMesh,
}

/// The series, in the order in which they are written: the last one tells which frames are whole.
const SERIES: [&str; 3] = ["particles", "bridges", "walls"];

/// Three time series in one folder, valid for ParaView at any moment.
#[derive(Debug)]
pub(crate) struct Series {
    folder: PathBuf,
    times: Vec<f64>,
}

impl Series {
    /// Starts empty series in a folder, which is made if need be.
    ///
    /// # Errors
    ///
    /// Where the folder or the series cannot be written.
    pub(crate) fn create(folder: &Path) -> Result<Self, VtkError> {
        std::fs::create_dir_all(folder)
            .map_err(|source| VtkError::Write { path: folder.to_path_buf(), source })?;
        let series = Self { folder: folder.to_path_buf(), times: Vec::new() };
        SERIES.iter().try_for_each(|name| series.list(name))?;
        Ok(series)
    }

    /// Goes on with the series of a folder after the frames up to `time`, s: later frames, which a
    /// run wrote after its last checkpoint, are taken out. Starts new series where there are none.
    ///
    /// # Errors
    ///
    /// Where the series cannot be read or written, or is not one of this program's.
    pub(crate) fn resume(folder: &Path, time: f64) -> Result<Self, VtkError> {
        let path = folder.join("walls.pvd");
        let text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Self::create(folder),
            Err(source) => return Err(VtkError::Read { path, source }),
        };
        let mut times = times(&path, &text)?;
        let found = times.len();
        times.retain(|t| *t <= time);
        let series = Self { folder: folder.to_path_buf(), times };
        SERIES.iter().try_for_each(|name| series.list(name))?;
        // One more than listed: a frame may have been cut short.
        for index in series.times.len()..=found {
            for name in SERIES {
                series.remove(&file_name(name, index))?;
            }
        }
        Ok(series)
    }

    /// Writes one more frame.
    ///
    /// # Errors
    ///
    /// Where its time is not after the last one's, a number is not finite, the walls do not fit
    /// together, or a file cannot be written.
    pub(crate) fn frame(&mut self, frame: &Frame) -> Result<(), VtkError> {
        let last = self.times.last().copied().unwrap_or(f64::NEG_INFINITY);
        if !frame.time.is_finite() || frame.time <= last {
            return Err(VtkError::Time { time: frame.time, last });
        }
        let index = self.times.len();
        let polys = [particles(frame)?, bridges(frame)?, walls(&frame.walls)?];
        for (name, poly) in SERIES.iter().zip(&polys) {
            let path = self.folder.join(file_name(name, index));
            let done = poly.file(frame.time).and_then(|bytes| replace(&path, &bytes));
            done.map_err(|source| VtkError::Write { path, source })?;
        }
        self.times.push(frame.time);
        SERIES.iter().try_for_each(|name| self.list(name))
    }

    /// Rewrites one `.pvd` file.
    fn list(&self, name: &str) -> Result<(), VtkError> {
        let mut text = String::from(HEAD);
        for (index, time) in self.times.iter().enumerate() {
            let file = file_name(name, index);
            text += &format!("<DataSet timestep=\"{time:?}\" part=\"0\" file=\"{file}\"/>\n");
        }
        text += FOOT;
        let path = self.folder.join(format!("{name}.pvd"));
        replace(&path, text.as_bytes()).map_err(|source| VtkError::Write { path, source })
    }

    fn remove(&self, file: &str) -> Result<(), VtkError> {
        let path = self.folder.join(file);
        match std::fs::remove_file(&path) {
            Err(source) if source.kind() != std::io::ErrorKind::NotFound => {
                Err(VtkError::Write { path, source })
            }
            _ => Ok(()),
        }
    }
}

const HEAD: &str = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" \
                    byte_order=\"LittleEndian\">\n<Collection>\n";
const FOOT: &str = "</Collection>\n</VTKFile>\n";

fn file_name(series: &str, index: usize) -> String {
    format!("{series}_{index:06}.vtp")
}

/// Times of the frames of a `.pvd` file that `Series::list` wrote.
fn times(path: &Path, text: &str) -> Result<Vec<f64>, VtkError> {
    let mut times = Vec::new();
    for (line, content) in text.lines().enumerate() {
        if HEAD.lines().chain(FOOT.lines()).any(|known| known == content) {
            continue;
        }
        let time = content
            .strip_prefix("<DataSet timestep=\"")
            .and_then(|rest| rest.split_once('"'))
            .and_then(|(time, _)| time.parse::<f64>().ok());
        let Some(time) = time else {
            let text = content.to_owned();
            return Err(VtkError::Series { path: path.to_path_buf(), line: line + 1, text });
        };
        times.push(time);
    }
    Ok(times)
}

fn particles(frame: &Frame) -> Result<Poly, VtkError> {
    let rows = &frame.particles;
    Ok(Poly {
        points: Array::floats("position", 3, rows.iter().flat_map(|p| p.position))?,
        cells: Cells::Verts,
        connectivity: (0..rows.len() as i64).collect(),
        point_data: vec![
            Array::int64("id", rows.iter().map(|p| p.id)),
            Array::int32("class", rows.iter().map(|p| p.class)),
            Array::floats("radius", 1, rows.iter().map(|p| p.radius))?,
            Array::floats("velocity", 3, rows.iter().flat_map(|p| p.velocity))?,
            Array::floats("film", 1, rows.iter().map(|p| p.film))?,
        ],
        cell_data: Vec::new(),
    })
}

fn bridges(frame: &Frame) -> Result<Poly, VtkError> {
    let rows = &frame.bridges;
    Ok(Poly {
        points: Array::floats("position", 3, rows.iter().flat_map(|b| b.ends).flatten())?,
        cells: Cells::Lines,
        connectivity: (0..2 * rows.len() as i64).collect(),
        point_data: Vec::new(),
        cell_data: vec![
            Array::floats("volume", 1, rows.iter().map(|b| b.volume))?,
            Array::floats("force", 1, rows.iter().map(|b| b.force))?,
            Array::floats("gap", 1, rows.iter().map(|b| b.gap))?,
        ],
    })
}

fn walls(mesh: &WallMesh) -> Result<Poly, VtkError> {
    let (films, triangles, points) = (mesh.film.len(), mesh.triangles.len(), mesh.points.len());
    if films != triangles {
        return Err(VtkError::Films { films, triangles });
    }
    for (triangle, corners) in mesh.triangles.iter().enumerate() {
        if let Some(&point) = corners.iter().find(|&&corner| corner as usize >= points) {
            return Err(VtkError::Triangle { triangle, point, points });
        }
    }
    Ok(Poly {
        points: Array::floats("position", 3, mesh.points.iter().flatten().copied())?,
        cells: Cells::Polys,
        connectivity: mesh.triangles.iter().flatten().map(|&corner| i64::from(corner)).collect(),
        point_data: Vec::new(),
        cell_data: vec![Array::floats("film", 1, mesh.film.iter().copied())?],
    })
}
