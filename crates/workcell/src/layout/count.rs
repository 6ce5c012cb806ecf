//! Number of plates of a layout.

use crate::layout::error::{InputProblem, LayoutError};

/// Greatest number of plates of a layout.
pub const MAX_PLATES: usize = 1000;

pub(crate) fn check_count(count: usize) -> Result<(), LayoutError> {
    match count {
        0 => Err(LayoutError::invalid("count", InputProblem::NotPositive)),
        1..=MAX_PLATES => Ok(()),
        _ => Err(LayoutError::invalid(
            "count",
            InputProblem::TooLarge { max: MAX_PLATES },
        )),
    }
}
