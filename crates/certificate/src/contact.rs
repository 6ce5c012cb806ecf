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
//! Stretches in which H stays above the face count for nothing; the others are halved like those of every quantity (`bound_tracker.rs`).

use crate::bound_tracker::BoundTracker;
use crate::check::{Check, Unit, Worst};
use crate::face::Face;
use crate::piece::Piece;
use crate::requirement::Requirement;
use crate::schedule::{Schedule, Span};
use crate::subject::Subject;
use crate::tip::{Arm, Derivatives, Moment, Stretch};
use crate::tip_limits::{self, Tips};
use platewash_workcell::segment::SegmentKind;

/// How far the bound of the speed may be above the greatest one found, as a part of the limit.
const RESOLUTION: f64 = 2e-3;

/// What a height may be wrong by \[m\].
const ROUNDING_M: f64 = 1e-9;

/// The sponge over the face of a plate. It meets the face where its rim does, as the tip is the middle of its far face: a sponge that is
/// compressed while it washes will meet it higher up by its compression.
#[derive(Debug, Clone, Copy)]
struct Rim {
    face: Face,
    /// Radius of the sponge \[m\].
    radius_m: f64,
    /// ρ \[m\].
    reach_m: f64,
}

impl Rim {
    /// H over the face \[m\].
    fn height(&self, m: &Moment) -> f64 {
        self.face.height_of_rim(&m.position, &m.axis, self.radius_m)
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

    /// Takes note of the lowest point's speed at a moment at which it touches.
    fn see(&self, tracker: &mut BoundTracker, m: &Moment, time_s: f64) {
        let r = self.face.lowest(&m.axis, self.radius_m);
        let speed = (m.speed + m.turning.cross(&r)).norm();
        let mut there = *m;
        there.position += r;
        tracker.see(speed, time_s, &there);
    }
}

/// The speed of the sponge's rim wherever it is at or below the face of a plate that it comes down on or leaves. The limit is that of
/// washing: the sponge touches no faster than it washes.
pub(crate) fn check(
    arm: &Arm<'_>,
    subject: &Subject<'_>,
    (pieces, schedule): (&[Piece], Option<&Schedule>),
    tips: &Tips,
) -> Check {
    let Some(schedule) = schedule else {
        return Check::not_judged(Requirement::ContactSpeed);
    };
    let limit = subject.limits.wash_speed_m_s;
    let mut tracker = BoundTracker::new(limit, RESOLUTION * limit);
    let touching = |span: &Span| matches!(span.kind, SegmentKind::Approach | SegmentKind::Retreat);
    let spans = || schedule.spans.iter().enumerate().filter(|(_, span)| touching(span));
    // A plate that is not there is found elsewhere.
    let radius_m = subject.sponge_m();
    let rim = |index: usize, span: &Span| {
        subject.plates().get(span.plate).map(|plate| Rim {
            face: Face::of(plate),
            radius_m,
            reach_m: radius_m / tips.least_cosine_of(index),
        })
    };
    tracker.allow_for(spans().map(|(_, span)| span.pieces.len()).sum());
    // Nothing that touches is fast: so it is until something is seen, and for good where nothing touches.
    tracker.seen = 0.0;
    tracker.take(0.0);
    let over = || spans().filter_map(|(i, span)| Some((rim(i, span)?, &pieces[span.pieces.clone()])));
    for (rim, pieces) in over() {
        look(arm, &rim, pieces, &mut tracker);
    }
    for (rim, pieces) in over() {
        for piece in pieces {
            halve(arm, &rim, &arm.stretch(piece), &mut tracker, 0);
        }
    }
    let worst = if tracker.seen > 0.0 {
        tip_limits::worst(&tracker, pieces, Some(schedule))
    } else {
        Worst::default()
    };
    tip_limits::check(
        Requirement::ContactSpeed,
        &tracker,
        (limit, Unit::MetrePerSecond),
        worst,
    )
}

/// Sees both ends of all pieces.
fn look(arm: &Arm<'_>, rim: &Rim, pieces: &[Piece], tracker: &mut BoundTracker) {
    for stretch in pieces.iter().map(|piece| arm.stretch(piece)) {
        for (moment, time_s) in stretch.ends.iter().zip(stretch.times()) {
            if rim.height(moment) <= 0.0 {
                rim.see(tracker, moment, time_s);
            }
        }
    }
}

fn halve(arm: &Arm<'_>, rim: &Rim, stretch: &Stretch<'_>, tracker: &mut BoundTracker, depth: u32) {
    let bounds = arm.derivatives(stretch);
    if rim.at_least(stretch, &bounds) > 0.0 {
        return;
    }
    let bound = rim.at_most(stretch, &bounds);
    if tracker.accepts(bound) || !tracker.may_split(depth) {
        return tracker.take(bound);
    }
    let Some(halves) = arm.halves(stretch) else {
        return tracker.take(bound);
    };
    let there = &halves[0].ends[1];
    if rim.height(there) <= 0.0 {
        rim.see(tracker, there, halves[0].times()[1]);
    }
    for half in &halves {
        halve(arm, rim, half, tracker, depth + 1);
    }
}
