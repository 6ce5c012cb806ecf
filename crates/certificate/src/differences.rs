//! Where the job of a plan is another one than was asked for: a certificate tells that a plan does its job, not whose job it is.

use platewash_workcell::job::JobTerms;
use platewash_workcell::words::{printable, shortened};
use serde::Serialize;
use serde_json::{Map, Value};
use std::collections::BTreeSet;

/// Longest value that a difference repeats, in characters.
const LONGEST: usize = 80;

/// A field in which two jobs differ.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, thiserror::Error)]
#[error("{}: {}; expected {}", printable(.key), printable(.found), printable(.expected))]
pub struct Difference {
    /// Its place, e.g. `plates[2].pose.position_m[0]`.
    pub key: String,
    /// What the one job says, as JSON; `nothing` where it says nothing.
    pub found: String,
    /// What the other says.
    pub expected: String,
}

/// Every field in which the terms found differ from those expected, by the order of their names.
#[must_use]
pub fn differences(found: &JobTerms, expected: &JobTerms) -> Vec<Difference> {
    let mut all = Vec::new();
    let said = [found, expected].map(|terms| serde_json::to_value(terms).unwrap_or(Value::Null));
    compare("", Some(&said[0]), Some(&said[1]), &mut all);
    all
}

fn compare(key: &str, found: Option<&Value>, expected: Option<&Value>, all: &mut Vec<Difference>) {
    match (found, expected) {
        (Some(Value::Object(found)), Some(Value::Object(expected))) => {
            for name in names(found, expected) {
                let dot = if key.is_empty() { "" } else { "." };
                compare(&format!("{key}{dot}{name}"), found.get(name), expected.get(name), all);
            }
        }
        (Some(Value::Array(found)), Some(Value::Array(expected))) => {
            if let (Some(ours), Some(theirs)) = (labels(found), labels(expected)) {
                return compare_labelled(key, (found, &ours), (expected, &theirs), all);
            }
            for i in 0..found.len().max(expected.len()) {
                compare(&format!("{key}[{i}]"), found.get(i), expected.get(i), all);
            }
        }
        _ if found == expected => {}
        _ => all.push(Difference {
            key: key.to_owned(),
            found: said(found),
            expected: said(expected),
        }),
    }
}

/// Lists of things that have names, or pairs of names: one thing more or less is one difference, wherever it stands.
fn compare_labelled(
    key: &str,
    (found, ours): (&[Value], &[String]),
    (expected, theirs): (&[Value], &[String]),
    all: &mut Vec<Difference>,
) {
    let both: BTreeSet<_> = theirs.iter().chain(ours).collect();
    for label in both {
        let of = |labels: &[String], values: &'_ [Value]| {
            let at = labels.iter().position(|other| other == label);
            at.map(|at| values[at].clone())
        };
        let (found, expected) = (of(ours, found), of(theirs, expected));
        compare(&format!("{key}[{label}]"), found.as_ref(), expected.as_ref(), all);
    }
    let in_order = |labels: &[String], others: &[String]| -> Vec<String> {
        labels.iter().filter(|label| others.contains(label)).cloned().collect()
    };
    let (ours, theirs) = (in_order(ours, theirs), in_order(theirs, ours));
    if ours != theirs {
        all.push(Difference {
            key: format!("order of {key}"),
            found: shortened(&ours.join(", "), LONGEST),
            expected: shortened(&theirs.join(", "), LONGEST),
        });
    }
}

/// What tells the things of a list apart: their names or pairs of names, where all have one of their own.
fn labels(list: &[Value]) -> Option<Vec<String>> {
    let label = |value: &Value| {
        let name = value.get("name").or_else(|| value.get("pair"))?;
        Some(name.to_string())
    };
    let labels: Vec<String> = list.iter().map(label).collect::<Option<_>>()?;
    let different: BTreeSet<_> = labels.iter().collect();
    (different.len() == labels.len()).then_some(labels)
}

/// The keys of two tables, each once.
fn names<'a>(found: &'a Map<String, Value>, expected: &'a Map<String, Value>) -> BTreeSet<&'a String> {
    expected.keys().chain(found.keys()).collect()
}

/// The beginning of a value.
fn said(value: Option<&Value>) -> String {
    shortened(&value.map_or_else(|| "nothing".to_owned(), Value::to_string), LONGEST)
}

#[cfg(test)]
mod tests {
    use super::*;
    use platewash_workcell::fixtures::{kitchen, kitchen_plate};

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
    fn a_pair_more_and_another_order_are_a_difference_each() {
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
    fn a_plate_more_and_a_planner_of_another_kind_are_differences_too() {
        let more = found(|t| t.plates.push(kitchen_plate([0.5, 0.5])));
        assert_eq!(
            (more.len(), &more[0][0][..], &more[0][2][..]),
            (1, "plates[4]", "nothing")
        );
        let planner = found(|t| t.planner = platewash_workcell::job::Planner::Paper(Value::Null));
        let keys: Vec<_> = planner.iter().map(|d| &d[0][..]).collect();
        assert_eq!(keys, ["planner.paper", "planner.wash"]);
    }
}
