//! Reason that a body that a section states could not be made.

use platewash_bodies::clearance::SolidError;
use platewash_kinematics::urdf::MeshError;
use platewash_workcell::words::printable;
use std::fmt;

/// Reason that the body of a section could not be made.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyError {
    /// List that it belongs to.
    pub section: BodySection,
    /// Index of the section, from 0.
    pub index: usize,
    /// Its name.
    pub name: String,
    /// The fault.
    pub why: BodyFault,
}

/// A list of bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BodySection {
    /// `[[obstacle]]`.
    Obstacle,
    /// `[[tool_body]]`.
    ToolBody,
}

impl BodySection {
    /// Its name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Obstacle => "obstacle",
            Self::ToolBody => "tool_body",
        }
    }

    /// The error of a body of the list.
    pub(crate) fn error(self, index: usize, name: &str, why: BodyFault) -> BodyError {
        let (section, name) = (self, name.to_owned());
        BodyError {
            section,
            index,
            name,
            why,
        }
    }

    fn noun(self) -> &'static str {
        match self {
            Self::Obstacle => "obstacle",
            Self::ToolBody => "body of the tool",
        }
    }
}

/// Fault of a body.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum BodyFault {
    /// Its mesh cannot be read; the error names the file and the reason.
    Mesh(MeshError),
    /// The mesh forms no body.
    Solid {
        /// The file.
        file: String,
        /// The fault of the mesh.
        why: SolidError,
    },
    /// It reaches farther from its origin than any body of a tool.
    Large {
        /// The file.
        file: String,
        /// Reach from the origin \[m\].
        reach_m: f64,
        /// Greatest reach allowed \[m\].
        most_m: f64,
    },
    /// Another body has its name.
    NameTaken {
        /// The other owner of the name.
        of: &'static str,
    },
}

impl fmt::Display for BodyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (noun, name) = (self.section.noun(), printable(&self.name));
        let at = format!("{}[{}]", self.section.name(), self.index);
        match &self.why {
            BodyFault::Mesh(why) => write!(f, "{at}.mesh: {noun} '{name}': {}", printable(&why.to_string())),
            BodyFault::Solid { file, why } => write!(f, "{at}.mesh: {noun} '{name}': {}: {why}", printable(file)),
            BodyFault::Large { file, reach_m, most_m } => write!(
                f,
                "{at}.mesh_scale: {noun} '{name}': {} reaches {reach_m} m from its origin, a {noun} up to {most_m} m: 0.001 each is the scale \
                 of a file in millimetres",
                printable(file)
            ),
            BodyFault::NameTaken { of } => write!(
                f,
                "{at}.name: '{name}' is the name of {of}; give the {noun} another one"
            ),
        }
    }
}

impl std::error::Error for BodyError {}
