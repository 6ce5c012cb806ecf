//! Settings of a controller that are not those that were handed over.

use crate::changes::Change;
use crate::controller_settings::ReadSetting;
use crate::reading::{ReadPoint, Reading, SegmentShape};
use platewash_workcell::words::count_with_noun;
use similar::{Algorithm, DiffTag, capture_diff_slices};
use std::collections::HashSet;
use std::iter::repeat_n;

/// Greatest difference of a joint at which two stops are the same one \[rad\]; what it changes of the motion is judged.
const SAME_STOP_RAD: f64 = 1e-3;

/// Lists the settings of a program that are not among those that were handed over, those that it lacks, and stops in other places; one entry
/// for each name.
pub(crate) fn changed_settings(found: &Reading, expected: &Reading) -> Vec<Change> {
    let mut all: Vec<Change> = Vec::new();
    let mut names = HashSet::new();
    for setting in found.settings.iter().filter(|setting| names.insert(&*setting.name)) {
        let name = &*setting.name;
        let of_name = |setting: &&ReadSetting| setting.name == name;
        let handed_over: Vec<_> = expected.settings.iter().filter(of_name).collect();
        let is_changed = |setting: &&ReadSetting| !handed_over.iter().any(|other| setting.is_accepted_for(other));
        let mut changed = found.settings.iter().filter(of_name).filter(is_changed);
        let Some(first) = changed.next() else { continue };
        let found = match changed.count() {
            0 => first.value.clone(),
            more => format!("{} and {}", first.value, count_with_noun(more, "other value")),
        };
        let mut values: Vec<_> = handed_over.iter().map(|other| &*other.value).collect();
        // The same setting may stand in several files.
        values.dedup();
        all.push(Change {
            place: first.place.to_string(),
            what: name.to_owned(),
            found,
            expected: if values.is_empty() {
                "nothing".to_owned()
            } else {
                values.join(" and ")
            },
        });
    }
    for other in expected.settings.iter().filter(|other| names.insert(&*other.name)) {
        let last = found.points.last();
        all.push(Change {
            place: last.map_or_else(String::new, |point| point.place.to_string()),
            what: other.name.clone(),
            found: "nothing".to_owned(),
            expected: other.value.clone(),
        });
    }
    // Where a program states speeds at its points, they say where it stops, and are judged.
    if found.interpolation == SegmentShape::RoundedLines {
        all.extend(changed_stops(&stops(found), &stops(expected)));
    }
    all
}

/// Points at which the arm stops, once each: a wait at a stop is the same stop.
fn stops(reading: &Reading) -> Vec<&ReadPoint> {
    let points = &reading.points;
    let goes_on = |k: usize| k > 0 && points[k - 1].corner_m.is_none() && points[k - 1].q_rad == points[k].q_rad;
    let stops = (0..points.len()).filter(|&k| points[k].corner_m.is_none() && !goes_on(k));
    stops.map(|k| &points[k]).collect()
}

/// Lists stops that were added, and stops that are missing.
fn changed_stops(found: &[&ReadPoint], expected: &[&ReadPoint]) -> Vec<Change> {
    let bits = |points: &[&ReadPoint]| -> Vec<_> {
        let of = |point: &&ReadPoint| <[f64; 6]>::from(point.q_rad).map(f64::to_bits);
        points.iter().map(of).collect()
    };
    let (mut added, mut missing): (Vec<&ReadPoint>, Vec<&ReadPoint>) = (Vec::new(), Vec::new());
    // The last stop of the program before one that is missing: it has no line of its own.
    let mut before = found.first().copied();
    for difference in capture_diff_slices(Algorithm::Myers, &bits(expected), &bits(found)) {
        let (tag, old, new) = difference.as_tag_tuple();
        if tag != DiffTag::Equal {
            let mut rest = &expected[old];
            for stop in &found[new.clone()] {
                let is_same = |other: &&ReadPoint| (other.q_rad - stop.q_rad).amax() <= SAME_STOP_RAD;
                match rest.iter().position(is_same) {
                    Some(k) => {
                        missing.extend(repeat_n(before, k).flatten());
                        rest = &rest[k + 1..];
                    }
                    None => added.push(stop),
                }
                before = Some(stop);
            }
            missing.extend(repeat_n(before, rest.len()).flatten());
        }
        before = found[..new.end].last().copied().or(before);
    }
    let change = |stops: &[&ReadPoint], found: &str| {
        let first = stops.first()?;
        Some(Change {
            place: first.place.to_string(),
            what: "stops".to_owned(),
            found: format!("{found} {}", count_with_noun(stops.len(), "target")),
            expected: format!("{} in all", expected.len()),
        })
    };
    let all = [change(&added, "at further"), change(&missing, "missing at")];
    all.into_iter().flatten().collect()
}
