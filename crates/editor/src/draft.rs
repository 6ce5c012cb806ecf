//! The scenario of a question: its text, changed, and what it says.

use crate::bounds::{self, MOST_EDITS};
use crate::end::End;
use crate::protocol::{Edit, Refusal};
use crate::refusal::{about, at, of_edit, of_scenario, plain};
use crate::subject::Subject;
use platewash_scenario::{Draft, Program, Scenario, values_of};
use platewash_workcell::cancel::CancelToken;
use serde_json::Value;
use std::collections::BTreeMap;

/// A text with its changes.
pub struct Changed {
    /// The text.
    pub text: String,
    /// What it states.
    pub stated: BTreeMap<String, Value>,
    /// What counts; empty where it is no scenario.
    pub values: BTreeMap<String, Value>,
    /// The scenario, or why it is none.
    pub scenario: Result<Scenario, Refusal>,
}

/// Changes a text.
///
/// # Errors
/// [`End`]: it is no TOML, a change is none, or it is given up.
pub fn changed(subject: &Subject, text: &str, edits: &[Edit], cancel: &CancelToken) -> Result<Changed, End> {
    if edits.len() > MOST_EDITS {
        let words = format!("{} changes at once; at most {MOST_EDITS} are made", edits.len());
        return Err(plain(words).into());
    }
    let mut draft = Draft::new(text).map_err(|error| of_scenario(&error))?;
    for edit in edits {
        cancel.check()?;
        let set = draft.set(&edit.key, edit.value.as_ref());
        set.map_err(|error| of_edit(&edit.key, &error))?;
    }
    let stated = draft.stated();
    // Paths are shown as they stand.
    let values = draft
        .scenario(&subject.name, None)
        .as_ref()
        .map(values_of)
        .unwrap_or_default();
    let scenario = in_folder(subject, &draft);
    Ok(Changed {
        text: draft.text().to_owned(),
        stated,
        values,
        scenario: scenario.and_then(|scenario| accepted(subject, scenario)),
    })
}

/// The scenario that a text states, its paths found from the scenario's folder; not one yet that a page may ask for.
pub fn stated(subject: &Subject, text: &str) -> Result<Scenario, Refusal> {
    let draft = Draft::new(text).map_err(|error| of_scenario(&error))?;
    in_folder(subject, &draft)
}

fn in_folder(subject: &Subject, draft: &Draft) -> Result<Scenario, Refusal> {
    let scenario = draft.scenario(&subject.name, subject.folder.as_deref());
    let mut scenario = scenario.map_err(|error| of_scenario(&error))?;
    scenario.solids = subject.solids.clone();
    Ok(scenario)
}

/// A scenario that a page may ask for.
pub fn accepted(subject: &Subject, scenario: Scenario) -> Result<Scenario, Refusal> {
    if scenario.job.program == Program::Paper {
        let words = "job.program = \"paper\": the paper's program moves from waypoint to waypoint, and nothing of it is proved; set it to \
                     \"certified\" (its wash.height_m to 0) for a plan with its proof, or look at it with `platewash run`";
        return Err(at("job.program", words));
    }
    may_name_its_files(subject, &scenario)?;
    match bounds::too_much(&scenario) {
        Some(words) => Err(about(words)),
        None => Ok(scenario),
    }
}

/// Refuses files that a page which other machines can reach may not name.
pub fn may_name_its_files(subject: &Subject, scenario: &Scenario) -> Result<(), Refusal> {
    if !subject.may_name_files() && !subject.names_all_of(scenario) {
        let words = "robot.urdf, robot.srdf, robot.package_path, meshes: a page that other machines can reach names no files but those of \
                     the scenario on disk; change them there";
        return Err(at("robot.urdf", words));
    }
    Ok(())
}
