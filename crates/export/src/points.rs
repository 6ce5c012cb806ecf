//! Choice of the points of a plan that a program names.
//!
//! Between two points a program moves evenly in the joints. Over a step h the tip then leaves the plan by about h²/8 · ‖J q̈‖ (the rest of
//! the tip's acceleration comes from the arm's own curvature, which both have), so that points are spread with the density
//! √(‖J q̈‖ / 8 tol). The resulting deviation is measured on the interpreted motion, corners and all, and points are packed more
//! closely where it is too large.

use crate::dialect::language::Points;
use crate::judgement::{TimedPoint, rounded_motions};
use crate::program::Point;
use crate::refusal::Refusal;
use crate::settings::ExportSettings;
use platewash_kinematics::{Axes, Frame, JointVector, RobotModel};
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::{KnotError, SegmentKind, Trajectory};

/// The longest step between two points \[s\].
const LONGEST_S: f64 = 0.1;

/// Parts of the tolerance that the choice of points leaves free: a share for the resolution of the proof, and a length for the
/// rounding of angles in a text \[m\].
const LEFT: (f64, f64) = (0.008, 1e-6);

/// Most points of a program that has them at even steps.
const MOST_STEPS: f64 = 300_000.0;

/// Rounds of packing.
const ROUNDS: usize = 24;

/// Grid of the times of a program \[s\]: every time is a multiple of it.
const GRID_S: f64 = 1e-6;

/// Moments at which the density is worked out, in each piece of the plan.
const MOMENTS: usize = 4;

/// Moments at which a step is compared with the plan.
const COMPARED: usize = 20;

/// A plan with the data by which points are chosen.
pub(crate) struct Source<'a> {
    pub plan: &'a Plan,
    pub motion: Trajectory,
    pub arm: &'a RobotModel,
    pub tip: Frame,
}

/// Largest deviation of the tip from the plan that the choice of points may show \[m\].
fn allowed_m(settings: &ExportSettings) -> f64 {
    let (part, rounding_m) = LEFT;
    settings.tolerance_m * (1.0 - part) - rounding_m
}

impl<'a> Source<'a> {
    /// # Errors
    /// [`KnotError`] for knots that are no motion.
    pub fn new(plan: &'a Plan, arm: &'a RobotModel) -> Result<Self, KnotError> {
        Ok(Self {
            plan,
            motion: plan.knots.motion()?,
            arm,
            tip: plan.job.workcell.tool.tip_frame(arm),
        })
    }

    /// The points that a dialect asks for.
    ///
    /// # Errors
    /// [`Refusal::TooClose`] where the tolerance asks for points that are too close.
    pub fn points(&self, points: Points, settings: &ExportSettings) -> Result<Vec<Point>, Refusal> {
        match points {
            Points::Knots => Ok(self.at_times(self.motion.times().iter().copied())),
            Points::Steps { step_s } => {
                let count = self.motion.duration_s() / (step_s * settings.speed_share);
                if count > MOST_STEPS {
                    return Err(Refusal::Setting {
                        name: "speed_share",
                        expected: format!(
                            "at least {:.2e}, for at most {MOST_STEPS} points {step_s} s apart",
                            settings.speed_share * count / MOST_STEPS
                        ),
                        found: settings.speed_share.to_string(),
                    });
                }
                Ok(self.at_times(self.steps(step_s * settings.speed_share)))
            }
            Points::Chords { least_s } => self.chords(least_s, settings),
        }
    }

    /// Multiples of a step up to the first that is not before the end \[s\].
    fn steps(&self, step_s: f64) -> impl Iterator<Item = f64> {
        // A remainder within rounding is no step.
        let count = (self.motion.duration_s() / step_s - 1e-6).ceil().max(1.0);
        (0..=count as usize).map(move |k| k as f64 * step_s)
    }

    fn at_times(&self, times_s: impl Iterator<Item = f64>) -> Vec<Point> {
        let rests = self.rest_times_s();
        times_s.filter_map(|t_s| self.point(t_s, &rests)).collect()
    }

    fn point(&self, t_s: f64, rests: &[f64]) -> Option<Point> {
        let state = self.motion.at(t_s)?;
        let segments = &self.plan.segments;
        let segment = segments.partition_point(|segment| segment.t_end_s < t_s);
        Some(Point {
            t_s,
            q_rad: state.q,
            qd_rad_s: state.qd,
            rests: rests.binary_search_by(|rest| rest.total_cmp(&t_s)).is_ok() || t_s >= self.motion.duration_s(),
            segment: segment.min(segments.len().saturating_sub(1)),
        })
    }

    /// Times at which the plan rests, in ascending order: at its ends, and where a wash begins and ends \[s\].
    fn rest_times_s(&self) -> Vec<f64> {
        let washes = self
            .plan
            .segments
            .iter()
            .filter(|segment| segment.kind == SegmentKind::Wash);
        let ends = washes.flat_map(|segment| [segment.t_start_s, segment.t_end_s]);
        let mut all: Vec<_> = [0.0, self.motion.duration_s()].into_iter().chain(ends).collect();
        all.sort_unstable_by(f64::total_cmp);
        all.dedup();
        all
    }

    fn chords(&self, least_s: f64, settings: &ExportSettings) -> Result<Vec<Point>, Refusal> {
        // Points keep their distance in the program's time.
        let least_s = least_s * settings.speed_share;
        let rests = self.rest_times_s();
        let allowed_m = allowed_m(settings);
        let mut density = Density::new(self, allowed_m);
        // Programs state times in whole microseconds, so points are chosen at these times of the plan. Where the plan rests it
        // does not move meanwhile.
        let grid_s = GRID_S * settings.speed_share;
        let rounded = |t_s: f64| match rests.contains(&t_s) {
            true => t_s,
            false => (t_s / grid_s).round() * grid_s,
        };
        let times = |density: &Density| density.times(&rests, least_s + grid_s).into_iter().map(rounded);
        let mut chosen = self.at_times(times(&density));
        let mut off_m = self.deviations_m(&chosen, settings.corner_m);
        for _ in 0..ROUNDS {
            if off_m.iter().all(|off| *off <= allowed_m) {
                return Ok(chosen);
            }
            density.pack(&chosen, &off_m, allowed_m);
            chosen = self.at_times(times(&density));
            off_m = self.deviations_m(&chosen, settings.corner_m);
        }
        let worst = off_m.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
        match worst.filter(|(_, off)| **off > settings.tolerance_m) {
            None => Ok(chosen),
            Some((step, &deviation_m)) => Err(Refusal::TooClose {
                t_s: chosen[step].t_s,
                deviation_m,
                tolerance_m: settings.tolerance_m,
                least_s: least_s / settings.speed_share,
            }),
        }
    }

    /// Deviation of the tip from the plan in each step, for corners of the given size \[m\].
    fn deviations_m(&self, points: &[Point], corner_m: f64) -> Vec<f64> {
        let passed = |point: &Point| TimedPoint {
            t_s: point.t_s,
            q_rad: point.q_rad,
            qd_rad_s: JointVector::zeros(),
            corner_m: if point.rests { 0.0 } else { corner_m },
        };
        let passed: Vec<_> = points.iter().map(passed).collect();
        let Ok(motions) = rounded_motions(&passed, self.arm, &self.tip) else {
            return vec![f64::INFINITY; points.len()];
        };
        let place = |q: &JointVector| self.arm.fk(q).rigid(&self.tip).translation;
        let step = |both: &[Point]| {
            let at = |i: usize| both[0].t_s + (both[1].t_s - both[0].t_s) * i as f64 / COMPARED as f64;
            let off = |t_s: f64| {
                let Some(planned) = self.motion.at(t_s).map(|state| place(&state.q)) else {
                    return f64::INFINITY;
                };
                let moved = motions.iter().filter_map(|m| m.motion.at(t_s));
                moved.map(|[q, _]| (place(&q) - planned).norm()).fold(0.0, f64::max)
            };
            (0..=COMPARED).map(at).map(off).fold(0.0, f64::max)
        };
        points.windows(2).map(step).collect()
    }
}

/// Required density of points over time.
struct Density {
    /// Moments, in ascending order \[s\].
    t_s: Vec<f64>,
    /// Points a second from each moment to the next.
    wanted: Vec<f64>,
}

impl Density {
    fn new(source: &Source<'_>, allowed_m: f64) -> Self {
        let times = source.motion.times();
        let mut t_s = Vec::with_capacity(times.len() * MOMENTS);
        for both in times.windows(2) {
            t_s.extend((0..MOMENTS).map(|i| both[0] + (both[1] - both[0]) * i as f64 / MOMENTS as f64));
        }
        t_s.extend(times.last());
        let density = |both: &[f64]| {
            let state = source.motion.at(0.5 * (both[0] + both[1]));
            let accelerates = state.map_or(0.0, |state| {
                let jacobian = source.arm.fk(&state.q).jacobian(&source.tip, Axes::Base);
                (jacobian.fixed_rows::<3>(0) * state.qdd).norm()
            });
            (accelerates / (8.0 * allowed_m)).sqrt().max(1.0 / LONGEST_S)
        };
        let wanted = t_s.windows(2).map(density).collect();
        Self { t_s, wanted }
    }

    /// Asks for more points in and beside steps that leave the plan too far.
    fn pack(&mut self, points: &[Point], off_m: &[f64], allowed_m: f64) {
        for (k, &off) in off_m.iter().enumerate().filter(|(_, off)| **off > allowed_m) {
            // A deviation grows with the square of the step.
            let factor = (off / allowed_m).sqrt().min(2.0) * 1.01;
            let [from, to] = [points[k].t_s, points[k + 1].t_s];
            let margin = 0.5 * (to - from);
            let first = self.t_s.partition_point(|t| *t < from - margin);
            let last = self.t_s.partition_point(|t| *t <= to + margin);
            let reached = self.wanted.len();
            self.wanted[first.saturating_sub(1).min(reached)..last.min(reached)]
                .iter_mut()
                .for_each(|wanted| *wanted *= factor);
        }
    }

    /// Times with that density, rests among them and none closer than `least_s` \[s\].
    fn times(&self, rests: &[f64], least_s: f64) -> Vec<f64> {
        let mut all = vec![0.0];
        for both in rests.windows(2) {
            self.spread([both[0], both[1]], least_s, &mut all);
        }
        all
    }

    /// Adds times after `from` and up to `to`.
    fn spread(&self, [from, to]: [f64; 2], least_s: f64, all: &mut Vec<f64>) {
        let sums = self.sums([from, to], least_s);
        let (_, sum) = sums[sums.len() - 1];
        let most = ((to - from) / least_s * (1.0 + 1e-9)).floor().max(1.0);
        let mut count = sum.ceil().clamp(1.0, most) as usize;
        let times = |count| -> Vec<f64> {
            let inner = quantiles(&sums, count);
            [from].into_iter().chain(inner).chain([to]).collect()
        };
        // A step more than the density gives makes all of them shorter.
        let mut chosen = times(count);
        while count > 1 && chosen.windows(2).any(|both| both[1] - both[0] < least_s) {
            count -= 1;
            chosen = times(count);
        }
        all.extend(&chosen[1..]);
    }

    /// Moments from `from` to `to` with the points wanted up to each of them.
    fn sums(&self, [from, to]: [f64; 2], least_s: f64) -> Vec<(f64, f64)> {
        let first = self.t_s.partition_point(|t| *t <= from).saturating_sub(1);
        let mut sums = vec![(from, 0.0)];
        let mut sum = 0.0;
        for k in first..self.wanted.len() {
            let [start, end] = [self.t_s[k].max(from), self.t_s[k + 1].min(to)];
            if end <= start {
                break;
            }
            sum += (end - start) * self.wanted[k].min(1.0 / least_s);
            sums.push((end, sum));
        }
        sums
    }
}

/// The moments that divide a growing sum evenly into `count` parts.
fn quantiles(sums: &[(f64, f64)], count: usize) -> Vec<f64> {
    let (_, whole) = sums[sums.len() - 1];
    let mut at = 1;
    let moment = |i: usize| {
        let target = whole * i as f64 / count as f64;
        while at + 1 < sums.len() && sums[at].1 < target {
            at += 1;
        }
        let ((t0, s0), (t1, s1)) = (sums[at - 1], sums[at]);
        t0 + (t1 - t0) * ((target - s0) / (s1 - s0)).clamp(0.0, 1.0)
    };
    (1..count).map(moment).collect()
}
