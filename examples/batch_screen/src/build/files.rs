//! Checksums of the files that a scene names: whether they are still what a run began with.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::error::SceneError;
use crate::scene::{Packing, Scene};

/// CRC-32 of each file.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Files {
    /// Of the scene's `parts`, in their order.
    parts: Vec<u32>,
    /// Of `packing.path`, where the spheres come from a file.
    packing: Option<u32>,
}

impl Files {
    /// Those of a scene as they are now; its paths are relative to `base`.
    pub(crate) fn of(scene: &Scene, base: &Path) -> Result<Self, SceneError> {
        let packing = packing(scene).map(|path| checksum(scene, base, PACKING, path));
        Ok(Self { packing: packing.transpose()?, ..Self::of_parts(scene, base)? })
    }

    /// Those of the parts alone: a run that has begun does not read where its spheres were.
    pub(crate) fn of_parts(scene: &Scene, base: &Path) -> Result<Self, SceneError> {
        let part = |k: usize| checksum(scene, base, &part_key(k), &scene.parts[k].stl);
        let parts = (0..scene.parts.len()).map(part).collect::<Result<_, _>>()?;
        Ok(Self { parts, packing: None })
    }

    /// Key and name of the first file of a part that is another one in `other`.
    pub(crate) fn other_part<'a>(
        &self,
        scene: &'a Scene,
        other: &Self,
    ) -> Option<(String, &'a PathBuf)> {
        let same = |k: usize| self.parts.get(k) == other.parts.get(k);
        let k = (0..scene.parts.len()).find(|&k| !same(k))?;
        Some((part_key(k), &scene.parts[k].stl))
    }

    /// Key and name of the first file that is another one in `other`.
    pub(crate) fn other<'a>(
        &self,
        scene: &'a Scene,
        other: &Self,
    ) -> Option<(String, &'a PathBuf)> {
        let of_packing = || {
            let path = packing(scene).filter(|_| self.packing != other.packing)?;
            Some((PACKING.to_owned(), path))
        };
        self.other_part(scene, other).or_else(of_packing)
    }
}

const PACKING: &str = "packing.path";

fn part_key(k: usize) -> String {
    format!("parts[{k}].stl")
}

fn packing(scene: &Scene) -> Option<&PathBuf> {
    match &scene.packing {
        Packing::File { path } => Some(path),
        _ => None,
    }
}

fn checksum(scene: &Scene, base: &Path, key: &str, name: &Path) -> Result<u32, SceneError> {
    let file = base.join(name);
    match std::fs::read(&file) {
        Ok(bytes) => Ok(crc32fast::hash(&bytes)),
        Err(source) => Err(scene.at(key, SceneError::Unreadable { file, source })),
    }
}
