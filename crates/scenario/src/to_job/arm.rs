//! From the `[robot]` section to an arm.

use crate::sections::robot::{BuiltInArm, RobotSection};
use crate::to_job::solids::Solids;
use platewash_kinematics::irb120::EmbeddedModelError;
use platewash_kinematics::urdf::{Files, FixedJoints, MAX_BYTES, MeshSource};
use platewash_kinematics::{DisabledPairs, RobotModel, SrdfError, UrdfError};
use std::path::Path;
use std::sync::Arc;

/// Reason that the arm of a scenario could not be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ArmError {
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
        /// Error in the description.
        error: UrdfError,
    },
    /// The SRDF was refused.
    #[error("{file}: {error}")]
    Srdf {
        /// The file.
        file: String,
        /// Error in the description.
        error: SrdfError,
    },
}

/// The arm of the section, from files on disk or from files read before.
///
/// # Errors
/// [`ArmError`] with the file and its error.
pub fn load_arm(section: &RobotSection, files: &Files) -> Result<RobotModel, ArmError> {
    load_arm_with_fixed(section, files, &FixedJoints::new())
}

/// The arm of the section as [`load_arm`] makes it, with joints of its description held still: see
/// [`RobotModel::from_urdf_with_fixed`].
///
/// # Errors
/// [`ArmError`] with the file and its error.
pub fn load_arm_with_fixed(section: &RobotSection, files: &Files, fixed: &FixedJoints) -> Result<RobotModel, ArmError> {
    load(section, files, fixed, &Solids::default())
}

/// The arm of the section as [`load_arm_with_fixed`] makes it, its meshes cut once for all that share the cache.
pub(crate) fn load(
    section: &RobotSection,
    files: &Files,
    fixed: &FixedJoints,
    solids: &Solids,
) -> Result<RobotModel, ArmError> {
    match (&section.urdf, section.model) {
        (Some(urdf), _) => load_description(urdf, section, files, (fixed, solids)),
        (None, BuiltInArm::Irb120) => {
            let robot = RobotModel::irb120()?;
            let file = "the built-in arm".to_owned();
            let held = robot.check_held(&section.fixed);
            held.map_err(|error| ArmError::Urdf { file, error }).map(|()| robot)
        }
    }
}

/// The arm of a URDF file, with the pairs that an SRDF file disables where one is given; `package://` names of meshes are looked up
/// in `package_path`, the others in the folder of the URDF.
///
/// # Errors
/// [`ArmError`] with the file and its error.
fn load_description(
    urdf: &Path,
    section: &RobotSection,
    files: &Files,
    (fixed, solids): (&FixedJoints, &Solids),
) -> Result<RobotModel, ArmError> {
    let file = urdf.display().to_string();
    let meshes = MeshSource::new(&section.package_path, urdf.parent())
        .reading(files)
        .with_visual_shapes(section.visual_shapes)
        .with_split_links(&section.split_links, Arc::new(solids.clone()));
    let held: FixedJoints = fixed
        .iter()
        .chain(&section.fixed)
        .map(|(joint, at)| (joint.clone(), *at))
        .collect();
    let robot = RobotModel::from_urdf_with_fixed(&read(urdf, files)?, &meshes, &held);
    let checked = robot.and_then(|robot| robot.check_held(&section.fixed).map(|()| robot));
    let robot = checked.map_err(|error| ArmError::Urdf { file, error })?;
    let Some(path) = &section.srdf else {
        return Ok(robot);
    };
    let srdf = |error| ArmError::Srdf {
        file: path.display().to_string(),
        error,
    };
    robot
        .with_disabled_pairs(DisabledPairs::parse(&read(path, files)?).map_err(srdf)?)
        .map_err(srdf)
}

fn read(path: &Path, files: &Files) -> Result<String, ArmError> {
    files
        .read_text(path, MAX_BYTES as u64)
        .map_err(|e| ArmError::Unreadable {
            file: path.display().to_string(),
            detail: e.to_string(),
        })
}
