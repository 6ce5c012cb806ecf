//! Makes the bundle of the page, `crates/viewer/dist`, from `crates/viewer/page` with Node.
//!
//! The build script of `platewash-viewer` calls it, so that every build has the page in it. `xtask` calls it to check the page.

mod make;
mod node;
mod place;
mod python;
mod run;
pub mod stamp;
mod workshop;

pub use make::{Outcome, alone, bundle, make, sources, workshop};
pub use node::{Node, Packages};
pub use place::{root, target};
pub use python::{interpreter, program as python_program};
pub use workshop::{Workshop, copied, removed};
