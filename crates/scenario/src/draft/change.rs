//! Change of a text where a key gets a value, or loses it.

use crate::draft::edit_error::EditError;
use crate::draft::elements::merge;
use crate::draft::stop::Stop;
use crate::draft::target::Target;
use crate::draft::value::{json, parsed, replace_value, same, text_of};
use crate::keys::key::Domain;
use crate::keys::line::line_at;
use crate::keys::table::KEYS;
use crate::keys::toml_text::{on_one_line, on_rows};
use serde_json::Value as Json;
use toml_edit::{Document, DocumentMut, InlineTable, Item, Key, KeyMut, Table, Value};

/// The mark of the encoding that a text may begin with.
const MARK: char = '\u{feff}';

/// Points of a list that stand on one line at most: more stand in a row each.
const MOST_ON_A_LINE: usize = 4;

/// Longest part of a line that is quoted in a message.
const LONGEST: usize = 40;

/// The text in which a key has a value, or none; `None` where it is the same text.
pub(crate) fn changed(text: &str, target: &Target, value: Option<&Json>) -> Result<Option<String>, EditError> {
    let plain = plain(text);
    let change = || {
        let mut document = document(&plain)?;
        match value {
            Some(value) => set(&mut document, target, value)?,
            None => remove(&mut document, target)?,
        }
        Ok(restored(document.to_string(), text))
    };
    let key = target.path();
    change().map(Some).or_else(|stop| match stop {
        Stop::Same => Ok(None),
        Stop::Blocked => Err(blocked(&plain, target)),
        Stop::NoRow(list) => Err(EditError::NoRow { key, list }),
        Stop::Unplaced => Err(EditError::Unplaced { key }),
    })
}

/// The text without a section of a list. Its comments go with it, but for those before the last blank line over it.
pub(crate) fn without_row(text: &str, (list, index): (&'static str, usize)) -> Result<String, EditError> {
    let plain = plain(text);
    let key = format!("{list}[{index}]");
    let mut document = document(&plain).map_err(|_| EditError::Unplaced { key: key.clone() })?;
    let lead = match document.get_mut(list) {
        Some(Item::ArrayOfTables(rows)) if index < rows.len() => {
            let row = rows.remove(index);
            let lead = text_of(row.decor().prefix());
            let kept = lead[..lead.rfind("\n\n").map_or(0, |blank| blank + 1)].to_owned();
            Some((kept, row.position()))
        }
        Some(Item::Value(Value::Array(rows))) if index < rows.len() => {
            rows.remove(index);
            None
        }
        _ => return Err(EditError::NoRow { key, list }),
    };
    if let Some((lead, position)) = lead.filter(|(lead, _)| !lead.trim().is_empty()) {
        lead_to_next(&mut document, position.unwrap_or(0), &lead);
    }
    Ok(restored(document.to_string(), text))
}

/// The document of a text that is printed as it stands. Dotted keys of two sections that take turns, for example, would be moved.
fn document(plain: &str) -> Result<DocumentMut, Stop> {
    let document = Document::parse(plain).map_err(|_| Stop::Unplaced)?;
    let document = document.into_mut();
    (document.to_string() == plain)
        .then_some(document)
        .ok_or(Stop::Unplaced)
}

/// A text with line feeds at the ends of all its lines, and without its mark.
fn plain(text: &str) -> String {
    let mut plain = text.trim_start_matches(MARK).replace("\r\n", "\n");
    if !plain.is_empty() && !plain.ends_with('\n') {
        plain.push('\n');
    }
    plain
}

/// A changed text with the ends of lines and the mark of the text that it comes from.
fn restored(mut changed: String, text: &str) -> String {
    let bare = text.trim_start_matches(MARK);
    if !bare.is_empty() && !bare.ends_with('\n') && changed.ends_with('\n') {
        changed.pop();
    }
    if text.contains("\r\n") {
        changed = changed.replace('\n', "\r\n");
    }
    match text.starts_with(MARK) {
        true => format!("{MARK}{changed}"),
        false => changed,
    }
}

/// The section of a key; `None` where it is not there.
fn section<'d>(document: &'d mut DocumentMut, target: &Target) -> Result<Option<&'d mut Item>, Stop> {
    Ok(match (target.row, target.section()) {
        (Some((list, index)), _) => match document.get_mut(list) {
            Some(item @ (Item::ArrayOfTables(_) | Item::Value(Value::Array(_)))) => item.get_mut(index),
            Some(_) => return Err(Stop::Blocked),
            None => None,
        },
        (None, Some(section)) => document.get_mut(section),
        (None, None) => Some(document.as_item_mut()),
    })
}

fn set(document: &mut DocumentMut, target: &Target, value: &Json) -> Result<(), Stop> {
    let (name, domain) = (target.name(), target.key.domain);
    if section(document, target)?.is_none() {
        match (target.row, target.section()) {
            (Some((list, _)), _) => return Err(Stop::NoRow(list)),
            (None, Some(section)) => add_section(document, section),
            (None, None) => {}
        }
    }
    let is_first = target.row.is_none() && target.section().is_none() && !has_keys(document);
    let head = is_first.then(|| take_head(document));
    match section(document, target)? {
        Some(Item::Table(table)) => match table.get_mut(name) {
            Some(Item::Value(Value::InlineTable(_))) if !is_table(domain) => Err(Stop::Blocked),
            Some(Item::Value(old)) => replace(old, value, domain),
            Some(_) => Err(Stop::Blocked),
            None => {
                add_key(table, name, fresh(value, domain)?, head);
                Ok(())
            }
        },
        Some(Item::Value(Value::InlineTable(table))) => match (is_on_one_line(table), table.get_mut(name)) {
            (_, Some(Value::InlineTable(_))) if !is_table(domain) => Err(Stop::Blocked),
            (_, Some(old)) => replace(old, value, domain),
            (false, None) => Err(Stop::Unplaced),
            (true, None) => {
                table.insert(name, parsed(&on_one_line(value))?);
                table.fmt();
                Ok(())
            }
        },
        _ => Err(Stop::Blocked),
    }
}

fn remove(document: &mut DocumentMut, target: &Target) -> Result<(), Stop> {
    let (name, domain) = (target.name(), target.key.domain);
    let lead = match section(document, target)? {
        None => return Err(Stop::Same),
        Some(Item::Table(table)) => match table.get(name) {
            None => return Err(Stop::Same),
            Some(Item::Value(value)) if is_table(domain) || !value.is_inline_table() => {
                match (table.is_dotted(), target.section()) {
                    (true, Some(section)) => remove_key(document.as_table_mut(), &[section, name]),
                    _ => remove_key(table, &[name]),
                }
            }
            Some(_) => return Err(Stop::Blocked),
        },
        Some(Item::Value(Value::InlineTable(table))) => match table.get(name) {
            None => return Err(Stop::Same),
            Some(Value::InlineTable(_)) if !is_table(domain) => return Err(Stop::Blocked),
            Some(_) if !is_on_one_line(table) => return Err(Stop::Unplaced),
            Some(_) => {
                table.remove(name);
                table.fmt();
                return Ok(());
            }
        },
        Some(_) => return Err(Stop::Blocked),
    };
    keep_lead(document, target, &lead);
    Ok(())
}

/// True where a key's value is a table.
fn is_table(domain: Domain) -> bool {
    matches!(domain, Domain::Positions(..))
}

/// Checks that braces have no lines and no comments of their own, which could not be kept.
fn is_on_one_line(table: &InlineTable) -> bool {
    !table.to_string().contains('\n')
}

/// Puts an empty section where the table of keys has it: behind the nearest one before it, or before all others.
fn add_section(document: &mut DocumentMut, section: &str) {
    let rank = |section: &str| KEYS.iter().position(|key| key.path.split('.').next() == Some(section));
    let position = |name: &str, item: &Item| Some((rank(name)?, last_position(item)?));
    let own = rank(section);
    let others: Vec<_> = document
        .iter()
        .filter_map(|(name, item)| position(name, item))
        .collect();
    let before = others
        .iter()
        .filter(|(rank, _)| Some(*rank) < own)
        .max_by_key(|(rank, _)| *rank);
    let first = others.iter().map(|(_, position)| *position).min();
    let mut table = Table::new();
    table.set_position(before.map(|(_, position)| *position).or(first.map(|first| first - 1)));
    let lead = match before.is_some() || has_keys(document) {
        true => "\n".to_owned(),
        false => take_head(document),
    };
    table.decor_mut().set_prefix(lead);
    document.insert(section, Item::Table(table));
}

/// Checks that there are keys before the first section.
fn has_keys(document: &DocumentMut) -> bool {
    let is_key = |item: &Item| match item {
        Item::Table(table) => table.is_dotted(),
        other => other.is_value(),
    };
    document.iter().any(|(_, item)| is_key(item))
}

/// Takes the head of a text without keys: the comments up to the last blank line before the first section.
fn take_head(document: &mut DocumentMut) -> String {
    let tables = tables_of(document.as_table_mut()).into_iter();
    if let Some(first) = tables.min_by_key(|table| table.position()) {
        let lead = text_of(first.decor().prefix());
        let (head, rest) = lead.split_at(lead.rfind("\n\n").map_or(0, |blank| blank + 2));
        first.decor_mut().set_prefix(format!("\n{rest}"));
        return head.to_owned();
    }
    let head = text_of(Some(document.trailing()));
    document.set_trailing("");
    match head.is_empty() || head.ends_with("\n\n") {
        true => head,
        false => head + "\n",
    }
}

/// Position of the last header of a section, those of its own sections included.
fn last_position(item: &Item) -> Option<isize> {
    let table = item.as_table()?;
    let inside = table.iter().filter_map(|(_, item)| last_position(item));
    inside.chain(table.position()).max()
}

/// Adds a key behind all others of its section, indented as they are; behind `head`, if there are no others.
fn add_key(table: &mut Table, name: &str, value: Value, head: Option<String>) {
    let last = table.iter().filter(|(_, item)| item.is_value()).last();
    let last = last.and_then(|(name, _)| table.key(name));
    let indent = last.map(|key| text_of(key.leaf_decor().prefix()));
    let indent = indent.map(|prefix| prefix.rsplit('\n').next().unwrap_or_default().to_owned());
    table.insert(name, Item::Value(value));
    let lead = head.or(indent.filter(|indent| indent.trim().is_empty()));
    if let (Some(lead), Some(mut key)) = (lead, table.key_mut(name)) {
        key.leaf_decor_mut().set_prefix(lead);
    }
}

/// Takes a key out, with the comment behind it; the lines that lead to it, where no other key follows that they can stand before.
fn remove_key(table: &mut Table, path: &[&str]) -> String {
    let own_path = |keys: &[&Key]| keys.iter().map(|key| key.get().to_owned()).collect::<Vec<_>>();
    let paths: Vec<_> = table.get_values().iter().map(|(keys, _)| own_path(keys)).collect();
    let at = paths.iter().position(|own| own == path).unwrap_or(paths.len());
    let mut lead = key_at(table, path)
        .map(|key| text_of(key.leaf_decor().prefix()))
        .unwrap_or_default();
    lead.truncate(lead.rfind('\n').map_or(0, |end| end + 1));
    if let Some(mut next) = paths.get(at + 1).and_then(|next| key_at(table, next)) {
        let own = text_of(next.leaf_decor().prefix());
        next.leaf_decor_mut().set_prefix(std::mem::take(&mut lead) + &own);
    }
    match path {
        [section, name] => table
            .get_mut(section)
            .and_then(Item::as_table_mut)
            .and_then(|table| table.remove(name)),
        _ => path.first().and_then(|name| table.remove(name)),
    };
    lead
}

/// The key of a path, through dotted sections.
fn key_at<'t>(table: &'t mut Table, path: &[impl AsRef<str>]) -> Option<KeyMut<'t>> {
    match path {
        [name] => table.key_mut(name.as_ref()),
        [section, rest @ ..] => key_at(table.get_mut(section.as_ref())?.as_table_mut()?, rest),
        [] => None,
    }
}

/// Keeps the lines that led to the last key of its section: before the next section, or at the end.
fn keep_lead(document: &mut DocumentMut, target: &Target, lead: &str) {
    if lead.is_empty() {
        return;
    }
    let own = section(document, target)
        .ok()
        .flatten()
        .and_then(|item| item.as_table()?.position());
    lead_to_next(document, own.unwrap_or(0), lead);
}

/// Puts lines before the first section behind a position, or at the end.
fn lead_to_next(document: &mut DocumentMut, after: isize, lead: &str) {
    let mut next: Option<&mut Table> = None;
    for table in tables_of(document.as_table_mut()) {
        let position = table.position();
        if position > Some(after) && next.as_ref().is_none_or(|next| position < next.position()) {
            next = Some(table);
        }
    }
    match next {
        Some(next) => {
            let prefix = text_of(next.decor().prefix());
            next.decor_mut().set_prefix(format!("{lead}{prefix}"));
        }
        None => {
            let trailing = text_of(Some(document.trailing()));
            document.set_trailing(format!("{lead}{trailing}"));
        }
    }
}

/// Returns all tables with a header.
fn tables_of(table: &mut Table) -> Vec<&mut Table> {
    let mut all = Vec::new();
    for (_, item) in table.iter_mut() {
        match item {
            Item::Table(table) => match table.is_implicit() || table.is_dotted() {
                true => all.extend(tables_of(table)),
                false => all.push(table),
            },
            Item::ArrayOfTables(array) => all.extend(array.iter_mut()),
            _ => {}
        }
    }
    all
}

/// A value on its own, at a key that had none.
fn fresh(value: &Json, domain: Domain) -> Result<Value, Stop> {
    match (domain, value) {
        (Domain::Points(..) | Domain::Knots(..), Json::Array(points)) if points.len() > MOST_ON_A_LINE => {
            parsed(&on_rows(points))
        }
        _ => parsed(&on_one_line(value)),
    }
}

/// Puts a value in the place of another, with its comments and as much of the layout of lists as can be kept.
fn replace(old: &mut Value, value: &Json, domain: Domain) -> Result<(), Stop> {
    let stated = json(old);
    let point_in_whole = matches!(domain, Domain::Integer(..)) && !stated.is_i64();
    if same(&stated, value) && !point_in_whole {
        return Err(Stop::Same);
    }
    let is_list = |domain| matches!(domain, Domain::Points(..) | Domain::Knots(..));
    let grows = match (old.as_array(), value) {
        (Some(old), Json::Array(new)) => {
            is_list(domain) && new.len() > old.len().max(MOST_ON_A_LINE) && !old.to_string().contains('\n')
        }
        (None, Json::Array(_)) => true,
        _ => false,
    };
    match grows {
        true => replace_value(old, fresh(value, domain)?),
        false => merge(old, value)?,
    }
    Ok(())
}

/// Error of a key whose place is taken: it names the last thing on the way to it that is there.
fn blocked(text: &str, target: &Target) -> EditError {
    let mut at = 0;
    if let Ok(document) = Document::parse(text) {
        let mut item = document.as_item();
        let section = target.row.map_or(target.section(), |(list, _)| Some(list));
        for name in section.into_iter().chain([target.name()]) {
            let Some(next) = item.get(name).or_else(|| item.get(target.row?.1)?.get(name)) else {
                break;
            };
            let first = next.as_array_of_tables().and_then(|array| array.get(0)?.span());
            at = next.span().or(first).map_or(at, |span| span.start);
            item = next;
        }
    }
    let start = text[..at].rfind('\n').map_or(0, |end| end + 1);
    let found = text[start..].lines().next().unwrap_or_default();
    EditError::Blocked {
        key: target.path(),
        line: line_at(text, at),
        found: found.chars().take(LONGEST).collect(),
    }
}
