use std::f64::consts::PI;

use super::problem::{Problem, State, cap_volume};

/// The neck of a meridian: its share of the length and its radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Neck {
    pub(super) t: f64,
    pub(super) radius: f64,
}

impl Problem {
    /// The narrowest place of the meridian; where both ends are narrower than a bulge between
    /// them, the thinner end, or the bulge itself if the ends are equal.
    pub(super) fn neck(&self, state: &State) -> Neck {
        let [beta, phase, length] = [state[0].exp(), state[1], state[2].exp()];
        let start = self.start(beta);
        let at = |t: f64| Neck { t, radius: Self::point(state, start, t).z.modulus() };
        let turn = phase.abs().max(1e-9);
        let (up, along) = (-turn * start.0.im, phase * start.0.re + length);
        let inside = |t: f64| (0.0..=1.0).contains(&t);
        // Im z = 0 where the profile is level: z + 1/q turns on a circle.
        let level = up.atan2(along) / turn;
        if inside(level) {
            return at(level);
        }
        let (first, last) = (at(0.0), at(1.0));
        let bulge = (-up).atan2(-along) / turn;
        if phase < 0.0 && inside(bulge) && (first.radius / last.radius - 1.0).abs() < 1e-9 {
            return at(bulge);
        }
        if first.radius < last.radius { first } else { last }
    }

    /// Share of the liquid between the first body and the point `t` of the meridian.
    pub(super) fn share_before(&self, state: &State, t: f64) -> f64 {
        let beta = state[0].exp();
        let start = self.start(beta);
        let length = state[2].exp();
        let slice = |&(s, weight): &(f64, f64)| {
            let z = Self::point(state, start, t * s).z;
            weight * t * length * PI * z.modulus() * z.re
        };
        let y = self.radius * beta.sin();
        let half = (0.5 * beta).sin();
        let cap = cap_volume(y * y, 2.0 * self.radius * half * half);
        let volume = self.rule.points().iter().map(slice).sum::<f64>() - cap;
        (volume / self.volume).clamp(0.0, 1.0)
    }

    /// F/(πσR) = 2 y cos α + q y², constant along the meridian.
    pub(super) fn pull(&self, state: &State) -> f64 {
        let (z, _) = self.start(state[0].exp());
        let y = z.modulus();
        2.0 * z.re + state[1] * (-state[2]).exp() * y * y
    }

    /// Free surface of the liquid over R².
    pub(super) fn free_area(&self, state: &State) -> f64 {
        let start = self.start(state[0].exp());
        let ds = 2.0 * PI * state[2].exp();
        self.rule
            .points()
            .iter()
            .map(|&(t, w)| w * ds * Self::point(state, start, t).z.modulus())
            .sum()
    }

    /// Radii of the two contact lines over R.
    pub(super) fn contact_radii(&self, state: &State) -> [f64; 2] {
        let start = self.start(state[0].exp());
        [start.0.modulus(), Self::point(state, start, 1.0).z.modulus()]
    }

    /// Half-filling angles, rad; the second is 0 for a plane.
    pub(super) fn half_filling_angles(&self, state: &State) -> [f64; 2] {
        let radii = self.contact_radii(state);
        [state[0].exp(), (self.curvature * radii[1]).min(1.0).asin()]
    }

    /// Wetted areas of the two bodies over R².
    pub(super) fn wetted_areas(&self, state: &State) -> [f64; 2] {
        let half = (0.5 * state[0].exp()).sin();
        let second = self.contact_radii(state)[1];
        let cos = (1.0 - (self.curvature * second).powi(2)).max(0.0).sqrt();
        [4.0 * PI * (self.radius * half).powi(2), 2.0 * PI * second * second / (1.0 + cos)]
    }

    /// Axial distance over R of the point `t` from the first body's surface on the axis.
    pub(super) fn position(&self, state: &State, t: f64) -> f64 {
        let start = self.start(state[0].exp());
        let half = (0.5 * state[0].exp()).sin();
        let ds = t * state[2].exp();
        let slice = |&(s, weight): &(f64, f64)| {
            let z = Self::point(state, start, t * s).z;
            weight * ds * z.re / z.modulus()
        };
        let run: f64 = self.rule.points().iter().map(slice).sum();
        run - 2.0 * self.radius * half * half
    }
}
