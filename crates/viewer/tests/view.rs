//! Documents of real plans against what proves, simulates and plans them.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use nalgebra::Vector3;
use platewash_certificate::{Certificate, Requirement, prove};
use platewash_fixtures::{contact_kitchen, kitchen, kitchen_tool};
use platewash_kinematics::{JointVector, RobotModel};
use platewash_motion::csv::RecordedMotion;
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::SegmentKind;
use platewash_simulator::{Execution, SimulationReport, simulate};
use platewash_viewer::View;
use platewash_viewer::view::{ExecutedMotion, ViewError, ViewExtras};
use platewash_workcell::dry_run::DryRun;
use platewash_workcell::layout::TaskRegion;
use platewash_workcell::plate::Foot;
use platewash_workcell::surface::Surface;
use platewash_workcell::wash_path::{Rings, WashPattern};
use serde_json::Value;
use std::collections::BTreeSet;
use std::sync::LazyLock;

/// The kitchen: planned, proved, simulated.
struct Kitchen {
    arm: RobotModel,
    plan: Plan,
    certificate: Certificate,
    execution: Execution,
    report: SimulationReport,
}

static KITCHEN: LazyLock<Kitchen> = LazyLock::new(|| {
    let job = kitchen();
    let plan = platewash_planner::plan(&job).unwrap().plan;
    let settings = &plan.job.simulation;
    let execution = simulate(&plan, job.arm(), settings).unwrap();
    Kitchen {
        arm: job.arm().clone(),
        certificate: prove(&plan, job.arm()).unwrap(),
        report: SimulationReport::new(&plan, job.arm(), settings, &execution).unwrap(),
        execution,
        plan,
    }
});

impl Kitchen {
    fn document(&self) -> Value {
        let executed = ExecutedMotion::simulated(&self.execution, &self.report);
        let region = TaskRegion {
            base_circle_m: Some(0.28),
            polygon_m: Some(vec![[0.0, -0.38], [0.3, -0.38], [0.3, 0.38]]),
        };
        let beside = ViewExtras {
            certificate: Some(&self.certificate),
            executed: Some(&executed),
            region: Some(&region),
            events: Some("events"),
        };
        serde_json::to_value(View::of_plan(&self.plan, &self.arm, &beside).unwrap()).unwrap()
    }
}

/// The numbers of an array, with its shape.
fn numbers(array: &Value) -> (Vec<f64>, Vec<usize>) {
    let array = array.as_object().unwrap();
    let (kind, text) = array.iter().find(|(key, _)| *key != "shape").unwrap();
    let bytes = STANDARD.decode(text.as_str().unwrap()).unwrap();
    let all: Vec<f64> = match kind.as_str() {
        "f64" => bytes
            .chunks_exact(8)
            .map(|b| f64::from_le_bytes(b.try_into().unwrap()))
            .collect(),
        "f32" => bytes
            .chunks_exact(4)
            .map(|b| f32::from_le_bytes(b.try_into().unwrap()).into())
            .collect(),
        "u16" => bytes
            .chunks_exact(2)
            .map(|b| u16::from_le_bytes(b.try_into().unwrap()).into())
            .collect(),
        "u8" => bytes.into_iter().map(f64::from).collect(),
        other => panic!("{other}"),
    };
    let shape: Vec<usize> = array["shape"]
        .as_array()
        .unwrap()
        .iter()
        .map(|n| n.as_u64().unwrap() as usize)
        .collect();
    assert_eq!(all.len(), shape.iter().product::<usize>());
    (all, shape)
}

/// Shares of the cells inside the rim that were ever swept, plate by plate.
fn shares(coverage: &Value) -> Vec<(u64, f64)> {
    let share = |plate: &Value| {
        let (first, _) = numbers(&plate["first"]);
        let inside = first.iter().filter(|mark| **mark != 65534.0).count();
        let swept = first.iter().filter(|mark| **mark < 65534.0).count();
        (plate["plate"].as_u64().unwrap(), swept as f64 / inside as f64)
    };
    coverage.as_array().unwrap().iter().map(share).collect()
}

#[test]
fn the_clearance_over_time_is_that_of_the_certificate() {
    let document = KITCHEN.document();
    let clearance = &document["clearance"];
    let (times, _) = numbers(&clearance["t_s"]);
    let (distances, _) = numbers(&clearance["distance_m"]);
    let (nearest, shape) = numbers(&clearance["nearest_m"]);
    assert_eq!(shape, [times.len(), 2, 3]);
    assert!(times.is_sorted() && times[0] == 0.0 && times[times.len() - 1] == KITCHEN.plan.duration_s());
    let proved = KITCHEN.certificate.check(Requirement::Clearance).unwrap();
    let measure = proved.measure.unwrap();
    let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
    // Never below what is proved, and no greater than what the proof found, whose moment is among those shown.
    assert!(least >= measure.bound.unwrap() - 1e-6, "{least}");
    assert!(least <= measure.seen.unwrap() + 1e-6, "{least} {:?}", measure.seen);
    assert!(times.contains(&proved.worst.time_s.unwrap()));
    for (points, distance) in nearest.chunks_exact(6).zip(&distances) {
        let between = Vector3::from_column_slice(&points[3..]) - Vector3::from_column_slice(&points[..3]);
        assert!(
            (between.norm() - distance).abs() < 1e-5,
            "{} {distance}",
            between.norm()
        );
    }
    let names = clearance["names"].as_array().unwrap();
    let (pairs, _) = numbers(&clearance["pair"]);
    assert!(pairs.iter().all(|body| (*body as usize) < names.len()));
    // While it washes, the sponge on its plate is no pair that counts.
    for (at, pair) in times.iter().zip(pairs.chunks_exact(2)) {
        let on = |s: &&platewash_motion::trajectory::PlanSegment| s.t_start_s < *at && *at < s.t_end_s;
        let segment = KITCHEN.plan.segments.iter().find(on);
        if let Some(segment) = segment.filter(|s| s.kind == SegmentKind::Wash) {
            let named: BTreeSet<_> = pair
                .iter()
                .map(|body| names[*body as usize].as_str().unwrap())
                .collect();
            let own = platewash_workcell::words::plate_name(segment.plate);
            assert!(!(named.contains("sponge") && named.contains(own.as_str())), "{named:?}");
        }
    }
}

#[test]
fn the_swept_share_agrees_with_proof_and_simulation() {
    let document = KITCHEN.document();
    let planned = shares(&document["coverage"]);
    let executed = shares(&document["execution"]["coverage"]);
    assert_eq!(planned.len(), 4);
    for (k, (plate, share)) in planned.iter().enumerate() {
        let proved = &KITCHEN.certificate.swept[k];
        assert_eq!(*plate as usize, proved.plate);
        assert!(*share >= proved.at_least - 0.005, "{share} {}", proved.at_least);
        assert_eq!(document["coverage"][k]["proved"], proved.at_least);
        let outcome = &KITCHEN.report.plates[k];
        assert!((executed[k].1 - outcome.executed.fraction).abs() < 0.005);
    }
}

/// Of a job that says what counts as contact the maps show that, and the certificate's words are its own.
#[test]
fn the_pressed_share_agrees_with_the_proof() {
    let job = contact_kitchen();
    let job = job.on_plates(job.terms().plates[..1].to_vec()).unwrap();
    let plan = platewash_planner::plan(&job).unwrap().plan;
    let certificate = prove(&plan, job.arm()).unwrap();
    let proved = certificate.contact[0];
    let document = |plan: &Plan, certificate| {
        let beside = ViewExtras {
            certificate,
            ..ViewExtras::default()
        };
        serde_json::to_value(View::of_plan(plan, job.arm(), &beside).unwrap()).unwrap()
    };
    let shown = document(&plan, Some(&certificate));
    let [coverage, contact] = ["/coverage/0", "/certificate/contact"].map(|at| shown.pointer(at).unwrap());
    let counted = serde_json::json!({"compression_m": 0.001, "height_error_m": 0.001, "is_promised": true});
    assert_eq!(
        (&coverage["counted"], &coverage["proved"]),
        (&counted, &Value::from(proved.pressed.at_least))
    );
    let [(_, share)] = shares(&shown["coverage"])[..] else {
        panic!()
    };
    assert!(
        share >= proved.pressed.at_least - 0.002,
        "{share} {}",
        proved.pressed.at_least
    );
    assert_eq!(
        contact["asked"],
        serde_json::to_value(plan.job.requirements.contact).unwrap()
    );
    assert_eq!(contact["plates"], serde_json::json!([proved]));
    // Dirt goes where the dose is proved. Without a certificate there is none.
    let dirt = &shown["dirt"][0];
    assert_eq!(
        (&dirt["plate"], &dirt["dose_pa_m"]),
        (&Value::from(0), &Value::from(proved.dose.threshold))
    );
    let (clean, _) = numbers(&dirt["clean"]);
    let inside: Vec<_> = clean.iter().filter(|step| **step != 65534.0).collect();
    let share = inside.iter().filter(|step| ***step < 65534.0).count() as f64 / inside.len() as f64;
    assert!(
        (share - proved.dose.at_least).abs() < 0.01,
        "{share} {}",
        proved.dose.at_least
    );
    let step_s = dirt["step_s"].as_f64().unwrap();
    let washes = plan.segments.iter().filter(|segment| segment.kind == SegmentKind::Wash);
    let [start_s, end_s] = washes.map(|wash| [wash.t_start_s, wash.t_end_s]).next().unwrap();
    let is_within = |step: f64| (start_s..=end_s + step_s).contains(&(step * step_s));
    assert!(inside.iter().all(|step| **step == 65535.0 || is_within(**step)));
    assert_eq!(document(&plan, None)["dirt"], serde_json::json!([]));
    for words in [
        "pressed",
        "contact time",
        "contact dose",
        "strain",
        "contact force",
        "wrist",
    ] {
        let all = shown["certificate"]["checks"].as_array().unwrap();
        assert!(all.iter().any(|check| check["words"] == words), "{words}");
    }
    // A sponge that is pressed in by 6 mm and tilted by 8° presses nothing by 10 mm, wherever it was.
    let mut deep = plan.clone();
    deep.job.requirements.contact.as_mut().unwrap().compression_m = 0.01;
    let [(_, none)] = shares(&document(&deep, None)["coverage"])[..] else {
        panic!()
    };
    assert_eq!(none, 0.0);
}

/// The foot of a plate is told, and a profile without a promise counts where it is touched.
#[test]
fn plates_with_a_profile_include_their_foot() {
    let mut plan = KITCHEN.plan.clone();
    let plate = &mut plan.job.plates[0];
    plate.surface = Surface::shipped("coupe275").unwrap();
    plate.foot = Some(Foot {
        radius_m: 0.06,
        height_m: 0.004,
    });
    let view = View::of_plan(&plan, &KITCHEN.arm, &ViewExtras::default()).unwrap();
    let document = serde_json::to_value(&view).unwrap();
    let told = |pointer: &str| document.pointer(pointer).cloned().unwrap_or_default();
    assert_eq!(
        told("/plates/0/foot"),
        serde_json::json!({"radius_m": 0.06, "height_m": 0.004})
    );
    assert_eq!(told("/plates/1/foot"), Value::Null);
    let of = |plate: u64| {
        view.coverage
            .iter()
            .find(|coverage| coverage.plate as u64 == plate)
            .unwrap()
    };
    assert_eq!(
        of(0)
            .counted
            .map(|counted| (counted.compression_m, counted.is_promised)),
        Some((0.0, false))
    );
    assert_eq!(of(1).counted, None);
}

/// A path without its ring leaves part of the rim: as much as the simulation measures.
#[test]
fn the_document_shows_unswept_area() {
    let job = kitchen();
    let mut terms = job.terms().clone();
    let platewash_workcell::job::Planner::Wash(settings) = &mut terms.planner else {
        panic!()
    };
    (settings.closing_ring, settings.turns) = (Some(false), Some(2.0));
    let job = platewash_bodies::job::WashJob::new(job.shared_arm(), terms).unwrap();
    let plan = platewash_planner::plan(&job).unwrap().plan;
    let settings = &plan.job.simulation;
    let execution = simulate(&plan, job.arm(), settings).unwrap();
    let report = SimulationReport::new(&plan, job.arm(), settings, &execution).unwrap();
    let view = View::of_plan(&plan, job.arm(), &ViewExtras::default()).unwrap();
    let shown = shares(&serde_json::to_value(&view.coverage).unwrap());
    for ((_, share), outcome) in shown.iter().zip(&report.plates) {
        let measured = outcome.planned.fraction;
        assert!(measured < 0.95 && (share - measured).abs() < 0.01, "{share} {measured}");
    }
}

#[test]
fn the_arm_of_a_document_is_the_arm() {
    let document = KITCHEN.document();
    let pose = |value: &Value| {
        let list = |key: &str| -> Vec<f64> { serde_json::from_value(value[key].clone()).unwrap() };
        let (p, q) = (list("position_m"), list("quaternion_wxyz"));
        let rotation = nalgebra::UnitQuaternion::new_normalize(nalgebra::Quaternion::new(q[0], q[1], q[2], q[3]));
        nalgebra::Isometry3::from_parts(nalgebra::Translation3::new(p[0], p[1], p[2]), rotation)
    };
    let arm = &document["arm"];
    let q = JointVector::new(0.3, -0.2, 0.5, 1.1, -0.7, 2.0);
    let mut frames = vec![pose(&arm["mount"])];
    for (k, joint) in arm["joints"].as_array().unwrap().iter().enumerate() {
        let turn = nalgebra::UnitQuaternion::from_axis_angle(&Vector3::z_axis(), q[k]);
        frames.push(frames[k] * pose(&joint["origin"]) * turn);
    }
    let tip = frames[6] * pose(&arm["flange"]) * pose(&document["tool"]["tip"]);
    let expected = KITCHEN
        .arm
        .pose(&q, &KITCHEN.plan.job.workcell.tool.tip_frame(&KITCHEN.arm));
    assert!((tip.translation.vector - expected.translation.vector).norm() < 1e-12);
    assert!(tip.rotation.angle_to(&expected.rotation) < 1e-7);
    for (link, known) in arm["links"].as_array().unwrap().iter().zip(KITCHEN.arm.links()) {
        let shown = frames[link["joints"].as_u64().unwrap() as usize] * pose(&link["pose"]);
        let expected = KITCHEN.arm.pose(&q, &known.frame);
        assert!((shown.translation.vector - expected.translation.vector).norm() < 1e-12);
        assert_eq!(link["collision"].as_array().unwrap().len(), known.collision.len());
    }
    // Our own description: white castings and dark fittings, by the names of its materials.
    let base = &arm["links"][0]["visuals"][0];
    assert!(
        base["rgba"]
            .as_array()
            .unwrap()
            .iter()
            .all(|share| (0.0..=1.0).contains(&share.as_f64().unwrap()))
    );
}

#[test]
fn an_execution_is_thinned_and_keeps_its_end_and_its_error() {
    let document = KITCHEN.document();
    let execution = &document["execution"];
    let (times, _) = numbers(&execution["t_s"]);
    let samples = &KITCHEN.execution.samples;
    assert_eq!(
        (times[0], times[times.len() - 1]),
        (0.0, samples[samples.len() - 1].t_s)
    );
    let steps = times.windows(2).map(|pair| pair[1] - pair[0]);
    let count = times.len();
    assert!(count <= 2501 && steps.take(count - 2).all(|step| step >= 0.0099));
    let (errors, _) = numbers(&execution["error_m"]);
    let most = errors.iter().copied().fold(0.0, f64::max);
    let stated = KITCHEN.report.tracking.tip_m.max;
    assert!(most <= stated * (1.0 + 1e-6) && most > 0.8 * stated, "{most} {stated}");
    assert_eq!(numbers(&execution["torque_n_m"]).1, [count, 6]);
    assert_eq!(
        (&execution["law"], &execution["washed"]),
        (&Value::from("computed_torque"), &Value::from(true))
    );
}

/// What `run` writes, read back: the same motion but for the step of the table.
#[test]
fn a_recorded_motion_looks_like_its_simulation() {
    let kitchen = &*KITCHEN;
    let table = platewash_simulator::simulate::table(&kitchen.execution, &kitchen.plan, &kitchen.arm, 0.01).unwrap();
    let recorded = RecordedMotion::from_csv(&table.to_string()).unwrap();
    let shown = |executed: &ExecutedMotion| {
        let beside = ViewExtras {
            executed: Some(executed),
            ..ViewExtras::default()
        };
        let view = View::of_plan(&kitchen.plan, &kitchen.arm, &beside);
        serde_json::to_value(view.unwrap().execution.unwrap()).unwrap()
    };
    let (simulated, read) = (
        shown(&ExecutedMotion::simulated(&kitchen.execution, &kitchen.report)),
        shown(&ExecutedMotion::recorded(&recorded)),
    );
    assert_eq!(
        (&read["source"], &read["law"], &read["washed"]),
        (&Value::from("recorded"), &Value::Null, &Value::Null)
    );
    let most = |execution: &Value| numbers(&execution["error_m"]).0.into_iter().fold(0.0, f64::max);
    assert!((most(&simulated) - most(&read)).abs() < 1e-5);
    for (a, b) in shares(&simulated["coverage"]).iter().zip(shares(&read["coverage"])) {
        assert!((a.1 - b.1).abs() < 0.01);
    }
}

#[test]
fn a_motion_of_another_plan_shows_by_its_error_or_is_refused() {
    let kitchen = &*KITCHEN;
    let table = platewash_simulator::simulate::table(&kitchen.execution, &kitchen.plan, &kitchen.arm, 0.05).unwrap();
    let recorded = RecordedMotion::from_csv(&table.to_string()).unwrap();
    let view = |recorded: &RecordedMotion| {
        let executed = ExecutedMotion::recorded(recorded);
        let beside = ViewExtras {
            executed: Some(&executed),
            ..ViewExtras::default()
        };
        View::of_plan(&kitchen.plan, &kitchen.arm, &beside)
    };
    let mut elsewhere = recorded.clone();
    elsewhere.samples.truncate(100);
    for sample in &mut elsewhere.samples {
        sample.q[0] += 0.5;
    }
    let shown = serde_json::to_value(view(&elsewhere).unwrap().execution.unwrap()).unwrap();
    assert!(numbers(&shown["error_m"]).0.iter().all(|error| *error > 0.1));
    let mut longer = recorded;
    for sample in &mut longer.samples {
        sample.t_s *= 1.5;
    }
    let refused = view(&longer).unwrap_err();
    assert!(matches!(refused, ViewError::BeyondEnd { .. }), "{refused}");
    assert!(refused.to_string().contains("not of this plan"), "{refused}");
}

#[test]
fn a_document_does_not_depend_on_the_number_of_threads() {
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| KITCHEN.document())
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn documents_have_a_bounded_size() {
    let length = KITCHEN.document().to_string().len();
    assert!(length < 1_000_000, "{length}");
}

#[test]
fn shows_a_failed_plan_with_its_broken_requirements() {
    let kitchen = &*KITCHEN;
    let mut plan = kitchen.plan.clone();
    plan.job.requirements.clearance_m = 0.06;
    let certificate = prove(&plan, &kitchen.arm).unwrap();
    let beside = ViewExtras {
        certificate: Some(&certificate),
        ..ViewExtras::default()
    };
    let document = serde_json::to_value(View::of_plan(&plan, &kitchen.arm, &beside).unwrap()).unwrap();
    let shown = &document["certificate"];
    assert_eq!(
        (&shown["passes"], &shown["hash"]),
        (&Value::from(false), &Value::from("violated"))
    );
    let checks = shown["checks"].as_array().unwrap();
    let clearance = checks.iter().find(|check| check["requirement"] == "clearance").unwrap();
    assert_eq!(clearance["status"], "violated");
    let detail = clearance["detail"].as_str().unwrap();
    assert!(
        detail.contains("limit ≥ 60") && detail.contains("found: 19."),
        "{detail}"
    );
    assert!(clearance["worst"]["time_s"].is_number() && clearance["worst"]["place_m"].is_array());
    assert!(clearance["place"].as_str().unwrap().contains(" and "));
    assert_eq!(document["clearance"]["margin_m"], 0.06);
}

#[test]
fn rejects_invalid_plans_and_shows_unusual_ones() {
    let kitchen = &*KITCHEN;
    let shown = |change: fn(&mut Plan)| {
        let mut plan = kitchen.plan.clone();
        change(&mut plan);
        View::of_plan(&plan, &kitchen.arm, &ViewExtras::default())
    };
    let none = |plan: &mut Plan| {
        plan.knots.t_s.clear();
        plan.knots.q_rad.clear();
        plan.knots.qd_rad_s.clear();
    };
    assert_eq!(shown(none), Err(ViewError::NoMotion));
    assert!(matches!(
        shown(|plan| plan.knots.t_s[3] = f64::NAN),
        Err(ViewError::Knots(_))
    ));
    assert!(matches!(shown(|plan| plan.job.plates.clear()), Err(ViewError::Job(_))));
    assert!(
        shown(|plan| plan.segments.iter_mut().for_each(|s| s.plate = 77))
            .unwrap()
            .coverage
            .is_empty()
    );
    assert!(shown(|plan| plan.segments.clear()).unwrap().clearance.is_some());
    assert_eq!(
        shown(|plan| plan.wash_paths[0].curve.turns = 1e12).unwrap().paths.len(),
        3
    );
    const ENDLESS: Rings = Rings {
        count: 3,
        inner_m: 0.02,
        lead_rad: 2.0,
        blend_rad: 1.7,
        laps: u32::MAX,
    };
    assert_eq!(
        shown(|plan| plan.wash_paths[0].curve.pattern = WashPattern::Rings(ENDLESS))
            .unwrap()
            .paths
            .len(),
        3
    );
    // As a run of the paper's program: what the tip does while it washes.
    let followed = shown(|plan| plan.wash_paths.clear()).unwrap();
    assert_eq!(followed.paths.len(), 4);
}

/// Whatever the plan is called: what it states of itself is told.
#[test]
fn the_document_of_a_dry_run_says_so() {
    assert_eq!(KITCHEN.document()["heading"]["dry_run"], Value::Null);
    let mut plan = KITCHEN.plan.clone();
    let dry_run = DryRun {
        parent: KITCHEN.plan.hash.clone().unwrap(),
        height_m: 0.05,
    };
    plan.job.dry_run = Some(dry_run.clone());
    let view = View::of_plan(&plan, &KITCHEN.arm, &ViewExtras::default()).unwrap();
    assert_eq!(view.heading.dry_run, Some(dry_run.words()));
}

#[test]
fn a_document_of_a_configuration_has_no_motion() {
    let robot = RobotModel::irb120().unwrap();
    let q = JointVector::new(0.1, 0.2, 0.3, 0.4, 0.5, 0.6);
    let view = View::of_configuration(&robot, Some(&kitchen_tool()), &q);
    let document = serde_json::to_value(view).unwrap();
    assert_eq!(document["pose_rad"], serde_json::json!([0.1, 0.2, 0.3, 0.4, 0.5, 0.6]));
    assert_eq!(
        (&document["motion"], &document["heading"]["process"]),
        (&Value::Null, &Value::Null)
    );
    assert_eq!(document["tool"]["bodies"][0]["name"], "handle");
}
