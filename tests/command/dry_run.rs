//! `platewash dry-run`, and `verify --parent`.

use super::{folder, kitchen, names, planned, platewash};
use serde_json::Value;
use std::path::Path;

fn read(path: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// A plan file with one fragment replaced, which must take effect.
fn edited(dir: &Path, from: &str, to: &str) {
    let text = std::fs::read_to_string(dir.join("out/plan.json")).unwrap();
    assert!(text.contains(from), "no '{from}' in the plan");
    std::fs::write(dir.join("edited.json"), text.replacen(from, to, 1)).unwrap();
}

#[test]
fn writes_a_dry_run_beside_a_proved_plan() {
    let folder = planned();
    let dir = folder.path();
    let ran = platewash(dir, &["dry-run", "out/plan.json", "--height", "0.05", "--speed", "0.1"]).done();
    let parent = read(&dir.join("out/plan.json"))["hash"].as_str().unwrap().to_owned();
    let first = format!(
        "DRY RUN of {}: 50 mm above the plates, nothing is washed; PROVED: ",
        &parent[..12]
    );
    assert!(ran.stdout.starts_with(&first), "{}", ran.stdout);
    assert!(ran.stdout.contains(&format!("\nparent {parent}\n")), "{}", ran.stdout);
    assert!(ran.stderr.contains("wrote "), "{}", ran.stderr);
    let own = ["certificate.json", "plan.json", "report.json", "report.txt"];
    assert_eq!(names(&dir.join("out/dry-run")), own);
    let whole = std::fs::read_to_string(dir.join("out/dry-run/report.txt")).unwrap();
    assert!(whole.starts_with(&first) && whole.len() > ran.stdout.len(), "{whole}");
    let plan = read(&dir.join("out/dry-run/plan.json"));
    assert_eq!(
        plan["job"]["dry_run"],
        serde_json::json!({"parent": parent, "height_m": 0.05})
    );
    // It is a plan like any other: proved again, simulated, shown.
    let proof = platewash(dir, &["verify", "out/dry-run/plan.json", "--json"])
        .done()
        .json();
    let mut written = read(&dir.join("out/dry-run/certificate.json"));
    let headline = proof["headline"].as_str().unwrap().to_owned();
    let compared = headline
        .strip_suffix("; not checked: whether it follows the plan that it names")
        .unwrap();
    assert_eq!(written["headline"], compared);
    written["headline"] = headline.into();
    assert_eq!(
        written.as_object_mut().unwrap().remove("parent_compared"),
        Some(true.into())
    );
    assert_eq!(written, proof);
    assert_eq!(proof["rests_on"]["dry_run"]["parent"], parent.as_str());
    let ran = platewash(
        dir,
        &[
            "simulate",
            "out/dry-run/plan.json",
            "--law",
            "exact",
            "--json",
            "--out",
            "sim",
        ],
    )
    .done();
    assert_eq!(ran.json()["verdict"], "dry_run");
    assert_eq!(ran.json()["plates"][0]["verdict"], "swept_in_air");
    platewash(
        dir,
        &[
            "figures",
            "out/dry-run/plan.json",
            "--only",
            "layout,coverage",
            "--out",
            "drawn",
        ],
    )
    .done();
    for name in ["layout", "coverage"] {
        let figure = std::fs::read_to_string(dir.join(format!("drawn/{name}.svg"))).unwrap();
        let words = "mm above the plates, nothing is washed; 1 plate, seed ";
        assert!(figure.contains(words) && !figure.contains("pressed"), "{name}");
    }
    // The defaults are the numbers above, and the same call gives the same bytes.
    let before = std::fs::read(dir.join("out/dry-run/plan.json")).unwrap();
    let answer = platewash(dir, &["dry-run", "out/plan.json", "--json", "--quiet"]).done();
    assert!(answer.stderr.is_empty(), "{}", answer.stderr);
    assert_eq!(before, std::fs::read(dir.join("out/dry-run/plan.json")).unwrap());
    let answer = answer.json();
    assert_eq!(answer["proved"], true);
    assert_eq!(
        (&answer["height_m"], &answer["tip_speed_m_s"]),
        (&0.05.into(), &0.1.into())
    );
    assert_eq!(read(&dir.join("out/dry-run/report.json")), answer);
}

#[test]
fn verify_compares_a_dry_run_with_its_parent() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["plan", "--quiet"]).done();
    platewash(dir, &["dry-run", "out/plan.json", "--quiet"]).done();
    let verify = |more: &[&str]| platewash(dir, &[&["verify", "out/dry-run/plan.json", "--parent"], more].concat());
    let ran = verify(&["out/plan.json"]).done();
    let last =
        "no field differs from what a dry run must have; that plan itself is not proved here\n\nmore: --details\n";
    assert!(
        ran.stdout.starts_with("DRY RUN of ") && ran.stdout.ends_with(last),
        "{}",
        ran.stdout
    );
    assert_eq!(
        verify(&["out/plan.json", "--json"]).done().json()["parent"]["differences"],
        serde_json::json!([])
    );
    // The same plates with another requirement are another plan.
    let low = kitchen(dir, &[("clearance_m = 0.01", "clearance_m = 0.005")]);
    platewash(
        dir,
        &["plan", "--scenario", low.to_str().unwrap(), "--out", "low", "--quiet"],
    )
    .done();
    let ran = verify(&["low/plan.json"]);
    assert_eq!(ran.code, 4, "{}", ran.stderr);
    assert!(
        ran.stdout.starts_with("NO DRY RUN of the plan given: "),
        "{}",
        ran.stdout
    );
    assert!(
        ran.stdout
            .contains("  requirements.clearance_m: the plan says 0.01, a dry run 0.005"),
        "{}",
        ran.stdout
    );
    assert!(ran.stdout.contains("  dry_run.parent: "), "{}", ran.stdout);
    // Another seed has other plates and another order.
    platewash(dir, &["plan", "--seed", "2", "--out", "other", "--quiet"]).done();
    let keys = verify(&["other/plan.json", "--json"]).json();
    let keys: Vec<_> = keys["parent"]["differences"]
        .as_array()
        .unwrap()
        .iter()
        .map(|d| d["key"].to_string())
        .collect();
    assert!(keys.iter().any(|key| key.contains("wash_paths[0]")), "{keys:?}");
    // What is no dry run has no parent, and what cannot be a parent is none.
    platewash(dir, &["verify", "out/plan.json", "--parent", "out/plan.json"])
        .refused(2, &["it is neither a dry run nor a recovery"]);
    verify(&["out/dry-run/plan.json"]).refused(2, &["is itself a dry run"]);
    verify(&["none.json"]).refused(2, &["none.json"]);
    edited(dir, "\"coverage\":0.995", "\"coverage\":0.5");
    verify(&["edited.json"]).refused(4, &["edited.json", "changed after it was written"]);
}

#[test]
fn implausible_numbers_are_refused_before_any_file() {
    let folder = planned();
    let dir = folder.path();
    for (option, values) in [
        ("--height", ["0", "-0.05", "nan", "inf", "x"]),
        ("--speed", ["0", "-0.1", "nan", "inf", ""]),
    ] {
        for value in values {
            let ran = platewash(dir, &["dry-run", "out/plan.json", option, value]);
            ran.refused(2, &[option, "finite number above 0"]);
        }
    }
    let dry_run = |more: &[&str]| platewash(dir, &[&["dry-run", "out/plan.json"], more].concat());
    dry_run(&["--height", "1e4"]).refused(2, &["at most 1000 m", "found 10000"]);
    dry_run(&["--height", "0.01"]).refused(2, &["at 0.01 m the sponge", "at least 0.0102 m"]);
    dry_run(&["--speed", "1.5"]).refused(2, &["the plan's 1 m/s", "found 1.5"]);
    dry_run(&["--seed", "2"]).refused(2, &["--seed"]);
    dry_run(&["--scenario", "kitchen"]).refused(2, &["--scenario"]);
    assert!(!dir.join("out/dry-run").exists());
}

#[test]
fn refuses_a_dry_run_of_an_unproved_plan() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["plan", "--quiet"]).done();
    edited(dir, "\"coverage\":0.995", "\"coverage\":0.5");
    platewash(dir, &["dry-run", "edited.json"]).refused(4, &["edited.json", "changed after it was written"]);
    // Sealed, and not proved: the wash is faster than it may be.
    let plan = platewash::Plan::from_json(&std::fs::read_to_string(dir.join("out/plan.json")).unwrap()).unwrap();
    let mut fast = plan.clone();
    fast.job.requirements.wash_speed_m_s = 0.2;
    fast.hash = fast.seal().ok();
    std::fs::write(dir.join("fast.json"), fast.to_json().unwrap()).unwrap();
    platewash(dir, &["dry-run", "fast.json"]).refused(4, &["NOT PROVED", "wash speed"]);
    // Sealed and proved, but with a path that this version does not plan for the job: one whose cone is a little narrower.
    let mut other = plan.clone();
    other.wash_paths[0].cone_rad -= 1e-9;
    other.hash = other.seal().ok();
    std::fs::write(dir.join("other.json"), other.to_json().unwrap()).unwrap();
    platewash(dir, &["verify", "other.json"]).done();
    platewash(dir, &["dry-run", "other.json"]).refused(4, &["other.json", "wash paths"]);
    platewash(
        dir,
        &["plan", "--scenario", "paper-appendix", "--out", "paper", "--quiet"],
    )
    .done();
    platewash(dir, &["dry-run", "paper/plan.json"]).refused(2, &["a run of the paper's program"]);
    assert!(!dir.join("out/dry-run").exists());
    platewash(dir, &["dry-run", "out/plan.json", "--quiet"]).done();
    platewash(dir, &["dry-run", "out/dry-run/plan.json", "--out", "more"]).refused(2, &["is itself a dry run"]);
    platewash(dir, &["dry-run", "out/dry-run/plan.json"]).refused(2, &["give --out another folder"]);
}

#[test]
fn an_impossible_height_is_refused_with_one_that_works() {
    let folder = planned();
    let dir = folder.path();
    platewash(dir, &["dry-run", "out/plan.json", "--quiet"]).done();
    let ran = platewash(dir, &["dry-run", "out/plan.json", "--height", "0.6", "--json"]);
    assert_eq!(ran.code, 3, "{}", ran.stderr);
    let answer = ran.json();
    assert_eq!(answer["verdict"], "infeasible");
    assert_eq!(
        names(&dir.join("out/dry-run")),
        ["report.json", "report.txt"],
        "no plan of an earlier call stays"
    );
    let works = answer["works_at_m"].as_f64().unwrap().to_string();
    platewash(dir, &["dry-run", "out/plan.json", "--height", &works, "--quiet"]).done();
    // Within what the tool's tilt and the planner's reserve take, a little higher is found.
    let ran = platewash(dir, &["dry-run", "out/plan.json", "--height", "0.0102"]);
    assert_eq!(ran.code, 3, "{}", ran.stderr);
    assert!(
        ran.stdout.contains(" passes real plate") && ran.stdout.contains(" mm required"),
        "{}",
        ran.stdout
    );
    let (_, works) = ran.stdout.split_once("; --height ").unwrap();
    let (works, _) = works.split_once(" was found to work\n").unwrap();
    assert!((0.0102..0.05).contains(&works.parse::<f64>().unwrap()), "{works}");
    platewash(dir, &["dry-run", "out/plan.json", "--height", works, "--quiet"]).done();
}

#[test]
fn asks_for_the_arm_of_the_plan() {
    let folder = folder();
    let dir = folder.path();
    let urdf = platewash::kinematics::irb120::IRB120_URDF.replacen("<robot name=\"", "<robot name=\"my_", 1);
    std::fs::write(dir.join("mine.urdf"), urdf).unwrap();
    let mine = kitchen(
        dir,
        &[
            ("model = \"irb120\"", "urdf = \"mine.urdf\""),
            ("count = 4", "count = 1"),
        ],
    );
    platewash(dir, &["plan", "--scenario", mine.to_str().unwrap(), "--quiet"]).done();
    platewash(dir, &["dry-run", "out/plan.json"]).refused(2, &["\"my_", "as --urdf FILE"]);
    platewash(dir, &["dry-run", "out/plan.json", "--urdf", "mine.urdf", "--quiet"]).done();
    let verify = [
        "verify",
        "out/dry-run/plan.json",
        "--urdf",
        "mine.urdf",
        "--parent",
        "out/plan.json",
    ];
    platewash(dir, &verify).done();
}

#[test]
fn the_program_of_a_dry_run_says_so_first_and_has_its_own_name() {
    let folder = folder();
    let dir = folder.path();
    let one = ("count = 4", "count = 1");
    let named = |name: &str| kitchen(dir, &[("name = \"kitchen\"", &format!("name = \"{name}\"")), one]);
    let long = named("a-kitchen-with-a-long-name");
    let plan = ["plan", "--scenario", long.to_str().unwrap(), "--quiet"];
    platewash(dir, &plan).done();
    platewash(dir, &["dry-run", "out/plan.json", "--quiet"]).done();
    let first = |said: &str| {
        assert!(said.starts_with("DRY RUN of "), "{said}");
        assert!(said.contains(": 50 mm above the plates, nothing is washed; "), "{said}");
    };
    let export = |plan: &str, out: &str, more: &[&str]| {
        platewash(dir, &[&["export", plan, "--to", "rapid", "--out", out], more].concat()).done()
    };
    let ran = export("out/dry-run/plan.json", "dry", &["--json"]).json();
    first(&format!("{}; ", ran["dry_run"].as_str().unwrap()));
    first(&export("out/dry-run/plan.json", "dry", &[]).stdout);
    // However long the name of the scenario is, both modules can be told apart on the pendant.
    let washing = export("out/plan.json", "wash", &[]).stdout;
    assert!(washing.starts_with("rapid program: "), "{washing}");
    assert_eq!(names(&dir.join("wash")), ["a_kitchen_with_a_lon.mod"]);
    assert_eq!(names(&dir.join("dry")), ["dry_run_a_kitchen_wi.mod"]);
    let module = std::fs::read_to_string(dir.join("dry/dry_run_a_kitchen_wi.mod")).unwrap();
    assert!(
        module.starts_with("MODULE dry_run_a_kitchen_wi\n"),
        "{}",
        &module[..200]
    );
    let verify = [
        "verify",
        "out/dry-run/plan.json",
        "--program",
        "dry/dry_run_a_kitchen_wi.mod",
    ];
    let ran = platewash(dir, &verify).done();
    first(&ran.stdout);
    assert!(ran.stdout.contains("; HOLDS: rapid program"), "{}", ran.stdout);
    // A washing that is called a dry run does not get a dry run's name.
    let washing = named("dry-run");
    platewash(dir, &["plan", "--scenario", washing.to_str().unwrap(), "--quiet"]).done();
    export("out/plan.json", "named", &[]);
    assert_eq!(names(&dir.join("named")), ["wash_dry_run.mod"]);
}
