//! Mount of an arm at a table, computed from points touched with its tip.
//!
//! A touched point is known twice: in the drawing of the table, which is the world (`p`), and as the pendant shows the tip there, in the
//! frame of the controller's base (`b`), which is not the root link of every arm ([`Alignment::of_root`]). The mount `T_world_base` is the rotation R and the translation t for which Σ |p − (R b + t)|² is least (Kabsch 1976,
//! Umeyama 1991): with the singular values of the covariance, and with the sign that makes R a rotation and no mirror.
//!
//! | concept | module |
//! | --- | --- |
//! | the fit, and how well the points fix it | `fit` |
//! | touched in another order than drawn | `order` |
//! | points in text | `table` |
//! | errors | `error` |
//!
//! The fit is the mount with the least squared residuals; the spread of the points shows how well they fix it.
//!
//! Points may have been touched in another order than they are drawn.
//!
//! Points come as text: a header, then a point per line, separated by commas. Empty lines and comments after `#` are skipped.
//!
//! The errors are the cases in which points give no mount.

use nalgebra::{Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};
use platewash::kinematics::trig::acos;
use platewash::kinematics::{Pose, RobotModel};
use platewash::workcell::number_table::{NumberTable, Row, TableError, TableShape};
use platewash::workcell::plate::GREATEST_M;
use platewash::workcell::words::millimetres;

/// Greatest number of points.
const MOST: usize = 10_000;

/// Least distance between two points \[m\].
const APART_M: f64 = 0.01;

/// Least distance of the points from the line that fits them best, root mean square \[m\], and below as a share of their spread along it.
const BESIDE_M: f64 = 0.005;
const BESIDE_SHARE: f64 = 0.02;

/// Greatest absolute coordinate \[m\]. A drawing in millimetres is below it, so that it is refused for its unit and not for its size.
const GREATEST: f64 = 1e3 * GREATEST_M;

/// Greatest factor between a ratio of lengths and 1/1000 for which the ratio counts as a slip of units.
const NEAR: f64 = 2.0;

/// Greatest size of a table on which an arm works \[m\].
const TABLE_M: f64 = 10.0;

/// Greatest residual of a mirror image as a share of the rotation's, and below the least residual of the rotation \[m\], for the points to
/// count as mirrored.
const MIRROR_SHARE: f64 = 0.25;
const MISFIT_M: f64 = 0.002;

/// Touched point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Position in the drawing, world frame \[m\].
    pub drawn_m: [f64; 3],
    /// Position of the tip, frame of the controller's base \[m\].
    pub touched_m: [f64; 3],
}

/// Mount of the arm with the quality of the fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Alignment {
    /// Mount of the frame in which the points were touched, `T_world_base`: the controller's base.
    pub mount: Pose,
    /// Residual of each point: the drawn position less the touched one in the world frame \[m\].
    pub residuals_m: Vec<[f64; 3]>,
    /// Length of the residuals, root mean square \[m\].
    pub rms_m: f64,
    /// Spread of the drawn points about their middle, root mean square, along their longest direction and beside it \[m\].
    pub spread_m: [f64; 2],
    /// Ratio of touched to drawn lengths; 1 if nothing is stretched.
    pub stretch: f64,
}

impl Alignment {
    /// Angle between the world's z axis and the base's \[rad\]: the tilt of the table as the arm sees it.
    #[must_use]
    pub fn tilt_rad(&self) -> f64 {
        let up = self.mount.rotation * Vector3::z();
        acos(up.z.clamp(-1.0, 1.0))
    }

    /// Index of the point with the longest residual, and the length \[m\].
    #[must_use]
    pub fn worst(&self) -> (usize, f64) {
        let lengths = self.residuals_m.iter().map(|r| Vector3::from(*r).norm()).enumerate();
        lengths.fold((0, 0.0), |worst, found| if found.1 > worst.1 { found } else { worst })
    }

    /// Returns the same fit with the mount of the arm's root link, `T_world_root = T_world_base · T_base_root`.
    #[must_use]
    pub fn of_root(&self, arm: &RobotModel) -> Self {
        let base = arm.controller_base();
        Self {
            mount: base.map_or(self.mount, |base| self.mount * base.pose.inverse()),
            ..self.clone()
        }
    }

    /// Converts a point of the drawing to the mounted frame \[m\].
    #[must_use]
    pub fn in_base(&self, drawn_m: [f64; 3]) -> [f64; 3] {
        self.mount.inverse_transform_point(&Point3::from(drawn_m)).coords.into()
    }
}

/// Computes the mount that fits best, in the sense of least squares.
///
/// # Errors
/// [`AlignError`]: points that fix no mount, or fix an implausible one. A bad fit is no error: see [`Alignment::rms_m`].
pub fn align(touches: &[Touch]) -> Result<Alignment, AlignError> {
    check(touches)?;
    let drawn = Cloud::new("drawn", touches, |touch| touch.drawn_m);
    let touched = Cloud::new("touched", touches, |touch| touch.touched_m);
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

/// Points relative to their middle.
struct Cloud {
    /// "drawn" or "touched", for messages.
    how: &'static str,
    middle: Vector3<f64>,
    about: Vec<Vector3<f64>>,
}

impl Cloud {
    fn new(how: &'static str, touches: &[Touch], which: fn(&Touch) -> [f64; 3]) -> Self {
        let points = || touches.iter().map(|touch| Vector3::from(which(touch)));
        let middle = points().sum::<Vector3<f64>>() / touches.len() as f64;
        let about = points().map(|point| point - middle).collect();
        Self { how, middle, about }
    }

    /// Root mean square of the distances from the middle \[m\].
    fn size_m(&self) -> f64 {
        root_mean_square(self.about.iter().copied())
    }

    /// Checks that no two points coincide.
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

    /// Returns the spread of the points along and beside their longest direction \[m\]. Refuses points in line.
    fn check_breadth(&self) -> Result<[f64; 2], AlignError> {
        let spread = self.about.iter().map(|p| p * p.transpose()).sum::<Matrix3<f64>>() / self.about.len() as f64;
        let mut along = spread.symmetric_eigenvalues().map(|value| value.max(0.0).sqrt());
        along.as_mut_slice().sort_unstable_by(f64::total_cmp);
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

/// Checks the number of points and their coordinates. NaN is refused.
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

/// Refuses points that are about a thousand times closer together as touched than as drawn: one of both is in another unit.
fn check_units(ratio: f64, drawn_m: f64) -> Result<(), AlignError> {
    if !(1e-3 / NEAR..=1e-3 * NEAR).contains(&ratio) {
        return Ok(());
    }
    let (which, found, expected) = match drawn_m > TABLE_M {
        true => ("drawn", "millimetres", "metres"),
        false => ("touched", "metres", "millimetres"),
    };
    Err(AlignError::Units {
        ratio,
        which,
        found,
        expected,
    })
}

/// Greatest number of points for which all orders are tried: 720 orders.
const MOST_IN_ORDER: usize = 6;

/// Returns the order in which the touched points fit the drawn ones within `tolerance_m` \[m\], root mean square. Entry k is the touched
/// point that belongs to the drawn one k. `None` if no other order than the given one fits, and for more than six points.
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

/// Changes `order` to the next permutation in lexicographic order; returns false after the last.
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

/// Columns of a touched point: those of a drawn one, and the touched position in the base frame \[mm\], as a pendant shows it.
const TOUCHED: [&str; 6] = ["x_m", "y_m", "z_m", "touched_x_mm", "touched_y_mm", "touched_z_mm"];

/// Optional column.
const NAME: [&str; 1] = ["name"];

/// Touched point with its line.
#[derive(Debug, Clone, PartialEq)]
pub struct TouchedPoint {
    /// Line number, from 1.
    pub line: usize,
    /// Name, if the text has names.
    pub name: Option<String>,
    /// Drawn and touched position.
    pub touch: Touch,
}

/// Point of the drawing with its line.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnPoint {
    /// Line number, from 1.
    pub line: usize,
    /// Name, if the text has names.
    pub name: Option<String>,
    /// Position, world frame \[m\].
    pub drawn_m: [f64; 3],
}

/// Reads points with columns `x_m,y_m,z_m,touched_x_mm,touched_y_mm,touched_z_mm` in any order, and an optional `name`.
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

/// Reads points with columns `x_m,y_m,z_m` in any order, and an optional `name`.
///
/// # Errors
/// [`TableError`], with the line.
pub fn drawn_points(text: &str) -> Result<Vec<DrawnPoint>, TableError> {
    points(text, &DRAWN, |line, name, drawn_m| DrawnPoint { line, name, drawn_m })
}

/// Reads all rows. `point` builds a point from its line, name and numbers.
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

/// Reason that touched points give no mount. Points count from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AlignError {
    /// There are fewer than three points, or too many.
    #[error("{found} points; at least 3 that are not in line, and at most {most}, give a mount")]
    Count {
        /// Number of points.
        found: usize,
        /// Greatest number.
        most: usize,
    },
    /// A coordinate is not finite or too large.
    #[error("point {point}: its coordinates must be numbers from -{most} to {most} m; found {found}")]
    Coordinate {
        /// Index of the point.
        point: usize,
        /// Coordinate \[m\].
        found: f64,
        /// Greatest absolute value \[m\].
        most: f64,
    },
    /// Two points coincide.
    #[error("points {} and {} are {} apart as they are {how}; touch points that are farther apart than {}", .points[0], .points[1], millimetres(*.apart_m), millimetres(*.least_m))]
    Coincident {
        /// Indices of the points.
        points: [usize; 2],
        /// Distance between them \[m\].
        apart_m: f64,
        /// Least distance \[m\].
        least_m: f64,
        /// "drawn" or "touched".
        how: &'static str,
    },
    /// All points are nearly in line.
    #[error(
        "the points, as they are {how}, lie within {} of one line, so that the turn about it is not known; touch one at least {} beside it",
        millimetres(*.beside_m),
        millimetres(*.least_m)
    )]
    InLine {
        /// Distance of the points from the line, root mean square \[m\].
        beside_m: f64,
        /// Least distance \[m\].
        least_m: f64,
        /// "drawn" or "touched".
        how: &'static str,
    },
    /// Touched and drawn lengths differ by a factor of a thousand.
    #[error(
        "the points are {ratio:.6} times as far apart as touched as they are drawn: the {which} coordinates seem to be in {found}; \
         expected {expected}"
    )]
    Units {
        /// Ratio of touched to drawn lengths.
        ratio: f64,
        /// "drawn" or "touched".
        which: &'static str,
        /// Unit that the coordinates seem to have.
        found: &'static str,
        /// Unit that they should have.
        expected: &'static str,
    },
    /// A mirror image fits, and no rotation does.
    #[error(
        "a mirror image of the points fits to {}, and no rotation better than {}: an axis of the drawing points the other way, or two \
         points are exchanged",
        millimetres(*.mirrored_m),
        millimetres(*.rotated_m)
    )]
    Mirrored {
        /// Residual with a mirror, root mean square \[m\].
        mirrored_m: f64,
        /// Residual with a rotation, root mean square \[m\].
        rotated_m: f64,
    },
    /// The mount would hang from the ceiling.
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
