//! Plates in words: of what shape they are, how high they lie, and where.

use crate::amounts::{list, mm};
use platewash_workcell::plate::Plate;

/// Plates whose places are listed in words; the JSON has them all.
const PLACES: usize = 12;

/// Sizes and heights of all, and the places of the first ones.
pub(crate) fn plates(plates: &[Plate]) -> String {
    let mut alike: Vec<(String, Vec<usize>)> = Vec::new();
    for (i, plate) in plates.iter().enumerate() {
        let size = size(plate);
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

/// Where some of the plates are, as far as they are among the first ones.
fn places(plates: &[Plate], those: &[usize]) -> String {
    let first = those.iter().filter(|i| **i < PLACES);
    let told: Vec<_> = first
        .map(|i| format!("{i} at ({})", list(plates[*i].centre_xy())))
        .collect();
    match those.len() - told.len() {
        _ if told.is_empty() => String::new(),
        0 => format!(": {} m", told.join(", ")),
        more => format!(": {} m and {more} more", told.join(", ")),
    }
}

/// Shape, height and, where it does not lie level, tilt: a flat face has one height, of a profile the pole's is told.
fn size(plate: &Plate) -> String {
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
}
