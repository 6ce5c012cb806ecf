//! What counts in a scenario, key by key.

use crate::keys::KEYS;
use crate::scenario::Scenario;
use serde_json::Value;
use std::collections::BTreeMap;

/// The values of a scenario by their keys, defaults filled in; keys without a value are left out. Paths are as the scenario has them:
/// those of a file that was loaded begin with its folder.
#[must_use]
pub fn values_of(scenario: &Scenario) -> BTreeMap<String, Value> {
    let Ok(all) = serde_json::to_value(scenario) else {
        return BTreeMap::new();
    };
    let stated = KEYS.iter().filter_map(|key| {
        let value = key.path.split('.').try_fold(&all, |v, name| v.get(name))?;
        (!value.is_null()).then(|| (key.path.to_owned(), value.clone()))
    });
    stated.collect()
}
