//! The description of the ABB IRB 120 as texts: geometry, limits, inertias and shapes in one URDF without meshes, and an SRDF with the
//! pairs of links that need no collision check. `docs/urdf.md` says where each number comes from.

/// Text of the description of the ABB IRB 120.
pub const IRB120_URDF: &str = include_str!("irb120.urdf");
/// Text of the list of its link pairs that need no collision check.
pub const IRB120_SRDF: &str = include_str!("irb120.srdf");
