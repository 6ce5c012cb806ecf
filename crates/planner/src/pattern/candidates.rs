//! Candidate curves.
//!
//! Estimates for a curve: its time at the limits of washing and of the arm, and its effect on the bare face.

use crate::pattern::promise::{Promise, SampledWash};
use crate::placed_arm::{AxisRule, TiltPolicy};
use crate::timing::TipLimits;
use nalgebra::Vector3;
use platewash_bodies::contact::{Moment, SpongePose};
use platewash_kinematics::trig::sin_cos;
use platewash_workcell::surface::Surface;
use platewash_workcell::wash_path::{CandidateRequest, Density, PatternName, SurfacePoint, WashCurve};

/// Lists all curves of a density that a job leaves open, of the pattern that it states if it does, with the greatest trim; at least one of the usual density.
pub(crate) fn candidates(pattern: Option<PatternName>, request: &CandidateRequest<'_>) -> Vec<WashCurve> {
    if request.stated.turns.is_some() && request.density == Density::Dense {
        return Vec::new();
    }
    let asked = PatternName::asked(pattern, &request.stated);
    let suits = |pattern: &PatternName| match request.laps {
        0 | 1 => asked.is_none_or(|asked| asked == *pattern),
        _ => pattern.rules().repeats,
    };
    let patterns = PatternName::ALL.into_iter().filter(suits);
    patterns.flat_map(|pattern| pattern.candidates(request)).collect()
}

/// Stride between moments \[m\], and the longest between their angles \[rad\].
const STRIDE_M: f64 = 3e-3;
const STRIDE_RAD: f64 = 0.15;

/// A curve that may be chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Candidate {
    pub curve: WashCurve,
    /// Lower bound of its estimated time, but for rare curves \[s\]; only the order of candidates depends on it.
    bound_s: f64,
}

/// Step of θ between the points from which the time of a curve is bounded \[rad\].
const COARSE_RAD: f64 = 0.4;

/// Share of the time along a coarse polyline that is a lower bound.
const COARSE_SHARE: f64 = 0.99;

impl Candidate {
    /// A curve on a surface, washed as fast as the limits allow.
    pub fn new(curve: WashCurve, surface: &Surface, limits: &TipLimits) -> Self {
        let speed_m_s = limits.speed_m_s;
        let steps = (curve.end() / COARSE_RAD).ceil();
        let points = (0..=steps as u32).map(|k| curve.on(surface, curve.end() * f64::from(k) / steps).position);
        let points: Vec<_> = points.collect();
        let length_m: f64 = points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        let bound_s = COARSE_SHARE * length_m / speed_m_s + speed_m_s / limits.acceleration_m_s2;
        Self { curve, bound_s }
    }
}

/// Candidates with their times, the quickest first. The time of one is computed once its bound is the least that is left.
#[derive(Debug)]
pub(crate) struct ByTime<'a> {
    surface: &'a Surface,
    limits: &'a TipLimits,
    left: Vec<Waiting>,
}

/// A candidate that is still to come.
#[derive(Debug)]
enum Waiting {
    Bounded(Candidate),
    Timed(Estimate),
}

impl Waiting {
    /// Bound or time \[s\].
    fn least_s(&self) -> f64 {
        match self {
            Self::Bounded(candidate) => candidate.bound_s,
            Self::Timed(estimate) => estimate.time_s,
        }
    }
}

impl<'a> ByTime<'a> {
    /// Candidates on a surface, with the limits of washing.
    pub fn new(candidates: &[Candidate], surface: &'a Surface, limits: &'a TipLimits) -> Self {
        let left = candidates.iter().copied().map(Waiting::Bounded).collect();
        Self { surface, limits, left }
    }
}

impl Iterator for ByTime<'_> {
    type Item = Estimate;

    fn next(&mut self) -> Option<Estimate> {
        loop {
            let waiting = self.left.iter().enumerate();
            let (least, _) = waiting.min_by(|(_, a), (_, b)| a.least_s().total_cmp(&b.least_s()))?;
            match &self.left[least] {
                Waiting::Bounded(candidate) => {
                    self.left[least] = Waiting::Timed(Estimate::new(candidate.curve, self.surface, self.limits));
                }
                Waiting::Timed(_) => {
                    if let Waiting::Timed(estimate) = self.left.remove(least) {
                        return Some(estimate);
                    }
                }
            }
        }
    }
}

/// A curve and its time.
#[derive(Debug, Clone)]
pub(crate) struct Estimate {
    pub curve: WashCurve,
    /// Points along it with their angles.
    points: Vec<(f64, SurfacePoint)>,
    /// Estimated time from rest to rest, with the acceleration that the limits state in every direction \[s\].
    pub time_s: f64,
    /// Length of the curve \[m\].
    pub length_m: f64,
    speed_m_s: f64,
}

impl Estimate {
    /// A curve on a surface, washed as fast as the limits allow.
    pub fn new(curve: WashCurve, surface: &Surface, limits: &TipLimits) -> Self {
        let (most_m_s2, speed_m_s) = (limits.acceleration_m_s2, limits.speed_m_s);
        let (mut moving_s, mut length_m) = (0.0, 0.0);
        let points = points(&curve, surface);
        for pair in points.windows(2) {
            let [from, to] = [&pair[0].1, &pair[1].1];
            let along_m = (to.position - from.position).norm();
            let turned = (to.first.normalize() - from.first.normalize()).norm();
            // The curvature of the piece bounds the speed: v² κ ≤ a.
            let slow_m_s = (most_m_s2 * along_m / turned.max(1e-9)).sqrt();
            moving_s += along_m / speed_m_s.min(slow_m_s);
            length_m += along_m;
        }
        Self {
            curve,
            points,
            // At both ends it takes v/a to reach the mean speed, on half the way.
            time_s: moving_s + length_m / moving_s / most_m_s2,
            length_m,
            speed_m_s,
        }
    }

    /// Samples of the sponge on the bare face along the curve, with the tool set by its rule.
    pub fn sampled(&self, promise: &Promise, surface: &Surface, rule: &AxisRule, cone_rad: f64) -> SampledWash {
        let swept = promise.swept_within(surface, cone_rad);
        let (promise, cone_rad) = swept.as_ref().map_or((promise, cone_rad), |swept| (swept, 0.0));
        SampledWash::new(*promise, *surface, self.moments(surface, rule, cone_rad))
    }

    /// The sponge along the curve at the speed of washing, the tool by its rule and leaning as is usual within a cone.
    fn moments(&self, surface: &Surface, rule: &AxisRule, cone_rad: f64) -> Vec<Moment> {
        // On flat faces the arm tilts the tool as this policy does; it is taken to be in the direction of -x.
        let policy = TiltPolicy::sloping(cone_rad, 0.0, self.curve.radius_m);
        let mut moments: Vec<Moment> = Vec::new();
        let mut t_s = 0.0;
        for (theta, here) in &self.points {
            if let Some(last) = moments.last() {
                t_s += (here.position - last.pose.tip).norm() / self.speed_m_s;
            }
            let [arc_m, ..] = self.curve.arc(*theta);
            let [c, s] = rule.direction(arc_m);
            let leans_rad = if surface.is_flat() {
                policy.tilt(here.position.x)
            } else {
                0.0
            };
            let (lean_s, lean_c) = sin_cos(leans_rad);
            let out = here.position.xy().try_normalize(0.0).unwrap_or_default();
            moments.push(Moment {
                t_s,
                pose: SpongePose {
                    tip: here.position,
                    axis: Vector3::new(s * out.x - lean_s, s * out.y, -c * lean_c),
                },
                speed: here.first.normalize() * self.speed_m_s,
                turning: Vector3::zeros(),
            });
        }
        moments
    }
}

/// Points of a curve with their angles, neighbours about a stride apart.
fn points(curve: &WashCurve, surface: &Surface) -> Vec<(f64, SurfacePoint)> {
    let (mut all, mut theta) = (Vec::new(), 0.0);
    while theta < curve.end() {
        let here = curve.on(surface, theta);
        all.push((theta, here));
        theta += (STRIDE_M / here.first.norm()).min(STRIDE_RAD);
    }
    all.push((curve.end(), curve.on(surface, curve.end())));
    all
}

/// Lower bound of the length of a curve, close to it \[m\].
pub(crate) fn length_m(curve: &WashCurve, surface: &Surface) -> f64 {
    let points = points(curve, surface);
    let chords = points
        .windows(2)
        .map(|pair| (pair[1].1.position - pair[0].1.position).norm());
    chords.sum()
}
