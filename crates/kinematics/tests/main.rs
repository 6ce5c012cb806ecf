//! The arm as its users meet it: descriptions, inverse kinematics, batches, and other implementations beside it.

// Tests compare with tolerances: the last bit of the C library's functions is of no matter.
#![allow(clippy::disallowed_methods)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod against_pinocchio;
mod batch;
mod controller_base;
mod fingerprint;
mod ik_analytic;
mod ik_answers;
mod ik_generalized;
mod ik_path;
mod ik_spread;
mod inertia;
mod limits;
mod obj_files;
mod reach;
mod rotation;
mod shapes;
mod srdf;
mod stl_files;
mod trig;
mod trig_accuracy;
mod urdf_collada;
mod urdf_files;
mod urdf_fixed;
mod urdf_followers;
mod urdf_gaps;
mod urdf_loads;
mod urdf_meshes;
mod urdf_refused;
mod urdf_statements;
mod urdf_visuals;
mod words;

#[path = "../../../tests/support/urdf.rs"]
mod urdf;
#[path = "../../../tests/support/wide.rs"]
mod wide;
