//! A part of a ring about axis 1 in which a plate can be washed, found from places on a few rays: quicker than a map.

use crate::error::PlanError;
use crate::pipeline::with_moved_plate;
use crate::redundancy::places::MovedPlate;
use crate::suggest::region::Sector;
use crate::washable_map::MapArea;
use crate::watch::Watch;
use platewash_bodies::job::WashJob;
use platewash_kinematics::trig::{atan2, sin_cos};
use std::ops::Range;

/// Steps along a ray, across the reach.
const STEPS: usize = 24;
/// Steps to each side of the first ray, and the angle of one \[deg\].
const TURNS: usize = 11;
const TURN_DEG: f64 = 15.0;
/// Width of a sector for which no shorter row is tried \[deg\].
const WIDE_DEG: f64 = 120.0;
/// More clearance than is asked for \[m\], so that transits find a way, too; none where no places have as much.
const SPARE_M: f64 = 2e-3;

/// Looks for a sector in which the first plate of a job could be washed from its home, were it alone: the row of places on the ray through
/// the plate whose ring is the largest, and the turn about axis 1 to each side within which the ends and the middle of that row are
/// washed; where that is narrow, a shorter row whose sector is larger. `None` where no two places in a row are washed. An estimate: only
/// these places are checked, and transits are not.
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
    let ray: Vec<_> = steps.iter().map(|&rho_m| at(rho_m, ahead_deg)).collect();
    with_moved_plate(&alone, 0, watch, |pipeline, asked| {
        let washable = |centres: &[[f64; 2]], spare_m: f64| {
            let clearance_m = asked.clearance_m + spare_m;
            pipeline.suitable_centres(&MovedPlate { clearance_m, ..*asked }, centres)
        };
        let (row, spare_m) = match widest_row(&washable(&ray, SPARE_M)?) {
            Some(row) => (row, SPARE_M),
            None => match widest_row(&washable(&ray, 0.0)?) {
                Some(row) => (row, 0.0),
                None => return Ok(None),
            },
        };
        let turned = |row: &Range<usize>| {
            let rho_m = [steps[row.start], steps[row.end - 1]];
            let ends = [rho_m[0], 0.5 * (rho_m[0] + rho_m[1]), rho_m[1]];
            let mut azimuth_deg = [ahead_deg; 2];
            for (end, side) in azimuth_deg.iter_mut().zip([-1.0, 1.0]) {
                let turn = |k: usize| ahead_deg + side * TURN_DEG * k as f64;
                let places: Vec<_> = (1..=TURNS).flat_map(|k| ends.map(|rho_m| at(rho_m, turn(k)))).collect();
                let answers = washable(&places, spare_m)?;
                let all = answers.chunks(ends.len()).take_while(|all| all.iter().all(|&one| one));
                *end = turn(all.count());
            }
            Ok::<_, PlanError>(Sector { rho_m, azimuth_deg })
        };
        let mut found = turned(&row)?;
        // Places at the ends of the row may be washed on the first ray alone.
        for ends in 1..row.len().div_ceil(2) {
            if width_deg(&found) >= WIDE_DEG {
                break;
            }
            let shorter = turned(&(row.start + ends..row.end - ends))?;
            if area_m2(&shorter) > area_m2(&found) {
                found = shorter;
            }
        }
        Ok(Some(found))
    })
}

fn width_deg(sector: &Sector) -> f64 {
    sector.azimuth_deg[1] - sector.azimuth_deg[0]
}

/// Area of a sector \[m²\].
fn area_m2(sector: &Sector) -> f64 {
    let [near_m, far_m] = sector.rho_m;
    0.5 * (far_m * far_m - near_m * near_m) * width_deg(sector).to_radians()
}

/// The row of at least two, in steps from the axis, whose ring has the greatest area; of equals the first.
fn widest_row(answers: &[bool]) -> Option<Range<usize>> {
    let starts = (0..answers.len()).filter(|&k| answers[k] && (k == 0 || !answers[k - 1]));
    let rows = starts.map(|start| start..start + answers[start..].iter().take_while(|&&one| one).count());
    let area = |row: &Range<usize>| row.end * row.end - (row.start + 1) * (row.start + 1);
    rows.rev().max_by_key(area).filter(|row| row.len() > 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_all_rows_the_one_with_the_largest_ring_is_found() {
        let row = |text: &str| widest_row(&text.chars().map(|c| c == '1').collect::<Vec<_>>());
        assert_eq!(row("0110111011"), Some(4..7));
        assert_eq!(row("0111000000000011"), Some(14..16));
        assert_eq!(row("11"), Some(0..2));
        assert_eq!(row("01010"), None);
        assert_eq!(row(""), None);
    }
}
