//! Recovery from a stop: from where the arm stands home with a proof, or the true reason; then the plates that are left.

use crate::shipped;
use platewash::bodies::clearance::{ClearanceModel, PairClearance};
use platewash::certificate::{Requirement, Status, certify, prove};
use platewash::export::dialects::by_name;
use platewash::export::program::ProgramFile;
use platewash::export::{ExportSettings, compare, export};
use platewash::kinematics::RobotModel;
use platewash::motion::dry_run::dry_run_terms;
use platewash::motion::trajectory::SegmentKind;
use platewash::planner::{Recovered, RecoveryError, Stop, Watch, recover};
use platewash::workcell::ReducedClearance;
use platewash::workcell::job::RecoveryPart;
use platewash::workcell::random::stream;
use platewash::{CancelToken, JointVector, Plan};
use rand::{Rng, RngExt};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Largest distance of a joint from the plan \[deg\].
const OFF_DEG: f64 = 2.0;

/// Time between samples of a motion \[s\].
const STEP_S: f64 = 2e-3;

/// Rounding of distances \[m\].
const ROUNDING_M: f64 = 1e-7;

fn planned(scenario: &str) -> (Plan, Arc<RobotModel>) {
    let (job, plan) = shipped::planned(scenario);
    (plan.clone(), job.shared_arm())
}

/// A moment of a plan, and where the arm stands then, off by up to the given share of [`OFF_DEG`].
fn stopped(plan: &Plan, rng: &mut impl Rng, share: f64) -> (f64, JointVector) {
    let time_s = rng.random_range(0.0..plan.duration_s());
    let q = plan.knots.motion().unwrap().at(time_s).unwrap().q;
    (
        time_s,
        q.map(|q| q + share * rng.random_range(-OFF_DEG..OFF_DEG).to_radians()),
    )
}

fn recovered(
    plan: &Plan,
    arm: &Arc<RobotModel>,
    q: &JointVector,
    time_s: Option<f64>,
) -> Result<Recovered, RecoveryError> {
    recover(plan, arm, q, time_s, &Watch::silent(&CancelToken::new()))
}

/// Pairs that are not clear at a configuration, without the sponge and the plates that it may touch.
fn not_clear(model: &ClearanceModel, q: &JointVector, working: &[usize], required_m: f64) -> Vec<PairClearance> {
    model.too_near(q, working, required_m - ROUNDING_M)
}

/// Samples the motion home: what is near at the start comes no nearer, everything else keeps clear, and the sponge only leaves its plate.
fn sample(stopped: &Plan, arm: &RobotModel, home: &Plan) {
    let job = &stopped.job;
    let model = ClearanceModel::new(arm, &job.workcell, &job.plates).unwrap();
    let clearance_m = job.requirements.clearance_m;
    let motion = home.knots.motion().unwrap();
    let tip = job.workcell.tool.tip_frame(arm);
    let start = not_clear(&model, &motion.at(0.0).unwrap().q, &[], clearance_m);
    let mut before_m = f64::NEG_INFINITY;
    let steps = (motion.duration_s() / STEP_S).ceil() as usize;
    for t_s in (0..=steps).map(|k| STEP_S * k as f64) {
        let q = motion.at(t_s).unwrap().q;
        let retreat = home
            .segments
            .iter()
            .find(|s| s.kind == SegmentKind::Retreat && t_s <= s.t_end_s);
        let working: Vec<_> = retreat.iter().map(|segment| segment.plate).collect();
        for pair in not_clear(&model, &q, &working, clearance_m) {
            let was = start.iter().find(|near| near.a == pair.a && near.b == pair.b);
            let allowed_m = was.map_or(clearance_m, |was| was.distance_m - 1e-4);
            assert!(
                pair.distance_m > 0.0 && pair.distance_m >= allowed_m - ROUNDING_M,
                "at {t_s} s: {pair:?}"
            );
        }
        if let Some(segment) = retreat {
            let plate = &job.plates[segment.plate];
            let height_m = plate.height_of(&arm.fk(&q).rigid(&tip).translation);
            assert!(
                height_m >= before_m - 1e-6,
                "at {t_s} s the tip goes down to {height_m} m"
            );
            before_m = height_m;
        }
    }
    let last = motion.at(motion.duration_s()).unwrap().q;
    assert!((last - job.home_rad[0]).amax() < 1e-9);
}

/// What came of random stops.
#[derive(Debug, Default)]
struct Tally {
    proved: u64,
    /// Of them, those with pairs nearer than asked at the start.
    near: u64,
    /// Number of times that each reason was given.
    refused: BTreeMap<String, u64>,
}

/// Recovers from random stops, with joints off by up to `share` of [`OFF_DEG`], some by a tenth of that.
fn stops(scenario: &str, count: u64, share: f64) -> Tally {
    let (plan, arm) = planned(scenario);
    let model = ClearanceModel::new(&arm, &plan.job.workcell, &plan.job.plates).unwrap();
    let (mut tally, mut rests) = (Tally::default(), BTreeSet::new());
    for seed in 0..count {
        let mut rng = stream(seed, "stops");
        let share = if seed % 4 == 0 { 0.1 * share } else { share };
        let (time_s, q) = stopped(&plan, &mut rng, share);
        let place = format!("{scenario}, stop {seed} at {time_s} s, {q:?}");
        match recovered(&plan, &arm, &q, Some(time_s)) {
            Ok(Recovered { stop, near, home, rest }) => {
                let certificate = prove(&home, &arm).unwrap();
                assert!(certificate.passes(), "{place}: {}", certificate.headline);
                sample(&plan, &arm, &home);
                let reduced = certificate.check(Requirement::ReducedClearance);
                assert!(
                    near.is_empty() || reduced.is_some_and(|check| check.status == Status::Proved),
                    "{place}"
                );
                let ended = plan
                    .segments
                    .iter()
                    .filter(|s| s.kind == SegmentKind::Wash && s.t_end_s <= time_s);
                assert_eq!(stop.washed, ended.map(|s| s.plate).collect::<Vec<_>>(), "{place}");
                // By the joints alone no plate is left out that was not washed.
                let guessed = Stop::new(&plan, &plan.knots.motion().unwrap(), &q, None).unwrap();
                assert!(
                    guessed.washed.iter().all(|plate| stop.washed.contains(plate)),
                    "{place}: {guessed:?}"
                );
                let left = plan.order.len() - stop.washed.len();
                assert_eq!(rest.as_ref().map_or(0, |rest| rest.order.len()), left, "{place}");
                if let Some(rest) = rest.filter(|_| rests.insert(stop.washed.clone())) {
                    check_rest(&plan, &arm, &rest, &stop);
                }
                tally.proved += 1;
                tally.near += u64::from(!near.is_empty());
            }
            Err(error) => {
                true_reason(&error, &model, &arm, &q, &place);
                let words = error.to_string();
                let kind = words.split(['\'', ',', ':']).next().unwrap_or_default().to_owned();
                println!("{place}: {words}");
                *tally.refused.entry(kind).or_default() += 1;
            }
        }
    }
    println!(
        "{scenario}, off by up to {:.1} deg: of {count} {tally:?}",
        share * OFF_DEG
    );
    tally
}

/// Checks that the plates that are left are washed as planned, with a proof.
fn check_rest(plan: &Plan, arm: &RobotModel, rest: &Plan, stop: &Stop) {
    let order: Vec<_> = plan
        .order
        .iter()
        .copied()
        .filter(|plate| !stop.washed.contains(plate))
        .collect();
    assert_eq!(rest.order, order);
    for path in &rest.wash_paths {
        assert_eq!(path.curve, plan.wash_path_of(path.plate).unwrap().curve);
    }
    let certificate = prove(rest, arm).unwrap();
    assert!(certificate.passes(), "{}", certificate.headline);
    assert_eq!(certificate.plates_washed(), order.len());
}

/// Checks what a refusal says.
fn true_reason(error: &RecoveryError, model: &ClearanceModel, arm: &RobotModel, q: &JointVector, place: &str) {
    match error {
        RecoveryError::Limit(_) => assert!(arm.limits().violation(q).is_some(), "{place}"),
        RecoveryError::Touching { pair } => {
            let all = model.all(q);
            let found = all.iter().find(|found| found.a == pair.a && found.b == pair.b).unwrap();
            assert!(found.distance_m <= 1e-4 + ROUNDING_M, "{place}: {found:?}");
        }
        RecoveryError::OtherTime {
            found_off_rad,
            fits_off_rad,
            ..
        } => assert!(*found_off_rad > 0.06 && fits_off_rad < found_off_rad, "{place}"),
        RecoveryError::NoWay { plate, pair } => assert!(plate.is_some() || pair.is_some(), "{place}"),
        other => panic!("{place}: {other}"),
    }
}

fn thorough(few: u64, many: u64) -> u64 {
    if std::env::var_os("PLATEWASH_THOROUGH").is_some() {
        many
    } else {
        few
    }
}

#[test]
fn random_stops_are_recovered_with_a_proof_or_refused_with_the_reason() {
    for (scenario, count) in [
        ("kitchen", thorough(8, 120)),
        ("rim", thorough(4, 50)),
        ("sink", thorough(3, 30)),
    ] {
        let tally = stops(scenario, count, 1.0);
        assert!(tally.proved > 0, "{tally:?}");
    }
}

/// So far off that bodies are near, and some touch.
#[test]
fn stops_far_off_the_plan_are_recovered_or_refused_by_the_pair_that_touches() {
    let tally = stops("kitchen", thorough(40, 300), 4.0);
    assert!(
        tally.proved > 0 && tally.near > 0 && !tally.refused.is_empty(),
        "{tally:?}"
    );
}

/// A stop in the middle of the second wash.
fn in_second_wash(plan: &Plan) -> (f64, JointVector) {
    let wash = plan
        .segments
        .iter()
        .filter(|s| s.kind == SegmentKind::Wash)
        .nth(1)
        .unwrap();
    let time_s = 0.5 * (wash.t_start_s + wash.t_end_s);
    (time_s, plan.knots.motion().unwrap().at(time_s).unwrap().q)
}

#[test]
fn both_plans_are_exported_for_the_arm_where_it_stands() {
    let (plan, arm) = planned("kitchen");
    let (time_s, q) = in_second_wash(&plan);
    let Recovered { stop, home, rest, .. } = recovered(&plan, &arm, &q, None).unwrap();
    assert_eq!(
        (stop.at_plate, stop.washed.len()),
        (Some(plan.order[1]), 1),
        "{stop:?} {time_s}"
    );
    // The sponge may be at a plate where the motion home starts.
    for (plan, within_deg) in [(home, 0.1), (rest.unwrap(), 0.5)] {
        let start = plan.job.home_rad[0];
        let certified = certify(plan, &arm).unwrap();
        let rapid = by_name("rapid").unwrap();
        let told = export(&certified, &arm, rapid, &ExportSettings::default(), &CancelToken::new()).unwrap();
        assert!(told.judgement.holds());
        let first = told.reading.points[0].q_rad;
        assert!((first - start).amax() < 1e-5, "{first} {start}");
        for dialect in ["rapid", "ros2"].map(|name| by_name(name).unwrap()) {
            let told = export(
                &certified,
                &arm,
                dialect,
                &ExportSettings::default(),
                &CancelToken::new(),
            )
            .unwrap();
            assert_eq!(told.reading.start_within_deg, Some(within_deg), "{dialect:?}");
            let checks_start = |files: &[ProgramFile]| {
                let compared = compare(&certified, &arm, files, &CancelToken::new()).unwrap();
                assert!(compared.holds());
                compared.checks_start
            };
            assert!(checks_start(&told.files), "{dialect:?}");
            // A start from farther away is not the one that was exported.
            let mut edited = told.files.clone();
            for file in &mut edited {
                for (from, to) in [
                    ("<=0.1 RETURN", "<=0.5 RETURN"),
                    ("0.1 deg", "0.5 deg"),
                    ("MOST_DEG = 0.1", "MOST_DEG = 0.5"),
                ] {
                    file.text = file.text.replace(from, to);
                }
            }
            assert_eq!(checks_start(&edited), within_deg == 0.5, "{dialect:?}");
            // An edit of the check is named by its own line.
            let (marked, line) = told
                .files
                .iter()
                .find_map(|file| {
                    Some((
                        file,
                        file.text.lines().position(|line| {
                            line.contains("Nothing has moved") && line.contains("main") || line.contains("PATIENCE_S =")
                        })?,
                    ))
                })
                .unwrap();
            let changed: Vec<_> = marked
                .text
                .lines()
                .enumerate()
                .map(|(k, text)| {
                    if k == line {
                        text.replace("pointer", "Pointer").replace("= 5.0", "= 6.0")
                    } else {
                        text.to_owned()
                    }
                })
                .collect();
            let mut edited = told.files.clone();
            edited.iter_mut().find(|file| file.name == marked.name).unwrap().text = changed.join("\n") + "\n";
            let refused = dialect.read(&edited, &arm).unwrap_err();
            assert_eq!(refused.place.line, line + 1, "{refused}");
        }
        let mut stands = start;
        stands[2] += 0.3_f64.to_radians();
        let settings = ExportSettings {
            stands_rad: Some(stands),
            ..ExportSettings::default()
        };
        let told = export(&certified, &arm, rapid, &settings, &CancelToken::new());
        assert_eq!(told.is_ok(), within_deg > 0.3);
    }
}

#[test]
fn a_recovery_is_a_plan_that_reads_back_and_names_its_parent() {
    let (plan, arm) = planned("kitchen");
    let (_, q) = in_second_wash(&plan);
    let Recovered { home, rest, .. } = recovered(&plan, &arm, &q, None).unwrap();
    for plan_of in [&home, rest.as_ref().unwrap()] {
        assert_eq!(&Plan::from_json(&plan_of.to_json().unwrap()).unwrap(), plan_of);
        assert_eq!(plan_of.job.recovery.as_ref().map(|r| &r.parent), plan.hash.as_ref());
    }
    let recovery = home.job.recovery.as_ref().unwrap();
    let RecoveryPart::Home { retreat: Some(line) } = recovery.part else {
        panic!("{recovery:?}")
    };
    assert!(line.plate == plan.order[1] && line.length_m < 0.05, "{line:?}");
    assert_eq!(recovered(&home, &arm, &q, None).err(), Some(RecoveryError::MotionHome));
}

/// The certificate believes no statement of the recovery that it can check.
#[test]
fn an_edited_recovery_is_not_proved() {
    let (plan, arm) = planned("kitchen");
    let (_, q) = in_second_wash(&plan);
    let Recovered { home, rest, .. } = recovered(&plan, &arm, &q, None).unwrap();
    let status = |plan: &Plan, edit: &dyn Fn(&mut Plan), requirement| {
        let mut edited = plan.clone();
        edit(&mut edited);
        edited.hash = Some(edited.seal().unwrap());
        let certificate = prove(&edited, &arm).unwrap();
        assert!(!certificate.passes(), "{requirement:?}: {}", certificate.headline);
        certificate.check(requirement).unwrap().status
    };
    let line = |plan: &mut Plan, edit: &dyn Fn(&mut platewash::workcell::job::RetreatLine)| {
        let Some(RecoveryPart::Home { retreat: Some(line) }) = plan.job.recovery.as_mut().map(|r| &mut r.part) else {
            panic!()
        };
        edit(line);
    };
    let longer = |plan: &mut Plan| line(plan, &|line| line.length_m += 0.02);
    assert_eq!(status(&home, &longer, Requirement::LineDeviation), Status::Violated);
    let other_plate = |plan: &mut Plan| line(plan, &|line| line.plate = (line.plate + 1) % 3);
    assert_eq!(status(&home, &other_plate, Requirement::Segments), Status::Violated);
    let faster = |plan: &mut Plan| {
        for t_s in &mut plan.knots.t_s {
            *t_s *= 0.5;
        }
        for qd in &mut plan.knots.qd_rad_s {
            *qd *= 2.0;
        }
        for segment in &mut plan.segments {
            segment.t_start_s *= 0.5;
            segment.t_end_s *= 0.5;
        }
    };
    assert_eq!(status(&home, &faster, Requirement::ContactSpeed), Status::Violated);
    let elsewhere = |plan: &mut Plan| plan.job.home_rad[0][0] += 0.01;
    assert_eq!(status(&home, &elsewhere, Requirement::HomeToHome), Status::Violated);
    // As if the whole motion were part of the retreat.
    let never_clear = |plan: &mut Plan| {
        let end = plan.segments[1].t_end_s;
        plan.segments[0].t_end_s = end;
        plan.segments.truncate(1);
    };
    assert_eq!(status(&home, &never_clear, Requirement::Segments), Status::Violated);
    let all_washed = |plan: &mut Plan| {
        let left = plan.order[0];
        let recovery = plan.job.recovery.as_mut().unwrap();
        recovery.left_out.push(left);
        recovery.left_out.sort_unstable();
    };
    assert_eq!(
        status(&rest.unwrap(), &all_washed, Requirement::EveryPlateOnce),
        Status::Violated
    );
}

#[test]
fn what_cannot_be_recovered_is_refused() {
    let (plan, arm) = planned("kitchen");
    let (_, q) = in_second_wash(&plan);
    let refused = |q: &JointVector, time_s| recovered(&plan, &arm, q, time_s).unwrap_err();
    assert!(matches!(refused(&q, Some(-0.1)), RecoveryError::Time { .. }));
    assert!(matches!(refused(&q, Some(f64::NAN)), RecoveryError::Time { .. }));
    assert!(matches!(refused(&q, Some(1e9)), RecoveryError::Time { .. }));
    assert_eq!(refused(&JointVector::repeat(f64::NAN), None), RecoveryError::NotFinite);
    let beyond = q + JointVector::new(0.0, 0.0, 0.0, 0.0, 9.0, 0.0);
    assert!(refused(&beyond, None).to_string().contains("joint 5"));
    // The tool is in the plate.
    let mut deep = q;
    deep[1] += 0.1;
    let words = refused(&deep, None).to_string();
    assert!(words.contains("touch"), "{words}");
    let mut edited = plan.clone();
    edited.knots.q_rad[3][0] += 1e-6;
    assert_eq!(
        recovered(&edited, &arm, &q, None).unwrap_err(),
        RecoveryError::NotSealed
    );
}

/// A sponge that is near a plate from behind or below is not at its face: a way along the normal would lead through the plate.
#[test]
fn a_sponge_behind_a_plate_does_not_leave_along_its_normal() {
    let (plan, arm) = planned("rack");
    let behind = JointVector::new(14.463, 23.23, -16.365, -28.328, 62.565, 133.149).map(f64::to_radians);
    match recovered(&plan, &arm, &behind, None) {
        Ok(Recovered { home, .. }) => {
            assert!(prove(&home, &arm).unwrap().passes());
            assert!(home.segments.iter().all(|segment| segment.kind != SegmentKind::Retreat));
            sample(&plan, &arm, &home);
        }
        Err(error) => panic!("{error}"),
    }
    // The certificate does not believe it, wherever the plate is said to be.
    let (plan, arm) = planned("kitchen");
    let (_, q) = in_second_wash(&plan);
    let home = recovered(&plan, &arm, &q, None).unwrap().home;
    let retreat = home.job.recovery.as_ref().unwrap().retreat().unwrap();
    let status = |higher_m: f64| {
        let mut edited = home.clone();
        edited.job.plates[retreat.plate].pose.translation.vector.z += higher_m;
        edited.hash = Some(edited.seal().unwrap());
        let certificate = prove(&edited, &arm).unwrap();
        certificate.check(Requirement::ContactHeight).unwrap().status
    };
    assert_eq!(status(0.0), Status::Proved);
    for higher_m in [0.025, 0.03, 0.05, 0.06] {
        assert_eq!(status(higher_m), Status::Violated, "{higher_m}");
    }
}

/// A pair that is far apart at the stop keeps what all pairs keep.
#[test]
fn a_pair_that_is_not_near_at_the_stop_is_not_excused() {
    let (plan, arm) = planned("kitchen");
    let (_, q) = in_second_wash(&plan);
    let home = recovered(&plan, &arm, &q, None).unwrap().home;
    for (pair, by_m) in [(["handle", "floor"], 0.001), (["link_4", "handle"], 0.0099)] {
        let mut edited = home.clone();
        edited.job.workcell.reduced_clearances.push(ReducedClearance {
            pair: pair.map(str::to_owned),
            by_m,
            at_stop: true,
        });
        edited.hash = Some(edited.seal().unwrap());
        let certificate = prove(&edited, &arm).unwrap();
        assert_eq!(
            certificate.check(Requirement::Exclusions).unwrap().status,
            Status::Violated,
            "{pair:?}"
        );
    }
}

#[test]
fn a_dry_run_has_no_recovery() {
    let (plan, arm) = planned("kitchen");
    let terms = dry_run_terms(&plan, &arm, 0.05, 0.1).unwrap();
    let mut dry_run = plan.clone();
    dry_run.job = terms;
    dry_run.hash = Some(dry_run.seal().unwrap());
    let home = plan.job.home_rad[0];
    assert_eq!(
        recovered(&dry_run, &arm, &home, None).err(),
        Some(RecoveryError::DryRun)
    );
}
