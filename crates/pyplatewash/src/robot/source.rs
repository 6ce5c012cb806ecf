//! Source of an arm's description: enough to make the arm again in another process.

use crate::errors::{self, FileKind};
use crate::exception;
use platewash::RobotModel;
use platewash::kinematics::DisabledPairs;
use platewash::kinematics::irb120::{IRB120_SRDF, IRB120_URDF};
use platewash::kinematics::urdf::{Files, FixedJoints, MAX_BYTES, MeshSource};
use platewash::scenario::{RobotSection, Solids};
use pyo3::prelude::*;
use pyo3::types::{PyTuple, PyType};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Source of an arm.
#[derive(Debug, Clone)]
pub enum Source {
    /// The embedded IRB 120.
    BuiltIn,
    /// An arm from URDF and SRDF texts.
    Described(Box<Description>),
}

/// URDF and SRDF texts, with the folders in which their meshes are found.
#[derive(Debug, Clone)]
pub struct Description {
    /// URDF text.
    pub urdf: String,
    /// SRDF text.
    pub srdf: Option<String>,
    /// Folders of packages.
    pub package_path: Vec<PathBuf>,
    /// Folder that relative names of meshes start from.
    pub folder: Option<PathBuf>,
    /// True where visuals stand for missing collision shapes.
    pub visual_shapes: bool,
    /// Links that count as convex parts that enclose their meshes.
    pub split_links: Vec<String>,
    /// Joints that are held still, with their positions.
    pub fixed: FixedJoints,
}

impl Source {
    /// From the files of a section; the built-in one if it names none.
    ///
    /// # Errors
    /// `UrdfError` for a file that cannot be read.
    pub fn files(py: Python<'_>, section: &RobotSection, files: &Files) -> PyResult<Self> {
        let Some(urdf) = &section.urdf else {
            return Ok(Self::BuiltIn);
        };
        let read = |path: &Path| {
            files
                .read_text(path, MAX_BYTES as u64)
                .map_err(|e| errors::unread(py, FileKind::Urdf, path, &e))
        };
        // A path without folder is in the working folder, which may be another one when the arm is restored.
        let folder = std::path::absolute(urdf)
            .ok()
            .and_then(|path| path.parent().map(Path::to_path_buf));
        Ok(Self::Described(Box::new(Description {
            urdf: read(urdf)?,
            srdf: section.srdf.as_deref().map(read).transpose()?,
            package_path: section.package_path.clone(),
            folder,
            visual_shapes: section.visual_shapes,
            split_links: section.split_links.clone(),
            fixed: section.fixed.clone(),
        })))
    }

    /// The SRDF text, if there is one.
    pub fn srdf(&self) -> Option<&str> {
        match self {
            Self::BuiltIn => Some(IRB120_SRDF),
            Self::Described(description) => description.srdf.as_deref(),
        }
    }

    /// Folders in which packages are looked up.
    pub fn package_path(&self) -> &[PathBuf] {
        match self {
            Self::BuiltIn => &[],
            Self::Described(description) => &description.package_path,
        }
    }

    /// The URDF text.
    pub fn urdf(&self) -> &str {
        match self {
            Self::BuiltIn => IRB120_URDF,
            Self::Described(description) => &description.urdf,
        }
    }

    /// The arm.
    ///
    /// # Errors
    /// `UrdfError`, naming the joint or link at fault.
    pub fn load(&self, py: Python<'_>) -> PyResult<RobotModel> {
        let Self::Described(description) = self else {
            return RobotModel::irb120().map_err(|e| exception::internal(py, &e.to_string()));
        };
        let wrong = |e: &dyn std::error::Error| exception::named(py, "UrdfError", &e.to_string());
        let files = platewash::cli::installed_files();
        let meshes = MeshSource::new(&description.package_path, description.folder.as_deref())
            .reading(&files)
            .with_visual_shapes(description.visual_shapes)
            .with_split_links(&description.split_links, Arc::new(Solids::default()));
        let robot = RobotModel::from_urdf_with_fixed(&description.urdf, &meshes, &description.fixed);
        let robot = robot.map_err(|e| wrong(&e))?;
        robot.check_held(&description.fixed).map_err(|e| wrong(&e))?;
        let Some(srdf) = &description.srdf else {
            return Ok(robot);
        };
        let disabled = DisabledPairs::parse(srdf).map_err(|e| wrong(&e))?;
        robot.with_disabled_pairs(disabled).map_err(|e| wrong(&e))
    }

    /// Returns the function, with its arguments, that pickle calls to make the arm again; meshes are read again from their files.
    ///
    /// # Errors
    /// Out of memory.
    pub fn reduce<'py>(
        &self,
        py: Python<'py>,
        class: &Bound<'py, PyType>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        match self {
            Self::BuiltIn => Ok((class.getattr("irb120")?, PyTuple::empty(py))),
            Self::Described(d) => {
                let arguments = (
                    &d.urdf,
                    &d.srdf,
                    &d.package_path,
                    &d.folder,
                    d.visual_shapes,
                    &d.split_links,
                    &d.fixed,
                );
                Ok((class.getattr("_restore")?, arguments.into_pyobject(py)?))
            }
        }
    }
}
