//! Link pairs that need no collision check, read from an SRDF file as MoveIt reads it: `disable_collisions` takes out a pair,
//! `disable_default_collisions` every pair of a link but those of `enable_collisions`. A pair that is disabled itself stays so.
//!
//! The other elements of an SRDF name groups, states, joints and grippers for planners, and change no pair. An unknown element whose name
//! begins as those above do is refused, and so is one of xacro, whose file is yet to be processed.

use crate::fingerprint::sha256_hex;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;
use std::collections::{BTreeMap, BTreeSet};

/// Beginnings of the names of elements that may be about pairs. MoveIt reads those that are known, directly below the root.
const ABOUT_PAIRS: [&str; 2] = ["disable", "enable"];

/// Beginning of the names of elements of a file that is yet to be processed.
const XACRO: &str = "xacro:";

/// Unordered pairs of link names that need no collision check.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct DisabledPairs {
    /// Pairs that are disabled themselves, the links of each in alphabetical order, with the reason that the file states.
    pairs: BTreeMap<[String; 2], String>,
    /// Links that need no check by default.
    by_default: BTreeSet<String>,
    /// Pairs of these that are checked all the same.
    enabled: BTreeSet<[String; 2]>,
    /// SHA-256 of the text, lower-case hexadecimal.
    sha256: String,
}

/// Reason that an SRDF file was refused.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SrdfError {
    /// The text is not well-formed XML.
    #[error("SRDF is not well-formed XML at byte {position}: {detail}")]
    Xml {
        /// Byte offset.
        position: u64,
        /// Message of the parser.
        detail: String,
    },
    /// The root element is not `<robot>`.
    #[error("SRDF must have a <robot> root element; found {found}")]
    NotARobot {
        /// Root element found.
        found: String,
    },
    /// An element about collisions lacks one of its links.
    #[error("SRDF: a <{element}> element at byte {position} has no attribute '{attribute}'")]
    MissingAttribute {
        /// Byte offset.
        position: u64,
        /// Name of the element.
        element: String,
        /// `link1`, `link2` or `link`.
        attribute: &'static str,
    },
    /// An element that may be about pairs is unknown, or stands where MoveIt does not read it.
    #[error(
        "SRDF: unexpected element <{element}> at byte {position}; expected disable_collisions, enable_collisions and \
         disable_default_collisions directly in <robot>, and nothing of xacro, which must be processed before"
    )]
    UnknownElement {
        /// Byte offset.
        position: u64,
        /// Name of the element.
        element: String,
    },
    /// A link is named that the arm does not have.
    #[error("SRDF names link '{link}', which the URDF does not have")]
    UnknownLink {
        /// Name of the link.
        link: String,
    },
}

impl DisabledPairs {
    /// Reads an SRDF text.
    ///
    /// # Errors
    /// [`SrdfError`] for broken XML, another root element, an unknown element, or one without its links.
    pub fn parse(text: &str) -> Result<Self, SrdfError> {
        let mut reader = Reader::from_str(text);
        let mut found = Self {
            sha256: sha256_hex(text.as_bytes()),
            ..Self::default()
        };
        let mut root_seen = false;
        let mut depth = 0_usize;
        loop {
            let position = reader.buffer_position();
            let event = reader.read_event().map_err(|e| xml(position, &e))?;
            match &event {
                Event::Start(tag) | Event::Empty(tag) => {
                    if !root_seen && tag.name().as_ref() != b"robot" {
                        return Err(not_a_robot(tag));
                    }
                    root_seen = true;
                    if depth > 0 {
                        found.add(tag, depth, position)?;
                    }
                    depth += usize::from(matches!(event, Event::Start(_)));
                }
                Event::End(_) => depth = depth.saturating_sub(1),
                Event::Eof if depth > 0 => return Err(xml(position, &"the file ends inside an element")),
                Event::Eof if !root_seen => {
                    let found = "no element at all".to_owned();
                    return Err(SrdfError::NotARobot { found });
                }
                Event::Eof => return Ok(found),
                _ => {}
            }
        }
    }

    /// Takes in an element at some depth below the root.
    fn add(&mut self, tag: &BytesStart<'_>, depth: usize, position: u64) -> Result<(), SrdfError> {
        let element = String::from_utf8_lossy(tag.name().as_ref()).into_owned();
        let links = || -> Result<[String; 2], SrdfError> {
            let mut links = [attribute(tag, "link1", position)?, attribute(tag, "link2", position)?];
            links.sort();
            Ok(links)
        };
        match (depth, &*element) {
            (1, "disable_collisions") => {
                let reason = tag.try_get_attribute("reason").map_err(|e| xml(position, &e))?;
                let reason = reason.map(|reason| reason.unescape_value().map_err(|e| xml(position, &e)));
                self.pairs
                    .insert(links()?, reason.transpose()?.unwrap_or_default().into_owned());
            }
            (1, "enable_collisions") => {
                self.enabled.insert(links()?);
            }
            (1, "disable_default_collisions") => {
                self.by_default.insert(attribute(tag, "link", position)?);
            }
            (_, other) if ABOUT_PAIRS.iter().any(|begins| other.starts_with(begins)) || other.starts_with(XACRO) => {
                return Err(SrdfError::UnknownElement { position, element });
            }
            _ => {}
        }
        Ok(())
    }

    /// SHA-256 of the text that the list was read from, in lower-case hexadecimal.
    #[must_use]
    pub fn sha256(&self) -> &str {
        &self.sha256
    }

    /// True if the pair needs no collision check, in either order.
    #[must_use]
    pub fn contains(&self, a: &str, b: &str) -> bool {
        self.reason(a, b).is_some()
    }

    /// Reason that a pair needs no check, in either order, as the file states it: empty where it states none. `None` for a pair that does.
    #[must_use]
    pub fn reason(&self, a: &str, b: &str) -> Option<&str> {
        let mut pair = [a.to_owned(), b.to_owned()];
        pair.sort();
        if let Some(reason) = self.pairs.get(&pair) {
            return Some(reason);
        }
        let is_by_default = pair.iter().any(|link| self.by_default.contains(link));
        (is_by_default && !self.enabled.contains(&pair)).then_some("disabled by default")
    }

    pub(crate) fn check_links<'a>(&self, known: impl Iterator<Item = &'a str>) -> Result<(), SrdfError> {
        let known: BTreeSet<_> = known.collect();
        let pairs = self.pairs.keys().chain(&self.enabled).flatten();
        let mut named = pairs.chain(&self.by_default);
        match named.find(|name| !known.contains(name.as_str())) {
            Some(link) => Err(SrdfError::UnknownLink { link: link.clone() }),
            None => Ok(()),
        }
    }
}

fn xml(position: u64, detail: &dyn std::fmt::Display) -> SrdfError {
    let detail = detail.to_string();
    SrdfError::Xml { position, detail }
}

fn not_a_robot(tag: &BytesStart<'_>) -> SrdfError {
    let found = format!("<{}>", String::from_utf8_lossy(tag.name().as_ref()));
    SrdfError::NotARobot { found }
}

fn attribute(tag: &BytesStart<'_>, name: &'static str, position: u64) -> Result<String, SrdfError> {
    let missing = SrdfError::MissingAttribute {
        position,
        element: String::from_utf8_lossy(tag.name().as_ref()).into_owned(),
        attribute: name,
    };
    let found = tag.try_get_attribute(name).map_err(|e| xml(position, &e))?;
    let value = found.ok_or(missing)?.unescape_value();
    Ok(value.map_err(|e| xml(position, &e))?.into_owned())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn reads_pairs_in_either_order() {
        let text = r#"<?xml version="1.0"?><robot name="x"><group name="g"><chain base_link="a" tip_link="b"/></group>
            <disable_collisions link1="a" link2="b" reason="Adjacent"/></robot>"#;
        let pairs = DisabledPairs::parse(text).unwrap();
        assert!(pairs.contains("a", "b") && pairs.contains("b", "a") && !pairs.contains("a", "c"));
        assert_eq!(
            pairs.check_links(["a", "c"].into_iter()),
            Err(SrdfError::UnknownLink { link: "b".into() })
        );
    }

    fn parsed(inside: &str) -> Result<DisabledPairs, SrdfError> {
        DisabledPairs::parse(&format!("<robot name=\"x\">{inside}</robot>"))
    }

    /// As MoveIt fills its matrix: defaults of links, then enabled pairs, then disabled ones.
    #[test]
    fn a_link_may_be_disabled_by_default() {
        let pairs = parsed(
            r#"<disable_default_collisions link="c"/><enable_collisions link1="d" link2="c"/><enable_collisions link1="c" link2="e"/>
               <disable_collisions link1="e" link2="c" reason="User"/><enable_collisions link1="a" link2="b"/>"#,
        )
        .unwrap();
        assert_eq!(pairs.reason("a", "c"), Some("disabled by default"));
        assert_eq!(pairs.reason("c", "e"), Some("User"));
        assert!(!pairs.contains("c", "d") && !pairs.contains("a", "b") && pairs.contains("b", "c"));
        let unknown = |links: &[&'static str]| pairs.check_links(links.iter().copied()).unwrap_err();
        assert_eq!(
            unknown(&["a", "b", "c", "e"]),
            SrdfError::UnknownLink { link: "d".into() }
        );
        assert_eq!(
            unknown(&["a", "b", "d", "e"]),
            SrdfError::UnknownLink { link: "c".into() }
        );
    }

    #[test]
    fn unknown_elements_about_pairs_are_refused() {
        for known in [
            "<gripper name=\"g\"/><rotor_params/>",
            "<group name=\"g\"><joint name=\"j\"/><link name=\"l\"/></group>",
            "<passive_joint name=\"j\"/>",
            "<!-- a -->",
        ] {
            assert!(parsed(known).is_ok(), "{known}");
        }
        for wrong in [
            "<disable_colisions link1=\"a\" link2=\"b\"/>",
            "<xacro:include filename=\"a\"/>",
            "<group name=\"g\"><disable_collisions link1=\"a\" link2=\"b\"/></group>",
        ] {
            assert!(
                matches!(parsed(wrong), Err(SrdfError::UnknownElement { .. })),
                "{wrong}"
            );
        }
        let missing = parsed("<disable_default_collisions name=\"a\"/>")
            .unwrap_err()
            .to_string();
        assert!(
            missing.contains("<disable_default_collisions>") && missing.contains("'link'"),
            "{missing}"
        );
    }
}
