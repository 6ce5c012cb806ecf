//! Checks of the plan's statements.
//!
//! | concept | module |
//! | --- | --- |
//! | arm, tool, plates and their order; plates apart from each other and from the base | `plates` |
//! | segments from home to home, at rest where a wash begins and ends | `schedule` |
//! | wash paths | `wash_paths` |
//! | a dry run | `dry_run` |

pub(crate) mod dry_run;
pub(crate) mod plates;
pub(crate) mod schedule;
pub(crate) mod wash_paths;
