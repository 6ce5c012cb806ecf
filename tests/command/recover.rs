//! `platewash recover`.

use super::other_arms::{UR5, UR5_START, cell};
use super::{folder, names, other_arms, planned, platewash};
use serde_json::Value;
use std::path::Path;

fn read(path: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// Joint positions of a plan file in the middle of its wash of that turn \[deg\], and the time \[s\].
fn in_wash(file: &Path, turn: usize) -> (Vec<String>, f64) {
    let plan = read(file);
    let washes = plan["segments"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|s| s["kind"] == "wash");
    let wash = washes.clone().nth(turn).unwrap();
    let middle_s = 0.5 * (wash["t_start_s"].as_f64().unwrap() + wash["t_end_s"].as_f64().unwrap());
    let times: Vec<_> = plan["knots"]["t_s"]
        .as_array()
        .unwrap()
        .iter()
        .map(|t| t.as_f64().unwrap())
        .collect();
    let knot = times.partition_point(|t| *t < middle_s);
    let q = plan["knots"]["q_rad"][knot].as_array().unwrap();
    let degrees = q.iter().map(|q| format!("{:.3}", q.as_f64().unwrap().to_degrees()));
    (degrees.collect(), times[knot])
}

fn recover<'a>(plan: &'a str, at: &'a [String], more: &[&'a str]) -> Vec<&'a str> {
    let asked = ["recover", plan, "--at-deg"]
        .into_iter()
        .chain(at.iter().map(String::as_str));
    asked.chain(more.iter().copied()).collect()
}

#[test]
fn writes_the_way_home_and_the_rest_beside_a_proved_plan() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["plan"]).done();
    let (at, time_s) = in_wash(&dir.join("out/plan.json"), 1);
    let ran = platewash(dir, &recover("out/plan.json", &at, &[])).done();
    assert!(ran.stdout.starts_with("RECOVERED, PROVED: home in "), "{}", ran.stdout);
    let all = [
        "home.certificate.json",
        "home.json",
        "report.json",
        "report.txt",
        "rest.certificate.json",
        "rest.json",
    ];
    assert_eq!(names(&dir.join("out/recovery")), all);
    let report = read(&dir.join("out/recovery/report.json"));
    let parent = read(&dir.join("out/plan.json"));
    let stop = &report["stop"];
    assert!(
        (stop["time_s"].as_f64().unwrap() - time_s).abs() < 0.1,
        "{stop} {time_s}"
    );
    assert_eq!(stop["washed"], serde_json::json!([parent["order"][0]]));
    assert_eq!(stop["at_plate"], parent["order"][1]);
    for (name, first) in [
        (
            "home",
            "RECOVERY: from the stop home, nothing is washed; the sponge may touch plate ",
        ),
        ("rest", "REST of a stopped plan, without plate "),
    ] {
        let file = format!("out/recovery/{name}.json");
        let proof = platewash(dir, &["verify", &file, "--json"]).done().json();
        let written = read(&dir.join(format!("out/recovery/{name}.certificate.json")));
        assert_eq!(proof["checks"], written["checks"]);
        let headline = written["headline"].as_str().unwrap();
        let alone = format!("{headline}; not checked: whether the plan that it names was stopped so");
        assert_eq!(proof["headline"], alone);
        assert!(proof["headline"].as_str().unwrap().starts_with(first), "{proof}");
        assert_eq!(read(&dir.join(&file))["job"]["recovery"]["parent"], parent["hash"]);
        platewash(dir, &["export", &file, "--to", "rapid", "--out", name]).done();
        let said = platewash(dir, &["simulate", &file]).done().stdout;
        assert!(said.contains(first), "{said}");
        platewash(dir, &["figures", &file, "--out", "drawn"]).done();
        let figure = std::fs::read_to_string(dir.join("drawn/layout.svg")).unwrap();
        assert!(
            figure.contains(first) && figure.contains("proved for every moment"),
            "{figure}"
        );
        assert_eq!(figure.contains("the tip at the stop"), name == "home");
    }
    let program = std::fs::read_to_string(dir.join("home/kitchen_home.mod")).unwrap();
    assert!(
        program.contains("the motion home, ") && !program.contains("0 plates"),
        "{program}"
    );
    platewash(dir, &["dry-run", "out/recovery/rest.json"]).done();
    platewash(dir, &["dry-run", "out/recovery/home.json"]).refused(2, &["motion home"]);
    platewash(dir, &recover("out/recovery/home.json", &at, &[])).refused(2, &["was stopped first"]);
    // The rest may be stopped, too.
    let (at, _) = in_wash(&dir.join("out/recovery/rest.json"), 1);
    let answer = platewash(dir, &recover("out/recovery/rest.json", &at, &["--json"]))
        .done()
        .json();
    assert_eq!(
        answer["rest"]["order"].as_array().unwrap().len(),
        parent["order"].as_array().unwrap().len() - 2
    );
}

#[test]
fn verify_compares_a_recovery_with_the_plan_that_was_stopped() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["plan", "--quiet"]).done();
    platewash(dir, &["plan", "--seed", "2", "--out", "other", "--quiet"]).done();
    let (at, _) = in_wash(&dir.join("out/plan.json"), 1);
    platewash(dir, &recover("out/plan.json", &at, &["--quiet"])).done();
    let verify = |file: &str, parent: &str| platewash(dir, &["verify", file, "--parent", parent]);
    for (name, assumed) in [
        ("home", "the arm stands still where the motion begins"),
        ("rest", "the plates that are left out were washed before"),
    ] {
        let file = format!("out/recovery/{name}.json");
        let said = verify(&file, "out/plan.json").done().stdout;
        let last = "no field differs from what a recovery must have; that plan itself is not proved here";
        assert!(said.contains(last) && said.contains(assumed), "{said}");
        let ran = verify(&file, "other/plan.json");
        assert_eq!(ran.code, 4, "{}", ran.stderr);
        assert!(
            ran.stdout.starts_with("NO RECOVERY of the plan given: "),
            "{}",
            ran.stdout
        );
        assert!(ran.stdout.contains("  recovery.parent: "), "{}", ran.stdout);
        verify("out/plan.json", &file).refused(2, &["it is neither a dry run nor a recovery"]);
        // A pair for which somebody allows less clearance was not near at the stop.
        let mut plan = read(&dir.join(&file));
        plan["job"]["workcell"]["reduced_clearances"] =
            serde_json::json!([{"pair": ["link_4", "sponge"], "by_m": 0.005}]);
        std::fs::write(dir.join("edited.json"), plan.to_string()).unwrap();
        let said = verify("edited.json", "out/plan.json").stdout;
        assert!(said.contains("workcell.reduced_clearances"), "{said}");
        verify(&file, "edited.json").refused(4, &["changed after it was written"]);
    }
}

/// The earliest moment that fits counts: at home nothing is washed yet, unless a later time is stated.
#[test]
fn a_stop_at_home_is_at_the_start_unless_the_time_says_otherwise() {
    let folder = planned();
    let dir = folder.path();
    let plan = read(&dir.join("out/plan.json"));
    let degrees = |q: &Value| q.as_f64().unwrap().to_degrees().to_string();
    let at: Vec<_> = plan["job"]["home_rad"][0]
        .as_array()
        .unwrap()
        .iter()
        .map(degrees)
        .collect();
    let mut off = at.clone();
    off[0] = "1.5".to_owned();
    let answer = platewash(dir, &recover("out/plan.json", &off, &["--json"]))
        .done()
        .json();
    assert_eq!(answer["rest"]["order"], plan["order"]);
    assert_eq!(read(&dir.join("out/recovery/rest.json")), plan, "the plan itself");
    let end_s = plan["knots"]["t_s"].as_array().unwrap().last().unwrap().to_string();
    let answer = platewash(dir, &recover("out/plan.json", &off, &["--stopped-s", &end_s, "--json"]))
        .done()
        .json();
    assert_eq!(answer["rest"], Value::Null);
    assert_eq!(
        names(&dir.join("out/recovery")),
        ["home.certificate.json", "home.json", "report.json", "report.txt"]
    );
    // Far from the plan no plate counts as washed.
    let far = ["90", "-60", "0", "0", "60", "0"].map(str::to_owned);
    let said = platewash(dir, &recover("out/plan.json", &far, &[])).done().stdout;
    assert!(said.contains("nowhere near the plan"), "{said}");
}

/// The times in the log of a program that ran at half speed are not those of the plan.
#[test]
fn a_stated_time_must_fit_the_joints_where_they_fit_the_plan() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["plan", "--quiet", "--scenario", "kitchen"]).done();
    let file = dir.join("out/plan.json");
    let plan = read(&file);
    let end_s = plan["knots"]["t_s"]
        .as_array()
        .unwrap()
        .last()
        .unwrap()
        .as_f64()
        .unwrap();
    let ask = |at: &[String], more: &[&str]| platewash(dir, &recover("out/plan.json", at, more));
    for turn in [0, 1, 2] {
        let (at, stopped_s) = in_wash(&file, turn);
        let true_s = stopped_s.to_string();
        let by_joints = ask(&at, &["--json"]).done().json();
        let stated = ask(&at, &["--stopped-s", &true_s, "--json"]).done().json();
        assert_eq!(stated["stop"]["washed"], by_joints["stop"]["washed"]);
        assert_eq!(stated["stop"]["joints_fit"], true);
        assert!(
            !stated["headline"].as_str().unwrap().contains("not checked"),
            "{stated}"
        );
        for other_s in [2.0 * stopped_s, stopped_s / 0.7, 0.5 * stopped_s, end_s] {
            if other_s <= end_s {
                let (other, nearest) = (other_s.to_string(), format!("fit it at {stopped_s:.2} s"));
                ask(&at, &["--stopped-s", &other]).refused(2, &["--stopped-s", "the joints do not fit", &nearest]);
            }
        }
        // Where the joints fit no moment, the time counts, and the first line says so.
        let mut off = at.clone();
        off[5] = "40".to_owned();
        let said = ask(&off, &["--stopped-s", &true_s]).done().stdout;
        let first = said.lines().next().unwrap();
        assert!(
            first.contains("; not checked: that it stopped at ") && first.contains("the joints fit no moment"),
            "{said}"
        );
    }
    let home: Vec<_> = ["0", "0", "0", "0", "90", "0"].map(str::to_owned).to_vec();
    let said = ask(&home, &["--stopped-s", &end_s.to_string()]).done().stdout;
    let first = said.lines().next().unwrap();
    assert!(
        first.contains("all plates were washed; not checked: ") && first.contains("0.00 s, which the joints fit, too"),
        "{said}"
    );
}

#[test]
fn says_what_touches_and_refuses_what_is_no_stop() {
    let folder = planned();
    let dir = folder.path();
    let (mut at, _) = in_wash(&dir.join("out/plan.json"), 0);
    let deep: f64 = at[1].parse().unwrap();
    at[1] = format!("{:.3}", deep + 8.0);
    let ran = platewash(dir, &recover("out/plan.json", &at, &[]));
    assert_eq!(ran.code, 3, "{}", ran.stdout);
    assert!(
        ran.stdout.starts_with("NOT RECOVERED: where the arm stands, '") && ran.stdout.contains(" touch"),
        "{}",
        ran.stdout
    );
    assert!(!dir.join("out/recovery").exists());
    let asked = |more: &[&str]| platewash(dir, &[&["recover", "out/plan.json"], more].concat());
    asked(&[]).refused(2, &["--at-deg"]);
    asked(&["--at-deg", "1", "2", "3"]).refused(2, &["6 values"]);
    asked(&["--at-deg", "1", "2", "3", "4", "5", "nan"]).refused(2, &["joint 6"]);
    asked(&["--at-deg", "0", "0", "0", "0", "0", "0", "--stopped-s", "-1"])
        .refused(2, &["--stopped-s", "from 0 to", "found -1 s"]);
    let ran = asked(&["--at-deg", "200", "0", "0", "0", "0", "0"]);
    assert!(ran.code == 3 && ran.stdout.contains("joint 1"), "{}", ran.stdout);
    let text = std::fs::read_to_string(dir.join("out/plan.json")).unwrap();
    std::fs::write(dir.join("edited.json"), text.replacen("\"lift_m\":", "\"lift_m\":1", 1)).unwrap();
    platewash(
        dir,
        &["recover", "edited.json", "--at-deg", "0", "0", "0", "0", "0", "0"],
    )
    .refused(4, &["NOT PROVED"]);
}

#[test]
fn the_way_home_of_another_arm_is_a_urscript_program() {
    let folder = folder();
    let dir = folder.path();
    let file = cell(dir, UR5_START, "[[0.55, 0.0], [0.0, 0.55]]", 0.2);
    other_arms::run(dir, "plan", &file, UR5).done();
    let (at, _) = in_wash(&dir.join("o/plan.json"), 1);
    platewash(dir, &recover("o/plan.json", &at, &["--urdf", UR5, "--out", "o"])).done();
    for name in ["home", "rest"] {
        let file = format!("o/recovery/{name}.json");
        let asked = [
            "export",
            &file,
            "--urdf",
            UR5,
            "--to",
            "urscript",
            "--speed-share",
            "0.5",
            "--out",
            name,
            "--json",
        ];
        let answer = platewash(dir, &asked).done().json();
        let program = answer["files"][0].as_str().unwrap().to_owned();
        let found = platewash(dir, &["verify", &file, "--urdf", UR5, "--json", "--program", &program])
            .done()
            .json();
        assert_eq!(
            (&found["holds"], &found["unchanged"]),
            (&true.into(), &true.into()),
            "{found}"
        );
    }
}
