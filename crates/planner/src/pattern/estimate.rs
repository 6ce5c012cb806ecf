//! How long a curve takes at the limits of washing, and what it brings about on the bare face.

use super::promise::{Margin, Promise};
use crate::scene::AxisRule;
use crate::trig::sin_cos;
use nalgebra::Vector3;
use platewash_workcell::contact::{Moment, SpongePose};
use platewash_workcell::surface::Surface;
use platewash_workcell::wash_path::{SurfacePoint, WashCurve};

/// How far a chord of the curve that is looked at may leave it \[m\].
const CHORD_M: f64 = 5e-5;

/// The longest stride between moments \[m\].
const STRIDE_M: f64 = 3e-3;

/// The tilt of the tool that is reckoned with on flat faces, as a share of the cone: the arm tilts it as suits it.
const LEAN: f64 = 0.8;

/// A curve and its time.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Estimate {
    pub curve: WashCurve,
    /// From rest to rest, the arm apart \[s\].
    pub least_s: f64,
    speed_m_s: f64,
}

impl Estimate {
    /// A curve on a surface, washed as fast as the limits allow \[m/s, m/s²\].
    pub fn new(curve: WashCurve, surface: &Surface, [speed_m_s, most_m_s2]: [f64; 2]) -> Self {
        let mut least_s = speed_m_s / most_m_s2;
        for [from, to] in pairs(&points(&curve, surface)) {
            let along_m = (to.position - from.position).norm();
            let turned = (to.first.normalize() - from.first.normalize()).norm();
            // The curvature of the piece bounds the speed: v² κ ≤ a.
            let slow_m_s = (most_m_s2 * along_m / turned.max(1e-9)).sqrt();
            least_s += along_m / speed_m_s.min(slow_m_s);
        }
        Self {
            curve,
            least_s,
            speed_m_s,
        }
    }

    /// Whether on the bare face, with the tool by its rule, it brings about what is promised.
    pub fn keeps(&self, promise: &Promise, surface: &Surface, (rule, cone_rad): (&AxisRule, f64)) -> bool {
        let swept = promise.swept_within(surface, cone_rad);
        let (promise, cone_rad) = swept.as_ref().map_or((promise, cone_rad), |swept| (swept, 0.0));
        promise.seems_kept(surface, &self.moments(surface, rule, cone_rad), &Margin::BARE_FACE)
    }

    /// The sponge along the curve at the speed of washing, the tool by its rule and leaning as is usual within a cone.
    pub fn moments(&self, surface: &Surface, rule: &AxisRule, cone_rad: f64) -> Vec<Moment> {
        let (lean_s, lean_c) = sin_cos(if surface.is_flat() { LEAN * cone_rad } else { 0.0 });
        let mut moments: Vec<Moment> = Vec::new();
        let mut t_s = 0.0;
        for (theta, here) in &points(&self.curve, surface) {
            if let Some(last) = moments.last() {
                t_s += (here.position - last.pose.tip).norm() / self.speed_m_s;
            }
            let [arc_m, ..] = self.curve.arc(*theta);
            let [c, s] = rule.direction(arc_m);
            let out = here.position.xy().try_normalize(0.0).unwrap_or_default();
            moments.push(Moment {
                t_s,
                pose: SpongePose {
                    tip: here.position,
                    axis: Vector3::new(s * out.x + lean_s, s * out.y, -c * lean_c),
                },
                speed: here.first.normalize() * self.speed_m_s,
                turning: Vector3::zeros(),
            });
        }
        moments
    }
}

/// Points of a curve, neighbours no farther apart than [`STRIDE_M`].
fn points(curve: &WashCurve, surface: &Surface) -> Vec<(f64, SurfacePoint)> {
    let mut all: Vec<(f64, SurfacePoint)> = Vec::new();
    for theta in curve.parameters(surface, CHORD_M) {
        let here = curve.on(surface, theta);
        if let Some((before, last)) = all.last().copied() {
            let pieces = ((here.position - last.position).norm() / STRIDE_M).ceil();
            for k in 1..pieces as u32 {
                let between = before + (theta - before) * f64::from(k) / pieces;
                all.push((between, curve.on(surface, between)));
            }
        }
        all.push((theta, here));
    }
    all
}

fn pairs(points: &[(f64, SurfacePoint)]) -> impl Iterator<Item = [&SurfacePoint; 2]> {
    points.windows(2).map(|pair| [&pair[0].1, &pair[1].1])
}
