//! Python's `Plate`, read field by field, and plates as Python's.

use crate::argument::{self};
use crate::tool::{LARGEST_M, check_length};
use crate::{arrays, exception};
use nalgebra::{Quaternion, Translation3, UnitQuaternion};
use platewash::workcell::layout::MAX_PLATES;
use platewash::workcell::plate::{Foot, PlateTerms};
use platewash::workcell::surface::{Knot, SHIPPED_PROFILES, Surface};
use platewash::{Plate, Pose};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyList, PyString, PyTuple, PyType};

static PLATE: PyOnceLock<Py<PyType>> = PyOnceLock::new();
static FOOT: PyOnceLock<Py<PyType>> = PyOnceLock::new();

/// The radius that Python's `Plate` has where none is stated \[m\].
const DEFAULT_RADIUS_M: f64 = 0.145;

/// Largest difference between the stated radius of a plate with a profile and the radius of its rim \[m\].
const SAME_M: f64 = 1e-12;

/// The profile of a level disc, by its name.
const FLAT: &str = "flat";

/// Profile, radius and quaternion of a plate, as Python's.
type PlateValues<'py> = (Option<Bound<'py, PyTuple>>, f64, (f64, f64, f64, f64));

/// Largest difference of the length of a quaternion from 1.
const UNIT: f64 = 1e-9;

/// Knots as radius \[m\] and slope \[rad\].
type Knots = Vec<[f64; 2]>;

/// Fields of Python's `Plate`.
#[derive(Debug)]
pub struct PlateFields {
    x_m: f64,
    y_m: f64,
    z_m: f64,
    radius_m: f64,
    thickness_m: f64,
    profile: Option<Knots>,
    foot: Option<[f64; 2]>,
    quaternion_wxyz: [f64; 4],
    terms: PlateTerms,
}

impl PlateFields {
    /// The fields of the plate called `name`.
    ///
    /// # Errors
    /// `InputTypeError` for what is no `Plate`, or a field of a wrong type.
    pub fn read(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Self> {
        let number = |field| argument::field((name, "a Plate"), value, ("plate", field), argument::number);
        let length = |field| {
            argument::field((name, "a Plate"), value, ("plate", field), |name, length| {
                let read = |length| argument::number_within(name, length, [0.0, 1.0]);
                (!length.is_none()).then(|| read(length)).transpose()
            })
        };
        let index = |field| {
            argument::field((name, "a Plate"), value, ("plate", field), |name, index| {
                let read = |index| argument::count(name, index, [0, MAX_PLATES as u64]);
                (!index.is_none()).then(|| read(index)).transpose()
            })
        };
        Ok(Self {
            x_m: number("x_m")?,
            y_m: number("y_m")?,
            z_m: number("z_m")?,
            radius_m: number("radius_m")?,
            thickness_m: number("thickness_m")?,
            profile: argument::field((name, "a Plate"), value, ("plate", "profile"), profile)?,
            foot: argument::field((name, "a Plate"), value, ("plate", "foot"), |_, foot| {
                (!foot.is_none()).then(|| foot_of(foot)).transpose()
            })?,
            quaternion_wxyz: argument::field(
                (name, "a Plate"),
                value,
                ("plate", "quaternion_wxyz"),
                arrays::fixed::<4>,
            )?,
            terms: PlateTerms {
                height_error_m: length("height_error_m")?,
                deviation_m: length("deviation_m")?,
                measured: index("measured")?,
                soil: index("soil")?,
            },
        })
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
                let problem = format!("must be within ±{LARGEST_M} m; found {place_m}");
                return Err(exception::input(py, name, &problem));
            }
        }
        for (name, length_m) in [
            ("plate.radius_m", self.radius_m),
            ("plate.thickness_m", self.thickness_m),
        ] {
            check_length(py, name, length_m)?;
        }
        let foot = self.foot.map(|[radius_m, height_m]| Foot { radius_m, height_m });
        for (name, length_m) in foot.iter().flat_map(lengths) {
            check_length(py, name, length_m)?;
        }
        let [w, x, y, z] = self.quaternion_wxyz;
        let quaternion = Quaternion::new(w, x, y, z);
        let off = (quaternion.norm() - 1.0).abs();
        if off.is_nan() || off > UNIT {
            let problem = format!("must have length 1; found {}", quaternion.norm());
            return Err(exception::input(py, "plate.quaternion_wxyz", &problem));
        }
        let at = Translation3::new(self.x_m, self.y_m, self.z_m);
        Ok(Plate {
            surface: self.surface(py)?,
            thickness_m: self.thickness_m,
            foot,
            pose: Pose::from_parts(at, UnitQuaternion::new_unchecked(quaternion)),
            terms: self.terms,
        })
    }

    /// The face that is washed.
    fn surface(&self, py: Python<'_>) -> PyResult<Surface> {
        let Some(knots) = &self.profile else {
            let radius_m = self.radius_m;
            return Ok(Surface::Disc { radius_m });
        };
        let knots: Vec<_> = knots
            .iter()
            .map(|&[radius_m, slope_rad]| Knot { radius_m, slope_rad })
            .collect();
        let surface = Surface::profile(&knots).map_err(|e| exception::input(py, "plate.profile", &e.to_string()))?;
        let (rim_m, stated_m) = (surface.rim_m(), self.radius_m);
        if (stated_m - rim_m).abs() <= SAME_M || stated_m == DEFAULT_RADIUS_M {
            return Ok(surface);
        }
        let problem = format!("is that of the profile's last knot, {rim_m}: leave it out; found {stated_m}");
        Err(exception::input(py, "plate.radius_m", &problem))
    }
}

/// Checks Python's `Foot` when it is made.
///
/// # Errors
/// `InputTypeError`, `InputError`.
pub fn check_foot(py: Python<'_>, value: &Bound<'_, PyAny>) -> PyResult<()> {
    let [radius_m, height_m] = foot_of(value)?;
    for (name, length_m) in lengths(&Foot { radius_m, height_m }) {
        check_length(py, name, length_m)?;
    }
    Ok(())
}

fn lengths(foot: &Foot) -> [(&'static str, f64); 2] {
    [("foot.radius_m", foot.radius_m), ("foot.height_m", foot.height_m)]
}

/// Radius and height of a foot \[m\].
fn foot_of(value: &Bound<'_, PyAny>) -> PyResult<[f64; 2]> {
    let number = |field| argument::field(("plate.foot", "a Foot"), value, ("foot", field), argument::number);
    Ok([number("radius_m")?, number("height_m")?])
}

/// A profile by its name or its knots; none for `None` and for a level disc.
fn profile(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Option<Knots>> {
    if value.is_none() {
        return Ok(None);
    }
    let Ok(word) = value.cast::<PyString>() else {
        return arrays::rows::<2>(name, value).map(Some);
    };
    let word = word.to_string_lossy();
    if word == FLAT {
        return Ok(None);
    }
    match Surface::shipped(&word) {
        Some(Surface::Profile(meridian)) => Ok(Some(
            meridian.knots().iter().map(|k| [k.radius_m, k.slope_rad]).collect(),
        )),
        _ => {
            let names = SHIPPED_PROFILES.map(|name| format!("'{name}'")).join(", ");
            let needed = format!("knots, '{FLAT}' or one of {names}");
            Err(argument::wrong_value(name, value, &needed))
        }
    }
}

/// Parts of a plate besides numbers that are taken as they are: the knots of its profile as tuples, or `None` where it is flat after
/// all, its radius \[m\] and its quaternion.
#[pyfunction]
pub fn _plate_made<'py>(py: Python<'py>, plate: &Bound<'py, PyAny>) -> PyResult<PlateValues<'py>> {
    let fields = PlateFields::read("plate", plate)?;
    let surface = fields.surface(py)?;
    let [w, x, y, z] = fields.quaternion_wxyz;
    Ok((knots(py, &surface)?, surface.rim_m(), (w, x, y, z)))
}

/// The knots of a profile, as Python's; `None` of a disc.
fn knots<'py>(py: Python<'py>, surface: &Surface) -> PyResult<Option<Bound<'py, PyTuple>>> {
    match surface {
        Surface::Profile(meridian) => {
            let knots = meridian.knots().iter().map(|knot| (knot.radius_m, knot.slope_rad));
            PyTuple::new(py, knots.collect::<Vec<_>>()).map(Some)
        }
        _ => Ok(None),
    }
}

/// Plates as Python's.
///
/// # Errors
/// Out of memory.
pub fn plates<'py>(py: Python<'py>, all: &[Plate]) -> PyResult<Bound<'py, PyList>> {
    let class = PLATE.import(py, "pyplatewash._values", "Plate")?;
    let list = PyList::empty(py);
    for plate in all {
        let fields = PyDict::new(py);
        let centre = plate.centre();
        fields.set_item("x_m", centre.x)?;
        fields.set_item("y_m", centre.y)?;
        fields.set_item("z_m", centre.z)?;
        fields.set_item("radius_m", plate.rim_m())?;
        fields.set_item("thickness_m", plate.thickness_m)?;
        fields.set_item("profile", knots(py, &plate.surface)?)?;
        fields.set_item("foot", plate.foot.map(|foot| foot_object(py, &foot)).transpose()?)?;
        let q = plate.pose.rotation.quaternion();
        fields.set_item("quaternion_wxyz", (q.w, q.i, q.j, q.k))?;
        let terms = &plate.terms;
        fields.set_item("height_error_m", terms.height_error_m)?;
        fields.set_item("deviation_m", terms.deviation_m)?;
        fields.set_item("measured", terms.measured)?;
        fields.set_item("soil", terms.soil)?;
        list.append(class.call((), Some(&fields))?)?;
    }
    Ok(list)
}

fn foot_object<'py>(py: Python<'py>, foot: &Foot) -> PyResult<Bound<'py, PyAny>> {
    let fields = PyDict::new(py);
    fields.set_item("radius_m", foot.radius_m)?;
    fields.set_item("height_m", foot.height_m)?;
    FOOT.import(py, "pyplatewash._values", "Foot")?.call((), Some(&fields))
}
