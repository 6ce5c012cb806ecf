//! The suggested region and its sector.

use platewash_fixtures::{kitchen, kitchen_plate};
use platewash_planner::suggest::suggest_region;
use platewash_planner::{Watch, plan_here};
use platewash_workcell::cancel::CancelToken;

/// Planning washes plates in the sector: four places on its border and one within.
#[test]
fn plates_in_the_sector_are_washed() {
    let (job, cancel) = (kitchen(), CancelToken::new());
    let region = suggest_region(&job, &Watch::silent(&cancel)).unwrap();
    let sector = region.sector.unwrap();
    let [near, far] = sector.rho_m;
    let [from, to] = sector.azimuth_deg;
    assert!(far - near > 0.05 && to - from > 60.0, "{sector:?}");
    let places = [
        (near, from),
        (near, to),
        (far, from),
        (far, to),
        (0.5 * (near + far), 0.5 * (from + to)),
    ];
    let washed = places.iter().filter(|(rho, azimuth)| {
        let (s, c) = azimuth.to_radians().sin_cos();
        let plate = kitchen_plate([rho * c, rho * s]);
        plan_here(&job.on_plates(vec![plate]).unwrap(), &Watch::silent(&cancel)).is_ok()
    });
    assert_eq!(washed.count(), places.len(), "{sector:?}");
}
