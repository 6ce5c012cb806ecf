//! `platewash scenario` and `platewash compare`: from a shipped scenario to one's own, and what a change gains.

use super::*;

#[test]
fn lists_and_prints_every_shipped_scenario() {
    let folder = folder();
    let dir = folder.path();
    let listed = platewash(dir, &["scenario"]).done().stdout;
    let names: Vec<&str> = listed
        .lines()
        .map(|line| line.split_whitespace().next().unwrap())
        .collect();
    assert_eq!(names.len(), 18);
    for name in names {
        let text = platewash(dir, &["scenario", name]).done().stdout;
        let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("scenarios/{name}.toml"));
        assert_eq!(text, std::fs::read_to_string(shipped).unwrap());
        assert_eq!(
            platewash(dir, &["scenario", name, "--json"]).done().json(),
            text.as_str()
        );
    }
    platewash(dir, &["scenario", "kitchn"]).refused(2, &["kitchn", "shipped: kitchen, "]);
    platewash(dir, &["scenario", "--scenario", "kitchen"]).refused(2, &["--scenario:", "platewash scenario NAME"]);
}

#[test]
fn two_plans_are_compared_in_job_time_and_margins() {
    let folder = folder();
    let dir = folder.path();
    let text = platewash(dir, &["scenario", "kitchen-roomy"]).done().stdout;
    let slower = text.replace("speed_m_s = 0.25", "speed_m_s = 0.2");
    assert_ne!(slower, text);
    std::fs::write(dir.join("slower.toml"), slower).unwrap();
    platewash(dir, &["plan", "--quiet", "--scenario", "kitchen-roomy", "--out", "a"]).done();
    platewash(dir, &["plan", "--quiet", "--scenario", "slower.toml", "--out", "b"]).done();

    let answer = platewash(dir, &["compare", "a/plan.json", "b/plan.json", "--json"])
        .done()
        .json();
    assert_eq!(
        answer["job"],
        serde_json::json!([{"key": "requirements.wash_speed_m_s", "a": "0.25", "b": "0.2"}])
    );
    let whole = &answer["times"][0];
    let [a_s, b_s] = ["a_s", "b_s"].map(|key| whole[key].as_f64().unwrap());
    assert_eq!(
        (whole["part"].as_str(), answer["a"]["duration_s"].as_f64()),
        (Some("whole cycle"), Some(a_s))
    );
    assert!(a_s < b_s, "{whole}");
    let parts = answer["times"].as_array().unwrap()[1..4].iter();
    let sum_s: f64 = parts.map(|part| part["a_s"].as_f64().unwrap()).sum();
    assert!((sum_s - a_s).abs() < 1e-9, "{sum_s} {a_s}");
    let verified = platewash(dir, &["verify", "b/plan.json", "--json"]).done().json();
    for margins in answer["margins"].as_array().unwrap() {
        let checks = verified["checks"].as_array().unwrap();
        let check = checks
            .iter()
            .find(|check| check["requirement"] == margins["requirement"])
            .unwrap();
        assert_eq!(check["measure"], margins["b"]);
    }

    let told = platewash(dir, &["compare", "a/plan.json", "b/plan.json"]).done().stdout;
    assert!(
        told.starts_with("A: a/plan.json: scenario \"kitchen-roomy\", seed "),
        "{told}"
    );
    assert!(
        told.contains("job: 1 field differs\n  requirements.wash_speed_m_s: A 0.25, B 0.2\n"),
        "{told}"
    );
    let speed = told.lines().find(|line| line.starts_with("wash speed ")).unwrap();
    assert!(speed.ends_with("≤ 0.2500 m/s, in B ≤ 0.2000 m/s"), "{speed}");

    let same = platewash(dir, &["compare", "a/plan.json", "a/plan.json"]).done().stdout;
    assert!(
        same.contains("job: no field differs") && same.contains("the same in both: "),
        "{same}"
    );
    platewash(dir, &["compare", "a/plan.json"]).refused(2, &["<B>"]);
    platewash(dir, &["compare", "a/plan.json", "slower.toml"]).refused(2, &["slower.toml"]);
}

#[test]
fn a_run_of_the_papers_program_is_compared_without_margins() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["plan", "--quiet", "--scenario", "paper-appendix", "--out", "a"]).done();
    let told = platewash(dir, &["compare", "a/plan.json", "a/plan.json"]).done().stdout;
    assert!(
        told.contains("it has no certificate") && !told.contains("proved bound"),
        "{told}"
    );
}
