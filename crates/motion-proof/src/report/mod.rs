//! Report on a motion: for people and as data.
//!
//! | concept | module |
//! | --- | --- |
//! | the report and its parts | here |
//! | the first line | `words` |
//! | assumptions | `assumptions` |
//! | the report as text | `text` |

mod assumptions;
mod text;
mod words;

use crate::points::PointMotion;
use crate::report::assumptions::assumptions;
use crate::stop::end_speeds;
use crate::time::ExactTime;
use platewash_certificate::{ArmMotionProof, Check, Measure, MotionRules, PairBound, Requirement, Status};
use platewash_kinematics::urdf::FollowerLink;
use platewash_kinematics::{AXES, RobotModel};
use platewash_motion::piecewise::PiecewiseMotion;
use platewash_workcell::{Exclusion, Workcell};
use serde::Serialize;

/// Verdict on a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum MotionVerdict {
    /// Every rule holds at every moment.
    Proved,
    /// A rule is broken at a stated moment.
    Broken,
    /// Neither a proof nor a broken rule was found.
    NotProved,
}

/// Moment of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MotionMoment {
    /// Time, as the points state it \[s\]; `None` where they state none.
    pub time_s: Option<f64>,
    /// Index of the point before, from 0.
    pub point: usize,
    /// Share of the piece from that point to the next that is done, 0 to 1: in time, or of the line where the points have no times.
    pub share: f64,
    /// Time since the last point \[s\], while the arm stops behind it; `None` before.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stopping_s: Option<f64>,
    /// The time with all of its decimals.
    #[serde(skip)]
    pub(crate) exact: Option<ExactTime>,
    /// Joint positions \[rad\].
    pub q_rad: [f64; AXES],
}

/// Rule that a motion was judged by, with its worst case.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JudgedRule {
    /// The rule.
    pub requirement: Requirement,
    /// Result.
    pub status: Status,
    /// Bound, worst value seen and limit: for positions the margin from the limit \[rad\], for speeds and accelerations the greatest value
    /// \[rad/s, rad/s²\], for the clearance the least distance \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measure: Option<Measure>,
    /// Name of the worst joint.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// Names of the nearest bodies.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pair: Option<[String; 2]>,
    /// Moment of the worst value seen.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub worst: Option<MotionMoment>,
    /// Midpoint between the nearest bodies then, in the frame of the world \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub place_m: Option<[f64; 3]>,
}

/// Proof of a motion of an arm among obstacles. Lengths in metres, angles in radians, times in seconds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MotionReport {
    /// True where every rule holds at every moment.
    pub proved: bool,
    /// The verdict.
    pub verdict: MotionVerdict,
    /// The first line.
    pub headline: String,
    /// Name of the arm.
    pub robot: String,
    /// Number of points.
    pub points: usize,
    /// Motion between two points that state all that any point states: `linear`, `cubic` or `quintic`.
    pub interpolation: &'static str,
    /// Times of the first and the last point \[s\]; `None` where the points state none.
    pub span_s: Option<[f64; 2]>,
    /// Required clearance \[m\].
    pub required_clearance_m: f64,
    /// Greatest joint speeds at the first and at the last point \[rad/s\]; `None` where the points have no times.
    pub end_speeds_rad_s: Option<[f64; 2]>,
    /// Duration of the stop behind the last point \[s\]; `None` where none is judged.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stop_s: Option<f64>,
    /// Times of the first and the last point, with all of their decimals, and the time between them \[s\].
    #[serde(skip)]
    pub(crate) span: Option<[ExactTime; 2]>,
    #[serde(skip)]
    pub(crate) duration_s: f64,
    /// Names of the obstacles.
    pub obstacles: Vec<String>,
    /// The rules, each with its result.
    pub rules: Vec<JudgedRule>,
    /// True where the clearance is broken, and a check of the points alone finds nothing.
    pub only_between_points: bool,
    /// Names of the obstacles that reach into the base.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub in_base: Vec<String>,
    /// Links that keep clear of nothing, as their description has no shape for them.
    pub shapeless: Vec<String>,
    /// Clearance of each pair of bodies.
    pub clearance: Vec<PairBound>,
    /// Pairs of bodies that are not judged, with the reason of each.
    pub excluded: Vec<Exclusion>,
    /// Facts beside the verdict that a reader of it should know: statements of the file beside the motion, and pairs that the SRDF leaves out and
    /// that meet; one clause each.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    /// Assumptions of the verdict; one sentence each.
    pub assumptions: Vec<String>,
    /// The rules as the certificate has them, with times from that of the first point.
    #[serde(skip)]
    pub checks: Vec<Check>,
}

impl MotionReport {
    pub(crate) fn new(
        (motion, whole): (&PointMotion, &PiecewiseMotion),
        workcell: &Workcell,
        arm: &RobotModel,
        rules: &MotionRules,
        proof: ArmMotionProof,
    ) -> Self {
        let verdict = match proof.status() {
            Status::Violated => MotionVerdict::Broken,
            Status::Proved => MotionVerdict::Proved,
            Status::NotProved | Status::Waived => MotionVerdict::NotProved,
        };
        let start_s = motion.start.map(ExactTime::seconds);
        let shift = |time_s: Option<f64>| time_s.and_then(|t_s| Some(t_s + start_s?));
        let stop_s = whole.duration_s() - motion.motion.duration_s();
        let met = |([a, b], t_s): &([String; 2], f64)| {
            let at = moment((motion, whole), *t_s).map_or_else(String::new, |moment| format!(" {moment}"));
            format!("{a} and {b} meet{at}, which the SRDF leaves out of the proof")
        };
        let meeting: Vec<_> = proof.disabled_meeting.iter().map(met).collect();
        let of_description = notes_on_description(motion, arm, &proof);
        let mut clearance = proof.clearance;
        for pair in &mut clearance {
            pair.time_s = shift(pair.time_s);
        }
        let mut report = Self {
            proved: verdict == MotionVerdict::Proved,
            verdict,
            headline: String::new(),
            robot: arm.name().to_owned(),
            points: motion.motion.pieces().len() + 1,
            interpolation: motion.interpolation().word(),
            span_s: start_s.map(|start_s| [start_s, start_s + motion.motion.duration_s()]),
            span: motion
                .start
                .map(|start| [start, start.later(motion.motion.duration_s())]),
            duration_s: motion.motion.duration_s(),
            end_speeds_rad_s: start_s.map(|_| end_speeds(&motion.motion)),
            stop_s: (stop_s > 0.0).then_some(stop_s),
            required_clearance_m: rules.clearance_m,
            rules: proof
                .checks
                .iter()
                .map(|check| judged(check, (motion, whole), arm))
                .collect(),
            only_between_points: proof
                .least_at_knots_m
                .is_some_and(|least_m| least_m >= rules.clearance_m && least_m > 0.0),
            in_base: proof.in_base.iter().map(|overlap| overlap.body.name()).collect(),
            shapeless: proof.shapeless,
            clearance,
            assumptions: assumptions(motion, workcell, arm, (rules, stop_s), &proof.excluded),
            excluded: proof.excluded,
            notes: [motion.notes.clone(), meeting, of_description].concat(),
            obstacles: workcell
                .obstacles
                .iter()
                .map(|obstacle| obstacle.name.clone())
                .collect(),
            checks: proof.checks,
        };
        let notes: String = report.notes.iter().map(|note| format!("; {note}")).collect();
        report.headline = report.first_line(arm) + &notes;
        report
    }

    /// Names of the bodies that come too near, or may; `None` where the clearance is proved.
    #[must_use]
    pub fn too_near(&self) -> Option<&[String; 2]> {
        let fault = self
            .at_fault()
            .filter(|rule| rule.requirement == Requirement::Clearance)?;
        fault.pair.as_ref()
    }

    /// Returns what the first line says beside the verdict: speeds at the ends, and notes; one clause each.
    #[must_use]
    pub fn remarks(&self) -> Vec<String> {
        let ends = self.ends_words();
        let ends = ends.split("; ").filter(|clause| !clause.is_empty() && self.proved);
        ends.map(str::to_owned).chain(self.notes.iter().cloned()).collect()
    }

    /// Adds a fact beside the verdict to the notes and to the first line; one clause.
    pub fn note(&mut self, words: &str) {
        self.headline += &format!("; {words}");
        self.notes.push(words.to_owned());
    }

    /// The rule at fault: one that is broken, or else one that is not proved.
    pub(crate) fn at_fault(&self) -> Option<&JudgedRule> {
        let of = |status| self.rules.iter().rev().find(|rule| rule.status == status);
        of(Status::Violated).or_else(|| of(Status::NotProved))
    }
}

/// Returns what the description states and this proof does not use: limits of accelerations where speeds jump, whatever
/// [`RobotModel::unused_statements`] names, and links that are left out.
fn notes_on_description(motion: &PointMotion, arm: &RobotModel, proof: &ArmMotionProof) -> Vec<String> {
    let is_limited = arm.limits().acceleration.iter().any(Option::is_some);
    let is_judged = motion.start.is_none() || proof.check(Requirement::JointAcceleration).is_some();
    let jumps = (is_limited && !is_judged).then(|| {
        "acceleration limits of the description are not judged, as speeds jump at points that state none".to_owned()
    });
    let unused = arm.unused_statements();
    let named = unused.first().map(|first| match unused.len() {
        1 => format!("not used of the description: {first}"),
        many => format!(
            "not used of the description: {first} and {} more (platewash robot)",
            many - 1
        ),
    });
    let left_out = FollowerLink::clause(arm.left_out_links());
    jumps.into_iter().chain(named).chain(left_out).collect()
}

fn judged(check: &Check, motion: (&PointMotion, &PiecewiseMotion), arm: &RobotModel) -> JudgedRule {
    JudgedRule {
        requirement: check.requirement,
        status: check.status,
        measure: check.measure,
        joint: check
            .worst
            .joint
            .and_then(|joint| Some(arm.joints().get(joint)?.name.clone())),
        pair: check.worst.pair.clone(),
        worst: check.worst.time_s.and_then(|t_s| moment(motion, t_s)),
        place_m: check.worst.place_m,
    }
}

/// The moment of a motion at a time from its start \[s\].
fn moment((motion, whole): (&PointMotion, &PiecewiseMotion), t_s: f64) -> Option<MotionMoment> {
    let pieces = motion.motion.pieces().len();
    let begun = whole.pieces().partition_point(|piece| piece.t_s[0] <= t_s);
    let index = match t_s <= motion.motion.duration_s() {
        true => begun.min(pieces),
        false => begun,
    }
    .saturating_sub(1);
    let piece = whole.pieces().get(index)?;
    let [q, _] = piece.at(t_s);
    let (point, share, stopping_s) = match index < pieces {
        true => (index, ((t_s - piece.t_s[0]) / piece.length_s()).clamp(0.0, 1.0), None),
        false => (pieces, 0.0, Some(t_s - motion.motion.duration_s())),
    };
    let exact = motion.start.map(|start| start.later(t_s));
    Some(MotionMoment {
        time_s: exact.map(ExactTime::seconds),
        point,
        share,
        stopping_s,
        exact,
        q_rad: q.into(),
    })
}
