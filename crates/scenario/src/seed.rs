//! Seeds that a plan file can state.

use crate::error::Problem;
use platewash_workcell::job::MAX_SEED;

/// Refuses a seed above [`MAX_SEED`], by the name of whatever states it.
///
/// # Errors
/// [`Problem::Value`].
pub fn check_seed(key: &str, seed: u64) -> Result<(), Problem> {
    if seed <= MAX_SEED {
        return Ok(());
    }
    Err(Problem::Value {
        key: key.to_owned(),
        expected: format!("a whole number from 0 to {MAX_SEED} (2^53 − 1)"),
        found: seed.to_string(),
    })
}
