//! Frames in which tool poses are stated, by name.

use crate::AXES;
use crate::model::{Frame, Link, RobotModel};
use nalgebra::Vector3;
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
    /// No link is stated to carry the tool, or no link behind joint 6 has the stated name.
    #[error(
        "robot '{robot}' {}; state the link that carries the tool as tool.mounted_on (--tool-mount): the tool leaves it along z, turned \
         by tool.mount_rpy_deg. Links behind joint 6, with their axis that is along axis 6: {candidates}",
        unmounted(.link.as_deref())
    )]
    NoMount {
        /// Robot name.
        robot: String,
        /// Link that was stated.
        link: Option<String>,
        /// Links behind joint 6, each with its axis that joint 6 turns about.
        candidates: String,
    },
}

fn unmounted(link: Option<&str>) -> String {
    link.map_or("has no link 'tool0' behind joint 6".to_owned(), |link| {
        format!("has no link '{}' behind joint 6", link.escape_debug())
    })
}

/// Greatest angle between axes that count as one in a message \[rad\].
const ALIGNED_RAD: f64 = 0.01;

/// Axes of a link along which a tool may leave it, and the `tool.mount_rpy_deg` that turns the tool there from z.
const TURNS: [([f64; 3], &str, &str); 6] = [
    ([0.0, 0.0, 1.0], "z", "[0, 0, 0]"),
    ([0.0, 0.0, -1.0], "-z", "[180, 0, 0]"),
    ([1.0, 0.0, 0.0], "x", "[0, 90, 0]"),
    ([-1.0, 0.0, 0.0], "-x", "[0, -90, 0]"),
    ([0.0, 1.0, 0.0], "y", "[-90, 0, 0]"),
    ([0.0, -1.0, 0.0], "-y", "[90, 0, 0]"),
];

/// Lists the links behind joint 6, each with its axis that joint 6 turns about, and the rotation of a tool that leaves z to those axes.
fn candidates<'a>(links: impl Iterator<Item = &'a Link>) -> String {
    let mut turned = Vec::new();
    let along = |link: &Link| {
        // Axis 6 in the axes of the link.
        let axis = link.frame.on_body().rotation.transpose().column(2).into_owned();
        TURNS
            .iter()
            .find(|(along, ..)| (axis - Vector3::from(*along)).norm() < ALIGNED_RAD)
    };
    let named: Vec<_> = links
        .map(|link| match along(link) {
            Some(&(_, axis, turn)) => {
                if axis != "z" && !turned.contains(&(axis, turn)) {
                    turned.push((axis, turn));
                }
                format!("'{}' ({axis})", link.name)
            }
            None => format!(
                "'{}' (z is {:.1}° from it)",
                link.name,
                link.frame.tilt_rad().to_degrees()
            ),
        })
        .collect();
    let turned = turned.iter().map(|(axis, turn)| format!("; {turn} turns it to {axis}"));
    format!("{}{}", named.join(", "), turned.collect::<String>())
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

    /// Returns the frame that carries a tool: that of a link behind joint 6, which the tool leaves along the link's z axis. `None` stands
    /// for `tool0`.
    ///
    /// # Errors
    /// [`ToolFrameError::NoMount`] for a link that is not behind joint 6, and for `None` if the description has no `tool0`.
    pub fn tool_mount(&self, link: Option<&str>) -> Result<Frame, ToolFrameError> {
        let name = link.unwrap_or(ToolFrame::Tool0.name());
        self.behind_joint_6(name)
            .map(|l| l.frame)
            .ok_or_else(|| ToolFrameError::NoMount {
                robot: self.name().to_owned(),
                link: link.map(str::to_owned),
                candidates: candidates(self.links_behind_joint_6()),
            })
    }

    fn links_behind_joint_6(&self) -> impl Iterator<Item = &Link> {
        self.links().iter().filter(|l| l.frame.body() == AXES)
    }

    fn behind_joint_6(&self, name: &str) -> Option<&Link> {
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
