//! A value in the place of another, with as much of the layout of lists as can be kept.

use super::lines::{self, Splices};
use super::list;
use super::statement::{Inside, Node};
use crate::key::Domain;
use crate::value::json_of;
use crate::write::{in_style_of, on_one_line, on_rows};
use serde_json::Value;
use toml::de::DeValue;

/// More points than this stand in a row each.
const MOST_ON_A_LINE: usize = 4;

/// A value on its own, at a key that had none; `indent` is that of its line, without one it stays on it.
pub(super) fn fresh(text: &str, domain: Domain, value: &Value, indent: Option<&str>) -> String {
    match (domain, value, indent) {
        (Domain::Points(..) | Domain::Knots(..), Value::Array(points), Some(indent))
            if points.len() > MOST_ON_A_LINE =>
        {
            on_rows(points, lines::newline(text), indent)
        }
        _ => on_one_line(value),
    }
}

/// What changes where a value takes the place of another; nothing where it is the same. `indent` is as in [`fresh`].
pub(super) fn merge(text: &str, node: &Node, domain: Domain, value: &Value, indent: Option<&str>) -> Splices {
    let old = &text[node.span.clone()];
    let stated = DeValue::parse(old).map_or(Value::Null, |old| json_of(old.get_ref()));
    let point_in_whole = matches!(domain, Domain::Integer(..)) && !stated.is_i64();
    if same(&stated, value) && !point_in_whole {
        return Vec::new();
    }
    if matches!(
        (&node.inside, value),
        (Inside::Scalar | Inside::Section(_), Value::Array(_))
    ) {
        return vec![(node.span.clone(), fresh(text, domain, value, indent))];
    }
    if let (Value::Array(was), Value::Array(new), Domain::Points(..) | Domain::Knots(..)) = (&stated, value, domain) {
        let grew = new.len() > was.len() && new.len() > MOST_ON_A_LINE;
        if grew && indent.is_some() && !old.contains('\n') {
            return vec![(node.span.clone(), fresh(text, domain, value, indent))];
        }
    }
    let mut splices = Vec::new();
    aligned(text, node, &stated, value, &mut splices);
    splices
}

fn aligned(text: &str, node: &Node, stated: &Value, value: &Value, splices: &mut Splices) {
    let (Inside::List(items), Value::Array(was), Value::Array(new)) = (&node.inside, stated, value) else {
        splices.push((node.span.clone(), in_style_of(&text[node.span.clone()], value)));
        return;
    };
    let most = was.len().min(new.len());
    let before = was.iter().zip(new).take_while(|(a, b)| same(a, b)).count();
    let pairs = was.iter().rev().zip(new.iter().rev()).take(most - before);
    let behind = pairs.take_while(|(a, b)| same(a, b)).count();
    let both = most - behind;
    for at in before..both {
        if !same(&was[at], &new[at])
            && let Some(item) = items.get(at)
        {
            aligned(text, &item.value, &was[at], &new[at], splices);
        }
    }
    let more: Vec<_> = new[both..new.len() - behind].iter().map(on_one_line).collect();
    splices.extend(list::insert(text, node, items, both, &more));
    splices.extend(list::remove(text, node, items, both..was.len() - behind));
}

/// Whether two values are the same to whoever reads the file: numbers to the bit, and a whole number with a point is the one
/// without.
pub(super) fn same(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => a.as_f64().map(f64::to_bits) == b.as_f64().map(f64::to_bits),
        (Value::Array(a), Value::Array(b)) => a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b)),
        (Value::Null, _) | (_, Value::Null) => false,
        _ => a == b,
    }
}
