//! Patterns are chosen as the settings leave them open, and the arm then presses as is promised.

use crate::pattern::*;
use platewash_bodies::job::WashJob;
use platewash_fixtures::{contact_kitchen, kitchen};
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::surface::SHIPPED_PROFILES;
use platewash_workcell::wash_path::{PatternName, WashPattern};

fn disc() -> Surface {
    Surface::Disc { radius_m: 0.145 }
}

fn plate(surface: &Surface) -> Plate {
    Plate {
        surface: *surface,
        ..Plate::level_disc([0.3, 0.0, 0.03], surface.rim_m(), 0.02)
    }
}

fn offered(terms: &JobTerms, settings: &PlannerSettings, surface: &Surface) -> Vec<Pattern> {
    let patterns = Patterns::new(terms, settings, &plate(surface), f64::INFINITY, &CancelToken::new());
    let widest = patterns.widest();
    let all: Vec<Pattern> = patterns.first().chain(patterns.wider_patterns()).collect();
    assert!(all.iter().all(|pattern| pattern.cone_rad <= widest.cone_rad));
    all
}

fn open() -> PlannerSettings {
    let job = contact_kitchen();
    let settings = *job.terms().planner_settings().unwrap();
    assert_eq!(
        (settings.turns, settings.path_radius_m, settings.pattern),
        (None, None, None)
    );
    settings
}

#[test]
fn keeps_the_stated_pattern() {
    let (job, wanted) = (contact_kitchen(), disc());
    let stated = |change: fn(&mut PlannerSettings)| {
        let mut settings = open();
        change(&mut settings);
        offered(job.terms(), &settings, &wanted)
    };
    assert!(
        stated(|s| s.pattern = Some(PatternName::Spiral))
            .iter()
            .all(|p| p.curve.rings().is_none())
    );
    assert!(
        stated(|s| s.pattern = Some(PatternName::Rings))
            .iter()
            .all(|p| p.curve.rings().is_some())
    );
    assert!(
        stated(|s| s.turns = Some(4.0))
            .iter()
            .all(|p| p.curve.turns == 4.0 && p.curve.rings().is_none())
    );
    assert!(
        stated(|s| s.path_radius_m = Some(0.12))
            .iter()
            .all(|p| p.curve.radius_m == 0.12)
    );
    assert!(
        stated(|s| s.closing_ring = Some(false))
            .iter()
            .all(|p| !p.curve.closing_ring)
    );
    let rings = stated(|s| (s.pattern, s.turns) = (Some(PatternName::Rings), Some(3.0)));
    assert!(rings.iter().all(|p| p.curve.rings().unwrap().count == 4));
    assert!(stated(|s| s.tilt_rad = Some(0.05)).iter().all(|p| p.cone_rad == 0.05));
}

/// Rings are as many as are stated, however few or many a face asks for, and however small the sponge or the path: there is always a curve.
#[test]
fn keeps_the_stated_number_of_rings() {
    let job = contact_kitchen();
    let mut surfaces = vec![
        disc(),
        Surface::Disc { radius_m: 1e-3 },
        Surface::Disc { radius_m: 5.0 },
    ];
    surfaces.extend(SHIPPED_PROFILES.iter().filter_map(|name| Surface::shipped(name)));
    for surface in surfaces {
        for sponge_m in [1e-4, 0.025, 1.0] {
            let mut terms = job.terms().clone();
            terms.workcell.tool.sponge.radius_m = sponge_m;
            // Without a promise about contact the test sees the curves alone.
            terms.requirements.contact = None;
            let promise = Promise::new(&terms, &plate(&surface));
            for turns in [None, Some(1.0), Some(2.0), Some(7.0), Some(99.0)] {
                for path_radius_m in [None, Some(1e-4), Some(0.05)] {
                    let settings = PlannerSettings {
                        pattern: Some(PatternName::Rings),
                        turns,
                        path_radius_m,
                        ..open()
                    };
                    let all = candidates(
                        settings.pattern,
                        &CandidateRequest {
                            stated: settings.stated_numbers(),
                            surface: &surface,
                            sponge_m: promise.foundation.radius_m,
                            density: Density::Usual,
                            laps: 1,
                        },
                    );
                    let what = format!("{surface:?}, {sponge_m} m, {turns:?}, {path_radius_m:?}");
                    assert!(!all.is_empty(), "{what}");
                    for curve in all {
                        let rings = curve.rings().unwrap();
                        let count = turns.map_or(rings.count, |turns| turns as usize + 1);
                        assert!(rings.count == count && count >= 2, "{what}: {curve:?}");
                        assert!(
                            0.0 < rings.inner_m && rings.inner_m < curve.radius_m,
                            "{what}: {curve:?}"
                        );
                        assert!(path_radius_m.is_none_or(|stated| curve.radius_m == stated), "{what}");
                    }
                }
            }
        }
    }
}

/// Before patterns were chosen the kitchen had one spiral and the whole cone.
#[test]
fn a_job_that_states_all_has_one_pattern() {
    let job = kitchen();
    let settings = job.terms().planner_settings().unwrap();
    let [only] = offered(job.terms(), settings, &disc())[..] else {
        panic!()
    };
    let curve = WashCurve {
        radius_m: 0.12385,
        turns: 3.5,
        start_angle_rad: 0.0,
        closing_ring: true,
        trim_rad: 0.0,
        pattern: WashPattern::Spiral,
    };
    assert_eq!((only.curve, only.cone_rad), (curve, job.terms().tilt_max_rad()));
}

/// The shortest first, no curve beyond the rim, and none faster than the area allows.
#[test]
fn chooses_short_wash_paths_on_the_plate() {
    let job = contact_kitchen();
    let mut surfaces = vec![disc()];
    surfaces.extend(SHIPPED_PROFILES.iter().filter_map(|name| Surface::shipped(name)));
    for surface in surfaces {
        let chosen = offered(job.terms(), &open(), &surface);
        let narrow: Vec<_> = chosen.iter().filter(|p| p.cone_rad == chosen[0].cone_rad).collect();
        assert!(!chosen.is_empty() && narrow.is_sorted_by(|a, b| a.time_s <= b.time_s));
        for pattern in chosen {
            assert!(pattern.curve.radius_m < surface.arc_m());
            let terms = job.terms();
            let sponge_m = terms.workcell.tool.sponge.radius_m;
            // A sponge that reaches over the rim washes more than the face.
            let area = surface.area_m2() / (2.0 * sponge_m * terms.wash_speed_m_s());
            assert!(
                pattern.time_s > area && pattern.time_s < 2.0 * area,
                "{pattern:?} {area}"
            );
        }
    }
}

/// A pattern checked on the bare face alone also keeps its promise with the arm's own tilts; with a third of the compression no
/// pattern does.
#[test]
fn the_kitchen_keeps_its_promises_of_contact() {
    let job = contact_kitchen();
    let planned = crate::plan(&job).unwrap();
    let pressed = |job: &WashJob| {
        let plan = &planned.plan;
        let clearance =
            platewash_bodies::clearance::ClearanceModel::new(job.arm(), &job.terms().workcell, &job.terms().plates)
                .unwrap();
        let tool = &job.terms().workcell.tool;
        let reach = job.terms().planner_settings().unwrap().reach;
        let placed =
            crate::placed_arm::PlacedArm::new(job.arm(), tool, &clearance, &job.terms().plates, reach).unwrap();
        let knots = &plan.knots;
        plan.segments
            .iter()
            .filter(|s| s.kind == platewash_motion::trajectory::SegmentKind::Wash)
            .all(|segment| {
                let plate = &job.terms().plates[segment.plate];
                let during = |t: &f64| (segment.t_start_s..=segment.t_end_s).contains(t);
                let along: Vec<_> = knots
                    .t_s
                    .iter()
                    .zip(&knots.q_rad)
                    .filter(|(t, _)| during(t))
                    .map(|(_, q)| *q)
                    .collect();
                let promise = Promise::new(job.terms(), plate);
                promise
                    .sampled(&placed, plate, &along, 0.25)
                    .shortfall(&Margin::ARM)
                    .is_none()
            })
    };
    assert!(pressed(&job));
    let mut terms = job.terms().clone();
    terms.workcell.tool.sponge.compression_m /= 3.0;
    assert!(!pressed(&WashJob::new(job.shared_arm(), terms).unwrap()));
}
