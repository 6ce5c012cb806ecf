//! The loop of samples: reference, law, plant; and the configurations at which a run must be stable: with nothing touching, and with the
//! sponge on plates.

use crate::control::{self, Command, ControlLaw, OperatingPoint, Reference};
use crate::dynamics::DynamicsModel;
use crate::plant::{FoamLoad, Plant, PlantState, SpongeOnPlates, longest_step_s};
use crate::simulate::amount::MAX_SAMPLES;
use crate::simulate::amount::MAX_STEPS;
use crate::simulate::amount::highest_rate;
use crate::simulate::check::check;
use crate::simulate::error::SimulationError;
use crate::simulate::execution::{Execution, Sample};
use crate::simulate::schedule::Schedule;
use nalgebra::Vector3;
use platewash_kinematics::words::rounded;
use platewash_kinematics::{Frame, JointVector, RobotModel};
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::{JointState, SegmentKind, Trajectory};
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::simulation::{PlantSettings, SimulationSettings};

/// Significant digits of a rate in messages.
const RATE_DIGITS: usize = 6;

/// Positions \[rad\] and speeds \[rad/s\] beyond this are divergence, not motion.
const LARGEST: f64 = 1e6;

/// Runs a plan on its arm: sampled law, torque held between samples, plant. The settings that the plan states are
/// `plan.job.simulation`.
///
/// The arm starts on the path, at its speed. The law knows the plant's rigid bodies exactly, tool included, but neither
/// friction nor contact: where the sponge's foam is simulated, plates push the arm off its path. Under a kinematic law there is no plant.
///
/// # Errors
/// [`SimulationError`]: a plan that is no motion or for another arm, settings that make no sense, an arm without dynamics, a
/// law that cannot be stable, or an arm that leaves all bounds.
pub fn simulate(plan: &Plan, robot: &RobotModel, settings: &SimulationSettings) -> Result<Execution, SimulationError> {
    simulate_with(plan, robot, settings, &CancelToken::new())
}

/// Simulates as [`simulate`], and stops half-way when `token` is cancelled.
///
/// # Errors
/// The errors of [`simulate`], and [`SimulationError::Cancelled`].
pub fn simulate_with(
    plan: &Plan,
    robot: &RobotModel,
    settings: &SimulationSettings,
    token: &CancelToken,
) -> Result<Execution, SimulationError> {
    simulate_watched(plan, robot, settings, token, &mut |_| {})
}

/// Simulates as [`simulate_with`], and passes each sample to `watch` as soon as it is known, in time order and once. The run
/// waits for `watch` to return, and its result does not depend on it.
///
/// # Errors
/// The errors of [`simulate_with`]; samples before the fault have been sent by then.
pub fn simulate_watched(
    plan: &Plan,
    robot: &RobotModel,
    settings: &SimulationSettings,
    token: &CancelToken,
    watch: &mut dyn FnMut(&Sample),
) -> Result<Execution, SimulationError> {
    check_arm(plan, robot)?;
    plan.job.validate()?;
    let mount = plan.job.workcell.mount;
    let plan = &*plan.seen_from_base();
    check(settings, &plan.job.workcell.tool)?;
    let motion = plan.knots.motion()?;
    let schedule = Schedule::new(plan, settings.period_s())?;
    let count = count(motion.duration_s(), settings.period_s(), settings.plant.substeps)?;
    token.check()?;
    let plant = match settings.law.is_kinematic() {
        true => None,
        false => {
            let model = DynamicsModel::mounted(robot, Some(&plan.job.workcell.tool), &mount)?;
            Some(Plant::new(model, robot.limits(), &settings.plant))
        }
    };
    let sponge = sponge(plan, robot, settings);
    let mut law: Box<dyn ControlLaw + '_> = match &plant {
        Some(plant) => {
            let standings = standings(plan, &motion, plant, sponge.as_ref());
            check_steps(plant, &standings, settings)?;
            let substeps = settings.plant.substeps;
            let highest_hz = highest_rate(motion.duration_s(), substeps);
            control::law(
                settings.law,
                &settings.control,
                plant,
                robot.limits(),
                &standings,
                substeps,
            )
            .map_err(|error| error.with_rates_up_to(highest_hz))?
        }
        None => control::stable_kinematic(settings.law, &settings.control)?,
    };
    let run = Run {
        motion: &motion,
        plant: plant.as_ref(),
        plan,
        tip: plan.job.workcell.tool.tip_frame(robot),
        sponge: sponge.as_ref(),
        settings: &settings.plant,
        period_s: settings.period_s(),
        token,
    };
    run.carry_out(law.as_mut(), schedule, count, watch)
}

/// Data that do not change from sample to sample.
struct Run<'a> {
    motion: &'a Trajectory,
    plant: Option<&'a Plant>,
    plan: &'a Plan,
    tip: Frame,
    sponge: Option<&'a SpongeOnPlates>,
    settings: &'a PlantSettings,
    period_s: f64,
    token: &'a CancelToken,
}

/// Result of a command over one sample.
struct Outcome {
    state: PlantState,
    qdd: JointVector,
    torque: JointVector,
    /// True where a limit cut the torque.
    is_cut: bool,
    /// Load on the foam at the sample.
    load: Option<FoamLoad>,
}

impl Run<'_> {
    fn carry_out(
        &self,
        law: &mut dyn ControlLaw,
        mut schedule: Schedule<'_>,
        count: usize,
        watch: &mut dyn FnMut(&Sample),
    ) -> Result<Execution, SimulationError> {
        let mut reference = Reference {
            now: self.commanded_state(0),
            next: self.commanded_state(1),
        };
        let mut state = PlantState {
            q: reference.now.q,
            qd: reference.now.qd,
        };
        let mut samples = Vec::with_capacity(count);
        let (mut segment, mut saturated) = (schedule.at(0.0), 0);
        law.begin_segment();
        for k in 0..count {
            self.token.check()?;
            let t_s = self.time(k);
            let towards = schedule.at(self.time(k + 1));
            // The paper's program begins with its first waypoint, which ends the way there from the start.
            if towards != segment && schedule.segment(segment).kind != SegmentKind::Depart {
                law.begin_segment();
            }
            let outcome = match law.command(&reference, &state) {
                Command::Position(q) => self.moved(&state, q),
                Command::Torque(torque) => self.step_under_torque(&state, &torque, schedule.washed_plate(segment)),
            };
            let sample = Sample {
                t_s,
                segment,
                commanded: reference.now.q,
                state,
                qdd: outcome.qdd,
                torque: outcome.torque,
                load: outcome.load,
            };
            watch(&sample);
            samples.push(sample);
            saturated += usize::from(outcome.is_cut);
            state = outcome.state;
            check_bounded(self.time(k + 1), &state)?;
            segment = towards;
            reference = Reference {
                now: reference.next,
                next: self.commanded_state(k + 2),
            };
        }
        Ok(Execution {
            period_s: self.period_s,
            samples,
            limits: self.plant.map(|plant| plant.limits),
            saturated,
        })
    }

    fn time(&self, sample: usize) -> f64 {
        sample as f64 * self.period_s
    }

    /// Commanded state of the plan; after its end, to stay there.
    fn commanded_state(&self, sample: usize) -> JointState {
        let still = JointVector::zeros();
        self.motion.at(self.time(sample)).unwrap_or(JointState {
            q: still,
            qd: still,
            qdd: still,
        })
    }

    /// The arm is put where the law says.
    fn moved(&self, state: &PlantState, q: JointVector) -> Outcome {
        let qd = (q - state.q) / self.period_s;
        Outcome {
            state: PlantState { q, qd },
            qdd: (qd - state.qd) / self.period_s,
            torque: JointVector::zeros(),
            is_cut: false,
            load: None,
        }
    }

    /// The arm moves under a torque, with its sponge on `plate` if on any.
    fn step_under_torque(&self, state: &PlantState, torque: &JointVector, plate: Option<usize>) -> Outcome {
        let Some(plant) = self.plant else {
            return self.moved(state, state.q);
        };
        let held = plant.limits.cut(torque);
        let h = self.period_s / self.settings.substeps as f64;
        let (mut now, mut first, mut felt) = (*state, None, None);
        for _ in 0..self.settings.substeps {
            if let Some(sponge) = self.sponge {
                let (next, qdd, feels) = plant.step_on(sponge, &now, &held, h);
                first.get_or_insert(qdd);
                felt.get_or_insert(feels);
                now = next;
                continue;
            }
            let pushed = match plate {
                Some(plate) if self.settings.contact_force_n > 0.0 => held + self.push(&plant.model, &now.q, plate),
                _ => held,
            };
            let (next, qdd) = plant.step(&now, &pushed, h);
            first.get_or_insert(qdd);
            now = next;
        }
        Outcome {
            state: now,
            qdd: first.unwrap_or_default(),
            torque: held,
            is_cut: held != *torque,
            load: felt,
        }
    }

    /// Torques of the plate's force on the sponge, where it touches \[N·m\].
    fn push(&self, model: &DynamicsModel, q: &JointVector, plate: usize) -> JointVector {
        let plate = &self.plan.job.plates[plate];
        let tip: Vector3<f64> = model.position(q, &self.tip).coords;
        if plate.height_of(&tip) > self.plan.job.workcell.tool.sponge.compression_m {
            return JointVector::zeros();
        }
        model.torque_of_force(q, &self.tip, &(plate.axis() * self.settings.contact_force_n))
    }
}

fn check_arm(plan: &Plan, robot: &RobotModel) -> Result<(), SimulationError> {
    let planned = &plan.job.workcell.arm.urdf_sha256;
    if planned == robot.sha256() {
        return Ok(());
    }
    Err(SimulationError::OtherArm {
        planned: planned.clone(),
        given: robot.sha256().to_owned(),
    })
}

/// Samples from 0 s to the plan's end, which is the last one or lies less than a period before it.
fn count(duration_s: f64, period_s: f64, substeps: usize) -> Result<usize, SimulationError> {
    // A last period shorter than a millionth is rounding, not a sample.
    let count = (duration_s / period_s - 1e-6).ceil().max(0.0) + 1.0;
    if count <= MAX_SAMPLES as f64 && count * substeps as f64 <= MAX_STEPS as f64 {
        return Ok(count as usize);
    }
    Err(SimulationError::TooLong {
        duration_s,
        rate_hz: rounded(1.0 / period_s, RATE_DIGITS),
        substeps,
    })
}

fn check_bounded(t_s: f64, state: &PlantState) -> Result<(), SimulationError> {
    // A range holds no NaN.
    let bounds = -LARGEST..=LARGEST;
    let stray = (0..6).find(|&j| !(bounds.contains(&state.q[j]) && bounds.contains(&state.qd[j])));
    match stray {
        Some(joint) => Err(SimulationError::Divergence {
            t_s,
            joint,
            position_rad: state.q[joint],
            speed_rad_s: state.qd[joint],
        }),
        None => Ok(()),
    }
}

/// Configurations along a plan about which the sampled loop is checked, at most; as many in washes, on each kind of foam.
const STABLE_AT: usize = 64;

/// The sponge among the plates, where its foam is simulated.
pub(crate) fn sponge(plan: &Plan, robot: &RobotModel, settings: &SimulationSettings) -> Option<SpongeOnPlates> {
    if settings.law.is_kinematic() {
        return None;
    }
    let contact = settings.plant.contact.as_ref()?;
    SpongeOnPlates::new(robot, &plan.job.workcell.tool, &plan.job.plates, contact)
}

/// Configurations along the motion, with nothing touching, and those of washes with foam on the plate, as it is within its limit and bottoming
/// out.
pub(crate) fn standings(
    plan: &Plan,
    motion: &Trajectory,
    plant: &Plant,
    sponge: Option<&SpongeOnPlates>,
) -> Vec<OperatingPoint> {
    let stride = motion.positions().len().div_ceil(STABLE_AT).max(1);
    let free = motion
        .positions()
        .iter()
        .step_by(stride)
        .map(|q| OperatingPoint::from(*q));
    let mut all: Vec<_> = free.collect();
    let Some(sponge) = sponge else { return all };
    let washes = plan.segments.iter().filter(|segment| segment.kind == SegmentKind::Wash);
    let each = (STABLE_AT / washes.clone().count().max(1)).max(1);
    for segment in washes {
        let moments = (0..each).map(|k| (k as f64 + 0.5) / each as f64);
        let moments = moments.map(|share| segment.t_start_s + share * (segment.t_end_s - segment.t_start_s));
        for q in moments.filter_map(|t_s| motion.at(t_s)).map(|state| state.q) {
            let slopes = sponge.slopes(&plant.model, &q, segment.plate);
            all.extend(slopes.map(|slope| OperatingPoint {
                q,
                contact: Some(slope),
            }));
        }
    }
    all
}

/// Checks that the steps of integration are short enough for the foam.
///
/// # Errors
/// [`SimulationError::StiffContact`], with settings that are short enough.
pub(crate) fn check_steps(
    plant: &Plant,
    standings: &[OperatingPoint],
    settings: &SimulationSettings,
) -> Result<(), SimulationError> {
    let Some(contact) = &settings.plant.contact else {
        return Ok(());
    };
    let longest = |at: &OperatingPoint| {
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

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// The rate and the period that a refusal suggests are accepted when they are typed in.
        #[test]
        fn a_suggested_rate_is_accepted(mantissa in 1.0..10.0_f64, exponent in 0..6_i32, substeps in 1_usize..1000) {
            let duration_s = mantissa * 10_f64.powi(exponent);
            let refused = count(duration_s, duration_s * 1e-9, substeps).unwrap_err().to_string();
            let number = |before: &str| -> f64 {
                let rest = refused.split(before).nth(1).unwrap();
                rest.split([' ', ')']).next().unwrap().parse().unwrap()
            };
            for period_s in [1.0 / number("the rate must be at most "), number("the time step at least ")] {
                prop_assert!(count(duration_s, period_s, substeps).is_ok(), "{}", refused);
                prop_assert!(count(duration_s, 0.9 * period_s, substeps).is_err(), "{}", refused);
            }
        }
    }
}
