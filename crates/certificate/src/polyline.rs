//! Moments of the tip, seen along the axis of a plate, as a polyline that the tip never leaves by much.

use crate::face::{Face, norm};
use crate::piece::Piece;
use crate::tip::{Arm, Stretch};

/// How far the tip may leave the polyline \[m\], where halving helps.
const CHORD_M: f64 = 5e-5;

/// How often a piece of a wash is halved at most.
pub(crate) const MOST_HALVINGS: u32 = 6;

/// Halvings that any motion may have besides those of its pieces.
const SPLITS: usize = 4096;

/// Moments of the tip, from the pole of a plate \[m\].
#[derive(Debug)]
pub(crate) struct Polyline {
    pub points: Vec<[f64; 2]>,
    /// The tip is never farther from it \[m\].
    pub off_m: f64,
    /// Largest distance of a moment from the pole \[m\].
    pub seen_m: f64,
    /// The tip is never farther from the pole \[m\].
    pub within_m: f64,
    /// How far it may be \[m\].
    allowed_m: f64,
    most_halvings: u32,
    /// Halvings left.
    splits: usize,
}

impl Polyline {
    /// The tip during some pieces over a face. It should keep within `allowed_m` of the pole: where it does, that is proved.
    pub fn new(arm: &Arm<'_>, pieces: &[Piece], face: &Face<'_>, allowed_m: f64, most_halvings: u32) -> Self {
        let mut line = Self {
            points: Vec::new(),
            off_m: 0.0,
            seen_m: 0.0,
            within_m: 0.0,
            allowed_m,
            most_halvings,
            splits: SPLITS + (pieces.len() << MOST_HALVINGS),
        };
        for (i, piece) in pieces.iter().enumerate() {
            let stretch = arm.stretch(piece);
            if i == 0 {
                line.points.push(seen(face, &stretch, 0));
            }
            line.add(arm, face, &stretch, 0);
        }
        line
    }

    /// Adds a stretch whose first end is there already.
    fn add(&mut self, arm: &Arm<'_>, face: &Face<'_>, stretch: &Stretch<'_>, depth: u32) {
        let off_m = stretch.sag(arm.derivatives(stretch).second());
        let ends = [0, 1].map(|end| seen(face, stretch, end));
        let far_m = ends.map(|[x, y]| norm(x, y)).into_iter().fold(0.0, f64::max);
        let undecided = far_m <= self.allowed_m && far_m + off_m > self.allowed_m;
        let halves = if (off_m > CHORD_M || undecided) && depth < self.most_halvings && self.splits > 0 {
            self.splits -= 1;
            arm.halves(stretch)
        } else {
            None
        };
        if let Some(halves) = halves {
            return halves.iter().for_each(|half| self.add(arm, face, half, depth + 1));
        }
        self.off_m = if off_m.is_nan() {
            f64::INFINITY
        } else {
            self.off_m.max(off_m)
        };
        // ‖f‖ ≤ max(‖f(a)‖, ‖f(b)‖) + h²/8 · sup ‖f″‖ for f from the pole to the tip.
        self.seen_m = self.seen_m.max(far_m);
        self.within_m = if off_m.is_nan() {
            f64::INFINITY
        } else {
            self.within_m.max(far_m + off_m)
        };
        self.points.push(ends[1]);
    }
}

/// An end of a stretch.
fn seen(face: &Face<'_>, stretch: &Stretch<'_>, end: usize) -> [f64; 2] {
    face.seen(&stretch.ends[end].position).into()
}
