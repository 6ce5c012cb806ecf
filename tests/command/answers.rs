//! What a newcomer tries: verdicts that name their cause, remedies and limits that hold when typed in, files of one plan only.

use super::*;

/// The kitchen with lines put in front of a table's first key.
fn with(dir: &Path, before: &str, lines: &str) -> String {
    let file = kitchen(dir, &[(before, &format!("{lines}\n{before}"))]);
    file.to_str().unwrap().to_owned()
}

#[test]
fn a_layout_that_was_only_not_found_is_not_called_infeasible() {
    let folder = folder();
    let dir = folder.path();
    let file = kitchen(dir, &[("count = 4", "count = 5")]);
    let file = file.to_str().unwrap();
    let ran = platewash(dir, &["sweep", "--scenario", file, "--seeds", "5..5", "--json"]);
    assert_eq!(ran.code, 3, "{}", ran.stderr);
    let row = &ran.json()[0];
    assert_eq!(row["outcome"], "not_found");
    let reason = row["reason"].as_str().unwrap();
    for remedy in ["another seed", "layout.min_distance_m", "layout.positions_m"] {
        assert!(reason.contains(remedy), "{reason}");
    }
}

#[test]
fn reports_an_overloaded_arm_instead_of_its_control_law() {
    let folder = folder();
    let dir = folder.path();
    let file = with(dir, "length_m = 0.15 ", "mass_kg = 5");
    let words = "OVERLOADED: tool 5 kg, rated 3 kg";
    let ran = platewash(dir, &["run", "--scenario", &file]);
    assert_eq!(ran.code, 4, "{}", ran.stderr);
    let first = ran.stdout.lines().next().unwrap();
    assert!(first.starts_with("PROVED") && first.ends_with(words), "{first}");
    assert!(!ran.stdout.contains("NOT WASHED"), "{}", ran.stdout);
    let headline = format!("{words}; 4 of 4 plates washed under computed_torque");
    assert!(ran.stdout.contains(&headline), "{}", ran.stdout);
    let line = ["tune", "out/plan.json", "--frequencies", "30", "--dampings", "1"];
    let ran = platewash(dir, &line);
    assert_eq!(ran.code, 4, "{}", ran.stderr);
    assert!(ran.stdout.contains(" overloaded\n"), "{}", ran.stdout);
    let ran = platewash(dir, &["validate", "--scenario", &file]).done();
    assert!(ran.stdout.contains(words), "{}", ran.stdout);
}

#[test]
fn shown_limits_are_accepted_when_typed_in() {
    let folder = folder();
    let dir = folder.path();
    let text = platewash(dir, &["robot"]).done().stdout;
    let ranges = |column: usize| -> Vec<[String; 2]> {
        let rows = text.lines().filter(|line| line.starts_with("joint_"));
        let range = |row: &str| {
            let words: Vec<_> = row.split_whitespace().collect();
            [words[column].to_owned(), words[column + 2].to_owned()]
        };
        rows.map(range).collect()
    };
    for (unit, column) in [("--deg", 1), ("--rad", 4)] {
        for end in [0, 1] {
            let q: Vec<String> = ranges(column).into_iter().map(|range| range[end].clone()).collect();
            let line: Vec<&str> = ["fk", unit].into_iter().chain(q.iter().map(String::as_str)).collect();
            let ran = platewash(dir, &line).done();
            assert!(ran.stdout.contains("within limits: yes"), "{q:?}: {}", ran.stdout);
        }
    }
    let ran = platewash(dir, &["fk", "--deg", "0", "0", "0", "0", "0", "-401"]).done();
    let beyond = "joint 6 at -401.00° is beyond its limit of -400.00°, by 1.00°";
    assert!(ran.stdout.contains(beyond), "{}", ran.stdout);
    assert!(!ran.stdout.contains("-0.0000 "), "{}", ran.stdout);
}

#[test]
fn removes_the_simulation_of_an_earlier_plan() {
    let folder = folder();
    let dir = folder.path();
    let out = dir.join("out");
    platewash(dir, &["run"]).done();
    let of_run = names(&out);
    let executed = std::fs::read(out.join("executed.csv")).unwrap();
    platewash(dir, &["simulate", "out/plan.json", "--frequency", "40"]).done();
    assert_eq!(std::fs::read(out.join("executed.csv")).unwrap(), executed);
    assert!(out.join("simulation.json").exists() && out.join("simulated.csv").exists());
    platewash(dir, &["run", "--seed", "2"]).done();
    assert_eq!(names(&out), of_run);
}

#[test]
fn a_suggested_frequency_or_rate_is_accepted() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["plan"]).done();
    for frequency in ["99999", "1e9"] {
        let simulate = |frequency: &str| platewash(dir, &["simulate", "out/plan.json", "--frequency", frequency]);
        let refused = simulate(frequency);
        refused.refused(
            2,
            &["not stable", "control.frequency_rad_s", "frequency must be at most"],
        );
        assert!(!refused.stderr.contains("need at least"), "{}", refused.stderr);
        let most = refused.stderr.split("must be at most ").nth(1).unwrap();
        let most = most.split(' ').next().unwrap();
        assert_ne!(simulate(most).code, 2, "{most}");
    }
    platewash(dir, &["simulate", "out/plan.json", "--rate", "1e12"]).refused(2, &["with 1 step a sample"]);
}

#[test]
fn a_simulation_asks_for_no_more_coverage_than_the_certificate() {
    let folder = folder();
    let dir = folder.path();
    let text = std::fs::read_to_string(spiral(dir, &[("required_coverage = 0.995", "required_coverage = 1")])).unwrap();
    std::fs::write(dir.join("all.toml"), text + "\n[control]\nlaw = \"exact\"\n").unwrap();
    let ran = platewash(dir, &["run", "--scenario", "all.toml"]).done();
    assert!(ran.stdout.contains("\nSWEPT: 4 of 4 plates"), "{}", ran.stdout);
}

#[test]
fn infeasible_jobs_answer_in_json() {
    let folder = folder();
    let dir = folder.path();
    let file = kitchen(dir, &[("count = 4", "count = 20")]);
    for verb in ["validate", "layout"] {
        let ran = platewash(dir, &[verb, "--json", "--scenario", file.to_str().unwrap()]);
        assert_eq!(ran.code, 3, "{}", ran.stderr);
        let answer = ran.json();
        assert_eq!(
            (&answer["valid"], &answer["verdict"]),
            (&false.into(), &"infeasible".into())
        );
        let reason = answer["reason"].as_str().unwrap();
        assert!(reason.contains("20 plates cannot fit"), "{reason}");
    }
}

#[test]
fn validate_lists_findings_about_sampled_plates() {
    let folder = folder();
    let ask = |verb: &str| {
        let line = [verb, "--scenario", "paper-text", "--json"];
        platewash(folder.path(), &line).done().json()
    };
    let (validated, placed) = (ask("validate"), ask("layout"));
    assert_eq!(validated["valid"], true);
    assert!(!placed["findings"].as_array().unwrap().is_empty());
    assert_eq!(validated["findings"], placed["findings"]);
}

#[test]
fn numbers_in_messages_have_the_digits_that_matter() {
    let folder = folder();
    let dir = folder.path();
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/scenarios/paper-text.toml")).unwrap();
    assert!(text.contains("kp = "));
    let kp = text.lines().find(|line| line.starts_with("kp = ")).unwrap();
    std::fs::write(dir.join("kp.toml"), text.replacen(kp, "kp = 1000000", 1)).unwrap();
    let ran = platewash(dir, &["run", "--scenario", "kp.toml"]);
    let position = ran.stderr.split(" is at ").nth(1).unwrap().split(' ').next().unwrap();
    assert!(position.len() < 10, "{}", ran.stderr);
    let low = kitchen(dir, &[("lift_m = 0.03 ", "lift_m = 0.011 ")]);
    let ran = platewash(dir, &["run", "--scenario", low.to_str().unwrap()]);
    assert!(!ran.stdout.contains("10.99999999"), "{}", ran.stdout);
    let ran = platewash(dir, &["layout", "--scenario", "kitchen"]).done();
    assert!(!ran.stdout.contains(" 1 restarts"), "{}", ran.stdout);
}
