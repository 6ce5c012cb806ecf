//! What a wash falls short of.

use platewash_kinematics::words::told_apart;
use serde::Serialize;
use std::fmt;

/// A promise about contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Promised {
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
    /// Which one.
    pub promised: Promised,
    /// What was found: a force \[N\], or a share.
    pub found: f64,
    /// What is required.
    pub required: f64,
}

impl fmt::Display for Shortfall {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (scale, unit) = match self.promised {
            Promised::LeastForce | Promised::GreatestForce => (1.0, "N"),
            _ => (100.0, "%"),
        };
        let [found, required] = told_apart(scale * self.found, scale * self.required, 1);
        match self.promised {
            Promised::Strain => write!(
                f,
                "the sponge is compressed by up to {found} {unit} of its height, {required} {unit} are allowed"
            ),
            Promised::GreatestForce => write!(
                f,
                "the sponge presses with up to {found} {unit}, {required} {unit} are allowed"
            ),
            Promised::LeastForce => write!(
                f,
                "the sponge presses with {found} {unit} at some moments, {required} {unit} are required"
            ),
            Promised::Pressed => write!(
                f,
                "{found} {unit} of the face are pressed, {required} {unit} are required"
            ),
            Promised::ContactTime => write!(
                f,
                "{found} {unit} of the face are pressed long enough, {required} {unit} are required"
            ),
            Promised::ContactDose => write!(
                f,
                "{found} {unit} of the face get the dose, {required} {unit} are required"
            ),
        }
    }
}
