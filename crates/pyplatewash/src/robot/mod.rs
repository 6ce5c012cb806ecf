//! `Robot`: the arm as Python sees it.

mod batch;
mod settings;
mod source;

pub use crate::robot::settings::settings;

use crate::argument::{self, ROBOT};
use crate::robot::settings::Solvers;
use crate::robot::source::{Description, Source};
use crate::tool::ToolFields;
use crate::warnings::warn;
use crate::{arrays, exception};
use numpy::PyArrayDyn;
use platewash::kinematics::urdf::{Files, FixedJoints};
use platewash::scenario::{MeshPlaces, Note, RobotSection};
use platewash::{Axes, Frame, IkSolver, RobotModel, Scenario, ToolFrame};
use pyo3::prelude::*;
use pyo3::types::{PyTuple, PyType};
use std::sync::Arc;

/// A six-axis arm. Immutable.
///
/// Angles are radians, lengths metres. A pose is a 4 × 4 matrix `T_base_frame`. `q` is an array of shape (6,), or (N, 6) for
/// many configurations at once.
///
/// The frame of a pose is called by name: `"tool0"` (ROS-Industrial's: z leaves the flange), `"flange"`, `"matlab_tool0"`
/// (MATLAB's `tool0`: x leaves the flange) or any link. Without a name it is `tool0`, or what stands for it on arms without
/// one; with `tool=Tool(...)` it is the tool's tip.
#[pyclass(frozen, module = "pyplatewash")]
pub struct Robot {
    model: Arc<RobotModel>,
    source: Source,
    solvers: Solvers,
}

impl Robot {
    fn new(model: Arc<RobotModel>, source: Source) -> Self {
        Self {
            model,
            source,
            solvers: Solvers::default(),
        }
    }

    /// The arm.
    #[must_use]
    pub fn model(&self) -> &Arc<RobotModel> {
        &self.model
    }

    /// Places in which meshes of obstacles are looked up: those of the arm's packages, and those that ROS has installed.
    #[must_use]
    pub fn mesh_places(&self) -> MeshPlaces {
        MeshPlaces {
            package_path: self.source.package_path().to_vec(),
            files: platewash::cli::installed_files(),
        }
    }

    /// The built-in arm.
    ///
    /// # Errors
    /// None in practice.
    pub fn built_in(py: Python<'_>) -> PyResult<Py<Self>> {
        let model = RobotModel::irb120().map_err(|e| exception::internal(py, &e.to_string()))?;
        Py::new(py, Self::new(Arc::new(model), Source::BuiltIn))
    }

    /// The arm of the argument called `robot`, if it is given.
    ///
    /// # Errors
    /// `InputTypeError` for what is no arm.
    pub fn given<'a, 'py>(value: Option<&'a Bound<'py, PyAny>>) -> PyResult<Option<&'a Bound<'py, Self>>> {
        argument::maybe("robot", value, ROBOT)
    }

    /// The arm of a scenario, which was made of that section's files just now.
    ///
    /// # Errors
    /// `UrdfError` for files that can no longer be read.
    pub fn of_scenario(py: Python<'_>, scenario: &Scenario, model: Arc<RobotModel>) -> PyResult<Py<Self>> {
        Py::new(
            py,
            Self::new(model, Source::files(py, &scenario.robot, &scenario.files)?),
        )
    }

    /// The solver for a frame, kept from an earlier call or new.
    fn solver(
        &self,
        py: Python<'_>,
        frame: Frame,
        settings: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Arc<IkSolver<'static>>> {
        self.solvers.solver(py, &self.model, frame, settings)
    }

    fn frame(
        &self,
        py: Python<'_>,
        name: Option<&Bound<'_, PyAny>>,
        tool: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Frame> {
        match (name, tool) {
            (None, None) => {
                let frame = self.model.tool_frame(ToolFrame::Tool0);
                frame.map_err(|e| exception::input(py, "frame", &e.to_string()))
            }
            (None, Some(tool)) => {
                let tool = ToolFields::read(tool)?.on(py, &self.model)?;
                Ok(tool.tip_frame(&self.model))
            }
            (Some(_), Some(_)) => Err(exception::input(
                py,
                "frame",
                "give either a frame or a tool, whose tip is meant",
            )),
            (Some(name), None) => {
                let name = argument::text("frame", name, "a frame's name")?;
                let known = ToolFrame::ALL.into_iter().find(|f| f.name() == name);
                let frame = known.map_or_else(|| self.model.frame(&name), |known| self.model.tool_frame(known));
                frame.map_err(|e| exception::input(py, "frame", &e.to_string()))
            }
        }
    }
}

#[pymethods]
impl Robot {
    /// The built-in ABB IRB 120.
    #[classmethod]
    fn irb120(_class: &Bound<'_, PyType>, py: Python<'_>) -> PyResult<Py<Self>> {
        Self::built_in(py)
    }

    /// An arm from expanded URDF text (no xacro) with six revolute axes in series.
    ///
    /// `srdf` is SRDF text with the pairs of links that need no collision check. `package_path` is a folder, or a list of them, in which
    /// `package://` meshes are looked up, `folder` is the one that relative mesh names start from. With `visual_shapes`, links without
    /// collision shapes take their visuals as such, meshes as convex hulls. The meshes of `split_links`, a list of names, count as a few convex
    /// parts that enclose them, not as their hulls. `fixed` holds joints still that are not of the arm, such as those of a gripper or a rail: a
    /// dict of their names with positions (rad, or m for a prismatic joint).
    ///
    /// Raises UrdfError, naming the joint or link at fault.
    #[classmethod]
    #[expect(clippy::too_many_arguments, reason = "Python's keywords")]
    #[pyo3(signature = (text, *, srdf=None, package_path=None, folder=None, visual_shapes=None, split_links=None, fixed=None), text_signature = "(text, *, srdf=None, package_path=None, folder=None, visual_shapes=False, split_links=None, fixed=None)")]
    fn from_urdf(
        _class: &Bound<'_, PyType>,
        py: Python<'_>,
        text: &Bound<'_, PyAny>,
        srdf: Option<&Bound<'_, PyAny>>,
        package_path: Option<&Bound<'_, PyAny>>,
        folder: Option<&Bound<'_, PyAny>>,
        visual_shapes: Option<&Bound<'_, PyAny>>,
        split_links: Option<&Bound<'_, PyAny>>,
        fixed: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let source = Source::Described(Box::new(Description {
            urdf: argument::text("text", text, "URDF text")?,
            srdf: srdf.map(|srdf| argument::text("srdf", srdf, "SRDF text")).transpose()?,
            package_path: argument::paths("package_path", package_path)?,
            folder: folder.map(|folder| argument::path("folder", folder)).transpose()?,
            visual_shapes: argument::flag_or_false("visual_shapes", visual_shapes)?,
            split_links: argument::names("split_links", split_links)?,
            fixed: argument::positions("fixed", fixed)?,
        }));
        Ok(Self::new(Arc::new(source.load(py)?), source))
    }

    /// An arm from an expanded URDF file, with an SRDF file if given; meshes are looked up beside it and in `package_path`, a
    /// folder or a list of them. With `visual_shapes`, links without collision shapes take their visuals as such, meshes as convex hulls.
    /// The meshes of `split_links`, a list of names, count as a few convex parts that enclose them, not as their hulls. `fixed` holds joints
    /// still that are not of the arm, such as those of a gripper or a rail: a dict of their names with positions (rad, or m for a prismatic
    /// joint).
    ///
    /// Raises UrdfError, naming the joint or link at fault; for a file that cannot be read it is a FileError, too.
    #[classmethod]
    #[expect(clippy::too_many_arguments, reason = "Python's keywords")]
    #[pyo3(signature = (urdf, *, srdf=None, package_path=None, visual_shapes=None, split_links=None, fixed=None), text_signature = "(urdf, *, srdf=None, package_path=None, visual_shapes=False, split_links=None, fixed=None)")]
    fn load(
        _class: &Bound<'_, PyType>,
        py: Python<'_>,
        urdf: &Bound<'_, PyAny>,
        srdf: Option<&Bound<'_, PyAny>>,
        package_path: Option<&Bound<'_, PyAny>>,
        visual_shapes: Option<&Bound<'_, PyAny>>,
        split_links: Option<&Bound<'_, PyAny>>,
        fixed: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let section = RobotSection {
            urdf: Some(argument::path("urdf", urdf)?),
            srdf: srdf.map(|srdf| argument::path("srdf", srdf)).transpose()?,
            package_path: argument::paths("package_path", package_path)?,
            visual_shapes: argument::flag_or_false("visual_shapes", visual_shapes)?,
            split_links: argument::names("split_links", split_links)?,
            fixed: argument::positions("fixed", fixed)?,
            ..RobotSection::default()
        };
        let source = Source::files(py, &section, &Files::default())?;
        let model = Arc::new(source.load(py)?);
        warn(py, &Note::of_arm(&model))?;
        Ok(Self::new(model, source))
    }

    /// Name in the description.
    #[getter]
    fn name(&self) -> &str {
        self.model.name()
    }

    /// SHA-256 of the URDF text, in hexadecimal.
    #[getter]
    fn sha256(&self) -> &str {
        self.model.sha256()
    }

    /// URDF text of the arm, for other programs.
    #[getter]
    fn urdf(&self) -> &str {
        self.source.urdf()
    }

    /// SRDF text with the pairs of links that need no collision check, None for an arm without.
    #[getter]
    fn srdf(&self) -> Option<&str> {
        self.source.srdf()
    }

    /// Names of the six joints, from the base to the tip.
    #[getter]
    fn joint_names(&self) -> Vec<&str> {
        self.model.joints().iter().map(|j| j.name.as_str()).collect()
    }

    /// Names of all links, from the root outwards.
    #[getter]
    fn link_names(&self) -> Vec<&str> {
        self.model.links().iter().map(|l| l.name.as_str()).collect()
    }

    /// Positions of the joints of the description that are held still, by name [rad, or m for a prismatic joint].
    #[getter]
    fn fixed_joints(&self) -> FixedJoints {
        self.model.fixed_joints().clone()
    }

    /// Names of the links that are left out, as joints carry them that follow an axis: no clearance of them is known.
    #[getter]
    fn left_out_links(&self) -> Vec<&str> {
        self.model.left_out_links().iter().map(|l| l.link.as_str()).collect()
    }

    /// Lowest joint positions, shape (6,) [rad]; -inf for a continuous joint.
    #[getter]
    fn lower<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        arrays::array(py, &[6], self.model.limits().lower.as_slice())
    }

    /// Highest joint positions, shape (6,) [rad]; inf for a continuous joint.
    #[getter]
    fn upper<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        arrays::array(py, &[6], self.model.limits().upper.as_slice())
    }

    /// Highest joint speeds, shape (6,) [rad/s].
    #[getter]
    fn velocity<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        arrays::array(py, &[6], self.model.limits().velocity.as_slice())
    }

    /// Highest joint torques [N·m], None where the description states none.
    #[getter]
    fn effort(&self) -> [Option<f64>; 6] {
        self.model.limits().effort
    }

    /// Distance of each joint from its nearer limit [rad], shape of `q`; negative outside.
    fn limit_margins<'py>(&self, py: Python<'py>, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        batch::limit_margins(&self.model, py, q)
    }

    /// Pose `T_base_frame` at `q`: shape (6,) gives (4, 4), (N, 6) gives (N, 4, 4). Limits are not checked; NaN in, NaN out.
    #[pyo3(signature = (q, frame=None, *, tool=None))]
    fn fk<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        frame: Option<&Bound<'_, PyAny>>,
        tool: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        batch::fk(&self.model, py, q, &self.frame(py, frame, tool)?)
    }

    /// Geometric Jacobian of a frame at `q`: shape (6,) gives (6, 6), (N, 6) gives (N, 6, 6).
    ///
    /// Rows 0-2 are the velocity of the frame's origin [m/s per rad/s], rows 3-5 the angular velocity, in the axes of the base
    /// (`axes="base"`) or of the frame (`axes="local"`).
    #[pyo3(signature = (q, frame=None, *, tool=None, axes=None), text_signature = "($self, q, frame=None, *, tool=None, axes='base')")]
    fn jacobian<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        frame: Option<&Bound<'_, PyAny>>,
        tool: Option<&Bound<'_, PyAny>>,
        axes: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let words = [("base", Axes::Base), ("local", Axes::Local)];
        let axes = axes.map_or(Ok(Axes::Base), |axes| argument::word("axes", axes, &words))?;
        batch::jacobian(&self.model, py, q, &self.frame(py, frame, tool)?, axes)
    }

    /// Yoshikawa's manipulability `|det J|` of a frame at `q` [m³]: shape (6,) gives a number, (N, 6) gives (N,).
    #[pyo3(signature = (q, frame=None, *, tool=None))]
    fn manipulability<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        frame: Option<&Bound<'_, PyAny>>,
        tool: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        batch::manipulability(&self.model, py, q, &self.frame(py, frame, tool)?)
    }

    /// A configuration within the limits that brings the frame to `target`, shape (4, 4), found from `seed`, shape (6,), by
    /// default zeros.
    ///
    /// Raises IkError with the best configuration found and the cause.
    #[pyo3(signature = (target, seed=None, frame=None, *, tool=None, settings=None))]
    fn ik<'py>(
        &self,
        py: Python<'py>,
        target: &Bound<'py, PyAny>,
        seed: Option<&Bound<'py, PyAny>>,
        frame: Option<&Bound<'py, PyAny>>,
        tool: Option<&Bound<'py, PyAny>>,
        settings: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let frame = self.frame(py, frame, tool)?;
        batch::one(&*self.solver(py, frame, settings)?, py, target, seed)
    }

    /// Every configuration within the limits that brings the frame to `target`, shape (4, 4), with the names of their branches,
    /// and why the other branches are none. `previous`, shape (6,), decides joints that are free at singularities.
    ///
    /// Raises InputError for an arm without closed form: see docs/cells.md, or what `platewash robot` says of it.
    #[pyo3(signature = (target, previous=None, frame=None, *, tool=None))]
    fn ik_all<'py>(
        &self,
        py: Python<'py>,
        target: &Bound<'py, PyAny>,
        previous: Option<&Bound<'py, PyAny>>,
        frame: Option<&Bound<'_, PyAny>>,
        tool: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let frame = self.frame(py, frame, tool)?;
        batch::all(&*self.solver(py, frame, None)?, py, target, previous)
    }

    /// Configurations, shape (N, 6), that bring the frame through `targets`, shape (N, 4, 4), without a jump. The first one is
    /// found from `seed`, shape (6,), by default zeros.
    ///
    /// Raises IkPathError with the waypoint at which the path breaks off, why, and the configurations up to there.
    #[pyo3(signature = (targets, seed=None, frame=None, *, tool=None, settings=None))]
    fn ik_path<'py>(
        &self,
        py: Python<'py>,
        targets: &Bound<'py, PyAny>,
        seed: Option<&Bound<'py, PyAny>>,
        frame: Option<&Bound<'_, PyAny>>,
        tool: Option<&Bound<'_, PyAny>>,
        settings: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let frame = self.frame(py, frame, tool)?;
        batch::path(self.solver(py, frame, settings)?, py, targets, seed)
    }

    /// Solves many targets, shape (N, 4, 4), each from its own seed, shape (N, 6), or all from one, shape (6,).
    ///
    /// Nothing is raised for a target that is not solved: `answer.solved` says which are, `answer.causes` why the others are not, and
    /// `answer.q` holds the best configuration found for those. A row that is no pose has the cause `"target"`, one whose seed is
    /// not finite `"seed"`, and both NaN in `answer.q`. Targets near their seeds are solved several at a time, on all processors.
    #[pyo3(signature = (targets, seeds=None, frame=None, *, tool=None, settings=None))]
    fn ik_batch<'py>(
        &self,
        py: Python<'py>,
        targets: &Bound<'py, PyAny>,
        seeds: Option<&Bound<'py, PyAny>>,
        frame: Option<&Bound<'_, PyAny>>,
        tool: Option<&Bound<'_, PyAny>>,
        settings: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let frame = self.frame(py, frame, tool)?;
        batch::solve(&*self.solver(py, frame, settings)?, py, targets, seeds)
    }

    fn __repr__(&self) -> String {
        format!("Robot('{}', sha256 {}…)", self.model.name(), &self.model.sha256()[..8])
    }

    fn __eq__(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.model, &other.model) || self.model == other.model
    }

    fn __hash__(&self) -> u64 {
        // The first bits of a SHA-256 are as good as any.
        u64::from_str_radix(&self.model.sha256()[..16], 16).unwrap_or(0)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let class = slf.get_type();
        slf.get().source.reduce(slf.py(), &class)
    }

    /// Restores a pickled arm from a description.
    #[classmethod]
    #[expect(clippy::too_many_arguments, reason = "Python's keywords")]
    fn _restore(
        class: &Bound<'_, PyType>,
        py: Python<'_>,
        text: &Bound<'_, PyAny>,
        srdf: Option<&Bound<'_, PyAny>>,
        package_path: Option<&Bound<'_, PyAny>>,
        folder: Option<&Bound<'_, PyAny>>,
        visual_shapes: Option<&Bound<'_, PyAny>>,
        split_links: Option<&Bound<'_, PyAny>>,
        fixed: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        Self::from_urdf(
            class,
            py,
            text,
            srdf,
            package_path,
            folder,
            visual_shapes,
            split_links,
            fixed,
        )
    }
}
