//! The world in which plates are washed, and the words for it.
//!
//! Conventions (units, frames, order of twists) are those of [`platewash_kinematics`].

pub mod arc;
pub mod clearance;
pub mod coverage;
pub mod csv;
pub mod layout;
pub mod random;
pub mod segment;
pub mod stroke;
pub mod tool;
pub mod trajectory;
pub mod words;

pub(crate) use platewash_kinematics::trig;
