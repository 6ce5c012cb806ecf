//! What must not be proved: jobs that would look washed if less were asked of a proof.
#![allow(clippy::unwrap_used, missing_docs)]

use platewash::planner::certificate::{self, CertificateVerdict, PromiseName, Status};
use platewash::planner::cycle::CycleReport;
use platewash::planner::robot;
use platewash::planner::scenario::Overlap;
use platewash::planner::sweep;
use platewash::{Certificate, Cycle, Plan, RobotModel, Scenario};
use std::path::Path;

/// One plate in front of the arm.
fn one_plate() -> Scenario {
    let mut scenario = Scenario::load("kitchen").unwrap();
    scenario.layout.positions_m = Some(vec![[0.36, 0.0]]);
    scenario
}

fn judged(scenario: &Scenario) -> (Cycle, Certificate) {
    let cycle = Cycle::plan(scenario).unwrap();
    let certificate = certificate::verify(&cycle.to_plan().unwrap(), &cycle.robot).unwrap();
    (cycle, certificate)
}

fn status(certificate: &Certificate, name: PromiseName) -> Status {
    certificate.promise(name).unwrap().status
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
fn a_body_without_a_shape_keeps_clear_of_nothing() {
    let folder = tempfile::tempdir().unwrap();
    for (link, named) in [(None, "\"base_link\""), (Some("link_3"), "\"link_3\"")] {
        let mut scenario = one_plate();
        scenario.robot.urdf = Some(written(folder.path(), "arm.urdf", &without_collision(link)));
        let (_, certificate) = judged(&scenario);
        assert_eq!(certificate.verdict, CertificateVerdict::Fail);
        let promise = certificate.promise(PromiseName::ClearancePairs).unwrap();
        assert_eq!(promise.status, Status::Fail);
        let said = promise
            .discrepancies
            .iter()
            .map(ToString::to_string)
            .collect::<String>();
        assert!(said.contains(named), "{said}");
    }
}

#[test]
fn a_sponge_in_the_air_does_not_wash() {
    let mut scenario = one_plate();
    scenario.wash.height_m = 0.01;
    let error = Cycle::plan(&scenario).unwrap_err().to_string();
    assert!(error.contains("wash.height_m must be 0"), "{error}");
    // Nor is a plan proved whose tip is above its plates, all of it stated so.
    scenario.wash.height_m = 0.0;
    let (cycle, _) = judged(&scenario);
    let mut plan = cycle.to_plan().unwrap();
    plan.scenario.layout.plate_height_m -= 0.01;
    plan.plates[0].z_m -= 0.01;
    plan.scenario.wash.height_m = 0.01;
    let certificate = certificate::verify(&sealed(plan), &cycle.robot).unwrap();
    let asked = &certificate.promise(PromiseName::ToolPath).unwrap().discrepancies;
    assert_eq!(
        asked.iter().map(|d| d.what.as_str()).collect::<Vec<_>>(),
        ["scenario.wash.height_m"]
    );
    assert_eq!(status(&certificate, PromiseName::StrokeDeviation), Status::Pass);
    assert_eq!(status(&certificate, PromiseName::ContactHeight), Status::Fail);
}

#[test]
fn a_flat_sponge_is_tilted_no_more_than_it_gives_way() {
    let mut scenario = one_plate();
    scenario.tool.sponge_radius_m = 0.1;
    scenario.tool.sponge_height_m = 0.02;
    scenario.wash.path_radius_m = 0.05;
    let most = (0.02f64 / 0.1).atan();
    assert!((scenario.tilt_max_rad() - most).abs() < 1e-12);
    let (_, certificate) = judged(&scenario);
    let tilt = certificate.promise(PromiseName::Tilt).unwrap();
    assert_eq!(tilt.status, Status::Pass);
    assert!(tilt.measure.unwrap().bound.unwrap() <= most + 1e-8);
    scenario.tool.sponge_radius_m = 0.025;
    assert_eq!(scenario.tilt_max_rad(), 15f64.to_radians());
}

#[test]
fn limits_of_the_tip_hold_while_it_washes_too() {
    let mut scenario = one_plate();
    scenario.limits.tip_speed_m_s = 0.2;
    scenario.limits.tip_acceleration_m_s2 = 2.0;
    let (cycle, certificate) = judged(&scenario);
    assert_eq!(certificate.verdict, CertificateVerdict::Pass);
    for (name, most) in [(PromiseName::WashSpeed, 0.2), (PromiseName::WashAcceleration, 2.0)] {
        let measure = certificate.promise(name).unwrap().measure.unwrap();
        assert_eq!(measure.limit, most);
        assert!(measure.bound.unwrap() <= most * (1.0 + 1e-9));
    }
    // The same motion under a plan whose scenario allows less anywhere.
    let mut plan = cycle.to_plan().unwrap();
    plan.scenario.limits.tip_speed_m_s = 0.1;
    let certificate = certificate::verify(&sealed(plan), &cycle.robot).unwrap();
    assert_eq!(status(&certificate, PromiseName::WashSpeed), Status::Fail);
}

fn sealed(mut plan: Plan) -> Plan {
    plan.hash = Some(plan.seal().unwrap());
    plan
}

#[test]
fn overlap_that_is_only_reported_is_exempt_and_no_pass() {
    let mut scenario = one_plate();
    scenario.layout.positions_m = Some(vec![[0.36, 0.0], [0.36, 0.2]]);
    scenario.layout.overlap = Overlap::Report;
    let (_, certificate) = judged(&scenario);
    let apart = certificate.promise(PromiseName::PlatesApart).unwrap();
    assert_eq!((apart.status, apart.discrepancies.len()), (Status::Exempt, 1));
    assert_eq!(certificate.verdict, CertificateVerdict::Pass);
    // Each wash sweeps half of the other plate.
    let swept = certificate.promise(PromiseName::EveryPlateOnce).unwrap();
    assert_eq!((swept.status, swept.discrepancies.len()), (Status::Exempt, 2));
}

#[test]
fn an_exemption_is_in_the_first_line_and_in_the_data() {
    let mut scenario = one_plate();
    scenario.layout.positions_m = Some(vec![[0.36, -0.1], [0.36, 0.11]]);
    scenario.layout.overlap = Overlap::Report;
    let (cycle, certificate) = judged(&scenario);
    let apart = "plates apart, gap between plate 0 and plate 1 -80.0 mm";
    for (line, verdict) in [
        (certificate.to_string(), "CERTIFIED"),
        (CycleReport::new(&cycle, certificate.clone()).headline, "PROVED"),
    ] {
        let line = line.lines().next().unwrap();
        assert!(
            line.starts_with(&format!("{verdict} BUT FOR every plate once")),
            "{line}"
        );
        assert!(
            line.contains(apart) && line.contains("waived by layout.overlap = \"report\""),
            "{line}"
        );
    }
    assert_eq!(
        certificate.exempt,
        [PromiseName::EveryPlateOnce, PromiseName::PlatesApart]
    );
    let data = serde_json::to_value(&certificate).unwrap();
    assert_eq!(data["exempt"], serde_json::json!(["every_plate_once", "plates_apart"]));
    assert!(data["headline"].as_str().unwrap().starts_with("CERTIFIED BUT FOR"));
    // Where something else is not kept, that comes first: nothing is proved "but for" both.
    let mut plan = cycle.to_plan().unwrap();
    plan.summary.headline = "washed twice".into();
    let unkept = certificate::verify(&sealed(plan), &cycle.robot).unwrap();
    for (line, verdict) in [
        (unkept.headline.clone(), "NOT CERTIFIED: kitchen, "),
        (
            CycleReport::new(&cycle, unkept).headline,
            "NOT PROVED: a plan for 2 plates in ",
        ),
    ] {
        let (broken, waived) = line.split_once("; waived by layout.overlap = \"report\": ").unwrap();
        assert!(broken.starts_with(verdict) && broken.ends_with(" summary"), "{line}");
        assert!(
            waived.starts_with("every plate once, ") && waived.contains(apart),
            "{line}"
        );
    }
    let rows = sweep::sweep(&scenario, 1..=1).unwrap();
    assert_eq!(rows[0].outcome.name(), "proved");
    assert!(rows[0].reason.as_ref().unwrap().contains(apart), "{:?}", rows[0].reason);
    // Nothing of the kind where nothing is waived.
    let certificate = judged(&one_plate()).1;
    assert!(certificate.exempt.is_empty() && certificate.headline.starts_with("CERTIFIED: kitchen, "));
}

/// Everything is swept, every line of the motion is kept, and each plate is washed twice.
#[test]
fn a_wash_that_sweeps_the_neighbour_too_is_not_every_plate_once() {
    let mut scenario = one_plate();
    scenario.layout.positions_m = Some(vec![[0.36, -0.06], [0.36, 0.06]]);
    (scenario.layout.plate_radius_m, scenario.layout.min_distance_m) = (0.05, 0.1);
    (scenario.wash.path_radius_m, scenario.wash.turns) = (0.15, 4.5);
    let (cycle, certificate) = judged(&scenario);
    let broken: Vec<_> = certificate.broken().map(|promise| promise.name).collect();
    assert_eq!(broken, [PromiseName::EveryPlateOnce], "{certificate}");
    let promise = certificate.promise(PromiseName::EveryPlateOnce).unwrap();
    let named: Vec<_> = promise.discrepancies.iter().map(|d| d.what.as_str()).collect();
    assert_eq!(
        named,
        ["plate 1 while plate 0 is washed", "plate 0 while plate 1 is washed"]
    );
    for swept in &certificate.coverage {
        // 150 mm of path and 25 mm of sponge, less 50 mm of plate.
        let seen = swept.beyond_rim_seen_m;
        assert!(seen > 0.125 - 1e-4 && seen < 0.127, "{swept:?}");
        assert_eq!(swept.touches.len(), 1);
    }
    let headline = CycleReport::new(&cycle, certificate).headline;
    assert!(
        headline.starts_with("NOT PROVED") && headline.ends_with("every plate once"),
        "{headline}"
    );
}

/// The rims of neighbours are run over where the stroke ends at the rim; that is what such a job is, and it is named.
#[test]
fn a_neighbours_rim_may_be_touched_and_is_named() {
    let mut scenario = Scenario::load("kitchen-rim").unwrap();
    scenario.layout.positions_m = Some(vec![[0.3, -0.15], [0.3, 0.15]]);
    let (_, certificate) = judged(&scenario);
    assert_eq!(certificate.verdict, CertificateVerdict::Pass, "{certificate}");
    for (swept, other) in certificate
        .coverage
        .iter()
        .zip([1, 0].map(|i| certificate.coverage[i].plate))
    {
        // A sponge of 25 mm, tilted, beyond the rim and a gap of 10 mm.
        let cosine = swept.cos_tilt;
        let wall = (0.025 + 0.001 * (1.0 - cosine * cosine).sqrt()) / cosine;
        let touched = &swept.touches[0];
        assert_eq!((swept.touches.len(), touched.plate), (1, other));
        assert!((touched.depth_m - (wall - 0.01)).abs() < 2e-4, "{touched:?}");
    }
}

#[test]
fn plates_may_touch() {
    let mut scenario = one_plate();
    scenario.layout.positions_m = Some(vec![[0.36, -0.1], [0.36, -0.1 + 0.29]]);
    let (_, certificate) = judged(&scenario);
    assert_eq!(status(&certificate, PromiseName::PlatesApart), Status::Pass);
}

#[test]
fn the_headline_says_no_more_than_is_covered() {
    let mut scenario = one_plate();
    scenario.wash.turns = 0.5;
    scenario.wash.closing_ring = false;
    scenario.job.required_coverage = 0.1;
    let (cycle, certificate) = judged(&scenario);
    let least = certificate.coverage[0].at_least;
    assert!(least < 0.9);
    let report = CycleReport::new(&cycle, certificate);
    let share = (1000.0 * least).floor() / 10.0;
    assert!(
        report
            .headline
            .starts_with(&format!("PROVED: 1 plate washed by at least {share:.1} %")),
        "{}",
        report.headline
    );
    let (cycle, mut certificate) = judged(&one_plate());
    assert!(
        CycleReport::new(&cycle, certificate.clone())
            .headline
            .contains("1 plate washed whole,")
    );
    certificate.coverage[0].at_least = 0.9996;
    let nearly = CycleReport::new(&cycle, certificate).headline;
    assert!(nearly.contains("1 plate washed by at least 99.9 %,"), "{nearly}");
    scenario.job.required_coverage = 0.99;
    let (cycle, certificate) = judged(&scenario);
    let report = CycleReport::new(&cycle, certificate);
    assert!(
        report.headline.starts_with("NOT PROVED: a plan for 1 plate in"),
        "{}",
        report.headline
    );
    assert!(
        report.headline.ends_with("does not keep coverage"),
        "{}",
        report.headline
    );
}

/// A sponge of 10 mm on a stroke for one of 25 mm: six tenths of the plate are swept, and no plate is washed.
#[test]
fn a_summary_counts_only_plates_that_are_swept() {
    let mut scenario = one_plate();
    let summary = |scenario: &Scenario| Cycle::plan(scenario).unwrap().to_plan().unwrap().summary;
    assert_eq!(summary(&scenario).plates_washed, 1);
    assert!(summary(&scenario).headline.starts_with("1 plate in "));
    scenario.tool.sponge_radius_m = 0.01;
    assert_eq!(summary(&scenario).plates_washed, 0);
}

#[test]
fn no_tilt_at_all_can_be_proved() {
    let mut scenario = one_plate();
    scenario.wash.tilt_max_deg = 0.0;
    let (_, certificate) = judged(&scenario);
    assert_eq!(status(&certificate, PromiseName::Tilt), Status::Pass);
}

#[test]
fn a_stroke_that_starts_many_turns_away_is_refused() {
    let (cycle, _) = judged(&one_plate());
    let mut text: serde_json::Value = serde_json::from_str(&cycle.to_plan().unwrap().to_json().unwrap()).unwrap();
    for segment in text["tool_path"].as_array_mut().unwrap() {
        if segment["kind"] == "wash" {
            segment["start_angle_rad"] = 1e17.into();
        }
    }
    let plan = sealed(Plan::from_json(&text.to_string()).unwrap());
    let certificate = certificate::verify(&plan, &cycle.robot).unwrap();
    assert_eq!(status(&certificate, PromiseName::ToolPath), Status::Fail);
}

#[test]
fn a_plan_with_a_key_too_many_is_no_plan() {
    let (cycle, _) = judged(&one_plate());
    let text = cycle.to_plan().unwrap().to_json().unwrap();
    let edited = text.replacen("{", "{\"bogus\":1,", 1);
    let error = Plan::from_json(&edited).unwrap_err().to_string();
    assert!(error.contains("bogus"), "{error}");
}

/// A plan of one plate, as data.
fn as_data() -> serde_json::Value {
    let (cycle, _) = judged(&one_plate());
    serde_json::to_value(cycle.to_plan().unwrap()).unwrap()
}

/// What reading says of a plan after a change.
fn refusal(data: &serde_json::Value, change: impl FnOnce(&mut serde_json::Value)) -> String {
    let mut data = data.clone();
    change(&mut data);
    Plan::from_json(&data.to_string()).unwrap_err().to_string()
}

#[test]
fn keys_that_no_plan_has_are_refused_wherever_they_are() {
    let data = as_data();
    // Free, line and stroke.
    for segment in 0..3 {
        let said = refusal(&data, |plan| plan["tool_path"][segment]["sponge"] = "none".into());
        assert!(
            said.contains(&format!("unknown key 'tool_path[{segment}].sponge'")),
            "{said}"
        );
    }
    for (place, key) in [
        ("/plates/0", "colour"),
        ("/scenario/wash", "soap"),
        ("/knots", "qdd"),
        ("/summary", "praise"),
    ] {
        let said = refusal(&data, |plan| plan.pointer_mut(place).unwrap()[key] = 1.into());
        assert!(said.contains(key), "{said}");
    }
}

#[test]
fn keys_that_are_missing_are_not_filled_in() {
    let data = as_data();
    let sections = data["scenario"].as_object().unwrap();
    for (section, keys) in sections {
        let drop = |plan: &mut serde_json::Value| _ = plan["scenario"].as_object_mut().unwrap().remove(section);
        assert!(refusal(&data, drop).contains(&format!("'scenario.{section}' is missing")));
        for key in keys.as_object().into_iter().flat_map(|keys| keys.keys()) {
            let drop =
                |plan: &mut serde_json::Value| _ = plan["scenario"][section].as_object_mut().unwrap().remove(key);
            let mut without = data.clone();
            drop(&mut without);
            match Plan::from_json(&without.to_string()) {
                Err(e) => assert!(
                    e.to_string()
                        .contains(&format!("'scenario.{section}.{key}' is missing")),
                    "{e}"
                ),
                // What is optional may be left out; that is another plan.
                Ok(plan) => assert!(
                    ["positions_m", "region"].contains(&key.as_str()) && !plan.is_sealed(),
                    "{key}"
                ),
            }
        }
    }
    let said = refusal(&data, |plan| {
        plan["scenario"]["tool"]["com_m"] = serde_json::Value::Null
    });
    assert!(
        said.contains("'scenario.tool.com_m' is null; expected left out"),
        "{said}"
    );
}

#[test]
fn a_key_that_is_stated_twice_is_refused() {
    let text = as_data().to_string();
    for (once, twice) in [
        ("\"shape\":\"stroke\"", "\"shape\":\"free\",\"shape\":\"stroke\""),
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
fn seeds_and_indices_that_json_cannot_tell_apart_have_no_hash() {
    const ABOVE: u64 = 1 << 53;
    let (cycle, _) = judged(&one_plate());
    let plan = cycle.to_plan().unwrap();
    let with = |seed: u64| {
        let mut plan = plan.clone();
        plan.scenario.seed = seed;
        plan
    };
    assert!(with(ABOVE - 1).seal().is_ok());
    assert!(with(ABOVE + 1).seal().is_err());
    for seed in [ABOVE, ABOVE + 1, u64::MAX] {
        let error = with(seed).scenario.validate().unwrap_err().to_string();
        let expected = format!("seed must be a whole number from 0 to 9007199254740991 (2^53 − 1); found {seed}");
        assert!(error.contains(&expected), "{error}");
        let verified = certificate::verify(&with(seed), &cycle.robot).unwrap_err().to_string();
        assert!(verified.contains(&expected), "{verified}");
    }
    let text = plan.to_json().unwrap();
    let said = Plan::from_json(&text.replacen("\"seed\":1,", "\"seed\":9007199254740993,", 1));
    let said = said.unwrap_err().to_string();
    assert!(
        said.contains("'scenario.seed' is 9007199254740993; expected a whole number from 0 to"),
        "{said}"
    );
    let error = sweep::sweep(&one_plate(), ABOVE..=ABOVE).unwrap_err().to_string();
    assert!(error.contains("9007199254740991"), "{error}");
}

#[test]
fn a_plan_that_could_not_be_read_back_is_not_sealed() {
    let (cycle, _) = judged(&one_plate());
    for value in [f64::NAN, f64::INFINITY] {
        let mut plan = cycle.to_plan().unwrap();
        plan.summary.duration_s = value;
        assert!(plan.seal().is_err());
        let certificate = certificate::verify(&plan, &cycle.robot).unwrap();
        assert_eq!(certificate.verdict, CertificateVerdict::Fail);
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
    let arm = |size: f64| -> RobotModel {
        let faces = "f 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n";
        let corners = format!("v 0 0 0\nv {size} 0 0\nv 0 {size} 0\nv 0 0 {size}\n");
        written(folder.path(), "hull.obj", &(corners + faces));
        let mut section = one_plate().robot;
        section.urdf = Some(written(folder.path(), "arm.urdf", &text));
        robot::load(&section).unwrap()
    };
    let (small, large) = (arm(0.05), arm(0.06));
    assert_ne!(small.sha256(), large.sha256());
    assert_eq!(small.sha256(), arm(0.05).sha256());
}

/// The tilted rim is down while the arm still moves: no faster than it washes, however slowly that is.
#[test]
fn the_sponge_comes_down_and_leaves_no_faster_than_it_washes() {
    let mut scenario = one_plate();
    scenario.wash.speed_m_s = 0.06;
    let (_, certificate) = judged(&scenario);
    assert_eq!(certificate.verdict, CertificateVerdict::Pass, "{certificate}");
    let measure = certificate.promise(PromiseName::ContactSpeed).unwrap().measure.unwrap();
    assert!(measure.limit == 0.06 && measure.seen.unwrap() > 0.01, "{measure:?}");
}
