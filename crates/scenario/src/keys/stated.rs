//! Keys that a section states.

use crate::keys::key::{Key, own_name};
use serde::Serialize;

/// The first key of a section, of those wanted, that the section states. One with a default is always stated.
pub(crate) fn first_stated(
    section: &impl Serialize,
    keys: &'static [Key],
    wanted: impl Fn(&str) -> bool,
) -> Option<&'static Key> {
    let values = serde_json::to_value(section).unwrap_or_default();
    let is_stated = |name: &str| values.get(name).is_some_and(|value| !value.is_null());
    keys.iter()
        .find(|key| wanted(own_name(key)) && is_stated(own_name(key)))
}
