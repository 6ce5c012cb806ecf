//! Elements of lists, and assignments within braces, that come and go; their layout, commas and comments stay.

use super::lines::{self, Splices};
use super::statement::{Item, Node};
use std::ops::Range;

/// Puts texts before the item at a place, or behind the last.
pub(super) fn insert(text: &str, list: &Node, items: &[Item], at: usize, new: &[String]) -> Splices {
    if new.is_empty() {
        return Vec::new();
    }
    if let Some(item) = items.get(at) {
        let behind = if lines::begins(text, item.span.start) {
            format!(",{}{}", lines::newline(text), lines::indent(text, item.span.start))
        } else {
            ", ".to_owned()
        };
        let new: String = new.iter().map(|new| format!("{new}{behind}")).collect();
        return vec![(item.span.start..item.span.start, new)];
    }
    let Some(last) = items.last() else {
        let before_bracket = list.span.end - 1;
        return vec![(before_bracket..before_bracket, new.join(", "))];
    };
    if own_lines(text, list, last) {
        let before = format!("{}{}", lines::newline(text), lines::indent(text, last.span.start));
        let at = lines::end(text, last.end());
        let rows = new.join(&format!(",{before}"));
        return match last.comma {
            Some(_) => vec![(at..at, format!("{before}{rows},"))],
            None => vec![
                (last.span.end..last.span.end, ",".to_owned()),
                (at..at, format!("{before}{rows}")),
            ],
        };
    }
    let at = last.end();
    let joined = new.join(", ");
    let new = if last.comma.is_some() {
        format!(" {joined},")
    } else {
        format!(", {joined}")
    };
    vec![(at..at, new)]
}

/// Takes items out.
pub(super) fn remove(text: &str, list: &Node, items: &[Item], out: Range<usize>) -> Splices {
    let gone = items.get(out.clone()).unwrap_or_default();
    let (Some(first), Some(last)) = (gone.first(), gone.last()) else {
        return Vec::new();
    };
    let from_line = lines::begins(text, first.span.start).then(|| lines::start(text, first.span.start));
    if let Some(next) = items.get(out.end) {
        let range = match from_line {
            Some(start) if lines::begins(text, next.span.start) => start..lines::next(text, last.end()),
            _ => first.span.start..next.span.start,
        };
        return vec![(range, String::new())];
    }
    let Some(before) = out.start.checked_sub(1).map(|before| &items[before]) else {
        return vec![(all_of(text, list, first, last), String::new())];
    };
    // The comma before what goes is kept where that had one, too.
    let mut splices = Vec::new();
    let spare = before.comma.clone().filter(|_| last.comma.is_none());
    let gap = before.end()..first.span.start;
    if text[gap.clone()].chars().all(|c| c == ' ' || c == '\t') {
        let start = spare.map_or(gap.start, |comma| comma.start);
        return vec![(start..last.end(), String::new())];
    }
    splices.extend(spare.map(|comma| (comma, String::new())));
    let range = match from_line {
        Some(start) if own_lines(text, list, last) => start..lines::next(text, last.end()),
        _ => first.span.start..last.end(),
    };
    splices.push((range, String::new()));
    splices
}

/// What goes where all items do: the spaces about them, too, where nothing else is there.
fn all_of(text: &str, list: &Node, first: &Item, last: &Item) -> Range<usize> {
    let inside = list.span.start + 1..list.span.end - 1;
    let about = [inside.start..first.span.start, last.end()..inside.end];
    if about.into_iter().all(|gap| text[gap].trim().is_empty()) {
        inside
    } else {
        first.span.start..last.end()
    }
}

/// Whether an item begins a line, and the bracket that closes its list is on a later one.
fn own_lines(text: &str, list: &Node, item: &Item) -> bool {
    lines::begins(text, item.span.start) && lines::end(text, item.end()) < list.span.end - 1
}
