//! Units of measures.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// Unit of a measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, TS)]
pub enum Unit {
    /// Radians.
    #[serde(rename = "rad")]
    Radian,
    /// Radians per second.
    #[serde(rename = "rad/s")]
    RadianPerSecond,
    /// Radians per second squared.
    #[serde(rename = "rad/s^2")]
    RadianPerSecondSquared,
    /// Metres.
    #[serde(rename = "m")]
    Metre,
    /// Metres per second.
    #[serde(rename = "m/s")]
    MetrePerSecond,
    /// Metres per second squared.
    #[serde(rename = "m/s^2")]
    MetrePerSecondSquared,
    /// Newtons.
    #[serde(rename = "N")]
    Newton,
    /// Newton metres.
    #[serde(rename = "N m")]
    NewtonMetre,
    /// Share of one.
    #[serde(rename = "1")]
    Share,
}
