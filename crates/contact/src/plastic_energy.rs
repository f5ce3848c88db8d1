use crate::error::positive;
use crate::{ContactError, ElasticPlastic, PlasticMemory};

/// Work and elastic energy, and what follows from them.
impl ElasticPlastic {
    /// Work of a first loading to `overlap` (m), J: the integral of [`Self::loading_force`].
    #[must_use]
    pub fn loading_work(&self, overlap: f64) -> f64 {
        let (s, s_y) = (overlap, self.yield_overlap);
        if s <= s_y {
            return 0.4 * self.loading_force(s) * s.max(0.0);
        }
        let c = self.root(s);
        let above = s * s * (1.0 - c + 0.25 * c * c) - 0.25 * s_y * s_y;
        0.4 * self.yield_force() * s_y + self.plastic * above
    }

    /// Elastic energy of a first loading to `overlap` (m), J (eq. 16): what unloading gives back.
    #[must_use]
    pub fn elastic_energy(&self, overlap: f64) -> f64 {
        let (s, s_y) = (overlap, self.yield_overlap);
        if s <= s_y {
            return self.loading_work(s);
        }
        let c = self.root(s);
        let above = s * s * c * (0.8 - 0.5 * c) - 0.3 * s_y * s_y;
        0.4 * self.yield_force() * s_y + self.plastic * above
    }

    /// Permanent deformation s_pl after a loading to `overlap` (m), m (eq. 18).
    #[must_use]
    pub fn plastic_overlap(&self, overlap: f64) -> f64 {
        if overlap <= self.yield_overlap {
            return 0.0;
        }
        let back = 2.5 * self.elastic_energy(overlap) / self.loading_force(overlap);
        (overlap - back).max(0.0)
    }

    /// Elastic energy that the contact holds at `overlap` (m) with its `memory`, J.
    #[must_use]
    pub fn stored_energy(&self, overlap: f64, memory: &PlasticMemory) -> f64 {
        let PlasticMemory { max_overlap, plastic_overlap } = *memory;
        if max_overlap == 0.0 || overlap >= max_overlap {
            return self.elastic_energy(overlap);
        }
        let back = (overlap - plastic_overlap).max(0.0);
        0.4 * self.unloading_force(overlap, memory) * back
    }

    /// Restitution of an impact at `speed` (m/s) of bodies of `reduced_mass` m* (kg):
    /// √(E_el/(m* v²/2)) at the overlap that stops it.
    ///
    /// # Errors
    /// [`ContactError`] unless both are positive and finite.
    pub fn restitution(&self, reduced_mass: f64, speed: f64) -> Result<f64, ContactError> {
        positive("reduced mass", reduced_mass)?;
        positive("speed", speed)?;
        let kinetic = 0.5 * reduced_mass * speed * speed;
        positive("kinetic energy", kinetic)?;
        if speed <= self.yield_speed(reduced_mass) {
            return Ok(1.0);
        }
        // W ≥ 1/4 π R* p_y s² above yield, so the root lies below the overlap where that is E.
        let (mut low, mut high) = (self.yield_overlap, 2.0 * (kinetic / self.plastic).sqrt());
        high = high.max(low);
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if self.loading_work(middle) < kinetic {
                low = middle;
            } else {
                high = middle;
            }
        }
        Ok((self.elastic_energy(high) / self.loading_work(high)).sqrt().min(1.0))
    }
}
