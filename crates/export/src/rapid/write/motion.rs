//! The motion: a routine a segment, a line a target.

use crate::dialect::{Point, Program};
use crate::maker_joints::Joint3;
use crate::rapid::write::{Lines, RUNNING, Routines};
use crate::rapid::zone_named;
use platewash_kinematics::JointVector;
use platewash_kinematics::words::fixed;
use platewash_workcell::trajectory::{PlanSegment, SegmentKind};
use platewash_workcell::words::{plate_name, plate_number};

/// Decimals of joint positions \[°\]: 1 µm at the tip.
const ANGLE_DECIMALS: usize = 4;
/// Decimals of times \[s\].
const TIME_DECIMALS: usize = 6;

/// A routine of motions.
#[derive(Debug)]
pub struct Routine {
    name: String,
    comment: String,
    lines: Vec<String>,
}

impl Routine {
    /// Name of the routine.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Number of targets.
    pub fn targets(&self) -> usize {
        self.lines.len()
    }

    /// Writes it.
    pub fn write(&self, lines: &mut Lines) {
        lines.comment(1, &self.comment);
        lines.line(1, &format!("PROC {}()", self.name));
        for line in &self.lines {
            lines.line(2, line);
        }
        lines.line(1, "ENDPROC");
    }
}

/// The zone at targets that are no stops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Zone {
    /// Zone that every controller has, by its name.
    Named(&'static str),
    /// One of that radius \[m\].
    Own(f64),
    /// No zone: every target is a stop.
    Stops,
}

impl Zone {
    fn word(self) -> &'static str {
        match self {
            Self::Named(name) => name,
            Self::Own(_) => "pwZone",
            Self::Stops => "fine",
        }
    }

    /// The radius that must be stated, as no zone by name has it \[mm\].
    pub fn radius_mm(self) -> Option<f64> {
        match self {
            Self::Own(radius_m) => Some(radius_m * 1e3),
            Self::Named(_) | Self::Stops => None,
        }
    }
}

/// The zone of a program.
pub fn zone(program: &Program<'_>) -> Zone {
    let radius_m = program.corner_m;
    match zone_named(radius_m) {
        Some(name) => Zone::Named(name),
        None if radius_m > 0.0 => Zone::Own(radius_m),
        None => Zone::Stops,
    }
}

/// The aggregate of a joint target, in the maker's joints. Axis 3 is counted with axis 2 as it is written, whose rounding is no error of joint 3.
pub fn target(joint_3: Joint3, q_rad: &JointVector) -> String {
    let mut degrees = q_rad.map(f64::to_degrees);
    degrees[1] = fixed(degrees[1], ANGLE_DECIMALS).parse().unwrap_or(degrees[1]);
    let degrees: Vec<String> = joint_3
        .convert(&degrees)
        .iter()
        .map(|q| fixed(*q, ANGLE_DECIMALS))
        .collect();
    format!("[[{}],[9E9,9E9,9E9,9E9,9E9,9E9]]", degrees.join(","))
}

/// Returns all motions after the one to the start, one routine per segment; a segment of more than `most` targets has several.
pub fn routines(program: &Program<'_>, most: usize) -> Vec<Routine> {
    let Some((start, points)) = program.points.split_first() else {
        return Vec::new();
    };
    let mut names = Routines::default();
    let mut clock = Clock::new(program.speed_share);
    let mut from = *start;
    let mut routines = Vec::new();
    let mut done = 0;
    for run in points.chunk_by(|a, b| a.segment == b.segment) {
        for part in run.chunks(most) {
            let (Some(first), Some(last)) = (part.first(), part.last()) else {
                continue;
            };
            let segment = program.plan.segments.get(first.segment);
            let mut lines = Vec::with_capacity(part.len());
            let begins_s = from.t_s;
            for (index, point) in part.iter().enumerate() {
                let next = points.get(done + index + 1);
                lines.push(motion(program, &mut clock, &from, point, next));
                from = *point;
            }
            done += part.len();
            routines.push(Routine {
                name: names.name(
                    segment.map(|segment| segment.kind),
                    segment.map_or(first.segment, |segment| plate_number(segment.plate)),
                ),
                comment: comment(segment, [begins_s, last.t_s], part.len()),
                lines,
            });
        }
    }
    routines
}

fn comment(segment: Option<&PlanSegment>, span_s: [f64; 2], targets: usize) -> String {
    let what = match segment.map(|segment| (segment.kind, plate_name(segment.plate))) {
        Some((SegmentKind::Depart, plate)) => format!("From the start to {plate}"),
        Some((SegmentKind::Approach, plate)) => format!("Down to {plate}"),
        Some((SegmentKind::Wash, plate)) => format!("Washes {plate}"),
        Some((SegmentKind::Retreat, plate)) => format!("Up from {plate}"),
        Some((SegmentKind::Transit, plate)) => format!("To {plate}"),
        Some((SegmentKind::Return, plate)) => format!("From {plate} to the end"),
        None => "Moves".to_owned(),
    };
    let [from, to] = span_s.map(|t_s| fixed(t_s, 3));
    format!("{what}: {from} s to {to} s of the plan, targets: {targets}.")
}

/// Returns the line for a point. Where the arm is there already it waits.
fn motion(program: &Program<'_>, clock: &mut Clock, from: &Point, point: &Point, next: Option<&Point>) -> String {
    let time = clock.up_to(point.t_s);
    let target = |point: &Point| target(program.joint_3, &point.q_rad);
    let target_here = target(point);
    if target_here == target(from) {
        return format!("WaitTime {time}/{RUNNING};");
    }
    let waits_next = next.is_some_and(|next| target(next) == target_here);
    let stops = point.rests || next.is_none() || waits_next;
    let zone = if stops { "fine" } else { zone(program).word() };
    format!("MoveAbsJ {target_here}\\NoEOffs,v100\\T:={time}/{RUNNING},{zone},pwTool\\WObj:=wobj0;")
}

/// Times between points, each rounded so that the sum of those before it, in the controller's single precision, is made good.
#[derive(Debug)]
struct Clock {
    share: f64,
    /// Time that the controller has reached \[s\].
    passed_s: f64,
}

impl Clock {
    fn new(share: f64) -> Self {
        Self { share, passed_s: 0.0 }
    }

    /// Time from the point before to a moment of the plan \[s\], as it is written.
    fn up_to(&mut self, t_s: f64) -> String {
        let written = fixed((t_s / self.share - self.passed_s) * self.share, TIME_DECIMALS);
        let read: f64 = written.parse().unwrap_or(0.0);
        self.passed_s += f64::from(read as f32 / self.share as f32);
        written
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounded_times_do_not_drift() {
        for share in [1.0, 0.1, 1.0 / 3.0] {
            let mut clock = Clock::new(share);
            for step in 1..20_000 {
                let t_s = f64::from(step) * 0.013_333_333_3;
                clock.up_to(t_s);
                assert!((clock.passed_s - t_s / share).abs() < 0.6e-6 / share, "{step} {share}");
            }
        }
    }

    #[test]
    fn targets_have_no_negative_zero() {
        let q = JointVector::from([-1e-9, 1.0, -1.0, 0.0, 1e-7, -1e-5]);
        assert_eq!(
            target(Joint3::Independent, &q),
            "[[0.0000,57.2958,-57.2958,0.0000,0.0000,-0.0006],[9E9,9E9,9E9,9E9,9E9,9E9]]"
        );
    }
}
