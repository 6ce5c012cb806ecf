//! Plain data of Python's side, read field by field: the tool, plates, curves.

use crate::errors;
use platewash::Plate;
use platewash::planner::scenario::ToolSection;
use pyo3::prelude::*;

/// Largest length that is believed \[m\].
const LARGEST_M: f64 = 100.0;

/// Fields of Python's `Tool`.
#[derive(Debug, FromPyObject)]
pub struct ToolFields {
    length_m: f64,
    radius_m: f64,
    sponge_radius_m: f64,
    sponge_height_m: f64,
}

impl ToolFields {
    /// The fields of the argument called `tool`.
    ///
    /// # Errors
    /// `InputTypeError` for what is no `Tool`.
    pub fn of(value: &Bound<'_, PyAny>) -> PyResult<Self> {
        let wrong = |e: PyErr| {
            errors::wrong_type(
                value.py(),
                "tool",
                &format!("a Tool is needed: {}", e.value(value.py())),
            )
        };
        value.extract().map_err(wrong)
    }

    /// The tool.
    ///
    /// # Errors
    /// `InputError` for a length that makes no sense.
    pub fn section(&self, py: Python<'_>) -> PyResult<ToolSection> {
        let lengths = [
            ("tool.length_m", self.length_m),
            ("tool.radius_m", self.radius_m),
            ("tool.sponge_radius_m", self.sponge_radius_m),
            ("tool.sponge_height_m", self.sponge_height_m),
        ];
        for (name, length_m) in lengths {
            check_length(py, name, length_m)?;
        }
        if self.length_m > 0.0 && self.sponge_height_m >= self.length_m {
            let problem = format!(
                "must be below length_m = {}; found {}",
                self.length_m, self.sponge_height_m
            );
            return Err(errors::input(py, "tool.sponge_height_m", &problem));
        }
        Ok(ToolSection {
            length_m: self.length_m,
            radius_m: self.radius_m,
            sponge_radius_m: self.sponge_radius_m,
            sponge_height_m: self.sponge_height_m,
        })
    }
}

/// Fields of Python's `Plate`.
#[derive(Debug, FromPyObject)]
pub struct PlateFields {
    x_m: f64,
    y_m: f64,
    z_m: f64,
    radius_m: f64,
    thickness_m: f64,
}

impl PlateFields {
    /// The fields of one of the `plates`.
    ///
    /// # Errors
    /// `InputTypeError` for what is no `Plate`.
    pub fn of(value: &Bound<'_, PyAny>) -> PyResult<Self> {
        let wrong = |e: PyErr| {
            errors::wrong_type(
                value.py(),
                "plates",
                &format!("Plates are needed: {}", e.value(value.py())),
            )
        };
        value.extract().map_err(wrong)
    }

    /// The plate.
    ///
    /// # Errors
    /// `InputError` for a number that makes no sense.
    pub fn plate(&self, py: Python<'_>) -> PyResult<Plate> {
        for (name, place_m) in [
            ("plate.x_m", self.x_m),
            ("plate.y_m", self.y_m),
            ("plate.z_m", self.z_m),
        ] {
            if !(-LARGEST_M..=LARGEST_M).contains(&place_m) {
                return Err(errors::input(
                    py,
                    name,
                    &format!("must be within ±{LARGEST_M} m; found {place_m}"),
                ));
            }
        }
        for (name, length_m) in [
            ("plate.radius_m", self.radius_m),
            ("plate.thickness_m", self.thickness_m),
        ] {
            check_length(py, name, length_m)?;
        }
        Ok(Plate {
            x_m: self.x_m,
            y_m: self.y_m,
            z_m: self.z_m,
            radius_m: self.radius_m,
            thickness_m: self.thickness_m,
        })
    }
}

/// Refuses what is no length from 0 to 100 m.
fn check_length(py: Python<'_>, name: &str, length_m: f64) -> PyResult<()> {
    if (0.0..=LARGEST_M).contains(&length_m) {
        return Ok(());
    }
    let problem = format!("must be from 0 to {LARGEST_M} m; found {length_m}");
    Err(errors::input(py, name, &problem))
}
