//! Joint positions, speeds and accelerations, and speed and acceleration of the tip.

use super::findings::Findings;
use super::hermite::Piece;
use super::moments::Moment;
use platewash::certificate::Requirement;
use platewash::workcell::trajectory::SegmentKind;
use platewash::{JointVector, Plan, RobotModel};

/// What a value must exceed its limit by to count as broken, as a part of the limit, and \[rad\].
const EXACT: f64 = 2e-9;
const MARGIN_RAD: f64 = 1e-9;

/// What differences of the tip are right to, as a part of the limit.
const DIFFERENCE: f64 = 2e-9;

pub fn joints(plan: &Plan, robot: &RobotModel, pieces: &[Piece], moments: &[Moment], findings: &mut Findings) {
    let limits = robot.limits();
    let most = JointVector::from(plan.job.limits.joint_acceleration_rad_s2);
    for m in moments {
        let piece = &pieces[m.piece];
        let (q, qd, qdd) = (piece.position(m.u), piece.speed(m.u), piece.acceleration(m.u));
        let margin = (q - limits.lower).min().min((limits.upper - q).min());
        findings.at_least(Requirement::JointPosition, margin, 0.0, MARGIN_RAD);
        for (name, value, limit) in [
            (Requirement::JointSpeed, qd, &limits.velocity),
            (Requirement::JointAcceleration, qdd, &most),
        ] {
            let share = value.abs().component_div(limit).imax();
            findings.at_most(name, value[share].abs(), limit[share], EXACT * limit[share]);
        }
    }
}

/// While it washes against what washing must keep, otherwise against the limits of the tip anywhere.
pub fn tip(plan: &Plan, moments: &[Moment], findings: &mut Findings) {
    let (limits, wash) = (&plan.job.limits, &plan.job.requirements);
    for m in moments {
        let washes = m.segment(plan).is_some_and(|s| s.kind == SegmentKind::Wash);
        let [(speed, v), (acceleration, a)] = if washes {
            [
                (Requirement::WashSpeed, wash.wash_speed_m_s.min(limits.tip_speed_m_s)),
                (
                    Requirement::WashAcceleration,
                    wash.wash_acceleration_m_s2.min(limits.tip_acceleration_m_s2),
                ),
            ]
        } else {
            [
                (Requirement::TipSpeed, limits.tip_speed_m_s),
                (Requirement::TipAcceleration, limits.tip_acceleration_m_s2),
            ]
        };
        findings.at_most(speed, m.speed, v, DIFFERENCE * v);
        findings.at_most(acceleration, m.acceleration, a, DIFFERENCE * a);
    }
}
