//! The curves that the tip must follow, by one parameter θ that never runs back.

use crate::face::Face;
use nalgebra::Vector3;
use platewash_workcell::plate::Plate;
use platewash_workcell::segment::SegmentKind;
use platewash_workcell::wash_path::{BLEND_RAD, WashCurve, WashPath};
use std::f64::consts::TAU;

/// Steps of Gauss–Newton that look for the nearest point; where they end matters for the bound, not for its validity.
const STEPS: usize = 12;

/// A curve, base frame, m.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Curve<'a> {
    /// Straight; θ is the length from `from` \[m\].
    Line {
        from: Vector3<f64>,
        along: Vector3<f64>,
        length: f64,
    },
    /// A wash curve on a face; θ is its own \[rad\].
    Wash { face: Face<'a>, curve: &'a WashCurve },
}

impl<'a> Curve<'a> {
    /// The curve that a wash path asks for while the tip is at its plate, in the direction of the motion; `None` for free motion.
    pub fn new(plate: &'a Plate, path: &'a WashPath, kind: SegmentKind) -> Option<Self> {
        let [start, end] = path.feet(plate);
        let (up, length) = (|foot: &Vector3<f64>| plate.normal_at(foot), path.lift_m);
        match kind {
            SegmentKind::Approach => {
                let up = up(&start);
                let (from, along) = (start + up * length, -up);
                Some(Self::Line { from, along, length })
            }
            SegmentKind::Wash => {
                let (face, curve) = (Face::of(plate), &path.curve);
                Some(Self::Wash { face, curve })
            }
            SegmentKind::Retreat => {
                let (from, along) = (end, up(&end));
                Some(Self::Line { from, along, length })
            }
            SegmentKind::Depart | SegmentKind::Transit | SegmentKind::Return => None,
        }
    }

    /// The last θ; the first is 0.
    pub fn end(&self) -> f64 {
        match self {
            Self::Line { length, .. } => *length,
            Self::Wash { curve, .. } => curve.end(),
        }
    }

    /// Position and first derivative at θ.
    pub fn at(&self, theta: f64) -> [Vector3<f64>; 2] {
        match self {
            Self::Line { from, along, .. } => [from + along * theta, *along],
            Self::Wash { face, curve } => face.on(curve, theta),
        }
    }

    /// Bound of the second derivative by θ between two θ. Of a spiral on a disc: |r″| + r + 2 r′, of which r never falls, r′ is at most the
    /// spiral's rate a, and r″ is 0 before the blend and at most 15/8 a / β in it. Of others: [`WashCurve::greatest_second`].
    pub fn bend(&self, between: [f64; 2]) -> f64 {
        match self {
            Self::Line { .. } => 0.0,
            Self::Wash { face, curve } if curve.rings.is_some() || !face.surface().is_flat() => {
                curve.greatest_second(face.surface(), between)
            }
            Self::Wash { curve, .. } => {
                let [_, theta] = between;
                let rate = curve.pitch_m() / TAU;
                let r = curve.at(theta).position.norm();
                let blends = theta >= curve.spiral_end() - BLEND_RAD;
                r + 2.0 * rate + if blends { 1.875 * rate / BLEND_RAD } else { 0.0 }
            }
        }
    }

    /// θ of a point of the curve near `p`, from `least` to `most`, sought from `guess` on.
    pub fn nearest(&self, p: &Vector3<f64>, guess: f64, [least, most]: [f64; 2]) -> f64 {
        let most_step = match self {
            Self::Line { .. } => f64::INFINITY,
            Self::Wash { .. } => 0.5,
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
