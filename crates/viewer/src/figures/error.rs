//! Why a figure cannot be drawn.

use platewash_motion::trajectory::KnotError;
use platewash_workcell::words::plate_name;

/// Reason that a figure cannot be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FigureError {
    /// Knots that are no motion.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// Nothing moves.
    #[error("the plan has {knots} knots; a motion has at least 2")]
    NoMotion {
        /// Number of knots.
        knots: usize,
    },
    /// The motion leads nowhere that could be drawn.
    #[error("at {t_s} s the tip is not at a finite place, or farther from the base than {FARTHEST_M} m")]
    Nowhere {
        /// Time \[s\].
        t_s: f64,
    },
    /// A segment whose plate does not exist, or whose times are not valid.
    #[error(
        "segment {segment}: {} of {plates}, from {t_start_s} to {t_end_s} s, is not a part of the motion",
        plate_name(*.plate)
    )]
    Segment {
        /// Index of the segment.
        segment: usize,
        /// The plate that it names.
        plate: usize,
        /// Number of plates.
        plates: usize,
        /// Its start \[s\].
        t_start_s: f64,
        /// Its end \[s\].
        t_end_s: f64,
    },
    /// No plate is washed. Other figures of the same plan can be drawn all the same.
    #[error("the figure \"{figure}\" shows what is washed; the plan washes no plate")]
    NothingWashed {
        /// The figure.
        figure: &'static str,
    },
    /// A plate that is nowhere or of no size.
    #[error("{}: its centre, height, radius and thickness must be finite, the latter two above 0", plate_name(*.plate))]
    NoPlate {
        /// Index of the plate.
        plate: usize,
    },
}

/// Farther from the base than this \[m\] nothing is drawn.
pub(super) const FARTHEST_M: f64 = 100.0;
