//! `platewash verify`.

use super::{folder, platewash};

#[test]
fn a_plan_of_the_papers_program_is_refused_by_name() {
    let folder = folder();
    platewash(folder.path(), &["plan", "--scenario", "paper-appendix", "--quiet"]).done();
    let ran = platewash(folder.path(), &["verify", "out/plan.json"]);
    assert_eq!(ran.code, 4, "{}", ran.stderr);
    assert_eq!(
        ran.stdout,
        "NOT PROVED: a run of the paper's program, 3.70 s; it has no certificate\nscenario \"paper-appendix\", as the plan names it\nthe hash matches the contents\n"
    );
    let ran = platewash(folder.path(), &["verify", "out/plan.json", "--json"]);
    assert_eq!(ran.code, 4);
    let answer = ran.json();
    assert_eq!(
        (&answer["verdict"], &answer["process"]),
        (&"fail".into(), &"paper".into())
    );
    assert_eq!(answer["hash"]["status"], "proved");
}

/// Two plates 80 mm into each other, which is only to be reported.
pub const OVERLAPPING: &str = "name = \"overlapping\"
[tool]
length_m = 0.15
[robot]
start_deg = [0, 0, 0, 0, 90, 0]
[layout]
positions_m = [[0.36, -0.1], [0.36, 0.11]]
overlap = \"report\"
[wash]
turns = 3.5
path_radius_m = 0.12385
height_m = 0
closing_ring = true
clearance_m = 0.01
";

#[test]
fn waived_requirements_are_in_the_first_line_and_data_without_failing() {
    let folder = folder();
    let dir = folder.path();
    std::fs::write(dir.join("case.toml"), OVERLAPPING).unwrap();
    let waived = "plates apart, gap between plate 1 and plate 2 -80.0 mm (waived by the job)";
    let ran = platewash(dir, &["run", "--scenario", "case.toml", "--quiet"]).done();
    let first = ran.stdout.lines().next().unwrap();
    assert!(first.starts_with("PROVED BUT FOR every plate once"), "{first}");
    assert!(first.contains(waived), "{first}");
    let ran = platewash(dir, &["verify", "out/plan.json"]).done();
    let first = ran.stdout.lines().next().unwrap();
    assert!(first.starts_with("PROVED BUT FOR every plate once"), "{first}");
    assert!(first.contains(waived), "{first}");
    let certificate = platewash(dir, &["verify", "out/plan.json", "--json"]).done().json();
    assert_eq!(
        certificate["waived"],
        serde_json::json!(["every_plate_once", "plates_apart"])
    );
    let written: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(dir.join("out/certificate.json")).unwrap()).unwrap();
    assert_eq!(written, certificate);
    // The help says what the exit code says of it.
    let help = platewash(dir, &["verify", "--help"]).done().stdout;
    assert!(help.contains("waived") && help.contains("code 0"), "{help}");
}

/// What is added to a plan or left out of it is refused, not passed over.
#[test]
fn rejects_a_plan_with_unknown_or_missing_keys() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["plan", "--quiet"]).done();
    let text = std::fs::read_to_string(dir.join("out/plan.json")).unwrap();
    for (from, to, told) in [
        ("\"coverage\":", "\"soap\":1,\"coverage\":", "soap"),
        ("\"kind\":\"wash\"", "\"kind\":\"wash\",\"soap\":1", "soap"),
        ("\"payload_kg\":null,", "", "'job.simulation.payload_kg' is missing"),
    ] {
        let edited = text.replacen(from, to, 1);
        assert_ne!(edited, text);
        std::fs::write(dir.join("edited.json"), edited).unwrap();
        platewash(dir, &["verify", "edited.json"]).refused(2, &["edited.json", told]);
    }
}

#[test]
fn rejects_files_that_are_no_plan() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["verify", "missing.json"]).refused(2, &["missing.json", "cannot be read"]);
    platewash(dir, &["verify", "."]).refused(2, &["not a regular file"]);
    std::fs::write(dir.join("text.json"), "{\"format\": 1}").unwrap();
    platewash(dir, &["verify", "text.json"]).refused(2, &["text.json", "not a plan file"]);
    platewash(dir, &["plan", "--scenario", "paper-appendix", "--quiet"]).done();
    let text = std::fs::read_to_string(dir.join("out/plan.json")).unwrap();
    std::fs::write(
        dir.join("other.json"),
        text.replace("platewash-plan/2", "platewash-plan/9"),
    )
    .unwrap();
    platewash(dir, &["verify", "other.json"]).refused(2, &["platewash-plan/9"]);
    let before = text.replace("platewash-plan/2", "platewash-plan/1");
    std::fs::write(dir.join("other.json"), before).unwrap();
    platewash(dir, &["verify", "other.json"]).refused(2, &["platewash-plan/1", "plan its scenario again"]);
    std::fs::write(dir.join("edited.json"), text.replacen("\"seed\":1", "\"seed\":2", 1)).unwrap();
    let ran = platewash(dir, &["verify", "edited.json"]);
    assert_eq!(ran.code, 4);
    assert!(
        ran.stdout.contains("the hash does NOT match the contents"),
        "{}",
        ran.stdout
    );
}
