//! When a sponge is first on each cell of the square around a face, and for how long: a disc that moves over it, or by the stays of points.

use super::numbers::Numbers;
use serde::Serialize;
use ts_rs::TS;

/// The mark of a cell that the disc is never over.
const NEVER: u16 = u16::MAX;

/// The mark of a cell whose middle is outside of the rim.
const OUTSIDE: u16 = u16::MAX - 1;

/// The greatest count of steps.
const MOST_STEPS: f64 = 65_533.0;

/// A moment of a disc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Disc {
    /// Time \[s\].
    pub t_s: f64,
    /// Its centre, from that of the square \[m\].
    pub at: [f64; 2],
    /// Its radius \[m\].
    pub radius_m: f64,
}

/// A square of cells about a round face.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Raster {
    half_m: f64,
    cells: usize,
    /// First time, infinite for never \[s\]; row by row, y and x ascending.
    first_s: Vec<f64>,
    /// Time altogether \[s\].
    dwell_s: Vec<f64>,
}

/// A raster as the page reads it.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct Marks {
    /// \[rows, columns\], y then x ascending in the plate's frame: when the cell's middle first counts, in steps of `step_s`;
    /// 65535 for never, 65534 for cells with their middle outside the rim.
    pub first: Numbers,
    /// \[s\]
    pub step_s: f64,
    /// \[rows, columns\]: for how long it counts, in steps of `dwell_step_s`, at most 255.
    pub dwell: Numbers,
    /// \[s\]
    pub dwell_step_s: f64,
}

impl Raster {
    /// Cells along an edge of a square about a face of that rim \[m\], none touched.
    pub fn new(rim_m: f64, cells: usize) -> Self {
        Self {
            half_m: rim_m,
            cells,
            first_s: vec![f64::INFINITY; cells * cells],
            dwell_s: vec![0.0; cells * cells],
        }
    }

    /// Moves the disc straight and evenly from one moment to another; on the way it is as large as the smaller of the two.
    pub fn sweep(&mut self, from: &Disc, to: &Disc) {
        let radius_m = from.radius_m.min(to.radius_m);
        let way = [to.at[0] - from.at[0], to.at[1] - from.at[1]];
        let length_s = to.t_s - from.t_s;
        let near = |axis: usize| {
            let (a, b) = (from.at[axis], to.at[axis]);
            self.range(a.min(b) - radius_m, a.max(b) + radius_m)
        };
        let (columns, rows) = (near(0), near(1));
        for row in rows {
            for column in columns.clone() {
                let off = [from.at[0] - self.middle(column), from.at[1] - self.middle(row)];
                let Some([enters, leaves]) = within(off, way, radius_m) else {
                    continue;
                };
                let cell = row * self.cells + column;
                self.first_s[cell] = self.first_s[cell].min(from.t_s + enters * length_s);
                self.dwell_s[cell] += (leaves - enters) * length_s;
            }
        }
    }

    /// Adds when the sponge is on the middle of each cell inside the rim: from and to \[s\], in order, of a place \[m\].
    pub fn add_stays(&mut self, stays: impl Fn([f64; 2]) -> Vec<[f64; 2]>) {
        let inside: Vec<usize> = self.inside().collect();
        for cell in inside {
            let stays = stays(self.middle_of(cell));
            let Some([first_s, _]) = stays.first() else { continue };
            self.first_s[cell] = self.first_s[cell].min(*first_s);
            self.dwell_s[cell] += stays.iter().map(|[from, to]| to - from).sum::<f64>();
        }
    }

    /// Time for which the sponge was on each cell \[s\], row by row, y and x ascending; `None` outside the rim.
    pub fn dwell_s(&self) -> Vec<Option<f64>> {
        let dwell = self.dwell_s.iter().enumerate();
        dwell
            .map(|(cell, dwell_s)| self.is_inside(cell).then_some(*dwell_s))
            .collect()
    }

    /// Share of the cells inside the rim that the sponge was on.
    #[cfg(test)]
    pub fn share(&self) -> f64 {
        let (all, swept) = self.inside().fold((0.0, 0.0), |(all, swept), cell| {
            (all + 1.0, swept + f64::from(u8::from(self.first_s[cell].is_finite())))
        });
        swept / all
    }

    /// The middles of the cells inside the rim, row by row \[m\].
    pub fn middles(&self) -> Vec<[f64; 2]> {
        self.inside().map(|cell| self.middle_of(cell)).collect()
    }

    /// Sets the first times \[s\] at the middles of the cells inside the rim.
    pub fn arrive(&mut self, times_s: &[f64]) {
        let inside: Vec<usize> = self.inside().collect();
        for (cell, time_s) in inside.into_iter().zip(times_s) {
            self.first_s[cell] = *time_s;
        }
    }

    /// The first times in steps of time, and the step \[s\], for a motion of that duration \[s\].
    pub fn first(&self, duration_s: f64) -> (Numbers, f64) {
        let step_s = (duration_s / MOST_STEPS).max(1e-3);
        let first = self.first_s.iter().enumerate().map(|(cell, first_s)| {
            if !self.is_inside(cell) {
                OUTSIDE
            } else if first_s.is_finite() {
                (first_s / step_s).ceil().clamp(0.0, MOST_STEPS) as u16
            } else {
                NEVER
            }
        });
        (Numbers::u16([self.cells, self.cells], first), step_s)
    }

    /// The raster in steps of time, for a motion of that duration \[s\].
    pub fn marks(&self, duration_s: f64) -> Marks {
        let (first, step_s) = self.first(duration_s);
        let longest_s = self.dwell_s.iter().copied().fold(0.0, f64::max);
        let dwell_step_s = (longest_s / 255.0).max(1e-3);
        let dwell = self
            .dwell_s
            .iter()
            .map(|s| (s / dwell_step_s).round().clamp(0.0, 255.0) as u8);
        Marks {
            first,
            step_s,
            dwell: Numbers::u8([self.cells, self.cells], dwell),
            dwell_step_s,
        }
    }

    /// Indices of the cells whose middles are between two coordinates \[m\].
    fn range(&self, from_m: f64, to_m: f64) -> std::ops::Range<usize> {
        let scale = self.cells as f64 / (2.0 * self.half_m);
        let index = |m: f64| (m + self.half_m) * scale - 0.5;
        let bound = |index: f64| index.clamp(0.0, self.cells as f64) as usize;
        bound(index(from_m).ceil())..bound(index(to_m).floor() + 1.0)
    }

    /// The middle of a row or column \[m\].
    fn middle(&self, index: usize) -> f64 {
        self.half_m * ((2 * index + 1) as f64 / self.cells as f64 - 1.0)
    }

    /// Middle of a cell \[m\].
    fn middle_of(&self, cell: usize) -> [f64; 2] {
        [cell % self.cells, cell / self.cells].map(|index| self.middle(index))
    }

    /// The cells whose middles are within the rim.
    fn inside(&self) -> impl Iterator<Item = usize> {
        (0..self.first_s.len()).filter(|&cell| self.is_inside(cell))
    }

    fn is_inside(&self, cell: usize) -> bool {
        let [x, y] = self.middle_of(cell);
        x * x + y * y <= self.half_m * self.half_m
    }
}

/// Range of shares of a straight path within which a point that starts at `off` from another one is within `radius_m` of it.
fn within(off: [f64; 2], way: [f64; 2], radius_m: f64) -> Option<[f64; 2]> {
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    // |off + u way|² ≤ r²: a u² + 2 b u + c ≤ 0.
    let (a, b, c) = (dot(way, way), dot(off, way), dot(off, off) - radius_m * radius_m);
    // Within it at both ends, and so all the way.
    if c <= 0.0 && a + 2.0 * b + c <= 0.0 {
        return Some([0.0, 1.0]);
    }
    if a == 0.0 {
        return None;
    }
    let discriminant = b * b - a * c;
    if discriminant < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    let [enters, leaves] = [(-b - root) / a, (-b + root) / a];
    (enters <= 1.0 && leaves >= 0.0).then(|| [enters.max(0.0), leaves.min(1.0)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use platewash_bodies::coverage::coverage;
    use proptest::prelude::*;

    fn disc(t_s: f64, at: [f64; 2], radius_m: f64) -> Disc {
        Disc { t_s, at, radius_m }
    }

    /// The first time and the time altogether of a cell by small steps.
    fn by_steps(path: &[Disc], middle: [f64; 2]) -> Option<[f64; 2]> {
        const STEPS: usize = 4000;
        let mut found: Option<[f64; 2]> = None;
        for ends in path.windows(2) {
            let [from, to] = [&ends[0], &ends[1]];
            let step_s = (to.t_s - from.t_s) / STEPS as f64;
            for k in 0..STEPS {
                let share = (k as f64 + 0.5) / STEPS as f64;
                let off = [0, 1].map(|axis| from.at[axis] + share * (to.at[axis] - from.at[axis]) - middle[axis]);
                if off[0] * off[0] + off[1] * off[1] <= from.radius_m * from.radius_m {
                    let [first, dwell] = found.unwrap_or([from.t_s + (k as f64 + 0.5) * step_s, 0.0]);
                    found = Some([first, dwell + step_s]);
                }
            }
        }
        found
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        /// Every cell, against small steps along the way.
        #[test]
        fn cells_record_arrival_and_stay_of_the_disc(
            places in prop::collection::vec(prop::array::uniform2(-0.2..0.2f64), 2..5), radius in 0.01..0.1f64,
        ) {
            let path: Vec<_> = places.iter().enumerate().map(|(k, at)| disc(k as f64, *at, radius)).collect();
            let mut raster = Raster::new(0.15, 9);
            path.windows(2).for_each(|ends| raster.sweep(&ends[0], &ends[1]));
            for cell in 0..81 {
                let middle = [raster.middle(cell % 9), raster.middle(cell / 9)];
                match by_steps(&path, middle) {
                    // Grazed for less than a step, it may go unseen there.
                    None => prop_assert!(raster.dwell_s[cell] < 2e-3),
                    Some([first, dwell]) => {
                        prop_assert!((raster.first_s[cell] - first).abs() < 2e-3, "{} {first}", raster.first_s[cell]);
                        prop_assert!((raster.dwell_s[cell] - dwell).abs() < 2e-3, "{} {dwell}", raster.dwell_s[cell]);
                    }
                }
            }
        }

        /// The share of cells is that of the area, but for cells that the border runs through.
        #[test]
        fn the_share_of_cells_is_that_of_the_area(
            places in prop::collection::vec(prop::array::uniform2(-0.14..0.14f64), 2..6), radius in 0.02..0.08f64,
        ) {
            let (rim, cells) = (0.145, 96);
            let mut raster = Raster::new(rim, cells);
            let path: Vec<_> = places.iter().enumerate().map(|(k, at)| disc(k as f64, *at, radius)).collect();
            path.windows(2).for_each(|ends| raster.sweep(&ends[0], &ends[1]));
            let exact = coverage(&places, [0.0; 2], rim, radius, 1e-3).unwrap();
            prop_assert!((raster.share() - exact.fraction).abs() < 0.01, "{} {}", raster.share(), exact.fraction);
        }
    }

    /// A disc that rests over one of four cells for two seconds.
    #[test]
    fn rows_go_up_with_y_and_columns_with_x() {
        let mut raster = Raster::new(1.0, 2);
        raster.sweep(&disc(3.0, [0.5, -0.5], 0.1), &disc(5.0, [0.5, -0.5], 0.1));
        assert_eq!(raster.first_s, [f64::INFINITY, 3.0, f64::INFINITY, f64::INFINITY]);
        assert_eq!(raster.dwell_s, [0.0, 2.0, 0.0, 0.0]);
        let marks = raster.marks(60.0);
        assert_eq!(
            marks.first,
            Numbers::u16([2, 2], [NEVER, 3000, NEVER, NEVER].into_iter())
        );
        assert_eq!(marks.dwell, Numbers::u8([2, 2], [0, 255, 0, 0].into_iter()));
        assert!((255.0 * marks.dwell_step_s - 2.0).abs() < 1e-12);
    }

    /// In a raster of five by five cells the middles of the corners are 1.13 from the centre.
    #[test]
    fn cells_beyond_the_rim_are_marked_and_far_ways_harmless() {
        let mut raster = Raster::new(1.0, 5);
        raster.sweep(&disc(0.0, [1e9, 1e9], 0.1), &disc(1.0, [2e9, 1e9], 0.1));
        raster.sweep(&disc(0.0, [f64::NAN; 2], 0.1), &disc(1.0, [0.0; 2], 0.1));
        let marks = raster.marks(1e9);
        let corner = |cell: usize| [0, 4, 20, 24].contains(&cell);
        let expected = (0..25).map(|cell| if corner(cell) { OUTSIDE } else { NEVER });
        assert_eq!(marks.first, Numbers::u16([5, 5], expected));
        // However long a motion lasts, its steps can be counted.
        assert!(marks.step_s * MOST_STEPS >= 1e9);
    }
}
