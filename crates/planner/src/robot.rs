//! From the `[robot]` section to an arm.

use crate::scenario::{BuiltInArm, RobotSection};
use platewash_kinematics::model::EmbeddedModelError;
use platewash_kinematics::urdf::{MAX_BYTES, MeshSource, file};
use platewash_kinematics::{DisabledPairs, LimitViolation, RobotModel, SrdfError, UrdfError};
use std::path::Path;

/// Why the arm of a scenario could not be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RobotError {
    /// The built-in description is broken.
    #[error(transparent)]
    BuiltIn(#[from] EmbeddedModelError),
    /// A file cannot be read.
    #[error("{file}: cannot be read: {detail}")]
    Unreadable {
        /// The file.
        file: String,
        /// The system's words.
        detail: String,
    },
    /// The URDF was refused.
    #[error("{file}: {error}")]
    Urdf {
        /// The file.
        file: String,
        /// Why.
        error: UrdfError,
    },
    /// The SRDF was refused.
    #[error("{file}: {error}")]
    Srdf {
        /// The file.
        file: String,
        /// Why.
        error: SrdfError,
    },
    /// The start configuration lies outside the joint limits.
    #[error("robot.start_deg: {0}")]
    Start(LimitViolation),
}

/// The arm that the section asks for.
///
/// # Errors
/// [`RobotError`] with the file and what is wrong in it.
pub fn load(section: &RobotSection) -> Result<RobotModel, RobotError> {
    let Some(path) = &section.urdf else {
        return match section.model {
            BuiltInArm::Irb120 => Ok(RobotModel::irb120()?),
        };
    };
    let file = path.display().to_string();
    let meshes = MeshSource::new(&section.package_path, path.parent());
    let robot = RobotModel::from_urdf(&read(path)?, &meshes).map_err(|error| RobotError::Urdf { file, error })?;
    let Some(path) = &section.srdf else {
        return Ok(robot);
    };
    let srdf = |error| RobotError::Srdf {
        file: path.display().to_string(),
        error,
    };
    robot
        .with_disabled_pairs(DisabledPairs::parse(&read(path)?).map_err(srdf)?)
        .map_err(srdf)
}

fn read(path: &Path) -> Result<String, RobotError> {
    file::read_text(path, MAX_BYTES as u64).map_err(|e| RobotError::Unreadable {
        file: path.display().to_string(),
        detail: e.to_string(),
    })
}
