//! `urdf-rs` says what is wrong but not where: this finds the element.

use super::scan::line_at;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

/// The first child of `<robot>` that `urdf-rs` does not read on its own, as "joint 'NAME' (line N)".
pub(super) fn find(text: &str) -> Option<String> {
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
                let line = line_at(text, start as u64);
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
