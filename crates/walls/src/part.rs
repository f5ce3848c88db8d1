use crate::{Motion, Shape, WallError};

/// A part of the walls: a surface that moves as one, of one material.
#[derive(Debug, Clone)]
pub struct Part {
    /// Name, unique among the parts; results are listed by it.
    pub name: String,
    /// The surface, in its rest position.
    pub shape: Shape,
    /// How it moves.
    pub motion: Motion,
    /// The caller's number of its material.
    pub material: u8,
    /// Half the width of the wall as liquid sees it, m: infinite for a wall that is large against
    /// the spheres, the radius for a wire.
    pub half_side: f64,
    /// Time at which the part is taken away, s; infinite for a part that stays.
    pub present_until: f64,
}

impl Part {
    /// A part at rest, of material 0, that stays. Its half side is the radius for a [`Wire`],
    /// infinite for all other shapes; set the fields for anything else.
    ///
    /// [`Wire`]: crate::Wire
    #[must_use]
    pub fn new(name: impl Into<String>, shape: Shape) -> Self {
        let half_side = match &shape {
            Shape::Wire(wire) => wire.radius(),
            _ => f64::INFINITY,
        };
        Self {
            name: name.into(),
            shape,
            motion: Motion::STILL,
            material: 0,
            half_side,
            present_until: f64::INFINITY,
        }
    }

    /// The same part with another motion.
    #[must_use]
    pub fn with_motion(self, motion: Motion) -> Self {
        Self { motion, ..self }
    }

    /// The same part of another material.
    #[must_use]
    pub fn with_material(self, material: u8) -> Self {
        Self { material, ..self }
    }

    /// The same part with another half side, m.
    #[must_use]
    pub fn with_half_side(self, half_side: f64) -> Self {
        Self { half_side, ..self }
    }

    /// The same part, taken away at `time` (s).
    #[must_use]
    pub fn until(self, time: f64) -> Self {
        Self { present_until: time, ..self }
    }

    pub(crate) fn check(&self) -> Result<(), WallError> {
        self.motion.check(&self.name)?;
        if self.half_side != f64::INFINITY {
            WallError::positive(&self.name, "half side", self.half_side)?;
        }
        let always = (f64::NEG_INFINITY, f64::INFINITY);
        WallError::within(&self.name, "time of removal", self.present_until, always)
    }
}
