//! Pressing of the sponge while it washed a plate: force, contact lost, and area in contact.
//!
//! Forces are those along the tool's axis, Σ p dA, as in the certificate. Measurements at samples, not bounds.

use crate::dynamics::DynamicsModel;
use crate::plant::{FoamLoad, SpongeOnPlates};
use crate::simulate::error::SimulationError;
use crate::simulate::execution::Sample;
use crate::simulate::run::sponge;
use platewash_bodies::contact::{ContactSampler, Dwell, Foundation, Moment, SpongePose};
use platewash_kinematics::{Frame, JointVector, RobotModel};
use platewash_motion::plan::Plan;
use platewash_workcell::job::ContactThresholds;
use platewash_workcell::job::{ContactRequirements, JobTerms};
use platewash_workcell::plate::Plate;
use platewash_workcell::simulation::SimulationSettings;
use serde::Serialize;

/// Heights of a plate over where it should be, of which the report states the force \[m\].
pub const HEIGHT_ERRORS_M: [f64; 5] = [-0.002, -0.001, 0.0, 0.001, 0.002];

/// The one of these at which the plate is where it should be.
pub(crate) const AS_STATED: usize = 2;

/// Poses of a plan, at most, from which the force at another height is taken.
const POSES: usize = 200;

/// Time between moments of which contact is measured, at most \[s\].
const MOMENT_S: f64 = 0.005;

/// Distance between the points of a face at which contact is measured \[m\].
const POINTS_APART_M: f64 = 3e-3;

/// Least, mean and greatest of a force \[N\].
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct ForceRange {
    /// The least.
    pub least_n: f64,
    /// The mean over time.
    pub mean_n: f64,
    /// The greatest.
    pub most_n: f64,
}

/// The force that a planned wash has where the plate lies higher or lower.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ForceAtHeight {
    /// Raise of the plate along its axis \[m\].
    pub higher_m: f64,
    /// The force there.
    #[serde(flatten)]
    pub force: ForceRange,
}

/// Contact that was lost.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ContactLoss {
    /// Share of the wash's samples at which nothing touches.
    pub share: f64,
    /// Total time \[s\].
    pub time_s: f64,
    /// Time of the first loss \[s\].
    pub first_t_s: f64,
}

/// Shares of a plate's face that the executed wash kept in contact as the job asks, the plate where it is stated and of the stiffness simulated:
/// measured at points of the face, 3 mm apart, and at samples of the motion. No bound.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ExecutedContact {
    /// Compressed by the least compression.
    pub contact: f64,
    /// Share in contact long enough.
    pub time: f64,
    /// Share with enough of a dose.
    pub dose: f64,
}

/// Pressing of the sponge while it washed a plate.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Pressing {
    /// The force.
    #[serde(flatten)]
    pub force: ForceRange,
    /// The greatest compression of the foam \[m\].
    pub deepest_m: f64,
    /// Strain: the greatest compression over the free height.
    pub strain: f64,
    /// Contact lost; `None` where it never was.
    pub lost: Option<ContactLoss>,
    /// The force of the plan's own poses, with the plate at other heights: −2, −1, 0, 1 and 2 mm.
    pub planned: [ForceAtHeight; HEIGHT_ERRORS_M.len()],
    /// Area in contact; `None` where the job asks for no contact.
    pub contact: Option<ExecutedContact>,
}

/// Data that a wash is judged with.
pub(crate) struct Judge<'a> {
    model: DynamicsModel,
    sponge: SpongeOnPlates,
    tip: Frame,
    /// The sponge, of the stiffness simulated.
    foundation: Foundation,
    job: &'a JobTerms,
    period_s: f64,
}

impl<'a> Judge<'a> {
    /// `None` where no foam was simulated.
    pub fn new(
        plan: &'a Plan,
        robot: &RobotModel,
        settings: &SimulationSettings,
        period_s: f64,
    ) -> Result<Option<Self>, SimulationError> {
        let Some((sponge, contact)) = sponge(plan, robot, settings).zip(settings.plant.contact) else {
            return Ok(None);
        };
        let tool = &plan.job.workcell.tool;
        Ok(Some(Self {
            model: DynamicsModel::new(robot, Some(tool))?,
            sponge,
            tip: tool.tip_frame(robot),
            foundation: Foundation::stiff(&tool.sponge, [contact.stiffness_pa; 2]),
            job: &plan.job,
            period_s,
        }))
    }

    /// Pressing over the samples of a wash of a plate, by its index; `None` without samples, or without foam.
    pub fn pressing(&self, samples: &[Sample], index: usize, plate: &Plate) -> Option<Pressing> {
        let load: Option<Vec<FoamLoad>> = samples.iter().map(|sample| sample.load).collect();
        let load = load.filter(|load| !load.is_empty())?;
        let deepest_m = load.iter().map(|load| load.deepest_m).fold(0.0, f64::max);
        Some(Pressing {
            force: ForceRange::from_loads(&load),
            deepest_m,
            strain: deepest_m / self.foundation.free_height_m,
            lost: self.lost(samples, &load),
            planned: HEIGHT_ERRORS_M.map(|higher_m| self.at_height(samples, index, higher_m)),
            contact: (self.job.contact_of(plate)).map(|required| self.contact(samples, plate, &required)),
        })
    }

    fn lost(&self, samples: &[Sample], load: &[FoamLoad]) -> Option<ContactLoss> {
        let first = load.iter().position(|load| load.deepest_m <= 0.0)?;
        let count = load.iter().filter(|load| load.deepest_m <= 0.0).count();
        Some(ContactLoss {
            share: count as f64 / load.len() as f64,
            time_s: count as f64 * self.period_s,
            first_t_s: samples[first].t_s,
        })
    }

    fn at_height(&self, samples: &[Sample], index: usize, higher_m: f64) -> ForceAtHeight {
        let stride = samples.len().div_ceil(POSES).max(1);
        let poses = samples.iter().step_by(stride).map(|sample| &sample.commanded);
        let load: Vec<_> = poses
            .map(|q| self.sponge.load_at_rest(&self.model, q, index, higher_m))
            .collect();
        ForceAtHeight {
            higher_m,
            force: ForceRange::from_loads(&load),
        }
    }

    fn contact(&self, samples: &[Sample], plate: &Plate, required: &ContactRequirements) -> ExecutedContact {
        let stride = ((MOMENT_S / self.period_s) as usize).max(1);
        let moments: Vec<_> = samples
            .iter()
            .step_by(stride)
            .map(|sample| self.moment(sample.t_s, &sample.state.q, &sample.state.qd, plate))
            .collect();
        let wanted = ContactThresholds {
            height_error_m: 0.0,
            ..required.thresholds()
        };
        let looks = ContactSampler::new(self.foundation, moments, wanted);
        let keeps = |got: &Dwell| {
            [
                got.compression_m >= wanted.compression_m,
                got.time_s >= wanted.time_s,
                got.dose_pa_m >= wanted.dose_pa_m,
            ]
        };
        let (mut whole_m2, mut kept_m2) = (0.0, [0.0; 3]);
        for (point, area_m2) in plate.surface.points(POINTS_APART_M) {
            let got = looks.until(&point, |got| keeps(got).iter().all(|keeps| *keeps));
            whole_m2 += area_m2;
            for (kept_m2, keeps) in kept_m2.iter_mut().zip(keeps(&got)) {
                *kept_m2 += if keeps { area_m2 } else { 0.0 };
            }
        }
        let [contact, time, dose] = kept_m2.map(|kept_m2| kept_m2 / whole_m2);
        ExecutedContact { contact, time, dose }
    }

    fn moment(&self, t_s: f64, q: &JointVector, qd: &JointVector, plate: &Plate) -> Moment {
        let at = self.model.frame_motion(q, &self.tip);
        let [speed, turning] = at.twist(qd).map(|v| plate.pose.inverse_transform_vector(&v));
        Moment {
            t_s,
            pose: SpongePose::on(plate, &at.pose),
            speed,
            turning,
        }
    }
}

impl ForceRange {
    /// Range over samples of equal duration; zeros without samples.
    fn from_loads(load: &[FoamLoad]) -> Self {
        if load.is_empty() {
            return Self::default();
        }
        let forces = || load.iter().map(|load| load.force_n);
        Self {
            least_n: forces().fold(f64::INFINITY, f64::min),
            mean_n: forces().sum::<f64>() / load.len() as f64,
            most_n: forces().fold(f64::NEG_INFINITY, f64::max),
        }
    }
}
