//! The quadtree that decides, cell by cell, what is swept.

use super::capsule::Capsule;
use super::columns::swept_share;
use super::disc::area_of_rectangle_in_disc;

/// Area of the disc that is not swept, in the square of the unit of the lengths.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Uncovered {
    /// Proven lower bound.
    pub(super) at_least: f64,
    /// Proven upper bound.
    pub(super) at_most: f64,
    /// Estimate: undecided cells count by the swept share of their columns.
    pub(super) estimate: f64,
}

/// The state of a recursion over square cells about the disc's centre.
#[derive(Debug)]
pub(super) struct Raster<'a> {
    capsules: &'a [Capsule],
    radius: f64,
    sponge_radius: f64,
    cell: f64,
    /// The capsules that reach the current cell, after those that reach the cells around it.
    near: Vec<u32>,
    /// Room for the sections of a column.
    sections: Vec<[f64; 2]>,
    uncovered: Uncovered,
}

impl<'a> Raster<'a> {
    /// Lengths in one unit, the disc's centre at the origin.
    pub(super) fn new(capsules: &'a [Capsule], radius: f64, sponge_radius: f64, cell: f64) -> Self {
        let near = (0..capsules.len() as u32).collect();
        Self {
            capsules,
            radius,
            sponge_radius,
            cell,
            near,
            sections: Vec::new(),
            uncovered: Uncovered::default(),
        }
    }

    /// The area of the disc that no capsule covers.
    pub(super) fn uncovered(mut self) -> Uncovered {
        // The root is the smallest square around the disc that halves down to cells of the wanted size.
        let mut half = 0.5 * self.cell;
        let mut depth = 0;
        while half < self.radius {
            half *= 2.0;
            depth += 1;
        }
        self.visit([0.0, 0.0], half, depth, 0);
        self.uncovered
    }

    /// Adds the cell about `middle`; `near[first..]` holds every capsule that may reach it.
    fn visit(&mut self, middle: [f64; 2], half: f64, depth: u32, first: usize) {
        if self.is_outside_disc(middle, half) {
            return;
        }
        let half_diagonal = half * std::f64::consts::SQRT_2;
        let (within, reach) = (self.sponge_radius - half_diagonal, self.sponge_radius + half_diagonal);
        let last = self.near.len();
        for k in first..last {
            let squared = self.capsules[self.near[k] as usize].distance_squared(middle);
            if within > 0.0 && squared <= within * within {
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
        self.uncovered.at_least += area;
        self.uncovered.at_most += area;
        self.uncovered.estimate += area;
    }

    /// Adds a smallest cell that the capsules of `near[first..]` reach but none of them covers.
    fn add_undecided(&mut self, middle: [f64; 2], half: f64, first: usize) {
        let area = self.area_in_disc(middle, half);
        let near = self.near[first..].iter().map(|&k| &self.capsules[k as usize]);
        let cell = middle.map(|c| [c - half, c + half]);
        let share = swept_share(cell, self.radius, near, self.sponge_radius, &mut self.sections);
        self.uncovered.at_most += area;
        self.uncovered.estimate += area * (1.0 - share);
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
