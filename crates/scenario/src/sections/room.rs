//! The `[floor]` and `[table]` sections.

use crate::error::{Problem, conflict};
use crate::keys::stated::first_stated;
use crate::sections::body_shape::pose;
use platewash_keys::Section;
use platewash_kinematics::Pose;
use platewash_kinematics::geometry::Shape;
use platewash_workcell::{Obstacle, ObstacleShape};
use serde::{Deserialize, Serialize};

/// `[floor]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("floor")]
#[serde(default, deny_unknown_fields)]
pub struct FloorSection {
    /// True where there is a floor: all below its height is an obstacle.
    #[key(domain = Bool, default = true)]
    pub present: bool,
    /// z of the floor. Without it, 0.
    #[key(unit = "m", domain = Number(-10.0, 10.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height_m: Option<f64>,
    /// Distance that arm and tool keep from the floor, beyond wash.clearance_m. Without it, 0.
    #[key(unit = "m", domain = Number(0.0, 1.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub margin_m: Option<f64>,
}

/// `[table]`: a box whose upper side is level.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("table")]
#[serde(default, deny_unknown_fields)]
pub struct TableSection {
    /// Edges of the table's top along its x and y. Without it there is no table, and none of the other keys of one is stated.
    #[key(unit = "m", domain = PairAbove(0.0, 100.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size_m: Option<[f64; 2]>,
    /// z of the table's upper side. Without it, 0.
    #[key(unit = "m", domain = Number(-10.0, 10.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height_m: Option<f64>,
    /// Thickness of the top, downwards. Without it, 0.03.
    #[key(unit = "m", domain = NumberAbove(0.0, 10.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thickness_m: Option<f64>,
    /// x and y of its middle. Without it, the origin.
    #[key(unit = "m", domain = Pair(-100.0, 100.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_m: Option<[f64; 2]>,
    /// Angle about the vertical, counter-clockwise. Without it, 0.
    #[key(unit = "deg", domain = Number(-720.0, 720.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub yaw_deg: Option<f64>,
    /// Distance that arm and tool keep from the table, beyond wash.clearance_m. Without it, 0.
    #[key(unit = "m", domain = Number(0.0, 1.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub margin_m: Option<f64>,
}

/// Name of the table, in messages.
pub(crate) const TABLE: &str = "table";

/// Default thickness of a table's top \[m\].
const TOP_M: f64 = 0.03;

impl FloorSection {
    /// Refuses a height or a margin of a floor that is not present.
    pub(crate) fn check(&self) -> Result<(), Problem> {
        match first_stated(self, Self::KEYS, |name| name != "present" && !self.present) {
            Some(key) => conflict(
                key.path,
                "says nothing where there is no floor: leave it out, or floor.present = false",
            ),
            None => Ok(()),
        }
    }

    /// The floor, where there is one.
    pub(crate) fn obstacle(&self) -> Option<Obstacle> {
        self.present.then(|| Obstacle {
            pose: Pose::translation(0.0, 0.0, self.height_m.unwrap_or(0.0)),
            margin_m: self.margin_m.unwrap_or(0.0),
            ..Obstacle::floor()
        })
    }
}

impl TableSection {
    /// Refuses where and how a table is that has no size.
    pub(crate) fn check(&self) -> Result<(), Problem> {
        match first_stated(self, Self::KEYS, |_| self.size_m.is_none()) {
            Some(key) => conflict(
                "table.size_m",
                format!("is missing; {} is stated, and a table without a size is none", key.path),
            ),
            None => Ok(()),
        }
    }

    /// The table, where there is one.
    pub(crate) fn obstacle(&self) -> Option<Obstacle> {
        let [x, y] = self.size_m?;
        let half_m = [x, y, self.thickness_m.unwrap_or(TOP_M)].map(|edge_m| 0.5 * edge_m);
        let [at_x, at_y] = self.at_m.unwrap_or_default();
        let middle = [at_x, at_y, self.height_m.unwrap_or(0.0) - half_m[2]];
        let shape = ObstacleShape::Convex(Shape::Box { half_m });
        Some(Obstacle {
            margin_m: self.margin_m.unwrap_or(0.0),
            ..Obstacle::new(TABLE, shape, pose(middle, [0.0, 0.0, self.yaw_deg.unwrap_or(0.0)]))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Point3, Vector3};

    #[test]
    fn the_default_floor_is_a_plain_half_space() {
        assert_eq!(FloorSection::default().obstacle(), Some(Obstacle::floor()));
        assert_eq!(TableSection::default().obstacle(), None);
        let none = FloorSection {
            present: false,
            ..FloorSection::default()
        };
        assert_eq!(none.obstacle(), None);
    }

    /// By hand: a table of 1 m by 0.6 m turned by 90° about its middle at (0.5, 0).
    #[test]
    fn the_body_of_a_table_ends_below_its_height() {
        let table = TableSection {
            size_m: Some([1.0, 0.6]),
            height_m: Some(0.4),
            thickness_m: Some(0.1),
            at_m: Some([0.5, 0.0]),
            yaw_deg: Some(90.0),
            ..TableSection::default()
        };
        let table = table.obstacle().unwrap();
        let ObstacleShape::Convex(Shape::Box { half_m }) = table.shape else {
            panic!("{:?}", table.shape)
        };
        let corner = table.pose * Point3::from(Vector3::from(half_m));
        assert!((corner - Point3::new(0.2, 0.5, 0.4)).norm() < 1e-12, "{corner}");
    }
}
