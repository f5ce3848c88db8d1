//! How far particles have moved since the lists were built.

use glam::{DVec3, Vec3};

use crate::particles::Place;

/// Where the particles were at the last build, from one point, in single precision.
#[derive(Debug, Default)]
pub(super) struct Built {
    from: DVec3,
    at: Vec<Vec3>,
    /// How far off a place may be, m.
    error: f64,
}

impl Built {
    /// Keeps where they are now.
    pub(super) fn note(&mut self, places: &[Place]) {
        let low = places.iter().fold(DVec3::INFINITY, |low, p| low.min(p.x));
        let high = places.iter().fold(DVec3::NEG_INFINITY, |high, p| high.max(p.x));
        self.from = 0.5 * (low + high);
        self.error = (high - low).length() * f64::from(f32::EPSILON);
        self.at.clear();
        self.at.reserve_exact(places.len());
        self.at.extend(places.iter().map(|p| (p.x - self.from).as_vec3()));
    }

    /// Upper bound of how far a particle has moved since, m, the common motion taken out.
    pub(super) fn most_moved(&self, places: &[Place]) -> f64 {
        let moved = || places.iter().zip(&self.at).map(|(p, x)| p.x - self.from - x.as_dvec3());
        let low = moved().fold(DVec3::INFINITY, DVec3::min);
        let high = moved().fold(DVec3::NEG_INFINITY, DVec3::max);
        let centre = 0.5 * (low + high);
        let most = moved().fold(0.0_f64, |most, d| most.max((d - centre).length_squared()));
        most.sqrt() + self.error
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cloud that moves as a whole by much and, here and there, by 1e-5 m or less.
    #[test]
    fn the_bound_holds_and_is_near() {
        let place = |k: u32, moved: f64| {
            let at = DVec3::new(0.037, -0.0011, 0.00023) * f64::from(k % 97);
            let own = DVec3::new(f64::from(k % 3) - 1.0, 0.0, 0.0) * 1e-5;
            Place { x: at + moved * (DVec3::splat(0.25) + own), r: 1e-3 }
        };
        let at = |moved: f64| (0..300).map(|k| place(k, moved)).collect::<Vec<_>>();
        let mut built = Built::default();
        built.note(&at(0.0));
        let bound = built.most_moved(&at(1.0));
        assert!((1e-5..1.1e-5).contains(&bound), "{bound}");
    }
}
