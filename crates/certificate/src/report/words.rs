//! Formatting of numbers in a certificate.
//!
//! Plates in words: shape, height and position.

use crate::report::check::{Measure, Sense};
use crate::report::unit::Unit;
use platewash_kinematics::words::{decimals_down, decimals_up, percent, rounded};
use platewash_workcell::job::Soil;
use platewash_workcell::plate::Plate;
use platewash_workcell::words::plate_number;

/// Greatest number of significant digits of a number.
const DIGITS: usize = 9;

/// Formats a length in millimetres with as few digits as possible.
pub(crate) fn mm(length_m: f64) -> String {
    number(1e3 * length_m)
}

/// Formats a number with as few digits as possible, up to nine.
pub(crate) fn number(value: f64) -> String {
    // A negative zero is 0.
    let told = rounded(value, DIGITS) + 0.0;
    if told == 0.0 || (1e-6..=1e6).contains(&told.abs()) {
        told.to_string()
    } else {
        format!("{told:e}")
    }
}

/// Formats numbers separated by commas.
pub(crate) fn list(numbers: impl IntoIterator<Item = f64>) -> String {
    let each: Vec<_> = numbers.into_iter().map(number).collect();
    each.join(", ")
}

/// Number of decimals from which on a bound and its limit count as the same number.
const MOST_DECIMALS: usize = 9;

impl Unit {
    /// Returns the factor and the unit in which a quantity is shown.
    #[must_use]
    pub fn scale(self) -> (f64, &'static str) {
        match self {
            Self::Radian => (180.0 / std::f64::consts::PI, "°"),
            Self::RadianPerSecond => (1.0, "rad/s"),
            Self::RadianPerSecondSquared => (1.0, "rad/s²"),
            Self::Metre => (1e3, "mm"),
            Self::MetrePerSecond => (1.0, "m/s"),
            Self::MetrePerSecondSquared => (1.0, "m/s²"),
            Self::Newton => (1.0, "N"),
            Self::NewtonMetre => (1.0, "N·m"),
            Self::Share => (100.0, "%"),
        }
    }
}

/// Number of decimals of a quantity in a table.
pub(crate) fn decimals(unit: Unit) -> usize {
    match unit {
        Unit::Share => 1,
        _ => 4,
    }
}

/// Formats the bound of a measure that keeps its limit, in its unit. A share that is less than whole only by rounding reads 100.
pub(crate) fn rounded_bound(measure: &Measure, bound: f64, decimals: usize) -> String {
    if measure.unit == Unit::Share && measure.sense == Sense::AtLeast && bound >= 1.0 - 1e-9 {
        return percent(bound);
    }
    let (scale, _) = measure.unit.scale();
    toward_limit(bound * scale, measure.limit * scale, measure.sense, decimals)
}

/// Formats a bound that keeps its limit. It is rounded towards the limit, so that no more is said than is proved, with `decimals` decimals
/// or as many more as it takes to keep the limit after rounding.
fn toward_limit(bound: f64, limit: f64, sense: Sense, decimals: usize) -> String {
    let told = |decimals| match sense {
        Sense::AtMost => decimals_up(bound, decimals),
        Sense::AtLeast | Sense::Above => decimals_down(bound, decimals),
    };
    let keeps = |told: &String| {
        let read = told.parse::<f64>().unwrap_or(f64::NAN);
        if sense == Sense::AtMost {
            read <= limit
        } else {
            read >= limit
        }
    };
    let shown = (decimals..=MOST_DECIMALS).map(told).find(keeps);
    shown.unwrap_or_else(|| number(limit))
}

/// Number of plates whose positions are listed in words. The JSON has all.
const PLACES: usize = 12;

/// Formats sizes and heights of all plates, and the positions of the first ones.
pub(crate) fn plates(plates: &[Plate], soils: &[Soil]) -> String {
    let mut alike: Vec<(String, Vec<usize>)> = Vec::new();
    for (i, plate) in plates.iter().enumerate() {
        let size = size(plate, soils);
        match alike.iter_mut().find(|(other, _)| *other == size) {
            Some((_, those)) => those.push(i),
            None => alike.push((size, vec![i])),
        }
    }
    let groups: Vec<_> = alike
        .iter()
        .map(|(size, those)| format!("{} {size}{}", those.len(), places(plates, those)))
        .collect();
    match &groups[..] {
        [one] => one.clone(),
        all => format!("{}: {}", plates.len(), all.join("; ")),
    }
}

/// Formats the positions of some plates, as far as they are among the first ones.
fn places(plates: &[Plate], those: &[usize]) -> String {
    let first = those.iter().filter(|i| **i < PLACES);
    let told: Vec<_> = first
        .map(|i| format!("{} at ({})", plate_number(*i), list(plates[*i].centre_xy())))
        .collect();
    match those.len() - told.len() {
        _ if told.is_empty() => String::new(),
        0 => format!(": {} m", told.join(", ")),
        more => format!(": {} m and {more} more", told.join(", ")),
    }
}

/// Formats shape, height and tilt of a plate, without the tilt of a level one. For a profile the height is that of the pole.
fn size(plate: &Plate, soils: &[Soil]) -> String {
    let (rim, thick, height) = (mm(plate.rim_m()), mm(plate.thickness_m), mm(plate.centre().z));
    let size = match plate.surface.profile_words() {
        None => format!("of radius {rim} mm, {thick} mm thick, faces {height} mm above 0"),
        Some(profile) => format!("of radius {rim} mm, {profile}, {thick} mm thick, poles {height} mm above 0"),
    };
    let foot = plate.foot.map_or_else(String::new, |foot| {
        format!(
            ", on a foot of radius {} mm, {} mm high",
            mm(foot.radius_m),
            mm(foot.height_m)
        )
    });
    size + &foot
        + &plate
            .tilt_words()
            .map_or_else(String::new, |tilted| format!(", {tilted}"))
        + &plate
            .terms_words(soils)
            .map_or_else(String::new, |own| format!(" ({own})"))
}
