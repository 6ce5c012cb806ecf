//! Colours, told apart by those who do not see all of them, too (after Okabe and Ito), on white.

use super::style::Colour;

/// Text and frames of importance.
pub const INK: Colour = "#1b1f24";
/// Text beside.
pub const GREY: Colour = "#57606a";
/// Outlines and frames.
pub const LINE: Colour = "#8c959f";
/// Grids.
pub const GRID: Colour = "#e4e8ec";
/// Grounds of boxes.
pub const GROUND: Colour = "#f6f8fa";
/// White.
pub const PAPER: Colour = "#ffffff";

/// The path on a plate, magenta as in the paper.
pub const WASH: Colour = "#c2187f";
/// The way between plates.
pub const TRANSIT: Colour = "#0072b2";
/// Down to a plate and up from it.
pub const LIFT: Colour = "#56b4e9";
/// What an arm made of it.
pub const EXECUTED: Colour = "#d55e00";
/// What is kept.
pub const GOOD: Colour = "#00795a";
/// What is not kept.
pub const BAD: Colour = "#c0392b";
/// What could not be judged, or is waived.
pub const OPEN: Colour = "#b26a00";

/// Six lines in one diagram.
pub const SIX: [Colour; 6] = ["#1b1f24", "#e69f00", "#56b4e9", "#009e73", "#d55e00", "#9b4f96"];

/// What was not reached.
pub const MISSED: Colour = "#d55e00";

/// Steps from little to much, light to dark.
pub const STEPS: [Colour; 8] = [
    "#e5f5f9", "#cdeae6", "#a3d9cf", "#74c2b4", "#48a999", "#278a80", "#0f6b66", "#014d4d",
];
