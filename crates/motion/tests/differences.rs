//! Fields in which two jobs differ, by their paths.

use platewash_fixtures::{kitchen, kitchen_plate};
use platewash_motion::differences::differences;
use platewash_workcell::job::JobTerms;
use serde_json::Value;

type Change = fn(&mut JobTerms);

fn found(change: Change) -> Vec<[String; 3]> {
    let job = kitchen();
    let mut terms = job.terms().clone();
    change(&mut terms);
    let all = differences(&terms, job.terms());
    all.into_iter().map(|d| [d.key, d.found, d.expected]).collect()
}

#[test]
fn a_job_does_not_differ_from_itself() {
    assert_eq!(found(|_| ()), [] as [[String; 3]; 0]);
}

#[test]
fn every_field_that_differs_is_named_by_its_path() {
    let one = |change: Change| match &found(change)[..] {
        [one] => one.clone(),
        others => panic!("{others:?}"),
    };
    let says = |change: Change, expected: [&str; 3]| assert_eq!(one(change), expected.map(str::to_owned));
    says(|t| t.seed = 2, ["seed", "2", "1"]);
    says(
        |t| t.requirements.clearance_m = 0.0,
        ["requirements.clearance_m", "0.0", "0.01"],
    );
    says(
        |t| t.plates[2].pose.translation.x = 0.3,
        ["plates[2].pose.position_m[0]", "0.3", "0.2923017826335751"],
    );
    says(
        |t| t.home_rad[1][4] = 1.5,
        ["home_rad[1][4]", "1.5", "1.5707963267948966"],
    );
    says(
        |t| t.workcell.arm.name = "other".to_owned(),
        ["workcell.arm.name", "\"other\"", "\"irb120\""],
    );
    says(
        |t| t.simulation.payload_kg = Some(0.5),
        ["simulation.payload_kg", "0.5", "null"],
    );
    says(
        |t| _ = t.workcell.obstacles.pop(),
        [
            r#"workcell.obstacles["floor"]"#,
            "nothing",
            r#"{"name":"floor","pose":{"position_m":[0.0,0.0,0.0],"quaternion_wxyz":[1.0,0.0,0.…"#,
        ],
    );
}

#[test]
fn reports_an_additional_pair_and_another_order() {
    let more = found(|t| {
        let mut first = t.workcell.exclusions[0].clone();
        first.pair = ["handle".to_owned(), "floor".to_owned()];
        t.workcell.exclusions.insert(0, first);
    });
    assert_eq!(more.len(), 1, "{more:?}");
    assert_eq!(more[0][0], r#"workcell.exclusions[["handle","floor"]]"#);
    let swapped = found(|t| t.workcell.exclusions.swap(0, 1));
    let keys: Vec<_> = swapped.iter().map(|d| &d[0][..]).collect();
    assert_eq!(keys, ["order of workcell.exclusions"]);
}

#[test]
fn reports_an_additional_plate_and_another_planner() {
    let more = found(|t| t.plates.push(kitchen_plate([0.5, 0.5])));
    assert_eq!(
        (more.len(), &more[0][0][..], &more[0][2][..]),
        (1, "plates[4]", "nothing")
    );
    let planner = found(|t| t.planner = platewash_workcell::job::Planner::Paper(Value::Null));
    let keys: Vec<_> = planner.iter().map(|d| &d[0][..]).collect();
    assert_eq!(keys, ["planner.paper", "planner.wash"]);
}
