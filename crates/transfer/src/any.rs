use std::fmt;
use std::str::FromStr;

use pendular_pair::{Bridge, OutOfRange, Range, Validity};

use crate::rupture::{Lian1993, Mikami1998, Tabulated, Willett2000, WillettUnequal2000};
use crate::{RuptureLaw, TransferError};

/// A rupture law chosen by name at run time.
///
/// ```
/// use pendular_transfer::AnyRupture;
/// assert_eq!("willett-unequal".parse(), Ok(AnyRupture::WillettUnequal));
/// assert!("willet".parse::<AnyRupture>().unwrap_err().to_string().contains("willett-unequal"));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum AnyRupture {
    /// [`Lian1993`].
    Lian,
    /// [`Willett2000`], equal spheres.
    Willett,
    /// [`WillettUnequal2000`].
    WillettUnequal,
    /// [`Mikami1998`], two spheres and sphere and wall.
    Mikami,
    /// [`Tabulated`], exact.
    Tabulated,
}

impl AnyRupture {
    /// Every law there is.
    pub const ALL: [Self; 5] =
        [Self::Lian, Self::Willett, Self::WillettUnequal, Self::Mikami, Self::Tabulated];

    /// The names of [`AnyRupture::ALL`], in the same order.
    pub const NAMES: [&'static str; 5] =
        ["lian", "willett", "willett-unequal", "mikami", "tabulated"];

    /// The law's name in scene files and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Lian => "lian",
            Self::Willett => "willett",
            Self::WillettUnequal => "willett-unequal",
            Self::Mikami => "mikami",
            Self::Tabulated => "tabulated",
        }
    }

    /// Where the law was published.
    #[must_use]
    pub fn source(self) -> &'static str {
        match self {
            Self::Lian => "Lian, Thornton & Adams 1993",
            Self::Willett => "Willett et al. 2000, equal spheres",
            Self::WillettUnequal => "Willett et al. 2000, unequal spheres",
            Self::Mikami => "Mikami, Kamiya & Horio 1998",
            Self::Tabulated => "Young-Laplace, tabulated",
        }
    }
}

impl RuptureLaw for AnyRupture {
    fn validity(&self) -> Validity {
        match self {
            Self::Lian => Lian1993.validity(),
            Self::Willett => Willett2000.validity(),
            Self::WillettUnequal => WillettUnequal2000.validity(),
            Self::Mikami => Mikami1998.validity(),
            Self::Tabulated => Tabulated.validity(),
        }
    }

    fn wall_validity(&self) -> Validity {
        match self {
            Self::Mikami => Mikami1998.wall_validity(),
            other => other.validity(),
        }
    }

    fn distance(&self, bridge: &Bridge, range: Range) -> Result<f64, OutOfRange> {
        match self {
            Self::Lian => Lian1993.distance(bridge, range),
            Self::Willett => Willett2000.distance(bridge, range),
            Self::WillettUnequal => WillettUnequal2000.distance(bridge, range),
            Self::Mikami => Mikami1998.distance(bridge, range),
            Self::Tabulated => Tabulated.distance(bridge, range),
        }
    }
}

impl FromStr for AnyRupture {
    type Err = TransferError;

    fn from_str(name: &str) -> Result<Self, TransferError> {
        Self::ALL
            .into_iter()
            .find(|law| law.name() == name)
            .ok_or_else(|| TransferError::UnknownLaw { name: name.to_owned(), known: &Self::NAMES })
    }
}

impl fmt::Display for AnyRupture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for AnyRupture {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for AnyRupture {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        name.parse().map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_round_trip() {
        for (law, name) in AnyRupture::ALL.into_iter().zip(AnyRupture::NAMES) {
            assert_eq!(law.name(), name);
            assert_eq!(name.parse::<AnyRupture>(), Ok(law));
            assert_eq!(law.to_string(), name);
            // Published laws name their year.
            let published = law != AnyRupture::Tabulated;
            assert_eq!(law.source().contains(|c: char| c.is_ascii_digit()), published);
        }
    }

    #[test]
    fn an_unknown_name_lists_the_known_ones() {
        let said = "Lian".parse::<AnyRupture>().unwrap_err().to_string();
        assert!(AnyRupture::NAMES.iter().all(|name| said.contains(name)), "{said}");
    }

    #[cfg(feature = "serde")]
    #[test]
    fn serde_reads_and_writes_the_name() {
        for law in AnyRupture::ALL {
            let text = serde_json::to_string(&law).unwrap();
            assert_eq!(text, format!("\"{law}\""));
            assert_eq!(serde_json::from_str::<AnyRupture>(&text).unwrap(), law);
        }
        let said = serde_json::from_str::<AnyRupture>("\"lien\"").unwrap_err().to_string();
        assert!(said.contains("lien") && said.contains("lian"), "{said}");
    }
}
