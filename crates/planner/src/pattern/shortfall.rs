//! Shortfall of a wash against its promise.

use platewash_kinematics::words::distinct_decimals;
use serde::Serialize;
use std::fmt;

/// A promise about contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ContactPromise {
    /// The greatest strain of the sponge.
    Strain,
    /// The least force of contact.
    LeastForce,
    /// The greatest force of contact.
    GreatestForce,
    /// The share of the face that is pressed.
    Pressed,
    /// The share of the face that is pressed long enough.
    ContactTime,
    /// The share of the face that gets the dose.
    ContactDose,
}

/// A promise that a wash does not keep, as it is seen at the configurations along it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Shortfall {
    /// The promise that is not kept.
    pub promised: ContactPromise,
    /// Value found: a force \[N\], or a share.
    pub found: f64,
    /// Value required.
    pub required: f64,
}

impl fmt::Display for Shortfall {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (scale, unit) = match self.promised {
            ContactPromise::LeastForce | ContactPromise::GreatestForce => (1.0, "N"),
            _ => (100.0, "%"),
        };
        if !self.found.is_finite() {
            return f.write_str(
                "no bound was found on how the sponge is pressed, as the face bends too sharply somewhere under it; a profile without that bend, such \
                 as one that ends before a rim that rolls off, may do",
            );
        }
        let [found, required] = distinct_decimals(scale * self.found, scale * self.required, 1);
        let [before, after, verdict] = match self.promised {
            ContactPromise::Strain => ["the sponge is compressed by up to ", " of its height", "allowed"],
            ContactPromise::GreatestForce => ["the sponge presses with up to ", "", "allowed"],
            ContactPromise::LeastForce => ["the sponge presses with ", " at some moments", "required"],
            ContactPromise::Pressed => ["", " of the face are pressed", "required"],
            ContactPromise::ContactTime => ["", " of the face are pressed long enough", "required"],
            ContactPromise::ContactDose => ["", " of the face get the dose", "required"],
        };
        write!(f, "{before}{found} {unit}{after}, {required} {unit} are {verdict}")
    }
}
