//! `Scenario`: a job in full.

use crate::job::{PaperJobObject, WashJobObject};
use crate::layout::LayoutObject;
use crate::robot::Robot;
use crate::value::{from_mapping, records, to_python, to_record};
use crate::warnings::warn;
use crate::work::patiently;
use crate::{argument, errors, exception};
use platewash::planner::Watch;
use platewash::scenario::{Program, SHIPPED, ScenarioError};
use platewash::{Failure, Layout, RobotModel, Scenario};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple, PyType};
use serde_json::{Map, Value};
use std::path::PathBuf;
use std::sync::Arc;

/// A job in full: what a scenario file states, with defaults filled in. Immutable; `replace` makes another one.
///
/// Keys, units and ranges are those of scenario files (docs/scenario.md). Sections are read as `scenario["wash"]["turns"]`, or, the
/// section `job` apart, as `scenario.wash.turns`. `job()` is the washing that the scenario asks for, `paper_job()` the run of the
/// paper's program.
#[pyclass(frozen, eq, module = "pyplatewash", name = "Scenario")]
#[derive(PartialEq)]
pub struct ScenarioObject {
    inner: Scenario,
}

impl From<Scenario> for ScenarioObject {
    fn from(inner: Scenario) -> Self {
        Self { inner }
    }
}

impl ScenarioObject {
    /// The scenario.
    #[must_use]
    pub fn inner(&self) -> &Scenario {
        &self.inner
    }

    fn as_table(&self, py: Python<'_>) -> PyResult<Map<String, Value>> {
        match serde_json::to_value(&self.inner) {
            Ok(Value::Object(map)) => Ok(map),
            Ok(_) => Err(exception::internal(py, "a scenario is a table")),
            Err(e) => Err(exception::internal(py, &e.to_string())),
        }
    }

    fn section<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let table = self.as_table(py)?;
        to_record(py, &table.get(name).unwrap_or(&Value::Null), None)
    }

    /// A scenario from a table of plain values, checked as a file would be.
    fn checked(py: Python<'_>, table: Map<String, Value>) -> PyResult<Self> {
        let name = table
            .get("name")
            .and_then(Value::as_str)
            .unwrap_or("unnamed")
            .to_owned();
        let mut table = table;
        if let Some(Value::Object(tool)) = table.get_mut("tool") {
            in_kilopascals(tool);
        }
        let table = without_nulls(Value::Object(table));
        let text = toml::to_string(&table).map_err(|e| exception::input(py, "scenario", &e.to_string()))?;
        let inner = Scenario::parse(&text, &name).map_err(|mut e| {
            // The line is one of a text that nobody has seen.
            e.line = None;
            errors::scenario(py, &e)
        })?;
        Self::warned(py, inner)
    }

    /// The object of a scenario, after warnings of what was probably meant in another unit.
    fn warned(py: Python<'_>, inner: Scenario) -> PyResult<Self> {
        warn(py, &inner.notes())?;
        Ok(Self { inner })
    }
}

/// The stiffness of Python's `Tool`, in pascals, as the key of a scenario states it.
fn in_kilopascals(tool: &mut Map<String, Value>) {
    let Some(mut stiffness) = tool.remove("sponge_stiffness_pa") else {
        return;
    };
    for end in stiffness.as_array_mut().into_iter().flatten() {
        if let Some(pa) = end.as_f64() {
            *end = (pa / 1e3).into();
        }
    }
    tool.insert("sponge_stiffness_kpa".to_owned(), stiffness);
}

/// Leaves out what is `None`.
fn without_nulls(value: Value) -> Value {
    match value {
        Value::Object(map) => Value::Object(
            map.into_iter()
                .filter(|(_, v)| !v.is_null())
                .map(|(k, v)| (k, without_nulls(v)))
                .collect(),
        ),
        Value::Array(all) => Value::Array(all.into_iter().map(without_nulls).collect()),
        plain => plain,
    }
}

#[pymethods]
impl ScenarioObject {
    /// A shipped scenario by name (see `Scenario.shipped()`), or a TOML file; paths in a file are relative to its folder.
    ///
    /// Raises ScenarioError with the line, the key, what was expected and what was found; where there is no such name or file, it is
    /// a FileError, too.
    #[classmethod]
    fn load(_class: &Bound<'_, PyType>, py: Python<'_>, name_or_file: &Bound<'_, PyAny>) -> PyResult<Self> {
        let name_or_file = argument::path("name_or_file", name_or_file)?;
        let Some(name) = name_or_file.to_str() else {
            return Err(exception::input(py, "name_or_file", "is not valid Unicode"));
        };
        let loaded = load(name).map_err(|e| errors::scenario(py, &e))?;
        Self::warned(py, loaded)
    }

    /// A scenario from TOML text; `source` is its name in messages.
    ///
    /// Raises ScenarioError.
    #[classmethod]
    #[pyo3(signature = (text, source=None), text_signature = "(text, source='text')")]
    fn parse(
        _class: &Bound<'_, PyType>,
        py: Python<'_>,
        text: &Bound<'_, PyAny>,
        source: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let text = argument::text("text", text, "TOML text")?;
        let source = source.map(|source| argument::text("source", source, "a name for messages"));
        let source = source.transpose()?;
        let inner =
            Scenario::parse(&text, source.as_deref().unwrap_or("text")).map_err(|e| errors::scenario(py, &e))?;
        Self::warned(py, inner)
    }

    /// A scenario from a dictionary as `to_dict` gives it; what is missing is default, None counts as missing.
    ///
    /// Raises ScenarioError with the key, what was expected and what was found.
    #[classmethod]
    fn from_dict(_class: &Bound<'_, PyType>, py: Python<'_>, table: &Bound<'_, PyAny>) -> PyResult<Self> {
        Self::checked(py, from_mapping("table", table)?)
    }

    /// Names of the scenarios that come with the package; the first is the default.
    #[classmethod]
    fn shipped(_class: &Bound<'_, PyType>) -> Vec<&'static str> {
        SHIPPED.iter().map(|s| s.name).collect()
    }

    /// The same scenario with other values: `replace(seed=3, layout={"count": 3}, tool=Tool(length_m=0.15))`. Keys of a section
    /// that are not given stay; None takes a key away.
    ///
    /// Raises ScenarioError.
    #[pyo3(signature = (**changes))]
    fn replace(&self, py: Python<'_>, changes: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut table = self.as_table(py)?;
        let changes = changes.map_or_else(|| Ok(Map::new()), |changes| from_mapping("", changes))?;
        for (key, value) in changes {
            match (table.get_mut(&key), value) {
                (Some(Value::Object(section)), Value::Object(new)) => section.extend(new),
                (_, value) => drop(table.insert(key, value)),
            }
        }
        let mut changed = Self::checked(py, table)?;
        changed.inner.solids = self.inner.solids.clone();
        Ok(changed)
    }

    /// Everything as plain dictionaries and lists.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.inner)
    }

    /// The scenario as a TOML file's text.
    pub fn to_toml(&self, py: Python<'_>) -> PyResult<String> {
        toml::to_string(&self.inner).map_err(|e| exception::internal(py, &e.to_string()))
    }

    /// Checks without running: the arm loads, the start is within its limits, plates have room in principle. The findings on
    /// plates that are given.
    ///
    /// Raises PlanError or LayoutError as `job` and `plan` would.
    fn check<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let scenario = self.inner.clone();
        let checked = patiently(py, move |_| scenario.check())?;
        let (_, findings) = checked.map_err(|e| errors::failure(py, &e))?;
        to_python(py, &findings)
    }

    /// The washing that the scenario asks for, resolved: its arm loaded, its plates placed, or those of a layout that was made before.
    ///
    /// Raises InputError for a scenario of the paper's program; PlanError or LayoutError.
    #[pyo3(signature = (layout=None))]
    fn job(&self, py: Python<'_>, layout: Option<&Bound<'_, PyAny>>) -> PyResult<WashJobObject> {
        resolved_wash(py, &self.inner, LayoutObject::given(layout)?)
    }

    /// The run of the paper's program that the scenario asks for, resolved: its arm loaded, its plates placed, or those of a layout
    /// that was made before.
    ///
    /// Raises InputError for a scenario of the other program; PlanError or LayoutError.
    #[pyo3(signature = (layout=None))]
    fn paper_job(&self, py: Python<'_>, layout: Option<&Bound<'_, PyAny>>) -> PyResult<PaperJobObject> {
        resolved_paper(py, &self.inner, LayoutObject::given(layout)?)
    }

    /// Notes on values that were probably meant in another unit: a home in radians. Each is also a `UserWarning` when the scenario is made.
    #[getter]
    fn notes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.inner.notes())
    }

    /// Name, for reports.
    #[getter]
    fn name(&self) -> &str {
        &self.inner.name
    }

    /// Seed of every random stream.
    #[getter]
    fn seed(&self) -> u64 {
        self.inner.seed
    }

    fn __getitem__<'py>(&self, py: Python<'py>, key: &Bound<'_, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let table = self.as_table(py)?;
        let key = argument::text("key", key, "a key")?;
        match table.get(&key) {
            Some(Value::Object(section)) => to_record(py, section, None),
            Some(plain) => to_python(py, plain),
            None => Err(exception::no_key(
                py,
                &key,
                &table.keys().map(String::as_str).collect::<Vec<_>>(),
            )),
        }
    }

    /// The arm.
    #[getter]
    fn robot<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.section(py, "robot")
    }

    /// The tool.
    #[getter]
    fn tool<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.section(py, "tool")
    }

    /// The floor of the room.
    #[getter]
    fn floor<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.section(py, "floor")
    }

    /// A table.
    #[getter]
    fn table<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.section(py, "table")
    }

    /// The obstacles, in their order.
    #[getter]
    fn obstacle<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        records(py, &self.inner.obstacle)
    }

    /// Positions of the plates, or the region in which they are drawn.
    #[getter]
    fn layout<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.section(py, "layout")
    }

    /// The path on a plate.
    #[getter]
    fn wash<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.section(py, "wash")
    }

    /// Holder of the plates.
    #[getter]
    fn holder<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.section(py, "holder")
    }

    /// Inverse kinematics along the path.
    #[getter]
    fn ik<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.section(py, "ik")
    }

    /// The transits between plates.
    #[getter]
    fn transition<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.section(py, "transition")
    }

    /// Limits beyond those of the arm's description.
    #[getter]
    fn limits<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.section(py, "limits")
    }

    /// The control law and its settings.
    #[getter]
    fn control<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.section(py, "control")
    }

    /// The arm as a physical system: payload, friction, foam, and steps of the integration.
    #[getter]
    fn plant<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.section(py, "plant")
    }

    fn __repr__(&self) -> String {
        format!("Scenario('{}', seed={})", self.inner.name, self.inner.seed)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let text = slf.get().to_toml(slf.py())?;
        let arguments = (text, slf.get().name()).into_pyobject(slf.py())?;
        Ok((slf.get_type().getattr("parse")?, arguments))
    }
}

/// The scenario of the argument called `scenario`: a scenario, or the name or file of one.
///
/// # Errors
/// `InputTypeError` for anything else, `ScenarioError`.
pub fn given(value: &Bound<'_, PyAny>) -> PyResult<Scenario> {
    called("scenario", value, SCENARIO)
}

/// Expected forms of a scenario, in messages.
/// A scenario whose meshes are also looked for in the packages that ROS has installed.
fn load(name_or_file: &str) -> Result<Scenario, ScenarioError> {
    let mut scenario = Scenario::load(name_or_file)?;
    scenario.files = platewash::cli::installed_files();
    Ok(scenario)
}

const SCENARIO: &str = "a Scenario, the name of a shipped one or the path of a file";

/// [`given`], of an argument of another name, which may be something else besides.
fn called(name: &str, value: &Bound<'_, PyAny>, needed: &str) -> PyResult<Scenario> {
    if let Ok(object) = value.cast::<ScenarioObject>() {
        return Ok(object.get().inner.clone());
    }
    let path: PathBuf = value.extract().map_err(|e| argument::refused(name, value, needed, e))?;
    let scenario = load(&path.to_string_lossy()).map_err(|e| errors::scenario(value.py(), &e))?;
    warn(value.py(), &scenario.notes())?;
    Ok(scenario)
}

/// The washing of the argument called `job`: a `WashJob`, or that of a scenario, with another seed if one is given.
///
/// # Errors
/// As [`given`] and `Scenario.job`; `InputError` for a seed beside a job, whose plates are placed.
pub fn wash_job<'py>(
    value: &Bound<'py, PyAny>,
    seed: Option<&Bound<'_, PyAny>>,
) -> PyResult<Bound<'py, WashJobObject>> {
    let py = value.py();
    let seed = seed.map(|seed| argument::seed("seed", seed)).transpose()?;
    if let Ok(job) = value.cast::<WashJobObject>() {
        return match seed {
            None => Ok(job.clone()),
            Some(_) => Err(exception::input(
                py,
                "seed",
                "is for scenarios: a WashJob's plates are placed; give the scenario in its stead, or scenario.replace(seed=…).job()",
            )),
        };
    }
    let mut scenario = called(
        "job",
        value,
        "a WashJob, a Scenario, the name of a shipped one or the path of a scenario file",
    )?;
    scenario.seed = seed.unwrap_or(scenario.seed);
    Bound::new(py, resolved_wash(py, &scenario, None)?)
}

/// The run of the paper's program of the argument called `job`: a `PaperJob`, or that of a scenario.
///
/// # Errors
/// As [`given`] and `Scenario.paper_job`.
pub fn paper_job<'py>(value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PaperJobObject>> {
    if let Ok(job) = value.cast::<PaperJobObject>() {
        return Ok(job.clone());
    }
    let scenario = called(
        "job",
        value,
        "a PaperJob, a Scenario, the name of a shipped one or the path of a scenario file",
    )?;
    Bound::new(value.py(), resolved_paper(value.py(), &scenario, None)?)
}

/// The washing that a scenario asks for, on its own plates or those of a layout.
fn resolved_wash(py: Python<'_>, scenario: &Scenario, layout: Option<Layout>) -> PyResult<WashJobObject> {
    of_program(py, scenario, Program::Certified)?;
    let ((job, layout), robot) = resolved(py, scenario, layout, |scenario, arm, layout| {
        Ok((scenario.job_on(arm, &layout)?, layout))
    })?;
    Ok(WashJobObject::new(job, layout, robot))
}

/// The run of the paper's program that a scenario asks for, on its own plates or those of a layout.
fn resolved_paper(py: Python<'_>, scenario: &Scenario, layout: Option<Layout>) -> PyResult<PaperJobObject> {
    of_program(py, scenario, Program::Paper)?;
    let (job, robot) = resolved(py, scenario, layout, Scenario::paper_job_on)?;
    Ok(PaperJobObject::new(job, robot))
}

/// The job of a scenario on its own plates, placed as its program places them, or on those of a layout; and its robot.
fn resolved<J: Send + 'static>(
    py: Python<'_>,
    scenario: &Scenario,
    layout: Option<Layout>,
    job: fn(&Scenario, &Arc<RobotModel>, Layout) -> Result<J, Failure>,
) -> PyResult<(J, Py<Robot>)> {
    let asked = scenario.clone();
    let resolved = patiently(py, move |cancel| {
        let arm = asked.arm()?;
        let layout = match (layout, asked.job.program) {
            (Some(layout), _) => layout,
            (None, Program::Certified) => asked.place(&arm, &Watch::silent(cancel))?,
            (None, Program::Paper) => asked.layout(&arm)?,
        };
        Ok::<_, Failure>((job(&asked, &arm, layout)?, arm))
    })?;
    let (job, arm) = resolved.map_err(|e| errors::failure(py, &e))?;
    Ok((job, Robot::of_scenario(py, scenario, arm)?))
}

/// Refuses a scenario of the other program than the one that a call runs.
///
/// # Errors
/// `InputError` that names the call for that program.
pub fn of_program(py: Python<'_>, scenario: &Scenario, wanted: Program) -> PyResult<()> {
    let name = &scenario.name;
    if scenario.job.program == wanted {
        return Ok(());
    }
    let problem = match wanted {
        Program::Certified => format!(
            "\"{name}\" has job.program = \"paper\", the paper's program: paper_job() is its job, which run_paper carries out; a \
             washing is needed here, such as \"kitchen\""
        ),
        Program::Paper => format!(
            "\"{name}\" has job.program = \"certified\", a washing: job() is its job, which plan plans; the paper's program is needed \
             here, such as \"paper-appendix\""
        ),
    };
    Err(exception::input(py, "scenario", &problem))
}

/// Places the plates of a scenario: drawn from its seed's own stream, or as given and checked. Where `layout.only_washable` asks for
/// it, layouts are drawn until every plate can be washed whole.
///
/// Raises LayoutError when they have no room.
#[pyfunction]
pub fn place_plates(py: Python<'_>, scenario: &Bound<'_, PyAny>) -> PyResult<LayoutObject> {
    let scenario = given(scenario)?;
    let placed = patiently(py, move |cancel| -> Result<Layout, Failure> {
        let arm = scenario.arm()?;
        scenario.place(&arm, &Watch::silent(cancel))
    })?;
    Ok(placed.map_err(|e| errors::failure(py, &e))?.into())
}

/// Foot of the arm's mount, radius about it, and outline: where plates are drawn.
type Region = ([f64; 2], Option<f64>, Option<Vec<[f64; 2]>>);

/// Region in which a scenario draws plates, in the world [m]: the foot of the arm's mount, the radius about it that their centres keep away
/// from, and the outline of their region. `name` is that of the argument.
#[pyfunction]
pub fn _task_region(py: Python<'_>, name: &str, scenario: &Bound<'_, PyAny>) -> PyResult<Region> {
    let scenario = called(name, scenario, SCENARIO)?;
    let arm = scenario.arm().map_err(|e| errors::failure(py, &e))?;
    let region = scenario.task_region(&arm);
    Ok((scenario.foot_m(&arm), region.base_circle_m, region.polygon_m))
}
