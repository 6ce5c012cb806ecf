//! Why an obstacle could not be made.

use platewash_kinematics::urdf::MeshError;
use platewash_workcell::clearance::SolidError;
use platewash_workcell::words::printable;

/// Why an obstacle could not be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ObstacleError {
    /// Its mesh cannot be read.
    #[error("obstacle[{index}].mesh: obstacle '{}': {}", printable(.name), printable(&.why.to_string()))]
    Mesh {
        /// Which section, from 0.
        index: usize,
        /// Its name.
        name: String,
        /// Why, with the file.
        why: MeshError,
    },
    /// Its mesh is no body.
    #[error("obstacle[{index}].mesh: obstacle '{}': {}: {why}", printable(.name), printable(.file))]
    Solid {
        /// Which section, from 0.
        index: usize,
        /// Its name.
        name: String,
        /// The file.
        file: String,
        /// Why.
        why: SolidError,
    },
    /// Another body has its name.
    #[error("obstacle[{index}].name: '{}' is the name of {of}; give the obstacle another one", printable(.name))]
    NameTaken {
        /// Which section, from 0.
        index: usize,
        /// The name.
        name: String,
        /// Who has it.
        of: &'static str,
    },
}
