//! Frames in which tool poses are stated, by name.

use crate::joints::AXES;
use crate::model::{Frame, Link, RobotModel};
use serde::{Deserialize, Serialize};

/// Frame in which tool poses are stated and returned.
///
/// ROS-Industrial's `tool0` has z leaving the flange. MATLAB's `loadrobot("abbIrb120")` has a body called
/// `tool0` that equals the last link, with **x** leaving the flange: the same numbers mean another pose
/// there. Both are here by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ToolFrame {
    /// The link named `flange`, or the link behind joint 6 where the description has none.
    Flange,
    /// ROS-Industrial's `tool0`: the link of that name; z leaves the flange.
    Tool0,
    /// MATLAB's `tool0`: the link behind joint 6; x leaves the flange.
    MatlabTool0,
}

impl ToolFrame {
    /// All frames, in the order of their declaration.
    pub const ALL: [Self; 3] = [Self::Flange, Self::Tool0, Self::MatlabTool0];

    /// Returns the name used in files and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Flange => "flange",
            Self::Tool0 => "tool0",
            Self::MatlabTool0 => "matlab_tool0",
        }
    }
}

/// Tool frame that the arm's description cannot provide.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ToolFrameError {
    /// The description has no link of that name.
    #[error("robot '{robot}' has no link named '{link}' behind joint 6; links there: {found}")]
    Missing {
        /// Robot name.
        robot: String,
        /// Link asked for.
        link: String,
        /// Links rigidly attached behind joint 6.
        found: String,
    },
    /// No link behind joint 6 has the stated name, or the description does not tell which link carries the tool.
    #[error(
        "robot '{robot}' {reason}; state the link that carries the tool, and its axis along which the tool leaves it, as tool.mounted_on = \
         \"LINK:AXIS\" (--tool-mount LINK:AXIS). Links behind joint 6: {candidates}"
    )]
    NoMount {
        /// Robot name.
        robot: String,
        /// Reason.
        reason: String,
        /// Links behind joint 6, each with its axis that leads out of the arm.
        candidates: String,
    },
}

impl RobotModel {
    /// Returns the frame of a named link (any link of the description).
    ///
    /// # Errors
    /// [`ToolFrameError::Missing`] when no link has that name.
    pub fn frame(&self, link: &str) -> Result<Frame, ToolFrameError> {
        self.links()
            .iter()
            .find(|l| l.name == link)
            .map(|l| l.frame)
            .ok_or_else(|| self.missing(link))
    }

    /// Returns the frame called [`ToolFrame`] on this arm.
    ///
    /// # Errors
    /// [`ToolFrameError::Missing`] when the description has no `tool0` behind joint 6.
    pub fn tool_frame(&self, which: ToolFrame) -> Result<Frame, ToolFrameError> {
        match which {
            ToolFrame::Flange => Ok(self
                .behind_joint_6("flange")
                .map_or(self.last_link_frame(), |l| l.frame)),
            ToolFrame::Tool0 => self
                .behind_joint_6("tool0")
                .map(|l| l.frame)
                .ok_or_else(|| self.missing("tool0")),
            ToolFrame::MatlabTool0 => Ok(self.last_link_frame()),
        }
    }

    pub(crate) fn links_behind_joint_6(&self) -> impl Iterator<Item = &Link> {
        self.links().iter().filter(|l| l.frame.body() == AXES)
    }

    pub(crate) fn behind_joint_6(&self, name: &str) -> Option<&Link> {
        self.links_behind_joint_6().find(|l| l.name == name)
    }

    fn missing(&self, link: &str) -> ToolFrameError {
        let found: Vec<_> = self.links_behind_joint_6().map(|l| l.name.as_str()).collect();
        ToolFrameError::Missing {
            robot: self.name().to_owned(),
            link: link.to_owned(),
            found: found.join(", "),
        }
    }
}
