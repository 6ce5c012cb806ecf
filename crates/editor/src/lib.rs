//! The live cell: a scenario that somebody changes on a page, planned and proved at once.
//!
//! The page holds the scenario, as the text of its file; an [`Editor`] answers its questions, each of which carries all that its answer
//! needs. An answer is lines of JSON that are told as they are known: what the scenario says, what there is, a guess, the plan, its proof.
//! `crates/viewer/page/src/edit/protocol.ts` states the same words for the page.
//!
//! | concept | file |
//! | --- | --- |
//! | what is edited; who answers | `subject.rs`, `editor.rs` |
//! | questions and lines as JSON | `protocol/`: `question.rs`, `line.rs` |
//! | what the page is given to begin with | `document.rs` |
//! | a new question ends those before it | `sessions.rs` |
//! | how much work a question may be, how long it may take | `bounds.rs` |
//! | the scenario, changed; its job | `draft.rs`, `placed.rs` |
//! | why it is refused; why an answer ends | `refusal.rs`, `end.rs` |
//! | arms that were loaded before | `arms.rs` |
//! | from the scenario to the proof | `cell.rs` |
//! | why there is no plan, and where plates could lie | `unplanned.rs`, `map.rs` |
//! | the file on disk | `keep.rs` |
//! | lines on their way to the page | `told.rs` |
//! | how long steps took | `stopwatch.rs` |
//! | an editor behind the page's server | `service.rs` |

mod arms;
mod bounds;
mod cell;
mod document;
mod draft;
mod editor;
mod end;
mod error;
mod keep;
mod map;
mod moves;
mod placed;
pub mod protocol;
mod refusal;
mod service;
mod sessions;
mod stopwatch;
mod subject;
mod told;
mod unplanned;

pub use bounds::{MOST_CONTACT_POINTS, MOST_QUESTION_BYTES};
pub use editor::Editor;
pub use error::EditorError;
pub use keep::{Keeper, NotWritten, Save, Written};
pub use service::site;
pub use subject::Latest;
