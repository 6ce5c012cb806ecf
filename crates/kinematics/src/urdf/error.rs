//! Errors of reading a URDF.
//!
//! `urdf-rs` reports the error but not its position: this file finds the element.

use crate::joints::AXES;
use crate::urdf::line::line_at;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

/// Reason that a URDF was refused. Every variant states the element at fault.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // the fields are named after what the message prints
pub enum UrdfError {
    /// The text is larger than any sensible description.
    #[error("URDF is {bytes} bytes long; at most {limit} are read")]
    TooLarge { bytes: usize, limit: usize },
    /// There are more links or collision elements than in any sensible description.
    #[error("URDF has {found} <{kind}> elements; at most {limit} are read: leave out what does not belong to the arm")]
    TooMany {
        kind: &'static str,
        found: usize,
        limit: usize,
    },
    /// The elements are nested deeper than in any sensible description.
    #[error("URDF nests elements {depth} deep at line {line}; at most {limit} are read")]
    TooDeep { depth: usize, limit: usize, line: usize },
    /// The text is not well-formed XML.
    #[error("URDF is not well-formed XML at line {line}: {detail}")]
    Xml { line: usize, detail: String },
    /// The file ends in the middle.
    #[error("URDF ends inside <{element}> (line {line}): the file is cut off, or a quotation mark is missing")]
    Truncated { element: String, line: usize },
    /// The root element is not `<robot>`.
    #[error("URDF must have a <robot> root element; found {found}")]
    NotARobot { found: String },
    /// The file is an unexpanded xacro file.
    #[error("line {line} has the xacro tag <{tag}>: expand the file first with `xacro FILE.xacro > FILE.urdf`")]
    Xacro { tag: String, line: usize },
    /// An element cannot be read (a bad number, a missing attribute, an unknown joint type).
    #[error("URDF cannot be read at {at}: {detail}")]
    Syntax { at: String, detail: String },
    /// A name has hidden characters.
    #[error("the {kind} named '{name}' (escaped) has a control or direction character in its name: rename it")]
    HiddenCharacter { kind: &'static str, name: String },
    /// Two links or two joints share a name.
    #[error("URDF has two {kind}s named '{name}'")]
    Duplicate { kind: &'static str, name: String },
    /// A joint refers to a link that does not exist.
    #[error("joint '{joint}': its {role} link '{link}' does not exist")]
    UnknownLink {
        joint: String,
        role: &'static str,
        link: String,
    },
    /// A link is the child of two joints.
    #[error("link '{link}' is the child of both joint '{first}' and joint '{second}'")]
    TwoParents {
        link: String,
        first: String,
        second: String,
    },
    /// Links form a ring.
    #[error("link '{link}' is part of a cycle of joints")]
    Cycle { link: String },
    /// There is no link without a parent, or there are several.
    #[error("URDF must have exactly one root link; found {}", list(.found))]
    Roots { found: Vec<String> },
    /// The number of axes is not six.
    #[error(
        "six revolute or continuous joints are needed; found {}: {}{}", .found.len(), list(.found),
        if .found.len() > AXES { "; hold those still that are not of the arm (--fix JOINT=VALUE, robot.fixed)" } else { "" }
    )]
    AxisCount { found: Vec<String> },
    /// The moving joints are not in series.
    #[error(
        "the six axes must be in series; joint '{joint}' does not move what joint '{previous}' moves: hold those still that are not of the arm \
         (--fix JOINT=VALUE, robot.fixed)"
    )]
    Branch { joint: String, previous: String },
    /// A joint has a type that this project does not handle.
    #[error(
        "joint '{joint}' is {kind}; axes must be revolute or continuous{}",
        if .kind == "prismatic" { format!(": hold it still where it is not of the arm (--fix {joint}=VALUE, robot.fixed)") } else { String::new() }
    )]
    JointKind { joint: String, kind: String },
    /// A joint mimics another one that does not move, or itself.
    #[error("joint '{joint}' mimics joint '{follows}', which is not a joint that moves by itself")]
    NoLeader { joint: String, follows: String },
    /// A joint that mimics an axis carries another axis.
    #[error(
        "joint '{joint}' mimics joint '{follows}' and carries joint '{carries}': arms whose axes move each other are not handled"
    )]
    Coupled {
        joint: String,
        follows: String,
        carries: String,
    },
    /// A joint is fixed where it cannot be.
    #[error("joint '{joint}' is fixed at {position}, beyond its limits {lower} … {upper}")]
    FixedBeyond {
        joint: String,
        position: f64,
        lower: f64,
        upper: f64,
    },
    /// A joint is fixed that follows another one.
    #[error("joint '{joint}' is fixed, and mimics joint '{follows}'; fix that one, or none where that one is an axis")]
    FixedFollower { joint: String, follows: String },
    /// A joint that is to be held still is not held.
    #[error("joint '{}' cannot be held still (--fix, robot.fixed): {reason}; leave it out", .joint.escape_debug())]
    NotHeld { joint: String, reason: String },
    /// A joint is fixed elsewhere than where the one that it follows brings it.
    #[error(
        "joint '{joint}' is fixed elsewhere than at {found}, where the joint that it mimics brings it; leave it out"
    )]
    FixedFollowerElsewhere { joint: String, found: f64 },
    /// An axis is zero or not finite.
    #[error("joint '{joint}': axis must be a finite vector other than zero; found {found:?}")]
    Axis { joint: String, found: [f64; 3] },
    /// A joint has no `<limit>` element (or all zeros, which reads the same).
    #[error("joint '{joint}' has no <limit> element (or one of zeros only): give lower, upper and velocity")]
    MissingLimit { joint: String },
    /// A continuous joint has no `<limit>` element (or all zeros, which reads the same).
    #[error(
        "continuous joint '{joint}' has no <limit> element (or one of zeros only): give velocity, as motions are checked \
         against every joint's speed limit; its position needs none"
    )]
    MissingVelocity { joint: String },
    /// Limits are reversed or empty.
    #[error("joint '{joint}': lower limit {lower} rad must be below upper limit {upper} rad")]
    LimitOrder { joint: String, lower: f64, upper: f64 },
    /// Limits are too large to be radians.
    #[error("joint '{joint}': limits {lower} … {upper} exceed ±{limit_rad} rad; URDF states radians, not degrees")]
    LimitSize {
        joint: String,
        lower: f64,
        upper: f64,
        limit_rad: f64,
    },
    /// A speed limit is not positive and finite.
    #[error("joint '{joint}': speed limit must be positive and finite [rad/s]; found {}", if *.found == 0.0 { "none, or 0".to_owned() } else { .found.to_string() })]
    Velocity { joint: String, found: f64 },
    /// A torque limit is negative.
    #[error("joint '{joint}': effort must not be negative [N·m]; found {found} (0 means unknown)")]
    Effort { joint: String, found: f64 },
    /// A limit of a joint's acceleration, deceleration or jerk is no number, or negative.
    #[error("joint '{joint}' (line {line}): {rate} must be a number from 0 on; found '{}' (0 means unknown)", .found.escape_debug())]
    Rate {
        joint: String,
        rate: String,
        found: String,
        line: usize,
    },
    /// Damping or friction of a joint is negative or not finite.
    #[error("joint '{joint}': {what} must be finite and not negative; found {found}")]
    Friction {
        joint: String,
        what: &'static str,
        found: f64,
    },
    /// A number is NaN or infinite.
    #[error("{at}: {what} must be finite; found {found}")]
    NotFinite { at: String, what: String, found: String },
    /// A length is too large to be in metres.
    #[error("{at}: {what} {found} exceeds {limit_m} m; URDF states metres")]
    TooLong {
        at: String,
        what: String,
        found: String,
        limit_m: f64,
    },
    /// A mass is negative.
    #[error("link '{link}': mass must not be negative [kg]; found {found}")]
    Mass { link: String, found: f64 },
    /// A collision shape has a size that is not positive.
    #[error("link '{link}': {shape} needs positive sizes; found {found}")]
    ShapeSize {
        link: String,
        shape: &'static str,
        found: String,
    },
    /// A mesh cannot be found.
    #[error(
        "link '{link}': mesh '{file}' not found; looked for {}; give the folder that holds its package as package path \
         (--package-path, robot.package_path)",
        list(.searched)
    )]
    MeshNotFound {
        link: String,
        file: String,
        searched: Vec<String>,
    },
    /// A mesh cannot be read.
    #[error("link '{link}': mesh '{file}' cannot be read: {detail}")]
    Mesh { link: String, file: String, detail: String },
    /// A link cannot be split into parts.
    #[error("link '{link}' cannot be split: {why}; leave it out of the links to split (robot.split_links)")]
    Split { link: String, why: String },
}

/// Greatest number of names that a message lists.
const LISTED: usize = 20;

fn list(names: &[String]) -> String {
    match names.len() {
        0 => "none".to_owned(),
        1..=LISTED => names.join(", "),
        many => format!("{} and {} more", names[..LISTED].join(", "), many - LISTED),
    }
}

/// Returns the first child of `<robot>` that `urdf-rs` cannot read on its own, as "joint 'NAME' (line N)".
pub(crate) fn find(text: &str) -> Option<String> {
    let mut reader = Reader::from_str(text);
    let (mut root, mut child) = ("", None);
    let mut depth = 0_usize;
    loop {
        let start = usize::try_from(reader.buffer_position()).ok()?;
        let event = reader.read_event().ok()?;
        let end = usize::try_from(reader.buffer_position()).ok()?;
        match &event {
            Event::Start(_) if depth == 0 => root = text.get(start..end)?,
            Event::Start(tag) | Event::Empty(tag) if depth == 1 => child = Some((start, name(tag))),
            Event::Eof => return None,
            _ => {}
        }
        depth = match event {
            Event::Start(_) => depth + 1,
            Event::End(_) => depth.saturating_sub(1),
            _ => depth,
        };
        if depth != 1 {
            continue;
        }
        if let Some((start, name)) = child.take() {
            let alone = format!("{root}{}</robot>", text.get(start..end)?);
            if urdf_rs::read_from_string(&alone).is_err() {
                let line = line_at(text, start);
                return Some(format!("{name} (line {line})"));
            }
        }
    }
}

fn name(tag: &BytesStart<'_>) -> String {
    let element = String::from_utf8_lossy(tag.name().into_inner()).into_owned();
    match tag.try_get_attribute("name") {
        Ok(Some(name)) => format!("{element} '{}'", String::from_utf8_lossy(&name.value)),
        _ => format!("a <{element}> without a name"),
    }
}
