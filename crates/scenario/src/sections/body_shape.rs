//! Shapes of bodies as sections state them: a word with its sizes, or a mesh out of a file.
//!
//! Poses as files state them: a place, and roll, pitch and yaw in degrees.

use crate::error::{Problem, conflict};
use crate::lossy_path::serialize_lossy;
use platewash_kinematics::Pose;
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::rotation::{RigidTransform, from_rpy};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// The keys of a section with a shape: keys before the shape, keys of the shape (its words, greatest edge and greatest radius \[m\],
/// further keys of a mesh), keys behind it.
macro_rules! with_shape_keys {
    ($section:literal, [$($before:expr,)*], $words:expr, $meaning:literal, [$edge_m:literal, $radius_m:literal], [$($of_mesh:expr,)*], [$($behind:expr,)*]) => {
        &[
            $($before,)*
            $crate::keys::key::key(concat!($section, ".shape"), "", $crate::keys::key::Domain::Word($words), $meaning),
            $crate::keys::key::key(concat!($section, ".size_m"), "m", $crate::keys::key::Domain::TripleAbove(0.0, $edge_m), "Edges of a box."),
            $crate::keys::key::key(
                concat!($section, ".radius_m"),
                "m",
                $crate::keys::key::Domain::NumberAbove(0.0, $radius_m),
                "Radius of a cylinder, a capsule or a sphere.",
            ),
            $crate::keys::key::key(
                concat!($section, ".length_m"),
                "m",
                $crate::keys::key::Domain::NumberAbove(0.0, $edge_m),
                "Length of a cylinder; of a capsule, that between the centres of its round ends.",
            ),
            $crate::keys::key::key(
                concat!($section, ".mesh"),
                "",
                $crate::keys::key::Domain::Path,
                "STL, OBJ or Collada file of a mesh, in metres unless mesh_scale or the file says otherwise; relative to the scenario's folder, or `package://` in \
                 robot.package_path.",
            ),
            $crate::keys::key::key(
                concat!($section, ".mesh_scale"),
                "",
                $crate::keys::key::Domain::Scale(-1e6, 1e6),
                "What the coordinates of a mesh are multiplied by: [0.001, 0.001, 0.001] where they are millimetres. Without it, 1. A Collada file that states a unit other than 1 m has none.",
            ),
            $($of_mesh,)*
            $($behind,)*
        ]
    };
}
pub(crate) use with_shape_keys;

/// Keys of a shape, as a section states them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct StatedShape {
    /// Its word.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shape: Option<BodyShape>,
    /// Edges of a box \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size_m: Option<[f64; 3]>,
    /// Radius of a cylinder, a capsule or a sphere \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<f64>,
    /// Length of a cylinder, and of the straight part of a capsule \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length_m: Option<f64>,
    /// File of a mesh.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "serialize_lossy")]
    pub mesh: Option<PathBuf>,
    /// Factors of the mesh's coordinates along x, y, z.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh_scale: Option<[f64; 3]>,
}

/// Kind of a shape, by its word in the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BodyShape {
    /// A box with its edges.
    Box,
    /// A cylinder along its z.
    Cylinder,
    /// A cylinder with half a ball on either end, along its z.
    Capsule,
    /// A ball.
    Sphere,
    /// All below its own z = 0; obstacles alone may be one.
    HalfSpace,
    /// A mesh, read from a file.
    Mesh,
}

impl BodyShape {
    fn words(self) -> &'static str {
        match self {
            Self::Box => "a box",
            Self::Cylinder => "a cylinder",
            Self::Capsule => "a capsule",
            Self::Sphere => "a sphere",
            Self::HalfSpace => "a half-space",
            Self::Mesh => "a mesh",
        }
    }

    /// True, in order, where the shape has edges, a radius, a length.
    fn sizes(self) -> [bool; 3] {
        match self {
            Self::Box => [true, false, false],
            Self::Cylinder | Self::Capsule => [false, true, true],
            Self::Sphere => [false, true, false],
            Self::HalfSpace | Self::Mesh => [false; 3],
        }
    }
}

/// Shape as its section states it; a mesh is not read yet.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum SectionShape<'a> {
    HalfSpace,
    Convex(Shape),
    Mesh { file: &'a Path, scale: Option<[f64; 3]> },
}

impl StatedShape {
    /// The shape of the section called `at` with the sizes that it states: no more and no fewer than the shape has.
    pub(crate) fn stated(&self, at: &str) -> Result<SectionShape<'_>, Problem> {
        let wrong = |key: &str, detail: String| Problem::conflict(format!("{at}.{key}"), detail);
        let Some(shape) = self.shape else {
            return Err(wrong("shape", "is missing; every body has one".to_owned()));
        };
        self.check_sizes(at, shape)?;
        let missing = |key: &str| wrong(key, format!("is missing; {} has one", shape.words()));
        let radius_m = || self.radius_m.ok_or_else(|| missing("radius_m"));
        let half_length_m = || self.length_m.map(|m| 0.5 * m).ok_or_else(|| missing("length_m"));
        Ok(SectionShape::Convex(match shape {
            BodyShape::Box => {
                let edges_m = self.size_m.ok_or_else(|| missing("size_m"))?;
                let half_m = edges_m.map(|edge_m| 0.5 * edge_m);
                Shape::Box { half_m }
            }
            BodyShape::Cylinder => Shape::Cylinder {
                radius_m: radius_m()?,
                half_length_m: half_length_m()?,
            },
            BodyShape::Capsule => Shape::Capsule {
                radius_m: radius_m()?,
                half_length_m: half_length_m()?,
            },
            BodyShape::Sphere => Shape::Sphere { radius_m: radius_m()? },
            BodyShape::HalfSpace => return Ok(SectionShape::HalfSpace),
            BodyShape::Mesh => {
                let file = self.mesh.as_deref();
                return Ok(SectionShape::Mesh {
                    file: file.ok_or_else(|| wrong("mesh", "is missing; it names the file".to_owned()))?,
                    scale: self.mesh_scale,
                });
            }
        }))
    }

    /// Refuses sizes that are none of the shape.
    fn check_sizes(&self, at: &str, shape: BodyShape) -> Result<(), Problem> {
        let of_mesh = [("mesh", self.mesh.is_some()), ("mesh_scale", self.mesh_scale.is_some())];
        for (key, _) in of_mesh.iter().filter(|(_, is_stated)| *is_stated) {
            only_of_mesh(at, key, Some(shape))?;
        }
        let sizes = [
            ("size_m", self.size_m.is_some()),
            ("radius_m", self.radius_m.is_some()),
            ("length_m", self.length_m.is_some()),
        ];
        let spare = sizes
            .iter()
            .zip(shape.sizes())
            .find(|((_, stated), has)| *stated && !has);
        match spare {
            Some(((key, _), _)) => conflict(format!("{at}.{key}"), format!("is not a size of {}", shape.words())),
            None => Ok(()),
        }
    }
}

/// Refuses a key for meshes, in the section called `at`, where the shape is no mesh.
pub(crate) fn only_of_mesh(at: &str, key: &str, shape: Option<BodyShape>) -> Result<(), Problem> {
    if shape == Some(BodyShape::Mesh) {
        return Ok(());
    }
    conflict(format!("{at}.{key}"), "is for shape = \"mesh\" alone")
}

/// The pose at a place \[m\], turned by roll, pitch and yaw about fixed axes in the order x, y, z \[deg\], as in URDF.
#[must_use]
pub(crate) fn pose(at_m: [f64; 3], rpy_deg: [f64; 3]) -> Pose {
    Pose::from(&RigidTransform {
        rotation: from_rpy(rpy_deg.map(f64::to_radians)),
        translation: at_m.into(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_of_zero_changes_no_bit() {
        let at = [0.1, -0.2, 0.3];
        assert_eq!(pose(at, [0.0; 3]), Pose::translation(0.1, -0.2, 0.3));
        // z turned about x by 30° is (0, −½, √¾), and that about z by 90° is (½, 0, √¾).
        let turned = pose([0.0; 3], [30.0, 0.0, 90.0]) * Pose::translation(0.0, 0.0, 1.0);
        let expected = Pose::translation(0.5, 0.0, 0.75_f64.sqrt()).translation;
        assert!((turned.translation.vector - expected.vector).norm() < 1e-15, "{turned}");
    }
}
