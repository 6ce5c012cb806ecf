//! Segments and stated curves: which moment belongs to which segment, and whether a path follows its curve in order.

use crate::mutation::sampler::motion::Piece;
use nalgebra::Vector3;
use platewash::motion::trajectory::{PlanSegment, SegmentKind};
use platewash::workcell::wash_path::WashPath;
use platewash::{Plan, Plate};
use std::f64::consts::{PI, TAU};

/// Whether the segments cover the motion from knot to knot, and their kinds and plates are those of a job that washes in the
/// plan's order.
pub fn is_sound(plan: &Plan) -> bool {
    let found: Vec<_> = plan.segments.iter().map(|s| (s.kind, s.plate)).collect();
    follows(&found, &plan.order) && covers(plan)
}

fn follows(list: &[(SegmentKind, usize)], order: &[usize]) -> bool {
    let last = 4 * order.len();
    list.len() == last + 1
        && list.iter().enumerate().all(|(i, (kind, plate))| {
            let expected = match (i, i % 4) {
                (0, _) => SegmentKind::Depart,
                (i, _) if i == last => return *kind == SegmentKind::Return && order.last() == Some(plate),
                (_, 0) => SegmentKind::Transit,
                (_, 1) => SegmentKind::Approach,
                (_, 2) => SegmentKind::Wash,
                _ => SegmentKind::Retreat,
            };
            *kind == expected && *plate == order[i / 4]
        })
}

fn covers(plan: &Plan) -> bool {
    let times = &plan.knots.t_s;
    let mut reached = times[0];
    let mut connected = |s: &PlanSegment| {
        let fits = s.t_start_s == reached && s.t_end_s > reached && times.contains(&s.t_end_s);
        reached = s.t_end_s;
        fits
    };
    plan.segments.iter().all(&mut connected) && reached == times[times.len() - 1]
}

/// Index of the segment in which the middle of a piece lies, for segments that are sound.
pub fn segment_of(plan: &Plan, piece: &Piece) -> usize {
    let middle = piece.start_s + 0.5 * piece.length_s;
    let after = plan.segments.partition_point(|s| s.t_end_s <= middle);
    after.min(plan.segments.len() - 1)
}

/// Whether the tip is on a plate, or on its normal.
pub fn is_at_plate(kind: SegmentKind) -> bool {
    use SegmentKind::{Approach, Retreat, Wash};
    matches!(kind, Approach | Wash | Retreat)
}

/// How a plate is washed; `None` where the plan does not say, or says what is no path.
pub fn path_of(plan: &Plan, plate: usize) -> Option<&WashPath> {
    let path = plan.wash_paths.iter().find(|path| path.plate == plate)?;
    let curve = &path.curve;
    let within = [
        (curve.radius_m, 1e-4, 10.0),
        (curve.turns, 0.25, 200.0),
        (curve.start_angle_rad, -TAU, TAU),
        (PI * curve.radius_m * (curve.turns + 2.0), 0.0, 100.0),
        (path.lift_m, 1e-300, 10.0),
        (path.cone_rad, 0.0, most_tilt_rad(plan)),
    ];
    let sound = within
        .iter()
        .all(|(found, least, most)| found >= least && found <= most);
    (sound && plate < plan.job.plates.len()).then_some(path)
}

/// How far the tool may tilt \[rad\]: as the job allows, and no more than the narrowest cone that a path states.
pub fn tilt_limit_rad(plan: &Plan) -> f64 {
    let paths = (0..plan.job.plates.len()).filter_map(|plate| path_of(plan, plate));
    let cones = paths.map(|path| path.cone_rad);
    cones.fold(most_tilt_rad(plan), f64::min)
}

/// How far the job allows the tool to tilt \[rad\].
fn most_tilt_rad(plan: &Plan) -> f64 {
    let sponge = &plan.job.workcell.tool.sponge;
    // Beyond this the rim where the handle holds the sponge would have to go through the plate.
    let gives_way = (sponge.height_m / sponge.radius_m).atan();
    plan.job.requirements.tilt_rad.min(gives_way)
}

/// β, the last part of a spiral \[rad\].
const BLEND_RAD: f64 = 1.0;

/// (√5 − 1) / 2.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// How far around the last parameter the next one is looked for \[rad\].
const WINDOW_RAD: f64 = 0.8;

/// A curve that the tip must follow, base frame.
pub enum Curve {
    /// θ is the length from the first point \[m\].
    Line {
        from: Vector3<f64>,
        along: Vector3<f64>,
        length_m: f64,
    },
    /// θ is the angle from the start \[rad\].
    Wash {
        centre: Vector3<f64>,
        radius_m: f64,
        spiral_rad: f64,
        start_rad: f64,
        end_rad: f64,
    },
}

impl Curve {
    /// What a wash path asks for on a level plate, in the direction of the motion; `None` for free motion.
    pub fn new(plate: &Plate, path: &WashPath, kind: SegmentKind) -> Option<Self> {
        let spiral_rad = TAU * path.curve.turns;
        // The plate may be turned about its axis.
        let x = plate.pose.rotation * Vector3::x();
        let wash = Self::Wash {
            centre: plate.centre(),
            radius_m: path.curve.radius_m,
            spiral_rad,
            start_rad: x.y.atan2(x.x) + path.curve.start_angle_rad,
            end_rad: spiral_rad + if path.curve.closing_ring { TAU } else { 0.0 },
        };
        let (up, length_m) = (Vector3::z(), path.lift_m);
        match kind {
            SegmentKind::Approach => Some(Self::Line {
                from: wash.at(0.0) + up * length_m,
                along: -up,
                length_m,
            }),
            SegmentKind::Wash => Some(wash),
            SegmentKind::Retreat => Some(Self::Line {
                from: wash.at(wash.end()),
                along: up,
                length_m,
            }),
            _ => None,
        }
    }

    /// The last θ.
    fn end(&self) -> f64 {
        match self {
            Self::Line { length_m, .. } => *length_m,
            Self::Wash { end_rad, .. } => *end_rad,
        }
    }

    /// The point at θ \[m\].
    pub fn at(&self, theta: f64) -> Vector3<f64> {
        match self {
            Self::Line { from, along, .. } => from + along * theta,
            Self::Wash {
                centre,
                radius_m,
                spiral_rad,
                start_rad,
                ..
            } => {
                let rate = radius_m / (spiral_rad - 0.5 * BLEND_RAD);
                let straight = spiral_rad - BLEND_RAD;
                let x = ((theta - straight) / BLEND_RAD).clamp(0.0, 1.0);
                let slowed = x - 2.5 * x.powi(4) + 3.0 * x.powi(5) - x.powi(6);
                let r = rate * (theta.min(straight) + BLEND_RAD * slowed);
                let angle = start_rad + theta;
                centre + Vector3::new(r * angle.cos(), r * angle.sin(), 0.0)
            }
        }
    }

    /// θ of the point nearest to `p`, near θ = `around`.
    fn nearest(&self, p: &Vector3<f64>, around: f64) -> f64 {
        if let Self::Line { from, along, length_m } = self {
            return (p - from).dot(along).clamp(0.0, *length_m);
        }
        // Golden section: no derivative is needed.
        let off = |theta: f64| (p - self.at(theta)).norm_squared();
        let clamp = |theta: f64| theta.clamp(0.0, self.end());
        let (mut least, mut most) = (clamp(around - WINDOW_RAD), clamp(around + WINDOW_RAD));
        let inner = |least: f64, most: f64| (most - least) * GOLDEN;
        let mut at = [most - inner(least, most), least + inner(least, most)];
        let mut offs = at.map(off);
        while most - least > 1e-8 {
            if offs[0] < offs[1] {
                most = at[1];
                at = [most - inner(least, most), at[0]];
                offs = [off(at[0]), offs[0]];
            } else {
                least = at[0];
                at = [at[1], least + inner(least, most)];
                offs = [offs[1], off(at[1])];
            }
        }
        0.5 * (least + most)
    }

    /// How far `path` leaves the curve at least, whatever parameter that never falls from 0 to the end is assigned to its points;
    /// exact up to the bend of the curve within `tolerance_m` \[m\].
    ///
    /// The parameters that lie within the tolerance of a point are an interval about the nearest one. A path within the tolerance
    /// has a parameter in each interval and none before one that it has passed.
    pub fn deviation(&self, path: &[Vector3<f64>], tolerance_m: f64) -> f64 {
        let ends = [(path[0], 0.0), (path[path.len() - 1], self.end())];
        let mut worst = ends.iter().map(|(p, t)| (p - self.at(*t)).norm()).fold(0.0, f64::max);
        let (mut theta, mut least) = (0.0, 0.0);
        let (mut passed, mut passed_off) = (self.at(0.0), 0.0_f64);
        for p in path {
            theta = self.nearest(p, theta);
            let near = self.at(theta);
            let off = (p - near).norm();
            worst = worst.max(off);
            let reach = (tolerance_m * tolerance_m - off * off).max(0.0).sqrt();
            let step = 1e-6;
            let rate = ((self.at(theta + step) - self.at(theta - step)) / (2.0 * step)).norm();
            let (first, last) = (theta - reach / rate, theta + reach / rate);
            if last < least {
                // The best is half-way.
                worst = worst.max((0.5 * (near - passed).norm()).hypot(off.max(passed_off)));
            }
            if first > least {
                (least, passed, passed_off) = (first, near, off);
            }
        }
        worst
    }
}
