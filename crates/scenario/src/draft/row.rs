//! Where a key of a section of a list stands in a text, or would go.

use super::place::{Place, in_braces};
use super::statement::{Inside, Kind, Statement};

/// Where the key of the section with this index, of a list that is stated by `[[name]]` or as `name = [{ … }]`, stands or would go. A section that is not
/// there gets no key.
pub(super) fn place_in_row<'a>(statements: &'a [Statement], (list, index): (&str, usize), name: &str) -> Place<'a> {
    let (mut last, mut count, mut is_inside, mut is_below_header) = (None, 0, false, false);
    for statement in statements {
        match &statement.kind {
            Kind::ListedSection if statement.path == [list] => {
                is_inside = count == index;
                count += 1;
                is_below_header = true;
                if is_inside {
                    last = Some(statement);
                }
            }
            Kind::Section | Kind::ListedSection => {
                // A section of the row's own, as `[plate.more]`, of which there is none that counts.
                if is_inside && statement.path.first().is_some_and(|first| first == list) {
                    return Place::Blocked { by: statement };
                }
                (is_inside, is_below_header) = (false, true);
            }
            Kind::Assignment(value) if is_inside => {
                if statement.path == [name] {
                    return Place::Line { statement, value };
                }
                if statement.path.first().is_some_and(|first| first == name) {
                    return Place::Blocked { by: statement };
                }
                last = Some(statement);
            }
            Kind::Assignment(value) if !is_below_header && statement.path == [list] => {
                let Inside::List(items) = &value.inside else {
                    return Place::Blocked { by: statement };
                };
                return match items.get(index) {
                    Some(item) => in_braces(statement, &item.value, name),
                    None => Place::NoSection,
                };
            }
            Kind::Assignment(_) => {}
        }
    }
    match last {
        Some(statement) => Place::Behind {
            statement,
            dotted: false,
        },
        None => Place::NoSection,
    }
}
