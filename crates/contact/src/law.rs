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

    /// Dashpot coefficient at `overlap`, N s/m.
    fn damping(&self, overlap: f64) -> f64;

    /// Whether the dashpot may pull more than the spring pushes while the bodies separate.
    fn may_pull(&self) -> bool {
        false
    }
}
