//! Where an arm stands at a table: points touched with its tip give the mount.
//!
//! A touched point is known twice: in the drawing of the table, which is the world (`p`), and as the pendant shows the tip there, in the
//! base frame (`b`). The mount `T_world_base` is the rotation R and the translation t for which Σ |p − (R b + t)|² is least (Kabsch 1976,
//! Umeyama 1991): with the singular values of the covariance, and with the sign that makes R a rotation and no mirror.
//!
//! | concept | module |
//! | --- | --- |
//! | the fit, and how well the points fix it | `fit` |
//! | touched in another order than drawn | `order` |
//! | points in text | `table` |
//! | why there is none | `error` |
//!
//! The mount that fits touched points best, and how well they fix it.
//!
//! Points that were touched in another order than they are drawn.
//!
//! Points in text: a header, then a point a line, separated by commas. Empty lines and what follows a `#` are skipped.
//!
//! Why points give no mount.

use crate::number_table::{NumberTable, Row, TableError, TableShape};
use crate::plate::GREATEST_M;
use crate::trig::acos;
use crate::words::millimetres;
use nalgebra::{Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};
use platewash_kinematics::Pose;

/// Points that are taken at most.
pub(crate) const MOST: usize = 10_000;

/// How far two points must be apart \[m\].
const APART_M: f64 = 0.01;

/// How far the points must be from the line that fits them best, root mean square \[m\], and as a share of how far they are along it.
const BESIDE_M: f64 = 0.005;
const BESIDE_SHARE: f64 = 0.02;

/// What a coordinate may be at most \[m\]: a drawing in millimetres is refused for that, and not for its size.
pub(crate) const GREATEST: f64 = 1e3 * GREATEST_M;

/// Lengths whose ratio is this near to 1/1000, as a factor, are taken for a slip of units.
const NEAR: f64 = 2.0;

/// No table on which an arm works is larger \[m\].
const TABLE_M: f64 = 10.0;

/// A mirror image fits where it leaves less than this share of what the rotation leaves, and the rotation more than [`MISFIT_M`].
const MIRROR_SHARE: f64 = 0.25;
const MISFIT_M: f64 = 0.002;

/// A point that was touched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Where the drawing has it, world frame \[m\].
    pub drawn_m: [f64; 3],
    /// Where the tip was, base frame \[m\].
    pub touched_m: [f64; 3],
}

/// Where the arm stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Alignment {
    /// `T_world_base`, the mount.
    pub mount: Pose,
    /// What is left of each point: drawn less touched and carried over, world frame \[m\].
    pub residuals_m: Vec<[f64; 3]>,
    /// Their lengths, root mean square \[m\].
    pub rms_m: f64,
    /// How far the drawn points are spread about their middle, root mean square, along their longest direction and beside it \[m\].
    pub spread_m: [f64; 2],
    /// Lengths touched over lengths drawn; 1 where nothing is stretched.
    pub stretch: f64,
}

impl Alignment {
    /// Angle between the world's z and the base's \[rad\]: how far the table is out of level for the arm.
    #[must_use]
    pub fn tilt_rad(&self) -> f64 {
        let up = self.mount.rotation * Vector3::z();
        acos(up.z.clamp(-1.0, 1.0))
    }

    /// Length of the longest residual \[m\], and its point.
    #[must_use]
    pub fn worst(&self) -> (usize, f64) {
        let lengths = self.residuals_m.iter().map(|r| Vector3::from(*r).norm()).enumerate();
        lengths.fold((0, 0.0), |worst, found| if found.1 > worst.1 { found } else { worst })
    }

    /// A point of the drawing in the base frame \[m\].
    #[must_use]
    pub fn in_base(&self, drawn_m: [f64; 3]) -> [f64; 3] {
        self.mount.inverse_transform_point(&Point3::from(drawn_m)).coords.into()
    }
}

/// The mount that fits best, in the sense of least squares.
///
/// # Errors
/// [`AlignError`]: points that fix no mount, or fix one that cannot be meant. A bad fit is no error: see [`Alignment::rms_m`].
pub fn align(touches: &[Touch]) -> Result<Alignment, AlignError> {
    check(touches)?;
    let drawn = Cloud::of("drawn", touches, |touch| touch.drawn_m);
    let touched = Cloud::of("touched", touches, |touch| touch.touched_m);
    let stretch = touched.size_m() / drawn.size_m();
    check_units(stretch, drawn.size_m())?;
    drawn.check_apart()?;
    touched.check_apart()?;
    let spread_m = drawn.check_breadth()?;
    touched.check_breadth()?;
    let pairs = || drawn.about.iter().zip(&touched.about);
    let covariance: Matrix3<f64> = pairs().map(|(p, b)| p * b.transpose()).sum();
    // nalgebra sorts singular values from the greatest down; both factors are asked for, and so are there.
    let svd = covariance.svd(true, true);
    let [u, v_t] = [svd.u, svd.v_t].map(|factor| factor.unwrap_or_else(Matrix3::identity));
    let sign = if (u * v_t).determinant() < 0.0 { -1.0 } else { 1.0 };
    // The rotation that carries the touched points nearest to the drawn ones, and the mirror that does.
    let turns = [sign, -sign].map(|last| u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, last)) * v_t);
    let [rms_m, mirrored_m] = turns.map(|turn| root_mean_square(pairs().map(|(p, b)| p - turn * b)));
    if rms_m > MISFIT_M && mirrored_m < MIRROR_SHARE * rms_m {
        let rotated_m = rms_m;
        return Err(AlignError::Mirrored { mirrored_m, rotated_m });
    }
    let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turns[0]));
    let translation = drawn.middle - rotation * touched.middle;
    let mount = Pose::from_parts(translation.into(), rotation);
    let residual = |touch: &Touch| -> [f64; 3] {
        (Point3::from(touch.drawn_m) - mount.transform_point(&Point3::from(touch.touched_m))).into()
    };
    let alignment = Alignment {
        mount,
        residuals_m: touches.iter().map(residual).collect(),
        rms_m,
        spread_m,
        stretch,
    };
    match alignment.tilt_rad() {
        tilt_rad if tilt_rad > std::f64::consts::FRAC_PI_2 => Err(AlignError::UpsideDown {
            tilt_deg: tilt_rad.to_degrees(),
        }),
        _ => Ok(alignment),
    }
}

/// Points about their middle.
struct Cloud {
    /// Drawn or touched.
    how: &'static str,
    middle: Vector3<f64>,
    about: Vec<Vector3<f64>>,
}

impl Cloud {
    fn of(how: &'static str, touches: &[Touch], which: fn(&Touch) -> [f64; 3]) -> Self {
        let points = || touches.iter().map(|touch| Vector3::from(which(touch)));
        let middle = points().sum::<Vector3<f64>>() / touches.len() as f64;
        let about = points().map(|point| point - middle).collect();
        Self { how, middle, about }
    }

    /// Root mean square of the distances from the middle \[m\].
    fn size_m(&self) -> f64 {
        root_mean_square(self.about.iter().copied())
    }

    /// Refuses two points in one place.
    fn check_apart(&self) -> Result<(), AlignError> {
        for (a, first) in self.about.iter().enumerate() {
            let mut apart_m = (a + 1..).zip(self.about[a + 1..].iter().map(|second| (second - first).norm()));
            if let Some((b, apart_m)) = apart_m.find(|(_, apart_m)| *apart_m < APART_M) {
                return Err(AlignError::Coincident {
                    points: [a, b],
                    apart_m,
                    least_m: APART_M,
                    how: self.how,
                });
            }
        }
        Ok(())
    }

    /// How far the points reach along and beside their longest direction \[m\], unless that is a line.
    fn check_breadth(&self) -> Result<[f64; 2], AlignError> {
        let spread = self.about.iter().map(|p| p * p.transpose()).sum::<Matrix3<f64>>() / self.about.len() as f64;
        let mut along = spread.symmetric_eigenvalues().map(|value| value.max(0.0).sqrt());
        along.as_mut_slice().sort_by(f64::total_cmp);
        let [_, beside_m, length_m]: [f64; 3] = along.into();
        let (least_m, how) = (BESIDE_M.max(BESIDE_SHARE * length_m), self.how);
        if beside_m < least_m {
            return Err(AlignError::InLine { beside_m, least_m, how });
        }
        Ok([length_m, beside_m])
    }
}

/// Root mean square of lengths.
fn root_mean_square(all: impl ExactSizeIterator<Item = Vector3<f64>>) -> f64 {
    let count = all.len() as f64;
    (all.map(|one| one.norm_squared()).sum::<f64>() / count).sqrt()
}

/// Refuses too few points, too many, and coordinates that are none; NaN too.
fn check(touches: &[Touch]) -> Result<(), AlignError> {
    let found = touches.len();
    if !(3..=MOST).contains(&found) {
        return Err(AlignError::Count { found, most: MOST });
    }
    for (point, touch) in touches.iter().enumerate() {
        let is_number = |coordinate: &f64| (-GREATEST..=GREATEST).contains(coordinate);
        let mut all = touch.drawn_m.into_iter().chain(touch.touched_m);
        if let Some(found) = all.find(|coordinate| !is_number(coordinate)) {
            let most = GREATEST;
            return Err(AlignError::Coordinate { point, found, most });
        }
    }
    Ok(())
}

/// Refuses points that are a thousand times nearer to each other as touched than as drawn: one of both is in another unit.
fn check_units(ratio: f64, drawn_m: f64) -> Result<(), AlignError> {
    if !(1e-3 / NEAR..=1e-3 * NEAR).contains(&ratio) {
        return Ok(());
    }
    let (which, found, expected) = match drawn_m > TABLE_M {
        true => ("drawn", Unit::Millimetre, Unit::Metre),
        false => ("touched", Unit::Metre, Unit::Millimetre),
    };
    Err(AlignError::Units {
        ratio,
        which,
        found,
        expected,
    })
}

/// Points of which all orders are tried: 720.
const MOST_IN_ORDER: usize = 6;

/// The order in which the touched points fit the drawn ones to `tolerance_m` \[m\], root mean square: entry k is the touched point that
/// belongs to the drawn one k. `None` where no other order than the given one fits, and for more than six points.
#[must_use]
pub fn fitting_order(touches: &[Touch], tolerance_m: f64) -> Option<Vec<usize>> {
    let count = touches.len();
    if count > MOST_IN_ORDER {
        return None;
    }
    let mut best: Option<(f64, Vec<usize>)> = None;
    let mut order: Vec<usize> = (0..count).collect();
    while next(&mut order) {
        let swapped: Vec<Touch> = order
            .iter()
            .zip(touches)
            .map(|(&k, touch)| Touch {
                touched_m: touches[k].touched_m,
                ..*touch
            })
            .collect();
        let Ok(found) = align(&swapped) else { continue };
        if found.rms_m <= tolerance_m && best.as_ref().is_none_or(|(rms_m, _)| found.rms_m < *rms_m) {
            best = Some((found.rms_m, order.clone()));
        }
    }
    best.map(|(_, order)| order)
}

/// The next permutation in lexicographic order; false after the last.
fn next(order: &mut [usize]) -> bool {
    let Some(at) = order.windows(2).rposition(|pair| pair[0] < pair[1]) else {
        return false;
    };
    let pivot = order[at];
    let Some(with) = order.iter().rposition(|k| *k > pivot) else {
        return false;
    };
    order.swap(at, with);
    order[at + 1..].reverse();
    true
}

/// Columns of a drawn point, world frame \[m\].
const DRAWN: [&str; 3] = ["x_m", "y_m", "z_m"];

/// Those of a touched point: besides, base frame \[mm\], as a pendant shows them.
const TOUCHED: [&str; 6] = ["x_m", "y_m", "z_m", "touched_x_mm", "touched_y_mm", "touched_z_mm"];

/// A column that may be there besides.
const NAME: [&str; 1] = ["name"];

/// A point with its line.
#[derive(Debug, Clone, PartialEq)]
pub struct TouchedPoint {
    /// The line, from 1.
    pub line: usize,
    /// Its name, where the text has names.
    pub name: Option<String>,
    /// What is known of it.
    pub touch: Touch,
}

/// A point of the drawing alone.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnPoint {
    /// The line, from 1.
    pub line: usize,
    /// Its name, where the text has names.
    pub name: Option<String>,
    /// Where it is, world frame \[m\].
    pub drawn_m: [f64; 3],
}

/// Points with columns `x_m,y_m,z_m,touched_x_mm,touched_y_mm,touched_z_mm` in any order, and a `name` where one is wanted.
///
/// # Errors
/// [`TableError`], with the line.
pub fn touched_points(text: &str) -> Result<Vec<TouchedPoint>, TableError> {
    points(text, &TOUCHED, |line, name, [x, y, z, touched @ ..]| TouchedPoint {
        line,
        name,
        touch: Touch {
            drawn_m: [x, y, z],
            touched_m: touched.map(|mm| 1e-3 * mm),
        },
    })
}

/// Points with columns `x_m,y_m,z_m` in any order, and a `name` where one is wanted.
///
/// # Errors
/// [`TableError`], with the line.
pub fn drawn_points(text: &str) -> Result<Vec<DrawnPoint>, TableError> {
    points(text, &DRAWN, |line, name, drawn_m| DrawnPoint { line, name, drawn_m })
}

/// All rows, each of which `point` makes of its line, name and numbers.
fn points<const N: usize, T>(
    text: &str,
    columns: &[&str; N],
    point: impl Fn(usize, Option<String>, [f64; N]) -> T,
) -> Result<Vec<T>, TableError> {
    let shape = TableShape {
        required: columns,
        optional: &[&NAME],
        most: 1e3 * GREATEST,
        most_rows: MOST,
        has_comments: true,
    };
    let table = NumberTable::read(text, &shape)?;
    let (name, places) = (table.places(&NAME), table.places(columns));
    let row = |row: Result<Row<'_>, TableError>| {
        let row = row?;
        let name = name.map(|[place]| row.text(place).to_owned());
        let numbers = places.map(|places| row.numbers(places)).transpose()?;
        Ok(point(row.line, name, numbers.unwrap_or([f64::NAN; N])))
    };
    table.rows().map(row).collect()
}

/// A unit of length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// m
    Metre,
    /// mm
    Millimetre,
}

impl std::fmt::Display for Unit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Metre => "metres",
            Self::Millimetre => "millimetres",
        })
    }
}

/// Why touched points give no mount. Points count from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AlignError {
    /// Fewer than three points, or more than anybody touches.
    #[error("{found} points; at least 3 that are not in line, and at most {most}, give a mount")]
    Count {
        /// How many.
        found: usize,
        /// How many are possible.
        most: usize,
    },
    /// A coordinate that is not finite or out of this world.
    #[error("point {point}: its coordinates must be numbers from -{most} to {most} m; found {found}")]
    Coordinate {
        /// Index of the point.
        point: usize,
        /// The coordinate \[m\].
        found: f64,
        /// What it may be at most \[m\].
        most: f64,
    },
    /// Two points in one place.
    #[error("points {} and {} are {} apart as they are {how}; touch points that are farther apart than {}", .points[0], .points[1], millimetres(*.apart_m), millimetres(*.least_m))]
    Coincident {
        /// Their indices.
        points: [usize; 2],
        /// How far they are apart \[m\].
        apart_m: f64,
        /// How far they must be apart \[m\].
        least_m: f64,
        /// Drawn or touched.
        how: &'static str,
    },
    /// All points are nearly in line.
    #[error(
        "the points, as they are {how}, lie within {} of one line, so that the turn about it is not known; touch one at least {} beside it",
        millimetres(*.beside_m),
        millimetres(*.least_m)
    )]
    InLine {
        /// How far the points are from it, root mean square \[m\].
        beside_m: f64,
        /// How far they must be \[m\].
        least_m: f64,
        /// Drawn or touched.
        how: &'static str,
    },
    /// Lengths that differ by a factor of a thousand.
    #[error(
        "the points are {ratio:.6} times as far apart as touched as they are drawn: the {which} coordinates seem to be in {found}; \
         expected {expected}"
    )]
    Units {
        /// Lengths touched over lengths drawn.
        ratio: f64,
        /// Drawn or touched.
        which: &'static str,
        /// What they seem to be in.
        found: Unit,
        /// What they should be in.
        expected: Unit,
    },
    /// A mirror image fits, and no rotation does.
    #[error(
        "a mirror image of the points fits to {}, and no rotation better than {}: an axis of the drawing points the other way, or two \
         points are exchanged",
        millimetres(*.mirrored_m),
        millimetres(*.rotated_m)
    )]
    Mirrored {
        /// Root mean square of what is left with a mirror \[m\].
        mirrored_m: f64,
        /// The same with a rotation \[m\].
        rotated_m: f64,
    },
    /// The table would hang from the ceiling.
    #[error(
        "the table would lie upside down at the arm, its z tilted by {tilt_deg:.1}° against the base's: touched in another order than \
         drawn, or an axis of the drawing points the other way"
    )]
    UpsideDown {
        /// Angle between both z axes \[°\].
        tilt_deg: f64,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_permutation_comes_once() {
        let mut order = vec![0, 1, 2, 3];
        let mut all = std::collections::BTreeSet::from([order.clone()]);
        while next(&mut order) {
            assert!(all.insert(order.clone()));
        }
        assert_eq!(all.len(), 24);
        assert!(!next(&mut []) && !next(&mut [0]));
    }
}
