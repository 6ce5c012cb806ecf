//! Places: the arm at its ends and at the plates, the tool over them, the plates themselves and their swept shares on a raster; and
//! obstacles in plates and in the base, by the depth of points in cylinders and boxes, in closed form.

use crate::mutation::sampler::findings::Findings;
use crate::mutation::sampler::motion::{Arm, Moment, Piece};
use crate::mutation::sampler::paths::{is_at_plate, path_of, tilt_limit_rad};
use crate::mutation::sampler::{LINE_M, PATH_M};
use nalgebra::{Point3, Vector3};
use platewash::certificate::Requirement;
use platewash::kinematics::geometry::Shape;
use platewash::motion::trajectory::SegmentKind;
use platewash::workcell::job::Overlap;
use platewash::workcell::{Obstacle, ObstacleShape};
use platewash::{Plan, Plate};

/// Height over a plate that every certified plan keeps \[m\].
const HEIGHT_M: f64 = 2e-4;

/// What joint positions and speeds at rest must be right to \[rad\], \[rad/s\].
const THERE: f64 = 2e-9;

/// What the raster's shares are right to.
const SHARE: f64 = 4e-3;

/// What tilt and height must exceed their limits by, as a part of them.
const EXACT: f64 = 2e-9;

/// The base's bounds in the plane of the plates, from its drawing \[m\].
const BASE_X_M: [f64; 2] = [-0.2115, 0.0905];
const BASE_Y_M: [f64; 2] = [-0.0905, 0.0905];

/// From home to home, at rest.
pub fn ends(plan: &Plan, findings: &mut Findings) {
    let last = plan.knots.t_s.len() - 1;
    for (home, knot) in plan.job.home_rad.iter().zip([0, last]) {
        let off = (plan.knots.q_rad[knot] - home).amax();
        let moving = plan.knots.qd_rad_s[knot].amax();
        findings.at_most(Requirement::HomeToHome, off.max(moving), 0.0, THERE);
    }
}

/// At rest at both ends of every wash.
pub fn contacts(plan: &Plan, findings: &mut Findings) {
    for segment in plan.segments.iter().filter(|s| s.kind == SegmentKind::Wash) {
        for time in [segment.t_start_s, segment.t_end_s] {
            let knot = plan.knots.t_s.iter().position(|t| *t == time).unwrap();
            let moving = plan.knots.qd_rad_s[knot].amax();
            findings.at_most(Requirement::RestAtWashEnds, moving, 0.0, THERE);
        }
    }
}

/// The sponge's lowest point while it comes down and while it leaves: no faster than the tip washes wherever it touches.
pub fn touches(plan: &Plan, arm: &Arm<'_>, pieces: &[Piece], moments: &[Moment], findings: &mut Findings) {
    let job = &plan.job;
    let most = job.requirements.wash_speed_m_s.min(job.limits.tip_speed_m_s);
    for m in moments {
        let lines = [SegmentKind::Approach, SegmentKind::Retreat];
        let Some(segment) = m.segment(plan).filter(|s| lines.contains(&s.kind)) else {
            continue;
        };
        let Some(plate) = job.plates.get(segment.plate) else {
            continue;
        };
        let sponge = (job.workcell.tool.sponge.radius_m, plate.centre().z);
        if let Some(speed) = arm.touch(&pieces[m.piece], m.u, sponge) {
            findings.at_most(Requirement::ContactSpeed, speed, most, EXACT * most);
        }
    }
}

/// No plate over another or over the base, unless that shall only be told.
pub fn apart(plan: &Plan, findings: &mut Findings) {
    if plan.job.requirements.overlap == Overlap::Report {
        return;
    }
    let plates = &plan.job.plates;
    for (i, a) in plates.iter().enumerate() {
        let [x, y] = a.centre_xy();
        for b in &plates[i + 1..] {
            let [u, v] = b.centre_xy();
            let gap = (x - u).hypot(y - v) - a.rim_m() - b.rim_m();
            findings.at_least(Requirement::PlatesApart, gap, 0.0, 1e-9);
        }
        let [u, v] = [x.clamp(BASE_X_M[0], BASE_X_M[1]), y.clamp(BASE_Y_M[0], BASE_Y_M[1])];
        let gap = (x - u).hypot(y - v) - a.rim_m();
        findings.at_least(Requirement::PlatesApart, gap, 0.0, 1e-9);
    }
}

/// Tilt at the plates, height over them while washing.
pub fn poses(plan: &Plan, moments: &[Moment], findings: &mut Findings) {
    let most = tilt_limit_rad(plan);
    for m in moments {
        let Some(segment) = m.segment(plan).filter(|s| is_at_plate(s.kind)) else {
            continue;
        };
        let tilt = tilt_rad(m);
        findings.at_most(Requirement::Tilt, tilt, most, EXACT * most + 2e-8);
        if let (SegmentKind::Wash, Some(plate)) = (segment.kind, plan.job.plates.get(segment.plate)) {
            let off = (m.tip.z - plate.centre().z).abs();
            findings.at_most(Requirement::ContactHeight, off, HEIGHT_M, EXACT * HEIGHT_M);
        }
    }
}

/// The share that even the whole face of the sponge, held flat, sweeps.
pub fn coverage(plan: &Plan, moments: &[Moment], findings: &mut Findings) {
    let required = plan.job.requirements.coverage;
    let sponge_m = plan.job.workcell.tool.sponge.radius_m;
    for plate in 0..plan.job.plates.len() {
        let share = share(plan, &washing(plan, moments, plate), plate, sponge_m);
        findings.at_least(Requirement::Swept, share, required, SHARE);
    }
}

/// Angle of the tool from straight down \[rad\].
fn tilt_rad(m: &Moment) -> f64 {
    m.axis.xy().norm().atan2(-m.axis.z)
}

/// How far the sponge gets beyond the rim of the plate that it works on, at the height of the plate's face, if it is always tilted as
/// much as it is there where it is tilted most, and towards the outside.
pub fn reach(plan: &Plan, moments: &[Moment], findings: &mut Findings) {
    let sponge_m = plan.job.workcell.tool.sponge.radius_m;
    let at = |m: &Moment| m.segment(plan).filter(|s| is_at_plate(s.kind)).map(|s| s.plate);
    for (i, plate) in plan.job.plates.iter().enumerate() {
        let Some(path) = path_of(plan, i) else { continue };
        let ([x, y], rim_m) = (plate.centre_xy(), plate.rim_m());
        let there: Vec<_> = moments.iter().filter(|m| at(m) == Some(i)).collect();
        let tilt = there.iter().map(|m| tilt_rad(m)).fold(0.0, f64::max);
        let wall_m = |tilt: f64| (sponge_m + LINE_M * tilt.sin()) / tilt.cos();
        let limit = path.curve.radius_m + PATH_M + wall_m(tilt.min(tilt_limit_rad(plan))) - rim_m;
        for m in there {
            let tip_m = (m.tip.x - x).hypot(m.tip.y - y);
            let beyond = tip_m + wall_m(tilt) - rim_m;
            findings.at_most(Requirement::Reach, beyond, limit, EXACT);
        }
    }
}

/// Whether the sponge might sweep too little of a plate if it were always tilted as much as it is where it is tilted most.
pub fn least_coverage_is_short(plan: &Plan, moments: &[Moment]) -> bool {
    let sponge_m = plan.job.workcell.tool.sponge.radius_m;
    (0..plan.job.plates.len()).any(|plate| {
        let washing = washing(plan, moments, plate);
        let cosine = washing.iter().map(|m| -m.axis.z).fold(1.0, f64::min).max(0.0);
        share(plan, &washing, plate, sponge_m * cosine) < plan.job.requirements.coverage + SHARE
    })
}

/// The moments at which a plate is washed.
fn washing<'a>(plan: &Plan, moments: &'a [Moment], plate: usize) -> Vec<&'a Moment> {
    let washes = |m: &&Moment| {
        m.segment(plan)
            .is_some_and(|s| s.kind == SegmentKind::Wash && s.plate == plate)
    };
    moments.iter().filter(washes).collect()
}

fn share(plan: &Plan, washing: &[&Moment], plate: usize, within_m: f64) -> f64 {
    let path: Vec<_> = washing.iter().map(|m| [m.tip.x, m.tip.y]).collect();
    swept_share(&plan.job.plates[plate], &path, within_m)
}

/// Points along each edge of an obstacle.
const POINTS: usize = 33;

/// The base from its drawing: a cylinder about the axis, radius and height \[m\].
const BASE_M: [f64; 2] = [0.0905, 0.1665];

/// How far obstacles that reach into a plate, or into the base, do so, as a gap below 0.
pub fn standing(plan: &Plan, findings: &mut Findings) {
    let base = |p: &Point3<f64>| cylinder(p, [0.0, 0.0], BASE_M[0], [0.0, BASE_M[1]]);
    for obstacle in &plan.job.workcell.obstacles {
        for (i, plate) in plan.job.plates.iter().enumerate() {
            if obstacle.holds_plates.contains(&i) {
                continue;
            }
            let top = plate.centre().z;
            let sdf = |p: &Point3<f64>| cylinder(p, plate.centre_xy(), plate.rim_m(), [top - plate.thickness_m, top]);
            note(findings, gap(obstacle, &sdf));
        }
        note(findings, gap(obstacle, &base));
    }
}

fn note(findings: &mut Findings, gap_m: Option<f64>) {
    if let Some(gap_m) = gap_m {
        findings.at_least(Requirement::PlatesApart, gap_m, -1e-6, 1e-9);
    }
}

/// The least signed distance of an obstacle's points \[m\]; `None` of a half-space and of shapes that no edit has.
fn gap(obstacle: &Obstacle, sdf: &dyn Fn(&Point3<f64>) -> f64) -> Option<f64> {
    let ObstacleShape::Convex(shape) = &obstacle.shape else {
        return None;
    };
    if let Shape::Sphere { radius_m } = shape {
        return Some(sdf(&obstacle.pose.translation.vector.into()) - radius_m);
    }
    let half = match shape {
        Shape::Box { half_m } => Vector3::from(*half_m),
        Shape::Cylinder {
            radius_m,
            half_length_m,
        } => Vector3::new(*radius_m, *radius_m, *half_length_m),
        _ => return None,
    };
    let share = |k: usize| 2.0 * k as f64 / (POINTS - 1) as f64 - 1.0;
    let mut least = f64::INFINITY;
    for k in 0..POINTS.pow(3) {
        let at = Vector3::new(
            share(k % POINTS),
            share(k / POINTS % POINTS),
            share(k / POINTS / POINTS),
        );
        if matches!(shape, Shape::Cylinder { .. }) && at.xy().norm() > 1.0 {
            continue;
        }
        least = least.min(sdf(&(obstacle.pose * Point3::from(at.component_mul(&half)))));
    }
    Some(least)
}

/// The signed distance of an upright cylinder.
fn cylinder(p: &Point3<f64>, [x, y]: [f64; 2], radius: f64, [low, high]: [f64; 2]) -> f64 {
    let out = (p.x - x).hypot(p.y - y) - radius;
    let over = (low - p.z).max(p.z - high);
    out.max(over).min(0.0) + out.max(0.0).hypot(over.max(0.0))
}

/// Distance between points of the raster \[m\].
const STEP_M: f64 = 2.5e-3;

/// Share of the plate's points that lie within a distance \[m\] of some point of a path.
pub fn swept_share(plate: &Plate, path: &[[f64; 2]], within_m: f64) -> f64 {
    let side = (plate.rim_m() / STEP_M).ceil() as i32;
    let (width, centre) = ((2 * side + 1) as usize, plate.centre_xy());
    let mut nearest = vec![f64::INFINITY; width * width];
    let mut last = [f64::INFINITY; 2];
    for p in path {
        if (p[0] - last[0]).hypot(p[1] - last[1]) < 5e-4 {
            continue;
        }
        last = *p;
        let (x, y) = (p[0] - centre[0], p[1] - centre[1]);
        let range = |c: f64| {
            let index = |v: f64| (v / STEP_M).clamp(-1e6, 1e6) as i32;
            (index(c - within_m) - 1).max(-side)..=(index(c + within_m) + 1).min(side)
        };
        for i in range(x) {
            for j in range(y) {
                let (dx, dy) = (f64::from(i) * STEP_M - x, f64::from(j) * STEP_M - y);
                let cell = &mut nearest[(i + side) as usize * width + (j + side) as usize];
                *cell = cell.min(dx * dx + dy * dy);
            }
        }
    }
    let (mut inside, mut swept) = (0_u32, 0_u32);
    for i in -side..=side {
        for j in -side..=side {
            let (x, y) = (f64::from(i) * STEP_M, f64::from(j) * STEP_M);
            if x.hypot(y) > plate.rim_m() {
                continue;
            }
            inside += 1;
            let off = nearest[(i + side) as usize * width + (j + side) as usize].sqrt();
            swept += u32::from(off <= within_m);
        }
    }
    f64::from(swept) / f64::from(inside)
}
