//! Why a figure cannot be drawn.

use super::ink::png::PngError;
use platewash_workcell::segment::SegmentKind;
use platewash_workcell::trajectory::KnotError;

/// Why a figure cannot be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FigureError {
    /// A figure of a moment, and no moment.
    #[error("the figure \"moment\" shows the arm at a time: say which, by --at SECONDS")]
    NoMoment,
    /// A moment that the motion does not have.
    #[error("the motion lasts from 0 to {duration_s} s; there is no {at_s} s in it")]
    Moment {
        /// The time asked for \[s\].
        at_s: f64,
        /// How long the motion lasts \[s\].
        duration_s: f64,
    },
    /// Knots that are no motion.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// Nothing moves.
    #[error("the plan has {knots} knots; a motion has at least 2")]
    NoMotion {
        /// How many there are.
        knots: usize,
    },
    /// The motion leads nowhere that could be drawn.
    #[error("at {t_s} s the tip is not at a finite place, or farther from the base than {FARTHEST_M} m")]
    Nowhere {
        /// When \[s\].
        t_s: f64,
    },
    /// A segment that names what there is not, or a time that is none.
    #[error(
        "segment {segment}: plate {plate} of {plates}, from {t_start_s} to {t_end_s} s, is no stretch of the motion"
    )]
    Segment {
        /// Index of the segment.
        segment: usize,
        /// The plate that it names.
        plate: usize,
        /// How many there are.
        plates: usize,
        /// Its start \[s\].
        t_start_s: f64,
        /// Its end \[s\].
        t_end_s: f64,
    },
    /// No segment is what the figure shows.
    #[error("the figure \"{figure}\" shows the arm in a segment \"{}\"; the plan has none", .kind.name())]
    NoSegment {
        /// The figure.
        figure: &'static str,
        /// What it would show.
        kind: SegmentKind,
    },
    /// No plate is washed.
    #[error("the figure \"{figure}\" shows what is washed; the plan washes no plate")]
    NothingWashed {
        /// The figure.
        figure: &'static str,
    },
    /// Neither is anything proved, nor claimed.
    #[error(
        "the figure \"sheet\" shows what is proved of a plan, or measured of a run of the paper's program; nothing is known of either"
    )]
    NothingKnown,
    /// A plate that is nowhere or of no size.
    #[error("plate {plate}: its centre, height, radius and thickness must be finite, the latter two above 0")]
    NoPlate {
        /// Index of the plate.
        plate: usize,
    },
    /// The drawing became no picture.
    #[error(transparent)]
    Png(#[from] PngError),
}

impl FigureError {
    /// Whether other figures of the same plan can be drawn all the same.
    #[must_use]
    pub fn is_of_one_figure(&self) -> bool {
        match self {
            Self::NoSegment { .. } | Self::NothingWashed { .. } | Self::NothingKnown | Self::NoMoment => true,
            Self::Moment { .. } | Self::Knots(_) | Self::NoMotion { .. } => false,
            Self::Nowhere { .. } | Self::Segment { .. } | Self::NoPlate { .. } | Self::Png(_) => false,
        }
    }
}

/// Farther from the base than this \[m\] nothing is drawn.
pub(super) const FARTHEST_M: f64 = 100.0;
