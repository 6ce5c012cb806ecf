//! Python's `Plate`, read field by field, and plates as Python's.
//!
//! Also here: poses from 4 × 4 matrices.
//!
//! Python's `Tool`, read field by field.
//!
//! Checks of Python's plain values at their construction.

use crate::argument::{self, TOOL};
use crate::errors::{self, Input};
use crate::{arrays, curves, page, robot};
use nalgebra::{Matrix3, Quaternion, Translation3, UnitQuaternion, Vector3};
use platewash::workcell::layout::MAX_PLATES;
use platewash::workcell::plate::{Foot, PlateTerms};
use platewash::workcell::surface::{Knot, SHIPPED_PROFILES, Surface};
use platewash::workcell::tool::StraightTool;
use platewash::{Plate, Pose, RobotModel, Tool};
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
    pub fn of(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Self> {
        let number = |field| argument::field((name, "a Plate"), value, ("plate", field), argument::number);
        let length = |field| {
            argument::field((name, "a Plate"), value, ("plate", field), |name, length| {
                let read = |length| curves::within(name, length, [0.0, 1.0]);
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
                return Err(errors::input(py, name, &problem));
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
            return Err(errors::input(py, "plate.quaternion_wxyz", &problem));
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
        let surface = Surface::profile(&knots).map_err(|e| errors::input(py, "plate.profile", &e.to_string()))?;
        let (rim_m, stated_m) = (surface.rim_m(), self.radius_m);
        if (stated_m - rim_m).abs() <= SAME_M || stated_m == DEFAULT_RADIUS_M {
            return Ok(surface);
        }
        let problem = format!("is that of the profile's last knot, {rim_m}: leave it out; found {stated_m}");
        Err(errors::input(py, "plate.radius_m", &problem))
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
    let fields = PlateFields::of("plate", plate)?;
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
    pub fn of(value: &Bound<'_, PyAny>) -> PyResult<Self> {
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
            return Err(errors::input(py, "tool.sponge_height_m", &problem));
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
        tool.map_err(|e| errors::input(py, "tool.mounted_on", &e.to_string()))
    }

    fn check_stiffness(&self, py: Python<'_>) -> PyResult<()> {
        match self.sponge_stiffness_pa {
            Some([least, most]) if !(least > 0.0 && least <= most && most <= LARGEST_PA) => {
                let problem =
                    format!("must be (least, greatest), above 0 and up to {LARGEST_PA} Pa; found ({least}, {most})");
                Err(errors::input(py, "tool.sponge_stiffness_pa", &problem))
            }
            _ => Ok(()),
        }
    }

    fn check_masses(&self, py: Python<'_>) -> PyResult<()> {
        if !(0.0..=LARGEST_KG).contains(&self.mass_kg) {
            let problem = format!("must be from 0 to {LARGEST_KG} kg; found {}", self.mass_kg);
            return Err(errors::input(py, "tool.mass_kg", &problem));
        }
        let mut entries = self.inertia_kg_m2.iter().flatten();
        match entries.find(|entry| !(-LARGEST_KG..=LARGEST_KG).contains(*entry)) {
            None => Ok(()),
            Some(found) => {
                let problem = format!("must be within ±{LARGEST_KG} kg·m²; found {found}");
                Err(errors::input(py, "tool.inertia_kg_m2", &problem))
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
    Err(errors::input(py, name, &problem))
}

/// Largest accepted entry of RᵀR − I; entries of R rounded to six decimals give 2e-6. A matrix within this bound is replaced by the nearest
/// rotation.
const ROUNDED: f64 = 1e-5;

/// Largest entry of RᵀR − I that needs no nearest rotation, as it is below the tolerance of any solver.
const EXACT: f64 = 1e-7;

/// Quaternion of NaN, in place of that of a matrix that is no pose.
const NO_POSE: Quaternion<f64> = Quaternion {
    coords: nalgebra::Vector4::new(f64::NAN, f64::NAN, f64::NAN, f64::NAN),
};

/// A pose `T_base_frame` from a 4 × 4 matrix, row by row.
///
/// # Errors
/// A matrix that is no pose; the error states the fault in words.
pub fn pose(matrix: &[f64]) -> Result<Pose, Input> {
    let Ok(m) = <&[f64; 16]>::try_from(matrix) else {
        return Err(Input("16 numbers are needed".to_owned()));
    };
    Ok(scaled(m, multiple(m)?))
}

/// Poses `T_base_frame` from many matrices; they replace the contents of `poses`, and `room` is scratch. A matrix that is no pose becomes
/// a pose of NaN.
///
/// Roots and divisions have a loop of their own: they depend on each other within one pose, but not from pose to pose.
pub fn poses(matrices: &[[f64; 16]], room: &mut Vec<Quaternion<f64>>, poses: &mut Vec<Pose>) {
    room.clear();
    room.extend(matrices.iter().map(|matrix| multiple(matrix).unwrap_or(NO_POSE)));
    poses.clear();
    poses.extend(matrices.iter().zip(room).map(|(matrix, q)| scaled(matrix, *q)));
}

/// A pose with a matrix's translation and a multiple of its quaternion.
fn scaled(m: &[f64; 16], quaternion: Quaternion<f64>) -> Pose {
    let rotation = UnitQuaternion::new_normalize(quaternion);
    Pose::from_parts(Vector3::new(m[3], m[7], m[11]).into(), rotation)
}

/// A multiple of the quaternion of a matrix that is a pose.
fn multiple(m: &[f64; 16]) -> Result<Quaternion<f64>, Input> {
    if let Some(found) = m.iter().find(|v| !v.is_finite()) {
        return Err(Input(format!("entries must be finite; found {found}")));
    }
    if m[12..] != [0.0, 0.0, 0.0, 1.0] {
        let row = &m[12..];
        return Err(Input(format!("the last row must be (0, 0, 0, 1); found {row:?}")));
    }
    let rows = [m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]];
    if surely_rotation(&rows) {
        return Ok(quaternion(&rows));
    }
    Ok(quaternion(&nearest_rotation(&rows)?))
}

/// True where three rows are a rotation to within [`EXACT`]: two unit rows at right angles, and their product.
fn surely_rotation(&[a, b, c, d, e, f, g, h, i]: &[f64; 9]) -> bool {
    let off = [
        a * a + b * b + c * c - 1.0,
        d * d + e * e + f * f - 1.0,
        a * d + b * e + c * f,
        b * f - c * e - g,
        c * d - a * f - h,
        a * e - b * d - i,
    ];
    // Not a comparison with the largest: NaN must not pass.
    off.iter().all(|off| off.abs() < EXACT)
}

/// The rotation nearest to three rows that are nearly one, in the sum of squares: the orthogonal factor of the polar decomposition,
/// by the iteration R ← R (3 I − RᵀR) / 2, which squares the error (Björck and Bowie, SIAM J. Numer. Anal. 8, 1971).
fn nearest_rotation(rows: &[f64; 9]) -> Result<[f64; 9], Input> {
    let mut rotation = Matrix3::from_row_slice(rows);
    let gram = |r: &Matrix3<f64>| r.tr_mul(r);
    let off = (gram(&rotation) - Matrix3::identity()).amax();
    if off > ROUNDED {
        return Err(Input(format!(
            "the upper left 3 × 3 must be a rotation; its columns are {off:.1e} from orthonormal, and up to {ROUNDED:.0e} is taken for \
             rounding: give more digits, or its nearest rotation, U @ Vt of U, s, Vt = np.linalg.svd(target[:3, :3])"
        )));
    }
    if rotation.determinant() < 0.0 {
        return Err(Input("the upper left 3 × 3 is a reflection, no rotation".to_owned()));
    }
    for _ in 0..2 {
        rotation *= (Matrix3::identity() * 3.0 - gram(&rotation)) * 0.5;
    }
    let [x, y, z] = rotation.transpose().data.0;
    Ok([x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2]])
}

/// A multiple of the quaternion of a rotation: of the four rows of `4 q qᵀ`, which the entries of the matrix add up to, the one with the
/// largest diagonal (Shepperd, J. Guidance and Control 1, 1978). No branches: they cost more than the rest.
fn quaternion(&[a, b, c, d, e, f, g, h, i]: &[f64; 9]) -> Quaternion<f64> {
    let squares = [1.0 + a + e + i, 1.0 + a - e - i, 1.0 - a + e - i, 1.0 - a - e + i];
    let (wx, wy, wz) = (h - f, c - g, d - b);
    let (xy, xz, yz) = (b + d, c + g, f + h);
    let rows = [
        [squares[0], wx, wy, wz],
        [wx, squares[1], xy, xz],
        [wy, xy, squares[2], yz],
        [wz, xz, yz, squares[3]],
    ];
    let first = usize::from(squares[1] > squares[0]);
    let second = 2 + usize::from(squares[3] > squares[2]);
    let [w, x, y, z] = rows[if squares[second] > squares[first] {
        second
    } else {
        first
    }];
    Quaternion::new(w, x, y, z)
}

/// Checks one of Python's plain values when it is made, field by field; `kind` is its class in lower case.
///
/// Raises InputTypeError for a field of a wrong type, InputError for one out of its range.
#[pyfunction]
pub fn _check(py: Python<'_>, kind: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
    match kind {
        "tool" => ToolFields::of(value)?.tool(py).map(|_| ()),
        "plate" => PlateFields::of("plate", value)?.plate(py).map(|_| ()),
        "foot" => check_foot(py, value),
        "ik_settings" => robot::settings(value).map(|_| ()),
        "paper_spiral" => curves::spiral_of(value).map(|_| ()),
        "figure" => page::check_figure(value),
        "page" => page::check(value),
        "rings" => curves::rings_of("rings", value).map(|_| ()),
        "wash_curve" => curves::curve_of(value).map(|_| ()),
        _ => Err(errors::internal(py, "no such kind of value")),
    }
}
