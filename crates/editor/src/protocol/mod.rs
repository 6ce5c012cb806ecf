//! Questions of the page and lines of answers, as JSON: `platewash-edit/1`.

mod line;
mod question;

pub use line::{
    ArmLine, BodyMove, CellLine, CellParts, DiskLine, FindingLine, HelloLine, MapLine, Moves, PlanParts, PlateChance,
    PlateMoves, PlateProof, Refusal, SaveLine, Unwashable,
};
pub use question::{CellQuestion, DiskQuestion, Edit, MapQuestion, SaveQuestion, Want};

/// The format of the words.
pub const FORMAT: &str = "platewash-edit/1";
