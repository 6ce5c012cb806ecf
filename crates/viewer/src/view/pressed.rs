//! Area of a plate that the foam presses, over time: sampled for display, not the proof.
//!
//! The sponge is the elastic foundation of [`platewash_bodies::contact`]. A place of the face counts as long as the foam over it is
//! compressed as required, for every height of the plate within the stated error; between two moments by the lines through both.

use super::raster::Raster;
use super::tips::Tip;
use nalgebra::Vector3;
use platewash_bodies::contact::{ContactSampler, Foundation, Moment, SpongePose};
use platewash_workcell::job::ContactThresholds;
use platewash_workcell::job::{JobTerms, Treatment};
use platewash_workcell::plate::Plate;
use platewash_workcell::tool::{Tool, Touch};
use serde::Serialize;
use ts_rs::TS;

/// Contact that counts as pressed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, TS)]
pub struct PressedRule {
    /// Least compression of the foam \[m\].
    pub compression_m: f64,
    /// Error of the plate's height, up or down, within which it must hold \[m\].
    pub height_error_m: f64,
    /// True where the job asks for it; otherwise any touch of the foam counts.
    pub is_promised: bool,
}

impl PressedRule {
    /// Contact that counts on a plate of a job; `None` where the sponge only has to be over a place: on a flat face without a
    /// promise of contact or in a dry run, and without a tool.
    #[must_use]
    pub fn on(plate: &Plate, job: &JobTerms) -> Option<Self> {
        if !job.workcell.tool.is_present() {
            return None;
        }
        let contact = job.contact_of(plate).filter(|_| job.treatment() == Treatment::Washed);
        let promised = contact.map(|contact| Self {
            compression_m: contact.compression_m,
            height_error_m: contact.height_error_m,
            is_promised: true,
        });
        let touched = Self {
            compression_m: 0.0,
            height_error_m: 0.0,
            is_promised: false,
        };
        promised.or_else(|| (!plate.surface.is_flat()).then_some(touched))
    }

    /// Adds the pressed area of a plate on a path of the tip. Where the sponge is pressed in farther than it can be, nothing
    /// counts.
    pub(crate) fn add(&self, raster: &mut Raster, plate: &Plate, tool: &Tool, way: &[Tip]) {
        // The stiffness does not matter: no force is computed.
        let foundation = Foundation::stiff(&tool.sponge, [0.0; 2]);
        let wanted = ContactThresholds {
            compression_m: self.compression_m,
            height_error_m: self.height_error_m,
            time_s: 0.0,
            dose_pa_m: 0.0,
        };
        let is_sound = |tip: &Tip| tool.touch(plate.height_of(&tip.at)) != Touch::Pressed;
        for stretch in way.chunk_by(|a, b| is_sound(a) == is_sound(b)) {
            if !stretch.first().is_some_and(is_sound) {
                continue;
            }
            let moments: Vec<Moment> = stretch.iter().map(|tip| moment(plate, tip)).collect();
            let looks = ContactSampler::new(foundation, moments, wanted);
            raster.add_stays(|[x, y]| {
                let height_m = plate.surface.height_m((x * x + y * y).sqrt());
                looks.contact_intervals(&Vector3::new(x, y, height_m))
            });
        }
    }
}

/// A moment in the frame of a plate; how fast it is does not matter.
fn moment(plate: &Plate, tip: &Tip) -> Moment {
    Moment {
        t_s: tip.t_s,
        pose: SpongePose {
            tip: plate.local(&tip.at),
            axis: plate.pose.inverse_transform_vector(&tip.axis),
        },
        speed: Vector3::zeros(),
        turning: Vector3::zeros(),
    }
}
