//! How fast the sponge touches a plate: whatever of it touches while it comes down and while it leaves.
//!
//! Where a job states how fast it may land, or lift off, the free sponge counts: its face lies beyond the tip by its compression, and the
//! plate as much higher as it may lie. Where it states nothing, the face that the sponge has while it washes counts, and it touches no
//! faster than it washes. Stretches in which nothing touches count for nothing; the others are halved like those of every quantity
//! (`motion/bound_tracker.rs`).
//!
//! The sponge over the face of a plate that it comes down on or leaves: whether it touches, and how fast what touches may be.
//!
//! Its far face lies b beyond the tip: b = 0 for the one that it has while it washes, b = c for the free one.
//!
//! - Over a disc the lowest point of its rim is at H = p_z + b a_z − s ‖a_xy‖, with p the tip and a the tool's axis. H ≥ min of its
//!   values at the ends of a stretch less h²/8 (sup ‖p̈‖ + (b + s) sup ‖ä‖): H is the least of functions p_z + b a_z + s d·a_xy, one for
//!   each horizontal direction d. Over other faces it does not touch where no column of its far face is compressed (`contact/stands.rs`).
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

use crate::motion::bound_tracker::BoundTracker;
use crate::motion::piece::Piece;
use crate::motion::tip::{Arm, Derivatives, Moment, Stretch};
use crate::motion::tip_limits::{self, Tips};
use crate::report::check::{Check, Unit, Worst};
use crate::report::requirement::Requirement;
use crate::statements::schedule::{Schedule, Span};
use crate::subject::Subject;
use crate::washing::contact::tighter;
use crate::washing::face::Face;
use crate::washing::instants;
use nalgebra::Vector3;
use platewash_workcell::contact::{Bends, Columns, Foundation, Standing, Touching};
use platewash_workcell::job::LINE_TOLERANCE_M;
use platewash_workcell::plate::Plate;
use platewash_workcell::tool::Sponge;
use platewash_workcell::trajectory::SegmentKind;

/// How far the bound of the speed may be above the greatest one found, as a part of the limit.
const RESOLUTION: f64 = 2e-3;

/// What is asked of the segments of some kinds.
struct Asked<'a> {
    kinds: &'a [SegmentKind],
    /// \[m/s\]
    limit: f64,
    far: FarFace,
}

/// The speed of whatever of the sponge touches a plate that it comes down on or leaves.
pub(crate) fn check(
    arm: &Arm<'_>,
    subject: &Subject<'_>,
    (pieces, schedule): (&[Piece], Option<&Schedule>),
    tips: &Tips,
) -> Check {
    let Some(schedule) = schedule else {
        return Check::not_judged(Requirement::ContactSpeed);
    };
    let wanted = &subject.job.requirements;
    let judged = |asked: &Asked<'_>| judge(arm, subject, (pieces, schedule), tips, asked);
    let as_washed = FarFace {
        beyond_m: 0.0,
        error_m: 0.0,
    };
    let limit = subject.limits.wash_speed_m_s;
    if wanted.landing_m_s.is_none() && wanted.lifting_m_s.is_none() {
        return judged(&Asked {
            kinds: &[SegmentKind::Approach, SegmentKind::Retreat],
            limit,
            far: as_washed,
        });
    }
    let free = FarFace {
        beyond_m: subject.job.workcell.tool.sponge.compression_m,
        error_m: wanted.contact.map_or(0.0, |contact| contact.height_error_m),
    };
    let of = |kind, stated: Option<f64>| {
        judged(&Asked {
            kinds: &[kind],
            limit: stated.map_or(limit, |stated| stated.min(limit)),
            far: stated.map_or(as_washed, |_| free),
        })
    };
    tighter(
        of(SegmentKind::Approach, wanted.landing_m_s),
        of(SegmentKind::Retreat, wanted.lifting_m_s),
    )
}

fn judge(
    arm: &Arm<'_>,
    subject: &Subject<'_>,
    (pieces, schedule): (&[Piece], &Schedule),
    tips: &Tips,
    asked: &Asked<'_>,
) -> Check {
    let limit = asked.limit;
    let mut tracker = BoundTracker::new(limit, RESOLUTION * limit);
    let touching = |span: &Span| asked.kinds.contains(&span.kind);
    let spans = || schedule.spans.iter().enumerate().filter(|(_, span)| touching(span));
    // A plate that is not there is found elsewhere.
    let rim = |index: usize, span: &Span| {
        let plate = subject.plates().get(span.plate)?;
        let sponge = &subject.job.workcell.tool.sponge;
        Some(Rim::new(plate, sponge, asked.far, tips.least_upright_cosine_of(index)))
    };
    tracker.allow_for(spans().map(|(_, span)| span.pieces.len()).sum());
    // Nothing that touches is fast: so it is until something is seen, and for good where nothing touches.
    tracker.seen = 0.0;
    tracker.take(0.0);
    let over: Vec<_> = spans()
        .filter_map(|(i, span)| Some((rim(i, span)?, &pieces[span.pieces.clone()])))
        .collect();
    for (rim, pieces) in &over {
        look(arm, rim, pieces, &mut tracker);
    }
    for (rim, pieces) in &over {
        for piece in *pieces {
            rim.halve(arm, &arm.stretch(piece), &mut tracker, 0);
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
fn look(arm: &Arm<'_>, rim: &Rim<'_>, pieces: &[Piece], tracker: &mut BoundTracker) {
    for stretch in pieces.iter().map(|piece| arm.stretch(piece)) {
        for (moment, time_s) in stretch.ends.iter().zip(stretch.times()) {
            rim.see(tracker, moment, time_s);
        }
    }
}

/// What a height may be wrong by \[m\].
const ROUNDING_M: f64 = 1e-9;

/// How often a piece is halved at most, where it is not asked how fast exactly the sponge touches.
const MOST_HALVINGS: u32 = 6;

/// Which of the sponge's faces counts, and where the plate may lie.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FarFace {
    /// b \[m\].
    pub beyond_m: f64,
    /// How much higher than stated a plate may lie \[m\].
    pub error_m: f64,
}

/// The sponge over the face of a plate.
#[derive(Debug)]
pub(crate) struct Rim<'a> {
    plate: &'a Plate,
    face: Face<'a>,
    /// Radius of the sponge \[m\].
    radius_m: f64,
    far: FarFace,
    /// ρ \[m\].
    reach_m: f64,
    /// How high the face gets over its pole \[m\].
    highest_m: f64,
    /// The columns over a face that is no disc, and how it bends.
    columns: Option<(Columns, Bends<'a>)>,
}

/// Parts of the sponge's face that may touch over a stretch.
struct Parts<'a> {
    columns: &'a Columns,
    touching: Vec<Touching>,
}

impl<'a> Rim<'a> {
    /// A sponge over a plate, with cos τ never below `cosine`.
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
            face: Face::of(plate),
            radius_m: s,
            far,
            reach_m: if flat && b == 0.0 {
                s / cosine
            } else {
                (s * s + along_m * along_m).sqrt()
            },
            highest_m: plate.surface.height_bounds_m()[1],
            columns: (!flat).then(|| (Columns::fine(&foundation), Bends::of(&plate.surface))),
        }
    }

    /// Where the far face of the sponge has its middle.
    fn middle(&self, m: &Moment) -> Vector3<f64> {
        if self.far.beyond_m == 0.0 {
            m.position
        } else {
            m.position + m.axis * self.far.beyond_m
        }
    }

    fn stand(&self, (columns, bends): &(Columns, Bends<'_>), m: &Moment) -> Standing {
        let side = self.plate.pose.inverse_transform_vector(&m.side);
        columns.stand(bends, &instants::pose(self.plate, m), &side, self.far.error_m)
    }

    /// H over a disc \[m\].
    fn height(&self, m: &Moment) -> f64 {
        self.face.height_of_rim(&self.middle(m), &m.axis, self.radius_m) - self.far.error_m
    }

    /// Whether nothing of the sponge touches anywhere in a stretch of a disc's approach or retreat.
    fn is_clear(&self, stretch: &Stretch<'_>, bounds: &Derivatives) -> bool {
        let [from, to] = stretch.ends.each_ref().map(|m| self.height(m));
        let lower = if from < to || from.is_nan() { from } else { to };
        let arm_m = self.far.beyond_m + self.radius_m;
        lower - stretch.sag(bounds.second() + arm_m * bounds.second_of_axis()) - ROUNDING_M > 0.0
    }

    /// Whether a face that is no disc is certainly too far away to be touched anywhere in a stretch: the plate's enclosing cylinder is.
    fn is_far(&self, stretch: &Stretch<'_>, bounds: &Derivatives) -> bool {
        let arm_m = self.reach_m + self.far.error_m;
        let [from, to] = stretch.ends.each_ref().map(|m| {
            let tip = self.plate.local(&m.position);
            (tip.z - self.highest_m).max(tip.xy().norm() - self.plate.rim_m())
        });
        // A maximum of a height and a distance: each moves no faster than the tip.
        let nearer = if from < to || from.is_nan() { from } else { to };
        let [a, b] = stretch.ends.each_ref().map(|m| m.speed.norm());
        let speed = a.max(b) + stretch.sag(bounds.third());
        nearer - 0.5 * stretch.length_s() * speed - arm_m - ROUNDING_M > 0.0
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

    /// What no point of some parts that touch is faster than anywhere in a stretch \[m/s\], part by part.
    fn at_most_of(&self, parts: &Parts<'_>, stretch: &Stretch<'_>, bounds: &Derivatives) -> f64 {
        let reach_m = parts.columns.reach_m();
        let ends = stretch.ends.each_ref();
        let mut greatest = 0.0_f64;
        let mut far_m = 0.0_f64;
        let mut along = [f64::INFINITY, f64::NEG_INFINITY];
        for touching in &parts.touching {
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

    /// Takes note of the speed of a point that touches at a moment, where one does.
    pub fn see(&self, tracker: &mut BoundTracker, m: &Moment, time_s: f64) {
        let Some(r) = self.touching(m) else { return };
        let speed = (m.speed + m.turning.cross(&r)).norm();
        let mut there = *m;
        there.position += r;
        tracker.see(speed, time_s, &there);
    }

    /// A point of the sponge that touches, from the tip \[m\]: the lowest of its rim over a disc, the deepest column elsewhere.
    fn touching(&self, m: &Moment) -> Option<Vector3<f64>> {
        let Some(columns) = &self.columns else {
            let from_middle = self.face.lowest(&m.axis, self.radius_m);
            return (self.height(m) <= 0.0).then(|| from_middle + (self.middle(m) - m.position));
        };
        let tip = self.plate.local(&m.position);
        if tip.z - self.highest_m > self.reach_m + self.far.error_m {
            return None;
        }
        let standing = self.stand(columns, m);
        let (seen, _) = columns.0.seen(&columns.1, &standing);
        let touches = seen.deepest_m >= 0.0;
        touches.then(|| self.plate.world(&Vector3::from(seen.deepest_at_m)) - m.position)
    }
}

/// What no point within a disc across the axis about one that moves at p is faster than \[m/s\]:
/// |p + ω × u|² = |p|² + 2 u·(p × ω) + |ω × u|² ≤ |p|² + 2 r |P (p × ω)| + r² |ω|², P across the axis, r the disc's radius.
fn fastest_within(m: &Moment, p: &Vector3<f64>, radius_m: f64) -> f64 {
    let across = {
        let way = p.cross(&m.turning);
        (way - m.axis * way.dot(&m.axis)).norm()
    };
    (p.norm_squared() + 2.0 * radius_m * across + radius_m * radius_m * m.turning.norm_squared()).sqrt()
}

/// The velocity of a point of the tool: across its axis, and along it from the tip \[m/s\].
fn velocity(m: &Moment, [x, y]: [f64; 2], along_m: f64) -> Vector3<f64> {
    let r = m.side * x + m.axis.cross(&m.side) * y + m.axis * along_m;
    m.speed + m.turning.cross(&r)
}

impl Rim<'_> {
    /// Looks at a stretch and, where that is needed, at its halves.
    pub fn halve(&self, arm: &Arm<'_>, stretch: &Stretch<'_>, tracker: &mut BoundTracker, depth: u32) {
        let bounds = arm.derivatives(stretch);
        let bound = match &self.columns {
            None if self.is_clear(stretch, &bounds) => return,
            Some(_) if self.is_far(stretch, &bounds) => return,
            None => self.at_most(stretch, &bounds),
            Some(columns) => match self.bound_on(columns, stretch, (tracker, &bounds)) {
                None => return,
                Some(bound) => bound,
            },
        };
        // How fast exactly is not asked where the limit is kept: the bound is above every speed that is seen, by what the tool turns.
        let rough = self.columns.is_some() || self.far.beyond_m > 0.0;
        let enough = rough && (tracker.keeps(bound) || depth >= MOST_HALVINGS);
        if enough || tracker.accepts(bound) || !tracker.may_split(depth) {
            return tracker.take(bound);
        }
        let Some(halves) = arm.halves(stretch) else {
            return tracker.take(bound);
        };
        self.see(tracker, &halves[0].ends[1], halves[0].times()[1]);
        for half in &halves {
            self.halve(arm, half, tracker, depth + 1);
        }
    }

    /// What nothing that touches a face that is no disc is faster than in a stretch \[m/s\]; `None` where nothing touches.
    fn bound_on(
        &self,
        columns: &(Columns, Bends<'_>),
        stretch: &Stretch<'_>,
        (tracker, bounds): (&mut BoundTracker, &Derivatives),
    ) -> Option<f64> {
        let rough = self.at_most(stretch, bounds);
        if tracker.keeps(rough) {
            return Some(rough);
        }
        let [from, to] = stretch.ends.each_ref().map(|m| self.stand(columns, m));
        let drift = instants::drift(stretch, bounds);
        let Some(touching) = columns.0.touching(&columns.1, [&from, &to], &drift) else {
            return Some(rough);
        };
        if touching.is_empty() {
            return None;
        }
        let parts = Parts {
            columns: &columns.0,
            touching,
        };
        Some(self.at_most_of(&parts, stretch, bounds).min(rough))
    }
}
