//! The curves of a declared tool path that the tip must follow, by one parameter θ that never runs back.

use crate::tool_path::{Segment, SegmentKind, Shape};
use nalgebra::Vector3;
use platewash_workcell::stroke::{BLEND_RAD, Stroke};
use std::f64::consts::TAU;

/// Steps of Gauss–Newton that look for the nearest point; where they end matters for the bound, not for its validity.
const STEPS: usize = 12;

/// A curve, base frame, m.
#[derive(Debug, Clone, Copy)]
pub(super) enum Curve {
    /// Straight; θ is the length from `from` \[m\].
    Line {
        from: Vector3<f64>,
        along: Vector3<f64>,
        length: f64,
    },
    /// A stroke about `centre`; θ is its own \[rad\].
    Stroke { centre: Vector3<f64>, stroke: Stroke },
}

impl Curve {
    /// The curve that a segment declares, in the direction of its motion; `None` for free motion and shapes that no certified job
    /// has, and for lengths and normals that are no curve.
    pub fn new(segment: &Segment) -> Option<Self> {
        match (&segment.shape, segment.kind) {
            (
                Shape::Line {
                    foot_m,
                    normal,
                    height_m,
                },
                kind,
            ) => {
                let (foot, up) = (Vector3::from(*foot_m), Vector3::from(*normal));
                let fits = *height_m >= 0.0 && (up.norm() - 1.0).abs() < 1e-9;
                let (from, along) = match kind {
                    SegmentKind::Approach => (foot + up * *height_m, -up),
                    SegmentKind::Retreat => (foot, up),
                    _ => return None,
                };
                let length = *height_m;
                fits.then_some(Self::Line { from, along, length })
            }
            (Shape::Stroke { centre_m, stroke, .. }, SegmentKind::Wash) => {
                let fits = stroke.radius_m > 0.0 && stroke.turns >= 0.25 && stroke.turns < 1e4;
                let centre = Vector3::from(*centre_m);
                fits.then_some(Self::Stroke {
                    centre,
                    stroke: *stroke,
                })
            }
            _ => None,
        }
    }

    /// The last θ; the first is 0.
    pub fn end(&self) -> f64 {
        match self {
            Self::Line { length, .. } => *length,
            Self::Stroke { stroke, .. } => stroke.end(),
        }
    }

    /// Position and first derivative at θ.
    pub fn at(&self, theta: f64) -> [Vector3<f64>; 2] {
        match self {
            Self::Line { from, along, .. } => [from + along * theta, *along],
            Self::Stroke { centre, stroke } => {
                let point = stroke.at(theta);
                let flat = |v: nalgebra::Vector2<f64>| Vector3::new(v.x, v.y, 0.0);
                [centre + flat(point.position), flat(point.first)]
            }
        }
    }

    /// Bound of the second derivative by θ, from θ = 0 to `theta`: |r″| + r + 2 r′, of which r never falls, r′ is at most the
    /// spiral's rate a, and r″ is 0 before the blend and at most 15/8 a / β in it.
    pub fn bend(&self, theta: f64) -> f64 {
        match self {
            Self::Line { .. } => 0.0,
            Self::Stroke { stroke, .. } => {
                let rate = stroke.pitch_m() / TAU;
                let r = stroke.at(theta).position.norm();
                let blends = theta >= stroke.spiral_end() - BLEND_RAD;
                r + 2.0 * rate + if blends { 1.875 * rate / BLEND_RAD } else { 0.0 }
            }
        }
    }

    /// θ of a point of the curve near `p`, from `least` to `most`, sought from `guess` on.
    pub fn nearest(&self, p: &Vector3<f64>, guess: f64, [least, most]: [f64; 2]) -> f64 {
        let most_step = match self {
            Self::Line { .. } => f64::INFINITY,
            Self::Stroke { .. } => 0.5,
        };
        let mut theta = guess.clamp(least, most);
        for _ in 0..STEPS {
            let [there, first] = self.at(theta);
            let step = (p - there).dot(&first) / first.norm_squared();
            if !step.is_finite() {
                break;
            }
            let next = (theta + step.clamp(-most_step, most_step)).clamp(least, most);
            if (next - theta).abs() <= 1e-13 {
                return next;
            }
            theta = next;
        }
        theta
    }
}
