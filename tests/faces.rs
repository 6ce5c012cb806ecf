//! Plates of every shape that ships: planned, proved, as fast as is promised, the wrist on one side and the tool in its cone; a flat plate
//! said in three ways is one; what a scenario pins is planned.

use platewash::motion::trajectory::SegmentKind;
use platewash::scenario::SHIPPED;
use platewash::workcell::random::stream;
use platewash::workcell::wash_path::PatternName;
use platewash::{Plan, RobotModel, Scenario, plan, prove};
use rand::RngExt;
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// The scenarios of plates that are not flat, and what the wash of one takes \[s\]: what is asked of the median, and a tenth.
const FACES: [(&str, f64); 4] = [
    ("coupe", 1.1 * 9.0),
    ("rim", 1.1 * 9.0),
    ("dessert", 1.1 * 5.5),
    ("deep", 1.1 * 8.6),
];

/// Layouts of one plate.
const SEEDS: std::ops::RangeInclusive<u64> = 1..=3;

/// Between two moments that are looked at \[s\].
const STEP_S: f64 = 2e-3;

/// What a moment may be off for rounding \[rad\].
const ROUNDING_RAD: f64 = 1e-9;

/// A shipped scenario with one plate.
fn one_plate(name: &str, seed: u64) -> Scenario {
    let mut scenario = Scenario::load(name).unwrap();
    scenario.seed = seed;
    scenario.layout.count = 1;
    scenario
}

/// A moment with the arm at a plate: the position of joint 5, and the angle of the tool from the normal of the face below \[rad\].
struct Moment {
    kind: SegmentKind,
    joint_5_rad: f64,
    tilt_rad: f64,
}

fn moments(plan: &Plan, robot: &RobotModel) -> Vec<Moment> {
    let (motion, plate) = (plan.knots.motion().unwrap(), &plan.job.plates[0]);
    let tip = plan.job.workcell.tool.tip_frame(robot);
    let at_plate = |kind| matches!(kind, SegmentKind::Approach | SegmentKind::Wash | SegmentKind::Retreat);
    let segments = plan.segments.iter().filter(|segment| at_plate(segment.kind));
    let within = segments.flat_map(|segment| {
        let steps = ((segment.t_end_s - segment.t_start_s) / STEP_S).ceil();
        (0..=steps as u32).map(move |k| {
            let share = f64::from(k) / steps;
            (
                segment.kind,
                segment.t_start_s + (segment.t_end_s - segment.t_start_s) * share,
            )
        })
    });
    let moment = |(kind, t_s): (SegmentKind, f64)| {
        let q = motion.at(t_s.min(plan.duration_s())).unwrap().q;
        let pose = robot.pose(&q, &tip);
        let axis = pose.rotation * nalgebra::Vector3::z();
        let normal = plate.normal_at(&pose.translation.vector);
        Moment {
            kind,
            joint_5_rad: q[4],
            tilt_rad: (-axis.dot(&normal)).clamp(-1.0, 1.0).acos(),
        }
    };
    within.map(moment).collect()
}

/// Seconds of the wash of a plan's one plate.
fn wash_s(plan: &Plan) -> f64 {
    let mut washes = plan.segments.iter().filter(|segment| segment.kind == SegmentKind::Wash);
    let wash = washes.next().unwrap();
    assert!(washes.next().is_none());
    wash.t_end_s - wash.t_start_s
}

/// Plans, proves and looks at a layout of one plate; the time of its wash \[s\].
fn washed(name: &str, seed: u64) -> f64 {
    let job = one_plate(name, seed).job().unwrap();
    let plan = plan(&job).unwrap().plan;
    let certificate = prove(&plan, job.arm()).unwrap();
    assert!(certificate.passes(), "{name}, seed {seed}: {certificate}");
    assert!(certificate.contact.len() == 1 && !plan.job.plates[0].surface.is_flat());
    let least_rad = plan.job.requirements.wrist_rad.unwrap();
    let cone_rad = plan.wash_paths[0].cone_rad;
    assert!(least_rad > 0.0 && cone_rad <= plan.job.tilt_max_rad());
    let moments = moments(&plan, job.arm());
    let side = moments[0].joint_5_rad.signum();
    for moment in &moments {
        assert!(
            side * moment.joint_5_rad >= least_rad - ROUNDING_RAD,
            "{name}, seed {seed}: joint 5 at {} rad",
            moment.joint_5_rad
        );
        // On the way down and up the normal is that of the face where the sponge lands.
        assert!(
            moment.kind != SegmentKind::Wash || moment.tilt_rad <= cone_rad + ROUNDING_RAD,
            "{name}, seed {seed}: {} rad from the normal",
            moment.tilt_rad
        );
    }
    wash_s(&plan)
}

#[test]
fn plates_of_every_shape_are_washed_as_promised() {
    for (name, most_s) in FACES {
        let mut took_s: Vec<f64> = SEEDS.into_par_iter().map(|seed| washed(name, seed)).collect();
        took_s.sort_by(f64::total_cmp);
        assert!(
            took_s[took_s.len() / 2] <= most_s,
            "{name}: {took_s:?}, {most_s} are asked"
        );
    }
}

/// A radius, a profile by name and a profile of level knots: the same plan and the same certificate, to the byte.
#[test]
fn both_statements_of_a_flat_plate_give_the_same_plan() {
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == "kitchen").unwrap();
    let radius = "plate_radius_m = 0.145";
    assert!(shipped.text.contains(radius));
    let said = |keys: &str| {
        let text = shipped.text.replace("count = 4", "count = 1").replace(radius, keys);
        let job = Scenario::parse(&text, "flat.toml").unwrap().job().unwrap();
        let plan = plan(&job).unwrap().plan;
        let certificate = prove(&plan, job.arm()).unwrap();
        assert!(
            certificate.passes() && plan.job.plates.len() == 1,
            "{keys}: {certificate}"
        );
        [plan.to_json().unwrap(), serde_json::to_string(&certificate).unwrap()]
    };
    let disc = said(radius);
    for keys in [
        "plate_profile = \"flat\"\nplate_radius_m = 0.145",
        "plate_profile = \"flat\"",
        "plate_knots = [[0.145, 0.0]]",
        "plate_knots = [[0.05, 0.0], [0.1, 0], [0.145, 0.0]]",
    ] {
        assert!(said(keys) == disc, "{keys}");
    }
    assert!(said("plate_radius_m = 0.144") != disc);
}

/// A number in a range.
fn any(random: &mut Pcg64, [least, most]: [f64; 2]) -> f64 {
    least + (most - least) * random.random::<f64>()
}

/// Whatever is pinned, nothing is promised that it might not keep.
fn promise_nothing(scenario: &mut Scenario) {
    scenario.job.required_coverage = 0.3;
    let wash = &mut scenario.wash;
    (wash.contact_share, wash.contact_time_share, wash.contact_dose_share) = (Some(0.0), Some(0.0), Some(0.0));
    (wash.contact_strain, wash.contact_force_n) = (Some(1.0), Some([0.0, 1e3]));
}

/// Whether a job with a pattern and a tilt of its own could be planned; planned, it has them.
fn is_planned_as_pinned(seed: u64) -> bool {
    let random = &mut stream(seed, "pinned");
    let name = ["kitchen", "coupe", "rim", "dessert", "deep"][random.random_range(0..5)];
    let mut scenario = one_plate(name, seed);
    promise_nothing(&mut scenario);
    let is_spiral = random.random();
    let wash = &mut scenario.wash;
    let (turns, radius_m, tilt_deg) = if is_spiral {
        wash.pattern = Some(PatternName::Spiral);
        (
            any(random, [1.5, 4.5]),
            any(random, [0.05, 0.075]),
            any(random, [1.0, 12.0]),
        )
    } else {
        wash.pattern = Some(PatternName::Rings);
        (
            f64::from(random.random_range(1..=4_u8)),
            any(random, [0.05, 0.075]),
            any(random, [1.0, 12.0]),
        )
    };
    let closing_ring = random.random();
    (wash.turns, wash.path_radius_m, wash.tilt_deg) = (Some(turns), Some(radius_m), Some(tilt_deg));
    wash.closing_ring = is_spiral.then_some(closing_ring);
    let job = scenario.job().unwrap();
    let planned = match plan(&job) {
        Ok(planned) => planned,
        Err(error) => {
            assert!(error.infeasibility().is_some(), "{name}, seed {seed}: {error}");
            return false;
        }
    };
    let path = &planned.plan.wash_paths[0];
    assert_eq!(path.curve.rings().is_none(), is_spiral, "{name}, seed {seed}");
    assert_eq!(path.curve.radius_m, radius_m, "{name}, seed {seed}");
    assert_eq!(path.cone_rad, tilt_deg.to_radians(), "{name}, seed {seed}");
    match path.curve.rings() {
        Some(rings) => assert_eq!(rings.count as f64, turns + 1.0, "{name}, seed {seed}"),
        None => assert_eq!(
            (path.curve.turns, path.curve.closing_ring),
            (turns, closing_ring),
            "{name}, seed {seed}"
        ),
    }
    let moments = moments(&planned.plan, job.arm());
    let tilt_rad = moments
        .iter()
        .filter(|m| m.kind == SegmentKind::Wash)
        .map(|m| m.tilt_rad)
        .fold(0.0, f64::max);
    assert!(
        tilt_rad <= path.cone_rad + ROUNDING_RAD,
        "{name}, seed {seed}: {tilt_rad}"
    );
    true
}

#[test]
fn a_pinned_pattern_is_planned_as_pinned() {
    let planned = (1..=20_u64)
        .into_par_iter()
        .filter(|seed| is_planned_as_pinned(*seed))
        .count();
    assert!(planned >= 12, "{planned} of 20");
}

/// How far the tool leans from the axis of the plate, on average over a wash \[rad\].
fn mean_lean_rad(axis_share: f64) -> f64 {
    let mut scenario = one_plate("coupe", 1);
    promise_nothing(&mut scenario);
    (scenario.wash.axis_share, scenario.wash.tilt_max_deg) = (Some(axis_share), 35.0);
    let job = scenario.job().unwrap();
    let plan = plan(&job).unwrap().plan;
    assert_eq!(job.terms().planner_settings().unwrap().axis_share, Some(axis_share));
    let tip = plan.job.workcell.tool.tip_frame(job.arm());
    let wash = plan
        .segments
        .iter()
        .find(|segment| segment.kind == SegmentKind::Wash)
        .unwrap();
    let inside = |t: &f64| (wash.t_start_s..=wash.t_end_s).contains(t);
    let knots = plan.knots.t_s.iter().zip(&plan.knots.q_rad).filter(|(t, _)| inside(t));
    let leans: Vec<f64> = knots
        .map(|(_, q)| {
            (-(job.arm().pose(q, &tip).rotation * nalgebra::Vector3::z()).z)
                .clamp(-1.0, 1.0)
                .acos()
        })
        .collect();
    leans.iter().sum::<f64>() / leans.len() as f64
}

/// The more of the face's slope the axis is told to take, the more it leans.
#[test]
fn the_axis_takes_the_share_of_the_slope_that_is_pinned() {
    let leans = [0.0, 0.4, 0.8].map(mean_lean_rad);
    assert!(leans.is_sorted() && leans[2] > leans[0] + 0.02, "{leans:?}");
}
