//! From the `[robot]` and `[tool]` sections to an arm with a tip.

use crate::layout::BaseFootprint;
use crate::scenario::{BuiltInArm, RobotSection, ToolSection};
use nalgebra::Vector3;
use platewash_kinematics::model::EmbeddedModelError;
use platewash_kinematics::rotation::Rigid;
use platewash_kinematics::urdf::{MAX_BYTES, MeshSource, file};
use platewash_kinematics::{DisabledPairs, Frame, LimitViolation, RobotModel, SrdfError, UrdfError};
use std::path::Path;

/// Half the side of the footprint assumed for an arm whose base has no collision geometry \[m\].
const DEFAULT_HALF_SIDE_M: f64 = 0.09;

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

/// The frame at the centre of the sponge's far face, z leaving the tool; the mounting frame without a tool body.
#[must_use]
pub fn tip_frame(robot: &RobotModel, tool: &ToolSection) -> Frame {
    robot.mounting_frame().offset(&Rigid {
        translation: Vector3::new(0.0, 0.0, tool.length_m),
        ..Rigid::identity()
    })
}

/// The rectangle around what stands on the floor and never moves: the bounds of the base's collision shapes, or
/// ± 90 mm where there are none.
#[must_use]
pub fn base_footprint(robot: &RobotModel) -> BaseFootprint {
    let mut bounds = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    let base = robot.fk(&nalgebra::Vector6::zeros());
    for link in robot.links().iter().filter(|link| link.frame.body() == 0) {
        let placed = base.rigid(&link.frame);
        for primitive in &link.collision {
            let shape = placed.then(&Rigid::from(&primitive.pose));
            for (axis, [least, most]) in bounds.iter_mut().enumerate() {
                let along = shape.rotation.row(axis).transpose();
                let centre = shape.translation[axis];
                *least = least.min(centre - primitive.shape.support(&-along));
                *most = most.max(centre + primitive.shape.support(&along));
            }
        }
    }
    let [x_m, y_m] = bounds.map(|[least, most]| {
        if least < most {
            [least, most]
        } else {
            [-DEFAULT_HALF_SIDE_M, DEFAULT_HALF_SIDE_M]
        }
    });
    BaseFootprint { x_m, y_m }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_irb_120_stands_on_its_bounds() {
        let foot = base_footprint(&RobotModel::irb120().unwrap());
        let close = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9;
        assert!(close(foot.x_m, [-0.2115, 0.0905]), "{foot:?}");
        assert!(close(foot.y_m, [-0.0905, 0.0905]), "{foot:?}");
    }
}
