//! Jobs of shipped scenarios, and homes that are suggested where none is stated.

use platewash_fixtures as fixtures;
use platewash_paper::PaperSettings;
use platewash_planner::Watch;
use platewash_planner::suggest::suggest_home;
use platewash_scenario::{Note, Scenario};
use platewash_workcell::cancel::CancelToken;
use std::time::Duration;

#[test]
fn the_kitchen_fixture_equals_the_shipped_scenario() {
    for (name, fixture) in [
        ("kitchen-spiral", fixtures::kitchen()),
        ("kitchen", fixtures::contact_kitchen()),
    ] {
        let job = Scenario::load(name).unwrap().job().unwrap();
        assert_eq!(job.terms(), fixture.terms(), "{name}");
        assert_eq!(job.name(), name);
    }
}

#[test]
fn the_papers_own_settings_are_those_of_its_scenarios() {
    for (name, settings) in [
        ("paper-appendix", PaperSettings::appendix()),
        ("paper-text", PaperSettings::text()),
    ] {
        let job = Scenario::load(name).unwrap().paper_job().unwrap();
        assert_eq!(job.settings, settings, "{name}");
    }
}

#[test]
fn a_tip_that_hovers_washes_nothing() {
    let mut scenario = Scenario::load("kitchen").unwrap();
    scenario.wash.height_m = 0.01;
    let failure = scenario.job().unwrap_err();
    assert!(failure.to_string().starts_with("wash.height_m must be 0"), "{failure}");
}

#[test]
fn a_job_without_a_home_uses_and_reports_the_suggested_one() {
    let mut scenario = Scenario::load("kitchen").unwrap();
    scenario.robot.start_deg = None;
    assert_eq!(scenario.validate(), Ok(()));
    assert!(
        matches!(scenario.notes()[..], [Note::HomeLeftOpen]),
        "{:?}",
        scenario.notes()
    );
    let job = scenario.job().unwrap();
    let found = suggest_home(job.arm(), job.terms(), &CancelToken::new()).unwrap();
    assert_eq!(job.terms().home_rad, [found.q_rad(); 2]);
    scenario.robot.home_deg = Some([0.0, 0.0, 0.0, 0.0, 90.0, 0.0]);
    let [start, end] = scenario.job().unwrap().terms().home_rad;
    assert_eq!((start, end[4]), (found.q_rad(), 90_f64.to_radians()));
}

#[test]
fn the_papers_program_starts_at_0_where_nothing_is_stated() {
    let mut scenario = Scenario::load("paper-text").unwrap();
    scenario.robot.start_deg = None;
    assert_eq!(scenario.notes(), []);
    assert_eq!(scenario.paper_job().unwrap().start_rad.amax(), 0.0);
}

#[test]
fn suggested_homes_are_accepted() {
    let (scenario, cancel) = (Scenario::load("angled-tool").unwrap(), CancelToken::new());
    let arm = scenario.arm().unwrap();
    let suggestion = scenario
        .suggest(&arm, Duration::from_secs(600), &Watch::silent(&cancel))
        .unwrap();
    let sector = suggestion.region.sector.unwrap();
    let mut like = scenario.clone();
    like.robot.start_deg = Some(suggestion.home.q_deg);
    like.layout.region = None;
    (like.layout.rho_m, like.layout.azimuth_deg) = (Some(sector.rho_m), Some(sector.azimuth_deg));
    like.layout.count = 2;
    platewash_planner::plan(&like.job().unwrap()).unwrap();
}
