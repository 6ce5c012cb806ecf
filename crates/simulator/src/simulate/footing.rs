//! About which configurations a run must be stable: with nothing touching, and with the sponge on plates.

use super::error::SimulationError;
use crate::control::Standing;
use crate::plant::{Plant, SpongeOnPlates, longest_step_s};
use platewash_kinematics::RobotModel;
use platewash_kinematics::words::rounded;
use platewash_workcell::plan::Plan;
use platewash_workcell::simulation::SimulationSettings;
use platewash_workcell::trajectory::SegmentKind;
use platewash_workcell::trajectory::Trajectory;

/// Configurations along a plan about which the sampled loop is checked, at most; as many in washes, on each kind of foam.
const STABLE_AT: usize = 64;

/// Significant digits of a rate in messages.
const RATE_DIGITS: usize = 6;

/// The sponge among the plates, where its foam is simulated.
pub(super) fn sponge(plan: &Plan, robot: &RobotModel, settings: &SimulationSettings) -> Option<SpongeOnPlates> {
    if settings.law.is_kinematic() {
        return None;
    }
    let contact = settings.plant.contact.as_ref()?;
    SpongeOnPlates::new(robot, &plan.job.workcell.tool, &plan.job.plates, contact)
}

/// Configurations along the motion, with nothing touching, and those of washes with foam on the plate, as it is within its limit and bottoming
/// out.
pub(super) fn standings(
    plan: &Plan,
    motion: &Trajectory,
    plant: &Plant,
    sponge: Option<&SpongeOnPlates>,
) -> Vec<Standing> {
    let stride = motion.positions().len().div_ceil(STABLE_AT).max(1);
    let free = motion.positions().iter().step_by(stride).map(|q| Standing::from(*q));
    let mut all: Vec<_> = free.collect();
    let Some(sponge) = sponge else { return all };
    let washes = plan.segments.iter().filter(|segment| segment.kind == SegmentKind::Wash);
    let each = (STABLE_AT / washes.clone().count().max(1)).max(1);
    for segment in washes {
        let moments = (0..each).map(|k| (k as f64 + 0.5) / each as f64);
        let moments = moments.map(|share| segment.t_start_s + share * (segment.t_end_s - segment.t_start_s));
        for q in moments.filter_map(|t_s| motion.at(t_s)).map(|state| state.q) {
            let slopes = sponge.slopes(&plant.model, &q, segment.plate);
            all.extend(slopes.map(|slope| Standing {
                q,
                contact: Some(slope),
            }));
        }
    }
    all
}

/// Whether the steps of integration are short enough for the foam.
///
/// # Errors
/// [`SimulationError::StiffContact`], with what would do.
pub(super) fn check_steps(
    plant: &Plant,
    standings: &[Standing],
    settings: &SimulationSettings,
) -> Result<(), SimulationError> {
    let Some(contact) = &settings.plant.contact else {
        return Ok(());
    };
    let longest = |at: &Standing| {
        let slope = at.contact.as_ref()?;
        Some(longest_step_s(&plant.model.mass_matrix(&at.q), slope, plant.integrator))
    };
    let longest_s = standings.iter().filter_map(longest).fold(f64::INFINITY, f64::min);
    let (substeps, period_s) = (settings.plant.substeps, settings.period_s());
    if period_s / (substeps as f64) <= longest_s {
        return Ok(());
    }
    Err(SimulationError::StiffContact {
        stiffness_pa: contact.stiffness_pa,
        rate_hz: rounded(1.0 / period_s, RATE_DIGITS),
        substeps,
        least_substeps: (period_s / longest_s * (1.0 + 1e-9)).ceil() as usize,
        least_rate_hz: 1.0 / (longest_s * substeps as f64),
    })
}
