//! The side of a measured plate that is washed: stated, or unmistakable.

use nalgebra::Vector3;
use platewash_kinematics::trig::atan2;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Direction of a file in which the washed face looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum FaceSide {
    /// +x.
    #[serde(rename = "+x")]
    PlusX,
    /// −x.
    #[serde(rename = "-x")]
    MinusX,
    /// +y.
    #[serde(rename = "+y")]
    PlusY,
    /// −y.
    #[serde(rename = "-y")]
    MinusY,
    /// +z.
    #[serde(rename = "+z")]
    PlusZ,
    /// −z.
    #[serde(rename = "-z")]
    MinusZ,
}

impl FaceSide {
    /// All sides with their names in files and their directions.
    const ALL: [(Self, &str, [f64; 3]); 6] = [
        (Self::PlusZ, "+z", [0.0, 0.0, 1.0]),
        (Self::MinusZ, "-z", [0.0, 0.0, -1.0]),
        (Self::PlusX, "+x", [1.0, 0.0, 0.0]),
        (Self::MinusX, "-x", [-1.0, 0.0, 0.0]),
        (Self::PlusY, "+y", [0.0, 1.0, 0.0]),
        (Self::MinusY, "-y", [0.0, -1.0, 0.0]),
    ];

    fn row(self) -> &'static (Self, &'static str, [f64; 3]) {
        Self::ALL.iter().find(|row| row.0 == self).unwrap_or(&Self::ALL[0])
    }

    /// Name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.row().1
    }

    fn direction(self) -> Vector3<f64> {
        self.row().2.into()
    }

    /// Returns the side that looks most along an axis.
    pub(super) fn along(axis: &Vector3<f64>) -> Self {
        let along = |side: &Self| side.direction().dot(axis);
        let sides = Self::ALL.into_iter().map(|(side, ..)| side);
        sides
            .max_by(|a, b| along(a).total_cmp(&along(b)))
            .unwrap_or(Self::PlusZ)
    }
}

impl fmt::Display for FaceSide {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Difference of both sides' rises from which on a plate is dished, and the side whose rim is higher than its middle is the face; and that below
/// which it is flat, and the side towards +z is. In between both must agree. Shares of the rim's radius.
const DISHED: f64 = 0.04;
pub(super) const FLAT: f64 = 0.01;

/// Least cosine of the angle between an axis and the file's z for which one side is towards +z, and of that to a stated direction.
const UPWARDS: f64 = 0.1;
const STATED: f64 = 0.5;

/// Side that is the face: 0 looks along the axis, 1 against it.
pub(super) enum Side {
    /// It is stated.
    Stated(usize),
    /// It is the one whose rim is much higher than its middle.
    Rising(usize),
    /// It is the one towards the file's +z.
    Upper(usize),
    /// It is the one towards the file's +z, unless the other one, which rises a little, could be the face, too.
    UpperIfAlone(usize),
    /// The axis is across the stated direction, by so many degrees.
    Across(f64),
    /// The axis is level in the file, and the plate is flat.
    Level,
}

impl Side {
    /// Returns the side of a plate about an axis, of which the side along it rises by `rise_m` more than the other one \[m\].
    pub(super) fn new(stated: Option<FaceSide>, axis: &Vector3<f64>, rise_m: f64, rim_m: f64) -> Self {
        if let Some(face) = stated {
            let cosine = face.direction().dot(axis) / axis.norm();
            return match cosine.abs() >= STATED {
                true => Self::Stated(usize::from(cosine < 0.0)),
                false => Self::Across(atan2((1.0 - cosine * cosine).max(0.0).sqrt(), cosine.abs()).to_degrees()),
            };
        }
        let (rising, upper) = (usize::from(rise_m < 0.0), usize::from(axis.z < 0.0));
        let share = rise_m.abs() / rim_m;
        if share > DISHED {
            Self::Rising(rising)
        } else if axis.z.abs() < UPWARDS * axis.norm() {
            Self::Level
        } else if share > FLAT && rising != upper {
            Self::UpperIfAlone(upper)
        } else {
            Self::Upper(upper)
        }
    }
}
