//! The suggested sector alone.

use platewash_fixtures::{kitchen, kitchen_plate};
use platewash_planner::suggest::{Sector, suggest_sector};
use platewash_planner::{Watch, plan_here};
use platewash_workcell::cancel::CancelToken;

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
        plan_here(&job.on_plates(plates).unwrap(), &watch).unwrap();
    }
}
