//! The tool: Python's `Tool`, field by field.

use crate::argument::{self, TOOL};
use crate::arrays;
use crate::exception;
use platewash::workcell::tool::StraightTool;
use platewash::{RobotModel, Tool};
use pyo3::prelude::*;

/// Largest accepted length \[m\].
pub const LARGEST_M: f64 = 100.0;

/// Largest accepted stiffness \[Pa\].
const LARGEST_PA: f64 = 1e9;

/// Largest accepted mass \[kg\], and largest accepted entry of an inertia \[kg·m²\].
const LARGEST_KG: f64 = 1e4;

/// Fields of Python's `Tool`.
#[derive(Debug)]
pub struct ToolFields {
    length_m: f64,
    radius_m: f64,
    sponge_radius_m: f64,
    sponge_height_m: f64,
    sponge_compression_m: f64,
    sponge_stiffness_pa: Option<[f64; 2]>,
    mass_kg: f64,
    com_m: Option<f64>,
    inertia_kg_m2: Option<[f64; 6]>,
    mounted_on: Option<String>,
}

impl ToolFields {
    /// The fields of the argument called `tool`.
    ///
    /// # Errors
    /// `InputTypeError` for what is no `Tool`, or a field of a wrong type.
    pub fn read(value: &Bound<'_, PyAny>) -> PyResult<Self> {
        let number = |field| argument::field(("tool", TOOL), value, ("tool", field), argument::number);
        let com_m = argument::field(("tool", TOOL), value, ("tool", "com_m"), |name, value| {
            (!value.is_none()).then(|| argument::number(name, value)).transpose()
        });
        let sponge_stiffness_pa =
            argument::field(("tool", TOOL), value, ("tool", "sponge_stiffness_pa"), |name, value| {
                (!value.is_none()).then(|| arrays::fixed::<2>(name, value)).transpose()
            });
        let inertia_kg_m2 = argument::field(("tool", TOOL), value, ("tool", "inertia_kg_m2"), |name, value| {
            (!value.is_none()).then(|| arrays::fixed::<6>(name, value)).transpose()
        });
        let mounted_on = argument::field(("tool", TOOL), value, ("tool", "mounted_on"), |name, value| {
            (!value.is_none())
                .then(|| argument::text(name, value, "a link's name"))
                .transpose()
        });
        Ok(Self {
            mounted_on: mounted_on?,
            length_m: number("length_m")?,
            radius_m: number("radius_m")?,
            sponge_radius_m: number("sponge_radius_m")?,
            sponge_height_m: number("sponge_height_m")?,
            sponge_compression_m: number("sponge_compression_m")?,
            sponge_stiffness_pa: sponge_stiffness_pa?,
            mass_kg: number("mass_kg")?,
            com_m: com_m?,
            inertia_kg_m2: inertia_kg_m2?,
        })
    }

    /// The tool.
    ///
    /// # Errors
    /// `InputError` for a number that makes no sense.
    pub fn tool(&self, py: Python<'_>) -> PyResult<Tool> {
        let lengths = [
            ("tool.length_m", self.length_m),
            ("tool.radius_m", self.radius_m),
            ("tool.sponge_radius_m", self.sponge_radius_m),
            ("tool.sponge_height_m", self.sponge_height_m),
            ("tool.sponge_compression_m", self.sponge_compression_m),
            ("tool.com_m", self.com_m.map_or(0.0, f64::abs)),
        ];
        for (name, length_m) in lengths {
            check_length(py, name, length_m)?;
        }
        if self.length_m > 0.0 && self.sponge_height_m >= self.length_m {
            let problem = format!(
                "must be below length_m = {}; found {}",
                self.length_m, self.sponge_height_m
            );
            return Err(exception::input(py, "tool.sponge_height_m", &problem));
        }
        self.check_stiffness(py)?;
        self.check_masses(py)?;
        let straight = StraightTool {
            length_m: self.length_m,
            radius_m: self.radius_m,
            sponge_radius_m: self.sponge_radius_m,
            sponge_height_m: self.sponge_height_m,
            sponge_compression_m: self.sponge_compression_m,
            sponge_stiffness_pa: self.sponge_stiffness_pa,
            mass_kg: self.mass_kg,
            com_m: self.com_m,
            inertia_kg_m2: self.inertia_kg_m2,
        };
        Ok(Tool::from(straight).mounted(self.mounted_on.clone()))
    }

    /// The tool on the link of an arm that is stated or that the description tells.
    ///
    /// # Errors
    /// As [`Self::tool`], and `InputError` for an arm that does not tell the link.
    pub fn on(&self, py: Python<'_>, robot: &RobotModel) -> PyResult<Tool> {
        let tool = self.tool(py)?.on(robot);
        tool.map_err(|e| exception::input(py, "tool.mounted_on", &e.to_string()))
    }

    fn check_stiffness(&self, py: Python<'_>) -> PyResult<()> {
        match self.sponge_stiffness_pa {
            Some([least, most]) if !(least > 0.0 && least <= most && most <= LARGEST_PA) => {
                let problem =
                    format!("must be (least, greatest), above 0 and up to {LARGEST_PA} Pa; found ({least}, {most})");
                Err(exception::input(py, "tool.sponge_stiffness_pa", &problem))
            }
            _ => Ok(()),
        }
    }

    fn check_masses(&self, py: Python<'_>) -> PyResult<()> {
        if !(0.0..=LARGEST_KG).contains(&self.mass_kg) {
            let problem = format!("must be from 0 to {LARGEST_KG} kg; found {}", self.mass_kg);
            return Err(exception::input(py, "tool.mass_kg", &problem));
        }
        let mut entries = self.inertia_kg_m2.iter().flatten();
        match entries.find(|entry| !(-LARGEST_KG..=LARGEST_KG).contains(*entry)) {
            None => Ok(()),
            Some(found) => {
                let problem = format!("must be within ±{LARGEST_KG} kg·m²; found {found}");
                Err(exception::input(py, "tool.inertia_kg_m2", &problem))
            }
        }
    }
}

/// Refuses what is no length from 0 to 100 m.
///
/// # Errors
/// `InputError`.
pub fn check_length(py: Python<'_>, name: &str, length_m: f64) -> PyResult<()> {
    if (0.0..=LARGEST_M).contains(&length_m) {
        return Ok(());
    }
    let problem = format!("must be from 0 to {LARGEST_M} m; found {length_m}");
    Err(exception::input(py, name, &problem))
}
