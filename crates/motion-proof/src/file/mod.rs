//! Trajectories in files.
//!
//! | concept | module |
//! | --- | --- |
//! | reading by a file's name | here |
//! | joints that do not move | `fixed_joints` |
//! | tables: times, positions, speeds and accelerations as CSV | `csv` |
//! | ROS messages as YAML and JSON: `JointTrajectory`; messages around one | `ros`; `wrapper` |

mod csv;
mod fixed_joints;
mod ros;
mod wrapper;

use crate::place::ReadError;
use crate::points::{Interpolation, JointPoints, PointMotion};
use platewash_kinematics::RobotModel;
use platewash_kinematics::urdf::FixedJoints;

/// Points of a file, with the line of each.
#[derive(Debug, Clone, PartialEq)]
pub struct TrajectoryFile {
    /// Name of the file.
    name: String,
    /// The points.
    pub points: JointPoints,
    /// Line of each point, from 1.
    pub lines: Vec<usize>,
}

impl TrajectoryFile {
    /// Reads the trajectory of an arm from a text, by the end of the file's name: `.csv`, or a ROS message as `.yaml`, `.yml` or `.json`.
    /// Joints are matched by name. A joint of the arm that the file leaves out, and one of the file that is none of the six axes, must be in
    /// `fixed`, or be fixed in the arm itself; where the file has it, its position there must be the same at every point.
    ///
    /// # Errors
    /// [`ReadError`] with the line, and for a file with several trajectories.
    pub fn read(name: &str, text: &str, arm: &RobotModel, fixed: &FixedJoints) -> Result<Self, ReadError> {
        let mut all = Self::read_all(name, text, arm, fixed)?;
        let count = all.len();
        match (all.pop(), count) {
            (Some(file), 1) => Ok(file),
            (last, _) => {
                let line = last.and_then(|file| file.lines.first().copied()).unwrap_or(1);
                let reason = format!("expected one trajectory; found {count}, the last of them here");
                Err(ReadError::at(name, line, reason))
            }
        }
    }

    /// Reads all trajectories of a text, as [`TrajectoryFile::read`]: a YAML text may have several documents, and a message several
    /// trajectories.
    ///
    /// # Errors
    /// [`ReadError`] with the line, and for a text without any.
    pub fn read_all(name: &str, text: &str, arm: &RobotModel, fixed: &FixedJoints) -> Result<Vec<Self>, ReadError> {
        let mut joints = arm.fixed_joints().clone();
        joints.extend(fixed.iter().map(|(name, at)| (name.clone(), *at)));
        let all = match name.to_ascii_lowercase().ends_with(".csv") {
            true => vec![csv::read(name, text, arm, &joints)?],
            false => ros::read_all(name, text, arm, &joints)?,
        };
        let with_name = |(mut points, lines): (JointPoints, Vec<usize>)| {
            points.fixed.clone_from(&joints);
            Self {
                name: name.to_owned(),
                points,
                lines,
            }
        };
        Ok(all.into_iter().map(with_name).collect())
    }

    /// Returns the motion through the points: see [`JointPoints::motion`].
    ///
    /// # Errors
    /// [`ReadError`] with the line.
    pub fn motion(&self, arm: &RobotModel, choice: Option<Interpolation>) -> Result<PointMotion, ReadError> {
        self.points.motion(arm, choice).map_err(|error| {
            let line = error
                .point()
                .and_then(|point| self.lines.get(point))
                .or(self.lines.first());
            ReadError::at(&self.name, line.copied().unwrap_or(1), error.to_string())
        })
    }
}
