//! The quick answers for a live cell, held against planning itself.

use crate::SOON;
use crate::jobs::{job, on};
use platewash_bodies::job::{PlateOverlap, WashJob};
use platewash_fixtures::{kitchen, kitchen_plate};
use platewash_planner::{
    Activity, Chance, MapArea, MapPatch, OutOfRange, PlaceSearch, PlanError, SEARCHED_M, UnwashablePlate, Watch, check,
    nearest_place, other_unwashable_plates, plan, plan_here, plan_with, plate_outlooks, unwashable_plates,
    washable_map,
};
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::{OrderRule, Overlap, Planner};
use platewash_workcell::random;
use rand::RngExt;
use std::sync::Mutex;
use std::time::Instant;

/// One that is washed, one out of reach, one behind the arm, one too near.
const MIXED: [[f64; 2]; 4] = [[0.40, 0.0], [0.1, 0.56], [-0.7, 0.1], [0.0, -0.2]];

/// Plates anywhere around the arm, over each other and the base too.
fn scattered(seed: u64, relocate: bool) -> WashJob {
    let mut rng = random::stream(seed, "live cell");
    let count = rng.random_range(1..=4);
    let places: Vec<[f64; 2]> = (0..count)
        .map(|_| [0, 1].map(|_| rng.random_range(-0.6..0.6)))
        .collect();
    on(&places, relocate)
}

/// What is said of the plate that a job fails for, if it does.
fn refused<T: std::fmt::Debug>(planned: Result<T, PlanError>) -> Option<UnwashablePlate> {
    match planned {
        Err(PlanError::Unwashable(plate)) => Some(*plate),
        _ => None,
    }
}

fn silently<T>(act: impl FnOnce(&Watch<'_>) -> T) -> T {
    act(&Watch::silent(&CancelToken::new()))
}

#[test]
fn the_outlook_plans_the_same_bytes() {
    for relocate in [false, true] {
        let single = on(&[[0.40, 0.0]], relocate);
        let four = job(|_, settings| settings.relocate = relocate);
        for job in [single, four] {
            let here = silently(|watch| plan_here(&job, watch)).unwrap();
            let planned = plan(&job).unwrap();
            assert_eq!(here.plan.to_json().unwrap(), planned.plan.to_json().unwrap());
            assert!(here.plan.is_sealed());
            assert_eq!((here.visits, here.transits), (planned.visits, planned.transits));
        }
    }
}

/// All but the place: that is looked for neither way where the job does not ask, and later where it does.
#[test]
fn the_outlook_fails_with_the_error_of_planning() {
    let asks_not = on(&MIXED, false);
    let error = silently(|watch| plan_here(&asks_not, watch)).unwrap_err();
    assert_eq!(error, plan(&asks_not).unwrap_err());
    let heard = Mutex::new(Vec::new());
    let tell = |activity: &Activity| heard.lock().unwrap().push(*activity);
    let cancel = CancelToken::new();
    let watch = Watch {
        tell: &tell,
        cancel: &cancel,
    };
    let asks = on(&MIXED, true);
    let here = refused(plan_here(&asks, &watch)).unwrap();
    assert_eq!((here.nearest_m, here.place_search), (None, PlaceSearch::Later));
    assert!(
        here.to_string().ends_with("another position was not looked for here"),
        "{here}"
    );
    let heard = heard.into_inner().unwrap();
    let of = |wanted: fn(&Activity) -> bool| heard.iter().filter(|activity| wanted(activity)).count();
    assert_eq!(of(|a| matches!(a, Activity::Cause { .. })), 1);
    assert_eq!(
        of(|a| matches!(a, Activity::Relocation { .. } | Activity::Trial { .. })),
        0
    );
    let there = refused(plan(&asks)).unwrap();
    assert!(there.nearest_m.is_some());
    let put = UnwashablePlate {
        nearest_m: there.nearest_m,
        place_search: PlaceSearch::Within(SEARCHED_M),
        ..here
    };
    assert_eq!(put, there);
}

/// Typed in together, the places that are told leave nothing that cannot be washed.
#[test]
fn suggested_positions_of_several_plates_are_compatible() {
    let places = [[0.40, 0.0], [0.0, 0.72], [0.05, 0.75]];
    let job = on(&places, true);
    let first = refused(plan(&job)).unwrap();
    let others = silently(|watch| other_unwashable_plates(&job, &first, watch)).unwrap();
    let both = first.plate.min(others[0].plate)..=first.plate.max(others[0].plate);
    assert_eq!(both, 1..=2);
    assert_eq!((others.len(), others[0].place_search), (1, first.place_search));
    let mut moved = places;
    for plate in others.iter().chain([&first]) {
        moved[plate.plate] = plate.nearest_m.unwrap();
    }
    let mended = self::job(|terms, _| terms.plates = on(&moved, false).terms().plates.clone());
    plan(&mended).unwrap();
}

#[test]
fn names_every_failed_plate_including_that_of_planning() {
    let all = silently(|watch| unwashable_plates(&on(&MIXED, true), watch)).unwrap();
    assert_eq!(all.iter().map(|plate| plate.plate).collect::<Vec<_>>(), [1, 2, 3]);
    let (mut some, mut none) = (0, 0);
    for seed in 0..14 {
        let job = scattered(seed, seed % 2 == 0);
        let all = match silently(|watch| unwashable_plates(&job, watch)) {
            Ok(all) => all,
            Err(error) => {
                assert_eq!(error, silently(|watch| plan_here(&job, watch)).unwrap_err());
                continue;
            }
        };
        match refused(silently(|watch| plan_here(&job, watch))) {
            Some(plate) => {
                assert!(all.contains(&plate), "{seed}: {plate}");
                some += 1;
            }
            None => {
                assert!(all.is_empty(), "{seed}: {all:?}");
                none += 1;
            }
        }
        assert!(all.windows(2).all(|pair| pair[0].plate < pair[1].plate));
        for plate in &all {
            assert_eq!(plate.nearest_m, None);
            let (free, dead) = (plate.free_m.len() as f64, plate.dead_m.len() as f64);
            match plate.share {
                Some(share) => assert!(dead > 0.0 && (share - free / (free + dead)).abs() < 1e-12),
                None => assert_eq!((free, dead), (0.0, 0.0)),
            }
            let [x, y] = plate.centre_m;
            for [px, py, pz] in plate.free_m.iter().chain(&plate.dead_m) {
                // On its face, within its rim.
                assert!((px - x).hypot(py - y) < 0.145 && (pz - 0.03).abs() < 1e-12);
            }
        }
    }
    assert!(some > 5 && none >= 2, "{some} {none}");
}

#[test]
fn planning_fails_for_plates_reported_unwashable() {
    let mut told = [0; 3];
    for seed in 0..14 {
        let job = scattered(seed, false);
        let Ok(outlooks) = silently(|watch| plate_outlooks(&job, watch)) else {
            assert!(plan(&job).is_err());
            continue;
        };
        let plates = job.terms().plates.len();
        assert!(outlooks.iter().map(|outlook| outlook.plate).eq(0..plates));
        let fails = silently(|watch| unwashable_plates(&job, watch)).unwrap();
        for outlook in &outlooks {
            told[outlook.chance as usize] += 1;
            let fails = fails.iter().any(|plate| plate.plate == outlook.plate);
            assert!(fails || outlook.chance != Chance::Unwashable, "{seed}: {outlook:?}");
        }
        let chance = |plate: usize| outlooks[plate].chance;
        if outlooks.iter().any(|outlook| outlook.chance == Chance::Unwashable) {
            let plate = refused(plan(&job)).unwrap_or_else(|| panic!("{seed}: planned"));
            assert_eq!(chance(plate.plate), Chance::Unwashable, "{seed}");
        }
    }
    let [washable, unwashable, _] = told;
    assert!(washable > 5 && unwashable > 10, "{told:?}");
}

#[test]
fn plans_overlapping_plates_where_the_job_allows_it() {
    let job = on(&[[0.40, 0.0], [0.40, 0.1]], false);
    let outlooks = silently(|watch| plate_outlooks(&job, watch)).unwrap();
    assert!(outlooks.iter().all(|outlook| outlook.chance == Chance::Washable));
    assert!(plan(&job).is_ok());
    let strict = self::job(|terms, _| terms.plates = job.terms().plates.clone());
    assert_eq!(silently(|watch| plate_outlooks(&strict, watch)).unwrap(), outlooks);
    let error = plan(&strict).unwrap_err();
    let PlanError::Overlap(overlaps) = &error else {
        panic!("{error}")
    };
    let [
        PlateOverlap {
            plate: 0,
            other: Some(1),
            by_m,
        },
    ] = overlaps[..]
    else {
        panic!("{error}")
    };
    assert!((by_m - 0.19).abs() < 1e-9, "{error}");
    assert_eq!(check(strict.arm(), strict.terms()), Err(error));
    let json = serde_json::to_string(&outlooks[1]).unwrap();
    assert_eq!(json, r#"{"plate":1,"chance":"washable"}"#);
}

/// The place that planning reports, where the job asks for it; the same where it does not.
#[test]
fn the_nearest_place_is_the_one_that_planning_reports() {
    let mut found = 0;
    for seed in 0..6 {
        let Some(plate) = refused(plan(&scattered(seed, true))) else {
            continue;
        };
        for relocate in [false, true] {
            let job = scattered(seed, relocate);
            let place = silently(|watch| nearest_place(&job, plate.plate, watch)).unwrap();
            assert_eq!(place, plate.nearest_m, "{seed}");
        }
        found += usize::from(plate.nearest_m.is_some());
    }
    assert!(found >= 3, "{found}");
}

/// Where no few points tell: the search along the path ends, after the plate before it was washed.
#[test]
fn the_nearest_place_of_a_plate_that_was_searched_for_is_the_one_that_planning_reports() {
    let edges = [
        [
            [-0.354_409_722_500_975, 0.222_525_747_624_526_7],
            [-0.258_626_817_405_437_7, -0.216_253_511_968_586_25],
        ],
        [
            [-0.253_626_962_613_814, 0.208_100_230_938_576_4],
            [-0.015_244_900_148_472_9, 0.449_025_171_247_609_4],
        ],
    ];
    let mut searched = 0;
    for places in edges {
        for order in [[0, 1], [1, 0]] {
            let given = |relocate: bool| {
                job(|terms, settings| {
                    terms.plates = order.map(|plate| kitchen_plate(places[plate])).into();
                    terms.requirements.overlap = Overlap::Report;
                    (settings.order, settings.relocate) = (OrderRule::Given, relocate);
                })
            };
            let asks = given(true);
            let outlooks = silently(|watch| plate_outlooks(&asks, watch)).unwrap();
            if outlooks.iter().any(|outlook| outlook.chance == Chance::Unwashable) {
                continue;
            }
            searched += 1;
            let plate = refused(plan(&asks)).unwrap();
            assert_eq!((order[plate.plate], plate.nearest_m.is_some()), (0, true));
            let place = silently(|watch| nearest_place(&given(false), plate.plate, watch)).unwrap();
            assert_eq!(place, plate.nearest_m);
            let listed = silently(|watch| unwashable_plates(&asks, watch)).unwrap();
            assert_eq!(listed, [refused(silently(|watch| plan_here(&asks, watch))).unwrap()]);
        }
    }
    assert!(searched >= 2, "{searched}");
}

/// One that is washed is left where it is; one that keeps the arm from home is moved away.
#[test]
fn a_place_is_found_for_any_plate() {
    let job = on(&MIXED, false);
    assert_eq!(
        silently(|watch| nearest_place(&job, 0, watch)).unwrap(),
        Some([0.40, 0.0])
    );
    for plate in [1, 2, 3] {
        let place = silently(|watch| nearest_place(&job, plate, watch)).unwrap();
        let Some([x, y]) = place else { continue };
        let others_fail = silently(|watch| {
            let mut places = MIXED;
            places[plate] = [x, y];
            unwashable_plates(&on(&places, false), watch)
        });
        assert!(others_fail.unwrap().iter().all(|other| other.plate != plate), "{plate}");
    }
}

fn patches(job: &WashJob, plate: usize, area: &MapArea) -> Vec<MapPatch> {
    let mut patches = Vec::new();
    silently(|watch| washable_map(job, plate, area, &mut |patch| patches.push(patch), watch)).unwrap();
    patches
}

#[test]
fn answers_do_not_depend_on_the_number_of_threads() {
    let job = on(&MIXED, true);
    let area = MapArea {
        step_m: 0.08,
        ..MapArea::within_reach(&job, 1).unwrap()
    };
    let all = || {
        let answers = silently(|watch| (plate_outlooks(&job, watch), unwashable_plates(&job, watch)));
        (answers, patches(&job, 1, &area))
    };
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(all)
    };
    let one = with(1);
    assert_eq!(one, with(2));
    assert_eq!(one, with(5));
}

/// Every square once, coarse to fine, counted, those of a size along the border of the coarser ones.
#[test]
fn streams_a_map_square_by_square() {
    let job = kitchen();
    let area = MapArea {
        step_m: 0.03,
        ..MapArea::within_reach(&job, 0).unwrap()
    };
    let patches = patches(&job, 0, &area);
    let mut coarser: Vec<([f64; 2], bool)> = Vec::new();
    for step_m in [0.12, 0.06, 0.03] {
        let of_size: Vec<_> = patches.iter().filter(|patch| patch.step_m == step_m).collect();
        let mut here: Vec<([f64; 2], bool)> = Vec::new();
        for patch in &of_size {
            here.extend(patch.washable_m.iter().map(|centre| (*centre, true)));
            here.extend(patch.unwashable_m.iter().map(|centre| (*centre, false)));
            assert_eq!(patch.done, here.len());
        }
        assert!(of_size.iter().all(|patch| patch.of == here.len()));
        assert!(here.iter().any(|(_, washable)| *washable) && here.iter().any(|(_, washable)| !washable));
        for (k, (centre, _)) in here.iter().enumerate() {
            assert!(here[..k].iter().all(|(other, _)| other != centre));
        }
        // What was not quartered is like all around it.
        let off = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
        for (centre, washable) in &coarser {
            let around = coarser.iter().filter(|(other, _)| off(centre, other) < 2.1 * step_m);
            let differs = around.clone().any(|(_, other)| other != washable);
            let quarters = here.iter().filter(|(inside, _)| off(centre, inside) < step_m).count();
            assert!(quarters == 4 || quarters == 0 && !differs, "{centre:?}: {quarters}");
        }
        coarser = here;
    }
    assert_eq!(patches.iter().filter(|patch| patch.step_m < 0.03).count(), 0);
}

/// The arm washes nothing beyond the area that is chosen for it; where nothing can be, that is told too.
#[test]
fn nothing_is_washable_beyond_reach() {
    let job = kitchen();
    let area = MapArea::within_reach(&job, 0).unwrap();
    assert!(0.6 < area.radius_m && area.radius_m < 1.0, "{area:?}");
    assert_eq!(format!("{:.3}", area.step_m).parse(), Ok(area.step_m));
    // Nothing is farther away than this that can be washed.
    let wider = MapArea {
        radius_m: 1.2,
        step_m: 0.06,
        ..area
    };
    for patch in patches(&job, 0, &wider) {
        for [x, y] in patch.washable_m {
            assert!(x.hypot(y) < area.radius_m, "{x} {y}");
        }
    }
    let elsewhere = MapArea {
        centre_m: [500.0, 0.0],
        radius_m: 120.0,
        step_m: 2.0,
    };
    let told = patches(&job, 0, &elsewhere);
    assert!(
        told.len() > 1
            && told
                .iter()
                .all(|patch| patch.washable_m.is_empty() && patch.step_m == 8.0)
    );
}

#[test]
fn rejects_invalid_numbers() {
    let job = kitchen();
    let missing = PlanError::Plate { plate: 4, count: 4 };
    let area = MapArea::within_reach(&job, 0).unwrap();
    let map = |job: &WashJob, plate: usize, area: &MapArea| {
        silently(|watch| washable_map(job, plate, area, &mut |patch| panic!("{patch:?}"), watch))
    };
    assert_eq!(silently(|watch| nearest_place(&job, 4, watch)), Err(missing.clone()));
    assert_eq!(map(&job, 4, &area), Err(missing.clone()));
    assert_eq!(MapArea::within_reach(&job, 4), Err(missing));
    assert!(map(&job, usize::MAX, &area).is_err());
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, 0.0, 1e300] {
        let areas = [
            MapArea { radius_m: bad, ..area },
            MapArea { step_m: bad, ..area },
            MapArea {
                centre_m: [0.0, if bad.abs() <= 1.0 { 1e4 } else { bad }],
                ..area
            },
        ];
        for (area, name) in areas.iter().zip(["map.radius_m", "map.step_m", "map.centre_m"]) {
            match map(&job, 0, area) {
                Err(PlanError::Setting(OutOfRange { name: found, .. })) => assert_eq!(found, name, "{bad}"),
                other => panic!("{bad}: {other:?}"),
            }
        }
    }
    let paper = job_of_the_paper();
    assert_eq!(
        silently(|watch| plate_outlooks(&paper, watch)).unwrap_err(),
        PlanError::PaperJob
    );
}

fn job_of_the_paper() -> WashJob {
    let kitchen = kitchen();
    let mut terms = kitchen.terms().clone();
    terms.planner = Planner::Paper(serde_json::Value::Null);
    WashJob::new(kitchen.shared_arm(), terms).unwrap()
}

/// Bent forward, the tool is in the floor: nothing is washable then, as nothing is planned.
#[test]
fn refuses_an_outlook_from_a_home_in_collision() {
    let low = job(|terms, _| terms.home_rad[1] = [0.0, 90.0, 0.0, 0.0, 0.0, 0.0].map(f64::to_radians).into());
    let error = plan(&low).unwrap_err();
    assert!(matches!(error, PlanError::HomeNotClear { .. }), "{error}");
    assert_eq!(silently(|watch| plate_outlooks(&low, watch)), Err(error.clone()));
    assert_eq!(silently(|watch| unwashable_plates(&low, watch)), Err(error));
    let area = MapArea {
        step_m: 0.03,
        ..MapArea::within_reach(&low, 0).unwrap()
    };
    let told = patches(&low, 0, &area);
    assert!(told.len() > 1 && told.iter().all(|patch| patch.washable_m.is_empty()));
}

#[test]
fn cancelled_work_ends_at_once() {
    let job = on(&MIXED, true);
    let cancel = CancelToken::new();
    cancel.cancel();
    let watch = Watch::silent(&cancel);
    let ended = |answer: Option<PlanError>| assert!(matches!(answer, Some(PlanError::Cancelled(_))), "{answer:?}");
    let area = MapArea::within_reach(&job, 1).unwrap();
    let start = Instant::now();
    ended(plan_here(&job, &watch).err());
    ended(plate_outlooks(&job, &watch).err());
    ended(unwashable_plates(&job, &watch).err());
    ended(nearest_place(&job, 1, &watch).err());
    ended(washable_map(&job, 1, &area, &mut |patch| panic!("{patch:?}"), &watch).err());
    assert!(start.elapsed() < SOON, "{:?}", start.elapsed());
}

/// Told in the midst of it: no later patch comes, and the end is near.
#[test]
fn a_map_and_a_search_can_be_cancelled_halfway() {
    let job = on(&MIXED, true);
    let area = MapArea::within_reach(&job, 1).unwrap();
    let cancel = CancelToken::new();
    let (mut patches, mut told) = (0, Instant::now());
    let mut tell = |_: MapPatch| {
        patches += 1;
        if patches == 3 {
            cancel.cancel();
            told = Instant::now();
        }
    };
    let ended = washable_map(&job, 1, &area, &mut tell, &Watch::silent(&cancel));
    assert!(matches!(ended, Err(PlanError::Cancelled(_))), "{ended:?}");
    assert_eq!(patches, 3);
    assert!(told.elapsed() < SOON);
    let kinds: [fn(&Activity) -> bool; 2] = [
        |a| matches!(a, Activity::Relocation { ring: 2, .. }),
        |a| matches!(a, Activity::Trial { .. }),
    ];
    for wanted in kinds {
        let (cancel, told) = (CancelToken::new(), Mutex::new(None));
        let tell = |activity: &Activity| {
            if wanted(activity) {
                told.lock().unwrap().get_or_insert_with(Instant::now);
                cancel.cancel();
            }
        };
        let watch = Watch {
            tell: &tell,
            cancel: &cancel,
        };
        let ended = nearest_place(&job, 1, &watch);
        assert!(matches!(ended, Err(PlanError::Cancelled(_))), "{ended:?}");
        let told = told.lock().unwrap().take();
        assert!(told.is_some_and(|at| at.elapsed() < SOON));
        // By `plan_with` too, as ever.
        assert!(matches!(plan_with(&job, &watch), Err(PlanError::Cancelled(_))));
    }
}
