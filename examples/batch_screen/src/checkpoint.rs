//! A run as one file, to go on from later: versioned, checksummed, compressed, written atomically.

use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use flate2::Compression;
use flate2::read::ZlibDecoder;
use flate2::write::ZlibEncoder;
use pendular::dem::{DVec3, Particle, Partner, Simulation, Snapshot, Touch, WallMemory};
use pendular::{Budget, Counts, Ledger, LedgerParts, LiveState, MeshWalls, WetState};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::build::{Files, WetTerm};
use crate::makeup::{Makeup, StoredPair};
use crate::screening::Screening;
use crate::spent::Spent;
use crate::tables::Start;
use crate::tally::Gone;

const NAME: &str = "checkpoint.bin";
const MAGIC: &[u8; 8] = b"PENDULAR";
/// Changes whenever [`Checkpoint`] does.
const VERSION: u32 = 5;

/// What is wrong with a checkpoint.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CheckpointError {
    #[error("no checkpoint to go on from: cannot read {}: {source}", path.display())]
    Unreadable { path: PathBuf, source: std::io::Error },
    #[error("{} is no checkpoint of this program", path.display())]
    Foreign { path: PathBuf },
    #[error("{} is of version {found}; this program reads version {VERSION}", path.display())]
    Version { path: PathBuf, found: u32 },
    #[error("{} is damaged: {message}", path.display())]
    Damaged { path: PathBuf, message: String },
    #[error("cannot write {}: {source}", path.display())]
    Unwritable { path: PathBuf, source: std::io::Error },
}

/// All that a run has become.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Checkpoint {
    /// What the scene was called on the command line.
    pub(crate) source: String,
    /// Text of the scene, and the folder its paths are relative to.
    pub(crate) scene: String,
    pub(crate) base: PathBuf,
    /// What the command line changed in it.
    pub(crate) time: f64,
    pub(crate) time_step: f64,
    pub(crate) seed: u64,
    /// Whether the time step may be above the stability limit.
    pub(crate) allow_unstable: bool,
    /// Time between ParaView frames, s.
    pub(crate) vtk: Option<f64>,
    /// Class of each particle, by id.
    pub(crate) class: Vec<u16>,
    pub(crate) core: Core,
    pub(crate) wet: Option<StoredWet>,
    pub(crate) screening: Screening,
    pub(crate) gone: Gone,
    pub(crate) start: Start,
    pub(crate) budget: Budget,
    pub(crate) limit: f64,
    /// What was decided for laws that the scene leaves open.
    pub(crate) decided: Vec<(String, String)>,
    /// Checksums of the files that the scene names.
    pub(crate) files: Files,
    /// Bytes of each table.
    pub(crate) tables: Vec<u64>,
    pub(crate) rows: u64,
    pub(crate) frames: u64,
    pub(crate) vtk_frames: u64,
    /// Wall time so far, s.
    pub(crate) elapsed: f64,
    /// Where it went.
    pub(crate) spent: Spent,
}

/// The simulation.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Core {
    step: u64,
    created: u32,
    particles: Vec<StoredParticle>,
    rolls: Vec<([f64; 3], f64)>,
    pairs: Vec<([u32; 2], StoredPair)>,
    walls: Vec<StoredWall>,
    overlap: f64,
}

type StoredParticle = (u32, u16, [[f64; 3]; 3]);
/// Particle, part, touches (element, gap, normal, column), elements near.
type StoredWall = (u32, u32, Vec<(u32, f64, [f64; 3], StoredPair)>, Vec<u32>);

/// The liquid.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct StoredWet {
    films: Vec<f64>,
    walls: Vec<f64>,
    bridges: Vec<f64>,
    free: Vec<u32>,
    drained: f64,
    initial: f64,
    live: Vec<Option<StoredBridge>>,
    counts: [u64; 3],
    thickest: f64,
    lost: f64,
}

/// Radius, mate, volume, angles, transfer ratio; the two bodies, the second of them a wall or not.
type StoredBridge = ([f64; 6], u32, u32, bool);

impl Core {
    /// A simulation as it is stored.
    pub(crate) fn of<T: Makeup>(simulation: &Simulation<T, MeshWalls>) -> Self {
        let snapshot = simulation.snapshot().map(|column| T::store(&column));
        let Snapshot { step, created, particles, rolls, pairs, walls, overlap } = snapshot;
        let particle =
            |p: Particle| (p.id, p.class, [p.position, p.velocity, p.spin].map(|v| v.to_array()));
        let wall = |wall: WallMemory<StoredPair>| {
            let touch =
                |(t, column): (Touch, StoredPair)| (t.element, t.gap, t.normal.to_array(), column);
            let touches = wall.touches.into_iter().map(touch).collect();
            (wall.particle, wall.part, touches, wall.elements)
        };
        Self {
            step,
            created,
            particles: particles.into_iter().map(particle).collect(),
            rolls: rolls.into_iter().map(|(spin, contacts)| (spin.to_array(), contacts)).collect(),
            pairs,
            walls: walls.into_iter().map(wall).collect(),
            overlap,
        }
    }

    /// The snapshot, with columns still as they are stored.
    pub(crate) fn snapshot(self) -> Snapshot<StoredPair> {
        let particle = |(id, class, [x, v, w]): StoredParticle| {
            let [position, velocity, spin] = [x, v, w].map(DVec3::from_array);
            Particle { id, class, position, velocity, spin }
        };
        let wall = |(particle, part, touches, elements): StoredWall| {
            let touch = |(element, gap, normal, column)| {
                (Touch { element, gap, normal: DVec3::from_array(normal) }, column)
            };
            let touches = touches.into_iter().map(touch).collect();
            WallMemory { particle, part, touches, elements }
        };
        Snapshot {
            step: self.step,
            created: self.created,
            particles: self.particles.into_iter().map(particle).collect(),
            rolls: self.rolls.into_iter().map(|(w, n)| (DVec3::from_array(w), n)).collect(),
            pairs: self.pairs,
            walls: self.walls.into_iter().map(wall).collect(),
            overlap: self.overlap,
        }
    }

    /// Simulated time of a step, s.
    pub(crate) fn time(&self, time_step: f64) -> f64 {
        self.step as f64 * time_step
    }
}

impl StoredWet {
    /// The liquid as it is stored.
    pub(crate) fn of(wet: &WetTerm) -> Self {
        let WetState { ledger, live, counts, thickest, capillary_loss: lost } = wet.state();
        let LedgerParts { films, walls, bridges, free, drained, initial } = ledger.parts();
        let bridge = |live: LiveState| {
            let [a, b] = live.contact_angles;
            let (second, wall) = match live.second {
                Partner::Particle(id) => (id, false),
                Partner::Wall(part) => (part, true),
            };
            let numbers = [live.radius, live.mate, live.volume, a, b, live.transfer_ratio];
            (numbers, live.first, second, wall)
        };
        let live = live.into_iter().map(|one| one.map(bridge)).collect();
        let counts = [counts.formed, counts.ruptured, counts.extrapolated];
        Self { films, walls, bridges, free, drained, initial, live, counts, thickest, lost }
    }

    /// The state of the liquid term.
    pub(crate) fn state(self) -> WetState {
        let Self { films, walls, bridges, free, drained, initial, live, counts, thickest, lost } =
            self;
        let parts = LedgerParts { films, walls, bridges, free, drained, initial };
        let bridge = |(numbers, first, second, wall): StoredBridge| {
            let [radius, mate, volume, a, b, transfer_ratio] = numbers;
            let second = if wall { Partner::Wall(second) } else { Partner::Particle(second) };
            let contact_angles = [a, b];
            LiveState { radius, mate, volume, contact_angles, transfer_ratio, first, second }
        };
        let [formed, ruptured, extrapolated] = counts;
        WetState {
            ledger: Ledger::from_parts(parts),
            live: live.into_iter().map(|one| one.map(bridge)).collect(),
            counts: Counts { formed, ruptured, extrapolated },
            thickest,
            capillary_loss: lost,
        }
    }
}

impl Checkpoint {
    /// Simulated time, s.
    pub(crate) fn at(&self) -> f64 {
        self.core.time(self.time_step)
    }

    /// Whether the run has come to its end: no step is left, and the last row is written.
    pub(crate) fn is_finished(&self) -> bool {
        self.rows > 0 && self.core.step >= (self.time / self.time_step).round() as u64
    }

    /// Writes the checkpoint of a folder.
    pub(crate) fn write(&self, folder: &Path) -> Result<(), CheckpointError> {
        store(self, &folder.join(NAME))
    }

    /// Reads the checkpoint of a folder.
    pub(crate) fn read(folder: &Path) -> Result<Self, CheckpointError> {
        load(&folder.join(NAME))
    }
}

/// Writes a value beside its place first, then moves it there, so that the last whole one survives
/// whatever happens.
pub(crate) fn store<T: Serialize>(value: &T, path: &Path) -> Result<(), CheckpointError> {
    let fail = |source| CheckpointError::Unwritable { path: path.to_path_buf(), source };
    let other = |e: postcard::Error| std::io::Error::other(e.to_string());
    let plain = postcard::to_allocvec(value).map_err(|e| fail(other(e)))?;
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(&plain).map_err(fail)?;
    let packed = encoder.finish().map_err(fail)?;
    let write = || -> std::io::Result<()> {
        let mut file = tempfile::NamedTempFile::new_in(path.parent().unwrap_or(Path::new(".")))?;
        file.write_all(MAGIC)?;
        file.write_all(&VERSION.to_le_bytes())?;
        file.write_all(&crc32fast::hash(&packed).to_le_bytes())?;
        file.write_all(&packed)?;
        file.as_file().sync_all()?;
        file.persist(path)?;
        Ok(())
    };
    write().map_err(fail)
}

/// Reads what [`store`] wrote.
pub(crate) fn load<T: DeserializeOwned>(path: &Path) -> Result<T, CheckpointError> {
    let path = path.to_path_buf();
    let bytes = std::fs::read(&path)
        .map_err(|source| CheckpointError::Unreadable { path: path.clone(), source })?;
    let damaged = |message: String| CheckpointError::Damaged { path: path.clone(), message };
    let (Some(magic), Some(rest)) = (bytes.get(..8), bytes.get(8..)) else {
        return Err(CheckpointError::Foreign { path });
    };
    if magic != MAGIC {
        return Err(CheckpointError::Foreign { path });
    }
    let number = |at: usize| {
        let bytes = rest.get(at..at + 4).and_then(|four| four.try_into().ok());
        bytes.map(u32::from_le_bytes).ok_or_else(|| damaged("it is cut short".into()))
    };
    let found = number(0)?;
    if found != VERSION {
        return Err(CheckpointError::Version { path, found });
    }
    let packed = rest.get(8..).unwrap_or_default();
    if number(4)? != crc32fast::hash(packed) {
        return Err(damaged("its checksum is wrong".into()));
    }
    let mut plain = Vec::new();
    let inflated = ZlibDecoder::new(packed).read_to_end(&mut plain);
    inflated.map_err(|e| damaged(e.to_string()))?;
    postcard::from_bytes(&plain).map_err(|e| damaged(e.to_string()))
}
