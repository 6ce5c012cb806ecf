//! The built-in arm: the ABB IRB 120.

use crate::model::RobotModel;
use crate::srdf::{DisabledPairs, SrdfError};
use crate::urdf::{MeshSource, UrdfError};

/// Error of reading the embedded IRB 120. It only occurs if the embedded sources were edited.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EmbeddedModelError {
    /// The URDF does not load.
    #[error(transparent)]
    Urdf(#[from] UrdfError),
    /// The SRDF does not load.
    #[error(transparent)]
    Srdf(#[from] SrdfError),
}

pub use platewash_urdf::{IRB120_SRDF, IRB120_URDF};

impl RobotModel {
    /// The embedded ABB IRB 120, with its list of link pairs that may be ignored.
    ///
    /// # Errors
    /// None in a released build: the embedded text is tested.
    pub fn irb120() -> Result<Self, EmbeddedModelError> {
        let model = Self::from_urdf(IRB120_URDF, &MeshSource::none())?;
        let disabled = DisabledPairs::parse(IRB120_SRDF)?;
        Ok(model.with_disabled_pairs(disabled)?)
    }
}
