//! A value in the place of another: elements of lists change, come and go, and the other elements keep their layout and their comments.
//!
//! `toml_edit` keeps the text between two elements, also a comment behind the comma, before the second one.

use crate::draft::stop::Stop;
use crate::draft::value::{bare_text, json, parsed, replace_value, same, text_of};
use crate::keys::toml_text::{in_style_of, on_one_line};
use serde_json::Value as Json;
use toml_edit::{Array, Value};

/// Puts elements in the place of others: those at the beginning and at the end that are the same stay.
pub(crate) fn merge_elements(old: &mut Array, new: &[Json]) -> Result<(), Stop> {
    let was: Vec<Json> = old.iter().map(json).collect();
    let most = was.len().min(new.len());
    let before = was.iter().zip(new).take_while(|(a, b)| same(a, b)).count();
    let pairs = was.iter().rev().zip(new.iter().rev()).take(most - before);
    let behind = pairs.take_while(|(a, b)| same(a, b)).count();
    let both = most - behind;
    for at in before..both {
        if let Some(element) = old.get_mut(at).filter(|_| !same(&was[at], &new[at])) {
            merge(element, &new[at])?;
        }
    }
    for at in (both..was.len() - behind).rev() {
        remove(old, at);
    }
    for (k, value) in new[both..new.len() - behind].iter().enumerate() {
        insert(old, both + k, value)?;
    }
    Ok(())
}

/// Text before an element; before the bracket, behind the last one.
fn gap(array: &Array, at: usize) -> String {
    match (array.get(at), array.get(at.wrapping_sub(1))) {
        (Some(element), _) => text_of(element.decor().prefix()),
        (None, Some(last)) if !array.trailing_comma() => text_of(last.decor().suffix()),
        (None, _) => text_of(Some(array.trailing())),
    }
}

fn set_gap(array: &mut Array, at: usize, gap: String) {
    let ends_with_comma = array.trailing_comma();
    if let Some(element) = array.get_mut(at) {
        return element.decor_mut().set_prefix(gap);
    }
    match array.get_mut(at.wrapping_sub(1)).filter(|_| !ends_with_comma) {
        Some(last) => last.decor_mut().set_suffix(gap),
        None => array.set_trailing(gap),
    }
}

/// Takes an element out: the comment behind it goes, too, those before it stay.
fn remove(array: &mut Array, at: usize) {
    let (before, behind) = (gap(array, at), gap(array, at + 1));
    array.remove(at);
    let rest = behind.find('\n').map(|line| &behind[line..]);
    let joined = match (rest, array.is_empty()) {
        (Some(rest), _) => before.trim_end_matches([' ', '\t', '\n']).to_owned() + rest,
        (None, true) => String::new(),
        (None, false) if at == array.len() => behind,
        (None, false) => before,
    };
    set_gap(array, at, joined);
}

/// Puts an element in, on a line of its own where others are.
fn insert(array: &mut Array, at: usize, value: &Json) -> Result<(), Stop> {
    let gaps: Vec<String> = (0..array.len()).map(|at| gap(array, at)).collect();
    let line = gaps
        .iter()
        .find_map(|gap| gap.rfind('\n').map(|line| gap[line..].to_owned()));
    let is_last = at == array.len();
    let here = gap(array, at);
    let mut element = parsed(&on_one_line(value))?;
    let (own, next) = match line {
        // The comment behind the element before stays behind it.
        Some(line) if is_last => {
            let comment = here.find('\n').map_or("", |end| &here[..end]);
            (format!("{comment}{line}"), here[comment.len()..].to_owned())
        }
        Some(line) => (here, line),
        None if is_last && at > 0 => (" ".to_owned(), here),
        None if at == 0 => (here, if is_last { String::new() } else { " ".to_owned() }),
        None => (" ".to_owned(), here),
    };
    element.decor_mut().set_prefix(own);
    if is_last && at > 0 && !array.trailing_comma() {
        set_gap(array, at, String::new());
    }
    array.insert_formatted(at, element);
    set_gap(array, at + 1, next);
    Ok(())
}

/// Puts a value in the place of another, element by element where both are lists.
pub(crate) fn merge(old: &mut Value, value: &Json) -> Result<(), Stop> {
    if let (Value::Array(old), Json::Array(new)) = (&mut *old, value) {
        return merge_elements(old, new);
    }
    let new = parsed(&in_style_of(&bare_text(old), value))?;
    replace_value(old, new);
    Ok(())
}
