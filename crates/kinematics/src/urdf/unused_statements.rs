//! All elements and attributes of a description, one after the other: rates that `urdf-rs` reads of some versions only, what is not used, and
//! what is not complete.
//!
//! What cannot matter is listed in `docs/urdf.md`. Everything else that is not used is an [`UnusedStatement`]. `urdf-rs` gets a text without
//! either, in which incomplete elements are left out or completed, so that they do not stop it: see `gaps`.

use crate::urdf::edits::Edits;
use crate::urdf::error::UrdfError;
use crate::urdf::gaps::{self, Gap};
use crate::urdf::line::line_at;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;

/// Element, attribute or text of a description that is not used, or an element that is not complete.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct UnusedStatement {
    /// Place: the joint or link by name and the elements in it, such as `joint 'elbow', limit`; empty for a child of `<robot>`.
    pub place: String,
    /// The statement: `jerk="5"`, `<stiffness>` or `<inertial> without mass`.
    pub statement: String,
    /// Line, counted from 1.
    pub line: usize,
}

impl fmt::Display for UnusedStatement {
    /// Writes place, statement and line.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { place, statement, line } = self;
        let separator = if place.is_empty() { "" } else { ": " };
        write!(f, "{place}{separator}{statement} (line {line})")
    }
}

/// Limits of a joint's rates that a description states, in any version.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Rates {
    /// Lesser of acceleration and deceleration \[rad/s²\].
    pub acceleration: Option<f64>,
    /// Jerk \[rad/s³\].
    pub jerk: Option<f64>,
}

/// The statements of a description.
#[derive(Debug, Default)]
pub(crate) struct Statements {
    /// Limits of rates, by joint.
    pub rates: BTreeMap<String, Rates>,
    /// Statements that are not used, in the order of the file.
    pub unused: Vec<UnusedStatement>,
    /// The text with what is used alone, complete, on the same lines.
    pub used_text: String,
}

/// Elements that are used, by their path below `<robot>`, with the attributes that are used. Those of a collision shape are those of a visual.
const USED: [(&str, &[&str]); 27] = [
    ("", &["name", "version"]),
    ("link", &["name"]),
    ("link/inertial", &[]),
    ("link/inertial/origin", &["xyz", "rpy"]),
    ("link/inertial/mass", &["value"]),
    ("link/inertial/inertia", &["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]),
    ("link/visual", &[]),
    ("link/visual/origin", &["xyz", "rpy"]),
    ("link/visual/geometry", &[]),
    ("link/visual/geometry/box", &["size"]),
    ("link/visual/geometry/cylinder", &["radius", "length"]),
    ("link/visual/geometry/capsule", &["radius", "length"]),
    ("link/visual/geometry/sphere", &["radius"]),
    ("link/visual/geometry/mesh", &["filename", "scale"]),
    ("joint", &["name", "type"]),
    ("joint/origin", &["xyz", "rpy"]),
    ("joint/parent", &["link"]),
    ("joint/child", &["link"]),
    ("joint/axis", &["xyz"]),
    (
        LIMIT,
        &["lower", "upper", "effort", "velocity", "acceleration", "deceleration"],
    ),
    ("joint/dynamics", &["damping", "friction"]),
    ("joint/mimic", &["joint", "multiplier", "offset"]),
    ("joint/safety_controller", &["soft_lower_limit", "soft_upper_limit"]),
    // Looks.
    ("link/visual/material", &["name"]),
    ("link/visual/material/color", &["rgba"]),
    ("material", &["name"]),
    ("material/color", &["rgba"]),
];

const LIMIT: &str = "joint/limit";

/// Version from which on `urdf-rs` refuses shapes without a size.
const SIZED: (u32, u32) = (1, 1);

const COLLISION_GEOMETRY: &str = "link/collision/geometry";

/// Elements, with all in them, and attributes that cannot matter: names of shapes, textures, where an encoder finds its zero, gains
/// of a safety controller, the words of
/// simulators about looks and sensors, and motors behind joints. `docs/urdf.md` gives the reasons.
const CANNOT_MATTER: [&str; 12] = [
    "link/visual/name",
    "link/collision/name",
    "link/collision/material",
    "link/visual/material/texture",
    "material/texture",
    "joint/calibration",
    "joint/safety_controller/k_position",
    "joint/safety_controller/k_velocity",
    "sensor",
    "gazebo",
    "mujoco",
    "transmission",
];

/// Element for drivers of joints. It cannot matter, but for the limits that it may state of their commands.
const DRIVERS: &str = "ros2_control";

/// Elements of a fixed joint that are never used.
const OF_MOVING_JOINTS: [&str; 6] = ["axis", "limit", "dynamics", "safety_controller", "calibration", "mimic"];

/// Returns all statements of a text that is known to be well-formed.
///
/// # Errors
/// [`UrdfError::Rate`] for an acceleration, deceleration or jerk that is no number, or below 0, [`UrdfError::Syntax`] for a collision shape
/// that is not complete.
pub(crate) fn read(text: &str) -> Result<Statements, UrdfError> {
    let mut walk = Walk {
        text,
        open: Vec::new(),
        skipped: 0,
        version: (1, 0),
        found: Statements::default(),
        edits: Edits::default(),
    };
    let mut reader = Reader::from_str(text);
    loop {
        let start = offset(reader.buffer_position());
        let event = reader.read_event();
        let end = offset(reader.buffer_position());
        match event {
            Ok(Event::Start(tag)) => walk.enter(&tag, start..end)?,
            Ok(Event::Empty(tag)) => {
                walk.enter(&tag, start..end)?;
                walk.leave(end)?;
            }
            Ok(Event::End(_)) => walk.leave(end)?,
            Ok(Event::Text(text)) => walk.text(&String::from_utf8_lossy(&text), start..end),
            Ok(Event::CData(text)) => walk.text(&String::from_utf8_lossy(&text), start..end),
            Ok(Event::GeneralRef(name)) => walk.name_text(&format!("&{};", String::from_utf8_lossy(&name)), end),
            Ok(Event::Eof) | Err(_) => break,
            Ok(_) => {}
        }
    }
    walk.found.unused.sort_by_key(|unused| unused.line);
    walk.found.used_text = walk.edits.applied_to(text);
    Ok(walk.found)
}

fn offset(position: u64) -> usize {
    usize::try_from(position).unwrap_or(usize::MAX)
}

/// An element that is not closed yet.
struct Element {
    tag: String,
    /// The attribute `name`.
    name: String,
    /// The attribute `type`.
    kind: String,
    /// Offsets of its start and of what it holds.
    start: usize,
    contents: usize,
    /// True if it is left out of the text that is used.
    is_left_out: bool,
    /// Elements in it that are used, and those that are not.
    used: Vec<String>,
    left_out: Vec<String>,
}

struct Walk<'a> {
    text: &'a str,
    open: Vec<Element>,
    /// Number of open elements whose statements need no look: of one that is named as a whole, or that cannot matter.
    skipped: usize,
    /// Major and minor number of the format, 1.0 where none is stated.
    version: (u32, u32),
    found: Statements,
    edits: Edits,
}

impl Walk<'_> {
    fn enter(&mut self, tag: &BytesStart<'_>, span: Range<usize>) -> Result<(), UrdfError> {
        let attributes: Vec<_> = tag
            .attributes()
            .flatten()
            .map(|a| {
                let value = a
                    .unescape_value()
                    .map_or_else(|_| String::from_utf8_lossy(&a.value).into_owned(), Into::into);
                (String::from_utf8_lossy(a.key.as_ref()).into_owned(), value)
            })
            .collect();
        let get = |key: &str| {
            attributes
                .iter()
                .find(|(name, _)| name == key)
                .map(|(_, value)| value.clone())
        };
        let position = span.end;
        let tag_name = String::from_utf8_lossy(tag.name().as_ref()).into_owned();
        self.open.push(Element {
            name: get("name").unwrap_or_default(),
            kind: get("type").unwrap_or_default(),
            tag: tag_name,
            start: span.start,
            contents: span.end,
            is_left_out: false,
            used: Vec::new(),
            left_out: Vec::new(),
        });
        if self.skipped > 0 {
            self.skipped += 1;
            return Ok(());
        }
        if self.open.get(1).is_some_and(|element| element.tag == DRIVERS) {
            let limit = self
                .open
                .last()
                .filter(|element| element.tag == "param" && ["min", "max"].contains(&element.name.as_str()));
            if let Some(param) = limit {
                let statement = format!("<param name=\"{}\">", param.name);
                self.note(self.open.len() - 1, statement, position);
            }
            self.leave_out();
            return Ok(());
        }
        let path = self.path();
        if let Some((major, minor)) = get("version").as_deref().and_then(|text| text.trim().split_once('.'))
            && path.is_empty()
            && let (Ok(major), Ok(minor)) = (major.parse(), minor.parse())
        {
            self.version = (major, minor);
        }
        let alike = path.replacen("link/collision", "link/visual", 1);
        let used = USED.iter().find(|(known, _)| *known == alike).map(|(_, used)| used);
        let can_matter = !self.cannot_matter(&path);
        let Some(used) = used.filter(|_| can_matter) else {
            self.skipped = 1;
            self.leave_out();
            if can_matter {
                let element = self.open.last().map(|element| format!("<{}>", element.tag));
                self.note(self.open.len() - 1, element.unwrap_or_default(), position);
            }
            return Ok(());
        };
        for (key, value) in &attributes {
            let is_used = match (path.as_str(), key.as_str()) {
                (_, "xmlns") => true,
                (_, key) if key.starts_with("xmlns:") => true,
                // A continuous joint has no end.
                (LIMIT, "lower" | "upper") if self.joint_kind() == "continuous" => number(value) == Some(0.0),
                (LIMIT, "acceleration" | "deceleration" | "jerk") => self.rate(key, value, position)?,
                (_, "quat_xyzw") if path.ends_with("/origin") => self.version >= (1, 1),
                (_, key) => used.contains(&key) || CANNOT_MATTER.contains(&format!("{path}/{key}").as_str()),
            };
            if !is_used {
                self.note(self.open.len(), format!("{key}=\"{value}\""), position);
            }
        }
        if path == "joint/safety_controller" {
            let gains = tag.attributes().flatten().filter(|a| a.key.as_ref().starts_with(b"k_"));
            gains.for_each(|gain| self.edits.blank_attribute(self.text, &gain));
        }
        match gaps::in_attributes(&path, &attributes, self.version >= SIZED) {
            Some(Gap::Completed(with, statement)) => {
                // Behind the opening bracket and the name.
                self.edits.insert(span.start + 1 + tag.name().as_ref().len(), with);
                if let Some(statement) = statement {
                    self.note(self.open.len() - 1, statement, position);
                }
            }
            Some(Gap::LeftOut(statement)) => {
                self.leave_out();
                self.note(self.open.len() - 1, statement, position);
            }
            None => {}
        }
        Ok(())
    }

    /// Marks the innermost element as one that is left out of the text that is used.
    fn leave_out(&mut self) {
        if let Some(element) = self.open.last_mut() {
            element.is_left_out = true;
        }
    }

    fn leave(&mut self, end: usize) -> Result<(), UrdfError> {
        if self.skipped == 0 {
            self.check_parts()?;
        }
        self.skipped = self.skipped.saturating_sub(1);
        let Some(element) = self.open.pop() else { return Ok(()) };
        if element.is_left_out {
            self.edits.blank(element.start..end);
        }
        if let Some(parent) = self.open.last_mut() {
            if element.tag == "inertial" && parent.used.iter().any(|tag| tag == "visual") && !element.is_left_out {
                // `urdf-rs` takes no other element between two visuals.
                self.edits.insert(parent.contents, &self.text[element.start..end]);
                self.edits.blank(element.start..end);
            }
            match element.is_left_out {
                true => parent.left_out.push(element.tag),
                false => parent.used.push(element.tag),
            }
        }
        Ok(())
    }

    /// Leaves out the innermost element, which ends here, if it lacks a part that it needs.
    ///
    /// # Errors
    /// [`UrdfError::Syntax`] for a collision shape that is not used: what it is meant to enclose would count as free space.
    fn check_parts(&mut self) -> Result<(), UrdfError> {
        let path = self.path();
        let Some(element) = self.open.last_mut().filter(|element| !element.is_left_out) else {
            return Ok(());
        };
        let Some(lacks) = gaps::in_parts(&path, &element.used, &element.left_out) else {
            return Ok(());
        };
        element.is_left_out = true;
        let (start, statement) = (element.start, format!("<{}> without {lacks}", element.tag));
        match element.left_out.first() {
            Some(shape) if path == COLLISION_GEOMETRY => Err(UrdfError::Syntax {
                detail: format!(
                    "collision shape <{shape}> is unknown or not complete; expected box (size), cylinder (radius, length), capsule (radius, \
                     length), sphere (radius) or mesh (filename)"
                ),
                at: format!("{} (line {})", self.place(2), line_at(self.text, start)),
            }),
            // That part is named.
            Some(_) => Ok(()),
            None => {
                self.note(self.open.len() - 1, statement, start);
                Ok(())
            }
        }
    }

    fn text(&mut self, text: &str, span: Range<usize>) {
        let text = text.trim_matches(['\u{feff}', ' ', '\t', '\r', '\n']);
        if self.open.is_empty() || text.is_empty() {
            return;
        }
        self.name_text(text, span.end);
        self.edits.blank(span);
    }

    fn name_text(&mut self, text: &str, offset: usize) {
        let is_looked_at = self.skipped == 0 && self.open.get(1).is_none_or(|element| element.tag != DRIVERS);
        if is_looked_at && !self.open.is_empty() {
            self.note(self.open.len(), format!("the text \"{text}\""), offset);
        }
    }

    /// Path of the innermost element below `<robot>`.
    fn path(&self) -> String {
        let below = self.open.iter().skip(1).map(|element| element.tag.as_str());
        below.collect::<Vec<_>>().join("/")
    }

    /// Kind of the open joint.
    fn joint_kind(&self) -> &str {
        self.open.get(1).map_or("", |element| &element.kind)
    }

    fn cannot_matter(&self, path: &str) -> bool {
        let of_joint = path.strip_prefix("joint/").filter(|_| self.joint_kind() == "fixed");
        CANNOT_MATTER.contains(&path) || of_joint.is_some_and(|element| OF_MOVING_JOINTS.contains(&element))
    }

    /// Takes the limit of a rate of a joint. Returns false for one that is not kept: a jerk, and 0.
    fn rate(&mut self, key: &str, value: &str, position: usize) -> Result<bool, UrdfError> {
        let joint = self.open.get(1).map(|element| element.name.clone()).unwrap_or_default();
        let Some(limit) = number(value).filter(|limit| *limit >= 0.0) else {
            return Err(UrdfError::Rate {
                joint,
                rate: key.to_owned(),
                found: value.to_owned(),
                line: line_at(self.text, position),
            });
        };
        if limit == 0.0 || limit.is_infinite() {
            return Ok(limit > 0.0);
        }
        let rates = self.found.rates.entry(joint).or_default();
        let is_jerk = key == "jerk";
        let kept = if is_jerk {
            &mut rates.jerk
        } else {
            &mut rates.acceleration
        };
        *kept = Some(kept.map_or(limit, |other| other.min(limit)));
        Ok(!is_jerk)
    }

    /// Names a statement in the outermost elements, as many as stated.
    fn note(&mut self, depth: usize, statement: String, offset: usize) {
        self.found.unused.push(UnusedStatement {
            place: self.place(depth),
            statement: statement.escape_debug().to_string().replace("\\\"", "\""),
            line: line_at(self.text, offset),
        });
    }

    /// The outermost elements below `<robot>` in words, as many as stated with it.
    fn place(&self, depth: usize) -> String {
        let words = |(k, element): (usize, &Element)| match (k, element.name.as_str()) {
            (0, name) if !name.is_empty() => format!("{} '{}'", element.tag, name.escape_debug()),
            _ => element.tag.clone(),
        };
        let place = self.open[..depth].iter().skip(1).enumerate().map(words);
        place.collect::<Vec<_>>().join(", ")
    }
}

/// Number of an attribute, infinity included.
fn number(text: &str) -> Option<f64> {
    text.trim().parse().ok().filter(|number: &f64| !number.is_nan())
}
