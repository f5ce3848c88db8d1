/// How the stable bridge ends when it is drawn out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum RuptureKind {
    /// Stable and unstable bridge merge and vanish.
    Fold,
    /// The symmetric bridge between equal bodies gives way sideways, to a bridge whose neck is
    /// off the middle, before its fold.
    Pitchfork,
}

/// The end of the stable branch.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Rupture {
    /// Rupture distance S_rup, m: the largest gap of a stable bridge.
    pub distance: f64,
    /// What ends there.
    pub kind: RuptureKind,
    /// Share of the liquid on the first body's side of the neck of the last stable bridge.
    pub share: f64,
}
