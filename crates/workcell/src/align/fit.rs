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
