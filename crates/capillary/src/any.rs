use std::fmt;
use std::str::FromStr;

use pendular_lane::Lane;
use pendular_pair::{Bridge, Mate, OutOfRange, Range, Validity};

use crate::{
    Bagheri2024, CapillaryLaw, ForceCurve, Lambert2008, Rabinovich2005, RabinovichPlane,
    RabinovichPlaneSmallGap, Soulie2006, Weigert1999, Willett2000Full, Willett2000Reduced,
    tabulated::Tabulated, young_laplace::YoungLaplace,
};

/// The pairs of bodies that a law is made for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum LawKind {
    /// Two spheres. Most take a plane too, as a sphere with R = 2 r: see the law's radius ratio.
    SphereSphere,
    /// A sphere and a plane only.
    SpherePlane,
    /// Two spheres, or a sphere and a plane, each in its own right.
    Both,
}

impl fmt::Display for LawKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::SphereSphere => "sphere-sphere",
            Self::SpherePlane => "sphere-plane",
            Self::Both => "sphere-sphere and sphere-plane",
        })
    }
}

/// What there is to say about a law in a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawInfo {
    /// Name in files and on command lines.
    pub name: &'static str,
    /// The pairs of bodies that it is made for.
    pub kind: LawKind,
    /// The bridges over which it holds.
    pub validity: Validity,
    /// Who published it where.
    pub source: &'static str,
}

/// A law name that is not known.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("unknown capillary law `{name}`; known: {}", known_names())]
pub struct UnknownLaw {
    /// The name that was asked for.
    pub name: String,
}

fn known_names() -> String {
    AnyCapillary::ALL.map(AnyCapillary::name).join(", ")
}

/// Makes [`AnyCapillary`] and [`AnyCurve`] from one line per law: variant, law (a unit struct),
/// name, kind, source.
macro_rules! any_law {
    ($($variant:ident: $law:ident, $name:literal, $kind:ident, $source:literal;)+) => {
        /// A capillary law chosen at run time, by name.
        ///
        /// ```
        /// use pendular_capillary::{AnyCapillary, Bridge, CapillaryLaw, Mate, Range};
        /// let law: AnyCapillary = "willett-reduced".parse()?;
        /// let bridge = Bridge::new(1e-3, Mate::PLANE, 1e-11, [0.3; 2], 0.07)?;
        /// assert!(law.force(&bridge, 1e-5, Range::Strict)? > 0.0);
        /// assert!("willet".parse::<AnyCapillary>().is_err());
        /// # Ok::<(), Box<dyn std::error::Error>>(())
        /// ```
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum AnyCapillary {
            $(#[doc = concat!("[`", stringify!($law), "`], `", $name, "`.")] $variant,)+
        }

        /// The force over the gap of one bridge under some [`AnyCapillary`].
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub enum AnyCurve {
            $(#[doc = concat!("Of [`", stringify!($law), "`].")]
            $variant(<$law as CapillaryLaw>::Curve),)+
        }

        impl AnyCapillary {
            /// Every law.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$variant),+];

            /// Name in files and on command lines.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)+ }
            }

            /// Name, kind, range and source.
            #[must_use]
            pub fn info(self) -> LawInfo {
                let (kind, source) = match self {
                    $(Self::$variant => (LawKind::$kind, $source),)+
                };
                LawInfo { name: self.name(), kind, validity: self.validity(), source }
            }
        }

        impl CapillaryLaw for AnyCapillary {
            type Curve = AnyCurve;

            fn validity(&self) -> Validity {
                match self { $(Self::$variant => $law.validity(),)+ }
            }

            fn curve(&self, bridge: &Bridge, range: Range) -> Result<AnyCurve, OutOfRange> {
                match self {
                    $(Self::$variant => $law.curve(bridge, range).map(AnyCurve::$variant),)+
                }
            }
        }

        impl ForceCurve for AnyCurve {
            #[inline]
            fn force(&self, gap: f64) -> f64 {
                match self { $(Self::$variant(curve) => curve.force(gap),)+ }
            }

            /// Of all laws only Lambert's has a formula for several bridges at once.
            #[inline(always)]
            fn forces<L: Lane>(curves: &L::Each<&Self>, gap: L) -> L {
                if let Self::Lambert(first) = curves[0] {
                    let mut all = true;
                    let mut lambert = L::each(|_| first);
                    for k in 1..L::WIDTH {
                        match curves[k] {
                            Self::Lambert(curve) => lambert[k] = curve,
                            _ => all = false,
                        }
                    }
                    if all {
                        return ForceCurve::forces(&lambert, gap);
                    }
                }
                let gaps = gap.unpack();
                L::pack(gap.permit(), &L::each(|k| curves[k].force(gaps[k])), |force| *force)
            }
        }
    };
}

any_law! {
    Rabinovich: Rabinovich2005, "rabinovich", SphereSphere,
        "Rabinovich, Esayanur, Moudgil (2005), Langmuir 21, 10992";
    Lambert: Lambert2008, "lambert", SphereSphere,
        "Lambert, Chau, Delchambre, Régnier (2008), Langmuir 24, 3157";
    WillettFull: Willett2000Full, "willett-full", SphereSphere,
        "Willett, Adams, Johnson, Seville (2000), Langmuir 16, 9396, full form";
    WillettReduced: Willett2000Reduced, "willett-reduced", SphereSphere,
        "Willett, Adams, Johnson, Seville (2000), Langmuir 16, 9396, reduced form";
    Weigert: Weigert1999, "weigert", SphereSphere,
        "Weigert, Ripperger (1999), Part. Part. Syst. Charact. 16, 238";
    Soulie: Soulie2006, "soulie", SphereSphere,
        "Soulié, Cherblanc, El Youssoufi, Saix (2006), Int. J. Numer. Anal. Meth. Geomech. 30, 213";
    Bagheri: Bagheri2024, "bagheri", SphereSphere,
        "Bagheri, Roy, Pöschel (2024), Comput. Part. Mech.";
    RabinovichPlane: RabinovichPlane, "rabinovich-plane", SpherePlane,
        "Rabinovich, Esayanur, Moudgil (2005), Langmuir 21, 10992";
    RabinovichPlaneSmallGap: RabinovichPlaneSmallGap, "rabinovich-plane-small-gap", SpherePlane,
        "Elskamp, Kruggel-Emden (2018), Chem. Eng. Res. Des. 136, 593, eq. (15)";
    Tabulated: Tabulated, "tabulated", Both,
        "a table of the exact bridge (`young-laplace`), made by this crate";
    YoungLaplace: YoungLaplace, "young-laplace", Both,
        "solved numerically: constant mean curvature at constant volume";
}

/// Radius m, mate, volume m³, angles in degrees, surface tension N/m.
type Row = (f64, Mate, f64, [f64; 2], f64);

/// Cases W11, W33, R1 and R3 of Gladkyy & Schwarze (2014), Table 1; the sphere-plane case of Elskamp
/// & Kruggel-Emden (2018); their wet POM and glass spheres, between themselves and on a steel wall.
const EXAMPLES: [Row; 10] = [
    (2.381e-3, Mate::Sphere { radius: 2.381e-3 }, 13.6e-12, [0.0, 0.0], 20.6e-3),
    (2.381e-3, Mate::Sphere { radius: 1.191e-3 }, 127.8e-12, [0.0, 0.0], 20.6e-3),
    (19e-6, Mate::Sphere { radius: 35e-6 }, 2e-19, [10.0, 10.0], 27e-3),
    (19e-6, Mate::Sphere { radius: 27.5e-6 }, 36e-19, [10.0, 10.0], 28e-3),
    (25e-6, Mate::PLANE, 170e-19, [10.0, 10.0], 26e-3),
    (2.5e-3, Mate::Sphere { radius: 2.5e-3 }, 1e-10, [40.0, 40.0], 72.75e-3),
    (2.5e-3, Mate::Sphere { radius: 5e-3 }, 1e-10, [15.0, 15.0], 72.75e-3),
    (2.5e-3, Mate::Sphere { radius: 3.5e-3 }, 5e-11, [5.0, 20.0], 72.75e-3),
    (2.5e-3, Mate::PLANE, 1e-9, [40.0, 45.0], 72.75e-3),
    (2.5e-3, Mate::PLANE, 1e-9, [15.0, 45.0], 72.75e-3),
];

impl AnyCapillary {
    /// Representative bridges inside the law's range: what benches, charts and tests loop over.
    #[must_use]
    pub fn examples(self) -> Vec<Bridge> {
        let bridge = |&(radius, mate, volume, angles, tension): &Row| {
            Bridge::new(radius, mate, volume, angles.map(f64::to_radians), tension).ok()
        };
        let fits = |bridge: &Bridge| self.validity().check(bridge).is_ok();
        EXAMPLES.iter().filter_map(bridge).filter(fits).collect()
    }
}

impl fmt::Display for AnyCapillary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for AnyCapillary {
    type Err = UnknownLaw;

    fn from_str(name: &str) -> Result<Self, UnknownLaw> {
        let known = Self::ALL.into_iter().find(|law| law.name() == name);
        known.ok_or_else(|| UnknownLaw { name: name.to_owned() })
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for AnyCapillary {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for AnyCapillary {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        name.parse().map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_go_there_and_back_and_differ() {
        for law in AnyCapillary::ALL {
            assert_eq!(law.name().parse(), Ok(law));
            assert_eq!(law.info().name, law.to_string());
            assert_eq!(law.info().validity, law.validity());
        }
    }

    #[test]
    fn an_unknown_name_lists_the_known_ones() {
        let said = "Lambert".parse::<AnyCapillary>().unwrap_err().to_string();
        assert!(said.contains("`Lambert`") && said.contains("lambert, willett-full"), "{said}");
    }

    #[test]
    fn every_law_has_examples_and_answers_like_its_own_type() {
        for law in AnyCapillary::ALL {
            assert!(law.examples().len() >= 2, "{law}");
        }
        let bridge = AnyCapillary::Lambert.examples()[0];
        let any = AnyCapillary::Lambert.force(&bridge, 1e-5, Range::Strict);
        assert_eq!(any, Lambert2008.force(&bridge, 1e-5, Range::Strict));
    }

    #[test]
    fn four_bridges_at_once_have_the_bits_of_each() {
        use pendular_lane::{Four, Lane};
        let cheap = |law: &AnyCapillary| *law != AnyCapillary::YoungLaplace;
        let mixed = [AnyCapillary::Lambert, AnyCapillary::Lambert, AnyCapillary::Rabinovich];
        for laws in AnyCapillary::ALL.into_iter().filter(cheap).map(|law| [law; 3]).chain([mixed]) {
            let curve = |k: usize| {
                let bridge = laws[k % 3].examples()[k % 2];
                laws[k % 3].curve(&bridge, Range::Strict).unwrap()
            };
            let curves = [curve(0), curve(1), curve(2), curve(3)];
            let gaps = [-1e-6, 0.0, 3e-6, 1e-4];
            let at_once = AnyCurve::forces(&curves.each_ref(), Four::pack((), &gaps, |gap| *gap));
            let each: [f64; 4] = std::array::from_fn(|k| curves[k].force(gaps[k]));
            assert_eq!(at_once.unpack().map(f64::to_bits), each.map(f64::to_bits), "{laws:?}");
        }
    }

    #[cfg(feature = "serde")]
    #[test]
    fn serde_reads_and_writes_the_name() {
        use serde::Deserialize;
        use serde::de::IntoDeserializer;
        use serde::de::value::{Error, StrDeserializer};

        struct Written(AnyCapillary);
        impl fmt::Display for Written {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                serde::Serialize::serialize(&self.0, f)
            }
        }
        for law in AnyCapillary::ALL {
            let text: StrDeserializer<'_, Error> = law.name().into_deserializer();
            assert_eq!(AnyCapillary::deserialize(text), Ok(law));
            assert_eq!(Written(law).to_string(), law.name());
        }
        let text: StrDeserializer<'_, Error> = "none".into_deserializer();
        assert!(AnyCapillary::deserialize(text).unwrap_err().to_string().contains("known: "));
    }
}
