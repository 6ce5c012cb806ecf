//! Robot programs: a proved plan in the words of a controller, read back and judged again before it is handed over.
//!
//! ```text
//! Certified<Plan> ─ points ─ Program ─ Dialect::write ─ text ─ Dialect::read ─ Reading ─ motions ─ judged ─┬─ files
//!                                                                                                          └─ Refusal
//! ```
//!
//! The text is never trusted: it is interpreted as the controller is assumed to move, and the resulting motion is judged against
//! the plan and its job (`platewash_certificate::prove_program`). A plan that is not certified cannot get here.
//!
//! | concept | module |
//! | --- | --- |
//! | a language of programs; the largest distance from the start at which a program moves | `dialect` |
//! | the list of all dialects | `dialects` |
//! | a program in no language, its files and places in them; a file made of bytes | `program`, `decode` |
//! | a program read back; words, numbers and signs of a text | `reading` |
//! | RAPID, of ABB: written and read | `rapid` |
//! | URScript, of Universal Robots: written and read | `urscript` |
//! | a table of positions and speeds, for any other use | `csv` |
//! | a tool as a controller has it, beside the plan's | `tool_frame` |
//! | settings of a controller that change the motion, as a program states them; those that were changed | `controller_settings`, `changed_settings` |
//! | settings, and as lines of a program | `settings` |
//! | the count of axis 3 by a controller, and the arms of which it is known | `joint_3`, `maker_joints` |
//! | the choice of points of a plan that a program names | `points` |
//! | the assumed motion of an arm along a program, and the proof of that motion | `judgement` |
//! | the head of a program, as comments | `header`, `comment` |
//! | all of it, one after the other; the reasons that a plan is not handed over | `export`, `refusal` |
//! | a program that may have been changed since: its changes, and its share of the plan's speed | `compare`, `changes`, `step`, `speed_share` |
//! | ROS 2 | `ros2` |

mod changed_settings;
mod changes;
mod comment;
pub mod compare;
pub mod controller_settings;
pub mod csv;
mod decode;
pub mod dialect;
pub mod dialects;
mod export;
mod header;
mod joint_3;
pub mod judgement;
mod maker_joints;
mod points;
pub mod program;
pub mod rapid;
pub mod reading;
mod refusal;
pub mod ros2;
mod settings;
mod speed_share;
mod step;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
mod tool_frame;
pub mod urscript;

pub use crate::changes::Change;
pub use crate::compare::{CompareError, ProgramComparison, compare};
pub use crate::export::{ExportError, ExportedProgram, export};
pub use crate::header::contact_not_judged;
pub use crate::joint_3::Joint3;
pub use crate::refusal::Refusal;
pub use crate::settings::ExportSettings;
