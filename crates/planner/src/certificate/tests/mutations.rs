//! Every promise is broken on purpose, the plan sealed again, and the right promise must say so.

use super::made::{Recipe, good, irb120, restated};
use crate::certificate::PromiseName::{self, *};
use crate::certificate::{Certificate, CertificateVerdict, PairRule, Status, verify};
use crate::plan::Plan;
use crate::scenario::Overlap;
use crate::tool_path::{SegmentKind, Shape};
use platewash_kinematics::JointVector;

fn judged(plan: Plan) -> Certificate {
    verify(&restated(plan), &irb120()).unwrap()
}

fn broken(certificate: &Certificate) -> Vec<PromiseName> {
    certificate.broken().map(|p| p.name).collect()
}

/// Changes the good plan, seals it, and expects exactly these promises not to pass.
#[track_caller]
fn breaks(expected: &[PromiseName], change: impl FnOnce(&mut Plan)) -> Certificate {
    let mut plan = good();
    change(&mut plan);
    let certificate = judged(plan);
    assert_eq!(certificate.hash.status, Status::Pass);
    assert_eq!(broken(&certificate), expected, "{certificate}");
    assert_eq!(certificate.verdict, CertificateVerdict::Fail);
    certificate
}

/// The same, but other promises may break too.
#[track_caller]
fn breaks_at_least(expected: &[PromiseName], change: impl FnOnce(&mut Plan)) -> Certificate {
    let mut plan = good();
    change(&mut plan);
    let certificate = judged(plan);
    let found = broken(&certificate);
    assert!(
        expected.iter().all(|name| found.contains(name)),
        "{expected:?}\n{certificate}"
    );
    certificate
}

fn stage(plan: &Plan, kind: SegmentKind) -> usize {
    plan.segments.iter().position(|s| s.kind == kind).unwrap()
}

/// Knots strictly within the first segment of a kind.
fn within(plan: &Plan, kind: SegmentKind) -> std::ops::Range<usize> {
    let segment = plan.segments[stage(plan, kind)];
    let knot = |t: f64| plan.knots.t_s.iter().position(|x| *x == t).unwrap();
    knot(segment.t_start_s) + 1..knot(segment.t_end_s)
}

#[test]
fn the_good_plan_passes() {
    let certificate = verify(&good(), &irb120()).unwrap();
    assert_eq!(broken(&certificate), [], "{certificate}");
    assert_eq!(certificate.verdict, CertificateVerdict::Pass);
    assert!(certificate.to_string().starts_with("CERTIFIED"));
}

#[test]
fn harmless_edits_pass() {
    let mut plan = good();
    plan.scenario.name = "renamed".into();
    // A knot more, on the curve of the motion.
    let k = within(&plan, SegmentKind::Wash).start + 40;
    let motion = platewash_workcell::trajectory::Trajectory::from_knots(
        plan.knots.t_s.clone(),
        plan.knots.q_rad.clone(),
        plan.knots.qd_rad_s.clone(),
    )
    .unwrap();
    let t = 0.3 * plan.knots.t_s[k] + 0.7 * plan.knots.t_s[k + 1];
    let state = motion.at(t).unwrap();
    plan.knots.t_s.insert(k + 1, t);
    plan.knots.q_rad.insert(k + 1, state.q);
    plan.knots.qd_rad_s.insert(k + 1, state.qd);
    let certificate = judged(plan);
    assert_eq!(certificate.verdict, CertificateVerdict::Pass, "{certificate}");
}

#[test]
fn tampering_without_the_seal_is_a_finding_of_its_own() {
    let mut plan = good();
    plan.summary.headline = "washed twice".into();
    let certificate = verify(&plan, &irb120()).unwrap();
    assert_eq!(broken(&certificate), [Summary]);
    plan.summary = good().summary;
    plan.scenario.name = "another".into();
    let certificate = verify(&plan, &irb120()).unwrap();
    assert_eq!(broken(&certificate), []);
    assert!(
        certificate.headline.ends_with("; not kept: the hash"),
        "{}",
        certificate.headline
    );
    assert_eq!(
        (certificate.hash.status, certificate.verdict),
        (Status::Fail, CertificateVerdict::Fail)
    );
    plan.hash = None;
    assert_eq!(verify(&plan, &irb120()).unwrap().hash.status, Status::Fail);
}

#[test]
fn statements_that_do_not_follow_are_named() {
    breaks(&[Limits], |p| p.limits.tilt_rad += 0.1);
    breaks(&[Limits], |p| p.limits.clearance_m = 0.001);
    breaks(&[Limits], |p| p.limits.velocity_rad_s[2] *= 2.0);
    breaks(&[Limits], |p| p.limits.upper_rad[0] = None);
    breaks(&[Limits], |p| p.limits.coverage = 0.5);
    let told = breaks(&[Tolerances], |p| p.tolerances.path_m = 0.01);
    assert!(
        told.to_string().contains("tolerances.path_m: 0.01; expected 0.0002"),
        "{told}"
    );
    breaks(&[Tool], |p| p.tool.length_m += 0.01);
    breaks(&[Tool], |p| p.tip.position_m[0] += 0.01);
    breaks(&[Arm], |p| p.robot.urdf_sha256 = "0".repeat(64));
    breaks(&[Arm], |p| p.robot.name = "other".into());
    breaks(&[Arm], |p| p.scenario.job.program = crate::scenario::Program::Paper);
    breaks(&[ClearancePairs], |p| _ = p.clearance_pairs.pop());
    breaks(&[ClearancePairs], |p| p.clearance_pairs.swap(0, 1));
    breaks(&[HomeToHome], |p| p.home_rad[1][3] += 0.1);
    breaks(&[Plates], |p| p.plates[1].thickness_m *= 0.5);
}

#[test]
fn the_summary_says_what_follows_and_no_more() {
    let certificate = breaks(&[Summary], |p| {
        p.summary.headline = "9 plates sterilised in 1 s, PROVED".into();
    });
    assert!(certificate.to_string().contains("summary.headline"), "{certificate}");
    assert!(
        certificate.headline.ends_with("; not kept: summary"),
        "{}",
        certificate.headline
    );
    breaks(&[Summary], |p| p.summary.plates_washed = 1);
    breaks(&[Summary], |p| p.summary.plates_washed = 3);
    breaks(&[Summary], |p| p.summary.duration_s = 1.0);
    breaks(&[Summary], |p| p.summary.waypoints_reached = [9, 9]);
    assert_eq!(good().summary.plates_washed, 2);
}

/// With a smaller sponge, all stated as it should be, the plates are no longer swept.
#[test]
fn a_plate_that_is_not_swept_is_not_counted_as_washed() {
    let mut plan = good();
    plan.scenario.tool.sponge_radius_m = 0.01;
    plan.tool = plan.scenario.tool.clone();
    assert_eq!(super::super::summary(&plan, &irb120()).plates_washed, 0);
    let certificate = judged(plan.clone());
    assert_eq!(broken(&certificate), [Coverage], "{certificate}");
    plan.summary.plates_washed = 1;
    assert_eq!(broken(&judged(plan)), [Coverage, Summary]);
}

/// Tilted as much as it may be the sponge would not cover the rim; tilted as it is, it does.
#[test]
fn the_tilt_at_the_knots_counts_where_the_limit_does_not_suffice() {
    let mut recipe = Recipe::arc(&[20.0]);
    recipe.scenario.wash.tilt_max_deg = 40.0;
    let plan = recipe.plan();
    assert_eq!(plan.summary.plates_washed, 1);
    assert_eq!(verify(&plan, &irb120()).unwrap().verdict, CertificateVerdict::Pass);
}

/// The motion is proved as before; what is asked is nonsense: the stroke runs over the neighbour.
#[test]
fn a_stroke_that_runs_over_another_plate_is_named() {
    let told = breaks_at_least(&[EveryPlateOnce], |p| {
        let radius = 0.05;
        p.scenario.layout.plate_radius_m = radius;
        p.plates.iter_mut().for_each(|plate| plate.radius_m = radius);
        let [a, b] = [p.plates[0], p.plates[1]];
        // On the way to each other, 20 mm apart.
        let share = 0.12 / ((a.x_m - b.x_m).powi(2) + (a.y_m - b.y_m).powi(2)).sqrt();
        (p.plates[1].x_m, p.plates[1].y_m) = (a.x_m + share * (b.x_m - a.x_m), a.y_m + share * (b.y_m - a.y_m));
    });
    let said = told.promise(EveryPlateOnce).unwrap();
    assert_eq!((said.status, said.discrepancies.len()), (Status::Fail, 2));
    let first = &said.discrepancies[0];
    assert_eq!(first.what, "plate 1 while plate 0 is washed");
    // 123 mm of path and 25 mm of sponge, tilted by 15°, less 50 mm of plate and 20 mm of gap.
    assert_eq!(first.stated, "swept as far as 78.9 mm over its rim");
}

#[test]
fn how_far_the_sponge_reaches_beyond_each_rim_is_shown_and_held() {
    let certificate = verify(&good(), &irb120()).unwrap();
    for swept in &certificate.coverage {
        // 123 mm of path and 25 mm of sponge, which is upright, less 145 mm of plate, and 0.2 mm.
        assert!((swept.beyond_rim_allowed_m - 0.0032).abs() < 1e-6);
        assert!(swept.beyond_rim_seen_m > 0.0029 && swept.beyond_rim_m.unwrap() < 0.0032);
        assert!(swept.touches.is_empty());
    }
    assert!(
        certificate.to_string().contains(" mm beyond the rim (allowed: 3.2"),
        "{certificate}"
    );
    // One knot moved outwards on the ring.
    breaks_at_least(&[Reach, StrokeDeviation], |p| {
        let k = within(p, SegmentKind::Wash).end - 40;
        p.knots.q_rad[k][1] += 0.02;
        p.knots.q_rad[k + 1][1] -= 0.02;
    });
}

/// Its side wall reaches s / cos τ from the tip at the height of the face, and lines over the ends of the stroke count, too.
#[test]
fn a_tilted_sponge_reaches_farther_than_its_radius() {
    let mut recipe = Recipe::arc(&[20.0]);
    recipe.lean = 0.2;
    let plan = recipe.plan();
    let certificate = verify(&plan, &irb120()).unwrap();
    assert_eq!(certificate.verdict, CertificateVerdict::Pass, "{certificate}");
    let swept = &certificate.coverage[0];
    let upright = 0.123 + 0.025 - 0.145;
    // The tip may be 1 mm under the face.
    let wider = (0.025 + 0.001 * 0.2_f64.sin()) / 0.2_f64.cos() - 0.025;
    let reach = swept.beyond_rim_m.unwrap();
    assert!(reach >= upright + wider && reach < upright + wider + 2e-4, "{swept:?}");
}

/// Plates from which a neighbour is out of reach are no excuse to come near that one.
#[test]
fn the_sponge_may_touch_only_what_is_within_reach() {
    let certificate = verify(&good(), &irb120()).unwrap();
    let exempt = certificate
        .clearance
        .iter()
        .filter(|line| line.rule == PairRule::Exempt);
    let exempt: Vec<_> = exempt
        .map(|line| (line.pair[1].as_str(), &line.working_on[..]))
        .collect();
    assert_eq!(exempt, [("plate 0", &[0][..]), ("plate 1", &[1])]);
    let near = verify(&Recipe::arc(&[-23.5, 23.5]).plan(), &irb120()).unwrap();
    let line = near
        .clearance
        .iter()
        .find(|line| line.rule == PairRule::Exempt)
        .unwrap();
    assert_eq!(line.working_on, [0, 1]);
}

#[test]
fn another_tool_consistently_stated_leaves_the_path() {
    let robot = irb120();
    breaks_at_least(&[StrokeDeviation, LineDeviation, ContactHeight], |p| {
        p.scenario.tool.length_m += 0.01;
        p.tool = p.scenario.tool.clone();
        p.tip = crate::plan::TipPose::new(&robot, &p.tool);
    });
}

#[test]
fn plates_elsewhere_are_not_washed() {
    breaks(&[Plates, ToolPath], |p| p.plates[0].x_m += 1e-4);
    breaks_at_least(&[Plates, ToolPath, Reach], |p| p.plates[0].x_m += 3e-4);
    breaks_at_least(&[Coverage, ToolPath], |p| {
        p.plates[0].x_m += 0.03;
        let moved = [p.plates[0].x_m, p.plates[0].y_m];
        p.scenario.layout.positions_m.as_mut().unwrap()[0] = moved;
    });
}

#[test]
fn the_stroke_must_be_the_scenarios_and_be_followed() {
    let edit = |p: &mut Plan, change: fn(&mut platewash_workcell::stroke::Stroke)| {
        let wash = stage(p, SegmentKind::Wash);
        if let Shape::Stroke { stroke, .. } = &mut p.tool_path[wash].shape {
            change(stroke);
        }
    };
    breaks(&[ToolPath, StrokeDeviation], |p| edit(p, |s| s.radius_m -= 0.003));
    breaks(&[ToolPath, StrokeDeviation], |p| edit(p, |s| s.turns += 0.5));
    breaks(&[ToolPath, StrokeDeviation], |p| edit(p, |s| s.closing_ring = false));
    // The angle at which it starts is free, but the tip must follow it, and the retreat begins where it ends.
    breaks(&[ToolPath, StrokeDeviation], |p| edit(p, |s| s.start_angle_rad += 0.1));
    breaks_at_least(&[ToolPath], |p| {
        let approach = stage(p, SegmentKind::Approach);
        if let Shape::Line { height_m, .. } = &mut p.tool_path[approach].shape {
            *height_m -= 0.01;
        }
    });
}

#[test]
fn a_smaller_stroke_with_another_scenario_leaves_the_rim() {
    let mut recipe = Recipe::arc(&[20.0]);
    recipe.scenario.wash.path_radius_m = 0.112;
    let certificate = verify(&recipe.plan(), &irb120()).unwrap();
    assert_eq!(broken(&certificate), [Coverage], "{certificate}");
    let coverage = certificate.promise(Coverage).unwrap();
    assert_eq!(
        coverage.status,
        Status::Fail,
        "proved to be too little, not merely unproved"
    );
}

#[test]
fn a_knot_moved_is_seen_by_joints_and_by_the_path() {
    breaks_at_least(&[StrokeDeviation], |p| {
        let k = within(p, SegmentKind::Wash).start + 200;
        p.knots.q_rad[k][1] += 0.002;
    });
    breaks_at_least(&[LineDeviation, JointAcceleration], |p| {
        let k = within(p, SegmentKind::Retreat).start + 20;
        p.knots.q_rad[k][2] += 0.02;
    });
    breaks_at_least(&[JointPosition, JointSpeed], |p| p.knots.q_rad[40][4] += 3.0);
    breaks(&[HomeToHome], |p| p.knots.q_rad[0][5] += 1e-6);
    breaks_at_least(&[RestAtWashEnds], |p| {
        let k = within(p, SegmentKind::Wash).start - 1;
        p.knots.qd_rad_s[k][0] = 1e-3;
    });
}

#[test]
fn a_stretch_run_backwards_is_no_stroke() {
    let told = breaks_at_least(&[StrokeDeviation], |p| {
        let washing = within(p, SegmentKind::Wash);
        let (from, to) = (washing.start + 300, washing.start + 340);
        p.knots.q_rad[from..to].reverse();
        p.knots.qd_rad_s[from..to].reverse();
        p.knots.qd_rad_s[from..to].iter_mut().for_each(|v| *v = -*v);
    });
    assert_eq!(told.promise(StrokeDeviation).unwrap().status, Status::Fail);
}

#[test]
fn time_squeezed_is_too_fast() {
    let squeeze = |p: &mut Plan, factor: f64| {
        p.knots.t_s.iter_mut().for_each(|t| *t *= factor);
        p.knots.qd_rad_s.iter_mut().for_each(|v| *v /= factor);
        for segment in &mut p.segments {
            segment.t_start_s *= factor;
            segment.t_end_s *= factor;
        }
    };
    breaks_at_least(&[WashSpeed, WashAcceleration], |p| squeeze(p, 0.45));
    breaks_at_least(&[TipSpeed, JointAcceleration], |p| squeeze(p, 0.2));
    breaks_at_least(&[JointSpeed, TipAcceleration], |p| squeeze(p, 0.1));
}

#[test]
fn segments_are_complete_and_in_order() {
    breaks_at_least(&[Segments], |p| _ = p.segments.remove(3));
    breaks_at_least(&[Segments], |p| _ = p.tool_path.remove(3));
    breaks_at_least(&[Segments], |p| p.segments.insert(2, p.segments[2]));
    breaks_at_least(&[Segments], |p| p.segments[2].kind = SegmentKind::Transition);
    breaks_at_least(&[Segments], |p| p.segments[2].plate = 1);
    breaks_at_least(&[Segments], |p| {
        p.segments.last_mut().unwrap().plate = 1_000_000_000_000_000
    });
    breaks_at_least(&[Segments], |p| p.tool_path.last_mut().unwrap().plate = 0);
    breaks_at_least(&[Segments], |p| p.segments[2].t_end_s += 1e-6);
    breaks_at_least(&[Segments], |p| p.segments[4].t_start_s -= 1e-6);
    breaks_at_least(&[Segments], |p| p.segments.last_mut().unwrap().t_end_s = 1e300);
    breaks_at_least(&[Segments], |p| p.order.swap(0, 1));
    breaks_at_least(&[Segments, EveryPlateOnce], |p| p.order[1] = 0);
    breaks_at_least(&[Segments, EveryPlateOnce], |p| p.order.push(7));
    // The boundary of a wash a knot later: the arm does not rest there and the line has not ended.
    breaks_at_least(&[RestAtWashEnds], |p| {
        let (wash, knot) = (stage(p, SegmentKind::Wash), within(p, SegmentKind::Wash).start + 5);
        p.segments[wash].t_start_s = p.knots.t_s[knot];
        p.segments[wash - 1].t_end_s = p.knots.t_s[knot];
    });
}

#[test]
fn the_tilt_is_judged_against_the_scenario() {
    let mut recipe = Recipe::arc(&[20.0]);
    recipe.lean = 0.1;
    let plan = recipe.plan();
    let certificate = verify(&plan, &irb120()).unwrap();
    let tilt = certificate.promise(Tilt).unwrap();
    let bound = tilt.measure.unwrap().bound.unwrap();
    assert_eq!(tilt.status, Status::Pass);
    assert!((0.1..0.1005).contains(&bound), "{bound}");
    let mut strict = plan;
    strict.scenario.wash.tilt_max_deg = 5.0;
    strict.limits.tilt_rad = 5.0_f64.to_radians();
    assert_eq!(broken(&judged(strict)), [Tilt]);
}

/// 6.04 mm high and 25 mm in radius: h/s is the sine of 13.98° and the tangent of 13.58°. At 13.78° the rim at the handle is 0.09 mm
/// inside the plate.
#[test]
fn a_sponge_is_tilted_no_further_than_its_upper_rim_allows() {
    let mut recipe = Recipe::arc(&[20.0]);
    recipe.lean = 0.2405;
    let tilt = |recipe: &Recipe| {
        verify(&recipe.plan(), &irb120())
            .unwrap()
            .promise(Tilt)
            .unwrap()
            .clone()
    };
    let rim_m = |height_m: f64| height_m * recipe.lean.cos() - 0.025 * recipe.lean.sin();
    for (height_m, status) in [(6.04e-3, Status::Fail), (6.14e-3, Status::Pass)] {
        assert_eq!(rim_m(height_m) > 0.0, status == Status::Pass);
        let mut recipe = recipe.clone();
        recipe.scenario.tool.sponge_height_m = height_m;
        assert_eq!(tilt(&recipe).status, status, "{height_m}");
    }
}

/// The speed of the lowest point of the rim of a tool that leans forward by an angle, at the worst of many moments at which it is
/// at or below the plate \[m/s\], from differences.
fn touching_speed(plan: &Plan, lean: f64) -> f64 {
    let robot = irb120();
    let tip = platewash_workcell::tool::tip_frame(&robot, &plan.tool);
    let knots = plan.knots.clone();
    let motion =
        platewash_workcell::trajectory::Trajectory::from_knots(knots.t_s, knots.q_rad, knots.qd_rad_s).unwrap();
    let place = |t: f64| robot.fk(&motion.at(t).unwrap().q).rigid(&tip).translation;
    let lines = |s: &&crate::plan::PlanSegment| matches!(s.kind, SegmentKind::Approach | SegmentKind::Retreat);
    let mut worst = 0.0f64;
    for segment in plan.segments.iter().filter(lines) {
        let (from, to) = (segment.t_start_s, segment.t_end_s);
        for t in (1..4000).map(|k| from + (to - from) * f64::from(k) / 4000.0) {
            let reach = plan.tool.sponge_radius_m * lean.sin();
            if place(t).z - reach <= plan.plates[segment.plate].z_m - 1e-6 {
                worst = worst.max((place(t + 1e-5) - place(t - 1e-5)).norm() / 2e-5);
            }
        }
    }
    worst
}

#[test]
fn a_tilted_rim_touches_in_motion_and_how_fast_is_said() {
    let mut recipe = Recipe::arc(&[20.0]);
    recipe.lean = 0.2;
    let plan = recipe.plan();
    let certificate = verify(&plan, &irb120()).unwrap();
    assert_eq!(certificate.promise(RestAtWashEnds).unwrap().status, Status::Pass);
    let touch = certificate.promise(ContactSpeed).unwrap();
    let measure = touch.measure.unwrap();
    let (bound, seen) = (measure.bound.unwrap(), measure.seen.unwrap());
    let sampled = touching_speed(&plan, recipe.lean);
    assert!(sampled > 0.03, "{sampled}");
    assert!(
        sampled <= bound && bound < sampled + 3e-3 && seen <= bound && seen > sampled - 3e-3,
        "{sampled} {measure:?}"
    );
    assert_eq!(
        (touch.status, measure.limit),
        (Status::Pass, plan.limits.wash_speed_m_s)
    );
    // Where: as far below the tip as the rim reaches, which is at the plate's face.
    let place = touch.worst.place_m.unwrap();
    assert!((place[2] - plan.plates[0].z_m).abs() < 1e-3, "{place:?}");
    assert_eq!(touch.worst.plate, Some(0));
    assert!(certificate.to_string().contains("contact speed"));
    // A tool that stands upright comes to rest where it touches.
    let upright = verify(&good(), &irb120()).unwrap();
    assert!(upright.promise(ContactSpeed).unwrap().measure.unwrap().bound.unwrap() < 5e-3);
}

#[test]
fn a_sponge_that_lifts_off_faster_than_it_may_wash_is_refused() {
    let mut recipe = Recipe::arc(&[20.0]);
    recipe.lean = 0.2;
    let mut plan = recipe.plan();
    plan.scenario.wash.speed_m_s = 0.02;
    plan.limits.wash_speed_m_s = 0.02;
    let certificate = judged(plan);
    assert_eq!(broken(&certificate), [WashSpeed, ContactSpeed], "{certificate}");
    assert_eq!(certificate.promise(ContactSpeed).unwrap().status, Status::Fail);
}

#[test]
fn a_margin_beyond_the_clearance_is_found() {
    let told = breaks(&[Clearance], |p| {
        p.scenario.wash.clearance_m = 0.0215;
        p.limits.clearance_m = 0.0215;
    });
    let promise = told.promise(Clearance).unwrap();
    assert_eq!(promise.status, Status::Fail);
    assert_eq!(promise.worst.pair, Some(["link_4".to_owned(), "handle".to_owned()]));
}

#[test]
fn plates_that_overlap_fail_or_are_reported() {
    let mut recipe = Recipe::arc(&[-22.0, 22.0]);
    let certificate = verify(&recipe.plan(), &irb120()).unwrap();
    assert_eq!(broken(&certificate), [PlatesApart], "{certificate}");
    recipe.scenario.layout.overlap = Overlap::Report;
    let certificate = verify(&recipe.plan(), &irb120()).unwrap();
    assert_eq!(certificate.verdict, CertificateVerdict::Pass, "{certificate}");
    assert_eq!(certificate.promise(PlatesApart).unwrap().discrepancies.len(), 1);
    assert_eq!(certificate.exempt, [PlatesApart]);
    let expected = "CERTIFIED BUT FOR plates apart, gap between plate 0 and plate 1 -12.8 mm (waived by layout.overlap = \"report\"): ";
    assert!(certificate.to_string().starts_with(expected), "{certificate}");
}

#[test]
fn another_home_consistently_stated_is_another_motion() {
    breaks(&[HomeToHome], |p| {
        p.scenario.robot.start_deg[5] += 1.0;
        p.home_rad = p.scenario.homes();
    });
    breaks_at_least(&[HomeToHome], |p| {
        *p.knots.qd_rad_s.last_mut().unwrap() = JointVector::repeat(0.01)
    });
}
