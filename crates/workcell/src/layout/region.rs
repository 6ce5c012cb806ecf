//! Region of the plate centres.
//!
//! A range of azimuths about the base axis is represented by half planes.
//!
//! The footprint of the arm's base is computed here, too.

use crate::layout::error::{InputProblem, LayoutError, not_negative, range};
use crate::layout::footprint::BaseFootprint;
use nalgebra::Matrix3;
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::trig::sin_cos;
use platewash_kinematics::{Pose, RobotModel};
use serde::{Deserialize, Serialize};

/// Region of plate centres, in the base frame (z up, origin on the base axis): the points that satisfy every range that is given.
/// Boundaries belong to it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Region {
    /// Least and greatest x \[m\].
    pub x_m: [f64; 2],
    /// Least and greatest y \[m\].
    pub y_m: [f64; 2],
    /// Least and greatest distance from the base axis \[m\]; `None` for no limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rho_m: Option<[f64; 2]>,
    /// Range of azimuths about the base axis, degrees counter-clockwise from base x, at most 360 wide and written in any turn (`[-110,
    /// 110]`, `[250, 470]`); `None` for no limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub azimuth_deg: Option<[f64; 2]>,
}

impl Region {
    /// Region of the paper's text.
    pub const PAPER_TEXT: Self = Self {
        x_m: [0.0, 0.32],
        y_m: [-0.38, 0.32],
        rho_m: None,
        azimuth_deg: None,
    };
    /// Region of the program in the paper's appendix.
    pub const PAPER_APPENDIX: Self = Self {
        x_m: [0.0, 0.30],
        y_m: [-0.38, 0.38],
        rho_m: None,
        azimuth_deg: None,
    };

    /// Refuses ranges that are not finite, reversed or of zero width, a negative `rho_m` and an `azimuth_deg` wider than
    /// a turn.
    ///
    /// # Errors
    ///
    /// [`LayoutError::InvalidInput`], naming the key.
    pub fn validate(&self) -> Result<(), LayoutError> {
        range("x_m", self.x_m)?;
        range("y_m", self.y_m)?;
        if let Some(rho) = self.rho_m {
            not_negative("rho_m", rho[0])?;
            range("rho_m", rho)?;
        }
        if let Some(azimuth) = self.azimuth_deg {
            range("azimuth_deg", azimuth)?;
            if azimuth[1] - azimuth[0] > 360.0 {
                return Err(LayoutError::invalid("azimuth_deg", InputProblem::MoreThanATurn));
            }
        }
        Ok(())
    }

    /// True if the point `[x, y]` \[m\] of the base frame belongs to the region.
    #[must_use]
    pub fn contains(&self, point_m: [f64; 2]) -> bool {
        Area::new(self).contains(point_m)
    }
}

/// Region prepared for many queries.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Area {
    low: [f64; 2],
    high: [f64; 2],
    rho_squared: Option<[f64; 2]>,
    wedge: Wedge,
}

/// Axis-aligned rectangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct QuadCell {
    pub(crate) middle: [f64; 2],
    pub(crate) half: [f64; 2],
}

impl QuadCell {
    /// Square of the greatest distance from `p` to a point of the rectangle.
    pub(crate) fn farthest_squared(&self, p: [f64; 2]) -> f64 {
        let dx = (self.middle[0] - p[0]).abs() + self.half[0];
        let dy = (self.middle[1] - p[1]).abs() + self.half[1];
        dx * dx + dy * dy
    }

    /// Square of the least distance from `p` to a point of the rectangle.
    fn nearest_squared(&self, p: [f64; 2]) -> f64 {
        let dx = ((self.middle[0] - p[0]).abs() - self.half[0]).max(0.0);
        let dy = ((self.middle[1] - p[1]).abs() - self.half[1]).max(0.0);
        dx * dx + dy * dy
    }

    fn corners(&self) -> [[f64; 2]; 4] {
        let ([x, y], [hx, hy]) = (self.middle, self.half);
        [[x - hx, y - hy], [x + hx, y - hy], [x + hx, y + hy], [x - hx, y + hy]]
    }
}

impl Area {
    pub(crate) fn new(region: &Region) -> Self {
        let reach = region.rho_m.map_or(f64::INFINITY, |rho| rho[1]);
        Self {
            low: [region.x_m[0].max(-reach), region.y_m[0].max(-reach)],
            high: [region.x_m[1].min(reach), region.y_m[1].min(reach)],
            rho_squared: region.rho_m.map(|[low, high]| [low * low, high * high]),
            wedge: region.azimuth_deg.map_or(Wedge::Full, Wedge::new),
        }
    }

    pub(crate) fn wedge(&self) -> &Wedge {
        &self.wedge
    }

    /// Lower corner of a box around the area.
    pub(crate) fn low(&self) -> [f64; 2] {
        self.low
    }

    /// Size of that box; not positive if the area is empty.
    pub(crate) fn size(&self) -> [f64; 2] {
        [self.high[0] - self.low[0], self.high[1] - self.low[1]]
    }

    pub(crate) fn contains(&self, p: [f64; 2]) -> bool {
        let in_box = p[0] >= self.low[0] && p[0] <= self.high[0] && p[1] >= self.low[1] && p[1] <= self.high[1];
        in_box
            && self
                .rho_squared
                .is_none_or(|[low, high]| (low..=high).contains(&(p[0] * p[0] + p[1] * p[1])))
            && self.wedge.contains(p)
    }

    /// True if a cell of the box is certainly outside. A cell outside may be missed; the reverse never happens.
    pub(crate) fn excludes(&self, cell: &QuadCell) -> bool {
        let ring = self
            .rho_squared
            .is_some_and(|[low, high]| cell.farthest_squared([0.0; 2]) < low || cell.nearest_squared([0.0; 2]) > high);
        ring || self.wedge.excludes(&cell.corners())
    }
}

type Point = [f64; 2];

/// Points whose azimuth lies in a closed range. No angle is computed per query: membership is the sign of cross products with the two
/// bounding rays.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Wedge {
    /// Every azimuth.
    Full,
    /// At most half a turn, counter-clockwise from the ray `from` to the ray `to`: an intersection of half planes.
    Convex { from: Point, to: Point, middle: Point },
    /// More than half a turn: the complement of the open convex wedge from the ray `to` to the ray `from`.
    Reflex { from: Point, to: Point },
}

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Unit vector at an azimuth, exact at multiples of 90° (so that a plate on an axis belongs to `[-90, 90]`).
fn ray(azimuth_deg: f64) -> Point {
    let azimuth_deg = azimuth_deg.rem_euclid(360.0);
    let quarter = (azimuth_deg / 90.0).floor();
    let (sin, cos) = sin_cos((azimuth_deg - 90.0 * quarter).to_radians());
    match quarter as u8 % 4 {
        0 => [cos, sin],
        1 => [-sin, cos],
        2 => [-cos, -sin],
        _ => [sin, -cos],
    }
}

impl Wedge {
    /// Returns the wedge of azimuths from `low_deg` to `high_deg`, counter-clockwise from base x, 0 < `high_deg` − `low_deg` ≤ 360.
    pub(crate) fn new([low_deg, high_deg]: [f64; 2]) -> Self {
        let (from, to) = (ray(low_deg), ray(high_deg));
        let width_deg = high_deg - low_deg;
        if width_deg >= 360.0 {
            Self::Full
        } else if width_deg > 180.0 {
            Self::Reflex { from, to }
        } else {
            Self::Convex {
                from,
                to,
                middle: ray(low_deg + 0.5 * width_deg),
            }
        }
    }

    pub(crate) fn contains(&self, p: Point) -> bool {
        match *self {
            Self::Full => true,
            Self::Convex { from, to, .. } => cross(from, p) >= 0.0 && cross(p, to) >= 0.0,
            Self::Reflex { from, to } => cross(to, p) <= 0.0 || cross(p, from) <= 0.0,
        }
    }

    /// True if the convex hull of `corners` is certainly outside. A polygon outside may be missed; the reverse never happens.
    pub(crate) fn excludes(&self, corners: &[Point; 4]) -> bool {
        let all = |outside: &dyn Fn(Point) -> bool| corners.iter().all(|&p| outside(p));
        match *self {
            Self::Full => false,
            Self::Convex { from, to, middle } => {
                all(&|p| cross(from, p) < 0.0) || all(&|p| cross(p, to) < 0.0) || all(&|p| dot(middle, p) < 0.0)
            }
            Self::Reflex { .. } => all(&|p| !self.contains(p)),
        }
    }

    /// Returns the outward normals of the half planes through the origin that contain the wedge; empty if it is not convex.
    pub(crate) fn outward_normals(&self) -> Vec<Point> {
        match *self {
            Self::Convex { from, to, .. } => vec![[from[1], -from[0]], [-to[1], to[0]]],
            Self::Full | Self::Reflex { .. } => Vec::new(),
        }
    }
}

/// Half side of the footprint assumed for an arm whose base has no collision geometry \[m\].
const DEFAULT_HALF_SIDE_M: f64 = 0.09;

/// Sine of the angle to the vertical up to which a base counts as upright.
const UPRIGHT: f64 = 1e-9;

/// Returns the rectangle around the links that stand on the floor and never move: the bounds of the base's collision shapes, or ± 90 mm if
/// there are none.
#[must_use]
pub fn base_footprint(robot: &RobotModel) -> BaseFootprint {
    turned_footprint(robot, &Matrix3::identity())
}

/// Returns the footprint of an arm mounted at `T_world_base`, in the frame of the layout; `None` if its base does not stand upright, so
/// that no plate is level with it.
#[must_use]
pub fn mounted_footprint(robot: &RobotModel, mount: &Pose) -> Option<BaseFootprint> {
    let turned = RigidTransform::from(mount).rotation;
    let [across, along] = [turned.m13.abs().max(turned.m23.abs()), turned.m33];
    (across <= UPRIGHT && along > 0.0).then(|| turned_footprint(robot, &turned))
}

/// Returns the footprint of an arm with a rotated base.
fn turned_footprint(robot: &RobotModel, turned: &Matrix3<f64>) -> BaseFootprint {
    let mut bounds = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    let base = robot.fk(&nalgebra::Vector6::zeros());
    for link in robot.links().iter().filter(|link| link.frame.body() == 0) {
        let placed = base.rigid(&link.frame);
        for primitive in &link.collision {
            let shape = placed.then(&RigidTransform::from(&primitive.pose));
            let shape = RigidTransform {
                rotation: turned * shape.rotation,
                translation: turned * shape.translation,
            };
            for (axis, [least, most]) in bounds.iter_mut().enumerate() {
                let along = shape.rotation.row(axis).transpose();
                let centre = shape.translation[axis];
                *least = least.min(centre - primitive.shape.support(&-along));
                *most = most.max(centre + primitive.shape.support(&along));
            }
        }
    }
    let [x_m, y_m] = bounds.map(|[least, most]| {
        if least < most {
            [least, most]
        } else {
            [-DEFAULT_HALF_SIDE_M, DEFAULT_HALF_SIDE_M]
        }
    });
    BaseFootprint { x_m, y_m }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn axes_belong_to_the_wedges_they_bound() {
        for (range, p) in [
            ([-90.0, 90.0], [0.0, 0.3]),
            ([-90.0, 90.0], [0.0, -0.3]),
            ([0.0, 180.0], [-0.3, 0.0]),
        ] {
            assert!(Wedge::new(range).contains(p), "{range:?} {p:?}");
        }
        assert!(Wedge::new([-180.0, 180.0]).contains([-0.3, 0.0]));
        assert!(Wedge::new([90.0, 360.0]).contains([0.0, 0.3]) && Wedge::new([90.0, 360.0]).contains([0.3, 0.0]));
        assert!(!Wedge::new([90.0, 360.0]).contains([0.3, 0.1]));
        assert!(Wedge::new([250.0, 470.0]).contains([1.0, 0.0]) && !Wedge::new([250.0, 470.0]).contains([-1.0, 0.0]));
    }

    proptest! {
        #[test]
        fn membership_agrees_with_the_angle(low in -360.0..360.0_f64, width in 0.01..360.0_f64, azimuth in -180.0..180.0_f64, rho in 1e-3..2.0_f64) {
            let offset = (azimuth - low).rem_euclid(360.0);
            prop_assume!(offset > 1e-9 && (offset - width).abs() > 1e-9 && offset < 360.0 - 1e-9);
            let (sin, cos) = sin_cos(azimuth.to_radians());
            prop_assert_eq!(Wedge::new([low, low + width]).contains([rho * cos, rho * sin]), offset < width);
        }

        #[test]
        fn no_point_of_an_excluded_square_is_inside(low in -360.0..360.0_f64, width in 0.01..360.0_f64, x in -1.0..1.0_f64, y in -1.0..1.0_f64, h in 0.0..0.5_f64, u in -1.0..1.0_f64, v in -1.0..1.0_f64) {
            let wedge = Wedge::new([low, low + width]);
            let corners = [[x - h, y - h], [x + h, y - h], [x + h, y + h], [x - h, y + h]];
            prop_assert!(!(wedge.excludes(&corners) && wedge.contains([x + u * h, y + v * h])));
        }
    }
}
