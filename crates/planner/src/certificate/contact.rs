//! How fast the sponge touches a plate: its rim, while it comes down and while it leaves.
//!
//! Tilted by τ, the rim of a sponge of radius s reaches s sin τ below the tip, so that it meets the plate's face while the tip is still
//! on its way. Every point of the rim that is at or below the face counts, over the plate or beside it:
//!
//! - The lowest of them is at H = p_z − s ‖a_xy‖, with p the tip and a the tool's axis. H ≥ min of its values at the ends of a stretch less
//!   h²/8 (sup ‖p̈‖ + s sup ‖ä‖): H is the least of functions p_z + s d·a_xy, one for each horizontal direction d.
//! - What is at or below the face, of the rim and of the side wall over it, is within ρ = s / cos τ of the tip, wherever the tip is at
//!   the face or above it. Such a point r moves at v + ω × r, no faster than G, G² = ‖v‖² + 2 ρ ‖v × ω‖ + ρ² ‖ω‖²: v·(ω × r) = r·(v × ω).
//!   Each is carried by the arm, so that over a stretch no point is faster than the greater G at its ends plus h²/8 (sup ‖p⃛‖ + ρ sup ‖a⃛‖).
//!
//! Stretches in which H stays above the face count for nothing; the others are halved like those of every quantity (`watch.rs`).

use super::piece::Piece;
use super::promise::{Promise, PromiseName, Unit, Worst};
use super::schedule::{Schedule, Stage};
use super::tip::{Arm, Derivatives, Moment, Stretch};
use super::tips::{self, Tips};
use super::watch::Watch;
use crate::plan::{Plan, PlanLimits};
use crate::tool_path::SegmentKind;
use nalgebra::Vector3;

/// How far the bound of the speed may be above the greatest one found, as a part of the limit.
const RESOLUTION: f64 = 2e-3;

/// What a height may be wrong by \[m\].
const ROUNDING_M: f64 = 1e-9;

/// The sponge over the face of a plate.
#[derive(Debug, Clone, Copy)]
struct Face {
    /// Radius of the sponge \[m\].
    radius_m: f64,
    /// ρ \[m\].
    reach_m: f64,
    /// Height of the tip at which an upright sponge meets the face \[m\]: that of the face, as the tip is the middle of the sponge's
    /// far face. A sponge that is compressed while it washes will meet it higher up by its compression.
    meets_m: f64,
}

impl Face {
    /// H over the height at which it meets \[m\].
    fn height(&self, m: &Moment) -> f64 {
        m.position.z - self.radius_m * m.axis.xy().norm() - self.meets_m
    }

    /// What the height over a stretch is not below \[m\].
    fn at_least(&self, stretch: &Stretch<'_>, bounds: &Derivatives) -> f64 {
        let [from, to] = stretch.ends.each_ref().map(|m| self.height(m));
        let lower = if from < to || from.is_nan() { from } else { to };
        lower - stretch.sag(bounds.second() + self.radius_m * bounds.second_of_axis()) - ROUNDING_M
    }

    /// G: what no point that touches is faster than \[m/s\].
    fn fastest(&self, m: &Moment) -> f64 {
        let (v, w, r) = (m.speed, m.turning, self.reach_m);
        (v.norm_squared() + 2.0 * r * v.cross(&w).norm() + r * r * w.norm_squared()).sqrt()
    }

    /// What no point that touches is faster than anywhere in a stretch \[m/s\].
    fn at_most(&self, stretch: &Stretch<'_>, bounds: &Derivatives) -> f64 {
        let [from, to] = stretch.ends.each_ref().map(|m| self.fastest(m));
        let greater = if from > to || from.is_nan() { from } else { to };
        greater + stretch.sag(bounds.third() + self.reach_m * bounds.third_of_axis())
    }

    /// The lowest point of the rim, from the tip \[m\]; the tip itself where all points are equally low.
    fn lowest(&self, m: &Moment) -> Vector3<f64> {
        let a = &m.axis;
        // −z less its part along the axis, written so that nothing cancels when the axis is nearly upright.
        let down = Vector3::new(a.x * a.z, a.y * a.z, -a.xy().norm_squared());
        down.try_normalize(0.0)
            .map_or_else(Vector3::zeros, |d| d * self.radius_m)
    }

    /// Takes note of the lowest point's speed at a moment at which it touches.
    fn see(&self, watch: &mut Watch, m: &Moment, time_s: f64) {
        let r = self.lowest(m);
        let speed = (m.speed + m.turning.cross(&r)).norm();
        let mut there = *m;
        there.position += r;
        watch.see(speed, time_s, &there);
    }
}

/// The speed of the sponge's rim wherever it is at or below the face of a plate that it comes down on or leaves. The limit is that of
/// washing: the sponge touches no faster than it washes.
pub(super) fn promise(
    arm: &Arm<'_>,
    plan: &Plan,
    limits: &PlanLimits,
    (pieces, schedule): (&[Piece], Option<&Schedule>),
    tips: &Tips,
) -> Promise {
    let Some(schedule) = schedule else {
        return Promise::not_judged(PromiseName::ContactSpeed);
    };
    let limit = limits.wash_speed_m_s;
    let mut watch = Watch::new(limit, RESOLUTION * limit);
    let touching = |stage: &Stage| matches!(stage.kind, SegmentKind::Approach | SegmentKind::Retreat);
    let stages = || schedule.stages.iter().enumerate().filter(|(_, stage)| touching(stage));
    // A plate that is not there is found elsewhere.
    let radius_m = plan.scenario.tool.sponge_radius_m;
    let face = |index: usize, stage: &Stage| {
        plan.plates.get(stage.plate).map(|plate| Face {
            radius_m,
            reach_m: radius_m / tips.least_cosine_of(index),
            meets_m: plate.z_m,
        })
    };
    watch.allow_for(stages().map(|(_, stage)| stage.pieces.len()).sum());
    // Nothing that touches is fast: so it is until something is seen, and for good where nothing touches.
    watch.seen = 0.0;
    watch.take(0.0);
    let over = || stages().filter_map(|(i, stage)| Some((face(i, stage)?, &pieces[stage.pieces.clone()])));
    for (face, pieces) in over() {
        look(arm, &face, pieces, &mut watch);
    }
    for (face, pieces) in over() {
        for piece in pieces {
            halve(arm, &face, &arm.stretch(piece), &mut watch, 0);
        }
    }
    let worst = if watch.seen > 0.0 {
        tips::worst(&watch, pieces, Some(schedule))
    } else {
        Worst::default()
    };
    tips::promise(PromiseName::ContactSpeed, &watch, (limit, Unit::MetrePerSecond), worst)
}

/// Sees both ends of all pieces.
fn look(arm: &Arm<'_>, face: &Face, pieces: &[Piece], watch: &mut Watch) {
    for stretch in pieces.iter().map(|piece| arm.stretch(piece)) {
        for (moment, time_s) in stretch.ends.iter().zip(stretch.times()) {
            if face.height(moment) <= 0.0 {
                face.see(watch, moment, time_s);
            }
        }
    }
}

fn halve(arm: &Arm<'_>, face: &Face, stretch: &Stretch<'_>, watch: &mut Watch, depth: u32) {
    let bounds = arm.derivatives(stretch);
    if face.at_least(stretch, &bounds) > 0.0 {
        return;
    }
    let bound = face.at_most(stretch, &bounds);
    if watch.accepts(bound) || !watch.may_split(depth) {
        return watch.take(bound);
    }
    let Some(halves) = arm.halves(stretch) else {
        return watch.take(bound);
    };
    let there = &halves[0].ends[1];
    if face.height(there) <= 0.0 {
        face.see(watch, there, halves[0].times()[1]);
    }
    for half in &halves {
        halve(arm, face, half, watch, depth + 1);
    }
}
