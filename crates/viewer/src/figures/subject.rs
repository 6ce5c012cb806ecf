//! What figures are drawn of: a plan with its arm, and what is known of them.

use super::error::{FARTHEST_M, FigureError};
use super::track::{Track, TrackPoint};
use nalgebra::Vector3;
use platewash_certificate::Certificate;
use platewash_kinematics::{Axes, Frame, JointVector, Pose, RobotModel};
use platewash_simulator::{Execution, SimulationReport};
use platewash_workcell::plan::{Plan, Process};
use platewash_workcell::segment::{PlanSegment, SegmentKind};
use platewash_workcell::trajectory::Trajectory;
use platewash_workcell::wash_path::{LEAST_RADIUS_M, LEAST_TURNS, LONGEST_M, MOST_TURNS, WashCurve};

/// Most moments of a motion that are looked at.
const MOST_MOMENTS: f64 = 20_000.0;

/// Time between two of them, where the motion is not too long for it \[s\].
const STEP_S: f64 = 0.01;

/// Farthest that a chord leaves a wash curve \[m\].
const CHORD_M: f64 = 1e-4;

/// What the tip is to follow on a plate.
#[derive(Debug, Clone, PartialEq)]
pub struct Ideal {
    /// Index of the plate.
    pub plate: usize,
    /// The curve, world frame \[m\].
    pub points: Vec<Vector3<f64>>,
}

/// A line of a sheet of claims: what is said, and what came of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Claim {
    /// What it is about.
    pub about: String,
    /// What is claimed, taken for granted or required.
    pub claimed: String,
    /// What was measured or proved.
    pub measured: String,
    /// Whether it holds.
    pub holds: bool,
}

/// A plan with its arm, and what is known of them. What is not known is not drawn.
#[derive(Debug, Clone)]
pub struct Subject<'a> {
    /// The plan.
    pub plan: &'a Plan,
    /// Its arm.
    pub arm: &'a RobotModel,
    /// What is proved of it.
    pub certificate: Option<&'a Certificate>,
    /// What an arm made of it, judged.
    pub executed: Option<(&'a Execution, &'a SimulationReport)>,
    /// Where plates' centres are drawn: a closed polygon seen from above, world frame \[m\].
    pub region_m: Option<Vec<[f64; 2]>>,
    /// Radius about the base's axis that plates' centres keep away from \[m\].
    pub base_circle_m: Option<f64>,
    /// What a run of the paper's program claims, and what came of it.
    pub claims: Vec<Claim>,
    pub(super) motion: Trajectory,
    pub(super) tip: Frame,
    pub(super) planned: Track,
    pub(super) followed: Option<Track>,
    pub(super) ideal: Vec<Ideal>,
}

impl<'a> Subject<'a> {
    /// A plan with its arm, and nothing else known. What the tip is to follow comes from the plan's wash paths.
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
        let tip = plan.job.workcell.tool.tip_frame(arm);
        let mut subject = Self {
            plan,
            arm,
            certificate: None,
            executed: None,
            region_m: None,
            base_circle_m: None,
            claims: Vec::new(),
            planned: Track::default(),
            followed: None,
            ideal: wash_curves(plan),
            motion,
            tip,
        };
        let moments = subject.moments();
        subject.planned = subject.track(moments)?;
        Ok(subject)
    }

    /// The same with what is proved.
    #[must_use]
    pub fn proved(mut self, certificate: &'a Certificate) -> Self {
        self.certificate = Some(certificate);
        self
    }

    /// The same with what an arm made of it.
    ///
    /// # Errors
    /// [`FigureError::Nowhere`].
    pub fn executed(mut self, execution: &'a Execution, report: &'a SimulationReport) -> Result<Self, FigureError> {
        let step = STEP_S.max(report.duration_s / MOST_MOMENTS);
        let stride = ((step / execution.period_s).round() as usize).max(1);
        let last = execution.samples.len().saturating_sub(1);
        let taken = execution
            .samples
            .iter()
            .enumerate()
            .filter(|(k, _)| k % stride == 0 || *k == last);
        let moments = taken
            .map(|(_, sample)| (sample.t_s, sample.segment, sample.state.q))
            .collect();
        self.followed = Some(self.track(moments)?);
        self.executed = Some((execution, report));
        Ok(self)
    }

    /// The same with what the tip is to follow on each plate.
    #[must_use]
    pub fn following(mut self, ideal: Vec<Ideal>) -> Self {
        self.ideal = ideal;
        self
    }

    /// Whether it is a run of the paper's program.
    #[must_use]
    pub fn is_paper(&self) -> bool {
        self.plan.process == Process::Paper
    }

    /// `T_world_base`.
    pub(super) fn mount(&self) -> &Pose {
        &self.plan.job.workcell.mount
    }

    /// Pose of the tip, world frame.
    pub(super) fn tip_pose(&self, q: &JointVector) -> Pose {
        self.mount() * self.arm.pose(q, &self.tip)
    }

    /// Speed of the tip \[m/s\].
    pub(super) fn tip_speed(&self, q: &JointVector, qd: &JointVector) -> f64 {
        let twist = self.arm.fk(q).jacobian(&self.tip, Axes::Base) * qd;
        twist.fixed_rows::<3>(0).norm()
    }

    /// The segments that wash, in time.
    pub(super) fn washes(&self) -> impl Iterator<Item = (usize, &PlanSegment)> {
        let all = self.plan.segments.iter().enumerate();
        all.filter(|(_, segment)| segment.kind == SegmentKind::Wash)
    }

    /// Times to look at the planned motion: the paper's program has waypoints and nothing between.
    fn moments(&self) -> Vec<(f64, usize, JointVector)> {
        let times: Vec<f64> = match self.plan.process {
            Process::Paper => self.motion.times().to_vec(),
            Process::Wash => {
                let duration = self.motion.duration_s();
                let count = (duration / STEP_S.max(duration / MOST_MOMENTS)).ceil();
                let even = (0..=count as usize).map(|k| duration * k as f64 / count);
                let ends = self
                    .plan
                    .segments
                    .iter()
                    .flat_map(|segment| [segment.t_start_s, segment.t_end_s]);
                let mut times: Vec<f64> = even.chain(ends).collect();
                times.sort_by(f64::total_cmp);
                times.dedup();
                times
            }
        };
        // A time belongs to the segment that ends at or after it.
        let segment = |t: f64| self.plan.segments.partition_point(|segment| segment.t_end_s < t);
        let at = |t: f64| self.motion.at(t).map(|state| (t, segment(t), state.q));
        times.into_iter().filter_map(at).collect()
    }

    fn track(&self, moments: Vec<(f64, usize, JointVector)>) -> Result<Track, FigureError> {
        let mut points = Vec::with_capacity(moments.len());
        for (t_s, segment, q) in moments {
            let pose = self.tip_pose(&q);
            let at = pose.translation.vector;
            if !at.iter().all(|c| c.abs() <= FARTHEST_M) {
                return Err(FigureError::Nowhere { t_s });
            }
            let axis = pose.rotation * Vector3::z();
            points.push(TrackPoint { t_s, segment, at, axis });
        }
        Ok(Track::new(points))
    }
}

fn wash_curves(plan: &Plan) -> Vec<Ideal> {
    let mut all = Vec::new();
    for path in &plan.wash_paths {
        if let Some(plate) = plan.job.plates.get(path.plate)
            && can_be_drawn(&path.curve)
        {
            let thetas = path.curve.parameters(&plate.surface, CHORD_M);
            all.push(Ideal {
                plate: path.plate,
                points: thetas.into_iter().map(|theta| path.contact(plate, theta)).collect(),
            });
        }
    }
    all
}

/// Whether a curve has a length that can be gone along.
fn can_be_drawn(curve: &WashCurve) -> bool {
    (LEAST_RADIUS_M..=LONGEST_M).contains(&curve.radius_m)
        && (LEAST_TURNS..=MOST_TURNS).contains(&curve.turns)
        && curve.start_angle_rad.abs() <= 1e3
}

fn check_segments(plan: &Plan, duration_s: f64) -> Result<(), FigureError> {
    let plates = plan.job.plates.len();
    let mut after = 0.0;
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
