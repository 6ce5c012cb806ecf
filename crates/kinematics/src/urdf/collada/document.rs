//! Elements of an XML file, in memory.

use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;
use std::str::FromStr;

/// Deepest nesting of elements, and greatest number of tags and texts.
const MAX_DEPTH: usize = 100;
const MAX_PIECES: usize = 2_000_000;

/// Elements of which another one holds no more than one: a second one would go unseen.
const ONCE: &str = "accessor asset float_array instance_visual_scene mesh scene technique_common unit vcount vertices";

/// Element with its attributes, the text in it and the elements in it.
#[derive(Default)]
pub(crate) struct Element {
    pub name: String,
    attributes: Vec<(String, String)>,
    text: String,
    pub children: Vec<Self>,
}

impl Element {
    /// Reads a whole file and returns its outermost element.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut reader = Reader::from_str(text);
        let mut around = Self::default();
        let mut open: Vec<Self> = Vec::new();
        for _ in 0..MAX_PIECES {
            let event = reader.read_event();
            let event = event.map_err(|e| format!("it is no whole XML: {e} at byte {}", reader.error_position()))?;
            let depth = open.len();
            let inner = open.last_mut().unwrap_or(&mut around);
            match event {
                Event::Start(_) if depth == MAX_DEPTH => {
                    return Err(format!("its elements are nested more than {MAX_DEPTH} deep"));
                }
                Event::Start(tag) => open.push(Self::begun(&tag)?),
                Event::Empty(tag) => inner.add(Self::begun(&tag)?)?,
                Event::End(_) => {
                    let closed = open.pop().unwrap_or_default();
                    open.last_mut().unwrap_or(&mut around).add(closed)?;
                }
                Event::Text(text) => inner.text += &String::from_utf8_lossy(&text),
                Event::CData(text) => inner.text += &String::from_utf8_lossy(&text),
                // Something that makes a number none, so that none is read wrongly.
                Event::GeneralRef(_) => inner.text.push('&'),
                Event::Eof => {
                    return match (open.pop(), around.children.pop()) {
                        (Some(element), _) => Err(format!("it is cut off in <{}>", element.name)),
                        (None, Some(root)) if around.children.is_empty() => Ok(root),
                        _ => Err("it is no XML with one outermost element".to_owned()),
                    };
                }
                _ => {}
            }
        }
        Err(format!("it has more than {MAX_PIECES} tags and texts"))
    }

    fn begun(tag: &BytesStart<'_>) -> Result<Self, String> {
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let name = text(tag.local_name().as_ref());
        let attributes = tag.attributes().map(|attribute| match attribute {
            Ok(attribute) => Ok((text(attribute.key.as_ref()), text(&attribute.value))),
            Err(e) => Err(format!("<{name}>: {e}")),
        });
        let attributes = attributes.collect::<Result<_, _>>()?;
        Ok(Self {
            name,
            attributes,
            ..Self::default()
        })
    }

    fn add(&mut self, child: Self) -> Result<(), String> {
        if ONCE.split(' ').any(|name| name == child.name) && self.child(&child.name).is_some() {
            return Err(format!("more than one <{}> in <{}>", child.name, self.name));
        }
        self.children.push(child);
        Ok(())
    }

    /// Returns the elements of one kind in this one.
    pub fn all(&self, name: &str) -> impl Iterator<Item = &Self> {
        self.children.iter().filter(move |child| child.name == name)
    }

    /// Returns the first element of one kind in this one.
    pub fn child(&self, name: &str) -> Option<&Self> {
        self.all(name).next()
    }

    /// Visits this element and all in it.
    pub fn each<'a>(&'a self, visit: &mut impl FnMut(&'a Self)) {
        visit(self);
        self.children.iter().for_each(|child| child.each(visit));
    }

    pub fn attribute(&self, name: &str) -> Option<&str> {
        let found = self.attributes.iter().find(|(key, _)| key == name);
        found.map(|(_, value)| value.as_str())
    }

    /// Returns an attribute that the element must have.
    pub fn required(&self, name: &str) -> Result<&str, String> {
        let found = self.attribute(name);
        found.ok_or_else(|| format!("<{}> has no {name}", self.name))
    }

    /// Returns an attribute that is a whole number, or what stands for it where it is absent.
    pub fn count(&self, name: &str, absent: Option<usize>) -> Result<usize, String> {
        match (self.attribute(name), absent) {
            (None, Some(absent)) => Ok(absent),
            _ => number(self.required(name)?.trim(), &self.name),
        }
    }

    /// True if the attribute of another element is the address of this one.
    pub fn is_named_by(&self, other: &Self, attribute: &str) -> bool {
        let named = other.attribute(attribute).and_then(|url| url.strip_prefix('#'));
        named.is_some() && named == self.attribute("id")
    }

    /// Reads the text of the element as numbers.
    pub fn numbers<T: FromStr>(&self) -> Result<Vec<T>, String> {
        let words = self.text.split_whitespace();
        words.map(|word| number(word, &self.name)).collect()
    }
}

fn number<T: FromStr>(word: &str, element: &str) -> Result<T, String> {
    // No `nan`, no `inf`.
    let is_plain = word.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b));
    let number = word.parse().ok().filter(|_| is_plain);
    number.ok_or_else(|| format!("'{word}' in <{element}> is no valid number"))
}
