//! Values that were probably meant in another unit.

use super::*;

const START: &str = "start_deg = [0, 0, 0, 0, 90, 0]";
const RADIANS: &str = "start_deg = [0, 0, 0, 0, 1.5708, 0]";

#[test]
fn warns_of_a_home_in_radians() {
    let folder = folder();
    let dir = folder.path();
    let file = kitchen(dir, &[(START, RADIANS)]);
    let file = file.to_str().unwrap();
    let warned = |output: &CommandOutput| {
        assert_eq!(output.stderr.matches("warning: ").count(), 1, "{}", output.stderr);
        for part in [
            "robot.start_deg",
            "radians were probably meant",
            "[0.0, 0.0, 0.0, 0.0, 90.0, 0.0]",
        ] {
            assert!(output.stderr.contains(part), "no {part} in {}", output.stderr);
        }
    };
    let cases: [&[&str]; 4] = [
        &["run", "--scenario", file],
        &["plan", "--scenario", file],
        &["validate", "--scenario", file],
        &["sweep", "--scenario", file, "--seeds", "1..1"],
    ];
    for line in cases {
        warned(&platewash(dir, line));
    }
    // A plan states radians.
    for verb in ["verify", "simulate"] {
        let ran = platewash(dir, &[verb, "out/plan.json"]);
        assert!(!ran.stderr.contains("warning"), "{}", ran.stderr);
    }
    let ran = platewash(dir, &["validate", "--json", "--quiet", "--scenario", file]).done();
    assert!(ran.stderr.is_empty(), "{}", ran.stderr);
    let note = &ran.json()["notes"][0];
    assert_eq!(
        (&note["kind"], &note["key"]),
        (&"home_in_radians".into(), &"robot.start_deg".into())
    );
    assert_eq!(note["meant_deg"][4], 90.0);
}

#[test]
fn no_shipped_scenario_is_warned_of() {
    let folder = folder();
    for shipped in platewash::scenario::SHIPPED {
        let ran = platewash(folder.path(), &["validate", "--scenario", shipped.name]);
        assert!(!ran.stderr.contains("warning"), "{}: {}", shipped.name, ran.stderr);
    }
}

#[test]
fn millimetres_are_refused_with_their_metres() {
    let folder = folder();
    let dir = folder.path();
    let file = kitchen(dir, &[("plate_radius_m = 0.145", "plate_radius_m = 145")]);
    platewash(dir, &["validate", "--scenario", file.to_str().unwrap()]).refused(
        2,
        &["layout.plate_radius_m", "found 145", "metres are expected", "0.145"],
    );
}
