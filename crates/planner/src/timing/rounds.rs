//! From knots on the path to the motion, in rounds: find the speed, refine the knots, check, lower limits, again.

use super::check::{self, Demand};
use super::error::TimingError;
use super::grid::{Grid, PathKnot};
use super::hermite::Piece;
use super::interval::Interval;
use super::limits::{MotionLimits, Slow};
use super::passes::Passes;
use super::refine::{self, Course};
use super::timed::Timed;
use platewash_kinematics::{AXES, JointVector};
use platewash_workcell::trajectory::Trajectory;

/// The shortest piece of a motion \[s\]: in less, the rounding of positions and times would show in accelerations.
pub const SHORTEST_PIECE_S: f64 = 1e-4;

/// Share of the limits that is kept back for rounding.
const MARGIN: f64 = 1e-6;
/// Excess of a limit that is left to stretching the whole motion in time.
const STRETCHED: f64 = 1e-4;
/// Stretch that is not worth it: what it mends is within the margin.
const HELD: f64 = 2e-7;
/// Times that a motion is stretched at most; the first is enough but where times round coarsely.
const STRETCHES: usize = 8;
/// Rounds of lowering limits at most.
const LOWERINGS: usize = 6;
/// Rounds of refining knots at most.
const REFINEMENTS: usize = 10;

/// The state of the rounds.
#[derive(Debug)]
pub(super) struct Rounds<'a> {
    grid: Grid<'a>,
    samples: usize,
    /// What is aimed at: the limits less the margin.
    limits: MotionLimits,
    /// Where the parameter moves slowly.
    slow: Vec<Slow>,
    intervals: Vec<Interval>,
    /// By what each interval's speed is lowered.
    slowed: Vec<f64>,
    /// Bounds on x = ṡ² at the knots.
    most: Vec<f64>,
    passes: Passes,
    times: Vec<f64>,
    speeds: Vec<JointVector>,
    courses: Vec<Course>,
}

impl<'a> Rounds<'a> {
    /// Before the first round.
    pub fn new(grid: Grid<'a>, limits: &MotionLimits, slow: &[Slow]) -> Self {
        let samples = grid.knots().len();
        let mut rounds = Self {
            grid,
            samples,
            limits: limits.times(1.0 - MARGIN),
            slow: slow.to_vec(),
            intervals: Vec::new(),
            slowed: vec![1.0; samples - 1],
            most: Vec::new(),
            passes: Passes::new(),
            times: Vec::new(),
            speeds: Vec::new(),
            courses: Vec::new(),
        };
        if samples == 2 {
            // A single interval from rest to rest would never end.
            rounds.slowed = vec![1.0; rounds.grid.refined(|_, shares| shares.extend([0.25, 0.5, 0.75])).len()];
        }
        rounds.constrain(&[]);
        rounds
    }

    /// All rounds.
    pub fn run(mut self) -> Result<Timed, TimingError> {
        self.pass()?;
        for _ in 0..REFINEMENTS {
            if !self.refine() {
                break;
            }
            self.pass()?;
        }
        let mut worst = self.lower();
        for _ in 0..LOWERINGS {
            if worst.stretch() <= 1.0 + STRETCHED {
                break;
            }
            self.pass()?;
            if self.refine() {
                self.pass()?;
            }
            worst = self.lower();
        }
        self.stretch(worst)?;
        self.finish()
    }

    /// Intervals and bounds of the grid's knots; tightened as the intervals that they are parts of.
    fn constrain(&mut self, parents: &[usize]) {
        let knots = self.grid.knots();
        let old = std::mem::take(&mut self.intervals);
        self.intervals.reserve(knots.len());
        for (k, ends) in knots.windows(2).enumerate() {
            let mut interval = Interval::between(&ends[0], &ends[1], self.grid.width(k), &self.limits);
            if let Some(parent) = parents.get(k).and_then(|&parent| old.get(parent)) {
                interval.tighten_like(parent);
            }
            self.intervals.push(interval);
        }
    }

    /// Bounds on x at the knots: speeds of joints and tip, the shortest piece, rest at the ends.
    fn bound(&mut self) {
        let (knots, last) = (self.grid.knots(), self.grid.knots().len() - 1);
        self.most.clear();
        for (k, knot) in knots.iter().enumerate() {
            let around = k.saturating_sub(1)..(k + 1).min(last);
            let slowed = self.slowed[around.clone()].iter().fold(1.0, |a: f64, &b| a.max(b));
            let width = self.intervals[around].iter().fold(f64::INFINITY, |a, i| a.min(i.width));
            let here = self.slow.iter().filter(|s| s.u[0] <= knot.u && knot.u <= s.u[1]);
            let slow = here.fold(f64::INFINITY, |most, s| most.min(s.most / self.grid.span()));
            let fastest = (fastest(knot, &self.limits) / slowed)
                .min(width / SHORTEST_PIECE_S)
                .min(slow);
            let rests = (k == 0 || k == last) && knot.slope.amax() > 0.0;
            self.most.push(if rests { 0.0 } else { fastest * fastest });
        }
    }

    /// Both passes, and the motion that follows from them.
    fn pass(&mut self) -> Result<(), TimingError> {
        self.bound();
        let x = self.passes.run(&self.intervals, &self.most);
        let knots = self.grid.knots();
        self.times.clear();
        self.times.push(0.0);
        self.speeds.clear();
        self.speeds
            .extend(knots.iter().zip(x).map(|(knot, x)| knot.slope * x.sqrt()));
        self.courses.clear();
        let mut time = 0.0;
        for (k, interval) in self.intervals.iter().enumerate() {
            let before = time;
            time += 2.0 * interval.width / (x[k].sqrt() + x[k + 1].sqrt());
            if !(time.is_finite() && time > before) {
                return Err(TimingError::Range { u: knots[k].u });
            }
            self.times.push(time);
            let piece = piece(k, &self.times, knots, &self.speeds);
            let course = Course::measured([x[k], x[k + 1]], &piece, |share| self.grid.position_within(k, share));
            self.courses.push(course);
        }
        Ok(())
    }

    /// Adds knots where they are needed and can be afforded; whether any was.
    fn refine(&mut self) -> bool {
        let longest_s = refine::longest_s(self.times[self.times.len() - 1]);
        let missing = refine::missing(&self.courses, longest_s);
        let knots = self.grid.knots().len();
        if missing == 0 || !refine::affordable(self.samples, knots + missing) {
            return false;
        }
        let courses = &self.courses;
        let parents = self.grid.refined(|k, shares| courses[k].shares(longest_s, shares));
        self.slowed = parents.iter().map(|&parent| self.slowed[parent]).collect();
        self.constrain(&parents);
        self.grid.knots().len() > knots
    }

    /// What piece k demands of the limits.
    fn demand(&self, k: usize) -> Demand {
        let piece = piece(k, &self.times, self.grid.knots(), &self.speeds);
        check::demand(&piece, &self.grid, &self.limits)
    }

    /// Lowers limits where the motion exceeds them; gives the largest demands.
    fn lower(&mut self) -> Demand {
        let mut worst = Demand::default();
        for k in 0..self.intervals.len() {
            let demand = self.demand(k);
            worst = worst.or(&demand);
            if demand.speed > 1.0 {
                self.slowed[k] *= demand.speed;
            }
            if demand.joints > 1.0 {
                self.intervals[k].tighten_joints(demand.joints);
            }
            if demand.tip > 1.0 {
                self.intervals[k].tighten_tip(demand.tip);
            }
        }
        worst
    }

    /// Stretches the whole motion in time until it keeps its limits, `worst` being what it demands.
    fn stretch(&mut self, mut worst: Demand) -> Result<(), TimingError> {
        for _ in 0..STRETCHES {
            let by = worst.stretch();
            if by <= 1.0 + HELD {
                return Ok(());
            }
            self.times.iter_mut().for_each(|t| *t *= by);
            self.speeds.iter_mut().for_each(|qd| *qd /= by);
            worst = (0..self.intervals.len()).fold(Demand::default(), |worst, k| worst.or(&self.demand(k)));
        }
        Err(TimingError::Unheld {
            excess: worst.stretch() - 1.0,
            duration_s: self.times[self.times.len() - 1],
        })
    }

    /// The motion.
    fn finish(self) -> Result<Timed, TimingError> {
        let knots = self.grid.knots();
        let path_error_rad = refine::close(&self.courses, |k| knots[k].u)?;
        let positions = knots.iter().map(|knot| knot.q).collect();
        Ok(Timed {
            parameters: knots.iter().map(|knot| knot.u).collect(),
            motion: Trajectory::from_knots(self.times, positions, self.speeds)?,
            path_error_rad,
        })
    }
}

/// Piece k of the motion.
fn piece(k: usize, times: &[f64], knots: &[PathKnot], speeds: &[JointVector]) -> Piece {
    let h = times[k + 1] - times[k];
    Piece::new(h, [&knots[k].q, &knots[k + 1].q], [speeds[k], speeds[k + 1]])
}

/// The largest ṡ at a knot that the speeds of joints and tip allow; infinite where nothing moves.
fn fastest(knot: &PathKnot, limits: &MotionLimits) -> f64 {
    let joints = (0..AXES).map(|joint| limits.velocity[joint] / knot.slope[joint].abs());
    let fastest = joints.fold(f64::INFINITY, f64::min);
    match (&limits.tip, &knot.tip) {
        (Some(limits), Some(tip)) => fastest.min(limits.speed_m_s / tip.velocity(&knot.slope).norm()),
        _ => fastest,
    }
}
