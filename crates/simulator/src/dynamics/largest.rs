//! The largest inertia that each joint meets.

use super::model::DynamicsModel;
use platewash_kinematics::{JointLimits, JointVector, halton};

/// Configurations that are looked at: the largest entry found is then within a percent or so of the largest there is.
const CONFIGURATIONS: u32 = 4096;

/// `count` configurations \[rad\] spread evenly over the limits, ±π for a continuous joint: [`halton`].
pub fn spread(limits: &JointLimits, count: u32) -> impl Iterator<Item = JointVector> + '_ {
    (1..=count).map(|k| {
        let shares = halton::point(k);
        JointVector::from_fn(|joint, _| {
            let [least, most] = limits.sampling_range(joint);
            least + (most - least) * shares[joint]
        })
    })
}

impl DynamicsModel {
    /// The largest diagonal entries of M(q) over configurations within `limits` \[kg·m²\]: the inertia by which gains of
    /// independent joints are scaled.
    #[must_use]
    pub fn largest_inertias(&self, limits: &JointLimits) -> JointVector {
        spread(limits, CONFIGURATIONS).fold(JointVector::zeros(), |largest, q| {
            largest.sup(&self.mass_matrix(&q).diagonal())
        })
    }
}
