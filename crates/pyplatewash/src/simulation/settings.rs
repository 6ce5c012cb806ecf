//! `SimulationSettings`: control law, gains and plant of a simulation.

use crate::plan::PlanObject;
use crate::value::{from_mapping, to_python, to_record};
use crate::{argument, errors, exception};
use platewash::Scenario;
use platewash::scenario::plant_keys;
use platewash::workcell::simulation::{ControlLawName, SimulationSettings};
use pyo3::prelude::*;
use pyo3::types::{PyTuple, PyType};
use serde::Serialize;
use serde_json::{Map, Value, json};

/// Law, gains and plant of a simulation. Immutable; `replace` makes another one.
///
/// `law` is `"paper"`, `"exact"`, `"pd"`, `"pd_gravity"` or `"computed_torque"`. `control` and `plant` are dictionaries with keys, units
/// and ranges of these sections of scenario files (docs/scenario.md); what is missing is default. Gains given outright
/// (`joint_kp`, `joint_kd`) stand in place of those that follow from `frequency_rad_s` and `damping_ratio`. `payload_kg` is what the arm
/// is rated for [kg]; without it, the built-in arm's figure counts for that arm. Plates push back where `plant` states it
/// (`contact_stiffness_pa`, or `contact_force_n`): settings know no tool whose stiffness they could take.
///
/// Raises ScenarioError with the key, what was expected and what was found.
#[pyclass(frozen, eq, module = "pyplatewash", name = "SimulationSettings")]
#[derive(PartialEq)]
pub struct SettingsObject {
    inner: SimulationSettings,
}

impl From<SimulationSettings> for SettingsObject {
    fn from(inner: SimulationSettings) -> Self {
        Self { inner }
    }
}

impl SettingsObject {
    /// The settings of the argument called `settings`, if they are given.
    ///
    /// # Errors
    /// `InputTypeError` for what are no settings of a simulation.
    pub fn given<'a, 'py>(value: Option<&'a Bound<'py, PyAny>>) -> PyResult<Option<&'a Bound<'py, Self>>> {
        argument::maybe("settings", value, "a SimulationSettings")
    }

    /// The settings.
    #[must_use]
    pub fn inner(&self) -> &SimulationSettings {
        &self.inner
    }

    /// From tables of plain values, checked as a scenario file's sections would be.
    fn checked(
        py: Python<'_>,
        law: ControlLawName,
        control: Map<String, Value>,
        plant: Map<String, Value>,
        payload_kg: Option<f64>,
    ) -> PyResult<Self> {
        if control.contains_key("law") {
            return Err(exception::input(py, "control.law", "is given as law, beside control"));
        }
        let given = |section: Map<String, Value>| -> Map<String, Value> {
            section.into_iter().filter(|(_, value)| !value.is_null()).collect()
        };
        // The rest of a scenario that is none, so that its sections are checked by its rules.
        let layout = json!({ "positions_m": [[0.4, 0.0]] });
        let robot = payload_kg.map_or_else(|| json!({}), |payload_kg| json!({ "payload_kg": payload_kg }));
        let (control, plant) = (given(control), given(plant));
        let table = json!({ "name": "settings", "robot": robot, "layout": layout, "control": control, "plant": plant });
        let text = toml::to_string(&table).map_err(|e| exception::input(py, "settings", &e.to_string()))?;
        let scenario = Scenario::parse(&text, "settings").map_err(|mut e| {
            // The line is one of a text that nobody has seen.
            e.line = None;
            errors::scenario(py, &e)
        })?;
        let inner = SimulationSettings {
            law,
            control: scenario.control.settings(),
            plant: scenario
                .plant
                .settings(None, &platewash::kinematics::JointFriction::default()),
            payload_kg,
        };
        Ok(Self { inner })
    }
}

fn table(py: Python<'_>, section: &impl Serialize) -> PyResult<Map<String, Value>> {
    match serde_json::to_value(section) {
        Ok(Value::Object(map)) => Ok(map),
        Ok(_) => Err(exception::internal(py, "a section is a table")),
        Err(e) => Err(exception::internal(py, &e.to_string())),
    }
}

/// The law of the argument called `law`.
fn named(law: &Bound<'_, PyAny>) -> PyResult<ControlLawName> {
    argument::word("law", law, &ControlLawName::ALL.map(|law| (law.name(), law)))
}

/// The payload of the argument called `payload_kg`, if it is given.
fn payload(payload_kg: Option<&Bound<'_, PyAny>>) -> PyResult<Option<f64>> {
    let Some(given) = payload_kg else {
        return Ok(None);
    };
    match argument::number("payload_kg", given)? {
        found if found.is_finite() => Ok(Some(found)),
        _ => Err(argument::wrong_value("payload_kg", given, "a finite number")),
    }
}

fn given(name: &str, section: Option<&Bound<'_, PyAny>>) -> PyResult<Map<String, Value>> {
    section.map_or_else(|| Ok(Map::new()), |section| from_mapping(name, section))
}

#[pymethods]
impl SettingsObject {
    #[new]
    #[pyo3(
        signature = (law=None, *, control=None, plant=None, payload_kg=None),
        text_signature = "(law='computed_torque', *, control=None, plant=None, payload_kg=None)"
    )]
    fn new(
        py: Python<'_>,
        law: Option<&Bound<'_, PyAny>>,
        control: Option<&Bound<'_, PyAny>>,
        plant: Option<&Bound<'_, PyAny>>,
        payload_kg: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let law = law.map_or(Ok(ControlLawName::ComputedTorque), named)?;
        let (control, plant) = (given("control", control)?, given("plant", plant)?);
        Self::checked(py, law, control, plant, payload(payload_kg)?)
    }

    /// The settings that a plan, or the plan file of that path, states.
    #[classmethod]
    fn of(_class: &Bound<'_, PyType>, plan: &Bound<'_, PyAny>) -> PyResult<Self> {
        let plan = PlanObject::given("plan", plan)?;
        let inner = plan.get().inner().job.simulation.clone();
        Ok(Self { inner })
    }

    /// The same settings with other values: `replace(law="pd", control={"frequency_rad_s": 15.0})`. Keys of a section that are not
    /// given stay; None takes a key away.
    ///
    /// Raises ScenarioError.
    #[pyo3(signature = (*, law=None, control=None, plant=None, payload_kg=None))]
    fn replace(
        &self,
        py: Python<'_>,
        law: Option<&Bound<'_, PyAny>>,
        control: Option<&Bound<'_, PyAny>>,
        plant: Option<&Bound<'_, PyAny>>,
        payload_kg: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let (mut new_control, mut new_plant) = (
            table(py, &self.inner.control)?,
            table(py, &plant_keys(&self.inner.plant))?,
        );
        new_control.extend(given("control", control)?);
        new_plant.extend(given("plant", plant)?);
        let payload_kg = payload(payload_kg)?.or(self.inner.payload_kg);
        let law = law.map_or(Ok(self.inner.law), named)?;
        Self::checked(py, law, new_control, new_plant, payload_kg)
    }

    /// The law.
    #[getter]
    fn law(&self) -> &'static str {
        self.inner.law.name()
    }

    /// Its gains and sampling.
    #[getter]
    fn control<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_record(py, &self.inner.control, None)
    }

    /// The plant; not used by the laws `"paper"` and `"exact"`.
    #[getter]
    fn plant<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_record(py, &plant_keys(&self.inner.plant), None)
    }

    /// Rated payload of the arm [kg], where that is stated.
    #[getter]
    fn payload_kg(&self) -> Option<f64> {
        self.inner.payload_kg
    }

    /// Time between samples [s].
    #[getter]
    fn period_s(&self) -> f64 {
        self.inner.period_s()
    }

    fn __repr__(&self) -> String {
        let (law, control) = (self.inner.law.name(), &self.inner.control);
        if self.inner.law.is_kinematic() {
            return format!("SimulationSettings('{law}')");
        }
        if control.joint_kp.is_some() {
            return format!("SimulationSettings('{law}', gains given)");
        }
        let (frequency, damping) = (control.frequency_rad_s, control.damping_ratio);
        format!("SimulationSettings('{law}', {frequency} rad/s, damping ratio {damping})")
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, settings) = (slf.py(), &slf.get().inner);
        let arguments = (
            settings.law.name(),
            to_python(py, &settings.control)?,
            to_python(py, &plant_keys(&settings.plant))?,
            settings.payload_kg,
        );
        Ok((slf.get_type().getattr("_restore")?, arguments.into_pyobject(py)?))
    }

    /// Restores pickled settings.
    #[classmethod]
    fn _restore(
        _class: &Bound<'_, PyType>,
        py: Python<'_>,
        law: &Bound<'_, PyAny>,
        control: &Bound<'_, PyAny>,
        plant: &Bound<'_, PyAny>,
        payload_kg: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        Self::new(py, Some(law), Some(control), Some(plant), payload_kg)
    }
}
