//! The live cell: a scenario that a user changes on a page, planned and proved at once.
//!
//! The page holds the scenario, as the text of its file; an [`Editor`] answers its questions, each of which carries all that its
//! answer needs. An answer is lines of JSON that are sent as they are known: the scenario, the parts of the cell, an outlook, the
//! plan, its proof. The page's TypeScript types are made from `protocol.rs`.
//!
//! | concept | file |
//! | --- | --- |
//! | the editor: answers, first contents of the page | `editor.rs` |
//! | clock and files of the machine that it runs on | `host.rs` |
//! | questions and lines as JSON | `protocol.rs` |
//! | a new question ends those before it | `sessions.rs` |
//! | the edited scenario: its changes; its arm and its job; the limit on work | `edited_scenario.rs` |
//! | from the scenario to the proof, or the reason that there is none; places at which plates could lie | `cell_answer.rs` |
//! | the paper's program on the plates of a plan | `beside.rs` |
//! | the way on after a stop | `recovery_answer.rs` |
//! | the things that a user can move | `moves.rs` |
//! | the reasons that a scenario is refused | `refusal.rs` |
//! | lines on their way to the page, their time, the reasons that an answer ends | `answer_writer.rs` |
//! | the file on disk | `keep.rs` |

mod answer_writer;
mod beside;
mod cell_answer;
mod edited_scenario;
mod editor;
mod host;
mod keep;
mod moves;
pub mod protocol;
mod recovery_answer;
mod refusal;
mod sessions;

pub use beside::paper_beside;
pub use edited_scenario::{LastResult, MOST_CONTACT_POINTS, MOST_QUESTION_BYTES};
pub use editor::{Editor, EditorError, FirstContents};
pub use host::Host;
pub use keep::{Keeper, Save, SaveError, SaveReport};
