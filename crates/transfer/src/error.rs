use pendular_pair::OutOfRange;

/// What can go wrong when liquid is to be moved.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TransferError {
    /// A value that the physics or the model does not allow.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// A law was asked for by a name that nobody has.
    #[error("unknown rupture law \"{name}\"; known: {}", known.join(", "))]
    UnknownLaw {
        /// The name as it was given.
        name: String,
        /// All names there are.
        known: &'static [&'static str],
    },
    /// The equations of the transfer model have no solution for this bridge.
    #[error("no bridge profile at volume {volume} m³ and gap {gap} m: {reason}")]
    NoSolution {
        /// Volume of the bridge, m³.
        volume: f64,
        /// Gap at which the profile was sought, m.
        gap: f64,
        /// What stands in the way.
        reason: NoSolution,
    },
    /// A stored table of transfer ratios could not be read.
    #[error("transfer table, line {line}: {reason}")]
    Table {
        /// Line of the file, counted from 1; 0 if the whole file is meant.
        line: u64,
        /// What is wrong with it.
        reason: TableFault,
    },
}

/// Why a bridge profile does not exist.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NoSolution {
    /// A contact angle of 90° or more: the profile has no neck between the bodies.
    #[error("a contact angle of 90 degrees or more leaves no neck")]
    ContactAngle,
    /// The profile that meets both contact angles would cross the axis.
    #[error("the neck would close before the gap is reached")]
    NeckCloses,
    /// The liquid would be wider at a contact line than anywhere between.
    #[error("the bridge is too full to have a neck")]
    NoNeck,
    /// The contact angles cannot both be met on the two bodies.
    #[error("the two contact angles cannot be met together")]
    Angles,
}

/// What is wrong with a stored table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TableFault {
    /// Not the columns that are expected.
    #[error("the columns are not the expected ones")]
    Columns,
    /// A cell is not a number where one is due.
    #[error("a cell is not a finite number")]
    Number,
    /// V* does not rise from row to row.
    #[error("v_star must rise from row to row")]
    Order,
    /// A transfer ratio outside [0, 1].
    #[error("a transfer ratio lies outside 0 to 1")]
    Ratio,
    /// Fewer than two nodes.
    #[error("fewer than two nodes")]
    TooShort,
    /// A pair of bodies of an unknown kind.
    #[error("the pair's kind is none of sphere, large_wall, small_wall")]
    Kind,
}
