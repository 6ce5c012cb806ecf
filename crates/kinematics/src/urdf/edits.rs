//! Changes of a text that keep its lines.

use quick_xml::events::attributes::Attribute;
use std::ops::Range;

/// Ranges of a text that become blank, and texts that come in.
#[derive(Debug, Default)]
pub(crate) struct Edits {
    blank: Vec<Range<usize>>,
    inserted: Vec<(usize, String)>,
}

impl Edits {
    /// Blanks a range of bytes, but for line breaks.
    pub fn blank(&mut self, range: Range<usize>) {
        self.blank.push(range);
    }

    /// Blanks an attribute that a parser has borrowed from the text.
    pub fn blank_attribute(&mut self, text: &str, attribute: &Attribute<'_>) {
        let key = attribute.key.as_ref();
        let start = (key.as_ptr() as usize).wrapping_sub(text.as_ptr() as usize);
        let Some(rest) = text.as_bytes().get(start..) else {
            return;
        };
        // The value stands between two equal quotation marks.
        let quote = rest.iter().position(|byte| matches!(byte, b'"' | b'\''));
        let Some(quote) = quote else { return };
        let close = rest[quote + 1..].iter().position(|byte| *byte == rest[quote]);
        if let Some(close) = close.filter(|_| rest.starts_with(key)) {
            self.blank(start..start + quote + close + 2);
        }
    }

    /// Inserts a text at an offset.
    pub fn insert(&mut self, at: usize, text: &str) {
        self.inserted.push((at, text.replace(['\n', '\r'], " ")));
    }

    /// Returns the text with the changes. What is inserted into a blank range is dropped.
    pub fn applied_to(mut self, text: &str) -> String {
        let mut bytes = text.as_bytes().to_vec();
        for range in &self.blank {
            let range = range.start..range.end.min(bytes.len());
            let kept = |byte: &u8| matches!(byte, b'\n' | b'\r');
            bytes[range]
                .iter_mut()
                .filter(|byte| !kept(byte))
                .for_each(|byte| *byte = b' ');
        }
        self.inserted.sort_by_key(|(at, _)| std::cmp::Reverse(*at));
        for (at, text) in self.inserted {
            if !self.blank.iter().any(|range| range.contains(&at)) {
                bytes.splice(at..at, text.bytes());
            }
        }
        // Only whole characters become blank.
        String::from_utf8(bytes).unwrap_or_default()
    }
}
