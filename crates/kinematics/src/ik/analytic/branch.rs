//! Branches of a target: their names, and the borders where they meet.

use crate::joints::JointVector;
use serde::Serialize;
use std::f64::consts::{PI, TAU};
use std::fmt;

/// Configuration that brings body 6 to the target; limits are not checked.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Branch {
    /// Joint positions in (−π, π] \[rad\].
    pub q: JointVector,
    /// Name of the branch.
    pub label: Label,
    /// Degeneracies of the branch.
    pub degenerate: Degeneracies,
}

impl Branch {
    /// Returns the branch with its joints turned into (−π, π].
    pub(crate) fn new(q: JointVector, label: Label, degenerate: Degeneracies) -> Self {
        Self {
            q: q.map(principal),
            label,
            degenerate,
        }
    }
}

/// Returns the angle in (−π, π] \[rad\], up to rounding.
pub(crate) fn principal(angle: f64) -> f64 {
    if -PI < angle && angle <= PI {
        return angle;
    }
    let turned = angle - TAU * (angle / TAU).round();
    if turned <= -PI { turned + TAU } else { turned }
}

/// Side of axis 1 on which the wrist centre lies, in the direction the arm faces. The two meet in the plane that holds axis 1 and is
/// parallel to axis 2.
///
/// The front is the side of axis 2; if axes 1 and 2 meet, the side of the wrist centre at q = 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Shoulder {
    /// The wrist centre is in front.
    Front,
    /// The wrist centre is behind, over the arm's shoulder.
    Back,
}

/// Side to which the forearm is bent out of the upper arm's line. The two meet at full stretch and full fold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Elbow {
    /// Bent outwards and down: towards the front when [`Shoulder::Front`], towards the back when [`Shoulder::Back`], so
    /// that the elbow is above the line from shoulder to wrist centre for a wrist centre further out.
    Up,
    /// Bent the other way.
    Down,
}

/// Sense of axis 5 (as the description directs it) against axes 4 and 6. The two meet where axes 4 and 6 are parallel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Wrist {
    /// Axis 5 points along axis 4 × axis 6.
    Plain,
    /// Axis 5 points against axis 4 × axis 6.
    Flipped,
}

/// Name of a branch. It depends on the positions of the arm's axes, not on zero positions or turns, and so stays the same along any path
/// that crosses no singularity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Label {
    /// Shoulder side.
    pub shoulder: Shoulder,
    /// Elbow side.
    pub elbow: Elbow,
    /// Wrist sense.
    pub wrist: Wrist,
    /// Which of the branches on these sides it is: 0 for all of an arm with eight branches.
    #[serde(skip_serializing_if = "is_first")]
    pub number: u8,
}

/// True for the only branch on its sides, or the first: its number is left out.
#[allow(clippy::trivially_copy_pass_by_ref)] // the signature that serde asks for
fn is_first(number: &u8) -> bool {
    *number == 0
}

impl Label {
    /// The labels of an arm with eight branches: front before back, then up before down, then plain before flipped.
    pub const EIGHT: [Self; 8] = {
        use {Elbow::*, Shoulder::*, Wrist::*};
        [
            Self::new(Front, Up, Plain),
            Self::new(Front, Up, Flipped),
            Self::new(Front, Down, Plain),
            Self::new(Front, Down, Flipped),
            Self::new(Back, Up, Plain),
            Self::new(Back, Up, Flipped),
            Self::new(Back, Down, Plain),
            Self::new(Back, Down, Flipped),
        ]
    };

    /// Returns the label of the only branch on its sides, or the first.
    #[must_use]
    pub const fn new(shoulder: Shoulder, elbow: Elbow, wrist: Wrist) -> Self {
        let number = 0;
        Self {
            shoulder,
            elbow,
            wrist,
            number,
        }
    }

    /// Returns the label of another branch on the same sides.
    #[must_use]
    pub const fn numbered(self, number: u8) -> Self {
        Self { number, ..self }
    }

    /// Position among the branches of an arm: that in [`Label::EIGHT`], and eight for each number before.
    #[must_use]
    pub const fn index(self) -> usize {
        8 * self.number as usize + 4 * self.shoulder as usize + 2 * self.elbow as usize + self.wrist as usize
    }

    /// Returns the label at a position.
    #[must_use]
    pub(crate) const fn at(index: usize) -> Self {
        Self::EIGHT[index % 8].numbered((index / 8) as u8)
    }
}

impl fmt::Display for Label {
    /// Shoulder, elbow and wrist in words: "front up plain"; behind them the count of a further branch on these sides, "front up plain 2".
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words = format!("{:?} {:?} {:?}", self.shoulder, self.elbow, self.wrist);
        f.write_str(&words.to_lowercase())?;
        match self.number {
            0 => Ok(()),
            number => write!(f, " {}", u32::from(number) + 1),
        }
    }
}

/// Degeneracies of a branch: it meets its neighbour, or leaves a joint free.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Degeneracies {
    /// Front and back meet; with b = 0 joint 1 is free and keeps its previous value.
    pub shoulder: bool,
    /// Elbow up and down meet (full stretch or full fold).
    pub elbow: bool,
    /// Axes 4 and 6 are parallel: joint 4 is free and keeps its previous value.
    pub wrist: bool,
}

/// Border of the reachable space that the wrist centre is beyond.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ReachBorder {
    /// Too far from axis 2: the arm at full stretch.
    Stretch,
    /// Too close to axis 2: the arm fully folded.
    Fold,
    /// Too close to axis 1: inside the column of radius |b|.
    Column,
}

/// Wrist centre that one shoulder side cannot reach.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, thiserror::Error)]
#[error("the wrist centre is {by_m:.3e} m beyond {border:?}")]
pub struct OutOfReach {
    /// Border that it is beyond.
    pub border: ReachBorder,
    /// Distance of the wrist centre from that border, in the plane of the arm \[m\].
    pub by_m: f64,
}

impl OutOfReach {
    /// Greatest possible miss, the start value of a search for the least.
    pub(crate) const NOWHERE: Self = Self {
        border: ReachBorder::Stretch,
        by_m: f64::INFINITY,
    };
}
