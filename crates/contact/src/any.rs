use std::str::FromStr;

use crate::{ElasticPlastic, HertzMindlin, Linear, NormalContact, PlasticMemory};

/// The contact laws by name. Text and serde form are the names of [`Self::NAMES`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum ContactModel {
    /// `linear`: [`Linear`].
    Linear,
    /// `hertz-mindlin`: [`HertzMindlin`].
    HertzMindlin,
    /// `elastic-plastic`: [`ElasticPlastic`].
    ElasticPlastic,
}

/// A name that no contact law has.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("unknown contact law {name:?}: expected one of {}", ContactModel::NAMES.join(", "))]
pub struct UnknownContact {
    /// What was asked for.
    pub name: String,
}

impl ContactModel {
    /// Every law.
    pub const ALL: &'static [Self] = &[Self::Linear, Self::HertzMindlin, Self::ElasticPlastic];
    /// Every law's name, in the order of [`Self::ALL`].
    pub const NAMES: &'static [&'static str] = &["linear", "hertz-mindlin", "elastic-plastic"];

    /// The law's name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::HertzMindlin => "hertz-mindlin",
            Self::ElasticPlastic => "elastic-plastic",
        }
    }
}

impl FromStr for ContactModel {
    type Err = UnknownContact;

    fn from_str(name: &str) -> Result<Self, UnknownContact> {
        let found = Self::ALL.iter().find(|model| model.name() == name);
        found.copied().ok_or(UnknownContact { name: name.into() })
    }
}

impl std::fmt::Display for ContactModel {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(self.name())
    }
}

/// A contact law chosen at run time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AnyContact {
    /// `linear`.
    Linear(Linear),
    /// `hertz-mindlin`.
    HertzMindlin(HertzMindlin),
    /// `elastic-plastic`.
    ElasticPlastic(ElasticPlastic),
}

impl AnyContact {
    /// Which law it is.
    #[must_use]
    pub fn model(&self) -> ContactModel {
        match self {
            Self::Linear(_) => ContactModel::Linear,
            Self::HertzMindlin(_) => ContactModel::HertzMindlin,
            Self::ElasticPlastic(_) => ContactModel::ElasticPlastic,
        }
    }
}

impl From<Linear> for AnyContact {
    fn from(law: Linear) -> Self {
        Self::Linear(law)
    }
}

impl From<HertzMindlin> for AnyContact {
    fn from(law: HertzMindlin) -> Self {
        Self::HertzMindlin(law)
    }
}

impl From<ElasticPlastic> for AnyContact {
    fn from(law: ElasticPlastic) -> Self {
        Self::ElasticPlastic(law)
    }
}

impl NormalContact for AnyContact {
    /// Used by the elastic-plastic law alone.
    type Memory = PlasticMemory;

    #[inline]
    fn force(&self, overlap: f64, approach_speed: f64, memory: &mut PlasticMemory) -> f64 {
        match self {
            Self::Linear(law) => law.force(overlap, approach_speed, &mut ()),
            Self::HertzMindlin(law) => law.force(overlap, approach_speed, &mut ()),
            Self::ElasticPlastic(law) => law.force(overlap, approach_speed, memory),
        }
    }

    #[inline]
    fn stiffness(&self, overlap: f64) -> f64 {
        match self {
            Self::Linear(law) => law.stiffness(overlap),
            Self::HertzMindlin(law) => law.stiffness(overlap),
            Self::ElasticPlastic(law) => law.stiffness(overlap),
        }
    }

    #[inline]
    fn tangential_stiffness(&self, overlap: f64) -> f64 {
        match self {
            Self::Linear(law) => law.tangential_stiffness(overlap),
            Self::HertzMindlin(law) => law.tangential_stiffness(overlap),
            Self::ElasticPlastic(law) => law.tangential_stiffness(overlap),
        }
    }

    #[inline]
    fn damping(&self, overlap: f64) -> f64 {
        match self {
            Self::Linear(law) => law.damping(overlap),
            Self::HertzMindlin(law) => law.damping(overlap),
            Self::ElasticPlastic(law) => law.damping(overlap),
        }
    }

    #[inline]
    fn may_pull(&self) -> bool {
        match self {
            Self::Linear(law) => law.may_pull(),
            Self::HertzMindlin(law) => law.may_pull(),
            Self::ElasticPlastic(law) => law.may_pull(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_go_both_ways_and_an_unknown_one_lists_them() {
        for (model, name) in ContactModel::ALL.iter().zip(ContactModel::NAMES) {
            assert_eq!(model.name(), *name);
            assert_eq!(name.parse(), Ok(*model));
        }
        let said = "hertz".parse::<ContactModel>().unwrap_err().to_string();
        assert!(said.contains("\"hertz\"") && said.contains("linear, hertz-mindlin"), "{said}");
    }
}
