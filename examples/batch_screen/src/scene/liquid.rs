//! The liquid of a scene.

use serde::Deserialize;

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct LiquidSpec {
    /// Mass of liquid over dry mass of particles, percent.
    pub(crate) moisture_percent: f64,
    pub(crate) density: f64,
    pub(crate) surface_tension: f64,
    pub(crate) viscosity: f64,
    /// Laws by name; `auto` leaves the choice to a pilot run, drags may be `none`.
    pub(crate) capillary: String,
    pub(crate) capillary_wall: String,
    pub(crate) normal_drag: String,
    pub(crate) tangential_drag: String,
    pub(crate) tangential_drag_wall: String,
    /// How drags enter the step.
    #[serde(default)]
    pub(crate) drag: Drag,
    /// Share of the impulses at which the passes of implicit drags stop.
    pub(crate) drag_tolerance: Option<f64>,
    /// Roughness of the lubrication gap as a share of the radius.
    #[serde(default = "thousandth")]
    pub(crate) roughness_share: f64,
    pub(crate) rupture: String,
    pub(crate) rupture_wall: String,
    pub(crate) dynamic_rupture: DynamicRupture,
    pub(crate) transfer: Transfer,
    pub(crate) outside_range: OutsideRange,
}

/// How drags, and with them dashpots and rolling friction, enter the step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Drag {
    /// Explicit while the drags allow as long a step as the contacts do, else implicit.
    #[default]
    Auto,
    /// With the velocities before the step.
    Explicit,
    /// With those after it: no drag limits the step.
    Implicit,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum DynamicRupture {
    None,
    /// Decided before the run.
    Auto,
    Pitois,
    Grohn,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Transfer {
    Exact,
    Parabola,
    Half,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum OutsideRange {
    /// Stop the run.
    Refuse,
    /// Go on and count.
    Extrapolate,
}

fn thousandth() -> f64 {
    0.001
}
