//! Washing of the plates: contact, coverage and verdict, plate by plate.
//!
//! The planned and the executed motion are measured alike: the tip seen along the plate's axis at every sample of the plate's wash; a
//! sponge tilted by τ counts as a disc of radius s cos τ, τ the largest tilt of that wash. The executed sponge sweeps only where it
//! touches ([`platewash_workcell::tool::Touch`]). Without a tool body the whole sponge counts wherever the flange passes, as in the report of the paper's
//! program. These are measurements, not bounds: between samples the tip is taken to move straight.
//!
//! Why a plate is not washed, or less of it than planned.

use crate::simulate::error::SimulationError;
use crate::simulate::execution::{Execution, Sample};
use crate::simulate::pressing::{Judge, Pressing};
use nalgebra::Vector3;
use platewash_bodies::coverage::{Coverage, CoverageError, coverage_of_strokes, reaches};
use platewash_kinematics::words::distinct_decimals;
use platewash_kinematics::{Frame, JointVector, RobotModel};
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::{PlanSegment, SegmentKind};
use platewash_workcell::job::Treatment;
use platewash_workcell::plate::Plate;
use platewash_workcell::simulation::SimulationSettings;
use platewash_workcell::tool::{Tool, Touch};
use rayon::prelude::*;
use serde::Serialize;

/// Cell size \[m\], as in the planner's own report: the proven error is about a tenth of a percent.
const CELL_M: f64 = 2e-4;

/// Points of a path nearer to the last one than this are left out \[m\]: on a circle of 10 mm the chord is off by 3 µm.
const SPACING_M: f64 = 5e-4;

/// Verdict on the washing of a plate by the executed motion, or on its sweeping where the job requires no contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PlateVerdict {
    /// Enough of it is surely swept, and the tool never had to be in the plate.
    Washed,
    /// Washed in this sense, where the job requires no contact.
    Swept,
    /// Swept in this sense, on a plate that a dry run has raised: nothing is there, and nothing is washed.
    SweptInAir,
    /// Not washed.
    NotWashed,
    /// Not swept.
    NotSwept,
}

impl PlateVerdict {
    fn new(treatment: Treatment, is_done: bool) -> Self {
        match (treatment, is_done) {
            (Treatment::Washed, true) => Self::Washed,
            (Treatment::Swept, true) => Self::Swept,
            (Treatment::SweptInAir, true) => Self::SweptInAir,
            (Treatment::Washed, false) => Self::NotWashed,
            (Treatment::Swept | Treatment::SweptInAir, false) => Self::NotSwept,
        }
    }

    /// Returns true where the plate got the treatment that the job requires.
    #[must_use]
    pub fn is_done(self) -> bool {
        matches!(self, Self::Washed | Self::Swept | Self::SweptInAir)
    }

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Washed => Treatment::Washed.participle(),
            Self::Swept => Treatment::Swept.participle(),
            Self::SweptInAir => Treatment::SweptInAir.participle(),
            Self::NotWashed => "not washed",
            Self::NotSwept => "not swept",
        }
    }
}

/// Result of a plate's wash.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlateOutcome {
    /// Index of the plate.
    pub plate: usize,
    /// Verdict on the plate.
    pub verdict: PlateVerdict,
    /// Causes that it is not washed, or swept less than planned.
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
    /// Pressing of the sponge; `None` where force is not simulated.
    pub pressing: Option<Pressing>,
}

/// Every plate that the plan washes, in the order of washing.
pub(crate) fn plates(
    plan: &Plan,
    robot: &RobotModel,
    settings: &SimulationSettings,
    execution: &Execution,
) -> Result<Vec<PlateOutcome>, SimulationError> {
    let tip = plan.job.workcell.tool.tip_frame(robot);
    let judge = Judge::new(plan, robot, settings, execution.period_s)?;
    let samples = &execution.samples;
    let segments = plan.segments.par_iter().enumerate();
    let washes = segments.filter(|(_, segment)| segment.kind == SegmentKind::Wash);
    let outcome = |(index, segment): (usize, &PlanSegment)| {
        let from = samples.partition_point(|s| s.segment < index);
        let to = samples.partition_point(|s| s.segment <= index);
        let plate = &plan.job.plates[segment.plate];
        let track = |of| track(robot, &tip, plate, &samples[from..to], of);
        let wash = Wash {
            tool: &plan.job.workcell.tool,
            treatment: plan.job.treatment(),
            required: plan.job.requirements.coverage,
            index: segment.plate,
            plate,
            planned: track(|s| s.commanded),
            executed: track(|s| s.state.q),
        };
        let mut outcome = wash.outcome()?;
        outcome.pressing = judge
            .as_ref()
            .and_then(|judge| judge.pressing(&samples[from..to], segment.plate, plate));
        Ok(outcome)
    };
    let outcomes: Vec<Result<_, SimulationError>> = washes.map(outcome).collect();
    outcomes.into_iter().collect()
}

/// The tip at a sample.
#[derive(Debug, Clone, Copy)]
struct Tip {
    t_s: f64,
    /// Place, world frame \[m\].
    at: Vector3<f64>,
    /// Height over the plate's face \[m\].
    height_m: f64,
    /// Cosine of the tool's tilt from the plate's normal.
    cosine: f64,
}

fn track(
    robot: &RobotModel,
    tip: &Frame,
    plate: &Plate,
    samples: &[Sample],
    of: fn(&Sample) -> JointVector,
) -> Vec<Tip> {
    let at = |sample: &Sample| {
        let pose = robot.fk(&of(sample)).rigid(tip);
        let at = pose.translation;
        Tip {
            t_s: sample.t_s,
            at,
            height_m: plate.height_of(&at),
            cosine: -pose.rotation.column(2).dot(&plate.normal_at(&at)),
        }
    };
    samples.iter().map(at).collect()
}

/// The wash of one plate.
struct Wash<'a> {
    tool: &'a Tool,
    treatment: Treatment,
    required: f64,
    index: usize,
    plate: &'a Plate,
    planned: Vec<Tip>,
    executed: Vec<Tip>,
}

impl Wash<'_> {
    fn outcome(&self) -> Result<PlateOutcome, CoverageError> {
        let touches: Vec<_> = self.executed.iter().map(|tip| self.tool.touch(tip.height_m)).collect();
        let everywhere = vec![Touch::On; self.planned.len()];
        let planned = self.swept(&self.planned, &everywhere)?;
        let executed = self.swept(&self.executed, &touches)?;
        let causes = self.causes(&touches, &executed);
        let fails = |cause: &Cause| matches!(cause, Cause::NoTool | Cause::Sunk { .. } | Cause::NotSwept { .. });
        Ok(PlateOutcome {
            plate: self.index,
            verdict: PlateVerdict::new(self.treatment, !causes.iter().any(fails)),
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
            pressing: None,
        })
    }

    fn has_tool(&self) -> bool {
        self.tool.is_present()
    }

    fn swept(&self, track: &[Tip], touches: &[Touch]) -> Result<Coverage, CoverageError> {
        let cosine = if self.has_tool() { least_cosine(track) } else { 1.0 };
        let radius = self.tool.sponge.radius_m * cosine;
        let strokes = if radius > 0.0 {
            strokes(self.plate, track, touches)
        } else {
            Vec::new()
        };
        // With nothing to sweep, any radius sweeps nothing.
        let rim_m = self.plate.rim_m();
        let radius = if radius > 0.0 { radius } else { rim_m };
        coverage_of_strokes(&strokes, [0.0; 2], rim_m, radius, CELL_M)
    }

    fn causes(&self, touches: &[Touch], executed: &Coverage) -> Vec<Cause> {
        let mut causes = Vec::new();
        if !self.has_tool() {
            causes.push(Cause::NoTool);
        }
        if let Some((share, most_m, t_s)) = self.greatest_in_touch(touches, Touch::Lifted, |tip| tip.height_m) {
            causes.push(Cause::Lifted { share, most_m, t_s });
        }
        if let Some((share, most_m, t_s)) = self.greatest_in_touch(touches, Touch::Pressed, |tip| -tip.height_m) {
            causes.push(Cause::Sunk { share, most_m, t_s });
        }
        causes.extend(self.stray_cause());
        let (at_least, required) = (executed.lower, self.required);
        if !reaches(at_least, required) {
            causes.push(Cause::NotSwept { at_least, required });
        }
        causes
    }

    /// Share of the samples in some touch, the greatest `of` among them and when; `None` where there are none.
    fn greatest_in_touch(&self, touches: &[Touch], touch: Touch, of: impl Fn(&Tip) -> f64) -> Option<(f64, f64, f64)> {
        let such = || self.executed.iter().zip(touches).filter(|(_, found)| **found == touch);
        let (tip, _) = such().max_by(|a, b| of(a.0).total_cmp(&of(b.0)))?;
        Some((such().count() as f64 / self.executed.len() as f64, of(tip), tip.t_s))
    }

    fn stray_cause(&self) -> Option<Cause> {
        let off = |(planned, executed): (&Tip, &Tip)| (sideways_m(self.plate, &planned.at, &executed.at), executed.t_s);
        let all: Vec<_> = self.planned.iter().zip(&self.executed).map(off).collect();
        let (most_m, t_s) = all.iter().copied().max_by(|a, b| a.0.total_cmp(&b.0))?;
        let mean = all.iter().map(|(off, _)| off * off).sum::<f64>() / all.len() as f64;
        (most_m > 0.1 * self.tool.sponge.radius_m).then_some(Cause::Strayed {
            rms_m: mean.sqrt(),
            most_m,
            t_s,
        })
    }
}

/// Cosine of the largest tilt from the plate's normal, at most 1; 1 of none.
fn least_cosine(track: &[Tip]) -> f64 {
    let cosines = track.iter().map(|tip| tip.cosine);
    cosines.fold(1.0, f64::min)
}

/// Runs of touching samples, seen along the plate's axis in its frame, and thinned.
fn strokes(plate: &Plate, track: &[Tip], touches: &[Touch]) -> Vec<Vec<[f64; 2]>> {
    let mut strokes: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut last = None;
    for (k, tip) in track.iter().enumerate() {
        if touches[k] != Touch::On {
            last = None;
            continue;
        }
        let local = plate.local(&tip.at);
        let here = [local.x, local.y];
        let ends = touches.get(k + 1) != Some(&Touch::On);
        match (last, strokes.last_mut()) {
            (Some(before), Some(stroke)) if ends || sideways_m(plate, &before, &tip.at) >= SPACING_M => {
                stroke.push(here)
            }
            (Some(_), Some(_)) => continue,
            _ => strokes.push(vec![here]),
        }
        last = Some(tip.at);
    }
    strokes
}

/// Distance of two points of the world, seen along the plate's axis \[m\].
fn sideways_m(plate: &Plate, from: &Vector3<f64>, to: &Vector3<f64>) -> f64 {
    plate.pose.inverse_transform_vector(&(to - from)).xy().norm()
}

/// Shares in percent, with as many decimals as tell them apart.
fn percents(found: f64, required: f64) -> [String; 2] {
    distinct_decimals(100.0 * found, 100.0 * required, 1)
}

/// Cause that less is swept than planned, or that a plate is not washed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, thiserror::Error)]
#[serde(tag = "cause", rename_all = "snake_case")]
#[non_exhaustive]
pub enum Cause {
    /// There is no tool body: the flange hovers.
    #[error("there is no tool body: the flange hovers")]
    NoTool,
    /// The tip lifts off: it is farther above the plate than the sponge is compressed.
    #[error(
        "contact is lost for {:.1} % of the wash: the tip lifts by up to {:.1} mm (at {t_s:.3} s)", 100.0 * .share, 1e3 * .most_m
    )]
    Lifted {
        /// Share of the wash's samples.
        share: f64,
        /// Height of the tip, at most \[m\].
        most_m: f64,
        /// Time of the sample \[s\].
        t_s: f64,
    },
    /// The arm sinks: the tip is deeper below the surface than the sponge is high, where in truth the plate would stop it.
    #[error(
        "the arm sinks for {:.1} % of the wash: the tip is up to {:.1} mm below the surface (at {t_s:.3} s), deeper than the sponge is high",
        100.0 * .share, 1e3 * .most_m
    )]
    Sunk {
        /// Share of the wash's samples.
        share: f64,
        /// Depth of the tip, at most \[m\].
        most_m: f64,
        /// Time of the sample \[s\].
        t_s: f64,
    },
    /// The tip strays sideways from its path by more than a tenth of the sponge's radius.
    #[error("the tip strays sideways by {:.1} mm rms, {:.1} mm at most (at {t_s:.3} s)", 1e3 * .rms_m, 1e3 * .most_m)]
    Strayed {
        /// Root mean square of the horizontal distance \[m\].
        rms_m: f64,
        /// Largest horizontal distance \[m\].
        most_m: f64,
        /// Time of the sample \[s\].
        t_s: f64,
    },
    /// Less is surely swept than is required.
    #[error("{0} % is surely swept, {1} % is required", percents(*.at_least, *.required)[0], percents(*.at_least, *.required)[1])]
    NotSwept {
        /// Share that is surely swept.
        at_least: f64,
        /// Share required.
        required: f64,
    },
}
