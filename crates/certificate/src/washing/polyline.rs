//! Moments of the tip, seen along the axis of a plate, as a polyline that the tip never leaves by much.

use crate::motion::tip::{Arm, Stretch, TipPiece};
use crate::washing::face::{Face, norm};

/// Distance between tip and chord above which a stretch is halved \[m\].
const CHORD_M: f64 = 5e-5;

/// Greatest depth of halving of a piece of a wash.
pub(crate) const MOST_HALVINGS: u32 = 6;

/// Halvings allowed for any motion besides those of its pieces.
const SPLITS: usize = 4096;

/// Positions of the tip, seen along the plate's axis, from the plate's pole \[m\].
#[derive(Debug)]
pub(crate) struct Polyline {
    pub points: Vec<[f64; 2]>,
    /// Upper bound Δ on the distance of the tip from the polyline \[m\], formula (26.1) in `docs/certificate.md`.
    pub off_m: f64,
    /// Largest distance of a point from the pole \[m\].
    pub seen_m: f64,
    /// Upper bound on the distance of the tip from the pole \[m\].
    pub within_m: f64,
    /// Distance from the pole that the tip should keep within \[m\].
    allowed_m: f64,
    most_halvings: u32,
    /// Halvings left.
    splits: usize,
}

impl Polyline {
    /// The tip during some pieces over a face. It should keep within `allowed_m` of the pole: where it does, that is proved.
    pub fn new(arm: &Arm<'_>, pieces: &[TipPiece<'_>], face: &Face<'_>, allowed_m: f64, most_halvings: u32) -> Self {
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
            let stretch = piece.stretch();
            if i == 0 {
                line.points.push(tip_from_pole(face, &stretch, 0));
            }
            line.add(arm, face, &stretch, 0);
        }
        line
    }

    /// Adds a stretch whose first end is there already, or its halves. The tip leaves the chord by at most h²/8 · sup ‖p̈‖, formula (0.1).
    fn add(&mut self, arm: &Arm<'_>, face: &Face<'_>, stretch: &Stretch<'_>, depth: u32) {
        let off_m = stretch.sag(arm.derivatives(stretch).second());
        let ends = [0, 1].map(|end| tip_from_pole(face, stretch, end));
        let far_m = ends.map(|[x, y]| norm(x, y)).into_iter().fold(0.0, f64::max);
        let undecided = far_m <= self.allowed_m && far_m + off_m > self.allowed_m;
        let halves = if (off_m > CHORD_M || undecided) && depth < self.most_halvings && self.splits > 0 {
            self.splits -= 1;
            arm.halves(stretch)
        } else {
            None
        };
        if let Some(halves) = halves {
            return halves
                .both()
                .iter()
                .for_each(|half| self.add(arm, face, half, depth + 1));
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

/// Returns the tip at an end of a stretch, seen along the plate's axis, from the pole \[m\].
fn tip_from_pole(face: &Face<'_>, stretch: &Stretch<'_>, end: usize) -> [f64; 2] {
    face.project(&stretch.ends[end].position).into()
}
