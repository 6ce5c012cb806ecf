//! The proof of a motion of an arm alone, of any planner: for people and as data.

use crate::motion_stop::{end_speeds, with_stop};
use platewash_certificate::{
    ArmMotionProof, Check, Measure, MotionRules, PairBound, ProveError, Requirement, Status, Timing, prove_arm_motion,
};
use platewash_export::trajectory::{ExactTime, Interpolation, PointMotion};
use platewash_kinematics::urdf::FollowerLink;
use platewash_kinematics::words::{decimals_down, distinct_decimals, rounded};
use platewash_kinematics::{AXES, JointVector, RobotModel};
use platewash_motion::piecewise::PiecewiseMotion;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::words::count_with_noun;
use platewash_workcell::workcell::{Exclusion, ExclusionReason, Workcell};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;

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
    exact: Option<ExactTime>,
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
    span: Option<[ExactTime; 2]>,
    #[serde(skip)]
    duration_s: f64,
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

/// Judges the motion of an arm in a workcell: joint limits, and the clearance of every pair of bodies, at every moment.
///
/// ```
/// use platewash::export::trajectory::JointPoints;
/// use platewash::bodies::assembly;
/// use platewash::{CancelToken, JointVector, Pose, RobotModel, prove_motion};
///
/// let arm = RobotModel::irb120()?;
/// let points = JointPoints { q_rad: vec![JointVector::zeros(), JointVector::repeat(0.5)], ..JointPoints::default() };
/// let motion = points.motion(&arm, None)?;
/// let alone = assembly::workcell_without_tool(&arm, Pose::identity(), Vec::new())?;
/// let report = prove_motion(&motion, &alone, &arm, 0.005, None, &CancelToken::new())?;
/// assert!(report.headline.starts_with("PROVED"), "{report}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// `acceleration_rad_s2` are the greatest joint accelerations, if they are to be judged; those that the description states are judged wherever
/// speeds do not jump. Without times only positions and clearance are judged.
///
/// # Errors
/// [`ProveError`] for what cannot be judged, and when it is given up. A motion that breaks a rule is no error.
pub fn prove_motion(
    motion: &PointMotion,
    workcell: &Workcell,
    arm: &RobotModel,
    clearance_m: f64,
    acceleration_rad_s2: Option<JointVector>,
    cancel: &CancelToken,
) -> Result<MotionReport, ProveError> {
    let rules = MotionRules {
        clearance_m,
        acceleration_rad_s2,
        rests_outside: motion.rests_outside(),
        timing: motion.start.map_or(Timing::Free, |_| Timing::Stated),
    };
    let judged = judged_motion(motion, arm, acceleration_rad_s2.as_ref());
    let proof = prove_arm_motion(&judged, workcell, arm, &rules, cancel)?;
    Ok(MotionReport::new((motion, &judged), workcell, arm, &rules, proof))
}

/// Returns the motion that is judged: through the points, and to rest behind the last one where the points state speeds and every joint has
/// an acceleration limit \[rad/s²\], given or of the description, at which it brakes.
#[must_use]
pub fn judged_motion(
    motion: &PointMotion,
    arm: &RobotModel,
    acceleration_rad_s2: Option<&JointVector>,
) -> PiecewiseMotion {
    let states_speeds = motion.start.is_some() && !motion.rests_outside();
    let given = acceleration_rad_s2.copied();
    let given = given.unwrap_or_else(|| JointVector::repeat(f64::INFINITY));
    // The lesser of those given and those of the description; infinite where neither is.
    let limits = arm.limits().within_acceleration(&given);
    match states_speeds && limits.iter().all(|limit| *limit > 0.0 && limit.is_finite()) {
        true => with_stop(&motion.motion, &limits),
        false => motion.motion.clone(),
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

impl MotionReport {
    fn new(
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
    fn at_fault(&self) -> Option<&JudgedRule> {
        let of = |status| self.rules.iter().rev().find(|rule| rule.status == status);
        of(Status::Violated).or_else(|| of(Status::NotProved))
    }

    fn first_line(&self, arm: &RobotModel) -> String {
        let required = self.required_words();
        let (fault, points) = (self.at_fault(), count_with_noun(self.points, "point"));
        match (self.verdict, fault) {
            (MotionVerdict::Proved, _) => {
                let mut rules = self.rules.iter();
                let clearance = rules.find(|rule| rule.requirement == Requirement::Clearance);
                let bound_m = clearance.and_then(|rule| rule.measure?.bound);
                let least_m = bound_m.map(|m| m.max(self.required_clearance_m));
                let least = least_m.map_or_else(String::new, |m| format!("at least {}", millimetres_down(m)));
                let span = self
                    .span_s
                    .map_or("for any timing (speeds are not judged)".to_owned(), |_| {
                        format!("over {} s", rounded(self.duration_s, 6))
                    });
                format!(
                    "PROVED: a motion through {points} {span} keeps its joint limits, and clearance {least} ({required}){}",
                    self.ends_words()
                )
            }
            (MotionVerdict::Broken, Some(rule)) => format!("BROKEN: {}", self.fault_words(rule, arm)),
            (_, Some(rule)) => format!("NOT PROVED: {}", self.fault_words(rule, arm)),
            (_, None) => format!(
                "NOT PROVED: {} of the arm's description without a collision shape: {}",
                count_with_noun(self.shapeless.len(), "link"),
                self.shapeless.join(", ")
            ),
        }
    }

    /// Speeds at the ends, and what is judged behind them; empty for a motion from rest to rest.
    fn ends_words(&self) -> String {
        let [start, end] = self.end_speeds_rad_s.unwrap_or_default();
        let at = |speed: f64| format!("{} rad/s", rounded(speed, 4));
        let starts = (start > 0.0).then(|| format!("it starts at {}", at(start)));
        let ends = (end > 0.0).then(|| match self.stop_s {
            Some(stop_s) => format!(
                "it ends at {} and stops within {} s, judged, too",
                at(end),
                rounded(stop_s, 4)
            ),
            None => format!("it ends at {}, and what follows is not judged", at(end)),
        });
        let told: Vec<_> = starts.into_iter().chain(ends).collect();
        match told.is_empty() {
            true => String::new(),
            false => format!("; {}", told.join("; ")),
        }
    }

    fn required_words(&self) -> String {
        match self.required_clearance_m {
            0.0 => "no contact allowed".to_owned(),
            required_m => format!("{} mm required", rounded(1e3 * required_m, 6)),
        }
    }

    fn fault_words(&self, rule: &JudgedRule, arm: &RobotModel) -> String {
        let at = rule
            .worst
            .as_ref()
            .map_or_else(String::new, |moment| format!(" {moment}"));
        if rule.requirement == Requirement::Clearance {
            return self.clearance_words(rule, &at);
        }
        let (joint, Some(measure)) = (rule.joint.as_deref().unwrap_or("a joint"), rule.measure) else {
            return format!("{} cannot be judged", rule.requirement.words());
        };
        let (_, unit) = measure.unit.scale();
        let proved = match rule.status {
            Status::NotProved => " (seen, and not excluded)",
            _ => "",
        };
        match (rule.requirement, rule.worst, measure.seen) {
            (Requirement::JointPosition, Some(moment), _) => {
                let limits = arm.limits();
                let index = arm.joints().iter().position(|other| other.name == joint).unwrap_or(0);
                let q = moment.q_rad[index];
                let [lower, upper] = [limits.lower[index], limits.upper[index]];
                let limit = if q - upper > lower - q { upper } else { lower };
                let soft = if limits.is_soft[index][usize::from(q - upper > lower - q)] {
                    "soft "
                } else {
                    ""
                };
                let [q, limit] = distinct_decimals(q, limit, 4);
                format!("{joint} is at {q} rad, its {soft}limit is {limit} rad{proved},{at}")
            }
            (Requirement::JointAcceleration, _, None) => {
                format!(
                    "the speed of {joint} jumps{at}, so no acceleration limit holds; leave --acceleration-limits out, or use cubics"
                )
            }
            (_, _, Some(seen)) => {
                let [seen, limit] = distinct_decimals(seen, measure.limit, 4);
                format!(
                    "{} of {joint} is {seen} {unit}, its limit is {limit} {unit}{proved},{at}",
                    rule.requirement.words()
                )
            }
            _ => format!("{} of {joint} is not bounded", rule.requirement.words()),
        }
    }

    fn clearance_words(&self, rule: &JudgedRule, at: &str) -> String {
        let required = self.required_words();
        let (Some(measure), Some([a, b])) = (rule.measure, &rule.pair) else {
            return match rule.measure {
                Some(_) => format!("clearance is not bounded ({required})"),
                None => "no bodies could meet: the arm's description has no collision shapes, or they are all left out"
                    .to_owned(),
            };
        };
        let seen_m = measure.seen.unwrap_or(f64::NAN);
        if rule.status == Status::Violated {
            let how = match seen_m <= 0.0 {
                true => "touch".to_owned(),
                false => {
                    let [seen, _] = distinct_decimals(1e3 * seen_m, 1e3 * measure.limit, 2);
                    format!("come within {seen} mm")
                }
            };
            let between = match self.only_between_points {
                true => "; at the points all is clear",
                false => "",
            };
            return match self.in_base.contains(b) {
                true => format!(
                    "{b} reaches {} mm into {a}, and neither moves",
                    rounded(-1e3 * seen_m, 2)
                ),
                false => format!("{a} and {b} {how} ({required}){at}{between}"),
            };
        }
        let bound = measure.bound.map_or("nothing".to_owned(), millimetres_down);
        format!(
            "clearance is proved to be at least {bound} ({required}); the nearest seen are {a} and {b}, {} mm{at}",
            rounded(1e3 * seen_m, 5)
        )
    }
}

/// A joint position for people: six digits, none beyond the ninth decimal \[rad\].
fn position(q_rad: f64) -> f64 {
    let shown = rounded(q_rad, 6);
    let shown = (shown * 1e9).round() / 1e9;
    // Adding zero turns −0 into 0.
    shown + 0.0
}

/// A length in millimetres, rounded down to hundredths.
fn millimetres_down(length_m: f64) -> String {
    format!("{} mm", decimals_down(1e3 * length_m, 2))
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

/// Sentences on what the verdict rests on.
fn assumptions(
    motion: &PointMotion,
    workcell: &Workcell,
    arm: &RobotModel,
    (rules, stop_s): (&MotionRules, f64),
    excluded: &[Exclusion],
) -> Vec<String> {
    let timed = motion.start.is_some();
    let mut all = vec![
        controller_words(motion.interpolation(), timed).to_owned(),
        "The motion begins at the first point; how the arm gets there is not judged.".to_owned(),
        format!(
            "The collision shapes of the description enclose the arm and what it carries; a mesh of a link counts as its convex hull{}.",
            match arm.split_links() {
                [] => String::new(),
                split => format!(
                    ", but for these, which count as convex parts that enclose it: {}",
                    split.join(", ")
                ),
            }
        ),
    ];
    if motion.simpler() > 0 {
        all.push(
            "Between two points of which one states no accelerations it moves along the cubic, and where one states no speeds along the \
             straight line in joint space, at constant speed."
                .to_owned(),
        );
    }
    if stop_s > 0.0 {
        all.push(
            "Behind the last point each joint brakes on its own, at its stated acceleration limit, until it rests."
                .to_owned(),
        );
    } else if rules.acceleration_rad_s2.is_some() && rules.rests_outside {
        all.push("The arm rests before the first point and after the last.".to_owned());
    }
    let fixed: BTreeMap<_, _> = arm.fixed_joints().iter().chain(&motion.fixed).collect();
    if !fixed.is_empty() {
        let words: Vec<_> = fixed.iter().map(|(name, at)| format!("{name} at {at}")).collect();
        all.push(format!("These joints do not move: {}.", words.join(", ")));
    }
    let names = |names: Vec<&str>| names.join(", ");
    if workcell.tool.is_present() {
        let bodies = workcell.tool.bodies.iter().map(|body| body.name.as_str());
        let bodies = names(bodies.chain(["sponge"]).collect());
        all.push(format!(
            "Behind its flange the arm carries these bodies of a tool: {bodies}."
        ));
    }
    all.push(match &workcell.obstacles[..] {
        [] => "Nothing stands around the arm, no floor either.".to_owned(),
        some => format!(
            "Nothing stands around the arm but these, which do not move: {}.",
            names(some.iter().map(|obstacle| obstacle.name.as_str()).collect())
        ),
    });
    all.extend(arm.controller_base().map(|base| {
        format!(
            "The arm's root link, '{}', stands at the mount; the controller counts from {base}.",
            base.root
        )
    }));
    if timed {
        let words = match rules.acceleration_rad_s2 {
            None => {
                "Speed limits are those of the description; no acceleration limits were stated, and accelerations are not judged."
            }
            Some(_) => "Speed limits are those of the description; acceleration limits are as they were stated.",
        };
        let described = arm.limits().acceleration.iter().flatten().next();
        all.push(match (described, rules.acceleration_rad_s2) {
            (None, _) => words.to_owned(),
            (Some(_), None) => {
                "Speed limits are those of the description, and so are acceleration limits where they are judged; other accelerations are not."
                    .to_owned()
            }
            (Some(_), Some(_)) => {
                "Speed limits are those of the description; acceleration limits are the lesser of those stated and the description's."
                    .to_owned()
            }
        });
    }
    all.extend(excluded_words(excluded));
    all
}

/// Motion that a controller is assumed to make.
fn controller_words(interpolation: Interpolation, timed: bool) -> &'static str {
    match (interpolation, timed) {
        (Interpolation::Linear, true) => {
            "The controller moves every joint at constant speed from each point to the next, a straight line in joint space, and follows it \
             exactly; the speed jumps at the points."
        }
        (Interpolation::Linear, false) => {
            "The arm moves from each point to the next along the straight line in joint space and follows it exactly, at any speed: the \
             points have no times, and speeds are not judged."
        }
        (Interpolation::Cubic, _) => {
            "The controller moves every joint along the cubic that has the positions and the speeds of two neighbouring points, and follows \
             it exactly."
        }
        (Interpolation::Quintic, _) => {
            "The controller moves every joint along the quintic that has the positions, speeds and accelerations of two neighbouring points, \
             and follows it exactly."
        }
    }
}

/// Counts the pairs that are not judged, by their reason.
fn excluded_words(excluded: &[Exclusion]) -> Option<String> {
    let count = |reason| excluded.iter().filter(|pair| pair.reason == reason).count();
    let told = |(reason, words): (ExclusionReason, &str)| match count(reason) {
        0 => None,
        count => Some(format!("{count} {words}")),
    };
    let reasons = [
        (ExclusionReason::Srdf, "by the SRDF"),
        (ExclusionReason::Neighbours, "as neighbours"),
        (
            ExclusionReason::AlwaysTouching,
            "as they touch in every configuration tried",
        ),
        (ExclusionReason::CarriesTool, "as one carries the other"),
        (
            ExclusionReason::NeitherMoves,
            "as neither body moves (none overlap; a floor at height 0 is not compared with the base)",
        ),
        (
            ExclusionReason::KeepsItsHeight,
            "as the link keeps its height over the floor",
        ),
    ];
    let reasons: Vec<_> = reasons.into_iter().filter_map(told).collect();
    (!reasons.is_empty()).then(|| format!("Pairs of bodies that are not judged: {}.", reasons.join(", ")))
}

impl fmt::Display for MotionMoment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(exact) = self.exact {
            write!(f, "at {exact} s, ")?;
        }
        if let Some(stopping_s) = self.stopping_s {
            return write!(
                f,
                "{} s after the last point, while the arm stops",
                rounded(stopping_s, 7)
            );
        }
        match self.share {
            0.0 => write!(f, "at point {}", self.point),
            1.0 => write!(f, "at point {}", self.point + 1),
            share => write!(
                f,
                "{:.1} % of the way from point {} to point {}",
                1e2 * share,
                self.point,
                self.point + 1
            ),
        }
    }
}

impl fmt::Display for MotionReport {
    /// Writes one screen; with `{:#}` every pair of bodies, too.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.headline)?;
        let worst = self.at_fault().or(self.rules.last()).and_then(|rule| rule.worst);
        if let Some(moment) = worst {
            let q: Vec<_> = moment.q_rad.iter().map(|q| position(*q).to_string()).collect();
            writeln!(f, "joint positions there [rad]: {}", q.join(", "))?;
        }
        writeln!(
            f,
            "\narm {}, {} motion, {}",
            self.robot,
            self.interpolation,
            self.span_words()
        )?;
        writeln!(
            f,
            "\n{:<20} {:<12} {:>12} {:>12} {:<7} worst",
            "rule", "status", "bound", "limit", "unit"
        )?;
        for rule in &self.rules {
            rule.fmt(f)?;
        }
        if !self.shapeless.is_empty() {
            writeln!(
                f,
                "\nlinks without a collision shape, which keep clear of nothing: {}",
                self.shapeless.join(", ")
            )?;
        }
        if f.alternate() {
            writeln!(f, "\nclearance of each pair [mm]: proved, seen")?;
            for pair in &self.clearance {
                let [a, b] = &pair.pair;
                let mm = |m: Option<f64>| m.map_or("–".to_owned(), |m| decimals_down(1e3 * m, 2));
                writeln!(f, "  {a} – {b}: {}, {}", mm(pair.at_least_m), mm(pair.seen_m))?;
            }
            writeln!(f, "\npairs that are not judged")?;
            for Exclusion { pair: [a, b], reason } in &self.excluded {
                writeln!(f, "  {a} – {b}: {}", reason_words(*reason))?;
            }
        }
        writeln!(f, "\nassumptions")?;
        self.assumptions
            .iter()
            .try_for_each(|sentence| writeln!(f, "  {sentence}"))
    }
}

impl MotionReport {
    fn span_words(&self) -> String {
        let points = count_with_noun(self.points, "point");
        match self.span {
            Some([from, to]) => format!("{points} from {from} s to {to} s"),
            None => format!("{points} without times"),
        }
    }
}

impl fmt::Display for JudgedRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = match self.requirement {
            Requirement::JointPosition => "joint limit margin".to_owned(),
            other => other.words(),
        };
        let status = match self.status {
            Status::Proved => "proved",
            Status::Violated => "broken",
            Status::NotProved | Status::Waived => "not proved",
        };
        write!(f, "{name:<20} {status:<12}")?;
        match &self.measure {
            Some(measure) => {
                let words = measure.words();
                write!(f, " {:>12} {:>12} {:<7}", words.bound, words.limit, words.unit)?;
            }
            None => write!(f, " {:>12} {:>12} {:<7}", "–", "–", "")?,
        }
        let who = self
            .joint
            .clone()
            .or_else(|| self.pair.as_ref().map(|[a, b]| format!("{a} and {b}")));
        let at = self.worst.map(|moment| moment.to_string());
        writeln!(f, " {}", who.into_iter().chain(at).collect::<Vec<_>>().join(", "))
    }
}

fn reason_words(reason: ExclusionReason) -> &'static str {
    match reason {
        ExclusionReason::Srdf => "the SRDF leaves it out",
        ExclusionReason::Neighbours => "neighbours",
        ExclusionReason::AlwaysTouching => "they touch in every configuration tried",
        ExclusionReason::CarriesTool => "one carries the other",
        ExclusionReason::NeitherMoves => "neither moves (they do not overlap; a floor at height 0 is not compared)",
        ExclusionReason::KeepsItsHeight => "the link keeps its height over the floor",
    }
}
