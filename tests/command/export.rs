//! `platewash export` and `verify --program`.

use super::other_arms::{UR5, UR5_START, cell};
use super::verify::OVERLAPPING;
use super::*;
use std::fs;

/// A line of a module that moves the arm, in the middle of it: its number and its text.
fn a_move(text: &str) -> (usize, String) {
    let moves: Vec<_> = text
        .lines()
        .enumerate()
        .filter(|(_, line)| line.contains("\\T:=") && line.contains("z5"))
        .collect();
    let (i, line) = moves[moves.len() / 2];
    (i + 1, line.to_owned())
}

fn module(dir: &Path) -> PathBuf {
    let mut all: Vec<_> = fs::read_dir(dir).unwrap().map(|entry| entry.unwrap().path()).collect();
    all.sort();
    all.into_iter()
        .find(|path| path.extension().is_some_and(|e| e == "mod"))
        .unwrap()
}

fn refused(output: &CommandOutput, code: &str, exit: i32) -> Value {
    assert_eq!(output.code, exit, "{} {}", output.stdout, output.stderr);
    assert!(
        output.stderr.contains(&format!("refused ({code}): ")),
        "{}",
        output.stderr
    );
    let answer = output.json();
    assert_eq!(answer["refused"], code);
    answer
}

#[test]
fn a_program_is_written_and_found_unchanged_and_an_edited_line_is_named() {
    let folder = planned();
    let dir = folder.path();
    let ran = platewash(dir, &["export", "out/plan.json", "--to", "rapid", "--json"]).done();
    let answer = ran.json();
    assert_eq!(answer["target"], "rapid");
    assert!(answer["points"].as_u64().unwrap() > 150);
    assert!(
        answer["checks"]
            .as_array()
            .unwrap()
            .iter()
            .all(|check| check["status"] == "proved")
    );
    let path = module(&dir.join("out/rapid"));
    let text = fs::read_to_string(&path).unwrap();
    let plan: Value = serde_json::from_str(&fs::read_to_string(dir.join("out/plan.json")).unwrap()).unwrap();
    let planned_s = plan["knots"]["t_s"].as_array().unwrap().last().unwrap();
    assert!((answer["duration_s"].as_f64().unwrap() - planned_s.as_f64().unwrap()).abs() < 2e-3);
    assert!(text.contains(plan["hash"].as_str().unwrap()));

    let verify = |expected: i32| {
        let ran = platewash(
            dir,
            &["verify", "out/plan.json", "--program", path.to_str().unwrap(), "--json"],
        );
        assert_eq!(ran.code, expected, "{}", ran.stderr);
        ran.json()
    };
    let answer = verify(0);
    assert_eq!((&answer["unchanged"], &answer["holds"]), (&true.into(), &true.into()));

    // One digit of a target: a tenth of a degree.
    let (line, before) = a_move(&text);
    let target = before.split("[[").nth(1).unwrap().split(',').next().unwrap().to_owned();
    let moved = format!("{:.4}", target.parse::<f64>().unwrap() + 0.1);
    fs::write(&path, text.replacen(&before, &before.replacen(&target, &moved, 1), 1)).unwrap();
    let answer = verify(4);
    let name = path.file_name().unwrap().to_str().unwrap();
    assert_eq!(answer["changes"][0]["place"], format!("{name}:{line}"));
    assert_eq!(answer["changes"][0]["what"], "joint 1");

    // One digit of a time: a microsecond, which holds and is named all the same.
    let time = before
        .split("\\T:=")
        .nth(1)
        .unwrap()
        .split(['/', ','])
        .next()
        .unwrap()
        .to_owned();
    let later = format!("{:.6}", time.parse::<f64>().unwrap() + 1e-6);
    fs::write(&path, text.replacen(&before, &before.replacen(&time, &later, 1), 1)).unwrap();
    let answer = verify(0);
    assert_eq!(answer["changes"][0]["place"], format!("{name}:{line}"));
    assert_eq!(answer["changes"][0]["what"], "time");
    let said = platewash(dir, &["verify", "out/plan.json", "--program", path.to_str().unwrap()])
        .done()
        .stdout;
    assert!(
        said.starts_with("HOLDS: rapid program, tip within 0.2 mm of the plan; CHANGED in 1 place"),
        "{said}"
    );
}

/// `play.py` sends the JSON, whichever file was verified.
#[test]
fn verify_also_reads_a_file_beside_the_program() {
    let folder = planned();
    let dir = folder.path();
    platewash(
        dir,
        &["export", "out/plan.json", "--to", "ros2", "--out", "robot", "--quiet"],
    )
    .done();
    let robot = dir.join("robot");
    let sent = robot.join("follow_joint_trajectory.json");
    let verified = robot.join("follow_joint_trajectory.yaml");
    let verify = || {
        platewash(
            dir,
            &["verify", "out/plan.json", "--program", verified.to_str().unwrap()],
        )
    };
    let said = verify().done().stdout;
    assert!(said.starts_with("HOLDS: ros2 program, "), "{said}");
    for name in names(&robot) {
        assert!(said.lines().nth(1).unwrap().contains(&name), "{name}: {said}");
    }
    let mut goal: Value = serde_json::from_str(&fs::read_to_string(&sent).unwrap()).unwrap();
    let moved = &mut goal["trajectory"]["points"][40]["positions"][1];
    *moved = (moved.as_f64().unwrap() + 0.5).into();
    fs::write(&sent, goal.to_string()).unwrap();
    verify().refused(2, &["follow_joint_trajectory.json", "expected point 40"]);
    // A message alone does not compare the start; the player does.
    for name in names(&robot) {
        if name != "follow_joint_trajectory.yaml" {
            fs::remove_file(robot.join(name)).unwrap();
        }
    }
    let said = verify().done().stdout;
    assert!(said.starts_with("HOLDS, START NOT CHECKED: ros2 program, "), "{said}");
}

#[test]
fn reports_a_program_without_its_start_check() {
    let folder = planned();
    let dir = folder.path();
    platewash(dir, &["export", "out/plan.json", "--to", "rapid", "--quiet"]).done();
    let path = module(&dir.join("out/rapid"));
    let text = fs::read_to_string(&path).unwrap();
    let verify = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        fs::write(&path, text.replacen(from, to, 1)).unwrap();
        platewash(dir, &["verify", "out/plan.json", "--program", path.to_str().unwrap()])
    };
    assert!(verify("", "").done().stdout.starts_with("HOLDS: rapid program, "));
    let said = verify("    pwCheckStart;\n", "").done().stdout;
    assert!(said.starts_with("HOLDS, START NOT CHECKED: rapid program, "), "{said}");
    assert!(said.contains("the start is not checked"), "{said}");
    let as_exported = "is read only as it is exported";
    for (from, to, words) in [
        (
            "found-expected)<=0.5 RETURN;",
            "found-expected)<=500 RETURN;",
            as_exported,
        ),
        ("pwCheckJoint 2,now.robax.rax_2,pwStart.robax.rax_2;", "", as_exported),
        (
            "PROC pwCheckStart()",
            "LOCAL PROC pwCheckStart()\nENDPROC\nPROC pwCheckStart()",
            "LOCAL",
        ),
    ] {
        verify(from, to).refused(2, &["kitchen.mod:", words]);
    }
}

#[test]
fn each_refusal_has_its_code() {
    let folder = planned();
    let dir = folder.path();
    let export = |more: &[&str]| {
        let mut arguments = vec!["export", "out/plan.json", "--to", "rapid", "--json"];
        arguments.extend(more);
        platewash(dir, &arguments)
    };
    refused(&export(&["--stands", "0,0,0,0,90.6,0"]), "start", 2);
    refused(&export(&["--tip", "0,0,151,1,0,0,0"]), "frame", 2);
    refused(&export(&["--tolerance", "-1"]), "setting", 2);
    refused(&export(&["--speed-share", "1.5"]), "setting", 2);
    refused(&export(&["--tolerance", "2e-5"]), "segment_time", 4);
    refused(
        &platewash(dir, &["export", "out/plan.json", "--to", "urscript", "--json"]),
        "arm",
        2,
    );
    assert_eq!(names(&dir.join("out")), ["plan.json", "trajectory.csv"]);
    export(&["--tip", "0,0,150,1,0,0,0", "--stands", "0,0,0,0,90.4,0"]).done();

    // Changed after it was sealed.
    let text = fs::read_to_string(dir.join("out/plan.json")).unwrap();
    fs::write(
        dir.join("edited.json"),
        text.replacen("\"coverage\":0.995", "\"coverage\":0.9", 1),
    )
    .unwrap();
    let ran = platewash(dir, &["export", "edited.json", "--to", "rapid", "--json"]);
    let answer = refused(&ran, "uncertified", 4);
    assert!(answer["message"].as_str().unwrap().contains("NOT PROVED"));

    // A tool that weighs nothing.
    let light = ("radius_m = 0.02\n", "radius_m = 0.02\nmass_kg = 0\n");
    let weightless = kitchen(dir, &[light, ("count = 4", "count = 1")]);
    platewash(
        dir,
        &[
            "plan",
            "--scenario",
            weightless.to_str().unwrap(),
            "--out",
            "light",
            "--quiet",
        ],
    )
    .done();
    let ran = platewash(dir, &["export", "light/plan.json", "--to", "rapid", "--json"]);
    assert!(
        refused(&ran, "load", 2)["message"]
            .as_str()
            .unwrap()
            .contains("mass_kg")
    );
}

#[test]
fn the_papers_program_is_not_handed_over() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["plan", "--scenario", "paper-appendix", "--quiet"]).done();
    refused(
        &platewash(dir, &["export", "out/plan.json", "--to", "csv", "--json"]),
        "uncertified",
        4,
    );
}

#[test]
fn accepts_waived_requirements_by_name_only() {
    let folder = folder();
    let dir = folder.path();
    fs::write(dir.join("case.toml"), OVERLAPPING).unwrap();
    platewash(dir, &["plan", "--scenario", "case.toml", "--quiet"]).done();
    let export = |more: &[&str]| {
        let mut arguments = vec!["export", "out/plan.json", "--to", "rapid", "--json"];
        arguments.extend(more);
        platewash(dir, &arguments)
    };
    let answer = refused(&export(&["--accept", "plates apart"]), "waived", 4);
    assert!(answer["message"].as_str().unwrap().contains("every plate once"));
    export(&["--accept", "plates apart", "--accept", "every plate once"]).done();
    let path = module(&dir.join("out/rapid"));
    assert!(fs::read_to_string(&path).unwrap().contains("BUT FOR"));
    let said = platewash(dir, &["verify", "out/plan.json", "--program", path.to_str().unwrap()])
        .done()
        .stdout;
    assert!(said.starts_with("HOLDS BUT FOR every plate once"), "{said}");
}

/// A washing by another make of arm, in its own language and in those that take any.
#[test]
fn another_arm_has_its_own_programs() {
    let folder = folder();
    let dir = folder.path();
    let file = cell(dir, UR5_START, "[[0.55, 0.0]]", 0.2);
    other_arms::run(dir, "plan", &file, UR5).done();
    for (target, share) in [("urscript", "0.5"), ("ros2", "0.5"), ("csv", "0.35")] {
        let asked = [
            "export",
            "o/plan.json",
            "--urdf",
            UR5,
            "--to",
            target,
            "--speed-share",
            share,
            "--json",
        ];
        let answer = platewash(dir, &asked).done().json();
        let files: Vec<_> = answer["files"]
            .as_array()
            .unwrap()
            .iter()
            .map(|file| file.as_str().unwrap())
            .collect();
        let mut asked = vec!["verify", "o/plan.json", "--urdf", UR5, "--json", "--program"];
        asked.extend(&files);
        let found = platewash(dir, &asked).done().json();
        assert_eq!(
            (&found["holds"], &found["unchanged"]),
            (&true.into(), &true.into()),
            "{found}"
        );
        // Each message, and the table without what explains it, tells the share of the speed by itself.
        for file in files
            .iter()
            .filter(|file| !file.ends_with(".py") && !file.ends_with(".txt"))
        {
            let found = platewash(
                dir,
                &["verify", "o/plan.json", "--urdf", UR5, "--json", "--program", file],
            )
            .done()
            .json();
            assert_eq!(
                (&found["holds"], &found["unchanged"]),
                (&true.into(), &true.into()),
                "{file}: {found}"
            );
        }
    }
    let asked = ["export", "o/plan.json", "--urdf", UR5, "--to", "rapid", "--json"];
    refused(&platewash(dir, &asked), "arm", 2);
    platewash(dir, &["export", "o/plan.json", "--to", "urscript"]).refused(2, &["--urdf"]);
}

/// The controller counts axis 3 with axis 2, which is asked for, stated and read back, also after a stop.
#[test]
fn an_arm_with_a_parallel_linkage_has_programs_in_the_makers_joints() {
    let folder = folder();
    let dir = folder.path();
    fs::write(dir.join("arm.urdf"), linkage::urdf("abb_irb2400")).unwrap();
    let call =
        |words: &[&str], more: &[&str]| platewash(dir, &[words, &["--urdf", "arm.urdf", "--json"], more].concat());
    let plan = "out/plan.json";
    call(&["plan"], &[]).done();
    let answer = refused(&call(&["export", plan, "--to", "rapid"], &[]), "arm", 2);
    let words = answer["message"].as_str().unwrap();
    for part in [
        "rax_3 = joint_3 + joint_2",
        "ros-industrial/abb",
        "--joint-3",
        "independent",
    ] {
        assert!(words.contains(part), "{part}: {words}");
    }
    let coupled = ["--joint-3", "with-joint-2"];
    refused(&call(&["export", plan, "--to", "csv"], &coupled), "setting", 2);
    call(&["export", plan, "--to", "rapid", "--joint-3", "both"], &[]).refused(2, &["with-joint-2, independent"]);

    // The pendant shows 36° for both axes, where joint 3 is at 0°.
    let stands = ["--stands", "-8,36,36,0,54,0"];
    call(&["export", plan, "--to", "rapid"], &[&coupled[..], &stands].concat()).done();
    let path = module(&dir.join("out/rapid"));
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains("pwStart:=[[-8.0000,36.0000,36.0000,0.0000,54.0000,0.0000],"));
    let verify = |text: &str| {
        fs::write(&path, text).unwrap();
        call(&["verify", plan, "--program", path.to_str().unwrap()], &[])
    };
    let found = verify(&text).done().json();
    assert_eq!(
        (&found["holds"], &found["unchanged"]),
        (&true.into(), &true.into()),
        "{found}"
    );
    let (line, moved) = a_move(&text);
    let rax_3 = moved.split(',').nth(2).unwrap();
    let other = moved.replacen(rax_3, &format!("{:.4}", rax_3.parse::<f64>().unwrap() + 0.1), 1);
    let ran = verify(&text.replacen(&moved, &other, 1));
    assert_eq!(ran.code, 4, "{}", ran.stderr);
    assert_eq!(ran.json()["changes"][0]["what"], "joint 3", "line {line}");
    verify(&text.replacen("platewash setting: joint_3 = with-joint-2", "", 1))
        .refused(2, &["platewash setting: joint_3", "found none"]);

    // A stop where joint 3 is at 20° and joint 2 at 10°.
    let at = ["--at-deg", "-8", "10", "30", "0", "54", "0"];
    call(&["recover", plan], &[&coupled[..], &at].concat()).done();
    call(
        &["export", "out/recovery/home.json", "--to", "rapid", "--out", "home"],
        &coupled,
    )
    .done();
    let home = fs::read_to_string(module(&dir.join("home"))).unwrap();
    assert!(home.contains("pwStart:=[[-8.0000,10.0000,30.0000,0.0000,54.0000,0.0000],"));
}

#[test]
fn programs_of_two_plans_do_not_stand_side_by_side() {
    let folder = planned();
    let dir = folder.path();
    fs::create_dir_all(dir.join("out/rapid")).unwrap();
    fs::write(dir.join("out/rapid/older.mod"), "MODULE older\nENDMODULE\n").unwrap();
    platewash(dir, &["export", "out/plan.json", "--to", "rapid"]).refused(2, &["older.mod", "remove it"]);
    assert_eq!(names(&dir.join("out/rapid")), ["older.mod"]);
}

#[test]
fn bad_usage_states_the_expected_values() {
    let folder = planned();
    let dir = folder.path();
    let ran = platewash(dir, &["export", "out/plan.json", "--to", "karel"]);
    assert_eq!(ran.code, 2);
    assert!(
        ran.stderr.contains("expected one of") && ran.stderr.contains("rapid"),
        "{}",
        ran.stderr
    );
    for (option, value, words) in [
        ("--stands", "1,2,3", "6 numbers"),
        ("--stands", "0,0,0,0,nan,0", "finite"),
        ("--tip", "0,0,150,2,0,0,0", "length 1"),
        ("--accept", "everything", "no requirement"),
    ] {
        let ran = platewash(dir, &["export", "out/plan.json", "--to", "rapid", option, value]);
        assert_eq!(ran.code, 2, "{option} {value}");
        assert!(ran.stderr.contains(words), "{}", ran.stderr);
    }
    platewash(dir, &["verify", "out/plan.json", "--program", "none.mod"]).refused(2, &["none.mod", "cannot be read"]);
    fs::write(dir.join("notes.txt"), "nothing").unwrap();
    platewash(dir, &["verify", "out/plan.json", "--program", "notes.txt"]).refused(2, &["notes.txt", "no program of"]);
}

/// A table without its column of the plan's time runs at the share that its rows tell, whatever that of its last row, which comes after the
/// plan has ended.
#[test]
fn a_table_without_the_plans_time_is_read_and_holds() {
    let folder = folder();
    let dir = folder.path();
    let single = kitchen(dir, &[("count = 4", "count = 1")]);
    platewash(dir, &["plan", "--quiet", "--scenario", single.to_str().unwrap()]).done();
    for options in [&[][..], &["--speed-share", "0.37"]] {
        platewash(
            dir,
            &[&["export", "out/plan.json", "--to", "csv", "--quiet"], options].concat(),
        )
        .done();
        let text = fs::read_to_string(dir.join("out/csv/kitchen.csv")).unwrap();
        let with = |cell: &dyn Fn(usize, usize, &str) -> Option<String>| {
            let lines = text.lines().enumerate().map(|(line, cells)| {
                let kept = cells.split(',').enumerate().filter_map(|(k, text)| cell(line, k, text));
                kept.collect::<Vec<_>>().join(",") + "\n"
            });
            fs::write(dir.join("kitchen.csv"), lines.collect::<String>()).unwrap();
            platewash(dir, &["verify", "out/plan.json", "--program", "kitchen.csv"])
        };
        for last in [14, 8] {
            let ran = with(&|_, k, text| (k != 1 && k < last).then(|| text.to_owned()));
            assert!(
                ran.code == 0 && ran.stdout.starts_with("HOLDS"),
                "{options:?}: {} {}",
                ran.stdout,
                ran.stderr
            );
        }
        let ran = with(&|line, k, text| {
            let is_moved = line > 0 && k == 3;
            (k != 1).then(|| {
                if is_moved {
                    (text.parse::<f64>().unwrap() + 0.01).to_string()
                } else {
                    text.to_owned()
                }
            })
        });
        assert!(
            ran.code == 4 && ran.stdout.starts_with("DOES NOT HOLD"),
            "{} {}",
            ran.stdout,
            ran.stderr
        );
    }
}

/// Settings that change how the controller moves are not judged: a program with others than the exported ones does not hold.
#[test]
fn a_script_with_other_settings_of_the_motion_does_not_hold() {
    let folder = folder();
    let dir = folder.path();
    let file = cell(dir, UR5_START, "[[0.55, 0.0]]", 0.2);
    other_arms::run(dir, "plan", &file, UR5).done();
    let plan = ["o/plan.json", "--urdf", UR5];
    platewash(
        dir,
        &[
            &["export"],
            &plan[..],
            &["--to", "urscript", "--speed-share", "0.5", "--out", "robot"],
        ]
        .concat(),
    )
    .done();
    let script = fs::read_dir(dir.join("robot")).unwrap().next().unwrap().unwrap().path();
    let text = fs::read_to_string(&script).unwrap();
    let verify = |from: &str, to: &str| {
        assert!(from.is_empty() || text.contains(from), "{from}");
        fs::write(&script, text.replacen(from, to, 1)).unwrap();
        let program = script.to_str().unwrap();
        platewash(dir, &[&["verify"], &plan[..], &["--program", program]].concat())
    };
    let said = verify("", "").done().stdout;
    assert!(said.starts_with("HOLDS: urscript program"), "{said}");
    let first = said.lines().next().unwrap();
    assert!(
        first.ends_with("; not judged: how late the arm follows, and stops"),
        "{said}"
    );
    for (from, to, words) in [
        (
            "global lookahead = 0.03",
            "global lookahead = 0.2",
            "lookahead_time 0.2 (0.03 handed over)",
        ),
        ("global gain = 2000", "global gain = 500", "gain 500 (2000 handed over)"),
        // One motion alone, and one that leaves the setting to the controller.
        (
            "lookahead_time=lookahead",
            "lookahead_time=0.05",
            "lookahead_time 0.05 (0.03 handed over)",
        ),
        (", gain=gain", "", "gain 300 (2000 handed over)"),
        (
            "movej(start, a=0.1, v=0.05)",
            "movej(start, a=0.1, v=1)",
            "v of movej 1 (0.05 handed over)",
        ),
        (
            "movej(start, a=0.1, v=0.05)",
            "movej(start, v=0.05)",
            "a of movej 1.4 (0.1 handed over)",
        ),
        ("stopj(2.0)", "stopj(0.1)", "a of stopj 0.1 (2 handed over)"),
    ] {
        let ran = verify(from, to);
        assert_eq!(ran.code, 4, "{to}: {}", ran.stdout);
        let first = ran.stdout.lines().next().unwrap();
        assert!(
            first.starts_with("DOES NOT HOLD: ") && first.contains(words),
            "{to}: {first}"
        );
        assert!(ran.stdout.contains("NOT KEPT"), "{to}: {}", ran.stdout);
    }
    // The end, and names of the controller.
    let last = text.lines().rfind(|line| line.contains("movej([")).unwrap();
    let ran = verify(&format!("{last}\n"), "");
    assert!(
        ran.code == 4 && ran.stdout.contains("; end nothing (movej behind stopj handed over)"),
        "{}",
        ran.stdout
    );
    let wash = text.lines().filter(|line| line.contains("servoj(")).nth(400).unwrap();
    let target = wash.split_once("servoj(").unwrap().1.split_once(']').unwrap().0;
    for (from, to, words) in [
        (
            wash,
            format!("{wash}\n    movej({target}], a=0.1, v=0.05)"),
            "movej while the arm moves",
        ),
        (
            "  movej(start",
            "  set_payload(3.0, [0.0, 0.0, 0.05])\n  movej(start".to_owned(),
            "payload",
        ),
        (
            "  start =",
            "  def norm():\n  end\n  start =".to_owned(),
            "`norm` is the controller's own",
        ),
        (
            "  start =",
            "  get_actual_joint_positions = [0, 0, 0, 0, 0, 0]\n  start =".to_owned(),
            "is the controller's own",
        ),
    ] {
        verify(from, &to).refused(2, &[words]);
    }
    // The share that nothing uses.
    let said = verify("  global speed_share = 0.5\n", "").done().stdout;
    assert!(said.starts_with("HOLDS: urscript program"), "{said}");
    let without_tip: String = text
        .lines()
        .filter(|line| !line.contains("set_tcp("))
        .map(|line| format!("{line}\n"))
        .collect();
    let ran = verify(&text, &without_tip);
    assert!(
        ran.code == 4
            && ran
                .stdout
                .lines()
                .next()
                .unwrap()
                .contains("; tool or load not the plan's"),
        "{}",
        ran.stdout
    );
    // Messages, outputs and comments change nothing.
    let said = verify(
        "  stopj(2.0)",
        "  textmsg(\"end\")\n  set_digital_out(1, True)\n  # here\n  stopj(2.0)",
    )
    .done()
    .stdout;
    assert!(said.starts_with("HOLDS: urscript program"), "{said}");
}

/// The order of a table's columns and the names of files change nothing; what does is named alone.
#[test]
fn columns_in_another_order_and_renamed_files_are_no_change() {
    let folder = planned();
    let dir = folder.path();
    platewash(dir, &["export", "out/plan.json", "--to", "csv", "--out", "table"]).done();
    platewash(
        dir,
        &["export", "out/plan.json", "--to", "ros2", "--out", "goals", "--quiet"],
    )
    .done();
    let table = fs::read_dir(dir.join("table"))
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let table = table
        .into_iter()
        .find(|path| path.extension().unwrap() == "csv")
        .unwrap();
    let text = fs::read_to_string(table).unwrap();
    let ordered = |text: &str, places: &dyn Fn(usize) -> Vec<usize>| {
        let row = |line: &str| {
            let cells: Vec<_> = line.split(',').collect();
            let moved: Vec<_> = places(cells.len()).iter().map(|place| cells[*place]).collect();
            moved.join(",")
        };
        text.lines().map(row).collect::<Vec<_>>().join("\n") + "\n"
    };
    let verify = |name: &str, text: &str| {
        fs::write(dir.join(name), text).unwrap();
        platewash(dir, &["verify", "out/plan.json", "--program", name])
            .done()
            .stdout
    };
    let third = |count: usize| [vec![2, 1, 0], (3..count).collect()].concat();
    for (name, text) in [
        ("copy.csv", text.clone()),
        ("third.csv", ordered(&text, &third)),
        ("reversed.csv", ordered(&text, &|count| (0..count).rev().collect())),
    ] {
        let said = verify(name, &text);
        let is_same = said.lines().next().unwrap().contains("; as it was handed over; ");
        assert!(said.starts_with("HOLDS") && is_same, "{name}: {said}");
    }
    let goal = fs::read_to_string(dir.join("goals/follow_joint_trajectory.yaml")).unwrap();
    let said = verify("goal.yaml", &goal);
    assert!(
        said.starts_with("HOLDS") && said.contains("; as it was handed over; "),
        "{said}"
    );
    // A change in a table with its columns elsewhere is one change.
    let line = text.lines().nth(200).unwrap();
    let mut cells: Vec<_> = line.split(',').map(str::to_owned).collect();
    cells[3] = format!("{:.9}", cells[3].parse::<f64>().unwrap() + 1e-7);
    let changed = text.replacen(line, &cells.join(","), 1);
    let said = verify("changed.csv", &ordered(&changed, &third));
    assert!(
        said.lines().next().unwrap().contains("; CHANGED in 1 place; "),
        "{said}"
    );
}

/// Settings of RAPID that change the motion: each changed once in an exported program.
#[test]
fn a_module_with_other_settings_of_the_motion_does_not_hold() {
    let folder = planned();
    let dir = folder.path();
    platewash(
        dir,
        &[
            "export",
            "out/plan.json",
            "--to",
            "rapid",
            "--speed-share",
            "0.5",
            "--quiet",
        ],
    )
    .done();
    let path = module(&dir.join("out/rapid"));
    let text = fs::read_to_string(&path).unwrap();
    let verify = |text: &str| {
        fs::write(&path, text).unwrap();
        platewash(dir, &["verify", "out/plan.json", "--program", path.to_str().unwrap()])
    };
    let edited = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1)
    };
    let (_, middle) = a_move(&text);
    let in_the_middle = |from: &str, to: &str| {
        assert!(middle.contains(from), "{from}");
        edited(&middle, &middle.replacen(from, to, 1))
    };
    let moves: Vec<_> = text.lines().filter(|line| line.contains("\\T:=")).collect();
    let stops: Vec<_> = moves.iter().filter(|line| line.contains(",fine,")).collect();
    let zones = moves.len() - stops.len();
    let passed = stops[1].replacen(",fine,", ",z5,", 1);
    for (text, words) in [
        (
            text.replace(",z5,", ",fine,"),
            format!("stops at further {zones} targets (4 in all handed over)"),
        ),
        (
            in_the_middle(",z5,", ",fine,"),
            "stops at further 1 target (4 in all handed over)".to_owned(),
        ),
        (
            edited(stops[1], &passed),
            "stops missing at 1 target (4 in all handed over)".to_owned(),
        ),
        (
            in_the_middle(",z5,", ",z1,"),
            "zone z1 (fine and z5 handed over)".to_owned(),
        ),
        (
            in_the_middle(",z5,", ",[FALSE,5,8,8,0.8,8,0.1],"),
            "zone [FALSE,5,8,8,0.8,8,0.1] (fine and z5 handed over)".to_owned(),
        ),
        (
            in_the_middle("v100", "v1000"),
            "speed data v1000 (v100 handed over)".to_owned(),
        ),
        (
            edited("pwStart\\NoEOffs,v20,", "pwStart\\NoEOffs,v1000,"),
            "speed data of the motion to the start v1000 (v20 handed over)".to_owned(),
        ),
        (
            edited("pwStart\\NoEOffs,v20,", "pwStart\\NoEOffs,v20\\T:=0.01,"),
            "\\T of the motion to the start 0.01 (nothing handed over)".to_owned(),
        ),
        (
            edited("CONST num pwShareMost:=0.5;", "CONST num pwShareMost:=1;"),
            "pwShareMost 1 (0.5 handed over)".to_owned(),
        ),
        (edited("[[0,0,150]", "[[0,0,160]"), "tool".to_owned()),
        (edited("],[0.3,[0,0,75]", "],[1.3,[0,0,75]"), "tool".to_owned()),
        (edited("0.0005925,", "0.05,"), "tool".to_owned()),
        (
            edited("[0.3,[0,0,75],[1,0,0,0]", "[0.3,[0,0,75],[0.7071068,0,0.7071068,0]"),
            "tool".to_owned(),
        ),
    ] {
        let ran = verify(&text);
        assert_eq!(ran.code, 4, "{words}: {}", ran.stdout);
        let first = ran.stdout.lines().next().unwrap();
        assert!(
            first.starts_with("DOES NOT HOLD: ") && first.contains(&format!("; {words}")),
            "{words}: {}",
            ran.stdout
        );
    }
    let (undivided, faster) = (
        text.replace("/pwRunning", ""),
        "; \\T divided by pwRunning no (yes handed over)",
    );
    let said = verify(&undivided).stdout;
    assert!(
        said.starts_with("DOES NOT HOLD") && said.lines().next().unwrap().contains(faster),
        "{said}"
    );
    // A joint speed that is kept at the stated share, and not at the greatest one that the program takes.
    let target = middle.split("[[").nth(1).unwrap().split(']').next().unwrap();
    let sixth = target.rsplit(',').next().unwrap();
    let turned = format!("{:.4}", sixth.parse::<f64>().unwrap() + 60.0);
    let fast = in_the_middle(&format!(",{sixth}]"), &format!(",{turned}]")).replacen(
        "PERS num pwShare:=0.5;",
        "PERS num pwShare:=0.01;",
        1,
    );
    let said = verify(&fast).stdout;
    assert!(said.contains("joint speed          NOT KEPT"), "{said}");
    for (text, words) in [
        (
            edited(&middle, &format!("    AccSet 50,100;\n{middle}")),
            "AccSet changes",
        ),
        (
            edited(&middle, &format!("    VelSet 50,5000;\n{middle}")),
            "VelSet changes",
        ),
        (in_the_middle("wobj0", "wobj1"), "work object"),
        (
            in_the_middle(",pwTool", ",tool0"),
            "expected the tool of the motions before",
        ),
        (in_the_middle("pwTool", "pwTool\\TLoad:=load0"), "TLoad"),
    ] {
        verify(&text).refused(2, &["kitchen.mod:", words]);
    }
    // A longer time is judged as a motion.
    let time = middle.split("\\T:=").nth(1).unwrap().split('/').next().unwrap();
    let said = verify(&in_the_middle(time, "0.4")).stdout;
    assert!(
        said.starts_with("DOES NOT HOLD") && said.contains(": time: 0.400000 s"),
        "{said}"
    );
    // The same stops, slower, with what changes nothing beside the motion.
    let slower = edited("PERS num pwShare:=0.5;", "PERS num pwShare:=0.2;").replacen(
        "CONST num pwShareMost:=0.5;",
        "CONST num pwShareMost:=0.3;",
        1,
    );
    let noted = slower.replacen(
        &middle,
        &format!("    SetDO doWater,1;\n    TPWrite \"half\"; ! here\n{middle}"),
        1,
    );
    let said = verify(&noted).done().stdout;
    assert!(said.starts_with("HOLDS: rapid program"), "{said}");
}

/// Controllers and editors write comments in ISO 8859-1.
#[test]
fn a_module_with_a_comment_in_iso_8859_1_is_read() {
    let folder = planned();
    let dir = folder.path();
    platewash(dir, &["export", "out/plan.json", "--to", "rapid", "--quiet"]).done();
    let path = module(&dir.join("out/rapid"));
    let text = fs::read(&path).unwrap();
    let verify = |path: &Path, head: &[u8]| {
        fs::write(path, [head, &text].concat()).unwrap();
        platewash(dir, &["verify", "out/plan.json", "--program", path.to_str().unwrap()])
    };
    for head in [&b"! D\xfcse gepr\xfcft\n"[..], b"! the user\x92s\n"] {
        let said = verify(&path, head).done().stdout;
        assert!(
            said.starts_with("HOLDS: rapid program") && said.contains("CHANGED in 1 place"),
            "{said}"
        );
    }
    verify(&path, b"! here\nD\xfcse\n").refused(2, &["kitchen.mod:2: unexpected character 'ü'"]);
    let other = dir.join("wash.yaml");
    fs::write(&other, b"time_from_start: 0\n# gepr\xfcft\n").unwrap();
    platewash(dir, &["verify", "out/plan.json", "--program", "wash.yaml"])
        .refused(2, &["wash.yaml:2: not UTF-8 text", "save it in UTF-8"]);
    platewash(dir, &["prove-motion", "wash.yaml"]).refused(2, &["wash.yaml", "line 2: not UTF-8 text"]);
}

/// Settings of ROS 2 that change the motion: each changed once in an exported goal.
#[test]
fn a_goal_with_other_settings_of_the_motion_does_not_hold() {
    let folder = planned();
    let dir = folder.path();
    platewash(
        dir,
        &["export", "out/plan.json", "--to", "ros2", "--out", "robot", "--quiet"],
    )
    .done();
    let path = dir.join("robot/follow_joint_trajectory.yaml");
    let text = fs::read_to_string(&path).unwrap();
    let verify = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        fs::write(&path, text.replacen(from, to, 1)).unwrap();
        platewash(dir, &["verify", "out/plan.json", "--program", path.to_str().unwrap()])
    };
    let path_line = text
        .lines()
        .find(|line| line.contains("name: joint_2") || line.contains("name: \"joint_2\""))
        .unwrap();
    let path_rad = path_line.split("position: ").nth(1).unwrap().trim_end_matches('}');
    let path_tolerance = |position: &str| path_line.replace(path_rad, position);
    let goal_line = text
        .lines()
        .filter(|line| line.contains("joint_2") && line.contains("position"))
        .nth(1)
        .unwrap();
    let late = "goal_time_tolerance: {sec: 1, nanosec: 0}";
    let of_path = "path_tolerance of joint_2, position";
    for (from, to, words) in [
        (
            path_line,
            path_tolerance("0.001"),
            format!("{of_path} 0.001 ({path_rad} handed over)"),
        ),
        (
            path_line,
            path_tolerance("0.0"),
            format!("{of_path} the controller's own ({path_rad} handed over)"),
        ),
        (
            path_line,
            path_line.replace(&format!(", position: {path_rad}"), ""),
            format!("{of_path} the controller's own"),
        ),
        (
            path_line,
            path_line.replace('}', ", velocity: 0.1}"),
            "path_tolerance of joint_2, velocity 0.1 (the controller's own handed over)".to_owned(),
        ),
        (
            path_line,
            path_line.replace('}', ", acceleration: 0.1}"),
            "path_tolerance of joint_2, acceleration 0.1 (the controller's own handed over)".to_owned(),
        ),
        (
            goal_line,
            goal_line.replace("0.01", "0.0001"),
            "goal_tolerance of joint_2, position 0.0001 (0.01 handed over)".to_owned(),
        ),
        (
            late,
            late.replace("sec: 1", "sec: 0"),
            "goal_time_tolerance the controller's own (1.0 handed over)".to_owned(),
        ),
        (
            late,
            "goal_time_tolerance: {sec: 0, nanosec: 5}".to_owned(),
            "goal_time_tolerance 5e-9".to_owned(),
        ),
    ] {
        let ran = verify(from, &to);
        assert_eq!(ran.code, 4, "{to}: {} {}", ran.stdout, ran.stderr);
        let first = ran.stdout.lines().next().unwrap();
        assert!(
            first.starts_with("DOES NOT HOLD: ") && first.contains(&format!("; {words}")),
            "{words}: {}",
            ran.stdout
        );
    }
    for (from, to, words) in [
        (late, "", "goal_time_tolerance; it is missing"),
        ("path_tolerance:", "path:", "found the key \"path\""),
        (
            "  joint_names:",
            "  header: {stamp: {sec: 1700000000, nanosec: 0}}\n  joint_names:",
            "stamp",
        ),
    ] {
        verify(from, to).refused(2, &["follow_joint_trajectory.yaml:", words]);
    }
    // What it was made for is no less than the share at which it runs.
    let lone = text.replacen(
        "# platewash setting: speed_share = 1",
        "# platewash setting: speed_share = 0.5",
        1,
    );
    fs::write(dir.join("lone.yaml"), lone).unwrap();
    platewash(dir, &["verify", "out/plan.json", "--program", "lone.yaml"])
        .refused(2, &["states the speed share 1", "speed_share = 0.5"]);
    // Wider ones, and none.
    for (from, to) in [
        (path_line, path_tolerance("0.9")),
        (path_line, path_tolerance("-1.0")),
        (path_line, path_line.replace('}', ", velocity: -1.0}")),
        (late, late.replace("sec: 1", "sec: 9")),
    ] {
        let said = verify(from, &to).done().stdout;
        assert!(said.starts_with("HOLDS: ros2 program"), "{to}: {said}");
    }
}

/// A file is known by its lines, whatever its name and its ending.
#[test]
fn renamed_files_of_a_program_are_no_change() {
    let folder = planned();
    let dir = folder.path();
    for target in ["ros2", "rapid"] {
        platewash(
            dir,
            &["export", "out/plan.json", "--to", target, "--out", target, "--quiet"],
        )
        .done();
    }
    for (file, name, start) in [
        (
            "ros2/joint_trajectory.yaml",
            "washing.yml",
            "HOLDS, START NOT CHECKED: ros2",
        ),
        (
            "ros2/joint_trajectory.json",
            "washing.json",
            "HOLDS, START NOT CHECKED: ros2",
        ),
        (
            "ros2/follow_joint_trajectory.yaml",
            "goal.yaml",
            "HOLDS, START NOT CHECKED: ros2",
        ),
        ("rapid/kitchen.mod", "kitchen.prg", "HOLDS: rapid"),
        ("rapid/kitchen.mod", "KITCHEN.SYS", "HOLDS: rapid"),
        ("rapid/kitchen.mod", "module.txt", "HOLDS: rapid"),
    ] {
        fs::copy(dir.join(file), dir.join(name)).unwrap();
        let said = platewash(dir, &["verify", "out/plan.json", "--program", name])
            .done()
            .stdout;
        assert!(
            said.starts_with(start) && said.contains("as it was handed over"),
            "{name}: {said}"
        );
    }
    // The player sends a goal that was not given.
    let others = ["verify", "out/plan.json", "--program", "washing.yml", "play.py"];
    fs::copy(dir.join("ros2/play.py"), dir.join("play.py")).unwrap();
    let said = platewash(dir, &others).done().stdout;
    assert!(said.starts_with("HOLDS, START NOT CHECKED: ros2"), "{said}");
    // Marks of byte order are no part of a text.
    let json = fs::read_to_string(dir.join("washing.json")).unwrap();
    fs::write(dir.join("marked.json"), format!("\u{feff}{json}")).unwrap();
    platewash(dir, &["verify", "out/plan.json", "--program", "marked.json"]).done();
    fs::write(
        dir.join("none.csv"),
        "q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad\n0,0,0,0,0,0\n",
    )
    .unwrap();
    platewash(dir, &["verify", "out/plan.json", "--program", "none.csv"])
        .refused(2, &["none.csv:1", "\"t_s\" is missing"]);
}
