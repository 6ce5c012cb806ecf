//! A washing of a UR5, handed over whole: what a dialect's text does is the plan.

use crate::programs::{program, ur5};
use nalgebra::Vector3;
use platewash_bodies::job::WashJob;
use platewash_certificate::certify;
use platewash_export::csv::Csv;
use platewash_export::dialect::{Dialect, Points};
use platewash_export::program::Point;
use platewash_export::reading::{Reading, SegmentShape};
use platewash_export::urscript::UrScript;
use platewash_fixtures::kitchen_terms;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::Trajectory;
use platewash_planner::plan;
use platewash_workcell::job::Planner;
use platewash_workcell::plate::Plate;
use std::sync::Arc;

/// One plate behind the arm's start, washed.
fn washing(arm: &RobotModel) -> Plan {
    let mut terms = kitchen_terms(arm, vec![Plate::level_disc([-0.4408, -0.2545, 0.1], 0.11, 0.02)]);
    terms.home_rad = [JointVector::from([0.0, -90.0, 90.0, -90.0, -90.0, 0.0]).map(f64::to_radians); 2];
    if let Planner::Wash(settings) = &mut terms.planner {
        settings.path_radius_m = Some(0.09);
    }
    let job = WashJob::new(Arc::new(arm.clone()), terms).unwrap();
    let plan = plan(&job).unwrap().plan;
    let certified = certify(plan, arm).unwrap_or_else(|error| panic!("{error}"));
    certified.into_parts().0
}

/// Points every step of the program's time, and where the plan rests.
fn points(plan: &Plan, motion: &Trajectory, step_s: f64, share: f64) -> Vec<Point> {
    let duration_s = motion.duration_s();
    let count = (duration_s / (step_s * share)).floor() as usize;
    let mut times: Vec<f64> = (0..=count).map(|k| k as f64 * step_s * share).collect();
    let knots = motion.times().iter().zip(motion.speeds());
    let rests: Vec<f64> = knots.filter(|(_, qd)| qd.amax() == 0.0).map(|(t_s, _)| *t_s).collect();
    times.extend(&rests);
    times.sort_by(f64::total_cmp);
    times.dedup_by(|b, a| *b - *a < 1e-9);
    let point = |t_s: f64| {
        let state = motion.at(t_s).unwrap();
        Point {
            t_s,
            q_rad: state.q,
            qd_rad_s: state.qd,
            rests: rests.contains(&t_s),
            segment: plan
                .segments
                .iter()
                .position(|segment| t_s <= segment.t_end_s)
                .unwrap_or(0),
        }
    };
    times.into_iter().map(point).collect()
}

/// Where the joints are between two points of a reading.
fn between(reading: &Reading, k: usize, part: f64) -> JointVector {
    let [a, b] = [&reading.points[k], &reading.points[k + 1]];
    let line = a.q_rad + (b.q_rad - a.q_rad) * part;
    match (reading.interpolation, a.qd_rad_s, b.qd_rad_s) {
        (SegmentShape::Cubics, Some(va), Some(vb)) => {
            let (h, s, away) = (b.t_s - a.t_s, part, b.q_rad - a.q_rad);
            line + ((va * h - away) * (1.0 - s) - (vb * h - away) * s) * (s * (1.0 - s))
        }
        _ => line,
    }
}

#[test]
fn a_washing_of_a_ur5_is_near_its_plan_in_either_dialect() {
    let arm = ur5();
    let plan = washing(&arm);
    let motion = plan.knots.motion().unwrap();
    let dialects: [(&dyn Dialect, f64); 2] = [(&UrScript, 0.2e-3), (&Csv, 0.02e-3)];
    for (dialect, most_m) in dialects {
        UrScript.accepts(&plan.job, &arm).unwrap();
        let Points::Steps { step_s } = dialect.points() else {
            panic!("steps")
        };
        for share in [1.0, 0.35] {
            let program = program(&plan, &arm, points(&plan, &motion, step_s, share), share);
            let files = dialect.write(&program);
            let clock = std::time::Instant::now();
            let reading = dialect.read(&files, &arm).unwrap();
            let read_s = clock.elapsed().as_secs_f64();
            assert_eq!(reading.points.len(), program.points.len());
            assert!((reading.share() - share).abs() < 1e-9);
            let last_s = reading.points.last().unwrap().t_s;
            assert!((last_s - plan.duration_s() / share).abs() < 1e-6);
            let tip = |q: &JointVector| -> Vector3<f64> {
                let tip = arm.pose(q, &arm.last_link_frame()) * program.tool().tip;
                tip.translation.vector
            };
            let mut worst_m = 0.0_f64;
            for k in 0..reading.points.len() - 1 {
                for part in [0.0, 0.25, 0.5, 0.75] {
                    let [a, b] = [k, k + 1].map(|k| reading.points[k].t_s);
                    let planned = motion.at((a + (b - a) * part) * share).unwrap().q;
                    worst_m = worst_m.max((tip(&between(&reading, k, part)) - tip(&planned)).norm());
                }
            }
            let (lines, bytes) = (files[0].text.lines().count(), files[0].text.len());
            println!(
                "{} at {share}: {lines} lines, {bytes} bytes, read in {read_s:.3} s, {:.4} mm from the plan of {:.2} s",
                dialect.name(),
                1e3 * worst_m,
                plan.duration_s()
            );
            assert!(worst_m < most_m, "{} at {share}: {worst_m} m", dialect.name());
        }
    }
}
