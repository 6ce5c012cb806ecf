//! Mesh whose equal corners are one vertex, its sides and its face.

use crate::measured::algebra::Moments;
use crate::measured::axis::{Cloud, Fitted, Frame};
use crate::measured::bounds::is_coordinate;
use crate::measured::error::MeasuredError;
use crate::measured::face::{corners, height_at, outermost};
use nalgebra::{Point3, Vector3};

/// Cells along the longest side of the box around a mesh: corners in one cell are one vertex. They are odd in number, so that one lies in the
/// middle plane, where seams are.
const CELLS: f64 = 2_097_145.0;

/// Distance along each side, as a share of the longest one, below which corners in neighbouring cells are one vertex, too.
const SAME: f64 = 2e-9;

/// Greatest share of the mesh's area, seen along the axis, by which both sides of a closed mesh may differ.
const OPEN: f64 = 0.01;

/// Least component of a facet's normal along the axis for which the facet faces up.
const UP: f64 = 0.02;

/// Least share of a piece of the face in its area.
const LEAST_PIECE: f64 = 0.01;

/// Number of sectors in which the outermost vertex is sought: each should hold a corner of the rim of a coarse mesh.
pub(super) const SECTORS: usize = 24;

/// Number of vertices of the face from which on only a part of them is fitted.
const ENOUGH: usize = 60_000;

/// Number of points all over the surface, roughly, where this is fitted.
const SAMPLES: f64 = 60_000.0;

/// Steps of a sequence of points that fills a square evenly: 1/p and 1/p², with the plastic number p.
const EVENLY: [f64; 2] = [0.754_877_666_246_693, 0.569_840_290_998_053];

/// Greatest slope by which the face falls outwards, as its tangent: 45°. It ends there, and the lip begins.
const LIP: f64 = 1.0;

/// Mesh of a plate, in the frame of its file, about its middle.
pub(super) struct Mesh {
    /// Middle of the corners' box, in the unit of the file.
    pub middle: Vector3<f64>,
    /// Vertices, each once, relative to the middle.
    pub points: Vec<Vector3<f64>>,
    /// Indices of the corners.
    pub triangles: Vec<[u32; 3]>,
    /// Sum of the facets' areas, as vectors along their normals.
    net: Vector3<f64>,
    /// Six times the volume about the middle.
    volume: f64,
}

/// Part of a face that is fitted.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Fit {
    /// The vertices: they lie on the plate that coarse facets stand for.
    Vertices,
    /// Points all over the facets: a drawing may have vertices at the knots of its profile alone.
    Surface,
}

/// Facets of the face.
pub(super) struct Face {
    /// Facets from the pole to the lip, and those of dents: what is measured.
    pub facets: Vec<[u32; 3]>,
    /// Points to fit.
    pub cloud: Cloud,
    /// Outermost corners of the rim, no more than one a sector.
    pub rim: Vec<Vector3<f64>>,
}

impl Face {
    /// Returns what is fitted; an error if nothing is.
    pub fn fitted(&self) -> Result<Fitted<'_>, MeasuredError> {
        let (cloud, rim) = (&self.cloud, self.rim.as_slice());
        if cloud.is_empty() {
            Err(MeasuredError::Empty)
        } else {
            Ok(Fitted { cloud, rim })
        }
    }
}

impl Mesh {
    /// Joins equal corners and drops triangles without an area. The order of the triangles does not matter.
    pub fn new(triangles: &[[Point3<f64>; 3]]) -> Result<Self, MeasuredError> {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for (index, corner) in triangles
            .iter()
            .enumerate()
            .flat_map(|(k, t)| t.iter().map(move |c| (k, c)))
        {
            if corner.iter().any(|c| !is_coordinate(*c)) {
                let (what, found) = ("triangle", [corner.x, corner.y, corner.z]);
                return Err(MeasuredError::Coordinate { what, index, found });
            }
            for axis in 0..3 {
                low[axis] = low[axis].min(corner[axis]);
                high[axis] = high[axis].max(corner[axis]);
            }
        }
        let extent = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
        if extent <= 0.0 {
            return Err(MeasuredError::Empty);
        }
        let middle = Vector3::from_fn(|k, _| 0.5 * (low[k] + high[k]));
        let part = |k: usize, by: f64, corner: &Point3<f64>| {
            let share = (corner[k] - middle[k]) / extent + by;
            ((share * CELLS).round() + 0.5 * (CELLS + 5.0)) as u64
        };
        // The cells of the corners of a small box around a corner: mostly one and the same.
        let cells = |corner: &Point3<f64>| {
            let ends = [0, 1, 2].map(|k| [part(k, -SAME, corner), part(k, SAME, corner)]);
            (0..8).map(move |way: usize| ends[0][way & 1] << 42 | ends[1][way >> 1 & 1] << 21 | ends[2][way >> 2])
        };
        let mut corners: Vec<(u64, u32)> = Vec::with_capacity(3 * triangles.len());
        for (k, corner) in (0..).zip(triangles.iter().flatten()) {
            let mut before = None;
            for cell in cells(corner).filter(|cell| before.replace(*cell) != Some(*cell)) {
                corners.push((cell, k));
            }
        }
        corners.sort_unstable();
        let mut joined: Vec<u32> = (0..3 * triangles.len() as u32).collect();
        for pair in corners.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
            join(&mut joined, [pair[0].1, pair[1].1]);
        }
        let (mut points, mut vertex) = (Vec::new(), vec![u32::MAX; joined.len()]);
        for (_, k) in corners {
            let root = root(&mut joined, k) as usize;
            if vertex[root] == u32::MAX {
                points.push(triangles[root / 3][root % 3].coords - middle);
                vertex[root] = points.len() as u32 - 1;
            }
            vertex[k as usize] = vertex[root];
        }
        let ordered = |t: &[u32]| match t.iter().min() {
            Some(least) if *least == t[1] => [t[1], t[2], t[0]],
            Some(least) if *least == t[2] => [t[2], t[0], t[1]],
            _ => [t[0], t[1], t[2]],
        };
        let is_triangle = |t: &[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
        let mut triangles: Vec<_> = vertex.chunks_exact(3).map(ordered).filter(is_triangle).collect();
        triangles.sort_unstable();
        triangles.dedup();
        let mut mesh = Self {
            middle,
            points,
            triangles,
            net: Vector3::zeros(),
            volume: 0.0,
        };
        for t in &mesh.triangles {
            mesh.net += mesh.normal(t);
            mesh.volume += mesh.normal(t).dot(&mesh.points[t[0] as usize]);
        }
        match mesh.moments().size > 0.0 {
            true => Ok(mesh),
            false => Err(MeasuredError::Empty),
        }
    }

    /// Changes the unit: lengths are multiplied.
    pub fn scale(&mut self, by: f64) {
        self.points.iter_mut().for_each(|point| *point *= by);
        self.net *= by * by;
        self.volume *= by * by * by;
    }

    fn corners(&self, t: &[u32; 3]) -> [Vector3<f64>; 3] {
        t.map(|k| self.points[k as usize])
    }

    /// Normal of a triangle, as long as its area.
    fn normal(&self, t: &[u32; 3]) -> Vector3<f64> {
        let [a, b, c] = self.corners(t);
        (b - a).cross(&(c - a)) * 0.5
    }

    /// Returns the moments of the surface.
    pub fn moments(&self) -> Moments {
        let weighted = self.triangles.iter().flat_map(|t| {
            let [a, b, c] = self.corners(t);
            let area = self.normal(t).norm();
            // The middles of the edges have a triangle's moments up to the second.
            [a + b, b + c, c + a].map(|sum| (0.5 * sum, area))
        });
        Moments::from_points(|| weighted.clone())
    }

    /// Share of the area seen along an axis by which both sides differ: 0 for a closed mesh, 1 for a face alone.
    fn openness(&self, axis: &Vector3<f64>) -> f64 {
        let seen: f64 = self.triangles.iter().map(|t| self.normal(t).dot(axis).abs()).sum();
        self.net.dot(axis).abs() / seen.max(f64::MIN_POSITIVE)
    }

    /// True if the whole body was measured.
    pub fn is_closed(&self, axis: &Vector3<f64>) -> bool {
        self.openness(axis) < OPEN
    }

    /// 1 or −1: factor that turns normals to the outside, or up if only the face was measured.
    fn side(&self, axis: &Vector3<f64>) -> f64 {
        let is_face = self.openness(axis) > 0.5;
        let outwards = if is_face { self.net.dot(axis) } else { self.volume };
        if outwards < 0.0 { -1.0 } else { 1.0 }
    }

    /// Height of the rim over the pole, roughly, of the side that looks along the frame's axis \[m\].
    pub fn rise_m(&self, frame: &Frame, rim_m: f64) -> f64 {
        let axis = frame.axis();
        let side = self.side(&axis);
        let mut sums = [[0.0; 2]; 2];
        for t in &self.triangles {
            let up = side * self.normal(t).dot(&axis);
            let [a, b, c] = self.corners(t);
            let middle = frame.local(&((a + b + c) / 3.0));
            let share = middle.xy().norm() / rim_m;
            if up > 0.0 && !(0.3..0.75).contains(&share) {
                let sum = &mut sums[usize::from(share > 0.5)];
                *sum = [sum[0] + up, sum[1] + up * middle.z];
            }
        }
        let [inner, outer] = sums.map(|[area, moment]| if area > 0.0 { moment / area } else { 0.0 });
        outer - inner
    }

    /// Returns the face that looks along the frame's axis: the facets that face up, in pieces that nothing covers.
    pub fn face(&self, frame: &Frame, fit: Fit) -> Face {
        let axis = frame.axis();
        let side = self.side(&axis);
        let area = |t: &[u32; 3]| side * self.normal(t).dot(&axis);
        let is_up = |t: &&[u32; 3]| area(t) > UP * self.normal(t).norm();
        let up: Vec<[u32; 3]> = self.triangles.iter().filter(is_up).copied().collect();
        let pieces = self.pieces(&up);
        let mut areas = vec![0.0; self.points.len()];
        let mut widest: Vec<Option<[u32; 3]>> = vec![None; self.points.len()];
        for t in &up {
            let piece = pieces[t[0] as usize] as usize;
            areas[piece] += area(t);
            if widest[piece].is_none_or(|before| area(t) > area(&before)) {
                widest[piece] = Some(*t);
            }
        }
        let total: f64 = areas.iter().sum();
        let is_face = |piece: usize| {
            let shown = widest[piece].filter(|_| areas[piece] >= LEAST_PIECE * total);
            shown.is_some_and(|t| !self.is_covered(&t, frame))
        };
        let face: Vec<bool> = (0..areas.len()).map(is_face).collect();
        let facets: Vec<_> = up
            .into_iter()
            .filter(|t| face[pieces[t[0] as usize] as usize])
            .collect();
        // What is fitted ends at the lip.
        let smooth: Vec<_> = facets.iter().filter(|t| !self.is_lip(t, frame)).collect();
        let mut weights = vec![0.0; self.points.len()];
        for t in &smooth {
            t.iter().for_each(|k| weights[*k as usize] += area(t) / 3.0);
        }
        let vertices = || (0..).zip(&weights).filter(|(_, weight)| **weight > 0.0);
        let corners = corners(vertices().map(|(k, _): (usize, _)| self.points[k]), frame);
        let mut cloud: Cloud = match fit {
            Fit::Vertices => vertices().map(|(k, weight)| (self.points[k], *weight)).collect(),
            Fit::Surface => {
                let all: f64 = smooth.iter().map(|t| area(t)).sum();
                let mut sequence = (0..).map(|k| EVENLY.map(|step| (f64::from(k) * step).fract()));
                let mut samples = Cloud::new();
                for t in &smooth {
                    let [a, b, c] = self.corners(t);
                    let count = (area(t) / all * SAMPLES).ceil().max(1.0);
                    let places = sequence.by_ref().take(count as usize);
                    // Over the parallelogram of two edges, folded onto the triangle.
                    samples.extend(places.map(|[u, v]: [f64; 2]| {
                        let [u, v] = if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] };
                        (a + (b - a) * u + (c - a) * v, area(t) / count)
                    }));
                }
                samples
            }
        };
        let every = cloud.len() / ENOUGH + 1;
        if every > 1 {
            cloud = cloud.into_iter().step_by(every).collect();
        }
        Face {
            cloud,
            rim: outermost(corners.into_iter(), frame, SECTORS),
            facets,
        }
    }

    /// True if a facet that faces up falls outwards as steeply as the lip.
    #[inline(never)]
    pub fn is_lip(&self, t: &[u32; 3], frame: &Frame) -> bool {
        let [a, b, c] = self.corners(t).map(|corner| frame.local(&corner));
        let (normal, middle) = ((b - a).cross(&(c - a)), a + b + c);
        let outwards = normal.xy().dot(&middle.xy()) / middle.xy().norm().max(f64::MIN_POSITIVE);
        outwards * normal.z.signum() > LIP * normal.z.abs()
    }

    /// For each vertex, the least vertex of the piece that it belongs to; facets with a common vertex are of one piece.
    fn pieces(&self, facets: &[[u32; 3]]) -> Vec<u32> {
        let mut of: Vec<u32> = (0..self.points.len() as u32).collect();
        for t in facets {
            join(&mut of, [t[0], t[1]]);
            join(&mut of, [t[1], t[2]]);
        }
        for k in 0..of.len() {
            of[k] = of[of[k] as usize];
        }
        of
    }

    /// True if another triangle lies above the middle of a facet.
    fn is_covered(&self, facet: &[u32; 3], frame: &Frame) -> bool {
        let [a, b, c] = self.corners(facet).map(|corner| frame.local(&corner));
        let middle = (a + b + c) / 3.0;
        let mut others = self.triangles.iter().filter(|t| *t != facet);
        others.any(|t| {
            let corners = self.corners(t).map(|corner| frame.local(&corner));
            height_at(&corners, [middle.x, middle.y]).is_some_and(|z| z > middle.z)
        })
    }
}

/// Returns the least member of the group that `k` is in; `of` leads from each member to another one, or to itself.
fn root(of: &mut [u32], mut k: u32) -> u32 {
    while of[k as usize] != k {
        of[k as usize] = of[of[k as usize] as usize];
        k = of[k as usize];
    }
    k
}

/// Joins the groups of two members.
fn join(of: &mut [u32], pair: [u32; 2]) {
    let [a, b] = pair.map(|k| root(of, k));
    of[a.max(b) as usize] = a.min(b);
}
