//! Lines of a text by their numbers, and the place at which a text states a key.

use toml::de::{DeTable, DeValue};

/// The line of a byte, from 1.
pub(crate) fn line_at(text: &str, byte: usize) -> usize {
    1 + text.as_bytes()[..byte.min(text.len())]
        .iter()
        .filter(|b| **b == b'\n')
        .count()
}

/// Byte at which a text states a key such as `layout.count` or `obstacle[1].name`. For a key that is left out it is the byte of
/// the section, where the section is one of a list or states something else. `None` where there is neither.
pub(crate) fn byte_of(table: &DeTable<'_>, key: &str) -> Option<usize> {
    let (first, rest) = key
        .split_once('.')
        .map_or((key, None), |(first, rest)| (first, Some(rest)));
    let (name, index) = match first.split_once('[') {
        Some((name, index)) => (name, index.trim_end_matches(']').parse::<usize>().ok()),
        None => (first, None),
    };
    let (stated, value) = table.iter().find(|(stated, _)| stated.get_ref() == name)?;
    let (at, value) = match (index, value.get_ref()) {
        (Some(index), DeValue::Array(all)) => all.get(index).map(|one| (one.span().start, one.get_ref()))?,
        (_, value) => (stated.span().start, value),
    };
    match (rest, value) {
        (Some(rest), DeValue::Table(section)) => byte_of(section, rest).or(Some(at)),
        _ => Some(at),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_a_key_in_its_line_or_its_section() {
        let text = "seed = 1\nlayout.count = 2\n[wash]\nturns = 1\n[[plate]]\ncount = 1\n\n[[plate]]\ncount = 2\n";
        let table = DeTable::parse(text).unwrap();
        let line = |key: &str| byte_of(table.get_ref(), key).map(|at| line_at(text, at));
        for (key, expected) in [
            ("seed", Some(1)),
            ("layout.count", Some(2)),
            ("wash.turns", Some(4)),
            ("wash.lift_m", Some(3)),
            ("plate[1].count", Some(9)),
            ("plate[1].at_m", Some(8)),
            ("plate[7].at_m", None),
            ("tool.length_m", None),
            ("", None),
            ("plate[x].count", Some(5)),
        ] {
            assert_eq!(line(key), expected, "{key}");
        }
    }
}
