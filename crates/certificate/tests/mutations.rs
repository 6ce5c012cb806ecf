//! Every requirement is broken on purpose, the plan sealed again, and the right one must say so.

use crate::maker::{Recipe, good, irb120, resealed, tool};
use platewash_certificate::Requirement::{self, *};
use platewash_certificate::{Certificate, PairRule, Status, Verdict, prove};
use platewash_kinematics::JointVector;
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::{PlanSegment, SegmentKind};
use platewash_workcell::job::Overlap;
use platewash_workcell::surface::Surface;
use platewash_workcell::wash_path::{WashCurve, WashPath};
use platewash_workcell::{Exclusion, ExclusionReason, ReducedClearance};

fn judged(plan: Plan) -> Certificate {
    prove(&resealed(plan), &irb120()).unwrap()
}

fn broken(certificate: &Certificate) -> Vec<Requirement> {
    certificate.broken().map(|p| p.requirement).collect()
}

/// Changes the good plan, seals it, and expects exactly these requirements not to be kept.
#[track_caller]
fn breaks(expected: &[Requirement], change: impl FnOnce(&mut Plan)) -> Certificate {
    let mut plan = good();
    change(&mut plan);
    let certificate = judged(plan);
    assert_eq!(certificate.hash.status, Status::Proved);
    assert_eq!(broken(&certificate), expected, "{certificate}");
    assert_eq!(certificate.verdict, Verdict::Fail);
    certificate
}

/// The same, but others may break too.
#[track_caller]
fn breaks_at_least(expected: &[Requirement], change: impl FnOnce(&mut Plan)) -> Certificate {
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

fn span(plan: &Plan, kind: SegmentKind) -> usize {
    plan.segments.iter().position(|s| s.kind == kind).unwrap()
}

/// Knots strictly within the first segment of a kind.
fn within(plan: &Plan, kind: SegmentKind) -> std::ops::Range<usize> {
    let segment = plan.segments[span(plan, kind)];
    let knot = |t: f64| plan.knots.t_s.iter().position(|x| *x == t).unwrap();
    knot(segment.t_start_s) + 1..knot(segment.t_end_s)
}

#[test]
fn the_good_plan_passes() {
    let certificate = prove(&good(), &irb120()).unwrap();
    assert_eq!(broken(&certificate), [], "{certificate}");
    assert_eq!(certificate.verdict, Verdict::Pass);
    assert!(certificate.to_string().starts_with("PROVED"));
}

#[test]
fn harmless_edits_pass() {
    let mut plan = good();
    plan.provenance.scenario = "renamed".into();
    // A knot more, on the curve of the motion.
    let k = within(&plan, SegmentKind::Wash).start + 40;
    let motion = plan.knots.motion().unwrap();
    let t = 0.3 * plan.knots.t_s[k] + 0.7 * plan.knots.t_s[k + 1];
    let state = motion.at(t).unwrap();
    plan.knots.t_s.insert(k + 1, t);
    plan.knots.q_rad.insert(k + 1, state.q);
    plan.knots.qd_rad_s.insert(k + 1, state.qd);
    let certificate = judged(plan);
    assert_eq!(certificate.verdict, Verdict::Pass, "{certificate}");
}

#[test]
fn reports_an_edit_that_breaks_the_seal() {
    let mut plan = good();
    plan.provenance.scenario = "another".into();
    let certificate = prove(&plan, &irb120()).unwrap();
    assert_eq!(broken(&certificate), []);
    assert!(
        certificate
            .headline
            .ends_with("; the plan was changed after it was written: its hash does not match the contents"),
        "{}",
        certificate.headline
    );
    assert_eq!(
        (certificate.hash.status, certificate.verdict),
        (Status::Violated, Verdict::Fail)
    );
    plan.hash = None;
    assert_eq!(prove(&plan, &irb120()).unwrap().hash.status, Status::Violated);
}

#[test]
fn names_false_statements_of_a_plan() {
    breaks(&[Arm], |p| p.job.workcell.arm.urdf_sha256 = "0".repeat(64));
    breaks(&[Arm], |p| p.job.workcell.arm.name = "other".into());
    let told = breaks(&[Arm], |p| p.job.workcell.arm.srdf_sha256 = None);
    assert!(
        told.to_string()
            .contains("job.workcell.arm.srdf_sha256: none; expected \""),
        "{told}"
    );
    breaks(&[Tool], |p| p.job.workcell.tool.sponge.pose.translation.x += 1e-6);
    let told = breaks(&[Tool], |p| p.job.workcell.tool.sponge.height_m -= 0.004);
    let words =
        "tip of the tool: 2.0 mm from it, its axis turned by 0.000 rad; expected the middle of the sponge's far face";
    assert!(told.to_string().contains(words), "{told}");
    let told = breaks(&[Tool], |p| {
        let handle = &mut p.job.workcell.tool.bodies[0];
        handle.pose.translation.z += 0.001;
    });
    let words = "end of the body \"handle\" of the tool: 1.0 mm within the sponge; expected behind the sponge, all of which counts as foam";
    assert!(told.to_string().contains(words), "{told}");
    // A sponge that no body carries is none, and nothing would keep it clear.
    let told = breaks_at_least(&[Tool], |p| p.job.workcell.tool.bodies.clear());
    let words = "150.0 mm from it, its axis turned by 0.000 rad; expected the mounting frame, as the tool has no body";
    assert!(told.to_string().contains(words), "{told}");
}

/// Pairs that the arm and its SRDF exclude are not judged; the job must state them, and nothing else.
#[test]
fn excluded_pairs_follow_from_the_arm() {
    let told = breaks(&[Exclusions], |p| _ = p.job.workcell.exclusions.remove(0));
    let words = "exclusion of \"base_link\" and \"link_1\": not stated; expected stated, as it follows from the arm: the pair is not judged";
    assert!(told.to_string().contains(words), "{told}");
    // The order of pairs says nothing, the reason does.
    let mut plan = good();
    plan.job.workcell.exclusions.reverse();
    assert_eq!(broken(&judged(plan)), []);
    breaks(&[Exclusions], |p| {
        p.job.workcell.exclusions[0].reason = ExclusionReason::AlwaysTouching;
    });
    breaks(&[Exclusions], |p| {
        p.job.workcell.exclusions.push(leaves_out(["link_3", "no body"]))
    });
    // Pairs are left out by names: those of two bodies that have one.
    let told = breaks_at_least(&[Exclusions], |p| {
        p.job.workcell.obstacles.push(crate::maker::post("link_3"))
    });
    assert!(
        told.to_string()
            .contains("bodies named \"link_3\": more than one; expected one"),
        "{told}"
    );
}

fn leaves_out(pair: [&str; 2]) -> Exclusion {
    Exclusion {
        pair: pair.map(str::to_owned),
        reason: ExclusionReason::Srdf,
    }
}

/// A pair that the job alone leaves out is judged all the same.
#[test]
fn names_a_waived_pair_that_is_too_near() {
    let pair = ["handle", "link_4"];
    let mut plan = good();
    plan.job.workcell.exclusions.push(leaves_out(pair));
    let certificate = judged(plan.clone());
    assert_eq!(broken(&certificate), [], "{certificate}");
    assert_eq!(certificate.waived, []);
    let line = certificate
        .clearance
        .iter()
        .find(|line| line.rule == PairRule::Waived)
        .unwrap();
    assert_eq!(
        (line.status, &line.pair),
        (Status::Proved, &["link_4".to_owned(), "handle".to_owned()])
    );
    assert_eq!(certificate.rests_on.waived_pairs, [leaves_out(pair)]);
    assert!(
        format!("{certificate:#}").contains("waived        by the job: \"handle\" – \"link_4\"\n"),
        "{certificate:#}"
    );
    // Some 20 mm are there.
    plan.job.requirements.clearance_m = 0.0215;
    let certificate = judged(plan.clone());
    assert_eq!(
        (broken(&certificate), certificate.verdict),
        (vec![], Verdict::Pass),
        "{certificate}"
    );
    assert_eq!(certificate.waived, [Exclusions]);
    let words =
        "PROVED BUT FOR exclusions, \"link_4\" and \"handle\" as near as 20.8 mm (waived by the job): 2 plates in ";
    assert!(certificate.headline.starts_with(words), "{certificate}");
    let words = "  - \"link_4\" and \"handle\": as near as 20.8 mm; expected at least 21.5 mm, as neither the arm nor its SRDF leaves the pair out";
    assert!(format!("{certificate:#}").contains(words), "{certificate:#}");
    assert!(certificate.clearance.iter().any(|line| line.status == Status::Waived));
    // Without the waiver it is a violation.
    plan.job.workcell.exclusions.pop();
    assert_eq!(broken(&judged(plan)), [Clearance]);
}

/// The sponge may touch the plates that it washes, and a job may waive what it does to them at other times; the handle must keep clear.
#[test]
fn waiving_one_pair_does_not_waive_others() {
    let mut plan = good();
    plan.job.requirements.clearance_m = 0.0215;
    plan.job.workcell.exclusions.push(leaves_out(["sponge", "plate 1"]));
    let certificate = judged(plan);
    assert_eq!(broken(&certificate), [Clearance], "{certificate}");
    let rules = certificate
        .clearance
        .iter()
        .filter(|line| line.pair == ["sponge".to_owned(), "plate 1".to_owned()]);
    let rules: Vec<_> = rules.map(|line| (line.rule, line.status)).collect();
    assert_eq!(
        rules,
        [(PairRule::Waived, Status::Proved), (PairRule::Touching, Status::Proved)]
    );
}

/// The handle is never farther than some 24 mm from the forearm, and comes as near as 20.8 mm.
#[test]
fn a_pair_with_a_reduced_clearance_is_proved_on_its_own() {
    let reduced = |required_m: f64| {
        let mut plan = good();
        plan.job.requirements.clearance_m = 0.0212;
        let pair = ["handle", "link_4"].map(str::to_owned);
        let by_m = 0.0212 - required_m;
        plan.job.workcell.reduced_clearances.push(ReducedClearance {
            pair,
            by_m,
            at_stop: false,
        });
        judged(plan)
    };
    let certificate = reduced(0.015);
    assert_eq!(broken(&certificate), [], "{certificate}");
    let measure = |requirement| certificate.check(requirement).unwrap().measure.unwrap();
    let (own, all) = (measure(Requirement::ReducedClearance), measure(Clearance));
    assert_eq!(own.limit, 0.015);
    assert!(
        own.bound > Some(0.0206) && own.bound <= own.seen && own.seen < Some(0.0209),
        "{own:?}"
    );
    assert!(all.limit == 0.0212 && all.bound >= Some(0.0212), "{all:?}");
    let line = certificate
        .clearance
        .iter()
        .find(|line| line.rule == PairRule::Reduced)
        .unwrap();
    assert_eq!((line.required_m, line.status), (Some(own.limit), Status::Proved));
    let words = "clearance at least 24.9 mm (21.2 mm required), between \"link_4\" – \"handle\" at least 20.6 mm (15 mm required)";
    assert!(certificate.headline.contains(words), "{certificate}");
    let words = "less clearance 15 mm between \"handle\" – \"link_4\"\n";
    assert!(format!("{certificate:#}").contains(words), "{certificate:#}");
    assert_eq!(broken(&reduced(0.021)), [Requirement::ReducedClearance]);
}

/// An obstacle in the way of the handle, and one that is far.
#[test]
fn refuses_an_obstacle_that_is_too_near() {
    let mut plan = good();
    let mut far = crate::maker::post("far");
    far.pose.translation.x = -0.9;
    plan.job.workcell.obstacles.push(far);
    plan.job.workcell.exclusions =
        platewash_bodies::clearance::exclusions(&irb120(), &plan.job.workcell.tool, &plan.job.workcell.obstacles)
            .unwrap();
    assert_eq!(broken(&judged(plan.clone())), []);
    plan.job.workcell.obstacles[1].pose.translation.x = 0.4;
    let told = judged(plan);
    assert_eq!(broken(&told), [Clearance], "{told}");
    let worst = told.check(Clearance).unwrap().worst.pair.clone().unwrap();
    assert_eq!(worst[1], "far");
}

/// With a smaller sponge, all stated as it should be, the plates are no longer swept.
#[test]
fn a_plate_that_is_not_swept_is_not_counted_as_washed() {
    assert_eq!(prove(&good(), &irb120()).unwrap().plates_washed(), 2);
    let certificate = breaks(&[Swept], |p| p.job.workcell.tool = tool(|t| t.sponge_radius_m = 0.01));
    assert_eq!(certificate.plates_washed(), 0);
}

/// The motion is proved as before; what is asked is nonsense: the path runs over the neighbour.
#[test]
fn a_path_that_runs_over_another_plate_is_named() {
    let told = breaks_at_least(&[EveryPlateOnce], |p| {
        let radius = 0.05;
        let small = Surface::Disc { radius_m: radius };
        p.job.plates.iter_mut().for_each(|plate| plate.surface = small);
        let [a, b] = [0, 1].map(|i| p.job.plates[i].centre().xy());
        // On the way to each other, 20 mm apart.
        p.job.plates[1] = p.job.plates[1].moved_to((a + (b - a).normalize() * 0.12).into());
    });
    let said = told.check(EveryPlateOnce).unwrap();
    assert_eq!((said.status, said.discrepancies.len()), (Status::Violated, 2));
    let first = &said.discrepancies[0];
    assert_eq!(first.what, "plate 2 while plate 1 is washed");
    // 123 mm of path and 25 mm of sponge, tilted by 15°, less 50 mm of plate and 20 mm of gap.
    assert_eq!(first.stated, "swept as far as 78.9 mm over its rim");
}

#[test]
fn reports_and_limits_the_reach_of_the_sponge_beyond_each_rim() {
    let certificate = prove(&good(), &irb120()).unwrap();
    for swept in &certificate.swept {
        // 123 mm of path and 25 mm of sponge, which is upright, less 145 mm of plate, and 0.2 mm.
        assert!((swept.beyond_rim_allowed_m - 0.0032).abs() < 1e-6);
        assert!(swept.beyond_rim_seen_m > 0.0029 && swept.beyond_rim_m.unwrap() < 0.0032);
        assert!(swept.touches.is_empty());
    }
    assert!(
        format!("{certificate:#}").contains(" mm beyond the rim (allowed: 3.2"),
        "{certificate}"
    );
    // One knot moved outwards on the ring.
    breaks_at_least(&[Reach, PathDeviation], |p| {
        let k = within(p, SegmentKind::Wash).end - 40;
        p.knots.q_rad[k][1] += 0.02;
        p.knots.q_rad[k + 1][1] -= 0.02;
    });
}

/// Its side wall reaches s / cos τ from the tip at the height of the face, and lines over the ends of the path count, too.
#[test]
fn a_tilted_sponge_reaches_farther_than_its_radius() {
    let mut recipe = Recipe::arc(&[20.0]);
    recipe.lean = 0.2;
    let plan = recipe.plan();
    let certificate = prove(&plan, &irb120()).unwrap();
    assert_eq!(certificate.verdict, Verdict::Pass, "{certificate}");
    let swept = &certificate.swept[0];
    let upright = 0.123 + 0.025 - 0.145;
    // The tip may be 1 mm under the face.
    let wider = (0.025 + 0.001 * 0.2_f64.sin()) / 0.2_f64.cos() - 0.025;
    let reach = swept.beyond_rim_m.unwrap();
    assert!(reach >= upright + wider && reach < upright + wider + 2e-4, "{swept:?}");
}

/// Plates from which a neighbour is out of reach are no excuse to come near that one.
#[test]
fn only_plates_within_reach_are_touching_pairs() {
    let certificate = prove(&good(), &irb120()).unwrap();
    let touching = certificate
        .clearance
        .iter()
        .filter(|line| line.rule == PairRule::Touching);
    let touching: Vec<_> = touching
        .map(|line| (line.pair[1].as_str(), &line.working_on[..]))
        .collect();
    assert_eq!(touching, [("plate 1", &[0][..]), ("plate 2", &[1])]);
    let near = prove(&Recipe::arc(&[-23.5, 23.5]).plan(), &irb120()).unwrap();
    let line = near
        .clearance
        .iter()
        .find(|line| line.rule == PairRule::Touching)
        .unwrap();
    assert_eq!(line.working_on, [0, 1]);
}

/// Contact speed and depth are bounded up to the face being worked on: the sponge keeps clear of a plate that is higher, if only by a
/// micron.
#[test]
fn the_sponge_keeps_clear_of_a_higher_neighbour() {
    let mut plan = Recipe::arc(&[-23.5, 23.5]).plan();
    plan.job.plates[1].pose.translation.z += 1e-6;
    let certificate = judged(plan);
    let touching = certificate
        .clearance
        .iter()
        .filter(|line| line.rule == PairRule::Touching);
    let touching: Vec<_> = touching
        .map(|line| (line.pair[1].as_str(), &line.working_on[..]))
        .collect();
    assert_eq!(touching, [("plate 1", &[0, 1][..]), ("plate 2", &[1])]);
    assert!(broken(&certificate).contains(&Clearance), "{certificate}");
    assert!(
        certificate
            .swept
            .iter()
            .all(|plate| plate.touches.iter().all(|other| other.plate == 0))
    );
}

#[test]
fn refuses_a_tool_whose_tip_leaves_the_path() {
    breaks_at_least(&[PathDeviation, LineDeviation, ContactHeight], |p| {
        p.job.workcell.tool = tool(|t| t.length_m = 0.16);
    });
}

#[test]
fn moved_plates_are_not_washed() {
    // By half the tolerance: the tip is still where it should be, and the job is another one.
    let by = |p: &mut Plan, way_m: f64| p.job.plates[0].pose.translation.x += way_m;
    let mut plan = good();
    by(&mut plan, 1e-4);
    let found = platewash_certificate::differences(&plan.job, &good().job);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].key, "plates[0].pose.position_m[0]");
    assert_eq!(broken(&judged(plan)), []);
    breaks(&[PathDeviation, Reach], |p| by(p, 3e-4));
    breaks_at_least(&[PathDeviation, LineDeviation, Reach, Swept], |p| by(p, 0.03));
    breaks_at_least(&[ContactHeight, PathDeviation], |p| {
        p.job.plates[0].pose.translation.z -= 1e-3
    });
}

/// The wash path is free to choose, but the tip must follow the stated one, and the lines must stand over the ends of the curve.
#[test]
fn the_wash_path_stated_must_be_followed() {
    let edit = |p: &mut Plan, change: fn(&mut WashCurve)| change(&mut p.wash_paths[0].curve);
    breaks_at_least(&[PathDeviation], |p| edit(p, |c| c.radius_m -= 0.003));
    breaks_at_least(&[PathDeviation], |p| edit(p, |c| c.turns += 0.5));
    breaks(&[PathDeviation], |p| edit(p, |c| c.closing_ring = false));
    breaks(&[PathDeviation, LineDeviation], |p| {
        edit(p, |c| c.start_angle_rad += 0.1)
    });
    breaks(&[LineDeviation], |p| p.wash_paths[0].lift_m -= 0.01);
}

#[test]
fn names_invalid_wash_paths() {
    type Change = fn(&mut WashPath);
    let changes: [(&str, Change); 10] = [
        ("curve.radius_m: 0; expected from 0.0001 to 10", |w| {
            w.curve.radius_m = 0.0
        }),
        ("curve.radius_m: NaN", |w| w.curve.radius_m = f64::NAN),
        ("curve.turns: 0.2; expected from 0.25 to 200", |w| w.curve.turns = 0.2),
        ("curve.turns: 1000000000000", |w| w.curve.turns = 1e12),
        ("curve.trim_rad: 2; expected from 0 to 1.5", |w| w.curve.trim_rad = 2.0),
        ("length of the curve: 125", |w| {
            (w.curve.radius_m, w.curve.turns) = (1.0, 38.0)
        }),
        ("curve.start_angle_rad: 7", |w| w.curve.start_angle_rad = 7.0),
        ("lift_m: -0.05", |w| w.lift_m = -0.05),
        ("lift_m: inf", |w| w.lift_m = f64::INFINITY),
        ("cone_rad: 0.27; expected from 0 to 0.2617", |w| w.cone_rad = 0.27),
    ];
    for (words, change) in changes {
        let mut plan = good();
        change(&mut plan.wash_paths[1]);
        // Not all of them can be sealed.
        let certificate = prove(&plan, &irb120()).unwrap();
        let found = broken(&certificate);
        for name in [WashPaths, PathDeviation, LineDeviation, Reach] {
            assert!(found.contains(&name), "{words}\n{certificate}");
        }
        assert_eq!(certificate.check(PathDeviation).unwrap().status, Status::NotProved);
        let told = certificate.to_string();
        assert!(told.contains(&format!("wash_paths[1]: {words}")), "{words}\n{told}");
    }
    breaks_at_least(&[WashPaths, PathDeviation], |p| _ = p.wash_paths.pop());
    breaks(&[WashPaths], |p| p.wash_paths.push(p.wash_paths[0]));
    let told = breaks(&[WashPaths], |p| p.wash_paths.swap(0, 1));
    assert!(
        told.to_string()
            .contains("wash_paths[0].plate: 1; expected 0, as order[0] says"),
        "{told}"
    );
    breaks_at_least(&[WashPaths], |p| p.wash_paths[1].plate = usize::MAX >> 11);
}

#[test]
fn a_smaller_wash_path_leaves_the_rim_unswept() {
    let mut recipe = Recipe::arc(&[20.0]);
    recipe.curve.radius_m = 0.112;
    let certificate = prove(&recipe.plan(), &irb120()).unwrap();
    assert_eq!(broken(&certificate), [Swept], "{certificate}");
    let coverage = certificate.check(Swept).unwrap();
    assert_eq!(
        coverage.status,
        Status::Violated,
        "proved to be too little, not merely unproved"
    );
}

#[test]
fn a_moved_knot_breaks_joint_limits_and_the_wash_path() {
    breaks_at_least(&[PathDeviation], |p| {
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
fn refuses_a_wash_that_runs_backwards() {
    let told = breaks_at_least(&[PathDeviation], |p| {
        let washing = within(p, SegmentKind::Wash);
        let (from, to) = (washing.start + 300, washing.start + 340);
        p.knots.q_rad[from..to].reverse();
        p.knots.qd_rad_s[from..to].reverse();
        p.knots.qd_rad_s[from..to].iter_mut().for_each(|v| *v = -*v);
    });
    assert_eq!(told.check(PathDeviation).unwrap().status, Status::Violated);
}

#[test]
fn refuses_a_motion_in_less_time() {
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
    breaks_at_least(&[Segments], |p| p.segments.insert(2, p.segments[2]));
    breaks_at_least(&[Segments], |p| p.segments[2].kind = SegmentKind::Transit);
    breaks_at_least(&[Segments], |p| p.segments[2].plate = 1);
    breaks_at_least(&[Segments], |p| {
        p.segments.last_mut().unwrap().plate = 1_000_000_000_000_000
    });
    breaks_at_least(&[Segments], |p| p.segments[2].t_end_s += 1e-6);
    breaks_at_least(&[Segments], |p| p.segments[4].t_start_s -= 1e-6);
    breaks_at_least(&[Segments], |p| p.segments.last_mut().unwrap().t_end_s = 1e300);
    breaks_at_least(&[Segments, WashPaths], |p| p.order.swap(0, 1));
    breaks_at_least(&[Segments, EveryPlateOnce], |p| p.order[1] = 0);
    breaks_at_least(&[Segments, EveryPlateOnce], |p| p.order.push(7));
    // The boundary of a wash a knot later: the arm does not rest there and the line has not ended.
    breaks_at_least(&[RestAtWashEnds], |p| {
        let (wash, knot) = (span(p, SegmentKind::Wash), within(p, SegmentKind::Wash).start + 5);
        p.segments[wash].t_start_s = p.knots.t_s[knot];
        p.segments[wash - 1].t_end_s = p.knots.t_s[knot];
    });
}

#[test]
fn judges_the_tilt_against_the_requirement() {
    let mut recipe = Recipe::arc(&[20.0]);
    recipe.lean = 0.1;
    let plan = recipe.plan();
    let certificate = prove(&plan, &irb120()).unwrap();
    let tilt = certificate.check(Tilt).unwrap();
    let bound = tilt.measure.unwrap().bound.unwrap();
    assert_eq!(tilt.status, Status::Proved);
    assert!((0.1..0.1005).contains(&bound), "{bound}");
    let mut strict = plan;
    strict.job.requirements.tilt_rad = 5.0_f64.to_radians();
    strict.wash_paths[0].cone_rad = strict.job.tilt_max_rad();
    assert_eq!(broken(&judged(strict)), [Tilt]);
}

/// 6.04 mm high and 25 mm in radius: h/s is the sine of 13.98° and the tangent of 13.58°. At 13.78° the rim at the handle is 0.09 mm
/// inside the plate.
#[test]
fn refuses_a_tilt_beyond_the_upper_rim_of_the_sponge() {
    let mut recipe = Recipe::arc(&[20.0]);
    recipe.lean = 0.2405;
    let tilt = |recipe: &Recipe| prove(&recipe.plan(), &irb120()).unwrap().check(Tilt).unwrap().clone();
    let rim_m = |height_m: f64| height_m * recipe.lean.cos() - 0.025 * recipe.lean.sin();
    for (height_m, status) in [(6.04e-3, Status::Violated), (6.14e-3, Status::Proved)] {
        assert_eq!(rim_m(height_m) > 0.0, status == Status::Proved);
        let mut recipe = recipe.clone();
        recipe.terms.workcell.tool = tool(|t| t.sponge_height_m = height_m);
        assert_eq!(tilt(&recipe).status, status, "{height_m}");
    }
}

/// Contact speed: that of the lowest point of the rim of a tool that leans forward by an angle, at the worst of many moments at which it is
/// at or below the plate \[m/s\], from differences.
fn contact_speed(plan: &Plan, lean: f64) -> f64 {
    let robot = irb120();
    let tool = &plan.job.workcell.tool;
    let tip = tool.tip_frame(&robot);
    let motion = plan.knots.motion().unwrap();
    let place = |t: f64| robot.fk(&motion.at(t).unwrap().q).rigid(&tip).translation;
    let lines = |s: &&PlanSegment| matches!(s.kind, SegmentKind::Approach | SegmentKind::Retreat);
    let mut worst = 0.0f64;
    for segment in plan.segments.iter().filter(lines) {
        let (from, to) = (segment.t_start_s, segment.t_end_s);
        for t in (1..4000).map(|k| from + (to - from) * f64::from(k) / 4000.0) {
            let reach = tool.sponge.radius_m * lean.sin();
            if place(t).z - reach <= plan.job.plates[segment.plate].centre().z - 1e-6 {
                worst = worst.max((place(t + 1e-5) - place(t - 1e-5)).norm() / 2e-5);
            }
        }
    }
    worst
}

#[test]
fn reports_the_contact_speed_of_a_tilted_rim() {
    let mut recipe = Recipe::arc(&[20.0]);
    recipe.lean = 0.2;
    let plan = recipe.plan();
    let certificate = prove(&plan, &irb120()).unwrap();
    assert_eq!(certificate.check(RestAtWashEnds).unwrap().status, Status::Proved);
    let touch = certificate.check(ContactSpeed).unwrap();
    let measure = touch.measure.unwrap();
    let (bound, seen) = (measure.bound.unwrap(), measure.seen.unwrap());
    let sampled = contact_speed(&plan, recipe.lean);
    assert!(sampled > 0.03, "{sampled}");
    assert!(
        sampled <= bound && bound < sampled + 3e-3 && seen <= bound && seen > sampled - 3e-3,
        "{sampled} {measure:?}"
    );
    assert_eq!(
        (touch.status, measure.limit),
        (Status::Proved, plan.job.wash_speed_m_s())
    );
    // The position is as far below the tip as the rim reaches, which is at the plate's face.
    let place = touch.worst.place_m.unwrap();
    assert!((place[2] - plan.job.plates[0].centre().z).abs() < 1e-3, "{place:?}");
    assert_eq!(touch.worst.plate, Some(0));
    assert!(format!("{certificate:#}").contains("contact speed"));
    // A tool that stands upright comes to rest where it touches.
    let upright = prove(&good(), &irb120()).unwrap();
    assert!(upright.check(ContactSpeed).unwrap().measure.unwrap().bound.unwrap() < 5e-3);
}

#[test]
fn refuses_a_sponge_that_lifts_off_too_fast() {
    let mut recipe = Recipe::arc(&[20.0]);
    recipe.lean = 0.2;
    let mut plan = recipe.plan();
    plan.job.requirements.wash_speed_m_s = 0.02;
    let certificate = judged(plan);
    assert_eq!(broken(&certificate), [WashSpeed, ContactSpeed], "{certificate}");
    assert_eq!(certificate.check(ContactSpeed).unwrap().status, Status::Violated);
}

#[test]
fn a_margin_beyond_the_clearance_is_found() {
    let told = breaks(&[Clearance], |p| p.job.requirements.clearance_m = 0.0215);
    let check = told.check(Clearance).unwrap();
    assert_eq!(check.status, Status::Violated);
    assert_eq!(check.worst.pair, Some(["link_4".to_owned(), "handle".to_owned()]));
}

#[test]
fn plates_that_overlap_fail_or_are_reported() {
    let mut recipe = Recipe::arc(&[-22.0, 22.0]);
    let certificate = prove(&recipe.plan(), &irb120()).unwrap();
    assert_eq!(broken(&certificate), [PlatesApart], "{certificate}");
    recipe.terms.requirements.overlap = Overlap::Report;
    let certificate = prove(&recipe.plan(), &irb120()).unwrap();
    assert_eq!(certificate.verdict, Verdict::Pass, "{certificate}");
    assert_eq!(certificate.check(PlatesApart).unwrap().discrepancies.len(), 1);
    assert_eq!(certificate.waived, [PlatesApart]);
    let expected = "PROVED BUT FOR plates apart, gap between plate 1 and plate 2 -12.8 mm (waived by the job): ";
    assert!(certificate.to_string().starts_with(expected), "{certificate}");
}

#[test]
fn refuses_a_motion_between_other_homes() {
    breaks(&[HomeToHome], |p| p.job.home_rad[0][5] += 0.01);
    breaks(&[HomeToHome], |p| p.job.home_rad[1][3] += 0.1);
    breaks_at_least(&[HomeToHome], |p| {
        *p.knots.qd_rad_s.last_mut().unwrap() = JointVector::repeat(0.01)
    });
}
