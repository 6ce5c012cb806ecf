//! A part of a ring about axis 1 in which a plate can be washed, found from places on a few rays: quicker than a map.

use crate::error::PlanError;
use crate::pipeline::washable_centres;
use crate::suggest::region::Sector;
use crate::trig::{atan2, sin_cos};
use crate::washable_map::MapArea;
use crate::watch::Watch;
use platewash_workcell::job::WashJob;

/// Steps along a ray, across the reach.
const STEPS: usize = 24;
/// Steps to each side of the first ray, and the angle of one \[deg\].
const TURNS: usize = 11;
const TURN_DEG: f64 = 15.0;

/// Looks for a sector in which the first plate of a job could be washed from its home, were it alone: the longest row of places on the ray
/// through the plate, and the turn about axis 1 to each side within which the ends and the middle of that row are washed. `None` where no
/// two places in a row are. An estimate: only these places are checked, and transits are not.
///
/// # Errors
/// [`PlanError`] of the input, and [`PlanError::Cancelled`].
pub fn suggest_sector(job: &WashJob, watch: &Watch<'_>) -> Result<Option<Sector>, PlanError> {
    let alone = job.on_plates(job.terms().plates.iter().take(1).copied().collect())?;
    let area = MapArea::within_reach(&alone, 0)?;
    let [x, y] = area.centre_m;
    let [towards_x, towards_y] = alone.terms().plates[0].centre_xy();
    let ahead_deg = atan2(towards_y - y, towards_x - x).to_degrees().round();
    let at = |rho_m: f64, azimuth_deg: f64| {
        let (s, c) = sin_cos(azimuth_deg.to_radians());
        [x + rho_m * c, y + rho_m * s]
    };
    let steps: Vec<f64> = (1..=STEPS).map(|k| area.radius_m * k as f64 / STEPS as f64).collect();
    let places: Vec<_> = steps.iter().map(|&rho_m| at(rho_m, ahead_deg)).collect();
    let answers = washable_centres(&alone, 0, &places, watch)?;
    let Some(row) = longest_row(&answers) else {
        return Ok(None);
    };
    let rho_m = [steps[row.start], steps[row.end - 1]];
    let ends = [rho_m[0], 0.5 * (rho_m[0] + rho_m[1]), rho_m[1]];
    let mut azimuth_deg = [ahead_deg; 2];
    for (end, side) in azimuth_deg.iter_mut().zip([-1.0, 1.0]) {
        let turn = |k: usize| ahead_deg + side * TURN_DEG * k as f64;
        let places: Vec<_> = (1..=TURNS).flat_map(|k| ends.map(|rho_m| at(rho_m, turn(k)))).collect();
        let answers = washable_centres(&alone, 0, &places, watch)?;
        let all = answers.chunks(ends.len()).take_while(|all| all.iter().all(|&one| one));
        *end = turn(all.count());
    }
    Ok(Some(Sector { rho_m, azimuth_deg }))
}

/// The longest row of at least two; of equals the first.
fn longest_row(answers: &[bool]) -> Option<std::ops::Range<usize>> {
    let starts = (0..answers.len()).filter(|&k| answers[k] && (k == 0 || !answers[k - 1]));
    let rows = starts.map(|start| start..start + answers[start..].iter().take_while(|&&one| one).count());
    rows.rev()
        .max_by_key(ExactSizeIterator::len)
        .filter(|row| row.len() > 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use platewash_workcell::cancel::CancelToken;
    use platewash_workcell::fixtures::{kitchen, kitchen_plate};

    #[test]
    fn the_longest_row_is_found() {
        let row = |text: &str| longest_row(&text.chars().map(|c| c == '1').collect::<Vec<_>>());
        assert_eq!(row("0110111011"), Some(4..7));
        assert_eq!(row("0110011"), Some(1..3));
        assert_eq!(row("11"), Some(0..2));
        assert_eq!(row("01010"), None);
        assert_eq!(row(""), None);
    }

    /// Planning washes plates on the corners of the sector and in its middle.
    #[test]
    fn plates_in_the_sector_are_washed() {
        let (job, cancel) = (kitchen(), CancelToken::new());
        let watch = Watch::silent(&cancel);
        let Sector { rho_m, azimuth_deg } = suggest_sector(&job, &watch).unwrap().unwrap();
        let [near, far] = rho_m;
        let [from, to] = azimuth_deg;
        assert!(far - near > 0.05 && to - from > 60.0, "{rho_m:?} {azimuth_deg:?}");
        for (rho, azimuth) in [
            (near, from),
            (near, to),
            (far, from),
            (far, to),
            (0.5 * (near + far), 0.5 * (from + to)),
        ] {
            let (s, c) = azimuth.to_radians().sin_cos();
            let plates = vec![kitchen_plate([rho * c, rho * s])];
            crate::plan_here(&job.on_plates(plates).unwrap(), &watch).unwrap();
        }
    }
}
