//! Jobs that are not planned: what is said of them, and how soon planning is given up.

use crate::SOON;
use crate::jobs::{job, on};
use platewash_bodies::job::{End, WashJob};
use platewash_fixtures::{kitchen, kitchen_plate};
use platewash_planner::{
    Activity, InfeasibleReport, OutOfRange, PlaceSearch, PlanError, Watch, check, draw_washable_layout, plan, plan_with,
};
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::Planner;
use platewash_workcell::layout::{Layout, LayoutError, LayoutSource};
use platewash_workcell::tool::{StraightTool, Tool};
use platewash_workcell::verdict::{Infeasibility, Verdict};
use std::sync::Mutex;
use std::time::Instant;

#[test]
fn a_plate_out_of_reach_is_named_with_the_nearest_place_that_will_do() {
    let error = plan(&on(&[[0.40, 0.0], [0.1, 0.56]], true)).unwrap_err();
    let PlanError::Unwashable(plate) = &error else {
        panic!("{error}");
    };
    assert_eq!((plate.plate, plate.place_search), (1, PlaceSearch::Within(0.6)));
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
    plan(&on(&[[0.40, 0.0], [x, y]], false)).unwrap();
    let report = InfeasibleReport::new("two plates", 1, &error).unwrap();
    assert_eq!(report.plates[0].nearest_m, Some([x, y]));
    assert_eq!(report.explained("short".to_owned()).headline, "INFEASIBLE: short");
}

#[test]
fn searches_other_positions_only_on_request() {
    let error = plan(&on(&[[0.40, 0.0], [0.1, 0.56]], false)).unwrap_err();
    let PlanError::Unwashable(plate) = &error else {
        panic!("{error}");
    };
    assert_eq!((plate.nearest_m, plate.place_search), (None, PlaceSearch::Off));
    assert!(
        error.to_string().ends_with("no other position was looked for"),
        "{error}"
    );
}

/// Whoever waits is told what is tried: washings, what is in the way, other places and jobs there.
#[test]
fn an_infeasible_job_reports_its_attempts() {
    let heard = Mutex::new(Vec::new());
    let listener = |activity: &Activity| heard.lock().unwrap().push(*activity);
    let cancel = CancelToken::new();
    let watch = Watch {
        tell: &listener,
        cancel: &cancel,
    };
    let job = on(&[[0.40, 0.0], [0.1, 0.56]], true);
    let error = plan_with(&job, &watch).unwrap_err();
    assert_eq!(error, plan(&job).unwrap_err(), "who listens changes nothing");
    let heard = heard.into_inner().unwrap();
    let place = |wanted: &dyn Fn(&Activity) -> bool| heard.iter().position(wanted).unwrap();
    let wash = place(&|a| matches!(a, Activity::Wash { plate: 1, .. }));
    let cause = place(&|a| matches!(a, Activity::Cause { plate: 1 }));
    let first = place(&|a| matches!(a, Activity::Relocation { plate: 1, ring: 1, .. }));
    let trial = place(&|a| matches!(a, Activity::Trial { plate: 1, .. }));
    assert!(wash < cause && cause < first && first < trial, "{heard:?}");
    let said = heard[first].to_string();
    assert!(said.contains("another place for plate 2: 0.02 m away"), "{said}");
}

/// A line that is not clear is that of the configurations taken; out of reach is out of reach.
#[test]
fn distinguishes_proved_impossible_from_not_found() {
    let low = job(|terms, settings| {
        terms.plates = vec![kitchen_plate([0.40, 0.0])];
        settings.lift_m = 0.005;
    });
    let error = plan(&low).unwrap_err();
    assert_eq!(error.infeasibility(), Some(Infeasibility::NotFound), "{error}");
    let report = InfeasibleReport::new("low", 1, &error).unwrap();
    assert_eq!((report.verdict, report.plates.len()), (Verdict::NotFound, 1));
    let error = plan(&on(&[[0.8, 0.0]], false)).unwrap_err();
    assert_eq!(error.infeasibility(), Some(Infeasibility::Proved), "{error}");
}

#[test]
fn rejects_impossible_jobs_before_any_search() {
    assert_eq!(check(kitchen().arm(), kitchen().terms()), Ok(()));
    let without = job(|terms, _| terms.workcell.tool = Tool::from(StraightTool::default()));
    assert_eq!(check(without.arm(), without.terms()), Err(PlanError::NoTool));
    let paper = {
        let kitchen = kitchen();
        let mut terms = kitchen.terms().clone();
        terms.planner = Planner::Paper(serde_json::Value::Null);
        WashJob::new(kitchen.shared_arm(), terms).unwrap()
    };
    assert_eq!(check(paper.arm(), paper.terms()), Err(PlanError::PaperJob));
    for bad in [f64::NAN, f64::INFINITY, -1.0] {
        let lifted = job(|_, settings| settings.lift_m = bad);
        assert!(
            matches!(
                check(lifted.arm(), lifted.terms()),
                Err(PlanError::Setting(OutOfRange { name: "lift_m", .. }))
            ),
            "{bad}"
        );
    }
    let far = job(|_, settings| settings.arc.points = usize::MAX);
    assert!(matches!(
        check(far.arm(), far.terms()),
        Err(PlanError::Setting(OutOfRange { name: "arc.points", .. }))
    ));
    // Bent forward, the tool is in the floor.
    let low = job(|terms, _| terms.home_rad[1] = [0.0, 90.0, 0.0, 0.0, 0.0, 0.0].map(f64::to_radians).into());
    let error = check(low.arm(), low.terms()).unwrap_err();
    assert!(
        matches!(&error, PlanError::HomeNotClear { end: End::End, .. }),
        "{error}"
    );
    assert_eq!(error.infeasibility(), Some(Infeasibility::Proved));
    assert!(error.to_string().starts_with("at the end of the motion"), "{error}");
}

#[test]
fn distinguishes_failed_draws_from_impossible_layouts() {
    let (job, cancel) = (kitchen(), CancelToken::new());
    let watch = Watch::silent(&cancel);
    let invalid = LayoutError::InvalidPosition { plate: 0 };
    let failing = invalid.clone();
    let drawn = draw_washable_layout(&job.shared_arm(), job.terms(), &mut || Err(failing.clone()), &watch);
    assert_eq!(drawn, Err(PlanError::Layout(invalid)));
    let far = Layout {
        plates: vec![kitchen_plate([0.9, 0.0])],
        source: LayoutSource::Explicit,
        findings: Vec::new(),
    };
    let mut draw = || Ok(far.clone());
    let drawn = draw_washable_layout(&job.shared_arm(), job.terms(), &mut draw, &watch);
    let error = drawn.unwrap_err();
    assert!(matches!(error, PlanError::NoneWashable { layouts: 200, .. }), "{error}");
    assert_eq!(error.infeasibility(), Some(Infeasibility::NotFound));
}

/// Planning ends within a fraction of a second of being told to, whatever it is busy with.
#[test]
fn planning_can_be_cancelled_at_any_stage() {
    let job = on(&[[0.40, 0.0], [0.1, 0.56]], true);
    let kinds: [fn(&Activity) -> bool; 4] = [
        |a| matches!(a, Activity::Wash { .. }),
        |a| matches!(a, Activity::Cause { .. }),
        |a| matches!(a, Activity::Relocation { ring: 2, .. }),
        |a| matches!(a, Activity::Trial { .. }),
    ];
    for kind in kinds {
        give_up(&job, kind);
    }
    give_up(&kitchen(), |a| matches!(a, Activity::Transit { turn: 3, .. }));
}

fn give_up(job: &WashJob, at: fn(&Activity) -> bool) {
    let (cancel, told) = (CancelToken::new(), Mutex::new(None));
    let tell = |activity: &Activity| {
        if at(activity) {
            told.lock().unwrap().get_or_insert_with(Instant::now);
            cancel.cancel();
        }
    };
    let watch = Watch {
        tell: &tell,
        cancel: &cancel,
    };
    let ended = plan_with(job, &watch);
    assert!(matches!(ended, Err(PlanError::Cancelled(_))), "{ended:?}");
    let told = told.lock().unwrap().take();
    assert!(told.is_some_and(|at| at.elapsed() < SOON));
}
