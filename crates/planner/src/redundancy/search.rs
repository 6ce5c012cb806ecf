//! Tilts along a wash path by a shortest path through a layered graph.
//!
//! Layers are contact points about [`SPACING_M`] apart; the vertices of a layer are tilts at most [`TILT_STEP_RAD`] apart
//! that are reachable on one branch of the arm, within the limits and clear. An edge joins equal or neighbouring tilts of
//! neighbouring layers, if no joint moves by more than 0.35 rad per 5 mm. It costs
//!
//! `Σ_i |Δq_i| + h (w_τ ((τ − τ*)/2°)² + w_l m² + w_c c) + w_Δ |Δτ|`
//!
//! with h the spacing over 5 mm, τ* the tilt of the sloping policy, m the worst joint's lack of [`AMPLE_MARGIN_RAD`] from
//! a limit as a share of it, and c one where the clearance is less than ample. What is near a singularity costs joint
//! travel. The policy is in it because steps of 2° are too coarse to find by themselves the slow turn of the tool that
//! saves joint travel; near the policy, smoothing finds it again.
//!
//! The graph has no cycles, so one pass forward finds the least cost of every vertex (Bellman 1957).

use crate::placed_arm::tilt_policy::GENTLE_TILT_RAD;
use crate::placed_arm::{Contact, Start, TiltPolicy};
use crate::redundancy::task::{Task, check_step};
use platewash_kinematics::{AXES, JointVector};
use platewash_workcell::cancel::Cancelled;

/// Distance of neighbouring layers along the wash path, at most \[m\].
pub(crate) const SPACING_M: f64 = 5e-3;

/// Difference of neighbouring tilts, at most \[rad\]: 2°. With the spacing it bounds how fast the tilt changes.
pub(crate) const TILT_STEP_RAD: f64 = std::f64::consts::PI / 90.0;

/// The most layers that a survey looks at: every one of a wash path of 3 m, so that a share is known to a fraction of a percent.
const MOST_SURVEYED: usize = 600;

/// This far from its limits a joint costs nothing more \[rad\].
const AMPLE_MARGIN_RAD: f64 = 0.2;

/// w_τ, w_l, w_c \[rad\] and w_Δ.
const WEIGHTS: [f64; 4] = [2e-2, 2e-2, 1e-2, 0.05];

/// The layers and the tilts of a search.
#[derive(Debug, Clone)]
pub(crate) struct Graph {
    /// θ of the layers \[rad\].
    pub theta: Vec<f64>,
    /// Distance of the layers along the wash path \[m\].
    pub spacing_m: f64,
    /// Tilts, ascending, 0 in the middle \[rad\].
    pub tilts: Vec<f64>,
    /// τ*.
    preferred: TiltPolicy,
}

/// A path through the graph.
#[derive(Debug, Clone)]
pub(crate) struct GraphPath {
    /// Index of the tilt, per layer.
    pub tilt: Vec<usize>,
    /// Range of feasible tilts around it without a gap, per layer \[rad\].
    pub ranges: Vec<[f64; 2]>,
    /// The configuration at the first layer \[rad\].
    pub first: JointVector,
}

/// A feasible configuration.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Vertex {
    pub q: JointVector,
    /// Cost of being here, and of the best path here \[rad\].
    own: f64,
    total: f64,
    /// Index of the tilt before it; there are fewer than a hundred.
    from: u16,
}

/// Vertices of a layer, by tilt.
type Layer = Vec<Option<Vertex>>;

/// Part of a layer that the trace back needs: for every vertex, the index of the tilt before it. On a long wash path it is much
/// smaller than the vertices themselves.
type Trail = Vec<Option<u16>>;

impl Graph {
    pub fn new(task: &Task<'_>) -> Self {
        let tilt_max_rad = task.tilt_max_rad();
        let centre_m = task.placed.distance(&task.centre().point);
        let gentle = tilt_max_rad.min(GENTLE_TILT_RAD);
        let pieces = (task.samples.whole_m() / SPACING_M).ceil().max(1.0);
        let steps = (tilt_max_rad / TILT_STEP_RAD).ceil();
        let step = if steps > 0.0 { tilt_max_rad / steps } else { 0.0 };
        let steps = steps as i32;
        Self {
            theta: task.samples.evenly(pieces as usize + 1),
            spacing_m: task.samples.whole_m() / pieces,
            tilts: (-steps..=steps).map(|k| step * f64::from(k)).collect(),
            preferred: TiltPolicy::sloping(gentle, centre_m, task.path.curve.radius_m),
        }
    }

    /// Indices of layers for a survey: all, or of very many an even choice.
    pub fn surveyed(&self) -> impl ExactSizeIterator<Item = usize> + use<> {
        let count = self.theta.len();
        (0..count).step_by(count.div_ceil(MOST_SURVEYED))
    }

    /// The cheapest path on the branch of `start`; or the index of the first layer that no path reaches.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn cheapest(&self, task: &Task<'_>, start: &Start) -> Result<Result<GraphPath, usize>, Cancelled> {
        let mut trails: Vec<Trail> = Vec::with_capacity(self.theta.len());
        let (mut first, mut last): (Layer, Option<Layer>) = (Layer::new(), None);
        for k in 0..self.theta.len() {
            task.placed.check_cancelled()?;
            let mut layer = self.layer(task, k, last.as_ref(), start);
            if k == 0 || k + 1 == self.theta.len() {
                self.remove_vertices_without_line(task, k, &mut layer, start);
            }
            match &last {
                Some(before) => self.connect(task, before, &mut layer),
                None => first.clone_from(&layer),
            }
            if layer.iter().all(Option::is_none) {
                return Ok(Err(k));
            }
            trails.push(layer.iter().map(|slot| slot.map(|vertex| vertex.from)).collect());
            last = Some(layer);
        }
        let path = self.trace(&trails, &first, &last.unwrap_or_default());
        Ok(path.ok_or(self.theta.len() - 1))
    }

    /// The vertices of a layer, each continued from its neighbours in the layer before or from the tilt below.
    pub fn layer(&self, task: &Task<'_>, k: usize, before: Option<&Layer>, start: &Start) -> Layer {
        let contact = task.samples.at(self.theta[k]);
        let preferred = self.preferred.tilt(task.placed.distance(&contact.point));
        let mut layer: Layer = Vec::with_capacity(self.tilts.len());
        for (j, &tilt) in self.tilts.iter().enumerate() {
            let of = |layer: &Layer, j: usize| layer.get(j).copied().flatten();
            let known = before
                .and_then(|b| of(b, j).or_else(|| of(b, j + 1)).or_else(|| of(b, j.wrapping_sub(1))))
                .or_else(|| of(&layer, j.wrapping_sub(1)));
            let near = Start {
                q: known.map_or(start.q, |vertex| vertex.q),
                sides: start.sides,
            };
            let target = task.placed.tip_rigid(&contact, tilt);
            let stands = task.check_cone(&contact, &target).is_ok();
            let q = stands
                .then(|| task.placed.inverse.continuing(&target, &near).ok())
                .flatten();
            let off = (tilt - preferred) / TILT_STEP_RAD;
            layer.push(q.and_then(|q| self.vertex(task, q, off)));
        }
        layer
    }

    /// Removes the vertices of an end of the wash path over which there is no approach or retreat line.
    fn remove_vertices_without_line(&self, task: &Task<'_>, k: usize, layer: &mut Layer, start: &Start) {
        let contact = task.samples.at(self.theta[k]);
        for (slot, &tilt) in layer.iter_mut().zip(&self.tilts) {
            if slot.is_some_and(|vertex| !task.has_line(&contact, tilt, &vertex.q, start)) {
                *slot = None;
            }
        }
    }

    /// Returns the tilts, those closest to the preferred tilt of a contact point first \[rad\].
    pub fn tilts_by_preference(&self, task: &Task<'_>, contact: &Contact) -> Vec<f64> {
        let preferred = self.preferred.tilt(task.placed.distance(&contact.point));
        let mut tilts = self.tilts.clone();
        tilts.sort_by(|a, b| (a - preferred).abs().total_cmp(&(b - preferred).abs()));
        tilts
    }

    /// The feasible configuration of the least tilt of a layer, continued from `start`.
    pub fn least_tilt(&self, task: &Task<'_>, k: usize, start: &Start) -> Option<JointVector> {
        let contact = task.samples.at(self.theta[k]);
        let inverse = &task.placed.inverse;
        let at = |&tilt: &f64| {
            let target = task.placed.tip_rigid(&contact, tilt);
            task.check_cone(&contact, &target).ok()?;
            let q = inverse.continuing(&target, start).ok()?;
            task.is_allowed(&q).then_some(q)
        };
        self.tilts.iter().find_map(at)
    }

    /// A vertex at `q`, if it is clear; `off` is how many steps of 2° its tilt is off the preferred one.
    fn vertex(&self, task: &Task<'_>, q: JointVector, off: f64) -> Option<Vertex> {
        task.check_wrist(&q).ok()?;
        let room = task.check_room(&q).ok()?;
        let [for_tilt, for_limit, for_clearance, _] = WEIGHTS;
        let margin = task.placed.robot.limits().margins(&q).min();
        let lack = (1.0 - margin / AMPLE_MARGIN_RAD).max(0.0);
        let cost = for_tilt * off * off + for_limit * lack * lack + if room { 0.0 } else { for_clearance };
        let own = cost * self.spacing_m / SPACING_M;
        Some(Vertex {
            q,
            own,
            total: own,
            from: 0,
        })
    }

    /// Finds the best path to each vertex and removes those without one.
    fn connect(&self, task: &Task<'_>, before: &Layer, layer: &mut Layer) {
        let [.., for_change] = WEIGHTS;
        for (j, slot) in layer.iter_mut().enumerate() {
            let Some(vertex) = slot else { continue };
            let mut best: Option<(f64, usize)> = None;
            for i in [Some(j), j.checked_sub(1), Some(j + 1)].into_iter().flatten() {
                let Some(from) = before.get(i).copied().flatten() else {
                    continue;
                };
                if check_step(&from.q, &vertex.q, self.spacing_m).is_err()
                    || task.check_side(&from.q, &vertex.q).is_err()
                {
                    continue;
                }
                let travel: f64 = (0..AXES).map(|joint| (vertex.q[joint] - from.q[joint]).abs()).sum();
                let change = (self.tilts[i] - self.tilts[j]).abs();
                let total = from.total + travel + for_change * change + vertex.own;
                if best.is_none_or(|(least, _)| total < least) {
                    best = Some((total, i));
                }
            }
            *slot = best.map(|(total, from)| Vertex {
                total,
                from: from as u16,
                ..*vertex
            });
        }
    }

    /// Back from the cheapest vertex of the last layer to the first.
    fn trace(&self, trails: &[Trail], first: &Layer, last: &Layer) -> Option<GraphPath> {
        let cost = |slot: &Option<Vertex>| slot.map_or(f64::INFINITY, |vertex| vertex.total);
        let mut j = (0..last.len()).min_by(|&a, &b| cost(&last[a]).total_cmp(&cost(&last[b])))?;
        let (mut tilt, mut ranges) = (Vec::with_capacity(trails.len()), Vec::with_capacity(trails.len()));
        for (k, trail) in trails.iter().enumerate().rev() {
            let from = trail[j]?;
            tilt.push(j);
            ranges.push(self.range(trail, j));
            if k > 0 {
                j = usize::from(from);
            }
        }
        tilt.reverse();
        ranges.reverse();
        let first = first[j]?.q;
        Some(GraphPath { tilt, ranges, first })
    }

    /// Range of feasible tilts around index `j` without a gap \[rad\].
    fn range(&self, layer: &Trail, j: usize) -> [f64; 2] {
        let least = layer[..j].iter().rposition(Option::is_none).map_or(0, |gap| gap + 1);
        let most = layer[j..]
            .iter()
            .position(Option::is_none)
            .map_or(layer.len(), |gap| j + gap)
            - 1;
        [self.tilts[least], self.tilts[most]]
    }
}
