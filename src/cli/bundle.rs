//! The bundle that all pages share, where this program was built with it.

use super::failure::Failure;
use super::output;
use anyhow::anyhow;
use platewash::viewer::bundle::Bundle;

/// What is wrong without a bundle, and what to do.
const MISSING: &str = "this program was built without it; `cargo xtask page` in its sources makes it, then build again";

/// The bundle; none where there is none, which a line on standard error explains, even where quiet was asked for: a file is missing.
pub fn bundle() -> Option<Bundle> {
    let found = Bundle::embedded();
    if found.is_none() {
        output::message(false, &format!("no page: {MISSING}"));
    }
    found
}

/// The bundle, for a verb that can do nothing without it.
pub fn needed() -> Result<Bundle, Failure> {
    Bundle::embedded().ok_or_else(|| Failure::internal(anyhow!("there is no page to show: {MISSING}")))
}
