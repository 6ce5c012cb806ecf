//! A dense sampler that shares no code with the certificate but the motion's knots, forward kinematics and distances: it must
//! never find anything worse than a certified bound, and the bounds must not be far from what it finds.

use crate::maker::{Recipe, good, irb120};
use nalgebra::Vector3;
use platewash_bodies::clearance::ClearanceModel;
use platewash_certificate::{Certificate, PairRule, Requirement, prove};
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::SegmentKind;
use platewash_workcell::wash_path::WashCurve;

struct MotionSample {
    time: f64,
    kind: SegmentKind,
    tip: Vector3<f64>,
    axis: Vector3<f64>,
    q: platewash_kinematics::JointVector,
}

fn sampled(plan: &Plan, per_knot: usize) -> Vec<MotionSample> {
    let robot = irb120();
    let motion = plan.knots.motion().unwrap();
    let frame = plan.job.workcell.tool.tip_frame(&robot);
    let mut all = Vec::new();
    for ends in plan.knots.t_s.windows(2) {
        for k in 0..per_knot {
            let time = ends[0] + (ends[1] - ends[0]) * (k as f64 + 0.5) / per_knot as f64;
            let q = motion.at(time).unwrap().q;
            let pose = robot.pose(&q, &frame);
            let kind = plan.segments.iter().find(|s| time <= s.t_end_s).unwrap().kind;
            all.push(MotionSample {
                time,
                kind,
                tip: pose.translation.vector,
                axis: pose.rotation * Vector3::z(),
                q,
            });
        }
    }
    all
}

fn bound(certificate: &Certificate, name: Requirement) -> f64 {
    certificate.check(name).unwrap().measure.unwrap().bound.unwrap()
}

/// Least distance from a wash path: a grid, then thirds about each of its local minima.
fn from_path(p: &Vector3<f64>, centre: Vector3<f64>, curve: &WashCurve) -> f64 {
    let at = |theta: f64| (curve.at(theta).position.push(0.0) + centre - p).norm();
    let step = curve.end() / 1500.0;
    let grid: Vec<f64> = (0..=1500).map(|k| at(step * f64::from(k))).collect();
    let mut least = grid[0].min(grid[1500]);
    for k in 0..=1500 {
        let (before, after) = (k.max(1) - 1, (k + 1).min(1500));
        if grid[k] > 0.005 || grid[before] < grid[k] || grid[after] < grid[k] {
            continue;
        }
        let (mut low, mut high) = (step * before as f64, step * after as f64);
        for _ in 0..60 {
            let (m, n) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if at(m) < at(n) { high = n } else { low = m }
        }
        least = least.min(at(low));
    }
    least
}

#[test]
fn no_sample_is_worse_than_a_proved_bound() {
    let mut leaning = Recipe::arc(&[10.0]);
    (leaning.lean, leaning.pace, leaning.curve.start_angle_rad) = (0.12, 0.8, -2.0);
    for plan in [good(), leaning.plan()] {
        let certificate = prove(&plan, &irb120()).unwrap();
        let samples = sampled(&plan, 4);
        rates(&plan, &certificate, &samples);
        poses(&plan, &certificate, &samples);
        distances(&plan, &certificate, &samples);
    }
}

/// Speeds and accelerations by differences between samples of the position.
fn rates(plan: &Plan, certificate: &Certificate, samples: &[MotionSample]) {
    let mut worst = [0.0_f64; 4];
    for three in samples.windows(3) {
        let [a, b, c] = three else { unreachable!() };
        if a.kind != c.kind {
            continue;
        }
        let washing = usize::from(b.kind == SegmentKind::Wash);
        let v = (b.tip - a.tip).norm() / (b.time - a.time);
        // A difference of second order is a mean of the acceleration.
        let [h, k] = [b.time - a.time, c.time - b.time];
        let acceleration = ((c.tip - b.tip) / k - (b.tip - a.tip) / h) * (2.0 / (h + k));
        worst[2 * washing] = worst[2 * washing].max(v);
        worst[2 * washing + 1] = worst[2 * washing + 1].max(acceleration.norm());
    }
    let names = [
        Requirement::TipSpeed,
        Requirement::TipAcceleration,
        Requirement::WashSpeed,
        Requirement::WashAcceleration,
    ];
    let limits = [1.0, 8.0, 0.25, 4.0];
    for ((name, worst), limit) in names.into_iter().zip(worst).zip(limits) {
        let bound = bound(certificate, name);
        assert!(worst <= bound + 1e-6, "{name:?}: {worst} found, {bound} certified");
        // Means lag behind where the acceleration jumps, at the start of a wash.
        assert!(
            worst >= bound - 0.12 * limit,
            "{name:?}: {worst} found, {bound} certified"
        );
    }
    let duration = plan.knots.t_s.last().unwrap();
    assert!((certificate.duration_s - duration).abs() < 1e-12);
}

fn poses(plan: &Plan, certificate: &Certificate, samples: &[MotionSample]) {
    let at_plate =
        |s: &&MotionSample| matches!(s.kind, SegmentKind::Approach | SegmentKind::Wash | SegmentKind::Retreat);
    let tilt = samples
        .iter()
        .filter(at_plate)
        .map(|s| s.axis.xy().norm().atan2(-s.axis.z))
        .fold(0.0, f64::max);
    let certified = bound(certificate, Requirement::Tilt);
    assert!(tilt <= certified && tilt >= certified - 5e-4, "{tilt} {certified}");
    let (mut height, mut off) = (0.0_f64, 0.0_f64);
    for s in samples.iter().filter(|s| s.kind == SegmentKind::Wash).step_by(7) {
        let plate = plan.segments.iter().find(|x| s.time <= x.t_end_s).unwrap().plate;
        let (centre, path) = (plan.job.plates[plate].centre(), plan.wash_path_of(plate).unwrap());
        height = height.max((s.tip.z - centre.z).abs());
        off = off.max(from_path(&s.tip, centre, &path.curve));
    }
    assert!(height <= bound(certificate, Requirement::ContactHeight));
    assert!(off <= bound(certificate, Requirement::PathDeviation) + 1e-9, "{off}");
    let mut off_line = 0.0_f64;
    for s in samples
        .iter()
        .filter(|s| matches!(s.kind, SegmentKind::Approach | SegmentKind::Retreat))
    {
        let plate = plan.segments.iter().find(|x| s.time <= x.t_end_s).unwrap().plate;
        let [start, end] = plan.wash_path_of(plate).unwrap().feet(&plan.job.plates[plate]);
        let foot = if s.kind == SegmentKind::Approach { start } else { end };
        off_line = off_line.max((s.tip - foot).xy().norm());
    }
    let certified = bound(certificate, Requirement::LineDeviation);
    assert!(off_line <= certified, "{off_line} {certified}");
}

fn distances(plan: &Plan, certificate: &Certificate, samples: &[MotionSample]) {
    let model = ClearanceModel::new(&irb120(), &plan.job.workcell, &plan.job.plates).unwrap();
    let names: Vec<_> = model
        .pair_names()
        .into_iter()
        .map(|(a, b)| [a.to_owned(), b.to_owned()])
        .collect();
    let mut least = vec![f64::INFINITY; names.len()];
    for s in samples.iter().step_by(3) {
        for (least, pair) in least.iter_mut().zip(model.all(&s.q)) {
            *least = least.min(pair.distance_m);
        }
    }
    let mut overall = f64::INFINITY;
    for (name, least) in names.iter().zip(least) {
        if name[0] == "sponge" && name[1].starts_with("plate") {
            continue;
        }
        overall = overall.min(least);
        let line = certificate
            .clearance
            .iter()
            .find(|l| l.pair == *name && l.rule == PairRule::Clearance)
            .unwrap();
        let certified = line.at_least_m.unwrap();
        assert!(least >= certified, "{name:?}: {least} found, {certified} certified");
        assert!(
            least <= certified / 0.88 + 1e-3,
            "{name:?}: {least} found, {certified} certified"
        );
    }
    let certified = bound(certificate, Requirement::Clearance);
    assert!(
        overall >= certified && overall <= certified + 2e-4,
        "{overall} found, {certified} certified"
    );
}
