//! The largest inertia that each joint meets.

use super::model::DynamicsModel;
use platewash_kinematics::{AXES, JointLimits, JointVector};

/// Configurations that are looked at: the largest entry found is then within a percent or so of the largest there is.
const CONFIGURATIONS: u32 = 4096;

/// The first six primes: bases of Halton's sequence.
const BASES: [u32; AXES] = [2, 3, 5, 7, 11, 13];

/// `count` configurations \[rad\] spread evenly over the limits, ±π for a continuous joint: Halton's sequence (Numer. Math. 2,
/// 1960), the same on every machine.
pub fn spread(limits: &JointLimits, count: u32) -> impl Iterator<Item = JointVector> + '_ {
    (1..=count).map(|k| {
        JointVector::from_fn(|joint, _| {
            let [least, most] = limits.sampling_range(joint);
            least + (most - least) * radical_inverse(k, BASES[joint])
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

/// The digits of `k` behind the point, last one first: in \[0, 1).
fn radical_inverse(mut k: u32, base: u32) -> f64 {
    let (mut value, mut digit) = (0.0, 1.0 / f64::from(base));
    while k > 0 {
        value += f64::from(k % base) * digit;
        digit /= f64::from(base);
        k /= base;
    }
    value
}
