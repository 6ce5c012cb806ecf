//! The page's bundle, `crates/viewer/dist`: made from `crates/viewer/page` with Node.

mod checks;
mod make;
mod node;
#[path = "../../../crates/viewer/stamp.rs"]
mod stamp;
mod workshop;

pub use checks::{again, tested};
pub use make::make;
pub use node::Node;
pub use workshop::{Packages, Workshop};
