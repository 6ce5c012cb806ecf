//! Quadtree that decides for each cell if it is swept.
//!
//! The swept share of an undecided cell is computed by columns: the parts that the disc and every capsule cut out of a column's middle line
//! are exact.
//!
//! Sections of the disc of a sponge on a straight segment.
//!
//! The common area of a disc and a rectangle.

use platewash_kinematics::trig::atan2;

/// Unswept area of the disc, in the square of the unit of the lengths.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct UnsweptArea {
    /// Proven lower bound.
    pub(crate) at_least: f64,
    /// Proven upper bound.
    pub(crate) at_most: f64,
    /// Estimate: undecided cells count by the swept share of their columns.
    pub(crate) estimate: f64,
}

/// State of a recursion over square cells about the disc's centre.
#[derive(Debug)]
pub(crate) struct Raster<'a> {
    capsules: &'a [Capsule],
    radius: f64,
    sponge_radius: f64,
    cell: f64,
    /// Capsules that reach the current cell, after those that reach the cells around it.
    near: Vec<u32>,
    /// Capsule that covers the last covered cell: often the next one, too.
    covering: u32,
    /// Buffer for the sections of a column.
    sections: Vec<[f64; 2]>,
    unswept: UnsweptArea,
}

impl<'a> Raster<'a> {
    /// Prepares the recursion. Lengths have one unit, and the disc's centre is the origin.
    pub(crate) fn new(capsules: &'a [Capsule], radius: f64, sponge_radius: f64, cell: f64) -> Self {
        let near = (0..capsules.len() as u32).collect();
        Self {
            capsules,
            radius,
            sponge_radius,
            cell,
            near,
            covering: 0,
            sections: Vec::new(),
            unswept: UnsweptArea::default(),
        }
    }

    /// Returns the area of the disc that no capsule covers.
    pub(crate) fn uncovered(mut self) -> UnsweptArea {
        // The root is the smallest square around the disc that halves down to cells of the wanted size.
        let mut half = 0.5 * self.cell;
        let mut depth = 0;
        while half < self.radius {
            half *= 2.0;
            depth += 1;
        }
        self.visit([0.0, 0.0], half, depth, 0);
        self.unswept
    }

    /// Adds the cell about `middle`; `near[first..]` holds every capsule that may reach it.
    fn visit(&mut self, middle: [f64; 2], half: f64, depth: u32, first: usize) {
        if self.is_outside_disc(middle, half) {
            return;
        }
        let half_diagonal = half * std::f64::consts::SQRT_2;
        let (within, reach) = (self.sponge_radius - half_diagonal, self.sponge_radius + half_diagonal);
        let covers = |squared: f64| within > 0.0 && squared <= within * within;
        let squared_to = |capsule: u32| self.capsules.get(capsule as usize).map(|c| c.distance_squared(middle));
        if squared_to(self.covering).is_some_and(covers) {
            return;
        }
        let last = self.near.len();
        for k in first..last {
            let squared = self.capsules[self.near[k] as usize].distance_squared(middle);
            if covers(squared) {
                self.covering = self.near[k];
                self.near.truncate(last);
                return;
            }
            if squared < reach * reach {
                self.near.push(self.near[k]);
            }
        }
        if self.near.len() == last {
            self.add_uncovered(self.area_in_disc(middle, half));
        } else if depth == 0 {
            self.add_undecided(middle, half, last);
        } else {
            let quarter = 0.5 * half;
            for (x, y) in [
                (-quarter, -quarter),
                (quarter, -quarter),
                (-quarter, quarter),
                (quarter, quarter),
            ] {
                self.visit([middle[0] + x, middle[1] + y], quarter, depth - 1, last);
            }
        }
        self.near.truncate(last);
    }

    fn add_uncovered(&mut self, area: f64) {
        self.unswept.at_least += area;
        self.unswept.at_most += area;
        self.unswept.estimate += area;
    }

    /// Adds a smallest cell that the capsules of `near[first..]` reach but none of them covers.
    fn add_undecided(&mut self, middle: [f64; 2], half: f64, first: usize) {
        let area = self.area_in_disc(middle, half);
        let near = self.near[first..].iter().map(|&k| &self.capsules[k as usize]);
        let cell = middle.map(|c| [c - half, c + half]);
        let share = swept_share(cell, self.radius, near, self.sponge_radius, &mut self.sections);
        self.unswept.at_most += area;
        self.unswept.estimate += area * (1.0 - share);
    }

    fn is_outside_disc(&self, [x, y]: [f64; 2], half: f64) -> bool {
        let (dx, dy) = ((x.abs() - half).max(0.0), (y.abs() - half).max(0.0));
        dx * dx + dy * dy >= self.radius * self.radius
    }

    fn area_in_disc(&self, [x, y]: [f64; 2], half: f64) -> f64 {
        let (dx, dy) = (x.abs() + half, y.abs() + half);
        if dx * dx + dy * dy <= self.radius * self.radius {
            return 4.0 * half * half;
        }
        area_of_rectangle_in_disc(self.radius, [x - half, x + half], [y - half, y + half])
    }
}

/// Number of columns of a cell.
const COLUMNS: u32 = 8;

/// Estimates the swept share, 0 to 1, of the part of a cell [x0, x1] × [y0, y1] that lies in the disc of `radius` about the origin.
/// `sections` is a buffer.
fn swept_share<'a>(
    [[x0, x1], [y0, y1]]: [[f64; 2]; 2],
    radius: f64,
    capsules: impl Iterator<Item = &'a Capsule> + Clone,
    sponge_radius: f64,
    sections: &mut Vec<[f64; 2]>,
) -> f64 {
    // Columns only where there is something of the disc.
    let nearest_y = y0.max(-y1).max(0.0);
    let widest = (radius * radius - nearest_y * nearest_y).max(0.0).sqrt();
    let (x0, x1) = (x0.max(-widest), x1.min(widest));
    let width = (x1 - x0) / f64::from(COLUMNS);
    let (mut whole, mut swept) = (0.0, 0.0);
    for column in 0..COLUMNS {
        let x = x0 + width * (f64::from(column) + 0.5);
        let rim = (radius * radius - x * x).max(0.0).sqrt();
        let (from, to) = (y0.max(-rim), y1.min(rim));
        if from < to {
            whole += to - from;
            sections.clear();
            sections.extend(capsules.clone().filter_map(|capsule| capsule.section(x, sponge_radius)));
            swept += covered_length([from, to], sections);
        }
    }
    if whole > 0.0 { (swept / whole).min(1.0) } else { 0.0 }
}

/// Returns the length of an interval that others together cover.
fn covered_length([from, to]: [f64; 2], others: &mut [[f64; 2]]) -> f64 {
    others.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
    let (mut done, mut covered) = (from, 0.0);
    for [start, end] in others {
        let (start, end) = (start.max(done), end.min(to));
        if end > start {
            covered += end - start;
            done = end;
        }
    }
    covered
}

/// Axis of a capsule: a segment, which may be a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Capsule {
    start: [f64; 2],
    along: [f64; 2],
    /// Inverse of the squared length; 0 for a point.
    inverse_length_squared: f64,
}

impl Capsule {
    pub(crate) fn new(start: [f64; 2], end: [f64; 2]) -> Self {
        let along = [end[0] - start[0], end[1] - start[1]];
        let inverse = (along[0] * along[0] + along[1] * along[1]).recip();
        Self {
            start,
            along,
            inverse_length_squared: if inverse.is_finite() { inverse } else { 0.0 },
        }
    }

    /// True if a point of the axis is within `reach` of the line at the given y.
    pub(crate) fn comes_near_height(&self, y: f64, reach: f64) -> bool {
        let ends = [self.start[1], self.start[1] + self.along[1]];
        ends[0].min(ends[1]) - reach <= y && y <= ends[0].max(ends[1]) + reach
    }

    /// Square of the distance of a point from the axis.
    pub(crate) fn distance_squared(&self, p: [f64; 2]) -> f64 {
        let (x, y) = (p[0] - self.start[0], p[1] - self.start[1]);
        let t = ((x * self.along[0] + y * self.along[1]) * self.inverse_length_squared).clamp(0.0, 1.0);
        let (dx, dy) = (x - t * self.along[0], y - t * self.along[1]);
        dx * dx + dy * dy
    }

    /// Returns the range of y within `reach` of the axis on the line at the given x. It joins those of both ends' discs and of the
    /// rectangle between them, which together are convex.
    fn section(&self, x: f64, reach: f64) -> Option<[f64; 2]> {
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

    /// Returns the range of y on the line at the given x whose nearest point of the axis is not an end, and within `reach`.
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

/// Returns one capsule per segment, relative to the disc's centre.
pub(super) fn capsules(polyline: &[[f64; 2]], centre: [f64; 2]) -> Vec<Capsule> {
    let about_centre = |p: [f64; 2]| [p[0] - centre[0], p[1] - centre[1]];
    match polyline {
        [] => Vec::new(),
        &[point] => vec![Capsule::new(about_centre(point), about_centre(point))],
        _ => polyline
            .windows(2)
            .map(|ends| Capsule::new(about_centre(ends[0]), about_centre(ends[1])))
            .collect(),
    }
}

/// Returns the range of y with least ≤ slope · y + offset ≤ most; all y if the slope is zero and the offset fits.
fn solutions(slope: f64, offset: f64, [least, most]: [f64; 2]) -> Option<[f64; 2]> {
    if slope == 0.0 {
        return (least <= offset && offset <= most).then_some([f64::NEG_INFINITY, f64::INFINITY]);
    }
    let [a, b] = [least, most].map(|end| (end - offset) / slope);
    Some([a.min(b), a.max(b)])
}

/// Area of the rectangle [x0, x1] × [y0, y1] within the disc of radius `radius` about the origin.
///
/// The signed area F(a, b) over [0, a] × [0, b] is odd in a and in b; the rectangle's is F(x1, y1) − F(x0, y1) − F(x1, y0) +
/// F(x0, y0).
#[must_use]
pub fn area_of_rectangle_in_disc(radius: f64, [x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> f64 {
    let signed = |a: f64, b: f64| quadrant_area(radius, a.abs(), b.abs()) * a.signum() * b.signum();
    (signed(x1, y1) - signed(x0, y1) - signed(x1, y0) + signed(x0, y0)).max(0.0)
}

/// Area of [0, a] × [0, b] within the disc: a b if the corner is inside, and otherwise b x_b plus the integral of
/// √(radius² − x²) from x_b to a, where x_b = √(radius² − b²).
fn quadrant_area(radius: f64, a: f64, b: f64) -> f64 {
    let (a, b) = (a.min(radius), b.min(radius));
    let squared = radius * radius;
    if a * a + b * b <= squared {
        return a * b;
    }
    let (x_b, y_a) = ((squared - b * b).max(0.0).sqrt(), (squared - a * a).max(0.0).sqrt());
    0.5 * (b * x_b + a * y_a + squared * (atan2(a, y_a) - atan2(x_b, b)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Compared with many points of the line.
        #[test]
        fn a_section_is_where_the_axis_is_near(
            start in prop::array::uniform2(-1.0..1.0f64),
            along in prop_oneof![
                prop::array::uniform2(-1.0..1.0f64),
                (-1.0..1.0f64).prop_map(|u| [u, 0.0]),
                (-1.0..1.0f64).prop_map(|u| [0.0, u]),
                Just([0.0, 0.0]),
            ],
            x in -2.0..2.0f64,
            reach in 0.05..1.0f64,
        ) {
            let capsule = Capsule::new(start, [start[0] + along[0], start[1] + along[1]]);
            let section = capsule.section(x, reach);
            for k in -400..=400 {
                let y = 0.01 * f64::from(k);
                let off = capsule.distance_squared([x, y]).sqrt() - reach;
                let inside = section.is_some_and(|[from, to]| from <= y && y <= to);
                prop_assert!(off.abs() < 1e-9 || inside == (off < 0.0), "y = {y}: {off} m off, section {section:?}");
            }
        }
    }

    #[test]
    fn lengths_that_overlap_count_once() {
        let mut others = [
            [0.5, 0.7],
            [-1.0, 0.1],
            [0.6, 0.8],
            [0.05, 0.2],
            [0.95, 3.0],
            [4.0, 5.0],
        ];
        assert!((covered_length([0.0, 1.0], &mut others) - 0.55).abs() < 1e-15);
        assert_eq!(covered_length([0.0, 1.0], &mut []), 0.0);
    }
}
