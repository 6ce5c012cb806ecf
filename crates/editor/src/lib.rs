//! The live cell: a scenario that somebody changes on a page, planned and proved at once.
//!
//! The page holds the scenario, as the text of its file; an [`Editor`] answers its questions, each of which carries all that its answer
//! needs. An answer is lines of JSON that are told as they are known: what the scenario says, what there is, a guess, the plan, its proof.
//! `crates/viewer/page/src/edit/protocol.ts` states the same words for the page.
//!
//! | concept | file |
//! | --- | --- |
//! | who answers; what the page is given to begin with; its server | `editor.rs` |
//! | questions and lines as JSON | `protocol.rs` |
//! | a new question ends those before it | `sessions.rs` |
//! | what is edited: the scenario, changed; its arm and its job; how much work that may be | `subject.rs` |
//! | from the scenario to the proof, or why there is none; where plates could lie | `cell.rs` |
//! | what hands may move | `moves.rs` |
//! | why a scenario is refused | `refusal.rs` |
//! | lines on their way to the page, how long they took, why an answer ends | `told.rs` |
//! | the file on disk | `keep.rs` |

mod cell;
mod editor;
mod keep;
mod moves;
pub mod protocol;
mod refusal;
mod sessions;
mod subject;
mod told;

pub use editor::{Editor, EditorError, site};
pub use keep::{Keeper, NotWritten, Save, Written};
pub use subject::{Latest, MOST_CONTACT_POINTS, MOST_QUESTION_BYTES};
