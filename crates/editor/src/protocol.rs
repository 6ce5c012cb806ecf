//! Questions of the page and lines of answers, as JSON: `platewash-edit/1`. The page's TypeScript types are made from these.

use platewash_motion::trajectory::PlanSegment;
use platewash_planner::Chance;
use platewash_viewer::view;
use platewash_workcell::tool::Tool;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use ts_rs::TS;

/// The format of the words.
pub const FORMAT: &str = "platewash-edit/1";

/// Question for the scenario with some changes, planned and proved.
#[derive(Debug, Clone, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct CellQuestion {
    /// The page that asks, by at most 64 letters and digits: its question ends those that it asked before.
    pub session: String,
    /// The scenario.
    pub text: String,
    /// Changes to it, in order.
    pub edits: Vec<Edit>,
    /// Last stage of the work.
    pub want: LastStage,
    /// Id of the arm that the page has.
    pub arm: Option<String>,
    /// True where the page shows an outlook already: then none is computed beside the plan, which comes sooner.
    #[serde(default)]
    pub guessed: bool,
}

/// A change to a scenario.
#[derive(Debug, Clone, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Edit {
    /// The key.
    pub key: String,
    /// Its new value; `None` takes it out.
    #[ts(type = "Value | null")]
    pub value: Option<Value>,
}

/// Last stage of the work for a question.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum LastStage {
    /// Up to the outlook.
    Preview,
    /// Up to the proof.
    Proof,
}

/// Question for the places at which a plate could be washed, with the others in place.
#[derive(Debug, Clone, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct MapQuestion {
    /// The page that asks.
    pub session: String,
    /// The scenario.
    pub text: String,
    /// The plate.
    pub plate: usize,
}

/// Question for the way on after a stop of the scenario's plan.
#[derive(Debug, Clone, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct RecoveryQuestion {
    /// The page that asks.
    pub session: String,
    /// The scenario.
    pub text: String,
    /// Time in the plan at which it was stopped \[s\]; `None` where that is not known.
    pub stopped_s: Option<f64>,
    /// Joint positions of the arm \[deg\]; `None` for those of the plan then.
    pub at_deg: Option<[f64; 6]>,
}

/// Request to write the scenario, and its results beside it.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct SaveQuestion {
    /// The page that asks.
    pub session: String,
    /// The scenario.
    pub text: String,
    /// SHA-256 of the file on disk, as the page knows it; `None` where there is none.
    pub disk: Option<String>,
    /// True to overwrite the file on disk without a check of its contents.
    pub force: bool,
}

/// Question whether the file on disk has changed.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct DiskQuestion {
    /// The page that asks.
    pub session: String,
    /// SHA-256 of the file on disk, as the page knows it.
    pub disk: Option<String>,
}

/// A line of the answer to a [`CellQuestion`].
#[derive(Debug, Serialize, TS)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum CellLine<'a> {
    /// The scenario with the changes.
    Scenario {
        /// Its text, comments and order kept.
        text: &'a str,
        /// Values that the text states.
        #[ts(type = "Record<string, Value>")]
        stated: &'a BTreeMap<String, Value>,
        /// Values in effect, defaults filled in; empty where it is no scenario.
        #[ts(type = "Record<string, Value>")]
        values: &'a BTreeMap<String, Value>,
        /// Time that it took.
        ms: Milliseconds,
    },
    /// Parts of the cell that are known before anything is planned.
    Cell(Box<CellParts<'a>>),
    /// A guess, plate by plate: not planned, not proved.
    Preview {
        /// The plates.
        plates: Vec<PlateChance>,
        /// Time that it took.
        ms: Milliseconds,
    },
    /// Planned, not proved.
    Plan(Box<PlanParts<'a>>),
    /// No plan.
    Unplanned {
        /// The first line.
        headline: &'a str,
        /// Reason in full.
        reason: &'a str,
        /// True where it is proved that there is none.
        proved: bool,
        /// The plates concerned.
        plates: &'a [UnwashableReport],
        /// Time that it took.
        ms: Milliseconds,
    },
    /// Other place at which a plate could lie.
    Place {
        /// The plate.
        plate: usize,
        /// The nearest centre found \[m\].
        nearest_m: Option<[f64; 2]>,
        /// Greatest distance searched \[m\].
        searched_m: f64,
        /// Time that it took.
        ms: Milliseconds,
    },
    /// The proof, behind the plan.
    Proof {
        /// The certificate.
        certificate: &'a view::Certificate,
        /// First line of the report.
        headline: &'a str,
        /// Area of each plate that is proved to be swept.
        proved: Vec<PlateProof>,
        /// Time that it took.
        ms: Milliseconds,
    },
}

/// Early end of an answer; nothing follows.
#[derive(Debug, Serialize, TS)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum EndLine<'a> {
    /// The text is no scenario, or states no job, or not what the question asks for.
    Refused {
        /// Reason of the refusal.
        #[serde(flatten)]
        refusal: &'a Refusal,
        /// Time that it took.
        ms: Milliseconds,
    },
    /// A later question of the same page came.
    Superseded,
    /// Too much work, a file that cannot be written, or a fault of the program.
    Failed {
        /// Fault, in words.
        words: &'a str,
    },
}

/// Reason that a scenario is refused.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct Refusal {
    /// In words.
    pub words: String,
    /// The key at fault, where one is.
    pub key: Option<String>,
    /// Its line in the text, from 1.
    pub line: Option<usize>,
}

/// Parts of a cell that are known before anything is planned.
#[derive(Debug, Serialize, TS)]
pub struct CellParts<'a> {
    /// Heading of the page.
    pub heading: &'a view::Heading,
    /// The arm, where the page does not have it.
    pub arm: Option<ArmLine<'a>>,
    /// Id of the arm's description.
    pub arm_id: &'a str,
    /// The tool.
    pub tool: &'a Option<Tool>,
    /// Bodies around the arm.
    pub surroundings: &'a view::Surroundings,
    /// The plates.
    pub plates: &'a [view::Plate],
    /// Their centres \[m\].
    pub centres_m: Vec<[f64; 2]>,
    /// Their radii \[m\].
    pub radius_m: Vec<f64>,
    /// True where the text lists the plates.
    pub listed: bool,
    /// Keys that move the plates and the bodies around the arm.
    pub moves: Moves,
    /// Home configuration of the arm \[rad\].
    pub pose_rad: [f64; 6],
    /// Findings on the layout of the plates.
    pub findings: Vec<FindingLine>,
    /// Time that it took.
    pub ms: Milliseconds,
}

/// Keys that move the things of a cell.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct Moves {
    /// Plates.
    pub plates: PlateMoves,
    /// Bodies around the arm, one by one.
    pub bodies: Vec<BodyMove>,
}

/// Part of the text that states the positions of plates.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
#[serde(tag = "by", rename_all = "snake_case")]
pub enum PlateMoves {
    /// `layout.positions_m`, which lists all of them.
    Positions,
    /// The `[[plate]]` sections.
    Sections {
        /// Index of the section of each plate.
        sections: Vec<usize>,
        /// Position of each section's plates \[m\].
        at_m: Vec<[f64; 3]>,
    },
    /// The plates cannot be moved.
    Nothing {
        /// Reason, in words.
        words: &'static str,
    },
}

/// Key that states the position of a body around the arm.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct BodyMove {
    /// The key; none where it is not moved.
    pub key: Option<String>,
    /// Its value \[m\], x and y first.
    pub at_m: Vec<f64>,
    /// Reason that it cannot be moved.
    pub words: Option<String>,
    /// The plates that it holds, by their index, with which it goes; none where it holds every plate.
    pub holds: Option<Vec<usize>>,
}

/// An arm and its id.
#[derive(Debug, Serialize, TS)]
pub struct ArmLine<'a> {
    /// The id.
    pub id: &'a str,
    /// The arm.
    pub arm: &'a view::Arm,
}

/// Finding on the layout of the plates.
#[derive(Debug, Serialize, TS)]
pub struct FindingLine {
    /// In words.
    pub words: String,
    /// The plates.
    pub plates: Vec<usize>,
}

/// Outlook for a plate.
#[derive(Debug, Serialize, TS)]
pub struct PlateChance {
    /// The plate.
    pub plate: usize,
    /// The chance that it can be washed.
    pub chance: Chance,
    /// The chance in words.
    pub words: &'static str,
}

/// A plan as it is shown.
#[derive(Debug, Serialize, TS)]
pub struct PlanParts<'a> {
    /// Heading of the page.
    pub heading: &'a view::Heading,
    /// The first line.
    pub headline: String,
    /// Paths that the tip follows.
    pub paths: &'a [view::WashPath],
    /// The stretches of the motion.
    pub segments: &'a [PlanSegment],
    /// The motion.
    pub motion: &'a Option<view::Motion>,
    /// The smallest distance over time.
    pub clearance: &'a Option<view::Clearance>,
    /// Swept area of the plates.
    pub coverage: &'a [view::PlateCoverage],
    /// Time that it took.
    pub ms: Milliseconds,
}

/// Area of a plate that is proved to be swept or, where the job states what counts as contact, pressed.
#[derive(Debug, Serialize, TS)]
pub struct PlateProof {
    /// The plate.
    pub plate: usize,
    /// The least share.
    pub at_least: f64,
}

/// A plate that cannot be washed, or that no way to wash was found for.
#[derive(Debug, Clone, PartialEq, Default, Serialize, TS)]
pub struct UnwashableReport {
    /// The plate.
    pub plate: usize,
    /// True where it is proved that it cannot be washed.
    pub proved: bool,
    /// In words.
    pub words: String,
    /// Causes that keep parts of it from being washed.
    pub causes: Vec<String>,
    /// Share of its wash path for which configurations were found.
    pub share: Option<f64>,
    /// Contact points for which configurations were found, world frame \[m\].
    pub free_m: Vec<[f64; 3]>,
    /// Contact points for which none were, world frame \[m\].
    pub dead_m: Vec<[f64; 3]>,
}

/// A line of the answer to a [`MapQuestion`].
#[derive(Debug, Serialize, TS)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum MapLine<'a> {
    /// Squares of one size; coarse ones come first.
    Map {
        /// Their edge \[m\].
        step_m: f64,
        /// Middles of those where the plate could be washed \[m\].
        washable_m: &'a [[f64; 2]],
        /// Middles of the others \[m\].
        unwashable_m: &'a [[f64; 2]],
        /// Squares checked so far.
        done: usize,
        /// Total number of squares, as far as is known.
        of: usize,
    },
    /// The map is complete.
    MapDone {
        /// Meaning of the map, in words.
        words: &'a str,
        /// Time that it took.
        ms: Milliseconds,
    },
}

/// The answer to a [`RecoveryQuestion`].
#[derive(Debug, Serialize, TS)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum RecoveryLine {
    /// The way home, and what is left.
    Recovery {
        /// True where both are proved.
        proved: bool,
        /// The stop, in words.
        stop: String,
        /// First line on the plates that are left; `None` where all were washed.
        rest: Option<String>,
        /// The motion home, with its proof.
        view: Box<view::View>,
        /// Time that it took.
        ms: Milliseconds,
    },
}

/// The answer to a [`SaveQuestion`].
#[derive(Debug, Serialize, TS)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum SaveLine<'a> {
    /// The text is on disk.
    Saved {
        /// SHA-256 of it.
        disk: &'a str,
        /// The file.
        file: &'a str,
        /// All files that were written.
        files: &'a [String],
        /// Result of the scenario, in one line.
        words: &'a str,
    },
    /// Something else stands there.
    Conflict {
        /// SHA-256 of that; `None` for nothing.
        disk: Option<&'a str>,
        /// Contents of the file on disk, where it is text.
        text: Option<&'a str>,
        /// Conflict, in words.
        words: &'a str,
    },
}

/// The answer to a [`DiskQuestion`].
#[derive(Debug, Serialize, TS)]
#[serde(tag = "kind", rename = "disk")]
pub struct DiskLine<'a> {
    /// SHA-256 of the file on disk; `None` where there is none.
    pub disk: Option<&'a str>,
    /// Contents of the file, where they differ from those that the page knows.
    pub text: Option<&'a str>,
    /// Reason that it cannot be read.
    pub words: Option<&'a str>,
}

/// Facts that a page needs after its server was replaced by another one.
#[derive(Debug, Serialize, TS)]
#[serde(tag = "kind", rename = "hello")]
pub struct HelloLine<'a> {
    /// [`FORMAT`].
    pub format: &'a str,
    /// File that the scenario is saved in.
    pub file: Option<&'a str>,
    /// SHA-256 of the file on disk.
    pub disk: Option<&'a str>,
}

/// Time that steps took, by their names \[ms\].
#[derive(Debug, Clone, Default, PartialEq, Serialize, TS)]
#[serde(transparent)]
#[ts(as = "BTreeMap<String, f64>")]
pub struct Milliseconds(pub(crate) BTreeMap<&'static str, f64>);
