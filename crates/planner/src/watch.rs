//! Watch: the caller that waits for planning, and the activities that it is told of.

use platewash_workcell::cancel::CancelToken;
use platewash_workcell::words::plate_name;
use std::fmt;

/// Callback that receives the current activity of planning; it is called often, and must not take long.
pub type Listener<'a> = &'a (dyn Fn(&Activity) + Sync);

/// Connection of planning to its caller, who receives its activities and may cancel it.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    /// Callback that receives the current activity.
    pub tell: Listener<'a>,
    /// Tells it to give up.
    pub cancel: &'a CancelToken,
}

impl<'a> Watch<'a> {
    /// Nobody listens.
    #[must_use]
    pub fn silent(cancel: &'a CancelToken) -> Self {
        Self { tell: &|_| (), cancel }
    }
}

impl fmt::Debug for Watch<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Watch")
            .field("cancel", self.cancel)
            .finish_non_exhaustive()
    }
}

/// Current activity of planning.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Activity {
    /// Drawing a layout of which every plate can be washed.
    #[error("layout {drawn} of at most {most}: whether it can be washed")]
    Layout {
        /// The layout, from 1.
        drawn: usize,
        /// Greatest number of layouts drawn.
        most: usize,
    },
    /// Looking for configurations that wash a plate, and timing its wash.
    #[error("washing of {} ({turn} of {of})", plate_name(*.plate))]
    Wash {
        /// The plate.
        plate: usize,
        /// Its place in the order of washing, from 1.
        turn: usize,
        /// Plates in all.
        of: usize,
    },
    /// Looking for a transit between plates, or from or to home.
    #[error("transit {turn} of {of} between home and plates")]
    Transit {
        /// The transit, from 1.
        turn: usize,
        /// Transits in all.
        of: usize,
    },
    /// Searching for the obstruction that keeps a plate from being washed, on every branch of the arm.
    #[error("what keeps {} from being washed, branch by branch", plate_name(*.plate))]
    Cause {
        /// The plate.
        plate: usize,
    },
    /// Looking for another place for a plate.
    #[error("another place for {}: {away_m:.2} m away (ring {ring} of {of})", plate_name(*.plate))]
    Relocation {
        /// The plate.
        plate: usize,
        /// The ring of places tried, from 1.
        ring: u32,
        /// Rings in all.
        of: u32,
        /// Distance from the plate's own place \[m\].
        away_m: f64,
    },
    /// Planning the job with a plate at another place.
    #[error("another place for {}: the job with it at ({:.3}, {:.3}) m", plate_name(*.plate), .centre_m[0], .centre_m[1])]
    Trial {
        /// The plate.
        plate: usize,
        /// Its centre \[m\].
        centre_m: [f64; 2],
    },
}
