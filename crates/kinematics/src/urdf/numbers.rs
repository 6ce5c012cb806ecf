//! Numbers of a description: finite, and no longer than an arm can be.

use super::error::UrdfError;
use crate::Pose;
use crate::rotation::{Rigid, from_rpy};

/// Largest length that is believed \[m\]; beyond it the file is probably in millimetres.
pub(super) const LARGEST_LENGTH_M: f64 = 100.0;

pub(super) fn rigid(origin: &urdf_rs::Pose, at: &str) -> Result<Rigid, UrdfError> {
    length(at, "origin xyz", &origin.xyz.0)?;
    finite(at, "origin rpy", &origin.rpy.0)?;
    Ok(Rigid {
        rotation: from_rpy(origin.rpy.0),
        translation: origin.xyz.0.into(),
    })
}

pub(super) fn pose(origin: &urdf_rs::Pose, at: &str) -> Result<Pose, UrdfError> {
    rigid(origin, at).map(|r| Pose::from(&r))
}

pub(super) fn finite(at: &str, what: &str, values: &[f64]) -> Result<(), UrdfError> {
    if values.iter().all(|v| v.is_finite()) {
        return Ok(());
    }
    Err(UrdfError::NotFinite {
        at: at.to_owned(),
        what: what.to_owned(),
        found: format!("{values:?}"),
    })
}

pub(super) fn length(at: &str, what: &str, values: &[f64]) -> Result<(), UrdfError> {
    finite(at, what, values)?;
    if values.iter().all(|v| v.abs() <= LARGEST_LENGTH_M) {
        return Ok(());
    }
    Err(UrdfError::TooLong {
        at: at.to_owned(),
        what: what.to_owned(),
        found: format!("{values:?}"),
        limit_m: LARGEST_LENGTH_M,
    })
}
