//! What must not be proved: jobs that would look washed if less were asked of a proof.
#![allow(clippy::unwrap_used, missing_docs)]

use platewash::planner::certificate::{self, CertificateVerdict, PromiseName, Status};
use platewash::planner::cycle::CycleReport;
use platewash::planner::robot;
use platewash::planner::scenario::Overlap;
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
    assert_eq!(status(&certificate, PromiseName::ToolPath), Status::Pass);
    assert_eq!(status(&certificate, PromiseName::StrokeDeviation), Status::Pass);
    assert_eq!(status(&certificate, PromiseName::ContactHeight), Status::Fail);
}

#[test]
fn a_flat_sponge_is_tilted_no_more_than_it_gives_way() {
    let mut scenario = one_plate();
    scenario.tool.sponge_radius_m = 0.1;
    scenario.tool.sponge_height_m = 0.02;
    scenario.wash.path_radius_m = 0.05;
    let most = (0.02f64 / 0.1).asin();
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
            .starts_with(&format!("PROVED: 1 plates washed by at least {share:.1} %")),
        "{}",
        report.headline
    );
    scenario.job.required_coverage = 0.99;
    let (cycle, certificate) = judged(&scenario);
    let report = CycleReport::new(&cycle, certificate);
    assert!(report.headline.starts_with("NOT PROVED"), "{}", report.headline);
    assert!(
        report.headline.ends_with("does not keep coverage"),
        "{}",
        report.headline
    );
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
