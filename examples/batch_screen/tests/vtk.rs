//! The ParaView series, read back by a reader of its own.

#![allow(clippy::unwrap_used, reason = "the helpers of tests may panic like the tests")]

#[path = "../src/vtk/mod.rs"]
mod vtk;

use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

use vtk::{BridgeRow, Frame, ParticleRow, Series, VtkError, WallMesh};

/// A moment with `n` particles on a spiral, a bridge between each two neighbours, and two triangles.
fn sample(time: f64, n: usize) -> Frame {
    let place = |k: usize| {
        let turn = 0.37 * k as f64;
        [0.1 * turn.cos(), 0.1 * turn.sin(), 1e-3 * k as f64 + time]
    };
    let particle = |k: usize| ParticleRow {
        id: 10_000_000_000 + k as i64,
        class: (k % 3) as i32,
        position: place(k),
        radius: [2.5e-3, 3.5e-3, 5e-3][k % 3],
        velocity: [0.1 * k as f64, -0.2, time],
        film: 7.4e-5 / (1 + k) as f64,
    };
    let bridge = |k: usize| BridgeRow {
        ends: [place(k), place(k + 1)],
        volume: 1e-9 * (1 + k) as f64,
        force: 1e-3 - 1e-6 * k as f64,
        gap: if k.is_multiple_of(2) { -1e-7 } else { 2e-5 },
    };
    let walls = WallMesh {
        points: vec![[0.0, 0.0, time], [0.1, 0.0, time], [0.0, 0.1, time], [0.1, 0.1, time]],
        triangles: vec![[0, 1, 2], [3, 2, 1]],
        film: vec![1e-5, 3e-5],
    };
    Frame {
        time,
        particles: (0..n).map(particle).collect(),
        bridges: (1..n).map(|k| bridge(k - 1)).collect(),
        walls,
    }
}

/// One `.vtp` file taken apart.
struct File {
    /// Attributes of the piece.
    piece: BTreeMap<String, usize>,
    time: f64,
    /// Number type, components and bytes by name.
    arrays: BTreeMap<String, (String, usize, Vec<u8>)>,
}

fn attribute<'a>(element: &'a str, name: &str) -> &'a str {
    let (_, rest) = element.split_once(&format!(" {name}=\"")).expect(name);
    rest.split_once('"').unwrap().0
}

/// Undoes the blocks and says how many bytes they took.
fn decode(data: &[u8]) -> (Vec<u8>, usize) {
    let word = |k: usize| u64::from_le_bytes(data[8 * k..8 * k + 8].try_into().unwrap()) as usize;
    let (count, size, partial) = (word(0), word(1), word(2));
    let mut out = Vec::new();
    let mut at = 8 * (3 + count);
    for block in 0..count {
        let stream = &data[at..at + word(3 + block)];
        let before = out.len();
        flate2::read::ZlibDecoder::new(stream).read_to_end(&mut out).unwrap();
        let last = block + 1 == count && partial > 0;
        assert_eq!(out.len() - before, if last { partial } else { size });
        at += stream.len();
    }
    (out, at)
}

fn read(path: &Path) -> File {
    let bytes = std::fs::read(path).unwrap();
    let mark = b"<AppendedData encoding=\"raw\">\n_";
    let split = bytes.windows(mark.len()).position(|w| w == mark).unwrap();
    let head = std::str::from_utf8(&bytes[..split]).unwrap();
    let data = &bytes[split + mark.len()..];
    let element = |tag: &str| {
        let from = head.find(&format!("<{tag} ")).expect(tag);
        head[from..].split_once('>').unwrap().0
    };
    assert_eq!(attribute(element("VTKFile"), "compressor"), "vtkZLibDataCompressor");
    assert_eq!(attribute(element("VTKFile"), "header_type"), "UInt64");
    assert_eq!(attribute(element("VTKFile"), "byte_order"), "LittleEndian");
    let numbers = ["Points", "Verts", "Lines", "Strips", "Polys"].map(|kind| {
        let name = format!("NumberOf{kind}");
        let number = attribute(element("Piece"), &name).parse().unwrap();
        (kind.to_owned(), number)
    });
    let (_, after) = head.split_once("Name=\"TimeValue\"").unwrap();
    let time = after.split_once('>').unwrap().1.split_once('<').unwrap().0.parse().unwrap();
    let mut arrays = BTreeMap::new();
    let mut end = 0;
    for line in head.lines().filter(|line| line.contains("format=\"appended\"")) {
        // Each array starts where the one before it ended.
        let offset: usize = attribute(line, "offset").parse().unwrap();
        assert_eq!(offset, end, "{line}");
        let (values, used) = decode(&data[offset..]);
        end = offset + used;
        let components = attribute(line, "NumberOfComponents").parse().unwrap();
        let value = (attribute(line, "type").to_owned(), components, values);
        assert!(arrays.insert(attribute(line, "Name").to_owned(), value).is_none(), "{line}");
    }
    assert_eq!(&data[end..], b"\n</AppendedData>\n</VTKFile>\n");
    File { piece: numbers.into(), time, arrays }
}

impl File {
    fn floats(&self, name: &str) -> Vec<f32> {
        let (kind, _, bytes) = &self.arrays[name];
        assert_eq!(kind, "Float32", "{name}");
        bytes.chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect()
    }

    fn wholes(&self, name: &str) -> Vec<i64> {
        let (kind, _, bytes) = &self.arrays[name];
        match kind.as_str() {
            "Int64" => {
                bytes.chunks_exact(8).map(|b| i64::from_le_bytes(b.try_into().unwrap())).collect()
            }
            "Int32" => bytes
                .chunks_exact(4)
                .map(|b| i64::from(i32::from_le_bytes(b.try_into().unwrap())))
                .collect(),
            other => panic!("{name} is {other}"),
        }
    }
}

/// Names of the files of a `.pvd`, by time.
fn listed(folder: &Path, series: &str) -> Vec<(f64, String)> {
    let text = std::fs::read_to_string(folder.join(format!("{series}.pvd"))).unwrap();
    assert!(text.ends_with("</VTKFile>\n"));
    text.lines()
        .filter(|line| line.starts_with("<DataSet"))
        .map(|l| (attribute(l, "timestep").parse().unwrap(), attribute(l, "file").to_owned()))
        .collect()
}

fn near(found: &[f32], expected: impl Iterator<Item = f64>, name: &str) {
    let expected: Vec<f64> = expected.collect();
    assert_eq!(found.len(), expected.len(), "{name}");
    for (a, b) in found.iter().zip(&expected) {
        // Half a unit in the last of the 24 binary places of single precision.
        assert!((f64::from(*a) - b).abs() <= 6e-8 * b.abs(), "{name}: {a} is not {b}");
    }
}

fn compare(folder: &Path, index: usize, frame: &Frame) {
    let file = |series: &str| {
        let (time, name) = listed(folder, series)[index].clone();
        let file = read(&folder.join(name));
        assert_eq!((time, file.time), (frame.time, frame.time));
        file
    };
    let (n, m) = (frame.particles.len(), frame.bridges.len());
    let found = file("particles");
    assert_eq!((found.piece["Points"], found.piece["Verts"], found.piece["Lines"]), (n, n, 0));
    let ids: Vec<i64> = frame.particles.iter().map(|p| p.id).collect();
    let classes: Vec<i64> = frame.particles.iter().map(|p| i64::from(p.class)).collect();
    assert_eq!((found.wholes("id"), found.wholes("class")), (ids, classes));
    let p = &frame.particles;
    near(&found.floats("position"), p.iter().flat_map(|p| p.position), "position");
    near(&found.floats("velocity"), p.iter().flat_map(|p| p.velocity), "velocity");
    near(&found.floats("radius"), p.iter().map(|p| p.radius), "radius");
    near(&found.floats("film"), p.iter().map(|p| p.film), "film");
    assert_eq!(found.wholes("connectivity"), (0..n as i64).collect::<Vec<_>>());
    assert_eq!(found.wholes("offsets"), (1..=n as i64).collect::<Vec<_>>());

    let found = file("bridges");
    assert_eq!((found.piece["Points"], found.piece["Lines"], found.piece["Verts"]), (2 * m, m, 0));
    near(&found.floats("volume"), frame.bridges.iter().map(|b| b.volume), "volume");
    near(&found.floats("force"), frame.bridges.iter().map(|b| b.force), "force");
    near(&found.floats("gap"), frame.bridges.iter().map(|b| b.gap), "gap");
    let offsets: Vec<i64> = (1..=m as i64).map(|k| 2 * k).collect();
    assert_eq!(found.wholes("offsets"), offsets);

    let found = file("walls");
    let triangles = frame.walls.triangles.len();
    assert_eq!((found.piece["Polys"], found.piece["Verts"]), (triangles, 0));
    let corners: Vec<i64> = frame.walls.triangles.iter().flatten().map(|&k| i64::from(k)).collect();
    assert_eq!(found.wholes("connectivity"), corners);
    near(&found.floats("film"), frame.walls.film.iter().copied(), "film");
}

#[test]
fn reads_back_what_was_written() {
    let folder = tempfile::tempdir().unwrap();
    // 5,000 particles: positions take two blocks, ids two, and none a whole number of them.
    let frames = [sample(0.0, 400), sample(0.02, 5_000), sample(0.1 + 0.2, 1)];
    let mut series = Series::create(folder.path()).unwrap();
    for (index, frame) in frames.iter().enumerate() {
        series.frame(frame).unwrap();
        // Valid at any moment: compared after each frame, not only at the end.
        compare(folder.path(), index, frame);
        assert_eq!(listed(folder.path(), "walls").len(), index + 1);
    }
    frames.iter().enumerate().for_each(|(k, frame)| compare(folder.path(), k, frame));
}

#[test]
fn a_series_without_frames_and_a_frame_without_anything_are_valid() {
    let folder = tempfile::tempdir().unwrap();
    let mut series = Series::create(folder.path()).unwrap();
    assert!(listed(folder.path(), "particles").is_empty());
    series.frame(&Frame::default()).unwrap();
    compare(folder.path(), 0, &Frame::default());
}

/// Every file of a folder with its bytes.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    entries
        .map(|e| (e.file_name().into_string().unwrap(), std::fs::read(e.path()).unwrap()))
        .collect()
}

#[test]
fn a_resumed_series_ends_like_one_that_was_never_stopped() {
    let times = [0.0, 0.02, 0.04, 0.06, 0.08];
    let whole = tempfile::tempdir().unwrap();
    let mut series = Series::create(whole.path()).unwrap();
    times.iter().for_each(|t| series.frame(&sample(*t, 50)).unwrap());
    // Stopped at 0.06, in the middle of a frame; the last checkpoint was at 0.03.
    let cut = tempfile::tempdir().unwrap();
    let mut series = Series::create(cut.path()).unwrap();
    times[..4].iter().for_each(|t| series.frame(&sample(*t, 50)).unwrap());
    std::fs::write(cut.path().join("particles_000004.vtp"), b"half a file").unwrap();
    let mut series = Series::resume(cut.path(), 0.03).unwrap();
    assert_eq!(listed(cut.path(), "bridges").len(), 2);
    assert_eq!(contents(cut.path()).len(), 3 + 2 * 3);
    times[2..].iter().for_each(|t| series.frame(&sample(*t, 50)).unwrap());
    assert!(contents(whole.path()) == contents(cut.path()));
    // Where there is no series yet, it starts one.
    let fresh = tempfile::tempdir().unwrap();
    Series::resume(&fresh.path().join("vtk"), 1.0).unwrap().frame(&sample(1.5, 2)).unwrap();
    assert_eq!(listed(&fresh.path().join("vtk"), "walls").len(), 1);
}

#[test]
fn bad_frames_are_refused_and_leave_the_series_alone() {
    let folder = tempfile::tempdir().unwrap();
    let mut series = Series::create(folder.path()).unwrap();
    series.frame(&sample(0.1, 4)).unwrap();
    let before = contents(folder.path());
    assert!(matches!(series.frame(&sample(0.1, 4)), Err(VtkError::Time { .. })));
    assert!(matches!(series.frame(&sample(f64::NAN, 4)), Err(VtkError::Time { .. })));
    let mut bad = sample(0.2, 4);
    bad.walls.triangles[1][2] = 4;
    let told = series.frame(&bad).unwrap_err().to_string();
    assert_eq!(told, "triangle 1 of the walls names point 4; allowed: below 4");
    bad = sample(0.2, 4);
    bad.walls.film.pop();
    assert!(matches!(series.frame(&bad), Err(VtkError::Films { films: 1, triangles: 2 })));
    bad = sample(0.2, 4);
    bad.particles[3].velocity[1] = f64::NAN;
    let told = series.frame(&bad).unwrap_err().to_string();
    assert!(told.starts_with("velocity, entry 3, is NaN"), "{told}");
    assert!(before == contents(folder.path()));
}

#[test]
fn foreign_series_and_unwritable_folders_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let pvd = folder.path().join("walls.pvd");
    std::fs::write(&pvd, "<?xml version=\"1.0\"?>\n<Other/>\n").unwrap();
    let told = Series::resume(folder.path(), 1.0).unwrap_err().to_string();
    assert!(told.contains("walls.pvd, line 2: `<Other/>`"), "{told}");
    std::fs::write(&pvd, [0xff, 0xfe]).unwrap();
    assert!(matches!(Series::resume(folder.path(), 1.0), Err(VtkError::Read { .. })));
    assert!(matches!(Series::create(&pvd), Err(VtkError::Write { .. })));
}

/// Writes a series and what it holds for `read_back.py`, where the variable names a folder.
#[test]
fn sample_for_other_readers() {
    let Some(folder) = std::env::var_os("PENDULAR_VTK_SAMPLE") else { return };
    let folder = Path::new(&folder);
    let mut series = Series::create(folder).unwrap();
    let mut expected = Vec::new();
    for (k, n) in [0, 3, 400, 17_000].into_iter().enumerate() {
        let frame = if n == 0 { Frame::default() } else { sample(0.02 * k as f64, n) };
        let start = std::time::Instant::now();
        series.frame(&frame).unwrap();
        println!("{n} particles: {:.1} ms", 1e3 * start.elapsed().as_secs_f64());
        let p = &frame.particles;
        expected.push(serde_json::json!({
            "time": frame.time,
            "particles": {
                "position": p.iter().map(|p| p.position).collect::<Vec<_>>(),
                "id": p.iter().map(|p| p.id).collect::<Vec<_>>(),
                "class": p.iter().map(|p| p.class).collect::<Vec<_>>(),
                "radius": p.iter().map(|p| p.radius).collect::<Vec<_>>(),
                "velocity": p.iter().map(|p| p.velocity).collect::<Vec<_>>(),
                "film": p.iter().map(|p| p.film).collect::<Vec<_>>(),
            },
            "bridges": {
                "position": frame.bridges.iter().flat_map(|b| b.ends).collect::<Vec<_>>(),
                "volume": frame.bridges.iter().map(|b| b.volume).collect::<Vec<_>>(),
                "force": frame.bridges.iter().map(|b| b.force).collect::<Vec<_>>(),
                "gap": frame.bridges.iter().map(|b| b.gap).collect::<Vec<_>>(),
            },
            "walls": {
                "position": frame.walls.points,
                "triangles": frame.walls.triangles,
                "film": frame.walls.film,
            },
        }));
    }
    let text = serde_json::to_string(&expected).unwrap();
    std::fs::write(folder.join("expected.json"), text).unwrap();
}
