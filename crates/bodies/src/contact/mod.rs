//! Contact model: the pressure of a sponge on a plate as an elastic foundation.
//!
//! The sponge is a cylinder of radius s whose free face lies c beyond the tip, across the tool's axis a (a unit vector out of the tool).
//! Columns of foam along the axis give way independently of each other: where a point x of the face of a plate lies within the cylinder,
//! the column over it is compressed by
//!
//! w(x) = c + (tip − x)·a,
//!
//! and presses with p = E w / H, H the free height, in the direction of its compression (Elandt et al. 2019 call it a pressure field;
//! Winkler 1867). Without friction the plate pushes back along its normal n: of a column of the cross-section dA, p n / (−a·n) dA.
//!
//! A plate that lies higher by e along its axis ẑ compresses each column by −e ẑ·a more, and lies −e (ẑ − a (ẑ·a)) to the side.
//!
//! All quantities are in the frame of the plate, lengths in metres. `columns.rs` has the sponge's face in columns: forces, and the greatest
//! compression; `plate_load.rs` the same over a stretch of time, `level.rs` on a flat face; `moment.rs` the contact time and dose of single
//! points of the plate's face; `bundles.rs` passes over moments far from a point.

mod bundles;
mod columns;
mod level;
mod moment;
mod parts;
mod plate_load;

pub use crate::contact::bundles::Bundles;
pub use crate::contact::columns::{Column, Columns, Load};
pub use crate::contact::level::{Level, LevelPress};
pub use crate::contact::moment::{ContactSampler, Drift, Dwell, Moment, at_least_0, both};
pub use crate::contact::parts::Bends;
pub use crate::contact::plate_load::{HolderVolumes, PlateLoad, Press, SpongeState, TouchRegion};

use nalgebra::Vector3;
use platewash_kinematics::rotation::RigidTransform;
use platewash_workcell::plate::Plate;
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

/// Pose of a sponge in the frame of a plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpongePose {
    /// Position of the tip \[m\].
    pub tip: Vector3<f64>,
    /// Axis a, out of the tool; a unit vector.
    pub axis: Vector3<f64>,
}

impl Foundation {
    /// Returns the foundation of a sponge with a stated stiffness; `None` without one.
    #[must_use]
    pub fn of(sponge: &Sponge) -> Option<Self> {
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
        Self::of(&tool.sponge).filter(|_| tool.is_present())
    }

    /// Compression w at a point of a face \[m\]; below 0 where the free face does not reach it.
    #[must_use]
    pub fn compression(&self, pose: &SpongePose, point: &Vector3<f64>) -> f64 {
        self.compression_m + (pose.tip - point).dot(&pose.axis)
    }

    /// Forces of a volume of compressed foam, for the least and the greatest stiffness \[N\].
    #[must_use]
    pub fn forces_n(&self, volume_m3: f64) -> [f64; 2] {
        self.stiffness_pa.map(|pa| pa * volume_m3 / self.free_height_m)
    }
}

impl SpongePose {
    /// Returns the pose of a tip frame of the world, relative to a plate.
    #[must_use]
    pub fn on(plate: &Plate, tip: &RigidTransform) -> Self {
        let axis: Vector3<f64> = tip.rotation.column(2).into_owned();
        Self {
            tip: plate.local(&tip.translation),
            axis: plate.pose.inverse_transform_vector(&axis),
        }
    }
}
