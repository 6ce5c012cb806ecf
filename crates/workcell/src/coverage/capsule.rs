//! Where the disc of a sponge is along a straight way.

/// The axis of a capsule: a segment, which may be a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Capsule {
    start: [f64; 2],
    along: [f64; 2],
    /// 1 / length², 0 for a point.
    inverse_length_squared: f64,
}

impl Capsule {
    pub(super) fn new(start: [f64; 2], end: [f64; 2]) -> Self {
        let along = [end[0] - start[0], end[1] - start[1]];
        let inverse = (along[0] * along[0] + along[1] * along[1]).recip();
        Self {
            start,
            along,
            inverse_length_squared: if inverse.is_finite() { inverse } else { 0.0 },
        }
    }

    /// Whether some point of the axis is within `reach` of the line at the given y.
    pub(super) fn comes_near_height(&self, y: f64, reach: f64) -> bool {
        let ends = [self.start[1], self.start[1] + self.along[1]];
        ends[0].min(ends[1]) - reach <= y && y <= ends[0].max(ends[1]) + reach
    }

    /// Square of the distance of a point from the axis.
    pub(super) fn distance_squared(&self, p: [f64; 2]) -> f64 {
        let (x, y) = (p[0] - self.start[0], p[1] - self.start[1]);
        let t = ((x * self.along[0] + y * self.along[1]) * self.inverse_length_squared).clamp(0.0, 1.0);
        let (dx, dy) = (x - t * self.along[0], y - t * self.along[1]);
        dx * dx + dy * dy
    }

    /// The y within `reach` of the axis on the line at the given x, from and to: those of both ends' discs and of the
    /// rectangle between them, which together are convex.
    pub(super) fn section(&self, x: f64, reach: f64) -> Option<[f64; 2]> {
        let [ax, ay] = self.start;
        let [ux, uy] = self.along;
        let disc = |cx: f64, cy: f64| {
            let left = reach * reach - (x - cx) * (x - cx);
            (left >= 0.0).then(|| [cy - left.sqrt(), cy + left.sqrt()])
        };
        let parts = [disc(ax, ay), disc(ax + ux, ay + uy), self.beside_axis(x, reach)];
        let both = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        parts.into_iter().flatten().reduce(both)
    }

    /// The y on the line at the given x whose nearest point of the axis is none of its ends', and within `reach`.
    fn beside_axis(&self, x: f64, reach: f64) -> Option<[f64; 2]> {
        let [ux, uy] = self.along;
        let (length_squared, x) = (ux * ux + uy * uy, x - self.start[0]);
        // Along the axis 0 ≤ ux x + uy y ≤ |u|², across it |ux y − uy x| ≤ reach |u|.
        let width = reach * length_squared.sqrt();
        let along = solutions(uy, ux * x, [0.0, length_squared])?;
        let across = solutions(ux, -uy * x, [-width, width])?;
        let y = [along[0].max(across[0]), along[1].min(across[1])];
        (y[0] <= y[1] && y[0].is_finite() && y[1].is_finite()).then(|| y.map(|y| self.start[1] + y))
    }
}

/// The y with least ≤ slope · y + offset ≤ most; all where the slope is zero and the offset fits.
fn solutions(slope: f64, offset: f64, [least, most]: [f64; 2]) -> Option<[f64; 2]> {
    if slope == 0.0 {
        return (least <= offset && offset <= most).then_some([f64::NEG_INFINITY, f64::INFINITY]);
    }
    let [a, b] = [least, most].map(|end| (end - offset) / slope);
    Some([a.min(b), a.max(b)])
}
