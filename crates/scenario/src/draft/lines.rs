//! The lines of a text.

use std::ops::Range;

const BOM: &str = "\u{feff}";

/// Changes of a text, from its start to its end: a stretch, and what takes its place.
pub(super) type Splices = Vec<(Range<usize>, String)>;

/// A text with stretches of it replaced; those that begin at the same place in the order given.
pub(super) fn spliced(text: &str, mut splices: Splices) -> String {
    splices.sort_by_key(|(range, _)| range.start);
    let mut done = String::with_capacity(text.len() + 64);
    let mut at = 0;
    for (range, new) in splices {
        done.push_str(text.get(at..range.start).unwrap_or_default());
        done.push_str(&new);
        at = range.end;
    }
    done.push_str(text.get(at..).unwrap_or_default());
    done
}

/// What ends lines in the text, as far as it shows.
pub(super) fn newline(text: &str) -> &'static str {
    match text.find('\n') {
        Some(at) if text[..at].ends_with('\r') => "\r\n",
        _ => "\n",
    }
}

/// Where the first line starts: behind the mark of its encoding.
pub(super) fn first(text: &str) -> usize {
    if text.starts_with(BOM) { BOM.len() } else { 0 }
}

/// Where the line of a place starts.
pub(super) fn start(text: &str, at: usize) -> usize {
    text[..at].rfind('\n').map_or(first(text), |newline| newline + 1)
}

/// Where the line of a place ends, before what ends it.
pub(super) fn end(text: &str, at: usize) -> usize {
    let end = text[at..].find('\n').map_or(text.len(), |newline| at + newline);
    if end < text.len() && text[..end].ends_with('\r') {
        end - 1
    } else {
        end
    }
}

/// Where the line after that of a place starts, the end of the text where there is none.
pub(super) fn next(text: &str, at: usize) -> usize {
    text[at..].find('\n').map_or(text.len(), |newline| at + newline + 1)
}

/// Whether nothing but spaces is before a place in its line.
pub(super) fn begins(text: &str, at: usize) -> bool {
    text[start(text, at)..at].trim().is_empty()
}

/// The spaces at the start of the line of a place.
pub(super) fn indent(text: &str, at: usize) -> &str {
    let line = &text[start(text, at)..at];
    &line[..line.len() - line.trim_start_matches([' ', '\t']).len()]
}

/// Whether the line that starts at a place has nothing in it; the end of the text has not.
pub(super) fn is_blank(text: &str, start: usize) -> bool {
    text[start..end(text, start)].trim().is_empty()
}

/// Whether the line that starts at a place is a comment.
pub(super) fn is_comment(text: &str, start: usize) -> bool {
    text[start..end(text, start)].trim_start().starts_with('#')
}

/// Where the comments begin that stand right above the line of a place; that line where there are none.
pub(super) fn lead(text: &str, at: usize) -> usize {
    let mut lead = start(text, at);
    while lead > first(text) {
        let above = start(text, lead - 1);
        if !is_comment(text, above) {
            break;
        }
        lead = above;
    }
    lead
}

/// The end of the line of a place, or of the comments right below it where nothing that they could be about follows them.
pub(super) fn tail(text: &str, at: usize) -> usize {
    let mut below = next(text, at);
    let mut last = at;
    while below < text.len() && is_comment(text, below) {
        last = below;
        below = next(text, below);
    }
    end(text, if is_blank(text, below) { last } else { at })
}
