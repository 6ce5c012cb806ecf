//! Questions of the page and lines of answers, as JSON: `platewash-edit/1`.

use crate::told::Milliseconds;
use platewash_planner::Chance;
use platewash_viewer::view;
use platewash_workcell::tool::Tool;
use platewash_workcell::trajectory::PlanSegment;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;

/// The format of the words.
pub const FORMAT: &str = "platewash-edit/1";

/// What the scenario with some changes looks like, planned and proved.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CellQuestion {
    /// The page that asks.
    pub session: String,
    /// The scenario.
    pub text: String,
    /// Changes to it, in order.
    pub edits: Vec<Edit>,
    /// How far to go.
    pub want: Want,
    /// Id of the arm that the page has.
    pub arm: Option<String>,
}

/// A change to a scenario.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Edit {
    /// The key.
    pub key: String,
    /// Its new value; `None` takes it out.
    pub value: Option<Value>,
}

/// How far to go.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Want {
    /// To the guess.
    Preview,
    /// To the proof.
    Proof,
}

/// Where a plate could be washed, the others as they lie.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MapQuestion {
    /// The page that asks.
    pub session: String,
    /// The scenario.
    pub text: String,
    /// The plate.
    pub plate: usize,
}

/// To write the scenario, and what comes of it beside it.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SaveQuestion {
    /// The page that asks.
    pub session: String,
    /// The scenario.
    pub text: String,
    /// SHA-256 of what the page takes to stand on disk; `None` for nothing.
    pub disk: Option<String>,
    /// Whether to write whatever stands there.
    pub force: bool,
}

/// Whether what stands on disk has changed.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DiskQuestion {
    /// The page that asks.
    pub session: String,
    /// SHA-256 of what the page takes to stand there.
    pub disk: Option<String>,
}

/// A line of the answer to a [`CellQuestion`].
#[derive(Debug, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum CellLine<'a> {
    /// The scenario with the changes.
    Scenario {
        /// Its text, comments and order kept.
        text: &'a str,
        /// What the text states.
        stated: &'a BTreeMap<String, Value>,
        /// What counts, defaults filled in; empty where it is no scenario.
        values: &'a BTreeMap<String, Value>,
        /// How long it took.
        ms: Milliseconds,
    },
    /// What there is before anything is planned.
    Cell(Box<CellParts<'a>>),
    /// A guess, plate by plate.
    Preview {
        /// The plates.
        plates: Vec<PlateChance>,
        /// How long it took.
        ms: Milliseconds,
    },
    /// Planned, not proved.
    Plan(Box<PlanParts<'a>>),
    /// No plan.
    Unplanned {
        /// The first line.
        headline: &'a str,
        /// Why, in full.
        reason: &'a str,
        /// Whether it is known that there is none.
        proved: bool,
        /// The plates concerned.
        plates: &'a [Unwashable],
        /// How long it took.
        ms: Milliseconds,
    },
    /// Where else a plate could lie.
    Place {
        /// The plate.
        plate: usize,
        /// The nearest centre found \[m\].
        nearest_m: Option<[f64; 2]>,
        /// How far was looked \[m\].
        searched_m: f64,
        /// How long it took.
        ms: Milliseconds,
    },
    /// The proof, behind the plan.
    Proof {
        /// The certificate.
        certificate: &'a view::Certificate,
        /// Its first line.
        headline: &'a str,
        /// What of each plate is proved to be swept.
        proved: Vec<PlateProof>,
        /// How long it took.
        ms: Milliseconds,
    },
}

/// The end of an answer before all is told; nothing follows.
#[derive(Debug, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum EndLine<'a> {
    /// It is no scenario, or states no job, or not what is asked about.
    Refused {
        /// Why.
        #[serde(flatten)]
        refusal: &'a Refusal,
        /// How long it took.
        ms: Milliseconds,
    },
    /// A later question of the same page came.
    Superseded,
    /// Too much work, a file that cannot be written, or a fault of the program.
    Failed {
        /// What is wrong.
        words: &'a str,
    },
}

/// Why a scenario is refused.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Refusal {
    /// In words.
    pub words: String,
    /// The key at fault, where one is.
    pub key: Option<String>,
    /// Its line in the text, from 1.
    pub line: Option<usize>,
}

/// What there is before anything is planned.
#[derive(Debug, Serialize)]
pub struct CellParts<'a> {
    /// What it is about.
    pub heading: &'a view::Heading,
    /// The arm, where the page does not have it.
    pub arm: Option<ArmLine<'a>>,
    /// Its id.
    pub arm_id: &'a str,
    /// The tool.
    pub tool: &'a Option<Tool>,
    /// What stands around.
    pub surroundings: &'a view::Surroundings,
    /// The plates.
    pub plates: &'a [view::Plate],
    /// Their centres \[m\].
    pub centres_m: Vec<[f64; 2]>,
    /// Their radii \[m\].
    pub radius_m: Vec<f64>,
    /// Whether the text lists the plates.
    pub listed: bool,
    /// How plates and what stands around are moved.
    pub moves: Moves,
    /// Where the arm is at home \[rad\].
    pub pose_rad: [f64; 6],
    /// What is to be said about how plates lie.
    pub findings: Vec<FindingLine>,
    /// How long it took.
    pub ms: Milliseconds,
}

/// How the things of a cell are moved.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Moves {
    /// Plates.
    pub plates: PlateMoves,
    /// What stands around, body by body.
    pub bodies: Vec<BodyMove>,
}

/// What says where plates are.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "by", rename_all = "snake_case")]
pub enum PlateMoves {
    /// `layout.positions_m`, which lists all of them.
    Positions,
    /// The `[[plate]]` sections.
    Sections {
        /// Of each plate its section.
        sections: Vec<usize>,
        /// Of each section its place \[m\].
        at_m: Vec<[f64; 3]>,
    },
    /// They are not moved.
    Nothing {
        /// Why.
        words: &'static str,
    },
}

/// What says where a body is that stands around.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BodyMove {
    /// The key; none where it is not moved.
    pub key: Option<String>,
    /// Its value \[m\], x and y first.
    pub at_m: Vec<f64>,
    /// Why it is not moved.
    pub words: Option<String>,
    /// The plates that it holds, by their index, with which it goes; none where it holds every plate.
    pub holds: Option<Vec<usize>>,
}

/// An arm and its id.
#[derive(Debug, Serialize)]
pub struct ArmLine<'a> {
    /// The id.
    pub id: &'a str,
    /// The arm.
    pub arm: &'a view::Arm,
}

/// What is to be said about how plates lie.
#[derive(Debug, Serialize)]
pub struct FindingLine {
    /// In words.
    pub words: String,
    /// The plates.
    pub plates: Vec<usize>,
}

/// A guess about a plate.
#[derive(Debug, Serialize)]
pub struct PlateChance {
    /// The plate.
    pub plate: usize,
    /// The guess.
    pub chance: Chance,
    /// It in words.
    pub words: &'static str,
}

/// A plan as it is shown.
#[derive(Debug, Serialize)]
pub struct PlanParts<'a> {
    /// What it is about.
    pub heading: &'a view::Heading,
    /// The first line.
    pub headline: String,
    /// What the tip follows.
    pub paths: &'a [view::WashPath],
    /// The stretches of the motion.
    pub segments: &'a [PlanSegment],
    /// The motion.
    pub motion: &'a Option<view::Motion>,
    /// The smallest distance over time.
    pub clearance: &'a Option<view::Clearance>,
    /// How plates get swept.
    pub coverage: &'a [view::PlateCoverage],
    /// How long it took.
    pub ms: Milliseconds,
}

/// What of a plate is proved to be swept or, where the job says what counts as contact, pressed.
#[derive(Debug, Serialize)]
pub struct PlateProof {
    /// The plate.
    pub plate: usize,
    /// The least share.
    pub at_least: f64,
}

/// A plate that cannot be washed, or that no way to wash was found for.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Unwashable {
    /// The plate.
    pub plate: usize,
    /// Whether it is known that it cannot.
    pub proved: bool,
    /// In words.
    pub words: String,
    /// What keeps parts of it from being washed.
    pub causes: Vec<String>,
    /// Share of its wash path for which configurations were found.
    pub share: Option<f64>,
    /// Contact points for which configurations were found, world frame \[m\].
    pub free_m: Vec<[f64; 3]>,
    /// Contact points for which none were, world frame \[m\].
    pub dead_m: Vec<[f64; 3]>,
}

/// A line of the answer to a [`MapQuestion`].
#[derive(Debug, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum MapLine<'a> {
    /// Squares of one size.
    Map {
        /// Their edge \[m\].
        step_m: f64,
        /// Middles of those where the plate could be washed \[m\].
        washable_m: &'a [[f64; 2]],
        /// Middles of the others \[m\].
        unwashable_m: &'a [[f64; 2]],
        /// Squares looked at so far.
        done: usize,
        /// Squares in all, as far as is known.
        of: usize,
    },
    /// All is told.
    MapDone {
        /// What it means.
        words: &'a str,
        /// How long it took.
        ms: Milliseconds,
    },
}

/// The answer to a [`SaveQuestion`].
#[derive(Debug, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum SaveLine<'a> {
    /// It stands on disk.
    Saved {
        /// SHA-256 of it.
        disk: &'a str,
        /// Where.
        file: &'a str,
        /// All that was written.
        files: &'a [String],
        /// What came of it.
        words: &'a str,
    },
    /// Something else stands there.
    Conflict {
        /// SHA-256 of that; `None` for nothing.
        disk: Option<&'a str>,
        /// That, where it is text.
        text: Option<&'a str>,
        /// What is wrong.
        words: &'a str,
    },
}

/// The answer to a [`DiskQuestion`].
#[derive(Debug, Serialize)]
#[serde(tag = "kind", rename = "disk")]
pub struct DiskLine<'a> {
    /// SHA-256 of what stands there; `None` for nothing.
    pub disk: Option<&'a str>,
    /// It, where it differs from what the page knows.
    pub text: Option<&'a str>,
    /// Why it cannot be read.
    pub words: Option<&'a str>,
}

/// What a page needs that comes from a server that is gone.
#[derive(Debug, Serialize)]
#[serde(tag = "kind", rename = "hello")]
pub struct HelloLine<'a> {
    /// [`FORMAT`].
    pub format: &'a str,
    /// Where it is saved.
    pub file: Option<&'a str>,
    /// SHA-256 of what stands there.
    pub disk: Option<&'a str>,
}
