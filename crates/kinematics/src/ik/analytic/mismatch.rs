//! Property of a structure that an arm does not have.

/// Property of the structure that an arm does not have, with the deviation.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StructureMismatch {
    /// Two axes that must be parallel are not.
    #[error("axes {} and {} are not parallel, by {by_rad:.3e} rad", .joints[0] + 1, .joints[1] + 1)]
    NotParallel {
        /// Joint indices, 0 for joint 1.
        joints: [usize; 2],
        /// Angle between the two lines \[rad\].
        by_rad: f64,
    },
    /// Two axes that must be perpendicular are not.
    #[error("axes {} and {} are not perpendicular, by {by_rad:.3e} rad", .joints[0] + 1, .joints[1] + 1)]
    NotPerpendicular {
        /// Joint indices, 0 for joint 1.
        joints: [usize; 2],
        /// Deviation from 90° \[rad\].
        by_rad: f64,
    },
    /// Axes 4, 5 and 6 do not meet in one point.
    #[error(
        "the wrist is not spherical: axes 4, 5 and 6 do not meet in one point, as axes {} and {} miss each other by {:.4} mm",
        .joints[0] + 1, .joints[1] + 1, 1e3 * .by_m
    )]
    WristNotSpherical {
        /// Joint indices, 0 for joint 1.
        joints: [usize; 2],
        /// Distance between the two lines (4, 5), or of axis 6 from the wrist centre (5, 6) \[m\].
        by_m: f64,
    },
    /// Axes 5 and 6 do not meet, on an arm with parallel axes 2, 3 and 4.
    #[error("axes 5 and 6 do not meet: they miss each other by {:.4} mm", 1e3 * .by_m)]
    AxesDoNotMeet {
        /// Distance between the two lines \[m\].
        by_m: f64,
    },
    /// The point where axes 5 and 6 meet has no offset along axis 2 from axis 1, on an arm with parallel axes 2, 3 and 4.
    #[error("axes 2, 3 and 4 are parallel, and the point where axes 5 and 6 meet has no offset along them from axis 1")]
    NoLateralOffset,
    /// Axes 2 and 3 coincide.
    #[error("the upper arm, axis 2 to axis 3, is only {length_m:.3e} m long")]
    NoUpperArm {
        /// Distance between the axes \[m\].
        length_m: f64,
    },
    /// The wrist centre lies on axis 3, or axes 3 and 4 coincide where axes 2, 3 and 4 are parallel.
    #[error("the forearm, axis 3 to the wrist centre or axis 4, is only {length_m:.3e} m long")]
    NoForearm {
        /// Length of the forearm \[m\].
        length_m: f64,
    },
}

/// Greatest deviation of an angle that the rounding of a description explains \[rad\]: printed values of five decimals, such as 1.5708 for
/// π/2, deviate by 4e-6.
const ROUNDED_RAD: f64 = 1e-5;
/// Greatest deviation of a length that the rounding of a description explains \[m\]: half a unit of the sixth decimal, twice.
pub(crate) const ROUNDED_M: f64 = 1e-6;

impl StructureMismatch {
    /// True where the rounding of the description's numbers explains the deviation.
    pub(super) fn is_rounding(&self) -> bool {
        match self {
            Self::NotParallel { by_rad, .. } | Self::NotPerpendicular { by_rad, .. } => *by_rad <= ROUNDED_RAD,
            Self::WristNotSpherical { by_m, .. } | Self::AxesDoNotMeet { by_m } => *by_m <= ROUNDED_M,
            Self::NoLateralOffset | Self::NoUpperArm { .. } | Self::NoForearm { .. } => false,
        }
    }
}
