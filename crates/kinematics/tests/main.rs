//! The arm as its users meet it: descriptions, inverse kinematics, batches, and other implementations beside it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod against_pinocchio;
mod batch;
mod ik_analytic;
mod ik_answers;
mod ik_generalized;
mod ik_path;
mod ik_spread;
mod trig_accuracy;
mod urdf_collada;
mod urdf_loads;
mod urdf_meshes;
mod urdf_refused;
mod urdf_visuals;

#[path = "../../../tests/support/urdf.rs"]
mod urdf;
