use pendular_lane::Lane;

/// A normal contact law of one pair of bodies, its constants folded.
pub trait NormalContact: Copy {
    /// What the contact remembers while it lasts; `()` where the law has no history.
    type Memory: Copy + Default + Send + Sync;

    /// Repulsive force, N (positive pushes the bodies apart).
    ///
    /// `overlap` δ = −S > 0 in m, `approach_speed` dδ/dt in m/s, positive while the bodies approach.
    fn force(&self, overlap: f64, approach_speed: f64, memory: &mut Self::Memory) -> f64;

    /// Stiffness dF/dδ at `overlap`, N/m: the largest over loading and unloading there.
    fn stiffness(&self, overlap: f64) -> f64;

    /// Tangential stiffness k_t at `overlap`, N/m.
    fn tangential_stiffness(&self, overlap: f64) -> f64;

    /// 1/k_t at `overlap`, m/N; 0 where there is no tangential spring.
    #[inline(always)]
    fn tangential_softness(&self, overlap: f64) -> f64 {
        let stiffness = self.tangential_stiffness(overlap);
        if stiffness > 0.0 { 1.0 / stiffness } else { 0.0 }
    }

    /// Force, k_t and 1/k_t of contacts side by side: of each to the bit the same, however many there
    /// are.
    #[inline(always)]
    fn side_by_side<L: Lane>(
        laws: &L::Each<&Self>,
        overlap: L,
        approach_speed: L,
        memories: &mut L::Each<Self::Memory>,
    ) -> [L; 3] {
        let (overlaps, speeds) = (overlap.unpack(), approach_speed.unpack());
        let each = L::each(|k| {
            let (law, overlap) = (laws[k], overlaps[k]);
            let force = law.force(overlap, speeds[k], &mut memories[k]);
            [force, law.tangential_stiffness(overlap), law.tangential_softness(overlap), 0.0]
        });
        let [force, stiffness, softness, _] = L::rows(overlap.permit(), &each, |each| *each);
        [force, stiffness, softness]
    }

    /// Dashpot coefficient at `overlap`, N s/m.
    fn damping(&self, overlap: f64) -> f64;

    /// Whether the dashpot may pull more than the spring pushes while the bodies separate.
    fn may_pull(&self) -> bool {
        false
    }
}
