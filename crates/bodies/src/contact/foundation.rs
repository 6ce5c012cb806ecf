//! Sponge as an elastic foundation.
//!
//! Formula (27.1) in `docs/contact.md`.

use crate::contact::sponge_pose::SpongePose;
use nalgebra::Vector3;
use platewash_workcell::tool::{Sponge, Tool};

/// Sponge as an elastic foundation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Foundation {
    /// Radius s \[m\].
    pub radius_m: f64,
    /// Height without load, H \[m\].
    pub free_height_m: f64,
    /// Distance of the free face beyond the tip, c \[m\].
    pub compression_m: f64,
    /// Least and greatest stiffness E \[Pa\].
    pub stiffness_pa: [f64; 2],
}

impl Foundation {
    /// Returns the foundation of a sponge with a stated stiffness; `None` without one.
    #[must_use]
    pub fn from_sponge(sponge: &Sponge) -> Option<Self> {
        sponge
            .stiffness_pa
            .map(|stiffness_pa| Self::stiff(sponge, stiffness_pa))
    }

    /// Returns the foundation of a sponge with another stiffness than stated \[Pa\].
    #[must_use]
    pub fn stiff(sponge: &Sponge, stiffness_pa: [f64; 2]) -> Self {
        Self {
            radius_m: sponge.radius_m,
            free_height_m: sponge.free_height_m(),
            compression_m: sponge.compression_m,
            stiffness_pa,
        }
    }

    /// Returns the foundation of a tool's sponge; `None` without a tool or a stated stiffness.
    #[must_use]
    pub fn of_tool(tool: &Tool) -> Option<Self> {
        Self::from_sponge(&tool.sponge).filter(|_| tool.is_present())
    }

    /// Compression w at a point of a face \[m\], formula (27.1). `pose` has p and a, `point` is x. The compression is below 0 where the
    /// free face does not reach it.
    #[must_use]
    pub fn compression(&self, pose: &SpongePose, point: &Vector3<f64>) -> f64 {
        self.compression_m + (pose.tip - point).dot(&pose.axis)
    }

    /// Pressures over compressions, E/H, for the least and the greatest stiffness E \[Pa/m\], formula (27.1).
    #[must_use]
    #[inline]
    pub fn pressure_pa_m(&self) -> [f64; 2] {
        self.stiffness_pa.map(|pa| pa / self.free_height_m)
    }

    /// Forces F = E V/H of a volume of compressed foam, for the least and the greatest stiffness E \[N\], formula (31.1). `volume_m3` is V.
    #[must_use]
    pub fn forces_n(&self, volume_m3: f64) -> [f64; 2] {
        self.stiffness_pa.map(|pa| pa * volume_m3 / self.free_height_m)
    }
}
