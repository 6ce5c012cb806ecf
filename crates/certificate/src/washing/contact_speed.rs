//! Contact speed: the speed of any point of the sponge that touches a plate while it comes down or leaves.
//!
//! Requirement 21, formulas (21.1) and (21.2) in `docs/certificate.md`.
//!
//! Where a job states how fast it may land, or lift off, the free sponge counts: its face lies beyond the tip by its compression, and the
//! plate as much higher as it may lie. Where it states nothing, the face that the sponge has while it washes counts, and it touches no
//! faster than it washes. Stretches in which nothing touches count for nothing; the others are halved like those of every quantity
//! (`motion/bound_tracker.rs`).
//!
//! The sponge over the face of a plate that it comes down on or leaves: contact or no contact, and a bound of the contact speed.
//!
//! Its far face lies b beyond the tip: b = 0 for the one that it has while it washes, b = c for the free one.
//!
//! - Over a disc the lowest point of its rim is at H = p_z + b a_z − s ‖a_xy‖, with p the tip and a the tool's axis. H ≥ min of its
//!   values at the ends of a stretch less h²/8 (sup ‖p̈‖ + (b + s) sup ‖ä‖): H is the least of functions p_z + b a_z + s d·a_xy, one for
//!   each horizontal direction d. Over other faces it does not touch where no column of its far face is compressed (`contact/plate_load.rs`).
//! - What touches is a point of the sponge: within ρ = s / cos τ of the tip where b = 0 on a disc, wherever the tip is at the face or
//!   above it; the free one reaches b beyond the tip, and its side wall s tan τ behind it on a disc, elsewhere no more than its height:
//!   ρ² = s² + max(b, s tan τ + tolerance)², or s² + max(b, height)². Such a point r moves at v + ω × r, no faster than G,
//!   G² = ‖v‖² + 2 ρ ‖v × ω‖ + ρ² ‖ω‖²: v·(ω × r) = r·(v × ω). Each is carried by the arm, so that over a stretch no point is faster
//!   than the greater G at its ends plus h²/8 (sup ‖p⃛‖ + ρ sup ‖a⃛‖).
//!
//!   Over other faces that is refined where it does not keep a limit: for every part of the sponge's face that may touch in a stretch the
//!   points along the axis where it may, at both ends, and all within the part's reach of them.
//!
//! A plate that may lie higher touches earlier: H less the error of its height.

use crate::judged_job::JudgedJob;
use crate::motion::bound_tracker::BoundTracker;
use crate::motion::piece::Piece;
use crate::motion::tip::{Arm, Derivatives, Moment, Stretch, TipPiece};
use crate::motion::tip_limits::{self, Tips};
use crate::plan_statements::schedule::{Schedule, Span};
use crate::report::check::{Check, Discrepancy, WorstCase, tighter};
use crate::report::requirement::Requirement;
use crate::report::unit::Unit;
use crate::washing::face::Face;
use crate::washing::instants;
use nalgebra::Vector3;
use platewash_bodies::contact::{Bends, Columns, Foundation, SpongeState, TouchRegion};
use platewash_kinematics::trig::acos;
use platewash_motion::trajectory::SegmentKind;
use platewash_workcell::job::{LINE_TOLERANCE_M, Recovery};
use platewash_workcell::plate::Plate;
use platewash_workcell::tool::Sponge;
use platewash_workcell::words::{millimetres, plate_name};

/// Gap allowed between the bound of the speed and the greatest speed found, as a part of the limit.
const RESOLUTION: f64 = 2e-3;

/// Limits for the segments of some kinds.
struct ContactSpeedLimit<'a> {
    kinds: &'a [SegmentKind],
    /// Greatest contact speed \[m/s\].
    limit: f64,
    /// True for the free sponge; false for the compressed one.
    is_free: bool,
}

/// Checks that the retreat of a motion home begins and goes on with the sponge at the face that it leaves; `None` for other plans. Behind
/// the plate, or beside it and lower, a way along the normal would lead into it.
pub(crate) fn from_face(
    judged: &JudgedJob<'_>,
    along: &[TipPiece<'_>],
    schedule: Option<&Schedule>,
    tips: &Tips,
) -> Option<Check> {
    let retreat = judged.job.recovery.as_ref().and_then(Recovery::retreat)?;
    let requirement = Requirement::ContactHeight;
    let spans = schedule?.spans.iter().enumerate();
    let (index, span) = spans.clone().find(|(_, span)| span.kind == SegmentKind::Retreat)?;
    let (Some(plate), Some(first)) = (judged.plates().get(retreat.plate), along.get(span.pieces.start)) else {
        return Some(Check::not_judged(requirement));
    };
    // The tip keeps to the line up from where it begins.
    let height_m = plate.height_of(&first.stretch().ends[0].position) - LINE_TOLERANCE_M;
    let cosine = tips.least_upright_cosine_of(index);
    if judged.job.workcell.tool.is_over_face(height_m, cosine) {
        return Some(Check::stated(requirement, Vec::new()));
    }
    let found = format!(
        "the tip {} over its face, the tool up to {:.1}° from the normal",
        millimetres(height_m),
        acos(cosine.clamp(-1.0, 1.0)).to_degrees()
    );
    let expected = "the sponge's upper rim over the face, the tool at most 45° from the normal: only so a way along the normal leads away";
    let what = format!("retreat from {}", plate_name(retreat.plate));
    Some(Check::stated(
        requirement,
        vec![Discrepancy::new(what, found, expected)],
    ))
}

/// Checks the contact speed on every plate that the sponge comes down on or leaves.
pub(crate) fn check(
    arm: &Arm<'_>,
    judged: &JudgedJob<'_>,
    (pieces, along): (&[Piece], &[TipPiece<'_>]),
    schedule: Option<&Schedule>,
    tips: &Tips,
) -> Check {
    let Some(schedule) = schedule else {
        return Check::not_judged(Requirement::ContactSpeed);
    };
    let wanted = &judged.job.requirements;
    let judge_limit = |limit: &ContactSpeedLimit<'_>| judge(arm, judged, (pieces, along), schedule, tips, limit);
    let limit = judged.job.wash_speed_m_s();
    if wanted.landing_m_s.is_none() && wanted.lifting_m_s.is_none() {
        return judge_limit(&ContactSpeedLimit {
            kinds: &[SegmentKind::Approach, SegmentKind::Retreat],
            limit,
            is_free: false,
        });
    }
    let of = |kind, stated: Option<f64>| {
        judge_limit(&ContactSpeedLimit {
            kinds: &[kind],
            limit: stated.map_or(limit, |stated| stated.min(limit)),
            is_free: stated.is_some(),
        })
    };
    tighter(
        of(SegmentKind::Approach, wanted.landing_m_s),
        of(SegmentKind::Retreat, wanted.lifting_m_s),
    )
}

fn judge(
    arm: &Arm<'_>,
    judged: &JudgedJob<'_>,
    (pieces, along): (&[Piece], &[TipPiece<'_>]),
    schedule: &Schedule,
    tips: &Tips,
    touch: &ContactSpeedLimit<'_>,
) -> Check {
    let limit = touch.limit;
    let mut tracker = BoundTracker::new(limit, RESOLUTION * limit);
    let touching = |span: &Span| touch.kinds.contains(&span.kind);
    let spans = || schedule.spans.iter().enumerate().filter(|(_, span)| touching(span));
    // A plate that is not there is found elsewhere.
    let rim = |index: usize, span: &Span| {
        let plate = judged.plates().get(span.plate)?;
        let sponge = &judged.job.workcell.tool.sponge;
        let far = if touch.is_free {
            FarFace {
                beyond_m: sponge.compression_m,
                error_m: judged.job.height_error_of(plate),
            }
        } else {
            FarFace {
                beyond_m: 0.0,
                error_m: plate.deviation_m(),
            }
        };
        Some(Rim::new(plate, sponge, far, tips.least_upright_cosine_of(index)))
    };
    tracker.allow_for(spans().map(|(_, span)| span.pieces.len()).sum());
    // Nothing that touches is fast: so it is until something is seen, and for good where nothing touches.
    tracker.seen = 0.0;
    tracker.take(0.0);
    let over: Vec<_> = spans()
        .filter_map(|(i, span)| Some((rim(i, span)?, &along[span.pieces.clone()])))
        .collect();
    for (rim, pieces) in &over {
        record_speeds(rim, pieces, &mut tracker);
    }
    for (rim, pieces) in &over {
        for piece in *pieces {
            rim.halve(arm, &piece.stretch(), &mut tracker, 0);
        }
    }
    let worst = if tracker.seen > 0.0 {
        tip_limits::worst_case(&tracker, pieces, Some(schedule))
    } else {
        WorstCase::default()
    };
    tip_limits::check(Requirement::ContactSpeed, &tracker, limit, Unit::MetrePerSecond, worst)
}

/// Records the speed at both ends of all pieces.
fn record_speeds(rim: &Rim<'_>, pieces: &[TipPiece<'_>], tracker: &mut BoundTracker) {
    for stretch in pieces.iter().map(TipPiece::stretch) {
        for (moment, time_s) in stretch.ends.into_iter().zip(stretch.times()) {
            rim.see(tracker, moment, time_s);
        }
    }
}

/// Rounding error allowed in a height \[m\].
const HEIGHT_ROUNDING_M: f64 = 1e-9;

/// Greatest depth of halving of a piece once the limit is kept.
const MOST_HALVINGS: u32 = 6;

/// The face of the sponge that counts, free or compressed, and the height error of the plate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FarFace {
    /// Distance b of that face beyond the tip \[m\].
    pub beyond_m: f64,
    /// Height by which a plate may lie above its stated position \[m\].
    pub error_m: f64,
}

/// Sponge over the face of a plate.
#[derive(Debug)]
pub(crate) struct Rim<'a> {
    plate: &'a Plate,
    face: Face<'a>,
    /// Radius of the sponge \[m\].
    radius_m: f64,
    far: FarFace,
    /// Greatest distance ρ of a touching point from the tip \[m\].
    reach_m: f64,
    /// Greatest height of the face over its pole \[m\].
    highest_m: f64,
    /// Columns over a face that is no disc, with the curvature of the face.
    columns: Option<(Columns, Bends<'a>)>,
}

/// Parts of the sponge's face that may touch over a stretch.
struct Parts<'a> {
    columns: &'a Columns,
    region: Vec<TouchRegion>,
}

impl<'a> Rim<'a> {
    /// A sponge over a plate. `far` has b and δ of formula (21.1), `cosine` is a lower bound on cos τ. From both follows ϱ of formula (21.2); on a
    /// profile the height of the sponge takes the place of s tan τ + 1 mm.
    pub fn new(plate: &'a Plate, sponge: &Sponge, far: FarFace, cosine: f64) -> Self {
        let (s, b) = (sponge.radius_m, far.beyond_m);
        let flat = plate.surface.is_flat();
        let behind_m = if flat {
            s * (1.0 - cosine * cosine).max(0.0).sqrt() / cosine + LINE_TOLERANCE_M
        } else {
            sponge.height_m
        };
        let along_m = b.max(behind_m);
        let foundation = Foundation {
            radius_m: s,
            free_height_m: sponge.height_m + b,
            compression_m: b,
            // No force is asked for.
            stiffness_pa: [0.0; 2],
        };
        Self {
            plate,
            face: Face::new(plate),
            radius_m: s,
            far,
            reach_m: if flat && b == 0.0 {
                s / cosine
            } else {
                (s * s + along_m * along_m).sqrt()
            },
            highest_m: plate.surface.height_bounds_m()[1],
            columns: (!flat).then(|| (Columns::fine(&foundation), Bends::new(&plate.surface))),
        }
    }

    /// Returns the centre of the sponge's far face.
    fn middle(&self, m: &Moment) -> Vector3<f64> {
        if self.far.beyond_m == 0.0 {
            m.position
        } else {
            m.position + m.axis * self.far.beyond_m
        }
    }

    fn sponge_state(&self, (columns, bends): &(Columns, Bends<'_>), m: &Moment) -> SpongeState {
        let side = self.plate.pose.inverse_transform_vector(&m.side);
        columns.sponge_state(bends, &instants::pose(self.plate, m), &side, self.far.error_m)
    }

    /// Height H of the lowest point of the rim over a disc \[m\], formula (21.1).
    fn height(&self, m: &Moment) -> f64 {
        self.face.height_of_rim(&self.middle(m), &m.axis, self.radius_m) - self.far.error_m
    }

    /// Checks that no part of the sponge touches anywhere in a stretch over a disc: the bound of H in formula (21.1) is above 0. `bounds` has
    /// sup ‖p̈‖ and sup ‖ä‖.
    fn is_clear(&self, stretch: &Stretch<'_>, bounds: &Derivatives) -> bool {
        let [from, to] = stretch.ends.map(|m| self.height(m));
        let lower = if from < to || from.is_nan() { from } else { to };
        let arm_m = self.far.beyond_m + self.radius_m;
        lower - stretch.sag(bounds.second() + arm_m * bounds.second_of_axis()) - HEIGHT_ROUNDING_M > 0.0
    }

    /// Checks that a face that is no disc is out of reach all through a stretch, by the plate's enclosing cylinder: no touching point is farther
    /// than ϱ from the tip.
    fn is_far(&self, stretch: &Stretch<'_>, bounds: &Derivatives) -> bool {
        let arm_m = self.reach_m + self.far.error_m;
        let [from, to] = stretch.ends.map(|m| {
            let tip = self.plate.local(&m.position);
            (tip.z - self.highest_m).max(tip.xy().norm() - self.plate.rim_m())
        });
        // A maximum of a height and a distance: each moves no faster than the tip.
        let nearer = if from < to || from.is_nan() { from } else { to };
        let [a, b] = stretch.ends.map(|m| m.speed.norm());
        let speed = a.max(b) + stretch.sag(bounds.third());
        nearer - 0.5 * stretch.length_s() * speed - arm_m - HEIGHT_ROUNDING_M > 0.0
    }

    /// Upper bound G on the speed of a touching point at a moment \[m/s\], formula (21.2).
    fn fastest(&self, m: &Moment) -> f64 {
        let (v, w, r) = (m.speed, m.turning, self.reach_m);
        (v.norm_squared() + 2.0 * r * v.cross(&w).norm() + r * r * w.norm_squared()).sqrt()
    }

    /// Upper bound on the speed of a touching point over a stretch \[m/s\], formula (21.2). `bounds` has sup ‖p⃛‖ and sup ‖a⃛‖.
    fn at_most(&self, stretch: &Stretch<'_>, bounds: &Derivatives) -> f64 {
        let [from, to] = stretch.ends.map(|m| self.fastest(m));
        let greater = if from > to || from.is_nan() { from } else { to };
        greater + stretch.sag(bounds.third() + self.reach_m * bounds.third_of_axis())
    }

    /// Upper bound on the speed of a point of the touching parts over a stretch \[m/s\]: formula (21.2), refined part by part. `bounds` has
    /// sup ‖p⃛‖ and sup ‖a⃛‖.
    fn at_most_of(&self, parts: &Parts<'_>, stretch: &Stretch<'_>, bounds: &Derivatives) -> f64 {
        let reach_m = parts.columns.reach_m();
        let ends = stretch.ends;
        let mut greatest = 0.0_f64;
        let mut far_m = 0.0_f64;
        let mut along = [f64::INFINITY, f64::NEG_INFINITY];
        for touching in &parts.region {
            for along_m in touching.along_m {
                far_m = far_m.max(along_m.abs());
                for m in ends {
                    let speed = fastest_within(m, &velocity(m, touching.at_m, along_m), reach_m);
                    greatest = greatest.max(speed);
                }
            }
            along = [along[0].min(touching.along_m[0]), along[1].max(touching.along_m[1])];
        }
        // Or of the whole cross-section.
        let mut whole = 0.0_f64;
        for (along_m, m) in along.into_iter().flat_map(|along_m| ends.map(|m| (along_m, m))) {
            whole = whole.max(fastest_within(m, &velocity(m, [0.0; 2], along_m), self.radius_m));
        }
        let arm_m = (self.radius_m * self.radius_m + far_m * far_m).sqrt();
        greatest.min(whole) + stretch.sag(bounds.third() + arm_m * bounds.third_of_axis())
    }

    /// Records the speed of a touching point at a moment, if there is one.
    pub fn see(&self, tracker: &mut BoundTracker, m: &Moment, time_s: f64) {
        // No touching point is faster, so that none would be recorded.
        if self.fastest(m) * (1.0 + 1e-9) <= tracker.seen {
            return;
        }
        let Some(r) = self.touching(m) else { return };
        let speed = (m.speed + m.turning.cross(&r)).norm();
        let mut there = *m;
        there.position += r;
        tracker.see(speed, time_s, &there);
    }

    /// Returns a touching point of the sponge relative to the tip \[m\]: the lowest of its rim over a disc, the deepest column elsewhere.
    fn touching(&self, m: &Moment) -> Option<Vector3<f64>> {
        let Some(columns) = &self.columns else {
            let from_middle = self.face.lowest(&m.axis, self.radius_m);
            return (self.height(m) <= 0.0).then(|| from_middle + (self.middle(m) - m.position));
        };
        let tip = self.plate.local(&m.position);
        if tip.z - self.highest_m > self.reach_m + self.far.error_m {
            return None;
        }
        let standing = self.sponge_state(columns, m);
        let (seen, _) = columns.0.load_at(&columns.1, &standing);
        let touches = seen.deepest_m >= 0.0;
        touches.then(|| self.plate.world(&Vector3::from(seen.deepest_at_m)) - m.position)
    }
}

/// Upper bound on the speed of the points within a disc across the axis \[m/s\], as G in formula (21.2): with v the velocity of its centre
/// and P the projection across the axis, ‖v + ω × u‖² = ‖v‖² + 2 u·(v × ω) + ‖ω × u‖² ≤ ‖v‖² + 2 ϱ ‖P (v × ω)‖ + ϱ² ‖ω‖². `centre_speed` is
/// v, `radius_m` is ϱ.
fn fastest_within(m: &Moment, centre_speed: &Vector3<f64>, radius_m: f64) -> f64 {
    let across = {
        let turned = centre_speed.cross(&m.turning);
        (turned - m.axis * turned.dot(&m.axis)).norm()
    };
    (centre_speed.norm_squared() + 2.0 * radius_m * across + radius_m * radius_m * m.turning.norm_squared()).sqrt()
}

/// Returns the velocity of a point of the tool \[m/s\]: `[x, y]` across the axis, `along_m` along it from the tip.
fn velocity(m: &Moment, [x, y]: [f64; 2], along_m: f64) -> Vector3<f64> {
    let r = m.side * x + m.axis.cross(&m.side) * y + m.axis * along_m;
    m.speed + m.turning.cross(&r)
}

impl Rim<'_> {
    /// Bounds a stretch by formulas (21.1) and (21.2) and, where needed, its halves.
    pub fn halve(&self, arm: &Arm<'_>, stretch: &Stretch<'_>, tracker: &mut BoundTracker, depth: u32) {
        let bounds = arm.derivatives(stretch);
        let bound = match &self.columns {
            None if self.is_clear(stretch, bounds) => return,
            Some(_) if self.is_far(stretch, bounds) => return,
            None => self.at_most(stretch, bounds),
            Some(columns) => match self.bound_on(columns, stretch, tracker, bounds) {
                None => return,
                Some(bound) => bound,
            },
        };
        // A kept limit needs no exact speed: the bound is above every speed found, by the effect of the tool's turning.
        let rough = self.columns.is_some() || self.far.beyond_m > 0.0;
        let enough = rough && (tracker.is_within_limit(bound) || depth >= MOST_HALVINGS);
        if enough || tracker.accepts(bound) || !tracker.may_split(depth) {
            return tracker.take(bound);
        }
        let Some(halves) = arm.halves(stretch) else {
            return tracker.take(bound);
        };
        let halves = halves.both();
        self.see(tracker, halves[0].ends[1], halves[0].times()[1]);
        for half in &halves {
            self.halve(arm, half, tracker, depth + 1);
        }
    }

    /// Upper bound on the contact speed on a face that is no disc over a stretch \[m/s\]: formula (21.2), and part by part where that does not keep
    /// the limit; `None` where nothing touches.
    fn bound_on(
        &self,
        columns: &(Columns, Bends<'_>),
        stretch: &Stretch<'_>,
        tracker: &mut BoundTracker,
        bounds: &Derivatives,
    ) -> Option<f64> {
        let rough = self.at_most(stretch, bounds);
        if tracker.is_within_limit(rough) {
            return Some(rough);
        }
        let [from, to] = stretch.ends.map(|m| self.sponge_state(columns, m));
        let drift = instants::drift(stretch, bounds);
        let Some(touching) = columns.0.touching(&columns.1, [&from, &to], &drift) else {
            return Some(rough);
        };
        if touching.is_empty() {
            return None;
        }
        let parts = Parts {
            columns: &columns.0,
            region: touching,
        };
        Some(self.at_most_of(&parts, stretch, bounds).min(rough))
    }
}
