//! Arms whose joints turn many times: planned, proved and verified as those that turn once.

use super::*;
use platewash::kinematics::irb120::{IRB120_SRDF, IRB120_URDF};

/// Plans and proves one plate of the kitchen, or more, with an arm of these limits \[rad\], verifies the plan, and returns the report.
fn run(dir: &Path, limits: Option<[f64; 2]>, homes: &str, count: &str) -> Value {
    let urdf = match limits {
        Some(limits) => wide::between(IRB120_URDF, limits),
        None => IRB120_URDF.replace("type=\"revolute\"", "type=\"continuous\""),
    };
    std::fs::write(dir.join("arm.urdf"), urdf).unwrap();
    std::fs::write(dir.join("arm.srdf"), IRB120_SRDF).unwrap();
    let arm = ["urdf = \"arm.urdf\"\nsrdf = \"arm.srdf\"", homes].join("\n");
    let changes = [
        ("count = 4", count),
        ("model = \"irb120\"", arm.as_str()),
        ("start_deg = [0, 0, 0, 0, 90, 0]", ""),
    ];
    let cell = kitchen(dir, &changes);
    let ran = platewash(dir, &["run", "--json", "--quiet", "--scenario", cell.to_str().unwrap()]);
    platewash(
        dir,
        &[
            "verify",
            "out/plan.json",
            "--quiet",
            "--against",
            cell.to_str().unwrap(),
        ],
    )
    .done();
    let report = ran.done().json();
    assert_eq!(
        report["verdict"], "washed",
        "{limits:?} {homes}: {}",
        report["headline"]
    );
    report
}

#[test]
fn arms_of_many_turns_wash_as_those_of_one_turn() {
    let folder = folder();
    let dir = folder.path();
    let cycle_s = |limits, homes: &str| run(dir, limits, homes, "count = 1")["duration_s"].as_f64().unwrap();
    let wide = Some([-100.0, 100.0]);
    let once_s = cycle_s(Some([-6.3, 6.3]), "start_deg = [0, 0, 0, 0, 90, 0]");
    for (limits, homes) in [
        (wide, "start_deg = [0, 0, 0, 0, 90, 0]"),
        (wide, "start_deg = [3600, -1800, 720, -5400, 2610, 5040]"),
        (Some([0.0, 100.0]), "start_deg = [360, 360, 360, 360, 450, 360]"),
        (
            Some([-100.0, -85.0]),
            "start_deg = [-5400, -5400, -5400, -5400, -5310, -5400]",
        ),
        (None, "start_deg = [18000, 0, 0, -25200, 90, 36000]"),
    ] {
        let found_s = cycle_s(limits, homes);
        assert!(
            (found_s - once_s).abs() < 1e-3 * once_s,
            "{limits:?} {homes}: {found_s} {once_s}"
        );
    }
    // Joint 6 ends ten turns on: it makes them.
    let unwound_s = cycle_s(
        wide,
        "start_deg = [0, 0, 0, 0, 90, 0]\nhome_deg = [0, 0, 0, 0, 90, 3600]",
    );
    let turns_s = 3600.0_f64.to_radians() / 7.33038;
    let more_s = unwound_s - once_s;
    assert!((0.9 * turns_s..2.0 * turns_s).contains(&more_s), "{more_s} {turns_s}");
}

/// Without a home, which is then looked for: the same for one turn as for sixteen.
#[test]
fn the_home_of_an_arm_of_many_turns_is_found() {
    let folder = folder();
    let dir = folder.path();
    let [once, often] = [6.3, 100.0].map(|limit| run(dir, Some([-limit, limit]), "", "count = 1"));
    assert_eq!(once["duration_s"], often["duration_s"]);
}

/// Plates lie to both sides of a home at which joint 1 cannot turn to one of them: it washes a turn away from there.
#[test]
fn plates_beyond_the_limit_at_home_are_washed_a_turn_away() {
    let folder = folder();
    for (limits, start_deg) in [
        ([0.0, 100.0], "start_deg = [0, 360, 360, 360, 450, 360]"),
        ([-100.0, 100.0], "start_deg = [5725, 0, 0, 0, 90, 0]"),
    ] {
        run(folder.path(), Some(limits), start_deg, "count = 4");
    }
}
