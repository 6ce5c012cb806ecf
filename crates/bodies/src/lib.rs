//! Bodies of a workcell at one moment: the distances between them, the sponge's contact with a plate, the share of a plate that is swept.
//!
//! Nothing here knows of time, but for bounds between two moments that are given.
//!
//! | concept | module |
//! | --- | --- |
//! | distances between bodies; pairs that need no check; hulls and parts of meshes | [`clearance`] |
//! | workcells with the pairs that need no check | [`assembly`] |
//! | jobs with their arm, whose bodies can be where they are | [`job`] |
//! | the pressure of a sponge on a plate | [`contact`] |
//! | the share of a plate that is swept | [`coverage`] |
//! | mass, centre and inertia of shapes; tools assembled from parts | [`uniform`]; [`tool_chain`] |
//!
//! The collision library (parry) is used by this crate alone, in [`clearance`].

pub mod assembly;
pub mod clearance;
pub mod contact;
pub mod coverage;
pub mod job;
pub mod tool_chain;
pub mod uniform;
