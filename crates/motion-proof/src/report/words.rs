//! Words of the first line: the verdict, and the fault or the bound behind it.

use crate::report::{JudgedRule, MotionReport, MotionVerdict};
use platewash_certificate::{Requirement, Status};
use platewash_kinematics::RobotModel;
use platewash_kinematics::words::{decimals_down, distinct_decimals, rounded};
use platewash_workcell::words::count_with_noun;

impl MotionReport {
    pub(crate) fn first_line(&self, arm: &RobotModel) -> String {
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
    pub(crate) fn ends_words(&self) -> String {
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

    pub(crate) fn required_words(&self) -> String {
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
pub(crate) fn position(q_rad: f64) -> f64 {
    let shown = rounded(q_rad, 6);
    let shown = (shown * 1e9).round() / 1e9;
    // Adding zero turns −0 into 0.
    shown + 0.0
}

/// A length in millimetres, rounded down to hundredths.
fn millimetres_down(length_m: f64) -> String {
    format!("{} mm", decimals_down(1e3 * length_m, 2))
}
