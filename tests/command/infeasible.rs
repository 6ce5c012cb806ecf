//! Certified jobs that cannot be done: what is said, written and removed.

use super::*;
use platewash_fixtures::is_thorough;

fn plan(dir: &Path, file: &Path) -> CommandOutput {
    platewash(dir, &["plan", "--scenario", file.to_str().unwrap(), "--out", "o"])
}

fn at(x: f64, y: f64) -> String {
    format!("positions_m = [[{x}, {y}]]")
}

#[test]
fn an_infeasible_job_is_reported_with_its_cause_and_a_place_that_will_do() {
    let folder = folder();
    let dir = folder.path();
    let far = [("region = \"appendix\"", "positions_m = [[0.8, 0.0]]")];
    let file = spiral(dir, &far);
    let run = ["run", "--scenario", file.to_str().unwrap()];
    let ran = platewash(dir, &run);
    assert_eq!(ran.code, 3, "{}", ran.stderr);
    assert!(
        ran.stdout.starts_with("INFEASIBLE: plate 1 at (0.800, 0.000) m"),
        "{}",
        ran.stdout
    );
    assert_eq!(names(&dir.join("out")), ["report.json", "report.txt"]);
    assert_eq!(std::fs::read_to_string(dir.join("out/report.txt")).unwrap(), ran.stdout);
    let ran = platewash(dir, &[&run[..], &["--json"]].concat());
    let value: Value = serde_json::from_str(&ran.stdout).unwrap();
    assert_eq!(value["verdict"], "infeasible");
    assert_eq!(value["plates"][0]["conclusion"], "beyond_reach");
    let plate = &value["plates"][0];
    assert_eq!(plate["plate"], 0);
    assert_eq!(plate["washable_share"], 0.0);
    // The largest shortfall: the stroke's far side lies 0.2 m and more beyond the reach of 0.635 m.
    assert!(plate["causes"][0]["shortfall_m"].as_f64().unwrap() > 0.2, "{plate}");
    assert_eq!(plate["causes"][0]["kind"], "reach");
    assert!(value["reason"].as_str().unwrap().contains("by up to"));
    let written = std::fs::read_to_string(dir.join("out/report.json")).unwrap();
    assert_eq!(serde_json::from_str::<Value>(&written).unwrap(), value);
    let [x, y] = [0, 1].map(|k| plate["nearest_m"][k].as_f64().unwrap());
    assert!(
        value["reason"]
            .as_str()
            .unwrap()
            .contains(&format!("({x:.3}, {y:.3}) m"))
    );
    plan(dir, &spiral(dir, &[("region = \"appendix\"", &at(x, y))])).done();
    spiral(dir, &[far[0], ("on_failure = \"fail\"", "on_failure = \"report\"")]);
    let ran = platewash(dir, &run).done();
    assert!(ran.stdout.starts_with("INFEASIBLE"), "{}", ran.stdout);
}

/// Places whose suggestions failed again when typed in, or left the job failing on a line or at home.
#[test]
fn a_suggested_place_holds_when_typed_in() {
    let folder = folder();
    let dir = folder.path();
    let cases = [
        (0.475, 0.194, 0.145, 0.1, 0.0, 15.0),
        (-0.386, 0.185, 0.1, 0.25, 0.0, 15.0),
        (-0.063, 0.508, 0.145, 0.03, 0.0, 15.0),
        (-0.516, 0.22, 0.1, 0.25, 0.0, 30.0),
        (-0.004, -0.194, 0.1, 0.1, 0.0, 15.0),
        (0.015, 0.236, 0.145, 0.1, 0.0, 30.0),
        (-0.1, 0.604, 0.1, 0.1, 0.01, 30.0),
        (-0.149, 0.526, 0.145, 0.25, 0.01, 30.0),
    ];
    let tried = if is_thorough() { cases.len() } else { 3 };
    for (x, y, radius, height, clearance, tilt) in cases.into_iter().rev().take(tried) {
        let case = |x: f64, y: f64| {
            spiral(
                dir,
                &[
                    ("region = \"appendix\"", &at(x, y)),
                    ("plate_radius_m = 0.145", &format!("plate_radius_m = {radius}")),
                    (
                        "path_radius_m = 0.12385",
                        &format!("path_radius_m = {}", radius - 0.021),
                    ),
                    ("plate_height_m = 0.03", &format!("plate_height_m = {height}")),
                    ("clearance_m = 0.01", &format!("clearance_m = {clearance}")),
                    ("tilt_max_deg = 15", &format!("tilt_max_deg = {tilt}")),
                    ("overlap = \"fail\"", "overlap = \"report\""),
                ],
            )
        };
        let file = case(x, y);
        let ran = platewash(
            dir,
            &["plan", "--json", "--scenario", file.to_str().unwrap(), "--out", "o"],
        );
        assert_eq!(ran.code, 3, "{}", ran.stderr);
        let value: Value = serde_json::from_str(&ran.stdout).unwrap();
        let nearest = &value["plates"][0]["nearest_m"];
        let Some([x, y]) = nearest.as_array().map(|_| [0, 1].map(|k| nearest[k].as_f64().unwrap())) else {
            panic!("{}", value["reason"]);
        };
        plan(dir, &case(x, y)).done();
    }
}

#[test]
fn says_plainly_that_no_position_was_found() {
    let folder = folder();
    let dir = folder.path();
    let large = [
        ("plate_radius_m = 0.145", "plate_radius_m = 0.6"),
        ("path_radius_m = 0.12385", "path_radius_m = 0.55"),
        ("start_deg = [0, 0, 0, 0, 90, 0]", "start_deg = [0, -30, 0, 0, 0, 0]"),
    ];
    let given = [&large[..], &[("region = \"appendix\"", "positions_m = [[0.9, 0.0]]")]].concat();
    let ran = plan(dir, &spiral(dir, &given));
    assert_eq!(ran.code, 3);
    assert!(
        ran.stdout
            .contains("no position where the arm can follow its wash path was found within 0.6 m"),
        "{}",
        ran.stdout
    );
    let sampled = [
        &large[..],
        &[
            ("region = \"appendix\"", "rho_m = [0.8, 0.9]"),
            ("count = 4", "count = 1"),
        ],
    ]
    .concat();
    let ran = plan(dir, &spiral(dir, &sampled));
    assert_eq!(ran.code, 3);
    assert!(
        ran.stdout.contains("plates are sampled") && ran.stdout.contains("layout.only_washable"),
        "{}",
        ran.stdout
    );
}

/// Keys that are told are typed in.
#[test]
fn suggested_keys_give_a_plan_when_typed_in() {
    let folder = folder();
    let dir = folder.path();
    // The handle ends 9 mm over a small plate: 1.5 mm and the tool's tilt too near.
    let plate = [
        ("region = \"appendix\"", "positions_m = [[0.4, 0.0]]"),
        ("plate_radius_m = 0.145", "plate_radius_m = 0.08"),
        ("path_radius_m = 0.12385", "path_radius_m = 0.059"),
        ("turns = 3.5", "turns = 1.5"),
    ];
    let with = |changes: &[(&str, &str)]| spiral(dir, &[&plate[..], changes].concat());
    let low = ("sponge_height_m = 0.025", "sponge_height_m = 0.009");
    let ran = plan(dir, &with(&[low]));
    assert_eq!(ran.code, 3, "{}", ran.stderr);
    let report: Value = serde_json::from_str(&std::fs::read_to_string(dir.join("o/report.json")).unwrap()).unwrap();
    let remedies = &report["remedies"]["would_do"];
    let of = |key: &str| remedies.as_array().unwrap().iter().find(|remedy| remedy["key"] == key);
    let higher = of("tool.sponge_height_m").unwrap_or_else(|| panic!("{}", ran.stdout));
    let (value, found) = (higher["value"].as_f64().unwrap(), higher["found"].as_f64().unwrap());
    assert!(found == 0.009 && value > found, "{higher}");
    let words = format!("tool.sponge_height_m = {value:?} instead of 0.009");
    assert!(ran.stdout.starts_with("INFEASIBLE: ") || ran.stdout.starts_with("NOT FOUND: "));
    assert!(ran.stdout.lines().next().unwrap().contains(&words), "{}", ran.stdout);
    for (value, code) in [(value, 0), (value - 0.001, 3)] {
        let typed = format!("sponge_height_m = {value:.3}");
        assert_eq!(plan(dir, &with(&[(low.0, &typed)])).code, code, "{typed}");
    }
    let clearance = of("wash.clearance_m").map(|remedy| remedy["value"].as_f64().unwrap());
    if let Some(value) = clearance {
        let typed = format!("clearance_m = {value}");
        plan(dir, &with(&[low, ("clearance_m = 0.01", &typed)])).done();
    }
}

#[test]
fn reports_all_unwashable_plates_in_one_run() {
    let folder = folder();
    let dir = folder.path();
    let at = |places: &str| format!("positions_m = [{places}]");
    let far = at("[0.7, 0.0], [0.0, 0.72], [0.3, 0.3]");
    let ran = plan(dir, &spiral(dir, &[("region = \"appendix\"", &far)]));
    assert_eq!(ran.code, 3, "{}", ran.stderr);
    for part in [
        "plate 1 at (0.700, 0.000) m",
        "plate 2 at (0.000, 0.720) m",
        "; besides, plate ",
    ] {
        assert!(ran.stdout.contains(part), "no {part} in {}", ran.stdout);
    }
    let report: Value = serde_json::from_str(&std::fs::read_to_string(dir.join("o/report.json")).unwrap()).unwrap();
    let plates = report["plates"].as_array().unwrap();
    assert_eq!(plates.len(), 2, "{}", ran.stdout);
    let place = |index: usize| {
        let plate = plates.iter().find(|plate| plate["plate"] == index).unwrap();
        plate["nearest_m"].to_string()
    };
    let places = [0, 1].map(place);
    let near = at(&format!("{}, {}, [0.3, 0.3]", places[0], places[1]));
    let told = ("overlap = \"fail\"", "overlap = \"report\"");
    plan(dir, &spiral(dir, &[("region = \"appendix\"", &near), told])).done();
}

#[test]
fn removes_files_of_an_earlier_call() {
    let folder = folder();
    let dir = folder.path();
    let out = dir.join("out");
    std::fs::create_dir_all(&out).unwrap();
    for name in [
        "plan.json",
        "certificate.json",
        "report.txt",
        "executed.csv",
        "mine.txt",
    ] {
        std::fs::write(out.join(name), "PROVED").unwrap();
    }
    let far = spiral(dir, &[("region = \"appendix\"", "positions_m = [[0.8, 0.0]]")]);
    assert_eq!(platewash(dir, &["run", "--scenario", far.to_str().unwrap()]).code, 3);
    assert_eq!(names(&out), ["mine.txt", "report.json", "report.txt"]);
    assert!(
        std::fs::read_to_string(out.join("report.txt"))
            .unwrap()
            .starts_with("INFEASIBLE")
    );
    platewash(dir, &["plan", "--scenario", "paper-text", "--csv", "out/executed.csv"]).done();
    assert_eq!(names(&out), ["executed.csv", "mine.txt", "plan.json"]);
    // Bad input removes nothing.
    platewash(dir, &["run", "--scenario", "nowhere.toml"]).refused(2, &["nowhere.toml"]);
    assert_eq!(names(&out), ["executed.csv", "mine.txt", "plan.json"]);
}

#[test]
fn names_bodies_that_are_too_near_at_home_and_over_a_plate() {
    let folder = folder();
    let dir = folder.path();
    let start = "start_deg = [0, 0, 0, 0, 90, 0]";
    let down = spiral(dir, &[(start, "start_deg = [0, 90, 60, 0, 90, 0]")]);
    platewash(dir, &["validate", "--scenario", down.to_str().unwrap()]).refused(
        3,
        &[
            "robot.start_deg",
            "handle",
            "11.00 mm must be kept",
            "wash.clearance_m",
            "1.00 mm in reserve",
        ],
    );
    let ran = plan(dir, &down);
    assert!(
        ran.code == 3 && ran.stdout.contains("robot.start_deg"),
        "{}",
        ran.stdout
    );
    let ran = plan(dir, &spiral(dir, &[("lift_m = 0.03 ", "lift_m = 0.01 ")]));
    assert_eq!(ran.code, 3);
    for part in [
        "the line over plate",
        "sponge is 5.00 mm from plate",
        "wash.lift_m",
        "11.00 mm",
    ] {
        assert!(ran.stdout.contains(part), "no {part} in {}", ran.stdout);
    }
}

#[test]
fn validate_reports_the_errors_of_run() {
    let folder = folder();
    let dir = folder.path();
    let start = "start_deg = [0, 0, 0, 0, 90, 0]";
    let home = format!("{start}\nhome_deg = [170, 0, 0, 0, 90, 0]");
    let cases: [(&str, &str, &[&str]); 9] = [
        (
            "plate_thickness_m = 0.02",
            "plate_thickness_m = 1e-9",
            &["layout.plate_thickness_m"],
        ),
        ("turns = 3.5", "turns = 0.1", &["wash.turns", "from 0.25 to 200"]),
        ("turns = 3.5", "turns = 1000", &["wash.turns", "from 0.25 to 200"]),
        (
            "path_radius_m = 0.12385",
            "path_radius_m = 1e-6",
            &["wash.path_radius_m", "0.0001"],
        ),
        (
            "path_radius_m = 0.12385",
            "path_radius_m = 10",
            &["wash.path_radius_m", "100 m"],
        ),
        ("length_m = 0.15", "length_m = 0", &["tool.length_m"]),
        ("speed_m_s = 0.25", "speed_m_s = 1e-300", &["wash.speed_m_s"]),
        ("tip_speed_m_s = 1.0", "tip_speed_m_s = 1e-9", &["limits.tip_speed_m_s"]),
        (start, &home, &["robot.home_deg", "joint 1"]),
    ];
    for (from, to, fragments) in cases {
        let file = spiral(dir, &[(from, to)]);
        for verb in ["validate", "run"] {
            platewash(dir, &[verb, "--scenario", file.to_str().unwrap()]).refused(2, fragments);
        }
        assert_eq!(names(dir), ["case.toml"]);
    }
    // An obstacle in a plate, whatever the program and wherever its plates come from.
    let post = "\n[[obstacle]]\nname = \"post\"\nshape = \"box\"\nsize_m = [0.6, 0.6, 0.1]\nat_m = [0.45, 0.0, 0.05]\n";
    for shipped in ["paper-appendix", "paper-text", "kitchen-spiral"] {
        let file = replaced(dir, shipped, &[]);
        let text = std::fs::read_to_string(&file).unwrap() + post;
        std::fs::write(&file, text).unwrap();
        for verb in ["validate", "run"] {
            let ran = platewash(dir, &[verb, "--scenario", file.to_str().unwrap()]);
            assert_eq!(ran.code, 2, "{verb} {shipped}: {}", ran.stdout);
            assert!(
                ran.stderr.contains("obstacle 'post' reaches 30.0 mm into plate"),
                "{}",
                ran.stderr
            );
        }
    }
    // Too long a table is said before anything is planned, by the key at fault.
    let slow = spiral(dir, &[("speed_m_s = 0.25", "speed_m_s = 1e-6")]);
    let slow = slow.to_str().unwrap();
    platewash(dir, &["run", "--scenario", slow]).refused(2, &["control.dt_s", "1000000 rows", "as --dt"]);
    platewash(dir, &["run", "--scenario", slow, "--dt", "0.1"]).refused(2, &["--dt: a time step of 0.1 s"]);
    // The file is named, not the scenario's own name.
    let many: Vec<_> = (0..1000).map(|k| format!("[{}, 0.3]", f64::from(k) * 1e-3)).collect();
    let many = format!("positions_m = [{}]", many.join(", "));
    let file = spiral(dir, &[("region = \"appendix\"", &many)]);
    platewash(dir, &["validate", "--scenario", file.to_str().unwrap()]).refused(2, &["case.toml", "wash.turns"]);
}

/// A search along one wash path finds nothing, and another path that the job allows is proved: nothing is said of all paths.
#[test]
fn what_fails_on_one_path_is_not_called_infeasible() {
    let folder = folder();
    let dir = folder.path();
    // Nine tenths of the face are enough, and its far edge is just out of reach.
    let lower = [
        ("required_coverage = 0.995", "required_coverage = 0.93"),
        ("count = 4\n", ""),
        ("min_distance_m = 0.30 ", ""),
        ("contact_share = 0.995", "contact_share = 0.93"),
        ("contact_time_share = 0.98", "contact_time_share = 0.9"),
        ("contact_dose_pa_m = 25", "contact_dose_pa_m = 10"),
        ("contact_dose_share = 0.98", "contact_dose_share = 0.85"),
    ];
    let pinned = ("\n[wash]\n", "\n[wash]\npath_radius_m = 0.118\n");
    for (x_m, tilt_deg) in [("0.516", "15"), ("0.516", "14.9"), ("0.514", "14.5")] {
        let placed = [
            ("region = \"appendix\"", &*format!("positions_m = [[{x_m}, 0.0]]")),
            ("tilt_max_deg = 15", &*format!("tilt_max_deg = {tilt_deg}")),
        ]
        .map(|(from, to)| (from, to.to_owned()));
        let mut changes: Vec<(&str, &str)> = placed.iter().map(|(from, to)| (*from, &**to)).collect();
        changes.extend(lower);
        let run = |changes: &[(&str, &str)]| {
            let file = replaced(dir, "kitchen", changes);
            let file = file.to_str().unwrap();
            platewash(dir, &["run", "--scenario", file, "--search-time", "0", "--out", "o"])
        };
        let free = run(&changes);
        changes.push(pinned);
        let pinned = run(&changes);
        assert_eq!(pinned.code, 0, "{x_m} {tilt_deg}: {}{}", pinned.stdout, pinned.stderr);
        assert_eq!(free.code, 3, "{x_m} {tilt_deg}: {}", free.stdout);
        assert!(
            free.stdout.starts_with("NOT FOUND: "),
            "{x_m} {tilt_deg}: {}",
            free.stdout
        );
        assert!(
            free.stdout.contains("of the wash path that was tried"),
            "{}",
            free.stdout
        );
    }
}

/// A home that keeps the clearance but not the planner's own reserve does not show that there is no plan.
#[test]
fn a_home_within_the_planners_reserve_is_not_called_infeasible() {
    let folder = folder();
    let dir = folder.path();
    // The sponge's side is 25 mm from the tool's axis, which is at x = 302 mm.
    for (gap_mm, word) in [
        (5.0, "INFEASIBLE"),
        (9.9, "INFEASIBLE"),
        (10.2, "NOT FOUND"),
        (10.9, "NOT FOUND"),
    ] {
        let x_m = 1e-3 * (302.0 + 25.0 + gap_mm + 50.0);
        let post = format!(
            "[[obstacle]]\nname = \"post\"\nshape = \"box\"\nsize_m = [0.1, 0.1, 0.1]\nat_m = [{x_m}, 0.0, 0.42]\n\n[limits]"
        );
        let file = spiral(dir, &[("region = \"appendix\"", &at(-0.1, 0.4)), ("[limits]", &post)]);
        let ran = plan(dir, &file);
        assert_eq!(ran.code, 3, "{gap_mm}: {}", ran.stderr);
        let first = ran.stdout.lines().next().unwrap();
        assert!(
            first.starts_with(word) && first.contains("not clear"),
            "{gap_mm}: {first}"
        );
    }
}
