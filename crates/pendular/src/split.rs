use pendular_pair::Bridge;
use pendular_transfer::split::{Pair, parabola};
use pendular_transfer::{Split, TransferError};

/// How the transfer ratio of a rupture is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SplitMethod {
    /// The parabolic profile of Pepin (2000) and Shi & McCarthy (2008), as Elskamp &
    /// Kruggel-Emden (2018) use it.
    #[default]
    Parabola,
    /// Half to each body.
    Half,
}

impl SplitMethod {
    /// The share of each body when `bridge` breaks.
    ///
    /// # Errors
    /// [`TransferError`] where the method has no solution for the bridge.
    pub fn split(self, bridge: &Bridge) -> Result<Split, TransferError> {
        match self {
            Self::Half => Ok(Split::HALF),
            Self::Parabola => parabola::split(&Pair::of(bridge), bridge.volume()),
        }
    }
}
