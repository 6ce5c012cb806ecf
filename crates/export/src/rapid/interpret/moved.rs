//! What was moved so far.

use crate::reading::{ReadPoint, ReadTool};

/// What was moved so far.
#[derive(Debug, Default)]
pub struct Motion {
    /// Points in the order in which they are reached.
    pub points: Vec<ReadPoint>,
    /// The tool of all motions.
    pub tool: Option<ReadTool>,
    /// The share of the speed that the program states, as it was at the first motion.
    pub share: Option<f32>,
    /// Whether the program has ended.
    pub is_over: bool,
}

impl Motion {
    /// Whether the arm has moved.
    #[must_use]
    pub fn has_begun(&self) -> bool {
        !self.points.is_empty()
    }
}
