//! From knots on the path to the motion, in rounds: find the speed, refine the knots, check, lower limits, again.
//!
//! The speed along the path: reachability analysis backwards and forwards over the knots.
//!
//! Time-optimal path parametrisation by Pham & Pham, *A new approach to time-optimal path parameterization based on
//! reachability analysis*, IEEE T-RO 2018. With x = ṡ² and constant s̈ between knots, a first pass from the end finds
//! the largest x at each knot from which the end can be reached within limits; as standing still always can, every
//! smaller x can too. A second pass from the start takes the largest x that stays below.
//!
//! Where further knots are needed: where a piece takes long, or leaves the path.

use crate::timing::check::{self, Demand};
use crate::timing::error::TimingError;
use crate::timing::grid::{Grid, PathKnot};
use crate::timing::hermite::Piece;
use crate::timing::interval::{Interval, LinearProgram};
use crate::timing::limits::{MotionLimits, SlowStretch};
use platewash_kinematics::{AXES, JointVector};
use platewash_motion::trajectory::Trajectory;

/// The shortest piece of a motion \[s\]: in less, the rounding of positions and times would show in accelerations.
pub const SHORTEST_PIECE_S: f64 = 1e-4;

/// Share of the limits that is kept back for rounding.
const MARGIN: f64 = 1e-6;
/// Excess of a limit that is left to stretching the whole motion in time.
const STRETCHED: f64 = 1e-4;
/// Stretch that is not worth it: the excess is within the margin.
const HELD: f64 = 2e-7;
/// Times that a motion is stretched at most; the first is enough but where times round coarsely.
const STRETCHES: usize = 8;
/// Rounds of lowering limits at most.
const LOWERINGS: usize = 6;
/// Rounds of refining knots at most.
const REFINEMENTS: usize = 10;

/// The state of the rounds.
#[derive(Debug)]
pub(crate) struct Rounds<'a> {
    grid: Grid<'a>,
    samples: usize,
    /// Limits that are aimed at: the given limits less the margin.
    limits: MotionLimits,
    /// Ranges in which the parameter moves slowly.
    slow_stretches: Vec<SlowStretch>,
    intervals: Vec<Interval>,
    /// Divisor of the speed limit of each interval.
    slowed: Vec<f64>,
    /// Bounds on x = ṡ² at the knots.
    most: Vec<f64>,
    passes: Passes,
    times: Vec<f64>,
    speeds: Vec<JointVector>,
    courses: Vec<Course>,
}

impl<'a> Rounds<'a> {
    /// State before the first round.
    pub fn new(grid: Grid<'a>, limits: &MotionLimits, slow_stretches: &[SlowStretch]) -> Self {
        let samples = grid.knots().len();
        let mut rounds = Self {
            grid,
            samples,
            limits: limits.times(1.0 - MARGIN),
            slow_stretches: slow_stretches.to_vec(),
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

    /// Runs all rounds.
    pub fn run(mut self) -> Result<TimedPath, TimingError> {
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
            let here = self
                .slow_stretches
                .iter()
                .filter(|s| s.u[0] <= knot.u && knot.u <= s.u[1]);
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
        let longest_s = longest_s(self.times[self.times.len() - 1]);
        let missing = missing(&self.courses, longest_s);
        let knots = self.grid.knots().len();
        if missing == 0 || !affordable(self.samples, knots + missing) {
            return false;
        }
        let courses = &self.courses;
        let parents = self.grid.refined(|k, shares| courses[k].shares(longest_s, shares));
        self.slowed = parents.iter().map(|&parent| self.slowed[parent]).collect();
        self.constrain(&parents);
        self.grid.knots().len() > knots
    }

    /// Demand of piece k on the limits.
    fn demand(&self, k: usize) -> Demand {
        let piece = piece(k, &self.times, self.grid.knots(), &self.speeds);
        check::demand(k, &piece, &self.grid, &self.limits)
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

    /// Stretches the whole motion in time until it keeps its limits, for the demand `worst`.
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
    fn finish(self) -> Result<TimedPath, TimingError> {
        let knots = self.grid.knots();
        let path_error_rad = close(&self.courses, |k| knots[k].u)?;
        let positions = knots.iter().map(|knot| knot.q).collect();
        Ok(TimedPath {
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

/// Share by which the backward pass stays inside its limits, so that rounding never closes the forward pass's way.
const INSIDE: f64 = 1e-10;

/// Room for the passes, kept from one round to the next.
#[derive(Debug)]
pub(crate) struct Passes {
    program: LinearProgram,
    /// Largest x from which the end is reached.
    controllable: Vec<f64>,
    /// Share of x₁ in x₀ that is allowed for the largest x₀, by interval.
    witness: Vec<f64>,
    /// ẋ² … the answer: x at every knot.
    x: Vec<f64>,
}

impl Passes {
    /// Empty.
    pub fn new() -> Self {
        Self {
            program: LinearProgram::new(),
            controllable: Vec::new(),
            witness: Vec::new(),
            x: Vec::new(),
        }
    }

    /// x at every knot. `most` bounds x at the knots, one more than there are intervals; it is positive and finite but
    /// at a knot where the motion rests, where it is 0.
    pub fn run(&mut self, intervals: &[Interval], most: &[f64]) -> &[f64] {
        let n = intervals.len();
        self.controllable.clear();
        self.controllable.extend_from_slice(most);
        self.witness.clear();
        self.witness.resize(n, 0.0);
        for (k, interval) in intervals.iter().enumerate().rev() {
            if most[k] > 0.0 {
                let [x0, x1] = self
                    .program
                    .furthest_back(interval, [most[k], self.controllable[k + 1]]);
                self.controllable[k] = x0 * (1.0 - INSIDE);
                self.witness[k] = x1 / x0;
            }
        }
        self.x.clear();
        self.x.push(self.controllable[0]);
        for (k, interval) in intervals.iter().enumerate() {
            let x0 = self.x[k];
            let furthest = interval.furthest(x0).max(self.witness[k] * x0);
            self.x.push(furthest.clamp(0.0, self.controllable[k + 1]));
        }
        &self.x
    }
}

/// The longest piece of a motion \[s\]; a fortieth of the duration of motions below 1 s, a thousandth of that of motions
/// above 25 s.
pub const LONGEST_PIECE_S: f64 = 0.025;

/// Largest deviation of a joint from its path between knots \[rad\].
pub const PATH_ERROR_RAD: f64 = 5e-6;

/// Length of the new pieces over the longest allowed: some room for the changes of the next round.
const ROOM: f64 = 0.8;
/// Pieces that one piece becomes at most, in one round.
const MOST_PARTS: f64 = 64.0;
/// Knots of a motion at most, for each sample of its path, and for any path.
const MOST_KNOTS: [usize; 2] = [16, 4096];

/// Course of a piece: x = ṡ² at its ends, length in s, duration and deviation from the path.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Course {
    /// x at both ends.
    pub x: [f64; 2],
    /// Duration \[s\].
    pub h: f64,
    /// Deviation from the path in its middle \[rad\].
    pub error_rad: f64,
}

impl Course {
    /// The share of the piece's length in s that is done after the share `t` of its duration, s̈ being constant.
    pub fn done(&self, t: f64) -> f64 {
        let [start, end] = self.x.map(f64::sqrt);
        (2.0 * start + (end - start) * t) * t / (start + end)
    }

    /// Measures a piece; `position` is the path's at a share of the piece's length.
    pub fn measured(x: [f64; 2], piece: &Piece, position: impl Fn(f64) -> platewash_kinematics::JointVector) -> Self {
        let mut course = Self {
            x,
            h: piece.h,
            error_rad: 0.0,
        };
        let [q, ..] = piece.at(0.5 * piece.h);
        course.error_rad = (q - position(course.done(0.5))).amax();
        course
    }

    /// Parts that this piece should become; 1 for none.
    fn parts(&self, longest_s: f64) -> usize {
        let slow = if self.h > longest_s {
            self.h / (ROOM * longest_s)
        } else {
            1.0
        };
        // The error of a piece falls with the fourth power of its length.
        let bent = if self.error_rad > PATH_ERROR_RAD {
            (self.error_rad / (0.5 * PATH_ERROR_RAD)).sqrt().sqrt().max(2.0)
        } else {
            1.0
        };
        slow.max(bent).min(MOST_PARTS).ceil() as usize
    }

    /// Places for further knots as shares of its length, equally far in time.
    pub fn shares(&self, longest_s: f64, shares: &mut Vec<f64>) {
        let parts = self.parts(longest_s);
        shares.extend((1..parts).map(|k| self.done(k as f64 / parts as f64)));
    }
}

/// The longest piece of a motion of this duration \[s\].
pub(crate) fn longest_s(duration_s: f64) -> f64 {
    LONGEST_PIECE_S.clamp(1e-3 * duration_s, duration_s / 40.0)
}

/// Knots that are missing.
pub(crate) fn missing(courses: &[Course], longest_s: f64) -> usize {
    courses.iter().map(|course| course.parts(longest_s) - 1).sum()
}

/// Checks that the number of knots is allowed for the number of samples.
pub(crate) fn affordable(samples: usize, knots: usize) -> bool {
    knots <= samples.saturating_mul(MOST_KNOTS[0]).saturating_add(MOST_KNOTS[1])
}

/// Refuses a motion that leaves its path too far; `u` is the path's parameter at a knot.
pub(crate) fn close(courses: &[Course], u: impl Fn(usize) -> f64) -> Result<f64, TimingError> {
    let mut worst = (0, 0.0);
    for (k, course) in courses.iter().enumerate() {
        if course.error_rad > worst.1 {
            worst = (k, course.error_rad);
        }
    }
    if worst.1 <= PATH_ERROR_RAD {
        return Ok(worst.1);
    }
    Err(TimingError::PathError {
        u: u(worst.0),
        error_rad: worst.1,
        allowed_rad: PATH_ERROR_RAD,
        knots: courses.len() + 1,
    })
}

/// A path in time.
#[derive(Debug, Clone, PartialEq)]
pub struct TimedPath {
    /// The motion, from time 0, at rest at both ends. Its knots are the path's samples and more between them.
    pub motion: Trajectory,
    /// The path's parameter at every knot; those of the samples are among them to the bit.
    pub parameters: Vec<f64>,
    /// Largest distance of a joint from the path \[rad\]: measured in the middle of every piece, where the leading term
    /// of the error of Hermite interpolation, `t² (h − t)²`, is largest.
    pub path_error_rad: f64,
}
