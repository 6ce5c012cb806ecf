//! `Setup`: under which law, with which gains and on which plant.

use crate::argument;
use crate::errors;
use crate::plan::PlanObject;
use crate::value::{from_mapping, to_python, to_record};
use platewash::planner::scenario::{ControlLawName, ControlSection, PlantSection};
use platewash::{Scenario, Setup};
use pyo3::prelude::*;
use pyo3::types::{PyTuple, PyType};
use serde::Serialize;
use serde_json::{Map, Value, json};

/// Law, gains and plant of a simulation. Immutable; `replace` makes another one.
///
/// `law` is `"paper"`, `"exact"`, `"pd"`, `"pd_gravity"` or `"computed_torque"`. `control` and `plant` are dictionaries with keys, units
/// and ranges of these sections of scenario files (docs/scenario.md); what is missing is default. Gains given outright
/// (`joint_kp`, `joint_kd`) stand in place of those that follow from `frequency_rad_s` and `damping_ratio`.
///
/// Raises ScenarioError with the key, what was expected and what was found.
#[pyclass(frozen, eq, module = "pyplatewash", name = "Setup")]
#[derive(PartialEq)]
pub struct SetupObject {
    inner: Setup,
}

/// The same setup without the law that a scenario's section may state: `law` alone counts.
pub fn without_law(mut setup: Setup) -> Setup {
    setup.control.law = None;
    setup
}

impl From<Setup> for SetupObject {
    fn from(inner: Setup) -> Self {
        Self { inner }
    }
}

impl SetupObject {
    /// The setup of the argument called `setup`, if it is given.
    ///
    /// # Errors
    /// `InputTypeError` for what is no setup.
    pub fn given<'a, 'py>(value: Option<&'a Bound<'py, PyAny>>) -> PyResult<Option<&'a Bound<'py, Self>>> {
        argument::maybe("setup", value, "a Setup")
    }

    /// The setup.
    #[must_use]
    pub fn inner(&self) -> &Setup {
        &self.inner
    }

    /// From tables of plain values, checked as a scenario file's sections would be.
    fn checked(
        py: Python<'_>,
        law: ControlLawName,
        control: Map<String, Value>,
        plant: Map<String, Value>,
    ) -> PyResult<Self> {
        if control.contains_key("law") {
            return Err(errors::input(py, "control.law", "is given as law, beside control"));
        }
        let given = |section: Map<String, Value>| -> Map<String, Value> {
            section.into_iter().filter(|(_, value)| !value.is_null()).collect()
        };
        // The rest of a scenario that is none, so that its sections are checked by its rules.
        let layout = json!({ "positions_m": [[0.4, 0.0]] });
        let table = json!({ "name": "setup", "layout": layout, "control": given(control), "plant": given(plant) });
        let text = toml::to_string(&table).map_err(|e| errors::input(py, "setup", &e.to_string()))?;
        let Scenario { control, plant, .. } = Scenario::parse(&text, "setup").map_err(|mut e| {
            // The line is one of a text that nobody has seen.
            e.line = None;
            errors::scenario(py, &e)
        })?;
        let inner = Setup { law, control, plant };
        Ok(Self { inner })
    }
}

fn table(py: Python<'_>, section: &impl Serialize) -> PyResult<Map<String, Value>> {
    match serde_json::to_value(section) {
        Ok(Value::Object(map)) => Ok(map),
        Ok(_) => Err(errors::internal(py, "a section is a table")),
        Err(e) => Err(errors::internal(py, &e.to_string())),
    }
}

/// The law of the argument called `law`.
fn named(law: &Bound<'_, PyAny>) -> PyResult<ControlLawName> {
    argument::word("law", law, &ControlLawName::ALL.map(|law| (law.name(), law)))
}

fn given(name: &str, section: Option<&Bound<'_, PyAny>>) -> PyResult<Map<String, Value>> {
    section.map_or_else(|| Ok(Map::new()), |section| from_mapping(name, section))
}

#[pymethods]
impl SetupObject {
    #[new]
    #[pyo3(
        signature = (law=None, *, control=None, plant=None),
        text_signature = "(law='computed_torque', *, control=None, plant=None)"
    )]
    fn new(
        py: Python<'_>,
        law: Option<&Bound<'_, PyAny>>,
        control: Option<&Bound<'_, PyAny>>,
        plant: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let law = law.map_or(Ok(ControlLawName::ComputedTorque), named)?;
        Self::checked(py, law, given("control", control)?, given("plant", plant)?)
    }

    /// What the scenario of a plan, or of the plan file of that path, states.
    #[classmethod]
    fn of(_class: &Bound<'_, PyType>, plan: &Bound<'_, PyAny>) -> PyResult<Self> {
        let plan = PlanObject::given("plan", plan)?;
        let inner = without_law(Setup::of(plan.get().inner()));
        Ok(Self { inner })
    }

    /// The same setup with other values: `replace(law="pd", control={"frequency_rad_s": 15.0})`. Keys of a section that are not
    /// given stay; None takes a key away.
    ///
    /// Raises ScenarioError.
    #[pyo3(signature = (*, law=None, control=None, plant=None))]
    fn replace(
        &self,
        py: Python<'_>,
        law: Option<&Bound<'_, PyAny>>,
        control: Option<&Bound<'_, PyAny>>,
        plant: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let (mut new_control, mut new_plant) = (table(py, &self.inner.control)?, table(py, &self.inner.plant)?);
        new_control.extend(given("control", control)?);
        new_plant.extend(given("plant", plant)?);
        Self::checked(py, law.map_or(Ok(self.inner.law), named)?, new_control, new_plant)
    }

    /// The law.
    #[getter]
    fn law(&self) -> &'static str {
        self.inner.law.name()
    }

    /// Its gains and sampling.
    #[getter]
    fn control<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let section: &ControlSection = &self.inner.control;
        to_record(py, section, None)
    }

    /// The plant; not used by the laws `"paper"` and `"exact"`.
    #[getter]
    fn plant<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let section: &PlantSection = &self.inner.plant;
        to_record(py, section, None)
    }

    /// Time between samples [s].
    #[getter]
    fn period_s(&self) -> f64 {
        self.inner.period_s()
    }

    fn __repr__(&self) -> String {
        let ControlSection {
            frequency_rad_s,
            damping_ratio,
            ..
        } = self.inner.control;
        let law = self.inner.law.name();
        if self.inner.law.is_kinematic() {
            return format!("Setup('{law}')");
        }
        if self.inner.control.joint_kp.is_some() {
            return format!("Setup('{law}', gains given)");
        }
        format!("Setup('{law}', {frequency_rad_s} rad/s, damping ratio {damping_ratio})")
    }

    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __deepcopy__(slf: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        slf
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, setup) = (slf.py(), &slf.get().inner);
        let arguments = (
            setup.law.name(),
            to_python(py, &setup.control)?,
            to_python(py, &setup.plant)?,
        );
        Ok((slf.get_type().getattr("_restore")?, arguments.into_pyobject(py)?))
    }

    /// Restores a pickled setup.
    #[classmethod]
    fn _restore(
        _class: &Bound<'_, PyType>,
        py: Python<'_>,
        law: &Bound<'_, PyAny>,
        control: &Bound<'_, PyAny>,
        plant: &Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        Self::new(py, Some(law), Some(control), Some(plant))
    }
}
