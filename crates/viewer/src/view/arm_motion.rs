//! Page of a motion of an arm alone, of any planner: the motion, its proof and the worst places.

use super::arm::Arm;
use super::certificate::{Certificate, Check};
use super::clearance::{Clearance, even_times};
use super::document::{Surroundings, View};
use super::error::ViewError;
use super::heading::Heading;
use super::motion::Motion;
use super::numbers::Numbers;
use nalgebra::Vector6;
use platewash_bodies::clearance::ClearanceModel;
use platewash_certificate::{self as proved, Status};
use platewash_kinematics::{AXES, RobotModel};
use platewash_motion::piecewise::PiecewiseMotion;
use platewash_motion::trajectory::{PlanSegment, SegmentKind};
use platewash_workcell::words::printable;
use platewash_workcell::{Exclusion, Workcell};

/// Time between two knots of the motion that is shown, at most \[s\].
const STEP_S: f64 = 0.01;

/// Greatest number of knots between two points.
const MOST_STEPS: f64 = 1000.0;

/// Motion of an arm, with what was proved about it.
#[derive(Debug, Clone, Copy)]
pub struct ArmMotion<'a> {
    /// Name of the motion, such as that of its file.
    pub name: &'a str,
    /// The motion, from 0 s.
    pub motion: &'a PiecewiseMotion,
    /// The arm's mount and tool, and the obstacles.
    pub workcell: &'a Workcell,
    /// The arm.
    pub robot: &'a RobotModel,
    /// Required clearance \[m\].
    pub clearance_m: f64,
    /// The first line of the proof.
    pub headline: &'a str,
    /// True where every rule is proved.
    pub proved: bool,
    /// The rules, with times from 0 s.
    pub checks: &'a [proved::Check],
    /// Pairs of bodies that are not judged.
    pub excluded: &'a [Exclusion],
    /// Assumptions of the proof.
    pub assumptions: &'a [String],
}

impl View {
    /// A motion of an arm alone, with its proof. Distances over time are sampled for display.
    ///
    /// # Errors
    /// [`ViewError`] for an empty motion.
    pub fn of_arm_motion(shown: &ArmMotion<'_>) -> Result<Self, ViewError> {
        let (workcell, robot) = (shown.workcell, shown.robot);
        let [start, _] = shown.motion.at(0.0).ok_or(ViewError::NoMotion)?;
        let duration_s = shown.motion.duration_s();
        let alone = Self::of_configuration(robot, Some(&workcell.tool), &start);
        Ok(Self {
            heading: Heading {
                scenario: shown.name.to_owned(),
                duration_s,
                ..alone.heading
            },
            certificate: Some(Certificate {
                passes: shown.proved,
                headline: printable(shown.headline),
                hash: Status::Proved,
                checks: (shown.checks.iter()).map(|check| Check::new(check, None)).collect(),
                contact: None,
                rests_on: shown.assumptions.to_vec(),
            }),
            arm: Arm::new(robot, &workcell.mount, &workcell.tool.mounting_frame(robot), None),
            surroundings: Surroundings {
                obstacles: workcell.obstacles.clone(),
                ..Surroundings::default()
            },
            segments: vec![PlanSegment {
                kind: SegmentKind::Transit,
                plate: 0,
                t_start_s: 0.0,
                t_end_s: duration_s,
            }],
            motion: Some(knots(shown.motion)),
            clearance: clearance(shown),
            ..alone
        })
    }
}

/// Samples a motion, so close that cubics between them show it.
fn knots(motion: &PiecewiseMotion) -> Motion {
    let mut times = Vec::new();
    for piece in motion.pieces() {
        let [from, length_s] = [piece.t_s[0], piece.length_s()];
        let steps = (length_s / STEP_S).ceil().clamp(1.0, MOST_STEPS);
        times.extend((0..steps as usize).map(|k| from + length_s * k as f64 / steps));
    }
    times.push(motion.duration_s());
    times.dedup();
    let states: Vec<[Vector6<f64>; 2]> = times.iter().filter_map(|t_s| motion.at(*t_s)).collect();
    Motion {
        t_s: Numbers::f64([times.len()], times.iter().copied()),
        q_rad: Numbers::f64([states.len(), AXES], states.iter().flat_map(|[q, _]| q.iter().copied())),
        qd_rad_s: Numbers::f32_rows(states.iter().map(|[_, qd]| qd)),
    }
}

fn clearance(shown: &ArmMotion<'_>) -> Option<Clearance> {
    let seen = Workcell {
        exclusions: shown.excluded.to_vec(),
        ..shown.workcell.seen_from_base().into_owned()
    };
    let model = ClearanceModel::new(shown.robot, &seen, &[]).ok()?;
    let worst = shown.checks.iter().filter_map(|check| check.worst.time_s);
    let times = even_times(shown.motion.duration_s(), worst);
    let nearest = |t_s: f64| model.nearest(&shown.motion.at(t_s)?[0], &[]);
    Clearance::sampled(
        &times,
        nearest,
        &shown.workcell.mount,
        model.body_names(),
        shown.clearance_m,
    )
}
