//! Link pairs that need no collision check, read from an SRDF file (the `disable_collisions` elements that
//! MoveIt's set-up assistant writes).

use crate::sha256_hex;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;
use std::collections::{BTreeMap, BTreeSet};

/// Unordered pairs of link names that need no collision check.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct DisabledPairs {
    /// Second links of the pairs, by their first link.
    pairs: BTreeMap<String, BTreeSet<String>>,
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
    /// A `disable_collisions` element lacks one of its links.
    #[error("SRDF: a <disable_collisions> element at byte {position} has no attribute '{attribute}'")]
    MissingAttribute {
        /// Byte offset.
        position: u64,
        /// `link1` or `link2`.
        attribute: &'static str,
    },
    /// A link is named that the arm does not have.
    #[error("SRDF names link '{link}', which the URDF does not have")]
    UnknownLink {
        /// Name of the link.
        link: String,
    },
}

impl DisabledPairs {
    /// Reads the `disable_collisions` elements of an SRDF text; everything else in it is ignored.
    ///
    /// # Errors
    /// [`SrdfError`] for broken XML, another root element, or an element without its links.
    pub fn parse(text: &str) -> Result<Self, SrdfError> {
        let mut reader = Reader::from_str(text);
        let mut pairs = BTreeMap::<String, BTreeSet<String>>::new();
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
                    if tag.name().as_ref() == b"disable_collisions" {
                        let [a, b] = [attribute(tag, "link1", position)?, attribute(tag, "link2", position)?];
                        pairs.entry(a).or_default().insert(b);
                    }
                    depth += usize::from(matches!(event, Event::Start(_)));
                }
                Event::End(_) => depth = depth.saturating_sub(1),
                Event::Eof if depth > 0 => return Err(xml(position, &"the file ends inside an element")),
                Event::Eof if !root_seen => {
                    let found = "no element at all".to_owned();
                    return Err(SrdfError::NotARobot { found });
                }
                Event::Eof => {
                    let sha256 = sha256_hex(text.as_bytes());
                    return Ok(Self { pairs, sha256 });
                }
                _ => {}
            }
        }
    }

    /// SHA-256 of the text that the list was read from, in lower-case hexadecimal.
    #[must_use]
    pub fn sha256(&self) -> &str {
        &self.sha256
    }

    /// True if the pair needs no collision check, in either order.
    #[must_use]
    pub fn contains(&self, a: &str, b: &str) -> bool {
        let listed = |x: &str, y: &str| self.pairs.get(x).is_some_and(|others| others.contains(y));
        listed(a, b) || listed(b, a)
    }

    pub(crate) fn check_links<'a>(&self, known: impl Iterator<Item = &'a str>) -> Result<(), SrdfError> {
        let known: BTreeSet<_> = known.collect();
        let named = self
            .pairs
            .iter()
            .flat_map(|(a, others)| std::iter::once(a).chain(others));
        match named.into_iter().find(|name| !known.contains(name.as_str())) {
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
}
