//! Messages whose remedy is accepted, and numbers that can be read.

use super::*;

#[test]
fn a_suggested_time_step_suits_the_motion_planned() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["plan", "--quiet"]).done();
    let plan: Value = serde_json::from_str(&std::fs::read_to_string(dir.join("out/plan.json")).unwrap()).unwrap();
    let duration_s = plan["knots"]["t_s"].as_array().unwrap().last().unwrap();
    let duration_s = duration_s.as_f64().unwrap();
    for verb in [&["run"][..], &["plan"], &["simulate", "out/plan.json"]] {
        let asked = |dt: &str| platewash(dir, &[verb, &["--dt", dt, "--out", "o"]].concat());
        let ran = asked("1e-6");
        ran.refused(2, &["--dt", "give at least"]);
        let suggested = ran.stderr.split("at least ").nth(1).unwrap().split(' ').next().unwrap();
        let rows = duration_s / suggested.parse::<f64>().unwrap();
        assert!(
            (0.98e6..1e6).contains(&rows),
            "{verb:?}: {suggested} s gives {rows} rows"
        );
        for dt in ["1e-9", "1e9"] {
            asked(dt).refused(2, &["--dt", dt, "from 0.000001 to 10"]);
        }
    }
    assert_eq!(names(dir), ["out"]);
}

/// Each of these is refused for another reason too, later.
#[test]
fn unwritable_outputs_are_refused_before_any_work() {
    let folder = folder();
    let dir = folder.path();
    std::fs::write(dir.join("taken"), "a file").unwrap();
    platewash(dir, &["plan", "--quiet"]).done();
    let slow = kitchen(dir, &[("speed_m_s = 0.25", "speed_m_s = 1e-6")]);
    let slow = slow.to_str().unwrap();
    let cases: [&[&str]; 6] = [
        &["run", "--scenario", slow],
        &["plan", "--scenario", slow],
        &["simulate", "out/plan.json", "--frequency", "5000"],
        &["tune", "out/plan.json", "--law", "paper"],
        &["sweep", "--seeds", "1..2"],
        &["reproduce", "--layouts", "10000", "--draws", "1000000"],
    ];
    for line in cases {
        for place in ["taken", "taken/below", "/proc/platewash"] {
            let ran = platewash(dir, &[line, &["--out", place]].concat());
            ran.refused(2, &[place, "cannot be written"]);
        }
    }
    let csv = ["run", "--scenario", slow, "--csv", "taken/motion.csv"];
    platewash(dir, &csv).refused(2, &["taken/motion.csv"]);
    assert_eq!(names(dir), ["case.toml", "out", "taken"], "nothing is left behind");
}

#[test]
fn a_plan_for_another_arm_asks_for_the_option_that_gives_it() {
    let folder = folder();
    let dir = folder.path();
    let built_in = platewash::kinematics::irb120::IRB120_URDF;
    std::fs::write(dir.join("same.urdf"), built_in).unwrap();
    let mine = built_in.replacen("<robot name=\"", "<robot name=\"my_", 1);
    std::fs::write(dir.join("mine.urdf"), mine).unwrap();
    let srdf = platewash::kinematics::irb120::IRB120_SRDF.replacen("<robot name=\"", "<robot name=\"my_", 1);
    std::fs::write(dir.join("a.srdf"), &srdf).unwrap();
    std::fs::write(dir.join("b.srdf"), srdf + "<!-- another one -->\n").unwrap();
    let name = "\"my_";
    platewash(dir, &["plan", "--urdf", "mine.urdf", "--quiet"]).done();
    for verb in ["verify", "simulate", "tune"] {
        platewash(dir, &[verb, "out/plan.json"]).refused(2, &["out/plan.json", name, "as --urdf FILE"]);
        let other = [verb, "out/plan.json", "--urdf", "same.urdf"];
        platewash(dir, &other).refused(2, &["out/plan.json", name, "--urdf describes \"irb120"]);
    }
    let verify = ["verify", "out/plan.json", "--urdf", "mine.urdf"];
    platewash(dir, &verify).done();
    let with = |srdf: &'static str| [&verify[..], &["--srdf", srdf]].concat();
    platewash(dir, &with("a.srdf")).refused(2, &["without an SRDF", "leave out --srdf"]);
    platewash(dir, &["plan", "--urdf", "mine.urdf", "--srdf", "a.srdf", "--quiet"]).done();
    platewash(dir, &["verify", "out/plan.json"]).refused(2, &[name, "as --urdf FILE", "as --srdf FILE"]);
    platewash(dir, &verify).refused(2, &["with an SRDF", "as --srdf FILE"]);
    platewash(dir, &with("b.srdf")).refused(2, &["the SRDF of SHA-256", "that of --srdf is"]);
    platewash(dir, &with("a.srdf")).done();
}

#[test]
fn a_joint_and_its_limit_are_printed_differently() {
    let folder = folder();
    let dir = folder.path();
    let start = "start_deg = [0, 0, 0, 0, 90, 0]";
    for changed in [
        "start_deg = [0, 0, 70.000000000001, 0, 90, 0]".to_owned(),
        format!("{start}\nhome_deg = [0, 0, 70.000000000001, 0, 90, 0]"),
    ] {
        let file = kitchen(dir, &[(start, &changed)]);
        let ran = platewash(dir, &["validate", "--scenario", file.to_str().unwrap()]);
        ran.refused(2, &["joint 3 at 70.0", "is beyond its limit of "]);
        let told: Vec<_> = ran
            .stderr
            .split('°')
            .map(|part| part.rsplit(' ').next().unwrap())
            .collect();
        assert_ne!(told[0], told[1], "{}", ran.stderr);
    }
}

#[test]
fn the_first_line_states_failed_or_missing_simulation() {
    let folder = folder();
    let dir = folder.path();
    for (law, says) in [
        ("law = \"pd\"\nfrequency_rad_s = 5000", "; NOT SIMULATED"),
        (
            "law = \"pd\"\nfrequency_rad_s = 15",
            "; in the simulation NOT SWEPT under pd",
        ),
    ] {
        let file = spiral(dir, &[("[job]", &format!("[control]\n{law}\n[job]"))]);
        let ran = platewash(dir, &["run", "--scenario", file.to_str().unwrap()]);
        let first = ran.stdout.lines().next().unwrap();
        assert!(first.starts_with("PROVED: ") && first.ends_with(says), "{first}");
        let report = std::fs::read_to_string(dir.join("out/report.json")).unwrap();
        let report: Value = serde_json::from_str(&report).unwrap();
        assert_eq!(report["headline"], first);
    }
}

/// Significant digits of the longest number in a text, hashes apart.
fn longest_number(text: &str) -> (usize, String) {
    let words = text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '.'));
    let numbers =
        words.filter(|word| word.contains('.') && !word.contains(|c: char| c.is_ascii_alphabetic() && c != 'e'));
    let digits = |number: &str| {
        let mantissa = number.split('e').next().unwrap_or_default().replace('.', "");
        mantissa.trim_matches('0').len()
    };
    let longest = numbers.max_by_key(|number| digits(number)).unwrap_or_default();
    (digits(longest), longest.to_owned())
}

#[test]
fn messages_contain_no_raw_float() {
    assert_eq!(
        longest_number("42.67915879140517 s at 0.001 Hz, 9f0.8, 10000000000000").0,
        16
    );
    let folder = folder();
    let dir = folder.path();
    // Lengths that are no round number in millimetres.
    let sponge = [
        (
            "sponge_radius_m = 0.025",
            "sponge_radius_m = 0.0249\nmass_kg = 0.30000000000000004",
        ),
        (
            "sponge_height_m = 0.025",
            "sponge_height_m = 0.0247\nsponge_compression_m = 0.0041",
        ),
    ];
    let file = spiral(dir, &sponge);
    let file = file.to_str().unwrap();
    platewash(dir, &["plan", "--scenario", file]);
    std::fs::rename(dir.join("case.toml"), dir.join("sponge.toml")).unwrap();
    let paper = scenario(dir, "sponge_radius_m = 0.025 ", "sponge_radius_m = 0.0271 ");
    let lines: [&[&str]; 9] = [
        &["run", "--scenario", "sponge.toml"],
        &["run", "--scenario", paper.to_str().unwrap(), "--out", "paper"],
        &["validate", "--scenario", "sponge.toml"],
        &["verify", "out/plan.json", "--details"],
        &["simulate", "out/plan.json"],
        &["simulate", "out/plan.json", "--rate", "1e9"],
        &["simulate", "out/plan.json", "--law", "pd", "--frequency", "5000"],
        &["tune", "out/plan.json", "--frequencies", "10,5000"],
        &["plan", "--dt", "1e-6"],
    ];
    for line in lines {
        let ran = platewash(dir, line);
        for text in [&ran.stdout, &ran.stderr] {
            let (digits, number) = longest_number(text);
            assert!(digits <= 10, "{line:?}: {number} in {text}");
        }
    }
}

#[test]
fn a_report_is_one_screen_and_names_every_pair_on_request() {
    let folder = folder();
    let dir = folder.path();
    let rows = |text: &str| -> Vec<f64> {
        let rows = text
            .lines()
            .filter(|line| line.contains(" – ") && line.contains(" mm  proved"));
        let distance = |line: &str| {
            line.split(" mm")
                .next()
                .unwrap()
                .rsplit(' ')
                .next()
                .unwrap()
                .parse()
                .unwrap()
        };
        rows.map(distance).collect()
    };
    let report = platewash(dir, &["run", "--json"]).done().json();
    let pairs = report["certificate"]["clearance"].as_array().unwrap();
    let judged = pairs.iter().filter(|pair| pair["rule"] == "clearance").count();
    assert!(judged > 50, "{judged}");
    for line in [&["run"][..], &["verify", "out/plan.json"]] {
        let text = platewash(dir, line).done().stdout;
        assert!(text.lines().count() <= 45, "{text}");
        assert!(
            text.contains("\nassumed, not proved\n") && text.ends_with("\nmore: --details\n"),
            "{text}"
        );
        let all = rows(&platewash(dir, &[line, &["--details"]].concat()).done().stdout);
        assert_eq!(all.len(), judged);
        assert!(all.is_sorted(), "{all:?}");
    }
    let file = std::fs::read_to_string(dir.join("out/report.txt")).unwrap();
    assert_eq!(rows(&file).len(), judged);
}

/// The same job with a key that is named is proved.
#[test]
fn a_key_that_is_named_as_a_remedy_gives_a_proof() {
    let folder = folder();
    let dir = folder.path();
    let too_near = kitchen(dir, &[("clearance_m = 0.01", "clearance_m = 0.05")]);
    let ran = platewash(
        dir,
        &[
            "run",
            "--scenario",
            too_near.to_str().unwrap(),
            "--search-time",
            "600",
            "--json",
        ],
    );
    assert_eq!(ran.code, 3, "{}", ran.stderr);
    let remedies = &ran.json()["remedies"]["would_do"];
    let remedy = &remedies[0];
    assert_eq!(
        (&remedy["key"], &remedy["is_proved"]),
        (&"wash.clearance_m".into(), &true.into()),
        "{remedies}"
    );
    let line = format!("clearance_m = {}", remedy["value"]);
    let mended = kitchen(dir, &[("clearance_m = 0.01", &line)]);
    let ran = platewash(dir, &["run", "--scenario", mended.to_str().unwrap(), "--quiet"]).done();
    assert!(ran.stdout.starts_with("PROVED: "), "{}", ran.stdout);
}

/// Without time to search, the keys that were not tried are named, and no more is said of them.
#[test]
fn names_keys_that_there_was_no_time_to_try() {
    let folder = folder();
    let dir = folder.path();
    let deep = platewash(dir, &["scenario", "deep"]).done().stdout;
    let thin = deep
        .replace("sponge_height_m = 0.035", "sponge_height_m = 0.012")
        .replace("sponge_compression_m = 0.006 ", "sponge_compression_m = 0.003 ");
    assert_ne!(thin, deep);
    std::fs::write(dir.join("thin.toml"), thin).unwrap();
    let ran = platewash(
        dir,
        &["run", "--scenario", "thin.toml", "--search-time", "0.01", "--json"],
    );
    let remedies = &ran.json()["remedies"];
    assert_eq!(
        (ran.code, &remedies["would_do"]),
        (3, &serde_json::json!([])),
        "{remedies}"
    );
    assert!(
        remedies["not_tried"]
            .as_array()
            .unwrap()
            .contains(&"tool.sponge_height_m".into()),
        "{remedies}"
    );
    assert!(
        ran.json()["reason"]
            .as_str()
            .unwrap()
            .contains("not tried to the end, for lack of time: ")
    );
}
