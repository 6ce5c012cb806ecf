//! What was washed: contact, coverage and verdict, plate by plate.
//!
//! The planned and the executed motion are measured alike: the tip seen from above at every sample of the plate's wash, with
//! the planner's own raster; a sponge tilted by τ counts as a disc of radius s cos τ, τ the largest tilt of that wash. The
//! executed sponge sweeps only where it touches ([`Touch`]). Without a tool body the whole sponge counts wherever the flange
//! passes, as in the report of the paper's job. These are measurements, not bounds: between samples the tip is
//! taken to move straight.

use super::cause::Cause;
use super::contact::{Contact, Touch};
use super::{Execution, Sample, SimulationError};
use platewash_kinematics::rotation::Rigid;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_planner::certificate;
use platewash_planner::plan::Plan;
use platewash_planner::tool_path::SegmentKind;
use platewash_workcell::coverage::{Coverage, CoverageError, CoverageSettings, coverage_of_strokes};
use platewash_workcell::layout::Plate;
use serde::Serialize;

/// As fine as the planner's own report: the proven error is about a tenth of a percent.
const RASTER: CoverageSettings = CoverageSettings { cell_m: 2e-4 };

/// Points of a path nearer to the last one than this are left out \[m\]: on a circle of 10 mm the chord is off by 3 µm.
const SPACING_M: f64 = 5e-4;

/// Whether a plate is washed by what the arm did.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PlateVerdict {
    /// Enough of it is surely swept, and the tool never had to be in the plate.
    Washed,
    /// Not so.
    NotWashed,
}

/// What was washed of a plate.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlateOutcome {
    /// Index of the plate.
    pub plate: usize,
    /// Whether it is washed.
    pub verdict: PlateVerdict,
    /// Why not, or why less than planned.
    pub causes: Vec<Cause>,
    /// Share swept by the planned motion.
    pub planned: Coverage,
    /// Share swept by the executed motion.
    pub executed: Coverage,
    /// Samples of the wash.
    pub samples: usize,
    /// Samples at which the executed sponge touches the plate.
    pub in_contact: usize,
    /// Largest tilt of the tool from the plate's normal, executed \[rad\].
    pub tilt_rad: f64,
}

/// Every plate that the plan washes, in the order of washing.
pub(super) fn plates(
    plan: &Plan,
    robot: &RobotModel,
    execution: &Execution,
) -> Result<Vec<PlateOutcome>, SimulationError> {
    let contact = Contact::new(plan, robot);
    let samples = &execution.samples;
    let mut outcomes = Vec::new();
    for (index, segment) in plan.segments.iter().enumerate() {
        if segment.kind != SegmentKind::Wash {
            continue;
        }
        let from = samples.partition_point(|s| s.segment < index);
        let to = samples.partition_point(|s| s.segment <= index);
        let wash = Wash {
            plan,
            contact: &contact,
            index: segment.plate,
            plate: &plan.plates[segment.plate],
            planned: track(robot, &contact, &samples[from..to], |s| s.commanded),
            executed: track(robot, &contact, &samples[from..to], |s| s.state.q),
        };
        outcomes.push(wash.outcome()?);
    }
    Ok(outcomes)
}

/// The tip at a sample.
#[derive(Debug, Clone, Copy)]
struct Tip {
    t_s: f64,
    pose: Rigid,
}

fn track(robot: &RobotModel, contact: &Contact<'_>, samples: &[Sample], of: fn(&Sample) -> JointVector) -> Vec<Tip> {
    let at = |sample: &Sample| Tip {
        t_s: sample.t_s,
        pose: robot.fk(&of(sample)).rigid(contact.tip()),
    };
    samples.iter().map(at).collect()
}

/// The wash of one plate.
struct Wash<'a> {
    plan: &'a Plan,
    contact: &'a Contact<'a>,
    index: usize,
    plate: &'a Plate,
    planned: Vec<Tip>,
    executed: Vec<Tip>,
}

impl Wash<'_> {
    fn outcome(&self) -> Result<PlateOutcome, CoverageError> {
        let touches: Vec<_> = self.executed.iter().map(|tip| self.touch(tip)).collect();
        let everywhere = vec![Touch::On; self.planned.len()];
        let planned = self.swept(&self.planned, &everywhere)?;
        let executed = self.swept(&self.executed, &touches)?;
        let causes = self.causes(&touches, &executed);
        let fails = |cause: &Cause| matches!(cause, Cause::NoTool | Cause::Pressed { .. } | Cause::Coverage { .. });
        Ok(PlateOutcome {
            plate: self.index,
            verdict: if causes.iter().any(fails) {
                PlateVerdict::NotWashed
            } else {
                PlateVerdict::Washed
            },
            causes,
            planned,
            executed,
            samples: self.executed.len(),
            in_contact: if self.has_tool() {
                touches.iter().filter(|touch| **touch == Touch::On).count()
            } else {
                0
            },
            tilt_rad: platewash_kinematics::trig::acos(least_cosine(&self.executed).clamp(-1.0, 1.0)),
        })
    }

    fn has_tool(&self) -> bool {
        self.plan.tool.length_m > 0.0
    }

    /// Without a tool body the sponge counts as touching wherever the flange passes, as in the paper's report.
    fn touch(&self, tip: &Tip) -> Touch {
        if self.has_tool() {
            self.contact.touch(self.contact.lift_m(&tip.pose, self.index))
        } else {
            Touch::On
        }
    }

    fn swept(&self, track: &[Tip], touches: &[Touch]) -> Result<Coverage, CoverageError> {
        let plate = self.plate;
        let cosine = if self.has_tool() { least_cosine(track) } else { 1.0 };
        let radius = self.plan.tool.sponge_radius_m * cosine;
        let strokes = if radius > 0.0 {
            strokes(track, touches)
        } else {
            Vec::new()
        };
        // With nothing to sweep, any radius sweeps nothing.
        let radius = if radius > 0.0 { radius } else { plate.radius_m };
        coverage_of_strokes(&strokes, [plate.x_m, plate.y_m], plate.radius_m, radius, &RASTER)
    }

    fn causes(&self, touches: &[Touch], executed: &Coverage) -> Vec<Cause> {
        let mut causes = Vec::new();
        if !self.has_tool() {
            causes.push(Cause::NoTool);
        }
        let height = |tip: &Tip| self.contact.lift_m(&tip.pose, self.index);
        if let Some((share, most_m, t_s)) = self.worst(touches, Touch::Lifted, height) {
            causes.push(Cause::Lifted { share, most_m, t_s });
        }
        if let Some((share, most_m, t_s)) = self.worst(touches, Touch::Pressed, |tip| -height(tip)) {
            causes.push(Cause::Pressed { share, most_m, t_s });
        }
        causes.extend(self.strayed());
        let required = self.plan.scenario.job.required_coverage;
        if !certificate::reaches(executed.lower, required) {
            let at_least = executed.lower;
            causes.push(Cause::Coverage { at_least, required });
        }
        causes
    }

    /// Share of the samples in some touch, the greatest `of` among them and when; `None` where there are none.
    fn worst(&self, touches: &[Touch], touch: Touch, of: impl Fn(&Tip) -> f64) -> Option<(f64, f64, f64)> {
        let such = || self.executed.iter().zip(touches).filter(|(_, found)| **found == touch);
        let (tip, _) = such().max_by(|a, b| of(a.0).total_cmp(&of(b.0)))?;
        Some((such().count() as f64 / self.executed.len() as f64, of(tip), tip.t_s))
    }

    fn strayed(&self) -> Option<Cause> {
        let off = |(planned, executed): (&Tip, &Tip)| {
            let off = (executed.pose.translation - planned.pose.translation).xy().norm();
            (off, executed.t_s)
        };
        let all: Vec<_> = self.planned.iter().zip(&self.executed).map(off).collect();
        let (most_m, t_s) = all.iter().copied().max_by(|a, b| a.0.total_cmp(&b.0))?;
        let mean = all.iter().map(|(off, _)| off * off).sum::<f64>() / all.len() as f64;
        (most_m > 0.1 * self.plan.tool.sponge_radius_m).then_some(Cause::Strayed {
            rms_m: mean.sqrt(),
            most_m,
            t_s,
        })
    }
}

/// Cosine of the largest tilt from the plate's normal, at most 1; 1 of none.
fn least_cosine(track: &[Tip]) -> f64 {
    let cosines = track.iter().map(|tip| -tip.pose.rotation.m33);
    cosines.fold(1.0, f64::min)
}

/// Runs of touching samples, seen from above and thinned.
fn strokes(track: &[Tip], touches: &[Touch]) -> Vec<Vec<[f64; 2]>> {
    let mut strokes: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut last = None;
    for (k, tip) in track.iter().enumerate() {
        if touches[k] != Touch::On {
            last = None;
            continue;
        }
        let here = [tip.pose.translation.x, tip.pose.translation.y];
        let ends = touches.get(k + 1) != Some(&Touch::On);
        match (last, strokes.last_mut()) {
            (Some(before), Some(stroke)) if ends || distance(before, here) >= SPACING_M => stroke.push(here),
            (Some(_), Some(_)) => continue,
            _ => strokes.push(vec![here]),
        }
        last = Some(here);
    }
    strokes
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    let (dx, dy) = (a[0] - b[0], a[1] - b[1]);
    (dx * dx + dy * dy).sqrt()
}
