//! Certified jobs: planned, proved, and refused with a reason.

use platewash::certificate::{Certificate, Requirement};
use platewash::paper::PaperPart;
use platewash::planner::{Activity, PlannedJob, Watch, plan_with};
use platewash::study::{Outcome, Row};
use platewash::workcell::cancel::CancelToken;
use platewash::workcell::job::{OrderRule, Overlap};
use platewash::workcell::verdict::Infeasibility;
use platewash::{Failure, PlanError, Scenario, plan, prove};
use platewash_fixtures::is_thorough;
use rayon::prelude::*;
use std::ops::{ControlFlow, RangeInclusive};
use std::sync::Mutex;

fn planned(scenario: &Scenario) -> Result<PlannedJob, Failure> {
    Ok(plan(&scenario.job()?)?)
}

fn judged(scenario: &Scenario) -> (PlannedJob, Certificate) {
    let job = scenario.job().unwrap();
    let planned = plan(&job).unwrap();
    let certificate = prove(&planned.plan, job.arm()).unwrap();
    (planned, certificate)
}

/// A row of each seed.
pub fn rows(scenario: &Scenario, seeds: RangeInclusive<u64>) -> Result<Vec<Row>, Failure> {
    platewash::sweep(scenario, seeds, &CancelToken::new(), &mut |_| ControlFlow::Continue(()))
}

/// Seeds of which each has a layout of its own.
fn seeds() -> RangeInclusive<u64> {
    1..=if is_thorough() { 6 } else { 2 }
}

/// A layout of its own per seed, each proved with the figures that the scenarios promise.
#[test]
fn the_shipped_scenarios_are_proved() {
    for name in ["kitchen", "kitchen-spiral", "kitchen-roomy", "kitchen-rim", "sink"] {
        let all = rows(&Scenario::load(name).unwrap(), seeds()).unwrap();
        for row in all {
            assert_eq!(
                row.outcome,
                Outcome::Proved,
                "{name}, seed {}: {:?}",
                row.axes["seed"],
                row.reason
            );
            assert!(
                row.swept.unwrap() >= 0.995 && row.clearance_m.unwrap() >= 0.01,
                "{row:?}"
            );
        }
    }
}

/// The angle at which a spiral leaves the centre is judged within a turn of 0, whatever remains of its turns.
#[test]
fn proves_wash_paths_of_any_number_of_turns() {
    for turns in [2.7, 3.9, 4.85, 30.0] {
        let mut scenario = Scenario::load("kitchen-spiral").unwrap();
        scenario.wash.turns = Some(turns);
        for seed in if turns < 10.0 { 1..=3 } else { 1..=1 } {
            scenario.seed = seed;
            let (_, certificate) = judged(&scenario);
            let broken: Vec<_> = certificate.broken().collect();
            assert!(broken.is_empty(), "{turns} turns, seed {seed}: {broken:?}");
        }
    }
}

/// As many as may be asked for: what a proof may take grows with the motion.
#[test]
fn a_wash_of_many_turns_is_proved() {
    let mut scenario = Scenario::load("kitchen-spiral").unwrap();
    scenario.wash.turns = Some(125.0);
    scenario.layout.count = 1;
    let (planned, certificate) = judged(&scenario);
    let broken: Vec<_> = certificate.broken().collect();
    assert!(broken.is_empty(), "{broken:?}");
    // The knots grow with the turns and not faster: some 500 a turn at most.
    let knots = planned.plan.knots.t_s.len();
    assert!(knots < 125 * 500, "{knots} knots");
}

/// The paper's own spacing and base radius, with everything else done properly; plates that overlap are a finding.
#[test]
fn the_papers_spacing_is_washed_too() {
    let mut scenario = Scenario::load("kitchen-spiral").unwrap();
    scenario.layout.min_distance_m = 0.28;
    scenario.layout.base_radius_m = 0.25;
    scenario.layout.overlap = Overlap::Report;
    for region in PaperPart::ALL {
        scenario.layout.region = Some(region);
        for row in rows(&scenario, seeds()).unwrap() {
            assert_eq!(
                row.outcome,
                Outcome::Proved,
                "{region:?}, seed {}: {:?}",
                row.axes["seed"],
                row.reason
            );
        }
    }
}

fn explicit(positions: &[[f64; 2]]) -> Scenario {
    let mut scenario = Scenario::load("kitchen-spiral").unwrap();
    scenario.layout.positions_m = Some(positions.to_vec());
    scenario
}

#[test]
fn a_plate_out_of_reach_is_named_with_the_nearest_place_that_will_do() {
    let scenario = explicit(&[[0.40, 0.0], [0.1, 0.56]]);
    let error = planned(&scenario).unwrap_err();
    assert!(error.infeasibility().is_some());
    let Failure::Plan(PlanError::Unwashable(plate)) = &error else {
        panic!("{error}");
    };
    assert_eq!(plate.plate, 1);
    let share = plate.share.unwrap();
    assert!(share > 0.5 && share < 1.0);
    let message = error.to_string();
    assert!(
        message.contains("out of reach") && message.contains("nearest position"),
        "{message}"
    );
    // There it can be washed, and it is not far.
    let [x, y] = plate.nearest_m.unwrap();
    assert!((x - 0.1_f64).hypot(y - 0.56) < 0.12);
    planned(&explicit(&[[0.40, 0.0], [x, y]])).unwrap();
}

/// Whoever waits is told what is tried: configurations, what is in the way, other places and jobs there.
#[test]
fn an_infeasible_job_reports_its_attempts() {
    let heard = Mutex::new(Vec::new());
    let tell = |activity: &Activity| heard.lock().unwrap().push(*activity);
    let job = explicit(&[[0.40, 0.0], [0.1, 0.56]]).job().unwrap();
    let cancel = CancelToken::new();
    let watch = Watch {
        tell: &tell,
        cancel: &cancel,
    };
    let error = plan_with(&job, &watch).unwrap_err();
    assert_eq!(error, plan(&job).unwrap_err(), "who listens changes nothing");
    let heard = heard.into_inner().unwrap();
    let place = |wanted: &dyn Fn(&Activity) -> bool| heard.iter().position(wanted).unwrap();
    let wash = place(&|a| matches!(a, Activity::Wash { plate: 1, .. }));
    let cause = place(&|a| matches!(a, Activity::Cause { plate: 1 }));
    let first = place(&|a| matches!(a, Activity::Relocation { plate: 1, ring: 1, .. }));
    let trial = place(&|a| matches!(a, Activity::Trial { plate: 1, .. }));
    assert!(wash < cause && cause < first && first < trial, "{heard:?}");
    assert!(
        heard[first]
            .to_string()
            .contains("another place for plate 2: 0.02 m away"),
        "{}",
        heard[first]
    );
}

/// A line that is not clear is that of the configurations taken; out of reach is out of reach.
#[test]
fn distinguishes_proved_impossible_from_not_found() {
    let mut low = explicit(&[[0.40, 0.0]]);
    low.wash.lift_m = 0.005;
    let error = planned(&low).unwrap_err();
    assert_eq!(error.infeasibility(), Some(Infeasibility::NotFound), "{error}");
    let error = planned(&explicit(&[[0.8, 0.0]])).unwrap_err();
    assert_eq!(error.infeasibility(), Some(Infeasibility::Proved), "{error}");
}

/// Where no tilt at all is allowed, or next to none, the plan keeps to that.
#[test]
fn keeps_the_smallest_allowed_tilt() {
    for tilt_max_deg in [0.0, 0.01, 0.5] {
        let mut scenario = explicit(&[[0.40, 0.0]]);
        scenario.wash.tilt_max_deg = tilt_max_deg;
        let (_, certificate) = judged(&scenario);
        assert!(certificate.passes(), "{tilt_max_deg}°: {certificate}");
    }
}

#[test]
fn overlapping_plates_are_refused_unless_only_reported() {
    let mut scenario = explicit(&[[0.35, 0.10], [0.35, -0.15]]);
    scenario.layout.overlap = Overlap::Report;
    let (done, certificate) = judged(&scenario);
    assert!(certificate.passes() && certificate.broken().next().is_none());
    let apart = certificate.check(Requirement::PlatesApart).unwrap();
    assert!(!apart.discrepancies.is_empty());
    // What the certificate would not pass is not planned.
    let mut strict = done.plan.clone();
    strict.job.requirements.overlap = Overlap::Fail;
    let arm = scenario.arm().unwrap();
    let broken = platewash::certificate::prove(&strict, &arm).unwrap();
    assert_eq!(
        broken.check(Requirement::PlatesApart).unwrap().discrepancies,
        apart.discrepancies
    );
    scenario.layout.overlap = Overlap::Fail;
    let error = planned(&scenario).unwrap_err();
    assert_eq!(error.infeasibility(), Some(Infeasibility::Proved), "{error}");
    let message = error.to_string();
    assert!(message.contains("plate 1 and plate 2 overlap by 40.0 mm"), "{message}");
    assert!(message.contains("layout.overlap"), "{message}");
    assert_eq!(scenario.check().unwrap_err(), error);
}

#[test]
fn layouts_are_drawn_until_they_can_be_washed_where_the_scenario_asks() {
    let mut scenario = Scenario::load("kitchen-spiral").unwrap();
    scenario.layout.region = None;
    scenario.layout.rho_m = Some([0.40, 0.62]);
    scenario.layout.azimuth_deg = Some([-90.0, 90.0]);
    scenario.layout.count = 2;
    let proved = |scenario: &Scenario| {
        let all = rows(scenario, 1..=8).unwrap();
        all.iter().filter(|row| row.outcome == Outcome::Proved).count()
    };
    assert!(proved(&scenario) < 8);
    scenario.layout.only_washable = true;
    assert_eq!(proved(&scenario), 8);
    // Where nothing can be washed, it says so instead of drawing for ever.
    scenario.layout.rho_m = Some([0.61, 0.62]);
    scenario.layout.count = 1;
    let error = planned(&scenario).unwrap_err();
    assert!(
        error.infeasibility().is_some() && error.to_string().contains("only_washable"),
        "{error}"
    );
}

#[test]
fn the_best_order_is_no_slower_than_nearest_next() {
    for seed in seeds() {
        let mut scenario = Scenario {
            seed,
            ..Scenario::load("kitchen-spiral").unwrap()
        };
        let best = planned(&scenario).unwrap().tour;
        assert!(best.travel_s <= best.nearest_next_s + 1e-12);
        scenario.job.order = OrderRule::Nearest;
        let nearest = planned(&scenario).unwrap();
        assert_eq!(nearest.tour.travel_s, best.nearest_next_s);
        scenario.job.order = OrderRule::Given;
        assert_eq!(planned(&scenario).unwrap().plan.order, [0, 1, 2, 3]);
    }
}

#[test]
fn rejects_senseless_input_by_name() {
    let refused = |change: fn(&mut Scenario), word: &str| {
        let mut scenario = Scenario::load("kitchen-spiral").unwrap();
        change(&mut scenario);
        let error = planned(&scenario).unwrap_err();
        assert!(error.to_string().contains(word), "{error}");
        error.infeasibility().is_some()
    };
    assert!(!refused(|s| s.tool.length_m = 0.0, "tool.length_m"));
    assert!(!refused(
        |s| s.robot.home_deg = Some([0.0, 200.0, 0.0, 0.0, 0.0, 0.0]),
        "robot.home_deg: joint 2"
    ));
    assert!(!refused(
        |s| s.robot.start_deg = Some([180.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        "robot.start_deg: joint 1"
    ));
    assert!(!refused(|s| s.wash.tilt_max_deg = f64::NAN, "tilt_max_deg"));
    assert!(!refused(|s| s.wash.speed_m_s = 0.0, "speed_m_s"));
    // Home with the tool in the floor.
    assert!(refused(
        |s| s.robot.start_deg = Some([0.0, 90.0, 0.0, 0.0, 0.0, 0.0]),
        "home"
    ));
    // More than the arm keeps from its own tool at home, which is looked at first.
    assert!(refused(|s| s.wash.clearance_m = 0.2, "201.00 mm must be kept"));
}

/// A job without a promise about contact that leaves the pattern open: however large the plates, what is chosen sweeps the share required.
#[test]
fn chosen_patterns_sweep_plates_of_any_size() {
    let radii = [0.05, 0.06, 0.07, 0.08, 0.09, 0.1, 0.11, 0.12, 0.13, 0.145];
    let swept: Vec<_> = radii
        .into_par_iter()
        .map(|radius_m| {
            let mut scenario = Scenario::load("kitchen-spiral").unwrap();
            scenario.layout.plate_radius_m = Some(radius_m);
            scenario.layout.positions_m = Some(vec![[0.35, 0.1]]);
            scenario.layout.region = None;
            (
                scenario.wash.path_radius_m,
                scenario.wash.turns,
                scenario.wash.closing_ring,
            ) = (None, None, None);
            let (_, certificate) = judged(&scenario);
            (radius_m, certificate.passes(), certificate.headline)
        })
        .collect();
    let not: Vec<_> = swept.iter().filter(|(_, passes, _)| !passes).collect();
    assert!(not.is_empty(), "{not:?}");
}
