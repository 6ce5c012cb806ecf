//! What a verdict rests on: the job that the motion was judged for, what was not judged, and what is assumed.

use crate::exclusions::Exclusions;
use crate::subject::Subject;
use platewash_kinematics::words::{fixed, rounded};
use platewash_kinematics::{JointVector, geometry::Shape};
use platewash_workcell::job::{Limits, Overlap, Requirements};
use platewash_workcell::plate::Plate;
use platewash_workcell::tool::Tool;
use platewash_workcell::words::{counted, printable};
use platewash_workcell::workcell::{ArmId, Exclusion, ExclusionReason, Obstacle, ObstacleShape, Workcell};
use serde::{Deserialize, Serialize};
use std::fmt;

/// Plates whose places are listed in words; the JSON has them all.
const PLACES: usize = 12;

/// Digits of a hash that are told.
const HASH_DIGITS: usize = 12;

/// What is assumed, whatever the job.
const ASSUMPTIONS: [&str; 5] = [
    "the arm is as its description says, and moves as its knots say",
    "joints and tip reach the accelerations stated; the manufacturer publishes none",
    "the collision shapes enclose the arm, the tool and the obstacles",
    "plates are rigid, flat and round, and lie where they are stated to lie",
    "the sponge is round and gives way, so that its whole face touches; how far it is compressed is not judged",
];

/// What a verdict rests on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RestsOn {
    /// Mount, tool and obstacles; its arm is the one that the motion was judged for, and the pairs that it leaves out are those that
    /// were not judged.
    pub workcell: Workcell,
    /// The plates.
    pub plates: Vec<Plate>,
    /// What the washing must keep.
    pub requirements: Requirements,
    /// What joints and tip must not exceed, beyond the limits of the arm's description.
    pub limits: Limits,
    /// Joint positions at the start and at the end \[rad\].
    pub home_rad: [JointVector; 2],
    /// Pairs that the job alone leaves out: judged, and waived where they do not keep clear.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub waived_pairs: Vec<Exclusion>,
    /// What is assumed, in words.
    pub assumptions: Vec<String>,
}

impl RestsOn {
    pub(crate) fn new(subject: &Subject<'_>, exclusions: Exclusions) -> Self {
        let job = subject.job;
        Self {
            workcell: Workcell {
                arm: ArmId::of(subject.robot),
                exclusions: exclusions.own,
                ..job.workcell.clone()
            },
            plates: job.plates.clone(),
            requirements: job.requirements,
            limits: job.limits,
            home_rad: job.home_rad,
            waived_pairs: exclusions.waived,
            assumptions: ASSUMPTIONS.map(str::to_owned).to_vec(),
        }
    }
}

impl fmt::Display for RestsOn {
    /// Some compact lines.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "\nrests on")?;
        let mut line = |name: &str, what: String| writeln!(f, "  {name:<13} {what}");
        line("arm", arm(&self.workcell))?;
        line("tool", tool(&self.workcell.tool))?;
        line("plates", plates(&self.plates))?;
        line("obstacles", obstacles(&self.workcell.obstacles))?;
        line("home", homes(&self.home_rad))?;
        line("limits", limits(&self.limits))?;
        line("requirements", requirements(&self.requirements))?;
        line("left out", left_out(&self.workcell.exclusions))?;
        if !self.waived_pairs.is_empty() {
            let pairs = self.waived_pairs.iter().map(pair).collect::<Vec<_>>();
            line("waived", format!("by the job alone: {}", pairs.join(", ")))?;
        }
        let assumed = self.assumptions.iter();
        let mut named = std::iter::once("assumed").chain(std::iter::repeat(""));
        assumed
            .zip(named.by_ref())
            .try_for_each(|(what, name)| line(name, printable(what)))
    }
}

fn arm(world: &Workcell) -> String {
    let arm = &world.arm;
    let short = |hash: &str| printable(&hash.chars().take(HASH_DIGITS).collect::<String>());
    let srdf = arm.srdf_sha256.as_deref();
    let srdf = srdf.map_or("without an SRDF".to_owned(), |hash| format!("SRDF {}", short(hash)));
    let at = world.mount.translation.vector;
    let place = if at.norm() == 0.0 {
        "on the floor at the origin".to_owned()
    } else {
        format!("at {} m", list(at.iter().copied(), 3))
    };
    format!(
        "{}, description {}, {srdf}; mounted {place}",
        printable(&arm.name),
        short(&arm.urdf_sha256)
    )
}

fn tool(tool: &Tool) -> String {
    let sponge = &tool.sponge;
    let sponge = format!(
        "sponge of radius {} and height {} mm, compressed by {} mm (assumed)",
        mm(sponge.radius_m),
        mm(sponge.height_m),
        mm(sponge.compression_m)
    );
    let bodies = tool
        .bodies
        .iter()
        .map(|body| format!("{}, {}", printable(&body.name), shape(&body.shape)));
    let mut parts: Vec<_> = bodies.collect();
    if parts.is_empty() {
        parts.push("no body".to_owned());
    }
    parts.push(sponge);
    let tip = tool.tip.translation.vector;
    parts.push(format!(
        "tip at {} mm of the flange",
        list(tip.iter().map(|v| 1e3 * v), 1)
    ));
    parts.join("; ")
}

fn shape(shape: &Shape) -> String {
    match shape {
        Shape::Box { half_m } => format!("a box of {} mm", list(half_m.iter().map(|v| 2e3 * v), 1)),
        Shape::Cylinder {
            radius_m,
            half_length_m,
        } => format!(
            "a cylinder of radius {} and length {} mm",
            mm(*radius_m),
            mm(2.0 * half_length_m)
        ),
        Shape::Sphere { radius_m } => format!("a sphere of radius {} mm", mm(*radius_m)),
        Shape::Capsule {
            radius_m,
            half_length_m,
        } => format!(
            "a capsule of radius {} and length {} mm",
            mm(*radius_m),
            mm(2.0 * (half_length_m + radius_m))
        ),
        Shape::Hull { points } => format!("the hull of {}", counted(points.len(), "point")),
    }
}

/// Sizes, and the places of the first ones.
fn plates(plates: &[Plate]) -> String {
    let size = |plate: &Plate| [plate.rim_m(), plate.thickness_m, plate.centre().z];
    let mut alike: Vec<([f64; 3], Vec<usize>)> = Vec::new();
    for (i, plate) in plates.iter().enumerate().take(PLACES) {
        match alike.iter_mut().find(|(other, _)| *other == size(plate)) {
            Some((_, those)) => those.push(i),
            None => alike.push((size(plate), vec![i])),
        }
    }
    let group = |([radius_m, thickness_m, height_m], those): ([f64; 3], Vec<usize>)| {
        let at = |i: &usize| format!("{i} at ({})", list(plates[*i].centre_xy(), 3));
        let places: Vec<_> = those.iter().map(at).collect();
        format!(
            "of radius {} mm, {} mm thick, faces {} mm over the floor: {} m",
            mm(radius_m),
            mm(thickness_m),
            mm(height_m),
            places.join(", ")
        )
    };
    let mut parts: Vec<_> = alike.into_iter().map(group).collect();
    if plates.len() > PLACES {
        parts.push(format!("and {} more", plates.len() - PLACES));
    }
    format!("{} {}", plates.len(), parts.join("; "))
}

fn obstacles(obstacles: &[Obstacle]) -> String {
    let one = |obstacle: &Obstacle| match &obstacle.shape {
        ObstacleShape::HalfSpace => format!("{}, all below 0", printable(&obstacle.name)),
        ObstacleShape::Convex(solid) => {
            let at = list(obstacle.pose.translation.vector.iter().copied(), 3);
            format!("{}, {} at ({at}) m", printable(&obstacle.name), shape(solid))
        }
    };
    match obstacles {
        [] => "none".to_owned(),
        some => some.iter().map(one).collect::<Vec<_>>().join("; "),
    }
}

fn homes([start, end]: &[JointVector; 2]) -> String {
    let degrees = |q: &JointVector| list(q.iter().map(|v| v.to_degrees()), 2);
    if start == end {
        return format!("{} ° at the start and at the end", degrees(start));
    }
    format!("{} ° at the start, {} ° at the end", degrees(start), degrees(end))
}

fn limits(limits: &Limits) -> String {
    format!(
        "joint positions and speeds of the description; joint accelerations {} rad/s² (assumed); tip {} m/s, {} m/s² (assumed)",
        list(limits.joint_acceleration_rad_s2, 3),
        number(limits.tip_speed_m_s),
        number(limits.tip_acceleration_m_s2)
    )
}

fn requirements(wanted: &Requirements) -> String {
    let overlap = match wanted.overlap {
        Overlap::Report => "overlapping plates reported",
        Overlap::Fail => "no overlapping plates",
    };
    let order = if wanted.as_listed { "as listed" } else { "in any order" };
    format!(
        "coverage {} %, clearance {} mm, tilt {} °, washing at most {} m/s and {} m/s², {overlap}, {order}",
        number(100.0 * wanted.coverage),
        mm(wanted.clearance_m),
        number(wanted.tilt_rad.to_degrees()),
        number(wanted.wash_speed_m_s),
        number(wanted.wash_acceleration_m_s2)
    )
}

/// Pairs by the reason why they are left out.
fn left_out(pairs: &[Exclusion]) -> String {
    let reasons = [
        (ExclusionReason::Srdf, "by the SRDF"),
        (ExclusionReason::Neighbours, "as neighbours"),
        (ExclusionReason::AlwaysTouching, "as always touching"),
        (ExclusionReason::CarriesTool, "as what carries the tool"),
        (ExclusionReason::NeitherMoves, "as neither moves"),
        (ExclusionReason::KeepsItsHeight, "as it keeps its height"),
    ];
    let of = |reason| {
        pairs
            .iter()
            .filter(move |e| e.reason == reason)
            .map(pair)
            .collect::<Vec<_>>()
    };
    let said = reasons.map(|(reason, words)| (of(reason), words));
    let said = said.into_iter().filter(|(pairs, _)| !pairs.is_empty());
    let said: Vec<_> = said
        .map(|(pairs, words)| format!("{words}: {}", pairs.join(", ")))
        .collect();
    if said.is_empty() {
        "no pair".to_owned()
    } else {
        said.join("; ")
    }
}

fn pair(exclusion: &Exclusion) -> String {
    let [a, b] = exclusion.pair.each_ref().map(|name| printable(name));
    format!("{a} – {b}")
}

/// A length in millimetres, as short as it is.
fn mm(length_m: f64) -> String {
    number(1e3 * length_m)
}

/// A number as people write it: up to six digits, no zeros at its end.
fn number(value: f64) -> String {
    rounded(value, 6).to_string()
}

fn list(numbers: impl IntoIterator<Item = f64>, decimals: usize) -> String {
    let each: Vec<_> = numbers.into_iter().map(|v| trimmed(&fixed(v, decimals))).collect();
    each.join(", ")
}

/// Without zeros at the end of its decimals.
fn trimmed(number: &str) -> String {
    if !number.contains('.') {
        return number.to_owned();
    }
    number.trim_end_matches('0').trim_end_matches('.').to_owned()
}
