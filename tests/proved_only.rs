//! What must not be proved: jobs that would look washed if less were asked of a proof.

use crate::certified::rows;
use platewash::certificate::{Certificate, Requirement, Status, prove};
use platewash::planner::{PlannedJob, plan};
use platewash::workcell::job::Overlap;
use platewash::{Plan, RobotModel, Scenario, WashReport};
use serde_json::Value;
use std::path::Path;

/// One plate in front of the arm.
fn one_plate() -> Scenario {
    let mut scenario = Scenario::load("kitchen-spiral").unwrap();
    scenario.layout.positions_m = Some(vec![[0.36, 0.0]]);
    scenario
}

fn judged(scenario: &Scenario) -> (PlannedJob, Certificate) {
    let job = scenario.job().unwrap();
    let planned = plan(&job).unwrap();
    let certificate = prove(&planned.plan, job.arm()).unwrap();
    (planned, certificate)
}

/// The certificate of an edited plan of the built-in arm, sealed again.
fn edited(planned: &PlannedJob, edit: impl FnOnce(&mut Plan)) -> Certificate {
    let mut plan = planned.plan.clone();
    edit(&mut plan);
    plan.hash = Some(plan.seal().unwrap());
    prove(&plan, &RobotModel::irb120().unwrap()).unwrap()
}

fn status(certificate: &Certificate, requirement: Requirement) -> Status {
    certificate.check(requirement).unwrap().status
}

fn headline(planned: &PlannedJob, certificate: &Certificate) -> String {
    WashReport::new(planned, &[], certificate.clone()).headline
}

fn written(folder: &Path, name: &str, text: &str) -> std::path::PathBuf {
    let file = folder.join(name);
    std::fs::write(&file, text).unwrap();
    file
}

fn urdf() -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("urdf/irb120.urdf")).unwrap()
}

/// The description without the collision elements of one link, or of all.
fn without_collision(link: Option<&str>) -> String {
    let mut inside = false;
    let mut kept = true;
    let mut text = String::new();
    for line in urdf().lines() {
        if line.contains("<link name=") {
            inside = link.is_none_or(|link| line.contains(&format!("\"{link}\"")));
        }
        kept = kept && !(inside && line.contains("<collision"));
        if kept {
            text.push_str(line);
            text.push('\n');
        }
        kept = kept || line.contains("</collision>");
    }
    text
}

#[test]
fn bodies_without_shape_are_never_proved_clear() {
    let folder = tempfile::tempdir().unwrap();
    for (link, named) in [(None, "\"base_link\""), (Some("link_3"), "\"link_3\"")] {
        let mut scenario = one_plate();
        scenario.robot.urdf = Some(written(folder.path(), "arm.urdf", &without_collision(link)));
        let (_, certificate) = judged(&scenario);
        assert!(!certificate.passes());
        let check = certificate.check(Requirement::Exclusions).unwrap();
        assert_eq!(check.status, Status::Violated);
        let said: String = check.discrepancies.iter().map(ToString::to_string).collect();
        assert!(said.contains(named), "{said}");
    }
}

#[test]
fn a_sponge_in_the_air_does_not_wash() {
    let mut scenario = one_plate();
    scenario.wash.height_m = 0.01;
    let error = scenario.job().unwrap_err().to_string();
    assert!(error.contains("wash.height_m must be 0"), "{error}");
    // Nor is a plan proved whose tip is above its plates.
    scenario.wash.height_m = 0.0;
    let (planned, _) = judged(&scenario);
    let certificate = edited(&planned, |plan| plan.job.plates[0].pose.translation.z -= 0.01);
    assert_eq!(status(&certificate, Requirement::ContactHeight), Status::Violated);
    assert_eq!(certificate.plates_washed(), 0);
}

#[test]
fn a_flat_sponge_is_tilted_no_more_than_its_compression_allows() {
    let mut scenario = one_plate();
    scenario.tool.sponge_radius_m = 0.1;
    scenario.tool.sponge_height_m = 0.02;
    scenario.wash.path_radius_m = Some(0.05);
    let most = (0.02f64 / 0.1).atan();
    let tilt_max_rad = |scenario: &Scenario| scenario.job().unwrap().terms().tilt_max_rad();
    assert!((tilt_max_rad(&scenario) - most).abs() < 1e-12);
    let (_, certificate) = judged(&scenario);
    let tilt = certificate.check(Requirement::Tilt).unwrap();
    assert_eq!(tilt.status, Status::Proved);
    assert!(tilt.measure.unwrap().bound.unwrap() <= most + 1e-8);
    scenario.tool.sponge_radius_m = 0.025;
    assert_eq!(tilt_max_rad(&scenario), 15f64.to_radians());
}

#[test]
fn limits_of_the_tip_hold_during_the_wash() {
    let mut scenario = one_plate();
    scenario.limits.tip_speed_m_s = 0.2;
    scenario.limits.tip_acceleration_m_s2 = 2.0;
    let (planned, certificate) = judged(&scenario);
    assert!(certificate.passes());
    for (name, most) in [(Requirement::WashSpeed, 0.2), (Requirement::WashAcceleration, 2.0)] {
        let measure = certificate.check(name).unwrap().measure.unwrap();
        assert_eq!(measure.limit, most);
        assert!(measure.bound.unwrap() <= most * (1.0 + 1e-9));
    }
    // The same motion under a plan whose job allows less anywhere.
    let certificate = edited(&planned, |plan| plan.job.limits.tip_speed_m_s = 0.1);
    assert_eq!(status(&certificate, Requirement::WashSpeed), Status::Violated);
}

#[test]
fn overlap_that_is_only_reported_is_waived_and_not_proved() {
    let mut scenario = one_plate();
    scenario.layout.positions_m = Some(vec![[0.36, 0.0], [0.36, 0.2]]);
    scenario.layout.overlap = Overlap::Report;
    let (_, certificate) = judged(&scenario);
    let apart = certificate.check(Requirement::PlatesApart).unwrap();
    assert_eq!((apart.status, apart.discrepancies.len()), (Status::Waived, 1));
    assert!(certificate.passes());
    // Each wash sweeps half of the other plate.
    let swept = certificate.check(Requirement::EveryPlateOnce).unwrap();
    assert_eq!((swept.status, swept.discrepancies.len()), (Status::Waived, 2));
}

#[test]
fn waived_requirements_are_in_the_first_line_and_data() {
    let mut scenario = one_plate();
    scenario.layout.positions_m = Some(vec![[0.36, -0.1], [0.36, 0.11]]);
    scenario.layout.overlap = Overlap::Report;
    let (planned, certificate) = judged(&scenario);
    let apart = "plates apart, gap between plate 1 and plate 2 -80.0 mm";
    for line in [certificate.to_string(), headline(&planned, &certificate)] {
        let line = line.lines().next().unwrap();
        assert!(line.starts_with("PROVED BUT FOR every plate once"), "{line}");
        assert!(line.contains(apart) && line.contains("(waived by the job)"), "{line}");
    }
    let waived = [Requirement::EveryPlateOnce, Requirement::PlatesApart];
    assert_eq!(certificate.waived, waived);
    let data = serde_json::to_value(&certificate).unwrap();
    assert_eq!(data["waived"], serde_json::json!(["every_plate_once", "plates_apart"]));
    assert!(data["headline"].as_str().unwrap().starts_with("PROVED BUT FOR"));
    // Where something else is not kept, that comes first: nothing is proved "but for" both.
    let unkept = edited(&planned, |plan| plan.job.home_rad[1][3] += 0.1);
    for line in [unkept.headline.clone(), headline(&planned, &unkept)] {
        let (broken, waived) = line.split_once("; waived by the job: ").unwrap();
        assert!(
            broken.starts_with("NOT PROVED: 2 plates in ") && broken.ends_with("; violated: home to home"),
            "{line}"
        );
        assert!(
            waived.starts_with("every plate once, ") && waived.contains(apart),
            "{line}"
        );
    }
    let rows = rows(&scenario, 1..=1).unwrap();
    assert_eq!(rows[0].outcome.code(), "proved");
    assert!(rows[0].reason.as_ref().unwrap().contains(apart), "{:?}", rows[0].reason);
    // Nothing of the kind where nothing is waived.
    let certificate = judged(&one_plate()).1;
    assert!(certificate.waived.is_empty() && certificate.headline.starts_with("PROVED: 1 plate in "));
}

/// Everything is swept, every line of the motion is kept, and each plate is washed twice.
#[test]
fn a_wash_that_sweeps_the_neighbour_too_is_not_every_plate_once() {
    let mut scenario = one_plate();
    scenario.layout.positions_m = Some(vec![[0.36, -0.06], [0.36, 0.06]]);
    (scenario.layout.plate_radius_m, scenario.layout.min_distance_m) = (Some(0.05), 0.1);
    (scenario.wash.path_radius_m, scenario.wash.turns) = (Some(0.15), Some(4.5));
    let (planned, certificate) = judged(&scenario);
    let broken: Vec<_> = certificate.broken().map(|check| check.requirement).collect();
    assert_eq!(broken, [Requirement::EveryPlateOnce], "{certificate}");
    let check = certificate.check(Requirement::EveryPlateOnce).unwrap();
    let named: Vec<_> = check.discrepancies.iter().map(|d| d.what.as_str()).collect();
    assert_eq!(
        named,
        ["plate 2 while plate 1 is washed", "plate 1 while plate 2 is washed"]
    );
    for swept in &certificate.swept {
        // 150 mm of path and 25 mm of sponge, less 50 mm of plate.
        let seen = swept.beyond_rim_seen_m;
        assert!(seen > 0.125 - 1e-4 && seen < 0.127, "{swept:?}");
        assert_eq!(swept.touches.len(), 1);
    }
    let headline = headline(&planned, &certificate);
    assert!(
        headline.starts_with("NOT PROVED") && headline.ends_with("every plate once"),
        "{headline}"
    );
}

/// The rims of neighbours are run over where the wash path ends at the rim; that is what such a job is, and it is named.
#[test]
fn a_touched_rim_of_a_neighbour_is_allowed_and_named() {
    let mut scenario = Scenario::load("kitchen-rim").unwrap();
    scenario.layout.positions_m = Some(vec![[0.3, -0.15], [0.3, 0.15]]);
    let (_, certificate) = judged(&scenario);
    assert!(certificate.passes(), "{certificate}");
    for (swept, other) in certificate.swept.iter().zip([1, 0].map(|i| certificate.swept[i].plate)) {
        // A sponge of 25 mm, tilted, beyond the rim and a gap of 10 mm.
        let cosine = swept.cos_tilt;
        let wall = (0.025 + 0.001 * (1.0 - cosine * cosine).sqrt()) / cosine;
        let touched = &swept.touches[0];
        assert_eq!((swept.touches.len(), touched.plate), (1, other));
        assert!((touched.depth_m - (wall - 0.01)).abs() < 2e-4, "{touched:?}");
    }
}

#[test]
fn touching_plates_are_allowed() {
    let mut scenario = one_plate();
    scenario.layout.positions_m = Some(vec![[0.36, -0.1], [0.36, -0.1 + 0.29]]);
    let (_, certificate) = judged(&scenario);
    assert_eq!(status(&certificate, Requirement::PlatesApart), Status::Proved);
}

#[test]
fn the_headline_claims_no_more_than_the_swept_share() {
    let mut scenario = one_plate();
    scenario.wash.turns = Some(0.5);
    scenario.wash.closing_ring = Some(false);
    scenario.job.required_coverage = 0.1;
    let (planned, certificate) = judged(&scenario);
    let least = certificate.swept[0].at_least;
    assert!(least < 0.9);
    let share = (1000.0 * least).floor() / 10.0;
    let line = headline(&planned, &certificate);
    let expected = format!(", each swept over at least {share:.1} % (10 % required), clearance at least ");
    assert!(
        line.contains(&expected)
            && line.ends_with(", contact not required; requires less than usual: swept 10 % (usual 99.5 %)"),
        "{line}"
    );
    let (planned, certificate) = judged(&one_plate());
    let whole = headline(&planned, &certificate);
    assert!(whole.contains("each swept over 100 % (99.5 % required)"), "{whole}");
    scenario.job.required_coverage = 0.99;
    let (planned, certificate) = judged(&scenario);
    let line = headline(&planned, &certificate);
    assert!(line.starts_with("NOT PROVED: 1 plate in "), "{line}");
    assert!(
        line.contains("; violated: swept ")
            && line.contains(" % (at least 99.0 % required); requires less than usual: "),
        "{line}"
    );
}

/// A sponge of 10 mm on a path for one of 25 mm: six tenths of the plate are swept, and no plate is washed.
#[test]
fn only_plates_that_are_swept_count_as_washed() {
    let mut scenario = one_plate();
    assert_eq!(judged(&scenario).1.plates_washed(), 1);
    scenario.tool.sponge_radius_m = 0.01;
    assert_eq!(judged(&scenario).1.plates_washed(), 0);
}

#[test]
fn proves_a_wash_without_tilt() {
    let mut scenario = one_plate();
    scenario.wash.tilt_max_deg = 0.0;
    let (_, certificate) = judged(&scenario);
    assert_eq!(status(&certificate, Requirement::Tilt), Status::Proved);
}

#[test]
fn a_wash_path_that_starts_many_turns_away_is_refused() {
    let mut data = as_data();
    data["wash_paths"][0]["curve"]["start_angle_rad"] = 1e17.into();
    let mut plan = Plan::from_json(&data.to_string()).unwrap();
    plan.hash = Some(plan.seal().unwrap());
    let certificate = prove(&plan, &RobotModel::irb120().unwrap()).unwrap();
    assert_eq!(status(&certificate, Requirement::WashPaths), Status::Violated);
}

#[test]
fn rejects_a_plan_with_an_unknown_key() {
    let text = judged(&one_plate()).0.plan.to_json().unwrap();
    let edited = text.replacen("{", "{\"bogus\":1,", 1);
    let error = Plan::from_json(&edited).unwrap_err().to_string();
    assert!(error.contains("bogus"), "{error}");
}

/// A plan of one plate, as data.
fn as_data() -> Value {
    serde_json::to_value(judged(&one_plate()).0.plan).unwrap()
}

/// What reading says of a plan after a change.
fn refusal(data: &Value, change: impl FnOnce(&mut Value)) -> String {
    let mut data = data.clone();
    change(&mut data);
    Plan::from_json(&data.to_string()).unwrap_err().to_string()
}

/// The places of all tables of a plan, each the first of its list.
fn tables(at: &str, data: &Value, all: &mut Vec<String>) {
    match data {
        Value::Object(keys) => {
            all.push(at.to_owned());
            keys.iter()
                .for_each(|(key, value)| tables(&format!("{at}/{key}"), value, all));
        }
        Value::Array(rows) => rows.iter().take(1).for_each(|row| tables(&format!("{at}/0"), row, all)),
        _ => {}
    }
}

#[test]
fn rejects_unknown_keys_at_every_level() {
    let data = as_data();
    let mut all = Vec::new();
    tables("", &data, &mut all);
    for place in [
        "/job/workcell/tool/sponge/pose",
        "/job/plates/0/surface",
        "/wash_paths/0/curve",
    ] {
        assert!(all.iter().any(|known| known == place), "{place} is none of {all:?}");
    }
    for place in all {
        let said = refusal(&data, |plan| plan.pointer_mut(&place).unwrap()["soap"] = 1.into());
        // Where a table tells a variant, there is one key in it.
        let variant = said.contains("expected map with a single key") || said.contains("expected value");
        assert!(said.contains("soap") || variant, "{place}: {said}");
    }
    let said = refusal(&data, |plan| plan["wash_paths"][0]["curve"]["soap"] = "none".into());
    assert!(said.contains("unknown key 'wash_paths[0].curve.soap'"), "{said}");
}

/// Of the settings of the planner, those that it chooses where they are not stated.
const CHOICES: [&str; 3] = ["path_radius_m", "turns", "closing_ring"];

#[test]
fn missing_keys_have_no_defaults() {
    let data = as_data();
    let mut all = Vec::new();
    tables("", &data, &mut all);
    let mut dropped = 0;
    for place in all {
        let table = data.pointer(&place).unwrap().as_object().unwrap();
        for key in table.keys() {
            let mut without = data.clone();
            _ = without
                .pointer_mut(&place)
                .unwrap()
                .as_object_mut()
                .unwrap()
                .remove(key);
            match Plan::from_json(&without.to_string()) {
                Err(error) => {
                    let said = error.to_string();
                    let variant = table.len() == 1 && said.contains("expected value");
                    assert!(said.contains(key) || variant, "{place}/{key}: {said}");
                }
                // What is not sealed has no hash; what is the planner's choice is another job's.
                Ok(plan) => {
                    let left_out = key == "hash" || place == "/job/planner/wash" && CHOICES.contains(&key.as_str());
                    assert!(left_out && !plan.is_sealed(), "{place}/{key}");
                }
            }
            dropped += 1;
        }
    }
    assert!(dropped > 90, "{dropped}");
    let missing = |section: &str, key: &str| {
        refusal(&data, |plan| {
            _ = plan["job"]
                .pointer_mut(section)
                .unwrap()
                .as_object_mut()
                .unwrap()
                .remove(key);
        })
    };
    // What may be nothing must say so.
    let said = missing("/simulation", "payload_kg");
    assert!(said.contains("'job.simulation.payload_kg' is missing"), "{said}");
    let said = refusal(&data, |plan| plan["hash"] = Value::Null);
    assert!(said.contains("'hash' is null; expected left out"), "{said}");
}

#[test]
fn a_key_that_is_stated_twice_is_refused() {
    let text = as_data().to_string();
    for (once, twice) in [
        ("\"meridian\":\"disc\"", "\"meridian\":\"disc\",\"meridian\":\"disc\""),
        ("\"turns\":3.5", "\"turns\":9.5,\"turns\":3.5"),
        ("\"order\":[0]", "\"order\":[0],\"order\":[0]"),
    ] {
        let edited = text.replacen(once, twice, 1);
        assert_ne!(edited, text);
        let said = Plan::from_json(&edited).unwrap_err().to_string();
        assert!(said.contains("twice") || said.contains("duplicate field"), "{said}");
    }
}

/// White space, the order of keys and the way a number is written are not contents.
#[test]
fn a_plan_written_otherwise_is_the_same_plan() {
    let data = as_data();
    let plan = Plan::from_json(&serde_json::to_string_pretty(&data).unwrap()).unwrap();
    assert!(plan.is_sealed());
    let text = plan.to_json().unwrap();
    let edited = text.replacen("\"clearance_m\":0.01", "\"clearance_m\":1.00e-2", 1) + "\n";
    assert_ne!(edited, text);
    assert_eq!(Plan::from_json(&edited).unwrap(), plan);
}

/// JSON's numbers are doubles: from 2⁵³ on two whole numbers are one.
#[test]
fn rejects_seeds_and_indices_beyond_the_exact_integers_of_json() {
    const ABOVE: u64 = 1 << 53;
    let plan = judged(&one_plate()).0.plan;
    let with = |seed: u64| {
        let mut plan = plan.clone();
        plan.job.seed = seed;
        plan
    };
    assert!(with(ABOVE - 1).seal().is_ok());
    assert!(with(ABOVE + 1).seal().is_err());
    for seed in [ABOVE, ABOVE + 1, u64::MAX] {
        let scenario = Scenario { seed, ..one_plate() };
        let error = scenario.validate().unwrap_err().to_string();
        let expected = format!("seed must be a whole number from 0 to 9007199254740991 (2^53 − 1); found {seed}");
        assert!(error.contains(&expected), "{error}");
        let judged = prove(&with(seed), &RobotModel::irb120().unwrap());
        let expected = format!("seed must be at most 2^53 − 1; found {seed}");
        assert!(judged.unwrap_err().to_string().contains(&expected));
    }
    let text = plan.to_json().unwrap();
    let said = Plan::from_json(&text.replacen("\"seed\":1,", "\"seed\":9007199254740993,", 1));
    let said = said.unwrap_err().to_string();
    assert!(
        said.contains("'job.seed' is 9007199254740993; expected a whole number from 0 to"),
        "{said}"
    );
    let error = rows(&one_plate(), ABOVE..=ABOVE).unwrap_err().to_string();
    assert!(error.contains("9007199254740991"), "{error}");
}

/// No requirement rests on the gains, and the hash does.
#[test]
fn a_plan_that_could_not_be_read_back_is_not_sealed() {
    let plan = judged(&one_plate()).0.plan;
    for value in [f64::NAN, f64::INFINITY] {
        let mut plan = plan.clone();
        plan.job.simulation.control.kp = value;
        assert!(plan.seal().is_err());
        let certificate = prove(&plan, &RobotModel::irb120().unwrap()).unwrap();
        assert!(!certificate.passes() && certificate.broken().count() == 0);
    }
}

/// The hash of the arm's description counts its meshes.
#[test]
fn another_mesh_is_another_arm() {
    let folder = tempfile::tempdir().unwrap();
    let text = urdf().replacen(
        "<geometry><sphere radius=\"0.11\"/></geometry>",
        "<geometry><mesh filename=\"hull.obj\"/></geometry>",
        1,
    );
    let sha256 = |size: f64| {
        let faces = "f 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n";
        let corners = format!("v 0 0 0\nv {size} 0 0\nv 0 {size} 0\nv 0 0 {size}\n");
        written(folder.path(), "hull.obj", &(corners + faces));
        let mut scenario = one_plate();
        scenario.robot.urdf = Some(written(folder.path(), "arm.urdf", &text));
        scenario.arm().unwrap().sha256().to_owned()
    };
    let small = sha256(0.05);
    assert_ne!(small, sha256(0.06));
    assert_eq!(small, sha256(0.05));
}

/// The tilted rim is down while the arm still moves: no faster than it washes, however slowly that is.
#[test]
fn the_sponge_lands_and_lifts_no_faster_than_it_washes() {
    let mut scenario = one_plate();
    scenario.wash.speed_m_s = 0.06;
    let (_, certificate) = judged(&scenario);
    assert!(certificate.passes(), "{certificate}");
    let measure = certificate.check(Requirement::ContactSpeed).unwrap().measure.unwrap();
    assert!(measure.limit == 0.06 && measure.seen.unwrap() > 0.01, "{measure:?}");
}
