//! Scenarios and layouts: what is refused, and how.

use super::*;

#[test]
fn a_job_that_does_not_wash_fails_where_washing_is_required() {
    let folder = folder();
    let file = scenario(folder.path(), "on_failure = \"report\"", "on_failure = \"fail\"");
    let ran = platewash(folder.path(), &["run", "--scenario", file.to_str().unwrap()]);
    assert_eq!(ran.code, 3, "seed 1 has waypoints out of reach");
    assert!(ran.stdout.starts_with("NOT SWEPT"));
    // One plate within reach and free of contact, but the paper's law covers too little of it: verification fails.
    let text = std::fs::read_to_string(&file)
        .unwrap()
        .replace("region = \"appendix\"", "positions_m = [[0.36, 0.0]]");
    std::fs::write(
        &file,
        text.replace("start_deg = [0, 0, 0, 0, 0, 0]", "start_deg = [0, 30, 10, 0, 50, 0]"),
    )
    .unwrap();
    let ran = platewash(folder.path(), &["run", "--scenario", file.to_str().unwrap()]);
    assert_eq!(ran.code, 4, "{}", ran.stdout);
}

#[test]
fn bad_scenarios_are_refused_with_line_key_expected_and_found() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["run", "--scenario", "nowhere.toml"]).refused(2, &["nowhere.toml", "paper-text"]);
    platewash(dir, &["run", "--scenario", "."]).refused(2, &["."]);
    let cases: &[(&str, &str, &[&str])] = &[
        ("seed = 1", "seed = ", &["line 5", "TOML"]),
        ("seed = 1", "seed = 1\nseed = 2", &["line 6", "TOML"]),
        (
            "seed = 1",
            "seed = -1",
            &["seed", "from 0 to 9007199254740991", "found -1"],
        ),
        (
            "name = \"paper-appendix\"",
            "name = \"a\\u001b[31m\"",
            &["name", "without control or direction characters", "a\\u{1b}[31m"],
        ),
        (
            "points = 55",
            "points = 100_000",
            &["wash.points", "400200 waypoints", "at most 200000"],
        ),
        (
            "samples = 50",
            "samples = 100_000",
            &["transition.samples", "at most 200000"],
        ),
        (
            "points = 55",
            "pionts = 55",
            &["unknown key 'wash.pionts'", "wash.points", "line"],
        ),
        ("seed = 1", "colour = 1", &["unknown key 'colour'"]),
        ("[control]", "[kontrol]", &["unknown key 'kontrol'"]),
        ("kp = 20", "kp = nan", &["control.kp", "nan", "from 0"]),
        ("kp = 20", "kp = inf", &["control.kp", "inf"]),
        ("kp = 20", "kp = -1", &["control.kp", "-1"]),
        ("kp = 20", "kp = \"20\"", &["control.kp", "\"20\""]),
        ("dt_s = 0.01", "dt_s = 0", &["control.dt_s", "from 0.000001 to 10"]),
        (
            "plate_radius_m = 0.145",
            "plate_radius_m = -0.145",
            &["layout.plate_radius_m", "-0.145", "above 0"],
        ),
        (
            "plate_radius_m = 0.145",
            "plate_radius_m = 0",
            &["layout.plate_radius_m", "found 0"],
        ),
        (
            "path_radius_m = 0.145",
            "path_radius_m = 1e300",
            &["wash.path_radius_m", "1e300"],
        ),
        ("count = 4", "count = 0", &["layout.count", "from 1 to 1000", "found 0"]),
        ("count = 4", "count = 4.5", &["layout.count", "4.5"]),
        ("count = 4", "count = 99999999999999999999", &["line"]),
        ("points = 55", "points = 1", &["wash.points", "from 2"]),
        (
            "region = \"appendix\"",
            "region = \"kitchen\"",
            &["layout.region", "\"text\" or \"appendix\"", "kitchen"],
        ),
        (
            "region = \"appendix\"",
            "x_m = [0.3, 0.0]\ny_m = [-0.3, 0.3]",
            &["layout.x_m", "least < greatest", "[0.3, 0.0]"],
        ),
        (
            "region = \"appendix\"",
            "x_m = [0.0, nan]\ny_m = [-0.3, 0.3]",
            &["layout.x_m", "nan"],
        ),
        ("region = \"appendix\"", "x_m = [0.0, 0.3]", &["region"]),
        ("region = \"appendix\"", "", &["region"]),
        (
            "region = \"appendix\"",
            "region = \"text\"\nx_m = [0.0, 0.3]",
            &["layout.region"],
        ),
        (
            "region = \"appendix\"",
            "positions_m = []",
            &["layout.positions_m", "1 to 1000"],
        ),
        (
            "region = \"appendix\"",
            "positions_m = [[0.3, nan]]",
            &["layout.positions_m", "nan"],
        ),
        (
            "start_deg = [0, 0, 0, 0, 0, 0]",
            "start_deg = [0, 0, 0, 0, 0]",
            &["robot.start_deg", "six"],
        ),
        (
            "start_deg = [0, 0, 0, 0, 0, 0]",
            "start_deg = [0, 0, 90, 0, 0, 0]",
            &["joint 3", "90", "70"],
        ),
        ("length_m = 0 ", "length_m = 0.02 ", &["tool.sponge_height_m", "0.02"]),
        ("model = \"irb120\"", "urdf = \"nowhere.urdf\"", &["nowhere.urdf"]),
        ("model = \"irb120\"", "package_path = [\"a\"]", &["robot.urdf"]),
    ];
    for (from, to, fragments) in cases {
        let file = scenario(dir, from, to);
        let name = file.to_str().unwrap();
        for verb in ["validate", "run"] {
            let mut all = vec!["case.toml"];
            all.extend(fragments.iter().filter(|f| !f.is_empty()));
            let ran = platewash(dir, &[verb, "--scenario", name]);
            // Faults of the arm or the layout are named by their own file or key.
            let fragments: &[&str] = if ran.stderr.contains("case.toml") {
                &all
            } else {
                fragments
            };
            ran.refused(2, fragments);
        }
        assert_eq!(names(dir), ["case.toml"], "nothing is written for {to}");
    }
}

#[test]
fn impossible_layouts_end_soon_with_a_bound() {
    let folder = folder();
    let dir = folder.path();
    let case = |from: &str, to: &str, verdict: &str, fragments: &[&str]| {
        let file = scenario(dir, from, to);
        let run = ["run", "--scenario", file.to_str().unwrap()];
        // Its scenario asks for a report; one that asks for failure gets it.
        let ran = platewash(dir, &run).done();
        assert!(ran.stdout.starts_with(&format!("{verdict}: ")), "{}", ran.stdout);
        for fragment in fragments {
            assert!(ran.stdout.contains(fragment), "no {fragment} in {}", ran.stdout);
        }
        let text = std::fs::read_to_string(&file).unwrap();
        std::fs::write(&file, text.replace("on_failure = \"report\"", "on_failure = \"fail\"")).unwrap();
        let failed = platewash(dir, &run);
        assert_eq!((failed.code, &failed.stdout), (3, &ran.stdout));
    };
    case(
        "count = 4",
        "count = 1000",
        "INFEASIBLE",
        &[
            "1000 plates cannot fit",
            "best of 100 random layouts held 5",
            "more than 8",
        ],
    );
    case(
        "count = 4",
        "count = 7",
        "NOT FOUND",
        &[
            "no layout of 7 plates",
            "best of 1001 random layouts held 5",
            "more than 8",
            "another seed",
            "layout.min_distance_m",
            "layout.positions_m",
        ],
    );
    case(
        "region = \"appendix\"",
        "rho_m = [0.3, 0.3000000001]",
        "NOT FOUND",
        &["rho_m", "too thin"],
    );
    case(
        "region = \"appendix\"",
        "x_m = [0.0, 0.1]\ny_m = [-0.1, 0.1]",
        "INFEASIBLE",
        &["base_radius_m"],
    );
    assert_eq!(names(dir), ["case.toml", "out"]);
    assert_eq!(names(&dir.join("out")), ["report.json", "report.txt"]);
}

/// First block of a page in a language that contains some text.
fn block(page: &str, language: &str, containing: &str) -> String {
    let root = env!("CARGO_MANIFEST_DIR");
    let text = std::fs::read_to_string(format!("{root}/docs/{page}")).unwrap();
    let fence = format!("```{language}\n");
    let blocks = text
        .split(fence.as_str())
        .skip(1)
        .filter_map(|rest| rest.split("```").next());
    blocks
        .into_iter()
        .find(|block| block.contains(containing))
        .unwrap()
        .to_owned()
}

/// First line of an answer up to its plates and time, such as "PROVED: 2 plates in 12.98 s".
fn verdict(stdout: &str) -> &str {
    stdout.lines().next().unwrap().split(',').next().unwrap()
}

/// The cells of the tutorials can be typed in, and come to what the pages show.
#[test]
fn the_cells_of_the_tutorials_are_planned_and_proved() {
    let folder = folder();
    let dir = folder.path();
    let cell = block("tutorial-engineer.md", "toml", "[layout]");
    std::fs::write(dir.join("mycell.toml"), &cell).unwrap();
    let run = ["run", "--scenario", "mycell.toml", "--search-time", "0"];
    let ran = platewash(dir, &run);
    assert_eq!(ran.code, 3, "{}", ran.stdout);
    let told = "INFEASIBLE: plate 2 at (0.600, 0.200) m cannot be washed: at least 33.1 %";
    assert!(ran.stdout.starts_with(told), "{}", ran.stdout);
    let nearer = cell.replace("[0.60, 0.20]", "[0.30, 0.20]");
    assert_ne!(nearer, cell);
    std::fs::write(dir.join("mycell.toml"), nearer).unwrap();
    let proved = platewash(dir, &run).done().stdout;
    let shown = block("tutorial-engineer.md", "console", "PROVED: 2 plates");
    assert!(shown.contains(verdict(&proved)), "{proved}");

    let arm = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/crates/kinematics/tests/fixtures/ur5_lengths.urdf"
    );
    std::fs::copy(arm, dir.join("arm.urdf")).unwrap();
    let suggested = platewash(dir, &["robot", "--suggest", "--urdf", "arm.urdf"])
        .done()
        .stdout;
    let wash = block("tutorial-rust.md", "toml", "[layout]");
    let home = wash.lines().find(|line| line.starts_with("start_deg")).unwrap();
    assert!(suggested.contains(home), "{suggested}");
    std::fs::write(dir.join("wash.toml"), &wash).unwrap();
    let proved = platewash(dir, &["run", "--scenario", "wash.toml"]).done().stdout;
    let shown = block("tutorial-rust.md", "text", "PROVED");
    assert!(shown.contains(verdict(&proved)), "{proved}");
}
