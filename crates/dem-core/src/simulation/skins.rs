//! How far lists look: what costs least at the speed that the particles have.

use super::Settings;
use crate::Class;

/// Cost of finding a particle's pairs, over that of looking at one pair while pruning.
const BUILD: f64 = 110.0;
/// Cost of looking at a pair while pruning, over that of an active pair in a step.
const PRUNE: f64 = 0.25;

/// The skins of the lists, m.
///
/// A list with the skin s lasts s/w steps, where gaps change by at most w in one. A wider skin has
/// more pairs in it, n for each metre. With N particles, P outer pairs and the costs B of finding a
/// particle's pairs, p of looking at a pair while pruning and a in a step, a step costs
///
/// ```text
/// B N w/s_outer + p (P + n s_outer) w/s_inner + a n s_inner
/// least at   s_inner = sqrt(w P p/(n a)),   s_outer = sqrt(s_inner B N/(n p))
/// ```
///
/// Results do not depend on them.
#[derive(Debug)]
pub(super) struct Skins {
    pub(super) outer: f64,
    pub(super) inner: f64,
    /// That of the lists of walls, which few particles are in.
    pub(super) walls: f64,
    /// How far gaps may have changed in the last step.
    pub(super) pace: f64,
    /// Whether outer and inner are given.
    fixed: [bool; 2],
    /// Smallest radius.
    radius: f64,
}

impl Skins {
    pub(super) fn new(classes: &[Class], settings: &Settings) -> Self {
        let smallest = classes.iter().fold(f64::INFINITY, |r, class| r.min(class.radius()));
        let radius = if smallest.is_finite() { smallest } else { 1.0 };
        let outer = settings.skin.unwrap_or(0.2 * radius);
        let inner = settings.inner_skin.unwrap_or(0.02 * radius).min(outer);
        let fixed = [settings.skin.is_some(), settings.inner_skin.is_some()];
        Self { outer, inner, walls: outer, pace: 0.0, fixed, radius }
    }

    /// Chooses the outer skin by what the lists with the present ones hold.
    pub(super) fn choose_outer(&mut self, particles: usize, pairs: [usize; 2]) {
        if let (false, Some(density)) = (self.fixed[0], self.density(pairs)) {
            let best = (self.inner * BUILD * particles as f64 / density).sqrt();
            self.outer = best.clamp(0.1 * self.radius, self.radius);
        }
    }

    /// Likewise the inner skin.
    pub(super) fn choose_inner(&mut self, pairs: [usize; 2]) {
        if let (false, Some(density)) = (self.fixed[1], self.density(pairs)) {
            let best = (self.pace * PRUNE * pairs[0] as f64 / density).sqrt();
            self.inner = best.clamp(0.005 * self.radius, 0.1 * self.radius);
        }
        self.inner = self.inner.min(self.outer);
    }

    /// Pairs for each metre of skin; `None` where there is nothing to go by.
    fn density(&self, [outer, active]: [usize; 2]) -> Option<f64> {
        let (more, wider) = (outer.saturating_sub(active) as f64, self.outer - self.inner);
        (more > 0.0 && wider > 0.0 && self.pace > 0.0).then_some(more / wider)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1000 spheres of 1 mm with 2500 pairs at contact and 8000 for each millimetre of gap.
    fn pairs(skin: f64) -> usize {
        (2500.0 + 8e6 * skin) as usize
    }

    #[test]
    fn the_skins_cost_least() {
        let classes = [Class::new(1e-3, 2500.0, 0).unwrap()];
        let pace = 3e-6;
        let cost = |outer: f64, inner: f64| {
            let prune = PRUNE * pairs(outer) as f64 / inner;
            PRUNE * BUILD * 1000.0 * pace / outer + prune * pace + 8e6 * inner
        };
        let mut skins = Skins { pace, ..Skins::new(&classes, &Settings::new(1e-6)) };
        for _ in 0..20 {
            let found = [pairs(skins.outer), pairs(skins.inner)];
            skins.choose_outer(1000, found);
            skins.choose_inner([pairs(skins.outer), pairs(skins.inner)]);
        }
        let (outer, inner) = (skins.outer, skins.inner);
        let least = cost(outer, inner);
        for factor in [0.8, 1.25] {
            assert!(cost(factor * outer, inner) > least, "{outer} {inner}");
            assert!(cost(outer, factor * inner) > least, "{outer} {inner}");
        }
    }

    #[test]
    fn what_is_given_stays_and_rest_changes_nothing() {
        let classes = [Class::new(1e-3, 2500.0, 0).unwrap()];
        let given = Settings { skin: Some(3e-4), inner_skin: Some(1e-5), ..Settings::new(1e-6) };
        let mut fixed = Skins { pace: 1e-6, ..Skins::new(&classes, &given) };
        let mut still = Skins::new(&classes, &Settings::new(1e-6));
        for skins in [&mut fixed, &mut still] {
            skins.choose_outer(1000, [5000, 2500]);
            skins.choose_inner([5000, 2500]);
        }
        assert_eq!([fixed.outer, fixed.inner], [3e-4, 1e-5]);
        assert_eq!([still.outer, still.inner], [2e-4, 2e-5]);
    }
}
