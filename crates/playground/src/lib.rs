//! The live cell in a browser: the engine as a WebAssembly module, without a server.
//!
//! The module has no files and no threads. Its host, a worker of the browser, asks the questions of the live cell, and some more:
//!
//! | question | answer |
//! | --- | --- |
//! | `/cell`, `/map`, `/recover` | those of [`platewash_editor::protocol`] |
//! | `/open` | the first contents of the page of a scenario |
//! | `/shipped` | the scenarios that come with the program |
//! | `/file` | a file, byte for byte as the command writes it of the same scenario |
//!
//! | concept | file |
//! | --- | --- |
//! | questions and answers | `playground.rs` |
//! | plan, proof, page and robot program as files | `files.rs` |
//! | memory and functions that the module shares with its host | `module.rs` |

mod files;
#[cfg(target_family = "wasm")]
mod module;
mod playground;

pub use playground::Playground;
