//! Tips on arguments that the command does not know.

use clap::Error;
use clap::error::{ContextKind, ContextValue};
use platewash::scenario::{SHIPPED, form};

/// Keys that a tip names at most.
const MOST_KEYS: usize = 3;

/// Characters that an option begins with as the one that is suggested in its place, to be taken for it, dashes too.
const NEAR: usize = 6;

/// An error about arguments, with a tip where a scenario stands without `--scenario`, or an option has the name of a scenario's key.
pub fn with_tip(mut error: Error) -> Error {
    let given = [ContextKind::InvalidArg, ContextKind::InvalidSubcommand];
    let given = given.into_iter().find_map(|kind| match error.get(kind) {
        Some(ContextValue::String(given)) => Some(given.clone()),
        _ => None,
    });
    let known = match error.get(ContextKind::SuggestedArg) {
        Some(ContextValue::String(known)) => known.clone(),
        _ => String::new(),
    };
    let is_near = |given: &String| given.chars().zip(known.chars()).take_while(|(a, b)| a == b).count() >= NEAR;
    if let Some(tip) = given.filter(|given| !is_near(given)).and_then(|given| tip(&given)) {
        let _ = error.remove(ContextKind::SuggestedArg);
        let _ = error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip.into()]));
    }
    error
}

fn tip(given: &str) -> Option<String> {
    if SHIPPED.iter().any(|shipped| shipped.name == given) || given.ends_with(".toml") {
        return Some(format!("a scenario is given as '--scenario {given}'"));
    }
    let option = given.strip_prefix("--")?.split('=').next()?.replace('-', "_");
    let is_named = |path: &str| {
        let name = path.rsplit('.').next().and_then(|name| name.strip_prefix(&*option));
        name.is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
    };
    let form = form();
    let keys = form
        .iter()
        .map(|key| key.path)
        .filter(|path| is_named(path))
        .take(MOST_KEYS);
    let keys: Vec<String> = keys.map(|path| format!("'{path}'")).collect();
    (!keys.is_empty()).then(|| format!("keys are set in the scenario's file: {}", keys.join(", ")))
}
