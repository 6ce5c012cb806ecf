//! Joints that follow an axis (`mimic`), such as those of a balancing cylinder: what they carry is left out of the arm, by name.

use crate::urdf::error::UrdfError;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::fmt;
use urdf_rs::{Joint, JointType, Robot};

/// Number of links that a clause names.
const NAMED: usize = 3;

/// Link that is left out of an arm, as a joint carries it that follows an axis.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FollowerLink {
    /// Name of the link.
    pub link: String,
    /// Name of the joint that carries it, or carries what carries it.
    pub joint: String,
    /// Name of the joint that this one follows.
    pub leader: String,
}

impl FollowerLink {
    /// Clause that names the first links of a list, which nothing is judged of, and how many more there are; `None` for an empty list.
    #[must_use]
    pub fn clause(links: &[Self]) -> Option<String> {
        let named: Vec<_> = links
            .iter()
            .take(NAMED)
            .map(|left_out| format!("'{}'", left_out.link.escape_debug()))
            .collect();
        let more = match links.len().saturating_sub(NAMED) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        (!named.is_empty()).then(|| {
            format!(
                "links that are not judged, as joints carry them that follow an axis: {}{more}",
                named.join(", ")
            )
        })
    }
}

impl fmt::Display for FollowerLink {
    /// Writes the link and what moves it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [link, joint, leader] = [&self.link, &self.joint, &self.leader].map(|name| name.escape_debug());
        write!(f, "'{link}' (joint '{joint}' follows '{leader}')")
    }
}

/// Takes the joints that follow others out of a description, with all that they carry.
///
/// # Errors
/// [`UrdfError::NoLeader`] for a joint that follows none that moves, [`UrdfError::Coupled`] for one that carries an axis.
pub(crate) fn take_out(robot: &mut Robot) -> Result<Vec<FollowerLink>, UrdfError> {
    let mut links = Vec::new();
    let followers = robot.joints.iter().filter(|joint| is_follower(joint));
    let with_leader = followers.map(|joint| Ok((joint.name.clone(), leader(robot, joint)?)));
    for (name, leader) in with_leader.collect::<Result<Vec<_>, UrdfError>>()? {
        // It may have been inside another one's link.
        let Some(joint) = robot.joints.iter().find(|joint| joint.name == name) else {
            continue;
        };
        let carried = carried(robot, &joint.child.link);
        let is_inside = |joint: &Joint| carried.contains(&joint.parent.link);
        let carries = robot
            .joints
            .iter()
            .find(|other| is_inside(other) && other.joint_type != JointType::Fixed && !is_follower(other));
        if let Some(axis) = carries {
            return Err(UrdfError::Coupled {
                joint: name,
                follows: leader,
                carries: axis.name.clone(),
            });
        }
        let inside = robot.links.iter().filter(|link| carried.contains(&link.name));
        links.extend(inside.map(|link| FollowerLink {
            link: link.name.clone(),
            joint: name.clone(),
            leader: leader.clone(),
        }));
        robot.links.retain(|link| !carried.contains(&link.name));
        robot
            .joints
            .retain(|other| other.name != name && !carried.contains(&other.parent.link));
    }
    Ok(links)
}

fn is_follower(joint: &Joint) -> bool {
    joint.mimic.is_some() && joint.joint_type != JointType::Fixed
}

/// Returns the name of the joint that a follower follows in the end: one that moves, and follows none.
fn leader(robot: &Robot, follower: &Joint) -> Result<String, UrdfError> {
    let mut joint = follower;
    for _ in 0..robot.joints.len() {
        let Some(mimic) = &joint.mimic else {
            return Ok(joint.name.clone());
        };
        let leads = |other: &&Joint| other.name == mimic.joint && other.joint_type != JointType::Fixed;
        match robot.joints.iter().find(leads) {
            Some(leader) => joint = leader,
            None => break,
        }
    }
    Err(UrdfError::NoLeader {
        joint: follower.name.clone(),
        follows: joint
            .mimic
            .as_ref()
            .map(|mimic| mimic.joint.clone())
            .unwrap_or_default(),
    })
}

/// Returns the names of a link and of all links that it carries.
fn carried(robot: &Robot, link: &str) -> BTreeSet<String> {
    let mut all = BTreeSet::from([link.to_owned()]);
    loop {
        let above = |joint: &&Joint| all.contains(&joint.parent.link) && !all.contains(&joint.child.link);
        match robot.joints.iter().find(above) {
            Some(joint) => all.insert(joint.child.link.clone()),
            None => return all,
        };
    }
}
