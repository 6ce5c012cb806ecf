//! Data of figures: a plan with its arm, and the further data on them; words that figures share.

use super::error::{FARTHEST_M, FigureError};
use super::page::FigureTexts;
use crate::view::PressedRule;
use crate::view::coverage::swept;
use crate::view::tips::{Tip, Tips};
use nalgebra::Vector3;
use platewash_certificate::Certificate;
use platewash_kinematics::words::percent;
use platewash_kinematics::{Axes, JointVector, Pose, RobotModel};
use platewash_motion::plan::{Plan, Process};
use platewash_motion::trajectory::{PlanSegment, SegmentKind, Trajectory};
use platewash_simulator::{Execution, SimulationReport};
use platewash_workcell::layout::TaskRegion;
use platewash_workcell::plate::Plate;
use platewash_workcell::words::quoted;

/// Greatest number of samples of an execution that are read, and the time between two of them where there are fewer \[s\].
const MOST_SAMPLES: f64 = 20_000.0;
const STEP_S: f64 = 0.01;

/// Farthest that a chord leaves a wash curve \[m\].
const CHORD_M: f64 = 1e-4;

/// Letters of a hash that are shown.
const HASH: usize = 12;

/// Path that the tip is to follow on a plate.
#[derive(Debug, Clone, PartialEq)]
pub struct IdealPath {
    /// Index of the plate.
    pub plate: usize,
    /// The curve, world frame \[m\].
    pub points: Vec<Vector3<f64>>,
}

/// The way of the tip, segment by segment.
pub(super) type Track = Vec<Vec<Tip>>;

/// A plan with its arm, and the further data on them. Data that are not there are not drawn.
#[derive(Debug, Clone)]
pub struct FigureData<'a> {
    /// The plan.
    pub plan: &'a Plan,
    /// Its arm.
    pub arm: &'a RobotModel,
    /// Certificate of the plan.
    pub certificate: Option<&'a Certificate>,
    /// Region in which plates were drawn at random.
    pub region: TaskRegion,
    /// Path that the tip is to follow on each plate: by default the plan's wash paths.
    pub ideal: Vec<IdealPath>,
    /// Report on the executed motion.
    pub(super) report: Option<&'a SimulationReport>,
    pub(super) motion: Trajectory,
    pub(super) planned: Track,
    pub(super) followed: Option<Track>,
}

impl<'a> FigureData<'a> {
    /// A plan with its arm, and nothing else known.
    ///
    /// # Errors
    /// [`FigureError`] for knots, segments or plates that cannot be drawn.
    pub fn new(plan: &'a Plan, arm: &'a RobotModel) -> Result<Self, FigureError> {
        let motion = plan.knots.motion()?;
        if motion.times().len() < 2 {
            let knots = motion.times().len();
            return Err(FigureError::NoMotion { knots });
        }
        if let Some(plate) = plan.job.plates.iter().position(|plate| !plate.is_sound()) {
            return Err(FigureError::NoPlate { plate });
        }
        check_segments(plan, motion.duration_s())?;
        let tips = Tips::new(plan, arm, &motion);
        let planned = plan.segments.iter().map(|segment| {
            let [start, end] = [segment.t_start_s, segment.t_end_s];
            match plan.process {
                Process::Wash => tips.during(start, end),
                // The paper's program has waypoints and nothing between.
                Process::Paper => {
                    let inside = motion.times().iter().filter(|t| (start..=end).contains(*t));
                    inside.filter_map(|t| tips.at(*t)).collect()
                }
            }
        });
        let planned = checked(planned.collect())?;
        Ok(Self {
            plan,
            arm,
            certificate: None,
            region: TaskRegion::default(),
            ideal: wash_curves(plan),
            report: None,
            motion,
            planned,
            followed: None,
        })
    }

    /// The same data with the executed motion of an arm.
    ///
    /// # Errors
    /// [`FigureError::Nowhere`].
    pub fn executed(mut self, execution: &Execution, report: &'a SimulationReport) -> Result<Self, FigureError> {
        let step = STEP_S.max(report.duration_s / MOST_SAMPLES);
        let stride = ((step / execution.period_s).round() as usize).max(1);
        let tips = Tips::new(self.plan, self.arm, &self.motion);
        let mut track: Track = vec![Vec::new(); self.plan.segments.len()];
        for sample in execution.samples.iter().step_by(stride).chain(execution.samples.last()) {
            if let Some(way) = track.get_mut(sample.segment) {
                way.push(tips.tip(&sample.state.q, sample.t_s));
            }
        }
        self.followed = Some(checked(track)?);
        self.report = Some(report);
        Ok(self)
    }

    /// Returns true where it is a run of the paper's program.
    pub(super) fn is_paper(&self) -> bool {
        self.plan.process == Process::Paper
    }

    /// `T_world_base`.
    pub(super) fn mount(&self) -> &Pose {
        &self.plan.job.workcell.mount
    }

    /// Speed of the tip \[m/s\].
    pub(super) fn tip_speed(&self, q: &JointVector, qd: &JointVector) -> f64 {
        let tip = self.plan.job.workcell.tool.tip_frame(self.arm);
        let twist = self.arm.fk(q).jacobian(&tip, Axes::Base) * qd;
        twist.fixed_rows::<3>(0).norm()
    }

    /// The segments that wash, in time.
    pub(super) fn washes(&self) -> impl Iterator<Item = (usize, &PlanSegment)> {
        let all = self.plan.segments.iter().enumerate();
        all.filter(|(_, segment)| segment.kind == SegmentKind::Wash)
    }

    /// Rule of contact on each washed plate.
    pub(super) fn counted(&self) -> Vec<Option<PressedRule>> {
        let job = &self.plan.job;
        let washed = self.washes().filter_map(|(_, wash)| job.plates.get(wash.plate));
        washed.map(|plate| PressedRule::on(plate, job)).collect()
    }

    /// Time for which each cell of a raster of a plate counts, along a way of the tip \[s\]; `None` outside the rim.
    pub(super) fn dwell_s(&self, plate: &Plate, way: &[Tip], cells: usize) -> Vec<Option<f64>> {
        let counted = PressedRule::on(plate, &self.plan.job);
        let ways = std::iter::once(way.to_vec());
        swept(plate, &self.plan.job.workcell.tool, counted.as_ref(), ways, cells).dwell_s()
    }

    /// Checks for a segment of a kind.
    pub(super) fn has(&self, kind: SegmentKind) -> bool {
        self.plan.segments.iter().any(|segment| segment.kind == kind)
    }

    /// The words around a figure.
    pub(super) fn texts(&self, title: &str, caption: String) -> FigureTexts {
        let hash = self.plan.hash.as_deref().unwrap_or("without a hash");
        let hash: String = hash.chars().take(HASH).collect();
        FigureTexts {
            title: format!("{title}: {}", quoted(&self.plan.provenance.scenario)),
            subtitle: self.about(),
            caption,
            source: format!("plan {hash} · platewash {}", env!("CARGO_PKG_VERSION")),
        }
    }

    /// Describes the plan: number of plates, duration, verdict.
    fn about(&self) -> String {
        let job = &self.plan.job;
        let plates = match job.plates_to_wash().count() {
            0 => String::new(),
            1 => "1 plate, ".to_owned(),
            count => format!("{count} plates, "),
        };
        format!(
            "{}{plates}seed {}, {:.2} s; {}",
            job.notices(),
            job.seed,
            self.motion.duration_s(),
            self.proof()
        )
    }

    fn proof(&self) -> String {
        let Some(certificate) = self.certificate.filter(|_| !self.is_paper()) else {
            let known = if self.is_paper() {
                "the paper's program, followed to the letter"
            } else {
                "planned, not proved"
            };
            return known.to_owned();
        };
        let waived: Vec<_> = certificate.waived.iter().map(|waived| waived.words()).collect();
        let broken: Vec<_> = certificate.broken().map(|check| check.requirement.words()).collect();
        match (certificate.passes(), waived.is_empty(), broken.is_empty()) {
            (true, true, _) => "proved for every moment".to_owned(),
            (true, false, _) => format!("proved, but for {}, which the job waives", waived.join(", ")),
            (false, _, true) => "NOT PROVED: the plan was changed after it was written".to_owned(),
            (false, _, false) => format!("NOT PROVED: {}", broken.join(", ")),
        }
    }
}

/// Beginning of a caption, where a figure shows the first of several plates.
pub(super) fn first_of(shown: usize, plates: usize) -> String {
    match plates > shown {
        true => format!("The first {shown} of {plates} plates. "),
        false => String::new(),
    }
}

/// A share as per cent, rounded down, so that none looks greater than it is.
pub(super) fn per_cent(share: f64) -> String {
    format!("{} %", percent(share))
}

/// A number to three decimals, as short as it goes.
pub(super) fn short(value: f64) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Ways whose places are all finite and near.
fn checked(track: Track) -> Result<Track, FigureError> {
    let is_lost = |tip: &&Tip| !tip.at.iter().all(|c| c.abs() <= FARTHEST_M);
    match track.iter().flatten().find(is_lost) {
        Some(tip) => Err(FigureError::Nowhere { t_s: tip.t_s }),
        None => Ok(track),
    }
}

fn wash_curves(plan: &Plan) -> Vec<IdealPath> {
    let curves = plan.wash_paths.iter().filter(|path| path.curve.is_sound());
    let ideal = curves.filter_map(|path| {
        let plate = plan.job.plates.get(path.plate)?;
        let thetas = path.curve.parameters(&plate.surface, CHORD_M);
        let points = thetas.into_iter().map(|theta| path.contact(plate, theta)).collect();
        let plate = path.plate;
        Some(IdealPath { plate, points })
    });
    ideal.collect()
}

fn check_segments(plan: &Plan, duration_s: f64) -> Result<(), FigureError> {
    let (plates, mut after) = (plan.job.plates.len(), 0.0);
    for (k, segment) in plan.segments.iter().enumerate() {
        let [start, end] = [segment.t_start_s, segment.t_end_s];
        let in_time = start >= after - 1e-9 && end >= start && end <= duration_s + 1e-6;
        if !in_time || segment.plate >= plates {
            return Err(FigureError::Segment {
                segment: k,
                plate: segment.plate,
                plates,
                t_start_s: start,
                t_end_s: end,
            });
        }
        after = end;
    }
    Ok(())
}
