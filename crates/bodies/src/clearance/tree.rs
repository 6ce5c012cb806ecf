//! Fixed body of many parts, examined from the outside in: as a whole, in groups, part by part.
//!
//! The whole and each group are shapes that hold their parts, so that a body far from a shape is far from its parts. A body of one part has
//! no tree.

use crate::clearance::convex::HullFault;
use crate::clearance::distance::Separation;
use crate::clearance::part::{Part, PlacedPart};
use nalgebra::{Point3, Vector3};
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::{BodyPoses, Frame, Pose};
use platewash_workcell::plate::{Foot, Plate, PlateParts};
use platewash_workcell::surface::Surface;
use std::ops::Range;
use std::sync::Arc;

/// Number of sectors of a plate in a group.
const SECTORS: usize = 3;

/// Shapes that hold the parts of a body.
#[derive(Debug, Clone)]
pub(crate) struct Tree {
    /// Shape that holds all parts.
    pub whole: Part,
    /// Groups of parts. Together they have all parts.
    pub groups: Vec<Group>,
    /// Pose-independent body of a plate; `None` for other bodies.
    solid: Option<Arc<Solid>>,
}

/// Some parts of a body with a sphere that holds them.
#[derive(Debug, Clone)]
pub(crate) struct Group {
    pub ball: Part,
    pub members: Range<usize>,
}

/// Pose-independent body of a plate, in the plate's frame.
#[derive(Debug)]
struct Solid {
    surface: Surface,
    thickness_m: f64,
    foot: Option<Foot>,
    whole: Part,
    groups: Vec<Group>,
    parts: Vec<Part>,
}

/// Order of two parts in a distance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Order {
    /// The part of the tree comes first.
    TreeFirst,
    /// The other part comes first.
    TreeSecond,
}

impl Solid {
    fn from_plate(plate: &Plate) -> Option<Self> {
        let made = PlateParts::new(plate);
        let part = |(shape, pose): &_| Part::new(shape, Frame::base().offset(&RigidTransform::from(pose))).ok();
        let whole = part(&made.whole)?;
        let mut parts = made.single.iter().map(part).collect::<Option<Vec<_>>>()?;
        let mut groups: Vec<_> = (0..parts.len())
            .map(|i| Group {
                ball: Part::ball(parts[i].bounding(), parts[i].frame()),
                members: i..i + 1,
            })
            .collect();
        let sector = made.sector.iter().map(part).collect::<Option<Vec<_>>>()?;
        for turns in made.turns.chunks(SECTORS) {
            let first = parts.len();
            for turn in turns {
                let by = RigidTransform::from(&Pose::from_parts(Vector3::zeros().into(), *turn));
                parts.extend(sector.iter().map(|part| part.moved_by(&by)));
            }
            let members = first..parts.len();
            if let Some(ball) = around(&parts[members.clone()]) {
                groups.push(Group { ball, members });
            }
        }
        Some(Self {
            surface: plate.surface,
            thickness_m: plate.thickness_m,
            foot: plate.foot,
            whole,
            groups,
            parts,
        })
    }

    fn is_of(&self, plate: &Plate) -> bool {
        (self.thickness_m, self.foot) == (plate.thickness_m, plate.foot) && self.surface == plate.surface
    }
}

/// Returns the sphere about the middle of the parts' corners that holds them; `None` without parts.
fn around(parts: &[Part]) -> Option<Part> {
    let corners: Vec<_> = parts.iter().flat_map(Part::corners).collect();
    let first = corners.first()?;
    let bounds = corners.iter().fold([*first; 2], |[low, high], corner| {
        [low.zip_map(corner, f64::min), high.zip_map(corner, f64::max)]
    });
    let middle = (bounds[0] + bounds[1]) * 0.5;
    let radius = corners
        .iter()
        .map(|corner| (corner - middle).norm())
        .fold(0.0, f64::max);
    let at = RigidTransform::from(&Pose::from_parts(middle.into(), nalgebra::UnitQuaternion::identity()));
    Some(Part::ball(radius, Frame::base().offset(&at)))
}

impl Tree {
    /// Returns the tree of a plate that is no flat disc, and its parts. The parts of `like` are reused if it has the same shape. `None` for
    /// a disc, and for a plate so thin that its parts have no volume.
    pub fn from_plate(plate: &Plate, like: Option<&Self>) -> Option<(Self, Vec<Part>)> {
        if plate.surface.is_flat() {
            return None;
        }
        let known = like
            .and_then(|tree| tree.solid.as_ref())
            .filter(|solid| solid.is_of(plate));
        let solid = match known {
            Some(solid) => solid.clone(),
            None => Arc::new(Solid::from_plate(plate)?),
        };
        let by = RigidTransform::from(&plate.pose);
        let groups = solid.groups.iter().map(|group| Group {
            ball: group.ball.moved_by(&by),
            members: group.members.clone(),
        });
        let parts = solid.parts.iter().map(|part| part.moved_by(&by)).collect();
        let tree = Self {
            whole: solid.whole.moved_by(&by),
            groups: groups.collect(),
            solid: Some(solid),
        };
        Some((tree, parts))
    }

    /// Returns the tree of some hulls in a fixed frame, and their parts; no tree for a single hull. Fails if there is no hull, or one has
    /// no volume.
    pub fn of_hulls(hulls: &[Vec<Point3<f64>>], frame: Frame) -> Result<(Option<Self>, Vec<Part>), HullFault> {
        let hull = |points: Vec<Point3<f64>>| Part::new(&Shape::Hull { points }, frame);
        let parts = hulls
            .iter()
            .map(|points| hull(points.clone()))
            .collect::<Result<Vec<_>, _>>()?;
        let whole = hull(hulls.concat())?;
        if parts.len() == 1 {
            return Ok((None, parts));
        }
        let groups = parts.iter().enumerate().filter_map(|(i, part)| {
            let ball = around(std::slice::from_ref(part))?;
            let members = i..i + 1;
            Some(Group { ball, members })
        });
        let tree = Self {
            whole,
            groups: groups.collect(),
            solid: None,
        };
        Ok((Some(tree), parts))
    }

    /// Returns the tree of parts that are all grown by a margin \[m\].
    pub fn grown(self, margin_m: f64) -> Self {
        let groups = self.groups.into_iter().map(|group| Group {
            ball: group.ball.grown(margin_m),
            ..group
        });
        Self {
            whole: self.whole.grown(margin_m),
            groups: groups.collect(),
            solid: self.solid,
        }
    }

    /// Returns the distance of the nearest of its parts to another part, if it is less than `below` \[m\].
    pub fn nearest(
        &self,
        parts: &[Part],
        (other, order): (&Part, Order),
        poses: &BodyPoses,
        (measure, below): (impl Fn(&PlacedPart<'_>, &PlacedPart<'_>) -> Separation, f64),
    ) -> Option<Separation> {
        let here = other.rigid(poses);
        let gap = |part: &Part| other.gap_to_sphere(&here, part, &part.origin(poses));
        let placed = other.place(poses);
        let mut best: Option<Separation> = None;
        let limit = |best: &Option<Separation>| best.as_ref().map_or(below, |best| best.distance.min(below));
        for (at_least, group) in ascending(self.groups.iter(), |group| gap(&group.ball), below) {
            if at_least >= limit(&best) {
                break;
            }
            let members = parts[group.members.clone()].iter();
            for (at_least, part) in ascending(members, |part| gap(part), limit(&best)) {
                if at_least >= limit(&best) {
                    break;
                }
                let part = part.place(poses);
                let found = match order {
                    Order::TreeFirst => measure(&part, &placed),
                    Order::TreeSecond => measure(&placed, &part),
                };
                if best.as_ref().is_none_or(|best| found.distance < best.distance) {
                    best = Some(found);
                }
            }
        }
        // NaN is kept.
        best.filter(|best| best.distance.partial_cmp(&below) != Some(std::cmp::Ordering::Greater))
    }
}

/// Returns the items whose bound on the distance is less than `below`, in ascending order; NaN is kept.
fn ascending<T>(
    items: impl Iterator<Item = T>,
    bound: impl Fn(&T) -> f64,
    below: f64,
) -> impl Iterator<Item = (f64, T)> {
    let bounded = items.map(|item| (bound(&item), item));
    let mut near: Vec<_> = bounded
        .filter(|(at_least, _)| *at_least < below || at_least.is_nan())
        .collect();
    near.sort_by(|x, y| x.0.total_cmp(&y.0));
    near.into_iter()
}
