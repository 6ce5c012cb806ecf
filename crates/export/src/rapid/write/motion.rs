//! The motion: a routine a segment, a line a target.

use crate::comment::wrapped;
use crate::joint_3::Joint3;
use crate::program::{Point, Program};
use crate::rapid::names::zone_named;
use crate::rapid::write::names::{RUNNING, free_name};
use platewash_kinematics::JointVector;
use platewash_kinematics::words::fixed;
use platewash_motion::trajectory::{PlanSegment, SegmentKind};
use platewash_workcell::words::{plate_name, plate_number};
use std::collections::HashSet;

/// Decimals of joint positions \[°\]: 1 µm at the tip.
const ANGLE_DECIMALS: usize = 4;
/// Decimals of times \[s\].
const TIME_DECIMALS: usize = 6;

/// Name of the program's own zone, where no zone that every controller has is the one at targets that are no stops.
pub const OWN_ZONE: &str = "pwZone";

/// A routine of motions.
#[derive(Debug)]
pub struct Routine {
    /// Its name.
    pub name: String,
    /// Number of targets.
    pub targets: usize,
    /// The whole of it, with an empty line before.
    pub text: String,
}

/// The zone at targets that are no stops: one by its name, the program's own, or none where every target is a stop.
pub fn zone(radius_m: f64) -> String {
    let other = if radius_m > 0.0 { OWN_ZONE } else { "fine" };
    zone_named(radius_m).unwrap_or_else(|| other.to_owned())
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
    let mut taken = HashSet::new();
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
            let mut lines = String::new();
            let [from_s, to_s] = [from.t_s, last.t_s].map(|t_s| fixed(t_s, 3));
            for (index, point) in part.iter().enumerate() {
                let next = points.get(done + index + 1);
                let line = motion(program, &mut clock, &from, point, next);
                lines += &format!("    {line}\n");
                from = *point;
            }
            let targets = part.len();
            done += targets;
            let (word, what) = words(segment);
            let number = segment.map_or(first.segment, |segment| plate_number(segment.plate));
            let name = free_name(&mut taken, word, number);
            let comment = format!("{what}: {from_s} s to {to_s} s of the plan, targets: {targets}.");
            let comment = wrapped("  !", [&*comment]);
            let text = format!("\n{comment}  PROC {name}()\n{lines}  ENDPROC\n");
            routines.push(Routine { name, targets, text });
        }
    }
    routines
}

/// The kind of a segment in the name of its routine, and in the comment there.
fn words(segment: Option<&PlanSegment>) -> (&'static str, String) {
    let Some(PlanSegment { kind, plate, .. }) = segment else {
        return ("Motion", "Moves".to_owned());
    };
    let plate = plate_name(*plate);
    match kind {
        SegmentKind::Depart => ("Depart", format!("From the start to {plate}")),
        SegmentKind::Approach => ("Approach", format!("Down to {plate}")),
        SegmentKind::Wash => ("Wash", format!("Washes {plate}")),
        SegmentKind::Retreat => ("Retreat", format!("Up from {plate}")),
        SegmentKind::Transit => ("Transit", format!("To {plate}")),
        SegmentKind::Return => ("Return", format!("From {plate} to the end")),
    }
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
    let zone = if stops { "fine" } else { &zone(program.corner_m) };
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
