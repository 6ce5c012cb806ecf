//! The frames in which tool poses are stated, by name.

use crate::frame::Frame;
use crate::model::RobotModel;
use crate::rotation::{Rigid, from_rpy};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use std::f64::consts::FRAC_PI_2;

/// The frame in which tool poses are stated and returned.
///
/// ROS-Industrial's `tool0` has z leaving the flange. MATLAB's `loadrobot("abbIrb120")` has a body called
/// `tool0` that equals the last link, with **x** leaving the flange: the same numbers mean another pose
/// there. Both are here by name, so that nobody has to guess.
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
    /// All of them, in the order of their declaration.
    pub const ALL: [Self; 3] = [Self::Flange, Self::Tool0, Self::MatlabTool0];

    /// The name used in files and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Flange => "flange",
            Self::Tool0 => "tool0",
            Self::MatlabTool0 => "matlab_tool0",
        }
    }
}

/// A tool frame that the arm's description cannot provide.
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
}

impl RobotModel {
    /// The frame of a named link (any link of the description).
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

    /// The frame called [`ToolFrame`] on this arm.
    ///
    /// # Errors
    /// [`ToolFrameError::Missing`] when the description has no `tool0` behind joint 6.
    pub fn tool_frame(&self, which: ToolFrame) -> Result<Frame, ToolFrameError> {
        let behind_joint_6 = |name: &str| self.links().iter().find(|l| l.name == name && l.frame.body() == 6);
        match which {
            ToolFrame::Flange => Ok(behind_joint_6("flange").map_or(self.last_link_frame(), |l| l.frame)),
            ToolFrame::Tool0 => behind_joint_6("tool0")
                .map(|l| l.frame)
                .ok_or_else(|| self.missing("tool0")),
            ToolFrame::MatlabTool0 => Ok(self.last_link_frame()),
        }
    }

    /// Whether the description says by itself how a tool leaves the flange: it has a `tool0` behind joint 6.
    #[must_use]
    pub fn states_its_mounting_frame(&self) -> bool {
        self.tool_frame(ToolFrame::Tool0).is_ok()
    }

    /// The frame in which a tool is mounted: its z axis leaves the flange. It is `tool0` where the
    /// description has one, otherwise the flange turned by 90° about y (ROS-Industrial's flange has x out).
    #[must_use]
    pub fn mounting_frame(&self) -> Frame {
        self.tool_frame(ToolFrame::Tool0).unwrap_or_else(|_| {
            let turn = Rigid {
                rotation: from_rpy([0.0, FRAC_PI_2, 0.0]),
                translation: Vector3::zeros(),
            };
            self.tool_frame(ToolFrame::Flange)
                .unwrap_or(self.last_link_frame())
                .offset(&turn)
        })
    }

    fn missing(&self, link: &str) -> ToolFrameError {
        let found: Vec<_> = self
            .links()
            .iter()
            .filter(|l| l.frame.body() == 6)
            .map(|l| l.name.as_str())
            .collect();
        ToolFrameError::Missing {
            robot: self.name().to_owned(),
            link: link.to_owned(),
            found: found.join(", "),
        }
    }
}
