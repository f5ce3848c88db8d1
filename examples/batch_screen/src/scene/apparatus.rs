//! What a scene says of screen, housing, parts and motion.

use std::path::PathBuf;

use serde::Deserialize;

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Screen {
    pub(crate) material: String,
    pub(crate) aperture_mm: f64,
    pub(crate) wire_diameter_mm: f64,
    /// Inner diameter of the round frame, mm.
    pub(crate) diameter_mm: f64,
    /// Height of the frame above the wire axes, mm.
    pub(crate) height_mm: f64,
    /// Depth below the wire axes at which a particle counts as passed and leaves, mm.
    pub(crate) collect_below_mm: f64,
    /// How the wires are made; exact and cheaper as cylinders.
    #[serde(default)]
    pub(crate) wires: WireKind,
    /// Sides of the prisms of `wires = "mesh"`.
    #[serde(default = "sixteen")]
    pub(crate) wire_sides: u32,
    /// Elements of the frame that hold a film each: around (cylinders only) and along.
    #[serde(default = "patches")]
    pub(crate) frame_elements: [u32; 2],
    /// Length of the wires' elements that hold a film each, mm; one pitch where it is left out.
    #[serde(default)]
    pub(crate) wire_element_mm: Option<f64>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Housing {
    pub(crate) material: String,
    /// Slope of the impact plate against the horizontal, degrees; it falls towards +x.
    pub(crate) plate_angle_deg: f64,
    /// Distance of the plate's upper end below the frame, mm.
    pub(crate) plate_gap_mm: f64,
    /// How far the plate goes on beyond the frame, mm.
    pub(crate) outlet_length_mm: f64,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PartFile {
    /// Name in the results; that of a built-in part (`wires`, `frame`, `impact plate`, `outlet`)
    /// takes its place.
    pub(crate) name: String,
    /// The STL file, relative to the scene file.
    pub(crate) stl: PathBuf,
    /// Metres per unit of the file.
    #[serde(default = "millimetre")]
    pub(crate) scale: f64,
    pub(crate) material: String,
    /// Whether it moves with the screen.
    #[serde(default)]
    pub(crate) moves: bool,
    /// Half its width as the liquid sees it, mm; a large wall where it is left out.
    #[serde(default)]
    pub(crate) half_side_mm: Option<f64>,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum WireKind {
    /// Exact cylinders.
    #[default]
    Cylinders,
    /// Triangle-mesh prisms.
    Mesh,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ScreenMotion {
    pub(crate) frequency: f64,
    /// Amplitude along x, y, z, mm: half of the stroke from peak to peak.
    pub(crate) amplitude_mm: [f64; 3],
    #[serde(default)]
    pub(crate) phase_deg: [f64; 3],
    /// Duration of a smooth start of the motion, s; none where it is left out.
    #[serde(default)]
    pub(crate) ramp: f64,
    /// Further harmonic terms, added to the first.
    #[serde(default)]
    pub(crate) terms: Vec<HarmonicTerm>,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct HarmonicTerm {
    pub(crate) frequency: f64,
    /// Amplitude along x, y, z, mm.
    pub(crate) amplitude_mm: [f64; 3],
    #[serde(default)]
    pub(crate) phase_deg: [f64; 3],
}

impl ScreenMotion {
    /// All terms whose sum is the motion.
    pub(crate) fn all(&self) -> impl Iterator<Item = HarmonicTerm> + '_ {
        let Self { frequency, amplitude_mm, phase_deg, .. } = *self;
        [HarmonicTerm { frequency, amplitude_mm, phase_deg }]
            .into_iter()
            .chain(self.terms.iter().copied())
    }

    /// Farthest that the screen may move along each axis, mm.
    pub(crate) fn reach_mm(&self) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.all().map(|term| term.amplitude_mm[axis]).sum())
    }
}

fn millimetre() -> f64 {
    1e-3
}

fn sixteen() -> u32 {
    16
}

fn patches() -> [u32; 2] {
    [36, 12]
}
