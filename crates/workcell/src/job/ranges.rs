//! Numbers of a job that are out of their range.

use crate::job::error::TermsError;

/// Refuses a number outside of its range, or NaN.
pub(crate) fn within(name: &'static str, found: f64, [least, most]: [f64; 2]) -> Result<(), TermsError> {
    if (least..=most).contains(&found) {
        return Ok(());
    }
    let expected = format!("from {least} to {most}");
    Err(TermsError::Number { name, expected, found })
}

/// Refuses a number that is not finite and above 0.
pub(crate) fn positive(name: &'static str, found: f64) -> Result<(), TermsError> {
    if found > 0.0 && found.is_finite() {
        return Ok(());
    }
    let expected = "finite and above 0".to_owned();
    Err(TermsError::Number { name, expected, found })
}
