use std::time::Duration;

/// Where the time of a run went. Parallel parts are summed over the threads.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Profile {
    /// Building and pruning neighbour lists.
    pub neighbours: Duration,
    /// Forces between particles.
    pub pairs: Duration,
    /// Forces between particles and walls.
    pub walls: Duration,
    /// Settling what pairs share: bridges formed and broken, liquid booked.
    pub settling: Duration,
    /// Solving for what resists ([`crate::Implicit`]).
    pub resistance: Duration,
    /// Moving the particles.
    pub integration: Duration,
    /// How often the outer neighbour lists were built.
    pub builds: u64,
    /// How often the active lists were pruned.
    pub prunes: u64,
}
