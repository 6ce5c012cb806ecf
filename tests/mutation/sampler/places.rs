//! Where things are: the arm at its ends and at the plates, the tool over them, the plates themselves.

use super::findings::Findings;
use super::hermite::Piece;
use super::moments::{Arm, Moment};
use super::schedule::{is_at_plate, path_of, tilt_limit_rad};
use super::{LINE_M, PATH_M, swept};
use platewash::Plan;
use platewash::certificate::Requirement;
use platewash::workcell::job::Overlap;
use platewash::workcell::trajectory::SegmentKind;

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
    swept::share(&plan.job.plates[plate], &path, within_m)
}
