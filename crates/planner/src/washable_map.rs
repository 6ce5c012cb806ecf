//! Map of the places at which a plate could be washed: the squares, and the answers for them.

use crate::error::PlanError;
use crate::out_of_range::OutOfRange;
use platewash_bodies::job::WashJob;
use serde::Serialize;
use std::collections::BTreeMap;

/// Edges of squares, the coarsest first, by the finest.
const LEVELS: [i32; 3] = [4, 2, 1];

/// Finest squares across the radius of an area, at most; of all levels together there are then fewer than 20 000.
const MOST_ACROSS: f64 = 60.0;

/// The same number where the area is chosen here.
const CHOSEN_ACROSS: f64 = 45.0;

/// Least number of them: the first squares are four times as large, and some must lie in the area.
const LEAST_ACROSS: f64 = 4.0;

/// Radius of an area, at least and at most \[m\].
const RADII_M: [f64; 2] = [0.05, 1e3];

/// Distance of an area from the base, at most \[m\].
const FARTHEST_M: f64 = 1e3;

/// Greatest number of squares in one patch: few, so that the first ones arrive soon.
pub const IN_A_PATCH: usize = 32;

/// Places of the edges chosen here in a metre.
const PER_METRE: f64 = 1000.0;

/// The disc of the floor that is mapped: centres of the plate.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MapArea {
    /// Its centre \[m\].
    pub centre_m: [f64; 2],
    /// Its radius \[m\].
    pub radius_m: f64,
    /// Edge of the finest squares \[m\]; the first ones are four times as large.
    pub step_m: f64,
}

/// Some checked squares of one size.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MapPatch {
    /// Their edge \[m\].
    pub step_m: f64,
    /// Centres of those where the plate could be washed \[m\].
    pub washable_m: Vec<[f64; 2]>,
    /// Centres of the others \[m\].
    pub unwashable_m: Vec<[f64; 2]>,
    /// Squares of this size checked so far.
    pub done: usize,
    /// Squares of this size in all.
    pub of: usize,
}

/// A square of a level by its column and row, those with index 0 beside the centre of the area.
pub(crate) type Square = (i32, i32);

impl MapArea {
    /// The floor below which the centre of a plate may be for the arm to reach it there, at its height: no farther away than the
    /// lengths of the links and of the tool add up to.
    ///
    /// # Errors
    /// [`PlanError::Plate`].
    pub fn within_reach(job: &WashJob, plate: usize) -> Result<Self, PlanError> {
        let (arm, terms) = (job.arm(), job.terms());
        let count = terms.plates.len();
        let lies = terms.plates.get(plate).ok_or(PlanError::Plate { plate, count })?;
        let (from, bound_m) = arm.reach_bound(&terms.workcell.tool.tip_frame(arm));
        let from = terms.workcell.mount * from;
        let up_m = lies.centre().z - from.z;
        let reach_m = (bound_m * bound_m - up_m * up_m).max(0.0).sqrt();
        Ok(Self::about([from.x, from.y], reach_m))
    }

    /// Area of a reach about a point: squares so fine that all levels take seconds, with edges in whole millimetres.
    fn about(centre_m: [f64; 2], reach_m: f64) -> Self {
        let [least, most] = RADII_M;
        // NaN is the least here.
        let radius_m = reach_m.max(least).min(most);
        Self {
            centre_m,
            radius_m,
            step_m: (PER_METRE * radius_m / CHOSEN_ACROSS).ceil() / PER_METRE,
        }
    }

    /// Refuses one with too many squares, or that is none.
    pub(crate) fn check(&self) -> Result<(), PlanError> {
        let within = OutOfRange::check;
        for at in self.centre_m {
            within("map.centre_m", at, [-FARTHEST_M, FARTHEST_M])?;
        }
        within("map.radius_m", self.radius_m, RADII_M)?;
        let steps = [MOST_ACROSS, LEAST_ACROSS].map(|across| self.radius_m / across);
        Ok(within("map.step_m", self.step_m, steps)?)
    }
}

/// The levels of a map, coarse to fine, with the answers so far.
#[derive(Debug)]
pub(crate) struct Levels<'a> {
    /// The whole of the map.
    pub area: &'a MapArea,
    /// Answers square by square of each level that was begun: true where the plate could be washed.
    pub found: Vec<BTreeMap<Square, bool>>,
}

impl<'a> Levels<'a> {
    pub fn new(area: &'a MapArea) -> Self {
        let found = Vec::with_capacity(LEVELS.len());
        Self { area, found }
    }

    /// The edge of the squares of a level \[m\]; `None` behind the finest.
    pub fn edge_m(&self, level: usize) -> Option<f64> {
        Some(self.area.step_m * f64::from(*LEVELS.get(level)?))
    }

    /// Begins the next level, and returns its squares and their edge \[m\]; `None` behind the finest. First all whose centre lies in the area,
    /// then quarters of those along the border between squares where the plate could be washed and others.
    pub fn next(&mut self) -> Option<(f64, Vec<Square>)> {
        let level = self.found.len();
        let step_m = self.edge_m(level)?;
        let squares = match self.found.last() {
            None => self.all(step_m),
            Some(coarser) => {
                let border = coarser.keys().filter(|&&square| self.is_border(level - 1, square));
                border.flat_map(|&square| quarters(square)).collect()
            }
        };
        self.found.push(BTreeMap::new());
        Some((step_m, squares))
    }

    /// Takes answers for squares of the level that was begun.
    pub fn add(&mut self, answers: impl IntoIterator<Item = (Square, bool)>) {
        if let Some(found) = self.found.last_mut() {
            found.extend(answers);
        }
    }

    /// Checks that the plate could be washed with its centre there \[m\]: the answer of the finest square.
    pub fn at(&self, place: [f64; 2]) -> bool {
        let Some(level) = self.found.len().checked_sub(1) else {
            return false;
        };
        let Some(edge_m) = self.edge_m(level) else { return false };
        let [x, y] = self.area.centre_m;
        let [column, row] = [(x, place[0]), (y, place[1])].map(|(from, at)| ((at - from) / edge_m).floor() as i32);
        self.answer(level, (column, row))
    }

    /// The middle of a square of some edge \[m\].
    pub fn centre(&self, step_m: f64, (column, row): Square) -> [f64; 2] {
        let [x, y] = self.area.centre_m;
        [(x, column), (y, row)].map(|(from, k)| from + step_m * (f64::from(k) + 0.5))
    }

    fn all(&self, step_m: f64) -> Vec<Square> {
        let across = (self.area.radius_m / step_m).ceil() as i32 + 1;
        let inside = |&(column, row): &Square| {
            let [x, y] = [column, row].map(|k| step_m * (f64::from(k) + 0.5));
            (x * x + y * y).sqrt() <= self.area.radius_m
        };
        let rows = -across..across;
        let square = |row: i32| (-across..across).map(move |column| (column, row));
        rows.flat_map(square).filter(inside).collect()
    }

    /// Checks that one of the eight squares around has the other answer. Outside of the area nothing can be washed.
    fn is_border(&self, level: usize, (column, row): Square) -> bool {
        let here = self.answer(level, (column, row));
        let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (column + dx, row + dy)));
        let mut around = around;
        around.any(|other| self.answer(level, other) != here)
    }

    /// The answer for a square, or for the coarser one around it that was not quartered.
    fn answer(&self, level: usize, (column, row): Square) -> bool {
        let mut square = (column, row);
        for found in self.found[..=level].iter().rev() {
            if let Some(&answer) = found.get(&square) {
                return answer;
            }
            square = (square.0.div_euclid(2), square.1.div_euclid(2));
        }
        false
    }
}

/// The four squares of the next level in one.
fn quarters((column, row): Square) -> impl Iterator<Item = Square> {
    let [x, y] = [2 * column, 2 * row];
    [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)].into_iter()
}

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests {
    use super::*;

    const AREA: MapArea = MapArea {
        centre_m: [0.3, -7.0],
        radius_m: 60.0,
        step_m: 1.0,
    };

    /// Every square is at the border.
    #[test]
    fn there_are_never_more_than_twenty_thousand_squares() {
        let mut levels = Levels::new(&AREA);
        let (mut all, mut steps) = (0, Vec::new());
        while let Some((step_m, squares)) = levels.next() {
            all += squares.len();
            steps.push(step_m);
            let inside = squares.iter().map(|square| levels.centre(step_m, *square));
            assert!(inside.clone().all(|[x, y]| (x - 0.3).hypot(y + 7.0) < 60.0 + 3.0));
            let answers: Vec<_> = squares.iter().map(|&(x, y)| ((x, y), (x + y) % 2 == 0)).collect();
            levels.add(answers);
        }
        assert_eq!(steps, [4.0, 2.0, 1.0]);
        assert!((14_000..20_000).contains(&all), "{all}");
    }

    /// On a half plane, only the squares beside its edge, on both sides, are quartered, and those at the rim: nothing is washed
    /// outside.
    #[test]
    fn squares_are_quartered_along_the_border_alone() {
        let mut levels = Levels::new(&AREA);
        for _ in 0..2 {
            let squares = levels.next().map(|(_, squares)| squares).unwrap_or_default();
            levels.add(squares.into_iter().map(|(x, y)| ((x, y), x < 0)).collect::<Vec<_>>());
        }
        let finest = levels.next().map(|(_, squares)| squares).unwrap_or_default();
        let inside = finest.iter().filter(|(x, y)| f64::from(*x).hypot(f64::from(*y)) < 45.0);
        let columns: std::collections::BTreeSet<i32> = inside.map(|(x, _)| *x).collect();
        assert_eq!(columns.into_iter().collect::<Vec<_>>(), [-2, -1, 0, 1]);
    }

    #[test]
    fn a_map_area_exists_for_any_reach() {
        for reach_m in [f64::NAN, 0.0, 0.01, 0.82, 1.0, 3.5, 900.0, 1e9, f64::INFINITY] {
            let area = MapArea::about([0.0, 0.0], reach_m);
            assert_eq!(area.check(), Ok(()), "{reach_m}: {area:?}");
            let squares = Levels::new(&area).next().map_or(0, |(_, squares)| squares.len());
            assert!(squares > 50, "{reach_m}: {squares}");
        }
    }
}
