//! The chance that a plate can be washed, told in milliseconds: a guess to show while somebody thinks.

use super::blocked::is_blocked;
use super::conclusion::is_beyond_reach;
use super::task::Task;
use super::washing::by_policy;
use crate::scene::Width;
use platewash_workcell::cancel::Cancelled;
use serde::Serialize;

/// The chance that a plate can be washed whole: nothing is planned, nothing proved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Chance {
    /// A policy of tilts washes it from end to end. How the arm gets there and away was not looked at.
    Washable,
    /// No policy washes it, and a search along the wash path finds nothing: some contact point is beyond the lengths of the links, or
    /// without a configuration at any tilt that the search would try. Whether that proves anything,
    /// [`Conclusion`](super::Conclusion) tells.
    Unwashable,
    /// Neither: a search may find a way.
    Unclear,
}

/// The chance of a plate, where branches are searched for on those found from nearby.
///
/// # Errors
/// [`Cancelled`].
pub fn chance(task: &Task<'_>) -> Result<Chance, Cancelled> {
    let mut contacts = task.samples.contact.iter();
    if contacts.any(|contact| is_beyond_reach(task, &contact.point)) {
        return Ok(Chance::Unwashable);
    }
    if by_policy(task, Width::Near)?.is_some() {
        return Ok(Chance::Washable);
    }
    Ok(if is_blocked(task)? {
        Chance::Unwashable
    } else {
        Chance::Unclear
    })
}
