use pendular_lane::Lane;
use pendular_pair::{Bridge, Mate, OutOfRange};

/// How the gap S is kept from 0, where every lubrication law diverges.
///
/// Roughness is added to the gap, a cut-off bounds it from below. Both stand for the asperities
/// that touch first, and both make the drag finite at S ≤ 0; their results differ.
///
/// # References
/// Krull, Strohner & Antonyuk (2025), eq. (24) and text. Elskamp & Kruggel-Emden (2018) add
/// 0.001 R (below eq. 29).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
pub enum Gap {
    /// S + s_r with the same roughness s_r for every bridge.
    Roughness {
        /// s_r, m; positive and finite.
        length: f64,
    },
    /// S + s_r with s_r a fraction of the radius 2 r_i r_j/(r_i + r_j) of two spheres, or of r_i
    /// against a wall.
    RelativeRoughness {
        /// s_r over that radius; positive and finite.
        fraction: f64,
    },
    /// max(S, h_min).
    CutOff {
        /// h_min, m; positive and finite.
        length: f64,
    },
}

/// The drag while the bodies overlap (S < 0), as a factor on the drag at contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Overlap {
    /// exp(S/s_r), or exp(S/h_min) with a cut-off.
    ///
    /// A whole deep contact then costs the normal impulse K = 6 π η R*² on the way in and K on
    /// the way out, whatever the contact stiffness: the logarithm of a rebound grows by 1.
    #[default]
    Fade,
    /// 1. Restitution then depends on the contact stiffness, which is often softened.
    Full,
    /// 0. The drag then jumps at S = 0.
    Off,
}

/// The gap and overlap treatment of a drag law.
///
/// ```
/// use pendular_lubrication::{Gap, Overlap, Regularisation};
/// let near = Regularisation { gap: Gap::CutOff { length: 1e-6 }, overlap: Overlap::Fade };
/// assert!(near.check().is_ok());
/// assert!(Regularisation::from(Gap::Roughness { length: 0.0 }).check().is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Regularisation {
    /// How the gap is kept from 0.
    pub gap: Gap,
    /// The drag in overlap.
    pub overlap: Overlap,
}

impl Default for Regularisation {
    /// Roughness 0.001 R (Elskamp & Kruggel-Emden 2018), fading in overlap.
    fn default() -> Self {
        Gap::RelativeRoughness { fraction: 0.001 }.into()
    }
}

impl From<Gap> for Regularisation {
    /// `gap`, fading in overlap.
    fn from(gap: Gap) -> Self {
        Self { gap, overlap: Overlap::Fade }
    }
}

impl Regularisation {
    /// Checks the length or fraction without a bridge, as a scene file wants it.
    ///
    /// # Errors
    /// [`OutOfRange`] unless it is positive and finite.
    pub fn check(&self) -> Result<(), OutOfRange> {
        match self.gap {
            Gap::Roughness { length } => OutOfRange::positive("roughness", length),
            Gap::RelativeRoughness { fraction } => {
                OutOfRange::positive("relative roughness", fraction)
            }
            Gap::CutOff { length } => OutOfRange::positive("minimum gap", length),
        }
    }

    /// The clearance s(0) that the drag sees at contact, m: s_r or h_min.
    ///
    /// # Errors
    /// [`OutOfRange`] unless it is positive and finite.
    pub fn contact_clearance(&self, bridge: &Bridge) -> Result<f64, OutOfRange> {
        self.check()?;
        let length = match self.gap {
            Gap::Roughness { length } | Gap::CutOff { length } => length,
            Gap::RelativeRoughness { fraction } => match bridge.mate() {
                Mate::Sphere { .. } => fraction * bridge.harmonic_radius(),
                Mate::Wall { .. } => fraction * bridge.radius(),
            },
        };
        OutOfRange::positive("clearance at contact", length)?;
        Ok(length)
    }

    pub(crate) fn fold(&self, bridge: &Bridge) -> Result<Clearance, OutOfRange> {
        let contact = self.contact_clearance(bridge)?;
        let cut_off = matches!(self.gap, Gap::CutOff { .. });
        Ok(Clearance { contact, cut_off, overlap: self.overlap })
    }
}

/// A [`Regularisation`] folded for one bridge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Clearance {
    /// s(0), m. Also the length of the fade.
    pub(crate) contact: f64,
    /// s is the gap, but at least s(0); else s(0) is added to the gap.
    cut_off: bool,
    overlap: Overlap,
}

impl Clearance {
    /// The clearance s that stands for `gap`, m; positive.
    #[inline(always)]
    pub(crate) fn at(&self, gap: f64) -> f64 {
        if self.cut_off { gap.max(self.contact) } else { gap.max(0.0) + self.contact }
    }

    /// The clearances of bridges side by side.
    #[inline(always)]
    pub(crate) fn of<L: Lane>(each: &L::Each<&Self>, gap: L) -> L {
        let permit = gap.permit();
        let (contact, zero) = (L::pack(permit, each, |c| c.contact), L::splat(permit, 0.0));
        if !(0..L::WIDTH).fold(false, |any, k| any | each[k].cut_off) {
            return gap.most(zero) + contact;
        }
        let least = L::pack(permit, each, |c| if c.cut_off { c.contact } else { 0.0 });
        let added = L::pack(permit, each, |c| if c.cut_off { 0.0 } else { c.contact });
        gap.most(least) + added
    }

    /// s does not change below this gap, m.
    pub(crate) fn floor(&self) -> f64 {
        if self.cut_off { self.contact } else { 0.0 }
    }

    /// Factor on the drag: 1 for gap ≥ 0.
    #[inline]
    pub(crate) fn weight(&self, gap: f64) -> f64 {
        if gap >= 0.0 {
            return 1.0;
        }
        match self.overlap {
            Overlap::Fade => (gap / self.contact).exp(),
            Overlap::Full => 1.0,
            Overlap::Off => 0.0,
        }
    }

    /// κ with weight = exp(κ gap) in overlap, 1/m.
    pub(crate) fn fade(&self) -> f64 {
        match self.overlap {
            Overlap::Fade => 1.0 / self.contact,
            Overlap::Full => 0.0,
            Overlap::Off => f64::INFINITY,
        }
    }

    /// [`Clearance::weight_integral`] and, to rounding, [`Clearance::weight`] in overlap.
    pub(crate) fn weighted(&self, gap: f64) -> [f64; 2] {
        match self.overlap {
            Overlap::Fade => {
                let less = (gap / self.contact).exp_m1();
                [self.contact * less, 1.0 + less]
            }
            Overlap::Full => [gap, 1.0],
            Overlap::Off => [0.0; 2],
        }
    }

    /// ∫ weight dS from 0 to an overlap `gap` < 0, m.
    pub(crate) fn weight_integral(&self, gap: f64) -> f64 {
        self.weighted(gap)[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bridge(mate: Mate) -> Bridge {
        Bridge::new(2e-3, mate, 1e-12, [0.0; 2], 0.07).unwrap()
    }

    #[test]
    fn relative_roughness_takes_the_radii_of_elskamp() {
        let near = Regularisation::default();
        let clearance = |mate| near.contact_clearance(&bridge(mate)).unwrap();
        // 2 · 2 · 1/(2 + 1) mm = 4/3 mm; a wall: r_i = 2 mm
        let pair = clearance(Mate::Sphere { radius: 1e-3 });
        assert!((pair - 4e-6 / 3.0).abs() < 1e-18);
        assert!((clearance(Mate::PLANE) - 2e-6).abs() < 1e-18);
    }

    #[test]
    fn roughness_is_added_and_a_cut_off_bounds() {
        let b = bridge(Mate::PLANE);
        let fold = |gap| Regularisation::from(gap).fold(&b).unwrap();
        let added = fold(Gap::Roughness { length: 2e-6 });
        let bound = fold(Gap::CutOff { length: 2e-6 });
        assert_eq!([added.at(-1.0), added.at(0.0), added.at(6e-6)], [2e-6, 2e-6, 8e-6]);
        assert_eq!([bound.at(-1.0), bound.at(1e-6), bound.at(6e-6)], [2e-6, 2e-6, 6e-6]);
    }

    #[test]
    fn overlap_fades_by_e_over_one_clearance() {
        let b = bridge(Mate::PLANE);
        let gap = Gap::CutOff { length: 2e-6 };
        let weight = |overlap| Regularisation { gap, overlap }.fold(&b).unwrap().weight(-2e-6);
        assert!((weight(Overlap::Fade) - 0.36787944117144233).abs() < 1e-15);
        assert_eq!(weight(Overlap::Full), 1.0);
        assert_eq!(weight(Overlap::Off), 0.0);
    }

    #[test]
    fn bad_lengths_are_named() {
        for length in [0.0, -1e-6, f64::NAN, f64::INFINITY] {
            let bad = |gap: Gap| Regularisation::from(gap).check().unwrap_err().quantity;
            assert_eq!(bad(Gap::Roughness { length }), "roughness");
            assert_eq!(bad(Gap::CutOff { length }), "minimum gap");
            assert_eq!(bad(Gap::RelativeRoughness { fraction: length }), "relative roughness");
        }
        let tiny = Regularisation::from(Gap::RelativeRoughness { fraction: 1e-323 });
        assert!(tiny.fold(&bridge(Mate::PLANE)).is_err());
    }
}
