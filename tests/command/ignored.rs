//! Options that would be ignored are refused; names out of files command no terminal; a sweep tells its rows in order.

use super::*;

#[test]
fn options_that_would_be_ignored_are_refused() {
    let folder = folder();
    let dir = folder.path();
    for verb in ["verify", "simulate", "tune"] {
        platewash(dir, &[verb, "p.json", "--scenario", "paper-text"]).refused(2, &["--scenario", "leave it out"]);
        platewash(dir, &[verb, "p.json", "--seed", "5"]).refused(2, &["--seed", "leave it out"]);
    }
    let verify = ["verify", "p.json", "--against", "kitchen", "--scenario", "kitchen"];
    platewash(dir, &verify).refused(2, &["--scenario", "leave it out"]);
    platewash(dir, &["sweep", "--seeds", "1..2", "--seed", "4"]).refused(2, &["--seed:", "leave it out"]);
    platewash(dir, &["align", "touched.csv", "--srdf", "arm.srdf"]).refused(2, &["--srdf:", "leave it out"]);
}

#[test]
fn help_shows_no_option_that_is_refused() {
    let folder = folder();
    let help = |verb: &str| platewash(folder.path(), &[verb, "--help"]).done().stdout;
    for (verb, shown, hidden) in [
        (
            "run",
            &["--scenario", "--seed", "--out", "--urdf", "--tool-mount"][..],
            &[][..],
        ),
        (
            "verify",
            &["--against", "--seed", "--urdf"],
            &["--scenario <", "--tool-mount <"],
        ),
        (
            "simulate",
            &["--out", "--urdf"],
            &["--scenario <", "--seed <", "--tool-mount <"],
        ),
        (
            "align",
            &["--json", "--scenario <", "--urdf <", "--package-path <"],
            &["--seed <", "--srdf <", "--out <"],
        ),
        ("study", &["--out"], &["--scenario <", "--seed <", "--urdf <"]),
        ("sweep", &["--scenario", "--seeds <"], &["--seed <"]),
        ("reproduce", &["--seed", "--out"], &["--scenario <", "--urdf <"]),
    ] {
        let text = help(verb);
        assert!(shown.iter().all(|option| text.contains(option)), "{verb}: {text}");
        assert!(!hidden.iter().any(|option| text.contains(option)), "{verb}: {text}");
    }
}

#[test]
fn control_characters_in_names_never_reach_the_terminal() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["plan", "--scenario", "kitchen", "--out", "."]).done();
    let text = std::fs::read_to_string(dir.join("plan.json")).unwrap();
    let named = text.replacen("\"scenario\":\"kitchen\"", "\"scenario\":\"a\\u001b[31m\\u009b2J\"", 1);
    assert_ne!(named, text);
    std::fs::write(dir.join("plan.json"), named).unwrap();
    for arguments in [&["verify", "plan.json"][..], &["verify", "plan.json", "--json"]] {
        let ran = platewash(dir, arguments);
        let all = ran.stdout + &ran.stderr;
        assert!(!all.replace('\n', "").contains(char::is_control), "{all:?}");
    }
}

#[test]
fn a_sweep_prints_its_rows_in_the_order_of_the_seeds() {
    let folder = folder();
    let dir = folder.path();
    let table = |threads: &str| {
        platewash(dir, &["sweep", "--seeds", "3..6", "--threads", threads, "--out", "s"])
            .done()
            .stdout
    };
    let first = table("1");
    assert_eq!(first, table("3"));
    let ran = platewash(dir, &["sweep", "--seeds", "3..4"]).done();
    let told = ran.stderr.lines().last().unwrap();
    assert!(
        told.starts_with("least clearance: seed ") && told.contains("; slowest: seed "),
        "{told}"
    );
    let seeds: Vec<_> = first.lines().map(|line| line.split(',').next().unwrap()).collect();
    assert_eq!(seeds, ["seed", "3", "4", "5", "6"]);
    assert_eq!(std::fs::read_to_string(dir.join("s/sweep.csv")).unwrap(), first);
}
