use std::str::FromStr;

use pendular_lane::Lane;
use pendular_pair::{Bridge, OutOfRange};

use crate::adams_perchard_1985::AdamsPerchard1985Curve;
use crate::goldman_1967::Goldman1967Curve;
use crate::jeffrey_onishi_1984::JeffreyOnishi1984Curve;
use crate::lian_1998::Lian1998Curve;
use crate::pitois_2000::Pitois2000Curve;
use crate::popov_2010::Popov2010Curve;
use crate::{
    AdamsPerchard1985, Goldman1967, JeffreyOnishi1984, Lian1998, NormalCurve, NormalDrag,
    Pitois2000, Popov2010, Regularisation, Resistance, TangentialCurve, TangentialDrag,
};

/// A name that no drag law has.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("unknown drag law {name:?}: expected one of {}", known.join(", "))]
pub struct UnknownDrag {
    /// What was asked for.
    pub name: String,
    /// The names there are.
    pub known: &'static [&'static str],
}

/// Defines, for one kind of drag: the names, the law chosen at run time and its curve.
macro_rules! any_drag {
    (
        $kind:literal, $model:ident, $any:ident: $drag:ident, $any_curve:ident: $curve:ident,
        $($name:literal => $law:ident, $law_curve:ident;)+
    ) => {
        #[doc = concat!("The ", $kind, " drag laws by name. Text and serde form are the names of [`Self::NAMES`].")]
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub enum $model {
            $(
                #[doc = concat!("`", $name, "`: [`", stringify!($law), "`].")]
                #[cfg_attr(feature = "serde", serde(rename = $name))]
                $law,
            )+
        }

        impl $model {
            /// Every law.
            pub const ALL: &'static [Self] = &[$(Self::$law),+];
            /// Every law's name, in the order of [`Self::ALL`].
            pub const NAMES: &'static [&'static str] = &[$($name),+];

            /// The law's name.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self { $(Self::$law => $name),+ }
            }

            /// The law with its gap and overlap treatment.
            #[must_use]
            pub fn with(self, near: Regularisation) -> $any {
                match self { $(Self::$law => $any::$law($law { near })),+ }
            }
        }

        impl FromStr for $model {
            type Err = UnknownDrag;

            fn from_str(name: &str) -> Result<Self, UnknownDrag> {
                let found = Self::ALL.iter().find(|model| model.name() == name);
                found.copied().ok_or(UnknownDrag { name: name.into(), known: Self::NAMES })
            }
        }

        impl std::fmt::Display for $model {
            fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                out.write_str(self.name())
            }
        }

        #[doc = concat!("A ", $kind, " drag law chosen at run time.")]
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub enum $any {
            $(
                #[doc = concat!("`", $name, "`.")]
                $law($law),
            )+
        }

        impl $any {
            /// Which law it is.
            #[must_use]
            pub fn model(&self) -> $model {
                match self { $(Self::$law(_) => $model::$law),+ }
            }

            /// Its gap and overlap treatment.
            #[must_use]
            pub fn near(&self) -> Regularisation {
                match self { $(Self::$law(law) => law.near),+ }
            }
        }

        impl $drag for $any {
            type Curve = $any_curve;

            fn curve(&self, bridge: &Bridge, viscosity: f64) -> Result<$any_curve, OutOfRange> {
                Ok(match self {
                    $(Self::$law(law) => $any_curve::$law(law.curve(bridge, viscosity)?)),+
                })
            }
        }

        #[doc = concat!("The curve of [`", stringify!($any), "`].")]
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub enum $any_curve {
            $(
                #[doc = concat!("`", $name, "`.")]
                $law($law_curve),
            )+
        }
    };
}

any_drag! {
    "normal", NormalModel, AnyNormalDrag: NormalDrag, AnyNormalCurve: NormalCurve,
    "adams-perchard" => AdamsPerchard1985, AdamsPerchard1985Curve;
    "pitois" => Pitois2000, Pitois2000Curve;
}

any_drag! {
    "tangential", TangentialModel, AnyTangentialDrag: TangentialDrag,
    AnyTangentialCurve: TangentialCurve,
    "popov" => Popov2010, Popov2010Curve;
    "lian" => Lian1998, Lian1998Curve;
    "goldman" => Goldman1967, Goldman1967Curve;
    "jeffrey-onishi" => JeffreyOnishi1984, JeffreyOnishi1984Curve;
}

/// Those curves that are of one law, if all are.
macro_rules! all_alike {
    ($curves:expr, $any:ident :: $law:ident, $lane:ty) => {
        match $curves[0] {
            $any::$law(first) => {
                let mut alike = true;
                let mut own = <$lane>::each(|_| first);
                for k in 1..<$lane>::WIDTH {
                    match $curves[k] {
                        $any::$law(curve) => own[k] = curve,
                        _ => alike = false,
                    }
                }
                alike.then_some(own)
            }
            _ => None,
        }
    };
}

impl NormalCurve for AnyNormalCurve {
    #[inline]
    fn coefficient(&self, gap: f64) -> f64 {
        match self {
            Self::AdamsPerchard1985(curve) => curve.coefficient(gap),
            Self::Pitois2000(curve) => curve.coefficient(gap),
        }
    }

    /// Of all laws only Pitois' has a formula for several bridges at once.
    #[inline(always)]
    fn coefficients<L: Lane>(curves: &L::Each<&Self>, gap: L) -> L {
        if let Some(own) = all_alike!(curves, AnyNormalCurve::Pitois2000, L) {
            return NormalCurve::coefficients(&own, gap);
        }
        let gaps = gap.unpack();
        L::pack(gap.permit(), &L::each(|k| curves[k].coefficient(gaps[k])), |c| *c)
    }

    #[inline]
    fn impulse(&self, gap: f64) -> f64 {
        match self {
            Self::AdamsPerchard1985(curve) => curve.impulse(gap),
            Self::Pitois2000(curve) => curve.impulse(gap),
        }
    }

    #[inline]
    fn charge(&self, gap: f64) -> [f64; 2] {
        match self {
            Self::AdamsPerchard1985(curve) => curve.charge(gap),
            Self::Pitois2000(curve) => curve.charge(gap),
        }
    }

    #[inline]
    fn clearance(&self, gap: f64) -> f64 {
        match self {
            Self::AdamsPerchard1985(curve) => curve.clearance(gap),
            Self::Pitois2000(curve) => curve.clearance(gap),
        }
    }

    #[inline(always)]
    fn clearances<L: Lane>(curves: &L::Each<&Self>, gap: L) -> L {
        if let Some(own) = all_alike!(curves, AnyNormalCurve::Pitois2000, L) {
            return NormalCurve::clearances(&own, gap);
        }
        let gaps = gap.unpack();
        L::pack(gap.permit(), &L::each(|k| curves[k].clearance(gaps[k])), |c| *c)
    }

    fn fade(&self) -> Option<f64> {
        match self {
            Self::AdamsPerchard1985(curve) => curve.fade(),
            Self::Pitois2000(curve) => curve.fade(),
        }
    }
}

impl TangentialCurve for AnyTangentialCurve {
    #[inline]
    fn resistance(&self, gap: f64) -> Resistance {
        match self {
            Self::Popov2010(curve) => curve.resistance(gap),
            Self::Lian1998(curve) => curve.resistance(gap),
            Self::Goldman1967(curve) => curve.resistance(gap),
            Self::JeffreyOnishi1984(curve) => curve.resistance(gap),
        }
    }

    /// Of all laws only Popov's has a formula for several bridges at once.
    #[inline(always)]
    fn resistances<L: Lane>(curves: &L::Each<&Self>, gap: L) -> [L; 3] {
        if let Some(own) = all_alike!(curves, AnyTangentialCurve::Popov2010, L) {
            return TangentialCurve::resistances(&own, gap);
        }
        let (permit, gaps) = (gap.permit(), gap.unpack());
        let each = L::each(|k| curves[k].resistance(gaps[k]));
        [
            L::pack(permit, &each, |r| r.slip),
            L::pack(permit, &each, |r| r.coupling),
            L::pack(permit, &each, |r| r.rolling),
        ]
    }

    fn fade(&self) -> Option<f64> {
        match self {
            Self::Popov2010(curve) => curve.fade(),
            Self::Lian1998(curve) => curve.fade(),
            Self::Goldman1967(curve) => curve.fade(),
            Self::JeffreyOnishi1984(curve) => curve.fade(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_go_both_ways() {
        for model in NormalModel::ALL {
            assert_eq!(model.name().parse(), Ok(*model));
            assert_eq!(model.with(Regularisation::default()).model(), *model);
        }
        for model in TangentialModel::ALL {
            assert_eq!(model.name().parse(), Ok(*model));
            assert_eq!(model.with(Regularisation::default()).model(), *model);
        }
    }

    #[test]
    fn an_unknown_name_lists_the_known_ones() {
        let said = "adams".parse::<NormalModel>().unwrap_err().to_string();
        assert!(said.contains("\"adams\"") && said.contains("adams-perchard, pitois"), "{said}");
    }

    #[test]
    fn four_bridges_at_once_have_the_bits_of_each() {
        use crate::{Gap, Mate};
        use pendular_lane::{Four, Lane};
        let bridge = |k: u32| {
            let radius = 1e-3 + 1e-4 * f64::from(k);
            Bridge::new(radius, Mate::Sphere { radius: 2e-3 }, 1e-11, [0.1; 2], 0.07).unwrap()
        };
        let bits = |all: [f64; 4]| all.map(f64::to_bits);
        for gap in [Gap::CutOff { length: 2e-6 }, Gap::Roughness { length: 1e-6 }] {
            for gaps in [[0.0, 1e-7, 3e-6, 1e-4], [-1e-7, 1e-6, 0.0, -3e-6]] {
                let lanes = Four::pack((), &gaps, |gap| *gap);
                for model in NormalModel::ALL {
                    let law = model.with(gap.into());
                    let curves = [0, 1, 2, 3].map(|k| law.curve(&bridge(k), 1e-3).unwrap());
                    let at_once = AnyNormalCurve::coefficients(&curves.each_ref(), lanes);
                    let each = std::array::from_fn(|k| curves[k].coefficient(gaps[k]));
                    assert_eq!(bits(at_once.unpack()), bits(each), "{model:?} {gaps:?}");
                    let at_once = AnyNormalCurve::clearances(&curves.each_ref(), lanes);
                    let each = std::array::from_fn(|k| curves[k].clearance(gaps[k]));
                    assert_eq!(bits(at_once.unpack()), bits(each), "{model:?} {gaps:?}");
                }
                for model in TangentialModel::ALL {
                    let law = model.with(gap.into());
                    let curves = [0, 1, 2, 3].map(|k| law.curve(&bridge(k), 1e-3).unwrap());
                    let at_once = AnyTangentialCurve::resistances(&curves.each_ref(), lanes);
                    let each: [_; 4] = std::array::from_fn(|k| curves[k].resistance(gaps[k]));
                    assert_eq!(bits(at_once[0].unpack()), bits(each.map(|r| r.slip)));
                    assert_eq!(bits(at_once[1].unpack()), bits(each.map(|r| r.coupling)));
                    assert_eq!(bits(at_once[2].unpack()), bits(each.map(|r| r.rolling)));
                }
            }
        }
    }

    #[test]
    fn every_law_fades_in_overlap_as_it_says() {
        use crate::{Gap, Mate, Overlap};
        let bridge =
            Bridge::new(1e-3, Mate::Sphere { radius: 2e-3 }, 1e-11, [0.1; 2], 0.07).unwrap();
        for overlap in [Overlap::Fade, Overlap::Full, Overlap::Off] {
            let near = Regularisation { gap: Gap::Roughness { length: 2e-6 }, overlap };
            for gap in [-1e-7, -2e-6, -1e-5] {
                let same = |value: f64, at_contact: f64, fade: Option<f64>| {
                    let faded = at_contact * (fade.unwrap() * gap).exp();
                    assert!((value - faded).abs() <= 1e-13 * at_contact, "{overlap:?} {gap}");
                };
                for model in NormalModel::ALL {
                    let curve = model.with(near).curve(&bridge, 1e-3).unwrap();
                    same(curve.coefficient(gap), curve.coefficient(0.0), curve.fade());
                }
                for model in TangentialModel::ALL {
                    let curve = model.with(near).curve(&bridge, 1e-3).unwrap();
                    let (at, open) = (curve.resistance(gap), curve.resistance(0.0));
                    same(at.slip, open.slip, curve.fade());
                    same(at.rolling.abs(), open.rolling.abs(), curve.fade());
                }
            }
        }
    }
}
