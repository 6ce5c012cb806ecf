//! Distances of facets from a profile, and the body below it.
//!
//! A facet is level along a line, and the profile is bent: with the greatest second derivative M of its height, over the facet's longest edge
//! L, seen along the axis, the difference is at most M L²/6 more than at the corners. Facets are halved until that is small, and it is added.

use crate::measured::bounds::NOISE_M;
use nalgebra::Vector3;
use platewash_workcell::plate::{Foot, LEAST_PLATE_M};
use platewash_workcell::surface::Surface;
use std::f64::consts::PI;

/// Number of rings in which the bend of the profile and the depth of the body are kept.
const CELLS: usize = 256;

/// Greatest number of times that a facet is halved.
const HALVINGS: u32 = 40;

/// Least share of the volume that a foot must save.
const SAVED: f64 = 0.02;

/// Profile, with what bounds its bend.
pub(super) struct Ruler {
    pub surface: Surface,
    /// Greatest second derivative in each ring \[1/m\].
    bends: Vec<f64>,
}

/// Part of a facet: its corners and their distances above the profile, which is off by no more than a bound in between \[m\].
pub(super) struct Part {
    pub corners: [Vector3<f64>; 3],
    pub above_m: [f64; 3],
    pub bound_m: f64,
}

impl Ruler {
    pub fn new(surface: Surface) -> Self {
        let width_m = surface.rim_m() / CELLS as f64;
        let bend = |k: usize| {
            let patch = surface.patch([width_m * k as f64, width_m * (k + 1) as f64]);
            let cosine = patch.least_cosine();
            patch.greatest_curvature() / (cosine * cosine * cosine)
        };
        let bends = (0..CELLS).map(bend).collect();
        Self { surface, bends }
    }

    fn cell(&self, rho_m: f64) -> usize {
        ((rho_m / self.surface.rim_m() * CELLS as f64).max(0.0) as usize).min(CELLS - 1)
    }

    /// Height of a point above the profile \[m\]; beyond the rim the profile goes on straight.
    pub fn above_m(&self, point: &Vector3<f64>) -> f64 {
        point.z - self.surface.height_m(point.xy().norm())
    }

    /// Shows the parts of a facet, no longer than `most_m`, for which `matters` is true.
    fn parts(
        &self,
        corners: [Vector3<f64>; 3],
        most_m: f64,
        mut matters: impl FnMut(&Part) -> bool,
        mut see: impl FnMut(&Part),
    ) {
        let mut rest = vec![(corners, HALVINGS)];
        while let Some((corners, halvings)) = rest.pop() {
            let squares = [0, 1, 2].map(|k| (corners[(k + 1) % 3] - corners[k]).xy().norm_squared());
            let longest = (0..3).max_by(|i, j| squares[*i].total_cmp(&squares[*j])).unwrap_or(0);
            let length_m = squares[longest].sqrt();
            let radii = corners.map(|corner| corner.xy().norm());
            let [near, far] = radii.iter().fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], r| {
                [low.min(*r), high.max(*r)]
            });
            let bends = &self.bends[self.cell(near - 0.5 * length_m)..=self.cell(far)];
            let part = Part {
                corners,
                above_m: corners.map(|corner| self.above_m(&corner)),
                bound_m: bends.iter().copied().fold(0.0, f64::max) * squares[longest] / 6.0,
            };
            if !matters(&part) {
                continue;
            }
            if (part.bound_m <= NOISE_M && length_m <= most_m) || halvings == 0 {
                see(&part);
                continue;
            }
            let [a, b, c] = [0, 1, 2].map(|k| corners[(longest + k) % 3]);
            let middle = (a + b) * 0.5;
            rest.push(([a, middle, c], halvings - 1));
            rest.push(([middle, b, c], halvings - 1));
        }
    }
}

/// Greatest and least height above the profile, each with its point.
#[derive(Clone, Copy)]
pub(super) struct Extremes {
    pub high: (f64, Vector3<f64>),
    pub low: (f64, Vector3<f64>),
}

impl Extremes {
    pub fn new() -> Self {
        Self {
            high: (f64::NEG_INFINITY, Vector3::zeros()),
            low: (f64::INFINITY, Vector3::zeros()),
        }
    }

    pub fn see(&mut self, above_m: f64, bound_m: f64, point: &Vector3<f64>) {
        if above_m + bound_m > self.high.0 {
            self.high = (above_m + bound_m, *point);
        }
        if above_m - bound_m < self.low.0 {
            self.low = (above_m - bound_m, *point);
        }
    }

    /// Middle between both: where the profile is as far from one as from the other \[m\].
    pub fn middle_m(&self) -> f64 {
        self.high.0.midpoint(self.low.0)
    }

    /// Adds a facet.
    pub fn see_facet(&mut self, ruler: &Ruler, corners: [Vector3<f64>; 3]) {
        let mut seen = *self;
        corners
            .iter()
            .for_each(|corner| seen.see(ruler.above_m(corner), 0.0, corner));
        let [high, low] = [seen.high.0, seen.low.0];
        let matters = |part: &Part| {
            let beyond = |above: &f64| above + part.bound_m > high || above - part.bound_m < low;
            part.above_m.iter().any(beyond)
        };
        let see = |part: &Part| {
            let corners = part.corners.iter().zip(part.above_m);
            corners.for_each(|(corner, above_m)| seen.see(above_m, part.bound_m, corner));
        };
        ruler.parts(corners, f64::INFINITY, matters, see);
        *self = seen;
    }
}

/// Body of a mesh below a profile.
pub(super) struct Body {
    /// Greatest depth below the profile in each ring \[m\].
    depths: Vec<f64>,
    /// Least height in each ring \[m\].
    floors: Vec<f64>,
    /// Greatest distance beyond the rim \[m\], with its point.
    pub beyond: (f64, Vector3<f64>),
    /// Greatest height above the profile, and beyond the rim greatest distance from its edge, of what is above it \[m\], with its point.
    pub above: (f64, Vector3<f64>),
}

impl Body {
    /// Returns the body of facets.
    pub fn from_facets(ruler: &Ruler, facets: impl Iterator<Item = [Vector3<f64>; 3]>) -> Self {
        let mut body = Self {
            depths: vec![0.0; CELLS],
            floors: vec![f64::INFINITY; CELLS],
            beyond: (0.0, Vector3::zeros()),
            above: (0.0, Vector3::zeros()),
        };
        let rim_m = ruler.surface.rim_m();
        let edge_m = ruler.surface.height_m(rim_m);
        for corners in facets {
            ruler.parts(
                corners,
                2.0 * rim_m / CELLS as f64,
                |_| true,
                |part| {
                    let radii = part.corners.map(|corner| corner.xy().norm());
                    let near = radii.iter().copied().fold(f64::INFINITY, f64::min);
                    let far = radii.iter().copied().fold(0.0, f64::max);
                    let length_m = (part.corners[1] - part.corners[0]).xy().norm();
                    let cells = ruler.cell(near - length_m)..=ruler.cell(far);
                    // Beyond the rim the depth counts from the edge of the face.
                    let depth = |(k, rho): (usize, &f64)| match *rho > rim_m {
                        true => edge_m - part.corners[k].z,
                        false => -part.above_m[k],
                    };
                    let (k, least) =
                        (0..3)
                            .map(|k| (k, depth((k, &radii[k]))))
                            .fold(
                                (0, f64::INFINITY),
                                |least, found| {
                                    if found.1 < least.1 { found } else { least }
                                },
                            );
                    // Beside the edge of the body, a point is as far from it as from the edge.
                    let above_m = match radii[k] > rim_m && least < 0.0 {
                        true => (least * least + (radii[k] - rim_m) * (radii[k] - rim_m)).sqrt() + part.bound_m,
                        false => part.bound_m - least,
                    };
                    if above_m > body.above.0 {
                        body.above = (above_m, part.corners[k]);
                    }
                    let deep_m = radii.iter().enumerate().map(depth).fold(0.0, f64::max) + part.bound_m;
                    let floor_m = part.corners.iter().map(|corner| corner.z).fold(f64::INFINITY, f64::min);
                    for cell in cells {
                        body.depths[cell] = body.depths[cell].max(deep_m);
                        body.floors[cell] = body.floors[cell].min(floor_m);
                    }
                    if far - rim_m > body.beyond.0 {
                        let at = part
                            .corners
                            .iter()
                            .max_by(|a, b| a.xy().norm().total_cmp(&b.xy().norm()));
                        body.beyond = (far - rim_m, at.copied().unwrap_or_default());
                    }
                },
            );
        }
        body
    }

    /// Greatest depth below the profile \[m\].
    pub fn depth_m(&self) -> f64 {
        self.depths.iter().copied().fold(0.0, f64::max)
    }

    /// Returns the thickness, and the foot if the body has one: whatever takes the least volume and holds the whole mesh.
    pub fn thickness_and_foot(&self, surface: &Surface) -> (f64, Option<Foot>) {
        let rim_m = surface.rim_m();
        let width_m = rim_m / CELLS as f64;
        let deepest = self.depths.iter().copied().fold(LEAST_M, f64::max);
        let mut least = PI * rim_m * rim_m * deepest * (1.0 - SAVED);
        let mut found = (deepest, None);
        for cells in 1..CELLS {
            let thickness_m = self.depths[cells..].iter().copied().fold(LEAST_M, f64::max);
            let floor_m = self.floors[..cells].iter().copied().fold(f64::INFINITY, f64::min);
            let height_m = -thickness_m - floor_m;
            if height_m <= 10.0 * LEAST_PLATE_M {
                continue;
            }
            let below = |cell: usize| {
                let rho_m = width_m * (cell as f64 + 0.5);
                2.0 * PI * rho_m * width_m * (surface.height_m(rho_m) + height_m).max(0.0)
            };
            let volume = PI * rim_m * rim_m * thickness_m + (0..cells).map(below).sum::<f64>();
            if volume < least {
                let radius_m = width_m * cells as f64;
                least = volume;
                found = (thickness_m, Some(Foot { radius_m, height_m }));
            }
        }
        found
    }
}

/// Least thickness of a body \[m\].
const LEAST_M: f64 = 1e-4;
