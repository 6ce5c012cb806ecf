//! Joints of an arm: their number, and one value for each.

/// Number of joints of every arm that this project handles.
pub const AXES: usize = 6;

/// One value per joint, from the base to the tip: \[rad\] for positions, \[rad/s\] for speeds.
pub type JointVector = nalgebra::Vector6<f64>;
