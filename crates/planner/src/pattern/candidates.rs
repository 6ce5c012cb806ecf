//! Candidate curves.
//!
//! Estimates for a curve: its time at the limits of washing and of the arm, and its effect on the bare face.

use crate::pattern::promise::{Promise, SampledWash};
use crate::scene::{AxisRule, TiltPolicy};
use crate::timing::TipLimits;
use crate::trig::sin_cos;
use nalgebra::Vector3;
use platewash_bodies::contact::{Moment, SpongePose};
use platewash_workcell::job::{PatternName, PlannerSettings};
use platewash_workcell::surface::Surface;
use platewash_workcell::wash_path::{
    BLEND_RAD, LEAST_RADIUS_M, LEAST_TURNS, MOST_RINGS, MOST_TURNS, Rings, SurfacePoint, WashCurve,
};
use std::f64::consts::TAU;

/// Distances of neighbouring windings that are tried, in sponge radii: two of them touch at 2.
const PITCHES: [f64; 9] = [1.95, 1.8, 1.65, 1.5, 1.4, 1.3, 1.2, 1.0, 0.8];

/// Distances of the outermost winding from the rim that are tried, in sponge radii.
const INSETS: [f64; 6] = [0.95, 0.92, 0.85, 0.77, 0.7, 0.5];

/// λ₀ and w₀ of blends \[rad\]: shorter ones are shorter ways, and longer times where joints reach their accelerations.
const BLENDS: [[f64; 2]; 2] = [[2.0, 1.7], [1.8, 1.4]];

/// ℓ of the innermost ring, relative to that of evenly spaced rings: farther out it lies nearer to the next ones.
const INNER: [f64; 3] = [1.0, 1.08, 1.17];

/// Trims of the closing ring that are tried \[rad\], the greatest first: the blend before it covers some of its beginning.
pub(crate) const TRIMS_RAD: [f64; 3] = [0.55, 0.4, 0.2];

/// Rings that are tried at most, where their number is not stated.
const MOST_TRIED: usize = 40;

/// Pitches of denser curves, for doses that the usual ones do not give.
const DENSE_PITCHES: [f64; 3] = [0.65, 0.5, 0.35];

/// Density with which a curve covers a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Density {
    /// Density for a usual job.
    Usual,
    /// Denser than that.
    Dense,
}

/// Lists all curves of a density that the settings leave open, with the greatest trim; at least one of the usual density.
pub(crate) fn candidates(
    settings: &PlannerSettings,
    surface: &Surface,
    sponge_m: f64,
    density: Density,
    laps: u32,
) -> Vec<WashCurve> {
    // A spiral passes every place once.
    let pattern = (laps > 1)
        .then_some(PatternName::Rings)
        .or(settings.pattern)
        .or(states_spiral(settings).then_some(PatternName::Spiral));
    let arc_m = surface.arc_m();
    let mut all = Vec::new();
    if settings.turns.is_some() && density == Density::Dense {
        return all;
    }
    if pattern != Some(PatternName::Spiral) {
        all.extend(rings(settings, arc_m, sponge_m, density, laps));
    }
    if pattern != Some(PatternName::Rings) {
        all.extend(spirals(settings, arc_m, sponge_m, density));
    }
    all
}

/// Checks that the settings state some of a spiral.
fn states_spiral(settings: &PlannerSettings) -> bool {
    settings.turns.is_some() || settings.path_radius_m.is_some() || settings.closing_ring.is_some()
}

/// Greatest ℓ: the one stated, or those tried \[m\].
fn outer(settings: &PlannerSettings, arc_m: f64, sponge_m: f64) -> Vec<f64> {
    match settings.path_radius_m {
        Some(radius_m) => vec![radius_m],
        None => INSETS
            .iter()
            .map(|inset| (arc_m - inset * sponge_m).max(0.3 * arc_m))
            .collect(),
    }
}

fn spirals(settings: &PlannerSettings, arc_m: f64, sponge_m: f64, density: Density) -> Vec<WashCurve> {
    let pitches: &[f64] = match density {
        Density::Usual => &PITCHES,
        Density::Dense => &DENSE_PITCHES,
    };
    let trim_rad = if states_spiral(settings) { 0.0 } else { TRIMS_RAD[0] };
    let mut all = Vec::new();
    for radius_m in outer(settings, arc_m, sponge_m) {
        let turns = match settings.turns {
            Some(turns) => vec![turns],
            None => pitches
                .iter()
                .map(|pitch| radius_m / (pitch * sponge_m) + 0.5 * BLEND_RAD / TAU)
                .collect(),
        };
        for turns in turns {
            all.push(WashCurve {
                radius_m: radius_m.max(LEAST_RADIUS_M),
                turns: turns.clamp(LEAST_TURNS, MOST_TURNS),
                start_angle_rad: 0.0,
                closing_ring: settings.closing_ring.unwrap_or(true),
                trim_rad,
                rings: None,
            });
        }
    }
    all
}

/// Rings that lie evenly, or nearly so: about half a pitch from the pole to the first, and half a pitch or less from the last to the
/// rim. As many as are stated, however far apart; at least one curve.
fn rings(settings: &PlannerSettings, arc_m: f64, sponge_m: f64, density: Density, laps: u32) -> Vec<WashCurve> {
    let mut all = Vec::new();
    let [least, most] = match settings.turns {
        Some(turns) => [(turns.round() as usize).saturating_add(1).clamp(2, MOST_RINGS); 2],
        None => {
            let least = ((arc_m / (2.0 * sponge_m)).ceil().max(2.0) as usize).min(MOST_TRIED);
            let few = (least + 2).min(MOST_TRIED);
            match density {
                Density::Usual => [least, few],
                Density::Dense => [few + 1, (few + 4).min(MOST_TRIED)],
            }
        }
    };
    for count in least..=most {
        let half_m = arc_m / (2 * count) as f64;
        let mut outers = outer(settings, arc_m, sponge_m);
        if settings.path_radius_m.is_none() {
            outers.push(arc_m - half_m);
        }
        for radius_m in outers.into_iter().map(|radius_m| radius_m.max(LEAST_RADIUS_M)) {
            let even_m = radius_m / (2 * count - 1) as f64;
            for inner_m in INNER.map(|share| share * even_m) {
                all.extend(BLENDS.map(|blend| ringed((count, laps), [inner_m, radius_m], blend)));
            }
        }
    }
    all
}

/// Rings, each gone round a number of times, with ℓ of the innermost and of the outermost.
fn ringed((count, laps): (usize, u32), [inner_m, radius_m]: [f64; 2], [lead_rad, blend_rad]: [f64; 2]) -> WashCurve {
    let rings = Rings {
        count,
        inner_m,
        lead_rad,
        blend_rad,
        laps,
    };
    WashCurve {
        radius_m,
        turns: rings.turns(),
        start_angle_rad: 0.0,
        closing_ring: true,
        trim_rad: TRIMS_RAD[0],
        rings: Some(rings),
    }
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
