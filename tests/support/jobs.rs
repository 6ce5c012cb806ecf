//! Jobs of more than one test.

use platewash_bodies::job::WashJob;
use platewash_fixtures::{kitchen, kitchen_plate};
use platewash_workcell::job::{JobTerms, Overlap, Planner, PlannerSettings};

/// The kitchen with other terms.
pub fn job(change: impl FnOnce(&mut JobTerms, &mut PlannerSettings)) -> WashJob {
    let kitchen = kitchen();
    let mut terms = kitchen.terms().clone();
    let mut settings = *terms.planner_settings().unwrap();
    change(&mut terms, &mut settings);
    terms.planner = Planner::Wash(settings);
    WashJob::new(kitchen.shared_arm(), terms).unwrap()
}

/// It with plates elsewhere, over each other too; `relocate`: whether the job asks for other places.
pub fn on(places: &[[f64; 2]], relocate: bool) -> WashJob {
    job(|terms, settings| {
        terms.plates = places.iter().copied().map(kitchen_plate).collect();
        terms.requirements.overlap = Overlap::Report;
        settings.relocate = relocate;
    })
}
