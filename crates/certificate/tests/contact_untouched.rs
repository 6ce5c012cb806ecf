//! Faces of which hardly anything is washed: an untouched area does not count, also if contact begins with no compression at all, and if
//! there are no contact requirements.

use crate::contact::{disc, spiral, washed};
use crate::foundation::raster;
use crate::maker::{Recipe, irb120};
use platewash_certificate::{Requirement, Status, prove};
use platewash_workcell::surface::{Knot, Surface};

/// Returns a disc and a face that is none, of which the sponge reaches the middle only.
fn recipes() -> [(&'static str, Recipe); 2] {
    let flat = disc(0.005, 0.0, spiral(0.01, 0.5));
    let knots = [(0.055, 0.0), (0.075, 22.0), (0.095, 22.0), (0.105, 6.0)];
    let knots = knots.map(|(radius_m, slope_deg): (f64, f64)| Knot {
        radius_m,
        slope_rad: slope_deg.to_radians(),
    });
    let mut rim = washed(Surface::profile(&knots).unwrap(), [0.40, 0.03], [0.01, 0.03]);
    rim.curve = spiral(0.01, 0.5);
    [("flat", flat), ("rim", rim)]
}

#[test]
fn untouched_cells_are_not_in_contact_for_any_least_compression() {
    for (name, recipe) in recipes() {
        for (compression_m, error_m) in [(0.0, 0.0), (0.0, 1e-3), (1e-3, 1e-3)] {
            let mut plan = recipe.plan();
            let asked = plan.job.requirements.contact.as_mut().unwrap();
            (asked.compression_m, asked.height_error_m) = (compression_m, error_m);
            // Of any place that is in contact at all.
            (asked.time_s, asked.dose_pa_m) = (0.0, 0.0);
            let seen = raster(&plan);
            assert!(seen.contact < 0.3, "{name}: {seen:?}");
            let certificate = prove(&plan, &irb120()).unwrap();
            let found = &certificate.contact[0];
            let share = found.pressed.at_least;
            assert!(
                share <= seen.contact + 1e-4 && share >= seen.contact - 1.2e-2,
                "{name}, {compression_m}: {share} proved, {seen:?}"
            );
            let check = certificate.check(Requirement::Pressed).unwrap();
            assert_ne!(check.status, Status::Proved, "{name}: {check:?}");
        }
    }
}

#[test]
fn untouched_cells_are_not_swept_where_no_contact_is_required() {
    for (name, recipe) in recipes() {
        let mut plan = recipe.plan();
        plan.job.requirements.coverage = 0.995;
        let seen = raster(&plan);
        plan.job.requirements.contact = None;
        let certificate = prove(&plan, &irb120()).unwrap();
        let share = certificate.swept[0].at_least;
        assert!(
            share <= seen.touched + 1e-4 && share >= seen.touched - 1.2e-2 && seen.touched < 0.3,
            "{name}: {share} proved, {} seen",
            seen.touched
        );
        let check = certificate.check(Requirement::Swept).unwrap();
        assert_ne!(check.status, Status::Proved, "{name}: {check:?}");
    }
}
