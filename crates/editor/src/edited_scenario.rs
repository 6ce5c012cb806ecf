//! Scenario under edit: the scenario as it was opened, its change by a question, the limit on work, and the latest answer.

use crate::answer_writer::End;
use crate::protocol::{Edit, Refusal};
use crate::refusal::{about, at, of_edit, of_scenario, plain};
use platewash_bodies::job::WashJob;
use platewash_certificate::Certificate;
use platewash_kinematics::RobotModel;
use platewash_kinematics::fingerprint::sha256_hex;
use platewash_kinematics::urdf::Files;
use platewash_motion::plan::Plan;
use platewash_planner::Watch;
use platewash_scenario::{Cache, Draft, Failure, Program, Scenario, Solids, values_of};
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::layout::Layout;
use platewash_workcell::words::count_with_noun;
use serde_json::Value;
use std::collections::{BTreeMap, HashSet};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, SystemTime};

/// Longest question \[bytes\]: a scenario of the largest size, with all its characters escaped.
pub const MOST_QUESTION_BYTES: usize = 2 << 20;

/// Contact points of all wash paths together, at most. Memory and time of a plan and its proof grow with them.
pub const MOST_CONTACT_POINTS: usize = 60_000;

/// Changes of one question, at most.
pub const MOST_EDITS: usize = 1000;

/// Longest time for a question up to its proof.
pub const LONGEST: Duration = Duration::from_secs(60);

/// Longest time for a map.
pub const LONGEST_MAP: Duration = Duration::from_secs(120);

/// Returns the reason that a scenario is too much work for a page that waits; `None` where it is not.
pub fn too_much(scenario: &Scenario) -> Option<String> {
    let points = scenario.contact_points();
    (points > MOST_CONTACT_POINTS).then(|| {
        format!(
            "layout.count or positions_m, wash.turns, wash.path_radius_m: {} have {points} contact points in all; up to \
             {MOST_CONTACT_POINTS} are planned while you wait (`platewash run` plans more)",
            count_with_noun(scenario.plates(), "plate")
        )
    })
}

/// Scenario that is edited.
#[derive(Debug, Default)]
pub struct EditedScenario {
    /// Name of the scenario, or its file as it was given.
    pub name: String,
    /// Folder that relative paths in it start from.
    pub folder: Option<PathBuf>,
    /// Text of the scenario as it was opened.
    pub text: String,
    /// True where pages on other machines may ask.
    pub is_open_to_others: bool,
    /// True where the latest answer is remembered.
    pub remembers: bool,
    /// Arms that were loaded, by the data that decide them.
    arms: Cache<String, Arc<RobotModel>, KEPT>,
    /// Meshes that were cut.
    pub solids: Solids,
    /// Source of the files that it names.
    pub files: Files,
    last: Mutex<Option<LastResult>>,
}

/// Result of the last question that was answered to its end.
#[derive(Debug, Clone)]
pub struct LastResult {
    /// The scenario's text.
    pub text: String,
    /// The scenario.
    pub scenario: Scenario,
    /// Its plan, if there is one.
    pub plan: Option<Arc<Plan>>,
    /// The proof of it.
    pub certificate: Option<Arc<Certificate>>,
    /// The first line of its result.
    pub headline: String,
}

impl EditedScenario {
    /// A scenario; paths in it begin in `folder`.
    pub fn new(name: &str, text: &str, folder: Option<&Path>) -> Self {
        Self {
            name: name.to_owned(),
            folder: folder.map(Path::to_owned),
            text: text.to_owned(),
            ..Self::default()
        }
    }

    /// Returns the latest answer, if it is remembered.
    pub fn latest(&self) -> Option<LastResult> {
        self.last.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Remembers the result of a question, where that is enabled.
    pub fn remember(&self, news: impl FnOnce() -> LastResult) {
        if self.remembers {
            *self.last.lock().unwrap_or_else(PoisonError::into_inner) = Some(news());
        }
    }

    /// Returns true where a question may name files that the scenario on disk does not.
    pub fn may_name_files(&self) -> bool {
        !self.is_open_to_others
    }

    /// Checks that the scenario, as it was opened, names all files that another one names.
    pub fn names_all_of(&self, scenario: &Scenario) -> bool {
        let opened = Draft::new(&self.text).and_then(|draft| draft.scenario(&self.name, self.folder.as_deref()));
        let opened = opened.ok();
        let named: HashSet<&Path> = opened.iter().flat_map(Scenario::files).collect();
        scenario.files().all(|path| named.contains(path))
    }
}

/// A text with its changes.
pub struct EditedText {
    /// The text.
    pub text: String,
    /// Values that it states.
    pub stated: BTreeMap<String, Value>,
    /// Values in effect; empty where it is no scenario.
    pub values: BTreeMap<String, Value>,
    /// The scenario, or why it is none.
    pub scenario: Result<Scenario, Refusal>,
}

/// Changes a text.
///
/// # Errors
/// [`End`]: it is no TOML, a change is none, or it is given up.
pub fn changed(edited: &EditedScenario, text: &str, edits: &[Edit], cancel: &CancelToken) -> Result<EditedText, End> {
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
        .scenario(&edited.name, None)
        .as_ref()
        .map(values_of)
        .unwrap_or_default();
    let scenario = in_folder(edited, &draft);
    Ok(EditedText {
        text: draft.text().to_owned(),
        stated,
        values,
        scenario: scenario.and_then(|scenario| accepted(edited, scenario)),
    })
}

/// The scenario that a text states, its paths found from the scenario's folder; not one yet that a page may ask for.
pub fn stated(edited: &EditedScenario, text: &str) -> Result<Scenario, Refusal> {
    let draft = Draft::new(text).map_err(|error| of_scenario(&error))?;
    in_folder(edited, &draft)
}

fn in_folder(edited: &EditedScenario, draft: &Draft) -> Result<Scenario, Refusal> {
    let scenario = draft.scenario(&edited.name, edited.folder.as_deref());
    let mut scenario = scenario.map_err(|error| of_scenario(&error))?;
    scenario.solids = edited.solids.clone();
    scenario.files = edited.files.clone();
    Ok(scenario)
}

/// A scenario that a page may ask for.
pub fn accepted(edited: &EditedScenario, scenario: Scenario) -> Result<Scenario, Refusal> {
    if scenario.job.program == Program::Paper {
        let words = "job.program = \"paper\": the paper's program moves from waypoint to waypoint, and nothing of it is proved; set it to \
                     \"certified\" (its wash.height_m to 0) for a plan with its proof, or look at it with `platewash run`";
        return Err(at("job.program", words));
    }
    may_name_its_files(edited, &scenario)?;
    match too_much(&scenario) {
        Some(words) => Err(about(words)),
        None => match scenario.plates_read() {
            Ok(read) => Ok(read.into_owned()),
            Err(error) => Err(of_scenario(&error)),
        },
    }
}

/// Refuses files that a page which other machines can reach may not name.
pub fn may_name_its_files(edited: &EditedScenario, scenario: &Scenario) -> Result<(), Refusal> {
    if !edited.may_name_files() && !edited.names_all_of(scenario) {
        let words = "robot.urdf, robot.srdf, robot.package_path, meshes: a page that other machines can reach names no files but those of \
                     the scenario on disk; change them there";
        return Err(at("robot.urdf", words));
    }
    Ok(())
}

/// Arms that are kept.
const KEPT: usize = 4;

/// An arm, and an id of its description.
#[derive(Debug, Clone)]
pub struct LoadedArm {
    /// The id: it differs wherever the arm may differ.
    pub id: String,
    /// The arm.
    pub arm: Arc<RobotModel>,
}

impl EditedScenario {
    /// The arm of a scenario.
    pub fn arm(&self, scenario: &Scenario) -> Result<LoadedArm, Failure> {
        let id = id(scenario);
        let arm = self.arms.get_or_make(id.clone(), || scenario.arm())?;
        Ok(LoadedArm { id, arm })
    }
}

/// Identifier of an arm: the files and the model that the scenario names, and the times when those files were last written; the
/// accelerations are shown with it.
fn id(scenario: &Scenario) -> String {
    let robot = &scenario.robot;
    let written = [&robot.urdf, &robot.srdf].map(|path| path.as_deref().and_then(written));
    let named = (
        robot.model,
        &robot.urdf,
        &robot.srdf,
        &robot.package_path,
        robot.visual_shapes,
        &robot.split_links,
        &robot.fixed,
    );
    let shown = scenario.limits.joint_acceleration_rad_s2;
    sha256_hex(format!("{named:?} {written:?} {shown:?}").as_bytes())
}

fn written(path: &Path) -> Option<(SystemTime, u64)> {
    let file = path.metadata().ok()?;
    Some((file.modified().ok()?, file.len()))
}

/// A job, and the further statements of its scenario.
pub struct PlacedJob {
    /// The scenario.
    pub scenario: Scenario,
    /// The arm.
    pub loaded: LoadedArm,
    /// The plates, and the findings on them.
    pub layout: Layout,
    /// The job.
    pub job: WashJob,
}

/// The job of a scenario.
pub fn place_job(edited: &EditedScenario, scenario: Scenario, cancel: &CancelToken) -> Result<PlacedJob, End> {
    let loaded = edited.arm(&scenario)?;
    let layout = scenario.place(&loaded.arm, &Watch::silent(cancel))?;
    let job = scenario.job_on(&loaded.arm, &layout)?;
    Ok(PlacedJob {
        scenario,
        loaded,
        layout,
        job,
    })
}
