//! Modules that import each other in a ring.
//!
//! At each level of a crate's tree of modules, a module counts with everything inside it, and the parent's own file is a member
//! of the level, too. A member uses another one where a path in it, followed through imports, re-exports and globs, ends at an item
//! that is defined in the other one. Items that a parent only re-exports are no use of its children.
//!
//! Where no level has a ring, no two files of the crate need each other.
//!
//! Calls of methods, names inside format strings and code for tests alone are not seen.

mod cfg;
mod levels;
mod module;
mod paths;
mod read;
mod resolve;
#[cfg(test)]
mod tests;

pub use levels::{lost, rings};
pub use read::read;
