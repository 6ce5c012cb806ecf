//! URDF text becomes a [`RobotModel`](crate::RobotModel): everything a lenient parser lets through is caught here, by name.
//!
//! The stages, which `load` goes through: `scan` bounds size and depth and finds cut files before any recursive parser sees them;
//! `statements` goes through all elements, names those that are not used, and leaves them out of the text (`edits`), as it does with those
//! that are not complete (`gaps`); `urdf-rs` reads the others (where it refuses one, `error` finds which); `fixed` holds joints still that
//! are not of the arm; `followers` takes out what follows an axis; `tree` checks the structure, orders the six joints and checks their limits;
//! `shapes` converts collision geometry (recognising capsules, finding meshes through `mesh` and reading
//! their vertices) and visual geometry (reading the triangles of meshes: `stl`, `obj`, `collada`), which is left out by name where it cannot be read. Every file is read through `file`.
//!
//! xacro is not expanded: run `xacro FILE.xacro > FILE.urdf` first.

mod collada;
mod edits;
mod error;
pub mod file;
mod files;
pub(crate) mod fixed;
pub(crate) mod followers;
mod gaps;
mod line;
mod load;
mod mesh;
mod mesh_text;
mod obj;
mod scan;
pub(crate) mod shapes;
mod stl;
mod tree;
pub(crate) mod unused_statements;

pub use crate::urdf::error::UrdfError;
pub use crate::urdf::files::{Files, HeldFiles};
pub use crate::urdf::fixed::FixedJoints;
pub use crate::urdf::followers::FollowerLink;
pub use crate::urdf::mesh::{MeshError, MeshSource, MeshSplitter, Scan};
pub use crate::urdf::scan::MAX_BYTES;
pub use crate::urdf::shapes::{MAX_TRIANGLES, MAX_VISUALS};
pub use crate::urdf::unused_statements::UnusedStatement;
