//! Kinematics of six-axis serial arms: URDF in, poses, Jacobians and inverse kinematics out.
//!
//! # Conventions (for the whole project)
//!
//! - SI units and radians everywhere; a name carries its unit where it is not obvious (`length_m`,
//!   `start_deg` in files).
//! - `T_a_b` maps coordinates in frame `b` to frame `a`: `p_a = T_a_b p_b`. A *pose* of frame `b` is
//!   `T_base_b`, with `base` the root link of the URDF, unless another frame is named.
//! - A rotation vector is axis × angle, angle in [0, π]. Roll–pitch–yaw is URDF's: fixed axes x, y, z,
//!   `R = Rz(yaw) Ry(pitch) Rx(roll)`. A quaternion is written (w, x, y, z).
//! - A twist and every six-row matrix is (linear, angular): rows 0–2 m or m/s, rows 3–5 rad or rad/s.
//! - Joint vectors are ordered from the base to the tip: index 0 is joint 1.
//!
//! # Where things are
//!
//! | concept | module |
//! | --- | --- |
//! | URDF text → [`RobotModel`], every malformation named | [`urdf`] |
//! | collision pairs that may be ignored (SRDF) | [`srdf`] |
//! | the immutable arm: joints, links and frames; forward kinematics, Jacobian, manipulability | [`model`] |
//! | the built-in arm | [`irb120`] |
//! | joint limits and margins | [`limits`] |
//! | shapes: collision and looks | [`geometry`] |
//! | inertias that no body has | [`inertia`] |
//! | tool frames by name | [`tool_frame`] |
//! | the link and axis that carry a tool, stated or found | [`tool_mount`] |
//! | the frame from which the controller counts | [`controller_base`] |
//! | inverse kinematics | [`ik`] |
//! | many configurations at once | [`batch`] |
//! | points spread evenly | [`halton`] |
//! | the number of joints, one value for each; poses, rotations, folded transforms | `joints`; [`rotation`] |
//! | trigonometry, the same on every machine | [`trig`] |
//! | vectors of four numbers, with the instructions that the processor has | `lanes.rs` |
//! | SHA-256 of descriptions | [`fingerprint`] |
//! | numbers in sentences | [`words`] |
//!
//! # Example
//!
//! ```
//! use platewash_kinematics::{ik::{IkSettings, IkSolver}, JointVector, RobotModel, ToolFrame};
//!
//! let robot = RobotModel::irb120()?;
//! let tool0 = robot.tool_frame(ToolFrame::Tool0)?;
//! let q = JointVector::new(0.1, 0.2, -0.1, 0.3, 0.8, 0.0);
//! let target = robot.pose(&q, &tool0);
//! let solver = IkSolver::new(&robot, tool0, IkSettings::default())?;
//! let answer = solver.solve(&target, &JointVector::zeros())?;
//! assert!(answer.position_error_m <= 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod batch;
pub mod controller_base;
pub mod fingerprint;
pub mod geometry;
pub mod halton;
pub mod ik;
pub mod inertia;
pub mod irb120;
mod joints;
mod lanes;
pub mod limits;
pub mod model;
pub mod rotation;
pub mod srdf;
pub mod tool_frame;
pub mod tool_mount;
pub mod trig;
pub mod urdf;
pub mod words;

pub use crate::fingerprint::sha256_hex;
pub use crate::joints::{AXES, JointVector};
pub use crate::limits::{JointFriction, JointLimits, LimitViolation};
pub use crate::model::{Axes, BodyPoses, Frame, Jacobian, Joint, Link, RobotModel};
pub use crate::rotation::Pose;
pub use crate::srdf::{DisabledPairs, SrdfError};
pub use crate::tool_frame::{ToolFrame, ToolFrameError};
pub use crate::urdf::UrdfError;

/// The example in the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct ReadmeExample;
