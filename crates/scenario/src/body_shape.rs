//! Shapes of bodies by their words and sizes.

use crate::error::Problem;
use platewash_kinematics::geometry::Shape;
use serde::{Deserialize, Serialize};

/// A convex shape by its name.
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
}

impl BodyShape {
    fn words(self) -> &'static str {
        match self {
            Self::Box => "a box",
            Self::Cylinder => "a cylinder",
            Self::Capsule => "a capsule",
            Self::Sphere => "a sphere",
        }
    }
}

/// The shape of the section called `at`, with the sizes that it states \[m\]: no more and no fewer than the shape has.
pub(crate) fn convex(
    at: &str,
    shape: Option<BodyShape>,
    size_m: Option<[f64; 3]>,
    radius_m: Option<f64>,
    length_m: Option<f64>,
) -> Result<Shape, Problem> {
    let wrong = |key: &str, detail: String| Problem::Conflict {
        keys: format!("{at}.{key}"),
        detail,
    };
    let shape = shape.ok_or_else(|| wrong("shape", "is missing; every body has one".to_owned()))?;
    let missing = |key: &str| wrong(key, format!("is missing; {} has one", shape.words()));
    let spare = |key: &str, stated: bool| match stated {
        true => Err(wrong(key, format!("is no size of {}", shape.words()))),
        false => Ok(()),
    };
    if shape == BodyShape::Box {
        spare("radius_m", radius_m.is_some())?;
    } else {
        spare("size_m", size_m.is_some())?;
    }
    if matches!(shape, BodyShape::Box | BodyShape::Sphere) {
        spare("length_m", length_m.is_some())?;
    }
    let radius_m = || radius_m.ok_or_else(|| missing("radius_m"));
    let half_length_m = || length_m.map(|m| 0.5 * m).ok_or_else(|| missing("length_m"));
    Ok(match shape {
        BodyShape::Box => {
            let edges_m = size_m.ok_or_else(|| missing("size_m"))?;
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
    })
}
