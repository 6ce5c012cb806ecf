//! Contact of the sponge with a plate, as the certificate states it.

use crate::judged_job::JudgedJob;
use crate::washing::holder_load::HolderLoad;
use platewash_bodies::coverage::reaches;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// Proved share of a plate's face.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, TS)]
#[ts(optional_fields)]
pub struct ProvedShare {
    /// Lower bound on the share of the face, by area, that gets `threshold` or more.
    pub at_least: f64,
    /// Required share of the face.
    pub required: f64,
    /// Compression \[m\], time in contact \[s\] or dose \[Pa·m\].
    pub threshold: f64,
    /// Value at the worst place found, in the unit of `threshold`; `None` where all places get enough.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub worst: Option<f64>,
    /// Position of that place, world frame \[m\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub worst_m: Option<[f64; 3]>,
}

/// Extreme of a quantity over a wash: a proved bound and an attained value.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, TS)]
#[ts(optional_fields)]
pub struct ProvedExtreme {
    /// Proved bound of the quantity; `None` where nothing is proved.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bound: Option<f64>,
    /// Value that is certainly attained.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seen: Option<f64>,
    /// Time of `seen` \[s\].
    pub time_s: f64,
    /// Position on the plate or, for a force, of the tip at that time, world frame \[m\].
    pub place_m: [f64; 3],
}

/// Proved bounds of the contact between the sponge and a plate from approach to retreat. They hold for every plate height within the stated
/// error and every sponge stiffness in the stated range.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, TS)]
#[ts(optional_fields)]
pub struct PlateContact {
    /// Index of the plate.
    pub plate: usize,
    /// Share that is compressed by the least compression that counts, or more, at some moment.
    pub pressed: ProvedShare,
    /// Share that is in contact long enough.
    pub time: ProvedShare,
    /// Share with enough dose ∫ p dl in contact.
    pub dose: ProvedShare,
    /// Greatest strain of the sponge, from approach to retreat.
    pub strain: ProvedExtreme,
    /// Least force along the sponge's axis during the wash \[N\].
    pub least_force_n: ProvedExtreme,
    /// Greatest force along the sponge's axis, from approach to retreat \[N\].
    pub greatest_force_n: ProvedExtreme,
    /// Greatest friction torque about the sponge's axis \[N·m\], for the assumed friction coefficients 0.3 and 1.0; `None` where nothing is
    /// proved.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction_torque_nm: Option<[f64; 2]>,
    /// Load that the plate's holder takes, from approach to retreat; `None` where nothing is proved.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub holder_load: Option<HolderLoad>,
}

impl PlateContact {
    /// True where the required shares are pressed, are in contact long enough, and get the dose.
    pub(crate) fn is_enough(&self) -> bool {
        [self.pressed, self.time, self.dose]
            .iter()
            .all(|share| reaches(share.at_least, share.required))
    }

    /// Returns every position in the result, for a change of frame.
    pub(crate) fn places_mut(&mut self) -> impl Iterator<Item = &mut [f64; 3]> {
        let shares = [&mut self.pressed, &mut self.time, &mut self.dose];
        let extremes = [&mut self.strain, &mut self.least_force_n, &mut self.greatest_force_n];
        let worst = shares.into_iter().filter_map(|share| share.worst_m.as_mut());
        worst.chain(extremes.into_iter().map(|extreme| &mut extreme.place_m))
    }
}

/// True if the contact with every plate to wash is known.
pub(crate) fn are_of_all_plates(judged: &JudgedJob<'_>, all: &[PlateContact]) -> bool {
    let mut plates = judged.job.plates_to_wash();
    plates.all(|plate| all.iter().any(|c| c.plate == plate))
}
