//! Structure of a URDF: one root, no cycles, six axes in series.
//!
//! The `<limit>` elements of the six axes.
//!
//! Numbers of a description: finite, and no longer than an arm can be.

use crate::joints::{AXES, JointVector};
use crate::limits::{JointFriction, JointLimits};
use crate::rotation::Pose;
use crate::rotation::{RigidTransform, from_rpy};
use crate::urdf::error::UrdfError;
use crate::urdf::unused_statements::Rates;
use crate::words::is_hidden;
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet};
use urdf_rs::{JointType, Robot};

/// Checked URDF tree: links from the root outwards, and the six axes from the base to the tip.
pub(crate) struct Tree<'a> {
    /// Every link, a parent always before its children.
    pub links: Vec<&'a urdf_rs::Link>,
    /// The six moving joints in series.
    pub axes: [&'a urdf_rs::Joint; AXES],
    above: BTreeMap<&'a str, &'a urdf_rs::Joint>,
    positions: BTreeMap<&'a str, usize>,
}

impl<'a> Tree<'a> {
    pub(crate) fn build(robot: &'a Robot) -> Result<Self, UrdfError> {
        check_names("robot", std::iter::once(robot.name.as_str()))?;
        check_names("link", robot.links.iter().map(|l| l.name.as_str()))?;
        check_names("joint", robot.joints.iter().map(|j| j.name.as_str()))?;
        robot.joints.iter().try_for_each(check_kind)?;
        let above = joints_above(robot)?;
        let links = links_from_root(robot, &above)?;
        let axes = axes_in_series(&links, &above)?;
        let positions = links.iter().enumerate().map(|(i, l)| (l.name.as_str(), i)).collect();
        Ok(Self {
            links,
            axes,
            above,
            positions,
        })
    }

    /// Returns the index in `links` of a link that the tree is known to hold.
    pub(crate) fn position(&self, link: &str) -> usize {
        self.positions[link]
    }

    /// Returns the joint whose child is `link`, which is known not to be the root.
    pub(crate) fn joint_above(&self, link: &str) -> &'a urdf_rs::Joint {
        self.above[link]
    }
}

/// Refuses repeated names, and names with hidden characters.
fn check_names<'a>(kind: &'static str, names: impl Iterator<Item = &'a str>) -> Result<(), UrdfError> {
    let mut seen = BTreeSet::new();
    for name in names {
        if name.contains(is_hidden) {
            let name = name.escape_debug().to_string();
            return Err(UrdfError::HiddenCharacter { kind, name });
        }
        if !seen.insert(name) {
            let name = name.to_owned();
            return Err(UrdfError::Duplicate { kind, name });
        }
    }
    Ok(())
}

fn check_kind(joint: &urdf_rs::Joint) -> Result<(), UrdfError> {
    match joint.joint_type {
        JointType::Revolute | JointType::Continuous | JointType::Fixed => Ok(()),
        ref other => Err(UrdfError::JointKind {
            joint: joint.name.clone(),
            kind: format!("{other:?}").to_lowercase(),
        }),
    }
}

/// Returns, for every link but the root, the joint above it.
fn joints_above(robot: &Robot) -> Result<BTreeMap<&str, &urdf_rs::Joint>, UrdfError> {
    let known: BTreeSet<_> = robot.links.iter().map(|l| l.name.as_str()).collect();
    let mut above: BTreeMap<&str, &urdf_rs::Joint> = BTreeMap::new();
    for joint in &robot.joints {
        for (role, link) in [("parent", &joint.parent.link), ("child", &joint.child.link)] {
            if !known.contains(link.as_str()) {
                return Err(UrdfError::UnknownLink {
                    joint: joint.name.clone(),
                    role,
                    link: link.clone(),
                });
            }
        }
        if let Some(first) = above.insert(&joint.child.link, joint) {
            return Err(UrdfError::TwoParents {
                link: joint.child.link.clone(),
                first: first.name.clone(),
                second: joint.name.clone(),
            });
        }
    }
    Ok(above)
}

fn links_from_root<'a>(
    robot: &'a Robot,
    above: &BTreeMap<&str, &urdf_rs::Joint>,
) -> Result<Vec<&'a urdf_rs::Link>, UrdfError> {
    let mut children: BTreeMap<&str, Vec<&urdf_rs::Link>> = BTreeMap::new();
    let mut roots = Vec::new();
    for link in &robot.links {
        match above.get(link.name.as_str()) {
            Some(joint) => children.entry(&joint.parent.link).or_default().push(link),
            None => roots.push(link),
        }
    }
    let [root] = roots[..] else {
        return Err(match (roots.first(), robot.links.first()) {
            (None, Some(link)) => cycle(&link.name, above),
            _ => UrdfError::Roots {
                found: roots.iter().map(|l| l.name.clone()).collect(),
            },
        });
    };
    let mut links = vec![root];
    let mut next = 0;
    while next < links.len() {
        links.extend(children.remove(links[next].name.as_str()).unwrap_or_default());
        next += 1;
    }
    match children.values().flatten().next() {
        Some(unreached) => Err(cycle(&unreached.name, above)),
        None => Ok(links),
    }
}

/// Returns the cycle that `link`, which no root leads to, is in or below. Going upwards, the first link that repeats is in the cycle.
fn cycle<'a>(mut link: &'a str, above: &BTreeMap<&str, &'a urdf_rs::Joint>) -> UrdfError {
    let mut seen = BTreeSet::new();
    while seen.insert(link) {
        link = above.get(link).map_or(link, |joint| &joint.parent.link);
    }
    UrdfError::Cycle { link: link.to_owned() }
}

fn axes_in_series<'a>(
    links: &[&'a urdf_rs::Link],
    above: &BTreeMap<&'a str, &'a urdf_rs::Joint>,
) -> Result<[&'a urdf_rs::Joint; AXES], UrdfError> {
    let moving: Vec<&urdf_rs::Joint> = links
        .iter()
        .filter_map(|link| above.get(link.name.as_str()).copied())
        .filter(|joint| joint.joint_type != JointType::Fixed)
        .collect();
    for pair in moving.windows(2) {
        if nearest_axis_above(&pair[1].parent.link, above) != Some(pair[0].name.as_str()) {
            return Err(UrdfError::Branch {
                joint: pair[1].name.clone(),
                previous: pair[0].name.clone(),
            });
        }
    }
    <[_; AXES]>::try_from(moving).map_err(|moving| UrdfError::AxisCount {
        found: moving.iter().map(|j| j.name.clone()).collect(),
    })
}

fn nearest_axis_above<'a>(mut link: &'a str, above: &BTreeMap<&str, &'a urdf_rs::Joint>) -> Option<&'a str> {
    loop {
        let joint = above.get(link)?;
        if joint.joint_type != JointType::Fixed {
            return Some(&joint.name);
        }
        link = &joint.parent.link;
    }
}

/// Greatest position limit that is accepted \[rad\]; a larger one is probably in degrees.
const LARGEST_POSITION_LIMIT_RAD: f64 = 100.0;

/// Returns the limits of the axes in series. The position of a continuous joint has none but soft ones, even if the file states some.
pub(crate) fn limits(tree: &Tree<'_>, rates: &BTreeMap<String, Rates>) -> Result<JointLimits, UrdfError> {
    let mut limits = JointLimits {
        lower: JointVector::repeat(f64::NEG_INFINITY),
        upper: JointVector::repeat(f64::INFINITY),
        velocity: JointVector::zeros(),
        effort: [None; AXES],
        acceleration: [None; AXES],
        jerk: [None; AXES],
        is_soft: [[false; 2]; AXES],
    };
    for (i, joint) in tree.axes.iter().enumerate() {
        let limit = &joint.limit;
        if [limit.lower, limit.upper, limit.velocity, limit.effort] == [0.0; 4] {
            return Err(missing(joint));
        }
        let ends = match joint.joint_type {
            JointType::Revolute => [limit.lower, limit.upper],
            _ => [f64::NEG_INFINITY, f64::INFINITY],
        };
        let [lower, upper] = positions(joint, ends)?;
        limits.is_soft[i] = [lower != ends[0], upper != ends[1]];
        (limits.lower[i], limits.upper[i]) = (lower, upper);
        limits.velocity[i] = velocity(joint)?;
        limits.effort[i] = effort(joint)?;
        let rates = rates.get(&joint.name).copied().unwrap_or_default();
        (limits.acceleration[i], limits.jerk[i]) = (rates.acceleration, rates.jerk);
    }
    Ok(limits)
}

fn missing(joint: &urdf_rs::Joint) -> UrdfError {
    let name = joint.name.clone();
    match joint.joint_type {
        JointType::Continuous => UrdfError::MissingVelocity { joint: name },
        _ => UrdfError::MissingLimit { joint: name },
    }
}

/// Returns the position limits of a joint: its ends, within the soft limits of `safety_controller`. Soft limits of 0 are none, as they are
/// where the file leaves them out.
fn positions(joint: &urdf_rs::Joint, [mut lower, mut upper]: [f64; 2]) -> Result<[f64; 2], UrdfError> {
    let at = format!("joint '{}'", joint.name);
    if joint.joint_type == JointType::Revolute {
        finite(&at, "limit (lower, upper)", &[lower, upper])?;
    }
    if let Some(soft) = &joint.safety_controller
        && [soft.soft_lower_limit, soft.soft_upper_limit] != [0.0; 2]
    {
        finite(&at, "soft limits", &[soft.soft_lower_limit, soft.soft_upper_limit])?;
        (lower, upper) = (lower.max(soft.soft_lower_limit), upper.min(soft.soft_upper_limit));
    }
    if lower >= upper {
        return Err(UrdfError::LimitOrder {
            joint: joint.name.clone(),
            lower,
            upper,
        });
    }
    if [lower, upper]
        .iter()
        .any(|end| end.is_finite() && end.abs() > LARGEST_POSITION_LIMIT_RAD)
    {
        return Err(UrdfError::LimitSize {
            joint: joint.name.clone(),
            lower,
            upper,
            limit_rad: LARGEST_POSITION_LIMIT_RAD,
        });
    }
    Ok([lower, upper])
}

fn velocity(joint: &urdf_rs::Joint) -> Result<f64, UrdfError> {
    let found = joint.limit.velocity;
    if found.is_finite() && found > 0.0 {
        return Ok(found);
    }
    let joint = joint.name.clone();
    Err(UrdfError::Velocity { joint, found })
}

/// Returns the effort limit. Zero means "unknown" by custom, infinity means "no limit" since URDF 1.2: neither is a limit.
fn effort(joint: &urdf_rs::Joint) -> Result<Option<f64>, UrdfError> {
    let found = joint.limit.effort;
    if found >= 0.0 {
        return Ok(Some(found).filter(|effort| *effort > 0.0 && effort.is_finite()));
    }
    let joint = joint.name.clone();
    Err(UrdfError::Effort { joint, found })
}

/// Returns the friction of the axes in series.
pub(crate) fn friction(tree: &Tree<'_>) -> Result<JointFriction, UrdfError> {
    let mut friction = JointFriction::default();
    for (i, joint) in tree.axes.iter().enumerate() {
        let Some(stated) = &joint.dynamics else { continue };
        for (what, found, kept) in [
            ("damping [N·m·s/rad]", stated.damping, &mut friction.viscous[i]),
            ("friction [N·m]", stated.friction, &mut friction.coulomb[i]),
        ] {
            if !(found >= 0.0 && found.is_finite()) {
                let joint = joint.name.clone();
                return Err(UrdfError::Friction { joint, what, found });
            }
            *kept = found;
        }
    }
    Ok(friction)
}

/// Greatest length that is accepted \[m\]; a larger one is probably in millimetres.
pub(crate) const LARGEST_LENGTH_M: f64 = 100.0;

pub(crate) fn rigid(origin: &urdf_rs::Pose, at: &str) -> Result<RigidTransform, UrdfError> {
    length(at, "origin xyz", &origin.xyz.0)?;
    finite(at, "origin rpy", &origin.rpy.0)?;
    Ok(RigidTransform {
        rotation: from_rpy(origin.rpy.0),
        translation: origin.xyz.0.into(),
    })
}

pub(crate) fn pose(origin: &urdf_rs::Pose, at: &str) -> Result<Pose, UrdfError> {
    rigid(origin, at).map(|r| Pose::from(&r))
}

pub(crate) fn finite(at: &str, what: &str, values: &[f64]) -> Result<(), UrdfError> {
    if values.iter().all(|v| v.is_finite()) {
        return Ok(());
    }
    Err(UrdfError::NotFinite {
        at: at.to_owned(),
        what: what.to_owned(),
        found: format!("{values:?}"),
    })
}

pub(crate) fn length(at: &str, what: &str, values: &[f64]) -> Result<(), UrdfError> {
    finite(at, what, values)?;
    if values.iter().all(|v| v.abs() <= LARGEST_LENGTH_M) {
        return Ok(());
    }
    Err(UrdfError::TooLong {
        at: at.to_owned(),
        what: what.to_owned(),
        found: format!("{values:?}"),
        limit_m: LARGEST_LENGTH_M,
    })
}

pub(crate) fn unit_axis(joint: &urdf_rs::Joint) -> Result<Vector3<f64>, UrdfError> {
    let axis = Vector3::from(joint.axis.xyz.0);
    let norm = axis.norm();
    if norm.is_finite() && norm > 1e-9 {
        return Ok(axis / norm);
    }
    Err(UrdfError::Axis {
        joint: joint.name.clone(),
        found: joint.axis.xyz.0,
    })
}
