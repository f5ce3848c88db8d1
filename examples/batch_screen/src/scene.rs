//! Scene files: what a run needs to know, as TOML.

mod apparatus;
mod liquid;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;

pub(crate) use self::apparatus::{HarmonicTerm, Housing, PartFile, Screen, ScreenMotion, WireKind};
pub(crate) use self::liquid::{Drag, DynamicRupture, LiquidSpec, OutsideRange, Transfer};
use crate::document;
use crate::error::SceneError;
use crate::place::Origin;

/// A screening scene. Units are SI unless the key's name says another one.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Scene {
    /// Where its values were given, for messages.
    #[serde(skip)]
    pub(crate) origin: Origin,
    /// The document itself, for what is told of it as it was written.
    #[serde(skip)]
    pub(crate) document: toml::Table,
    /// One line that says what this is.
    pub(crate) title: String,
    /// Keys whose values no source gives; told with the results.
    #[serde(default)]
    pub(crate) assumed: Vec<String>,
    /// Simulated time, s.
    pub(crate) time: f64,
    /// Time step, s; a share of the stability limit where it is left out.
    #[serde(default)]
    pub(crate) time_step: Option<f64>,
    /// Seed of the packing.
    #[serde(default = "one")]
    pub(crate) seed: u64,
    /// Time between rows of the results, s.
    pub(crate) output_interval: f64,
    /// Gravity, m/s².
    #[serde(default = "earth")]
    pub(crate) gravity: [f64; 3],
    /// Materials by name.
    pub(crate) materials: BTreeMap<String, Material>,
    /// Friction and restitution of pairs of materials.
    pub(crate) contacts: Vec<ContactPair>,
    /// The contact law.
    pub(crate) contact: ContactLaw,
    /// Size classes, by diameter.
    pub(crate) classes: Vec<SizeClass>,
    /// Where the particles are at the start.
    pub(crate) packing: Packing,
    /// The screen and its frame.
    pub(crate) screen: Screen,
    /// How the screen moves.
    pub(crate) motion: ScreenMotion,
    /// Impact plate and outlet below the screen; without them a particle is collected where it
    /// has passed.
    #[serde(default)]
    pub(crate) housing: Option<Housing>,
    /// Parts from STL files, beside the built-in ones or in their place.
    #[serde(default)]
    pub(crate) parts: Vec<PartFile>,
    /// The liquid; a dry run where it is left out.
    #[serde(default)]
    pub(crate) liquid: Option<LiquidSpec>,
    /// When a run stops because its state cannot be.
    #[serde(default)]
    pub(crate) guard: GuardSpec,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct GuardSpec {
    /// Largest overlap, as a share of the smaller radius; nothing reaches 10.
    pub(crate) overlap_share: f64,
    /// Largest speed, m/s; from drop height and wall speed where it is left out.
    pub(crate) speed: Option<f64>,
    pub(crate) escapes: Escapes,
}

impl Default for GuardSpec {
    fn default() -> Self {
        Self { overlap_share: 0.2, speed: None, escapes: Escapes::Stop }
    }
}

/// What a sphere does that leaves through a wall.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Escapes {
    /// It stops the run.
    Stop,
    /// It is counted.
    Count,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Material {
    /// Young's modulus, Pa: only its ratios matter here, for the tangential stiffness.
    pub(crate) youngs_modulus: f64,
    pub(crate) poisson_ratio: f64,
    /// Contact angle of the liquid, degrees.
    pub(crate) contact_angle_deg: f64,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ContactPair {
    /// The two materials.
    pub(crate) between: [String; 2],
    /// Coulomb friction coefficient.
    pub(crate) friction: f64,
    /// Rolling friction, m.
    pub(crate) rolling_friction: f64,
    /// Coefficient of restitution of the dry contact.
    pub(crate) restitution: f64,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ContactLaw {
    /// Normal stiffness of all contacts, N/m.
    pub(crate) stiffness: f64,
    /// Tangential over normal stiffness; from the Poisson ratios where it is left out.
    #[serde(default)]
    pub(crate) tangential_ratio: Option<f64>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SizeClass {
    /// Name in the results.
    pub(crate) name: String,
    pub(crate) material: String,
    pub(crate) diameter_mm: f64,
    /// Density, kg/m³.
    pub(crate) density: f64,
    /// Mass of the whole class, g; or else `count`.
    #[serde(default)]
    pub(crate) mass_g: Option<f64>,
    /// Number of particles; or else `mass_g`.
    #[serde(default)]
    pub(crate) count: Option<u64>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, tag = "from", rename_all = "kebab-case")]
pub(crate) enum Packing {
    /// Placed at random above the screen, without overlap.
    Random {
        /// Share of the space that the particles fill, at most 0.35.
        solid_fraction: f64,
        /// Clear height between screen and particles, mm.
        clearance_mm: f64,
    },
    /// Settled dry in the feed bin, the upper part of the frame; its floor is gone at t = 0.
    Bin {
        /// Height of the bin's floor above the wire axes, mm.
        floor_height_mm: f64,
        /// Share of the space that the particles fill before they settle, at most 0.35.
        solid_fraction: f64,
        /// Longest simulated time for settling, s.
        #[serde(default = "two")]
        settle_at_most: f64,
    },
    /// Read from a CSV file with the header `id,x,y,z,radius,density`.
    File {
        /// The file, relative to the scene file.
        path: PathBuf,
    },
}

fn one() -> u64 {
    1
}

fn two() -> f64 {
    2.0
}

fn earth() -> [f64; 3] {
    [0.0, 0.0, -9.81]
}

impl Scene {
    /// Reads a scene from TOML text; `file` is what errors name.
    pub(crate) fn parse(text: &str, file: &Path) -> Result<Self, SceneError> {
        Self::read(text, Origin::new(file, text))
    }

    /// Reads a scene from a text whose values were given at `origin`.
    pub(crate) fn read(text: &str, origin: Origin) -> Result<Self, SceneError> {
        let table: toml::Table = document::read(text, &origin)?;
        if table.is_empty() {
            return Err(SceneError::Empty { place: origin.place("") });
        }
        crate::forms::check(&table, &origin)?;
        let mut scene: Self = document::read(text, &origin)?;
        scene.document = table;
        scene.origin = origin;
        crate::check::check(&scene)?;
        Ok(scene)
    }

    /// A wrong value, with its place.
    pub(crate) fn fail(
        &self,
        key: &str,
        value: impl ToString,
        allowed: impl ToString,
    ) -> SceneError {
        SceneError::Value {
            place: self.origin.place(key),
            key: key.to_owned(),
            value: value.to_string(),
            allowed: allowed.to_string(),
        }
    }

    /// What went wrong with a value that is well formed, with its place.
    pub(crate) fn at(&self, key: &str, source: impl Into<SceneError>) -> SceneError {
        let (place, key) = (self.origin.place(key), key.to_owned());
        SceneError::At { place, key, source: Box::new(source.into()) }
    }

    /// Index of a material in the order of names.
    pub(crate) fn material(&self, name: &str) -> Option<u8> {
        self.materials.keys().position(|known| known == name).map(|k| k as u8)
    }
}
