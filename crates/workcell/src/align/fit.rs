//! The mount that fits touched points best, and how well they fix it.

use super::error::{AlignError, Unit};
use crate::plate::GREATEST_M;
use crate::trig::acos;
use nalgebra::{Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};
use platewash_kinematics::Pose;

/// Points that are taken at most.
pub(super) const MOST: usize = 10_000;

/// How far two points must be apart \[m\].
const APART_M: f64 = 0.01;

/// How far the points must be from the line that fits them best, root mean square \[m\], and as a share of how far they are along it.
const BESIDE_M: f64 = 0.005;
const BESIDE_SHARE: f64 = 0.02;

/// What a coordinate may be at most \[m\]: a drawing in millimetres is refused for that, and not for its size.
pub(super) const GREATEST: f64 = 1e3 * GREATEST_M;

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
    let alignment = fitted(touches)?;
    let tilt_rad = alignment.tilt_rad();
    if tilt_rad > std::f64::consts::FRAC_PI_2 {
        let tilt_deg = tilt_rad.to_degrees();
        return Err(AlignError::UpsideDown { tilt_deg });
    }
    Ok(alignment)
}

/// The same whichever way up the table is.
pub(super) fn fitted(touches: &[Touch]) -> Result<Alignment, AlignError> {
    check(touches)?;
    let drawn = Cloud::of(touches, |touch| touch.drawn_m);
    let touched = Cloud::of(touches, |touch| touch.touched_m);
    check_units([drawn.size_m(), touched.size_m()])?;
    drawn.check_apart("drawn")?;
    touched.check_apart("touched")?;
    let stretch = touched.size_m() / drawn.size_m();
    let spread_m = drawn.check_breadth("drawn")?;
    touched.check_breadth("touched")?;
    let (rotation, mirror) = rotations(&drawn, &touched);
    let [rms_m, mirrored_m] = [rotation, mirror].map(|turn| left(&drawn, &touched, &turn));
    if rms_m > MISFIT_M && mirrored_m < MIRROR_SHARE * rms_m {
        return Err(AlignError::Mirrored {
            mirrored_m,
            rotated_m: rms_m,
        });
    }
    let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation));
    let translation = drawn.middle - rotation * touched.middle;
    let mount = Pose::from_parts(translation.into(), rotation);
    let residual = |touch: &Touch| -> [f64; 3] {
        (Point3::from(touch.drawn_m) - mount.transform_point(&Point3::from(touch.touched_m))).into()
    };
    Ok(Alignment {
        mount,
        residuals_m: touches.iter().map(residual).collect(),
        rms_m,
        spread_m,
        stretch,
    })
}

/// Points about their middle.
struct Cloud {
    middle: Vector3<f64>,
    about: Vec<Vector3<f64>>,
}

impl Cloud {
    fn of(touches: &[Touch], which: fn(&Touch) -> [f64; 3]) -> Self {
        let points = || touches.iter().map(|touch| Vector3::from(which(touch)));
        let middle = points().sum::<Vector3<f64>>() / touches.len() as f64;
        Self {
            middle,
            about: points().map(|point| point - middle).collect(),
        }
    }

    /// Root mean square of the distances from the middle \[m\].
    fn size_m(&self) -> f64 {
        mean(self.about.iter().map(Vector3::norm_squared), self.about.len()).sqrt()
    }

    /// Refuses two points in one place.
    fn check_apart(&self, how: &'static str) -> Result<(), AlignError> {
        let mut sorted: Vec<usize> = (0..self.about.len()).collect();
        sorted.sort_by(|a, b| self.about[*a].x.total_cmp(&self.about[*b].x));
        for (at, &a) in sorted.iter().enumerate() {
            let near = sorted[at + 1..].iter();
            for &b in near.take_while(|b| self.about[**b].x - self.about[a].x < APART_M) {
                let apart_m = (self.about[a] - self.about[b]).norm();
                if apart_m < APART_M {
                    let points = [a.min(b), a.max(b)];
                    return Err(AlignError::Coincident {
                        points,
                        apart_m,
                        least_m: APART_M,
                        how,
                    });
                }
            }
        }
        Ok(())
    }

    /// How far the points reach along and beside their longest direction \[m\], unless that is a line.
    fn check_breadth(&self, how: &'static str) -> Result<[f64; 2], AlignError> {
        let spread = self.about.iter().map(|p| p * p.transpose()).sum::<Matrix3<f64>>() / self.about.len() as f64;
        let mut along = spread.symmetric_eigenvalues().map(|value| value.max(0.0).sqrt());
        along.as_mut_slice().sort_by(f64::total_cmp);
        let [_, beside_m, length_m]: [f64; 3] = along.into();
        let least_m = BESIDE_M.max(BESIDE_SHARE * length_m);
        if beside_m < least_m {
            return Err(AlignError::InLine { beside_m, least_m, how });
        }
        Ok([length_m, beside_m])
    }
}

fn mean(values: impl Iterator<Item = f64>, count: usize) -> f64 {
    values.sum::<f64>() / count as f64
}

/// The rotation that carries the touched points nearest to the drawn ones, and the mirror that does.
fn rotations(drawn: &Cloud, touched: &Cloud) -> (Matrix3<f64>, Matrix3<f64>) {
    let pairs = drawn.about.iter().zip(&touched.about);
    let covariance: Matrix3<f64> = pairs.map(|(p, b)| p * b.transpose()).sum();
    // nalgebra sorts singular values from the greatest down; both factors are asked for, and so are there.
    let svd = covariance.svd(true, true);
    let (u, v_t) = (
        svd.u.unwrap_or_else(Matrix3::identity),
        svd.v_t.unwrap_or_else(Matrix3::identity),
    );
    let sign = if (u * v_t).determinant() < 0.0 { -1.0 } else { 1.0 };
    let with = |last: f64| u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, last)) * v_t;
    (with(sign), with(-sign))
}

/// What is left with a rotation or a mirror, root mean square \[m\].
fn left(drawn: &Cloud, touched: &Cloud, turn: &Matrix3<f64>) -> f64 {
    let pairs = drawn.about.iter().zip(&touched.about);
    mean(pairs.map(|(p, b)| (p - turn * b).norm_squared()), drawn.about.len()).sqrt()
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
fn check_units([drawn_m, touched_m]: [f64; 2]) -> Result<(), AlignError> {
    let ratio = touched_m / drawn_m;
    if !(1e-3 / NEAR..=1e-3 * NEAR).contains(&ratio) {
        return Ok(());
    }
    let (which, found, expected) = if drawn_m > TABLE_M {
        ("drawn", Unit::Millimetre, Unit::Metre)
    } else {
        ("touched", Unit::Metre, Unit::Millimetre)
    };
    Err(AlignError::Units {
        ratio,
        which,
        found,
        expected,
    })
}
