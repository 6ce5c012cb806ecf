//! What a plan says of contact, of paths along a face and of faces that are not flat, edited field by field: refused by the requirement that the
//! field concerns, refused as no plan, or kept for a reason.

use crate::mutation::edit::scenario;
use nalgebra::Vector3;
use platewash::certificate::Requirement::{
    self, ContactDose, ContactForce, ContactHeight, ContactSpeed, ContactTime, PathDeviation, PlateStays, Plates,
    Pressed, Strain, Swept, Tilt, Tool, WashPaths, WashSpeed, Wrist,
};
use platewash::certificate::{Certificate, Status, prove};
use platewash::motion::trajectory::SegmentKind;
use platewash::workcell::job::{ContactRequirements, FixtureTerms, HolderTerms, Planner, PlannerSettings, RingTerms};
use platewash::workcell::plate::Foot;
use platewash::workcell::simulation::FoamContact;
use platewash::workcell::surface::Knot;
use platewash::workcell::tool::Sponge;
use platewash::workcell::wash_path::{PatternName, WashPattern};
use platewash::workcell::wash_path::{Rings, WashCurve};
use platewash::{Plan, RobotModel, Surface, plan};
use rayon::prelude::*;
use serde_json::Value;
use std::collections::BTreeSet;
use std::sync::LazyLock;

/// What comes of an edit.
enum Outcome {
    /// These requirements are refused, and no others.
    Refused(&'static [Requirement]),
    /// These are refused, with others that follow from them.
    Breaks(&'static [Requirement]),
    /// There is nothing to judge: an error that names this.
    NoPlan(&'static str),
    /// It is proved all the same, because …
    Kept(&'static str),
}
use Outcome::{Breaks, Kept, NoPlan, Refused};

/// The field of the plan, what comes of its edit, the edit.
struct Case(&'static str, Outcome, fn(&mut Plan));

const LESS: &str = "it asks for less: what a job asks for is compared with its scenario (`--against`), not judged";
const PLANNED: &str = "it says how was planned, and no requirement rests on it";
const SIMULATED: &str = "no proof rests on a simulation";

/// Edits of `kitchen`, seed 1, with one plate: flat, rings, contact promised.
const KITCHEN: [Case; 74] = [
    Case("job.requirements.contact", Kept(LESS), |p| {
        p.job.requirements.contact = None
    }),
    Case(
        "job.requirements.contact.compression_m",
        Refused(&[Pressed, ContactTime, ContactDose]),
        |p| wanted(p).compression_m = 5e-3,
    ),
    Case("job.requirements.contact.compression_m", Kept(LESS), |p| {
        wanted(p).compression_m = 0.0
    }),
    Case("job.requirements.contact.compression_m", NoPlan("compression_m"), |p| {
        wanted(p).compression_m = -1e-3
    }),
    Case(
        "job.requirements.contact.height_error_m",
        Refused(&[ContactSpeed, Pressed, ContactTime, ContactDose, ContactForce]),
        |p| wanted(p).height_error_m = 5.2e-3,
    ),
    Case("job.requirements.contact.height_error_m", Kept(LESS), |p| {
        wanted(p).height_error_m = 0.0
    }),
    Case(
        "job.requirements.contact.height_error_m",
        NoPlan("height_error_m"),
        |p| wanted(p).height_error_m = f64::NAN,
    ),
    Case("job.requirements.contact.share", Refused(&[Pressed]), |p| {
        wanted(p).share = 0.9996
    }),
    Case("job.requirements.contact.share", Kept(LESS), |p| wanted(p).share = 0.0),
    Case("job.requirements.contact.share", NoPlan("contact.share"), |p| {
        wanted(p).share = 1.01
    }),
    Case("job.requirements.contact.strain", Refused(&[Strain]), |p| {
        wanted(p).strain = 0.25
    }),
    Case("job.requirements.contact.strain", Kept(LESS), |p| {
        wanted(p).strain = 1.0
    }),
    Case("job.requirements.contact.strain", NoPlan("strain"), |p| {
        wanted(p).strain = f64::INFINITY
    }),
    Case("job.requirements.contact.force_n", Refused(&[ContactForce]), |p| {
        wanted(p).force_n[0] = 4.0
    }),
    Case("job.requirements.contact.force_n", Refused(&[ContactForce]), |p| {
        wanted(p).force_n[1] = 20.0
    }),
    Case("job.requirements.contact.force_n", Kept(LESS), |p| {
        wanted(p).force_n = [0.0, 1e3]
    }),
    Case("job.requirements.contact.force_n", NoPlan("force_n"), |p| {
        wanted(p).force_n = [40.0, 1.0]
    }),
    Case("job.requirements.contact.time_s", Refused(&[ContactTime]), |p| {
        wanted(p).time_s = 0.1
    }),
    Case("job.requirements.contact.time_s", Kept(LESS), |p| {
        wanted(p).time_s = 0.0
    }),
    Case("job.requirements.contact.time_share", Refused(&[ContactTime]), |p| {
        wanted(p).time_share = 0.9999
    }),
    Case("job.requirements.contact.time_share", Kept(LESS), |p| {
        wanted(p).time_share = 0.0
    }),
    Case("job.requirements.contact.dose_pa_m", Refused(&[ContactDose]), |p| {
        wanted(p).dose_pa_m = 60.0
    }),
    Case("job.requirements.contact.dose_pa_m", Kept(LESS), |p| {
        wanted(p).dose_pa_m = 0.0
    }),
    Case("job.requirements.contact.dose_share", Refused(&[ContactDose]), |p| {
        wanted(p).dose_share = 0.995
    }),
    Case("job.requirements.contact.dose_share", Kept(LESS), |p| {
        wanted(p).dose_share = 0.0
    }),
    Case("job.requirements.landing_m_s", Refused(&[ContactSpeed]), |p| {
        p.job.requirements.landing_m_s = Some(0.04)
    }),
    Case("job.requirements.landing_m_s", Kept(LESS), |p| {
        p.job.requirements.landing_m_s = None
    }),
    Case("job.requirements.landing_m_s", NoPlan("landing_m_s"), |p| {
        p.job.requirements.landing_m_s = Some(0.0)
    }),
    Case("job.requirements.lifting_m_s", Refused(&[ContactSpeed]), |p| {
        p.job.requirements.lifting_m_s = Some(0.04)
    }),
    Case("job.requirements.lifting_m_s", Kept(LESS), |p| {
        p.job.requirements.lifting_m_s = Some(1.0)
    }),
    Case("job.requirements.wrist_rad", Refused(&[Wrist]), |p| {
        p.job.requirements.wrist_rad = Some(0.25)
    }),
    Case("job.requirements.wrist_rad", Kept(LESS), |p| {
        p.job.requirements.wrist_rad = None
    }),
    Case("job.requirements.wrist_rad", NoPlan("wrist_rad"), |p| {
        p.job.requirements.wrist_rad = Some(2.0)
    }),
    Case(
        "job.requirements.holder",
        Kept("what holds the plate takes the load"),
        |p| holder(p, Some([21.0, 2.7]), None),
    ),
    Case("job.requirements.holder.fixture.force_n", Refused(&[PlateStays]), |p| {
        holder(p, Some([20.0, 2.7]), None)
    }),
    Case(
        "job.requirements.holder.fixture.torque_nm",
        Refused(&[PlateStays]),
        |p| holder(p, Some([21.0, 2.3]), None),
    ),
    Case("job.requirements.holder.fixture.force_n", NoPlan("force_n"), |p| {
        holder(p, Some([f64::NAN, 2.7]), None)
    }),
    Case("job.requirements.holder.ring", Refused(&[PlateStays]), |p| {
        holder(p, None, Some([0.5, 0.1]))
    }),
    Case("job.requirements.holder.ring.radius_m", NoPlan("radius_m"), |p| {
        holder(p, None, Some([0.5, 0.2]))
    }),
    Case("job.requirements.holder.ring", NoPlan("not both"), |p| {
        holder(p, Some([21.0, 2.7]), Some([0.5, 0.1]))
    }),
    Case("job.requirements.holder", NoPlan("needs requirements.contact"), |p| {
        holder(p, Some([21.0, 2.7]), None);
        p.job.requirements.contact = None;
    }),
    // Foam as stiff as that presses with more than 40 N; as soft, with less than 1 N and with half the dose.
    Case("job.workcell.tool.sponge.stiffness_pa", Refused(&[ContactForce]), |p| {
        sponge(p).stiffness_pa = Some([11e3, 90e3])
    }),
    Case(
        "job.workcell.tool.sponge.stiffness_pa",
        Refused(&[ContactDose, ContactForce]),
        |p| sponge(p).stiffness_pa = Some([2.9e3, 44e3]),
    ),
    Case(
        "job.workcell.tool.sponge.stiffness_pa",
        Kept("a narrower range: the tool is the job's to state, and what is proved for the wider one holds"),
        |p| sponge(p).stiffness_pa = Some([15e3, 40e3]),
    ),
    Case("job.workcell.tool.sponge.stiffness_pa", NoPlan("stiffness_pa"), |p| {
        sponge(p).stiffness_pa = None
    }),
    Case("job.workcell.tool.sponge.stiffness_pa", NoPlan("stiffness_pa"), |p| {
        sponge(p).stiffness_pa = Some([44e3, 11e3])
    }),
    // Pressed in less, it gets less; more, it is longer where it is free, and its rim is on the plate while the arm is still fast.
    Case(
        "job.workcell.tool.sponge.compression_m",
        Breaks(&[Pressed, ContactTime, ContactDose]),
        |p| sponge(p).compression_m = 3e-3,
    ),
    Case("job.workcell.tool.sponge.compression_m", Breaks(&[ContactSpeed]), |p| {
        sponge(p).compression_m = 12e-3
    }),
    Case(
        "job.workcell.tool.sponge.radius_m",
        Breaks(&[Swept, Pressed, ContactDose]),
        |p| sponge(p).radius_m = 0.022,
    ),
    Case("job.workcell.tool.sponge.height_m", Breaks(&[Tool]), |p| {
        sponge(p).height_m += 1e-3
    }),
    Case("job.workcell.tool.sponge.pose", Refused(&[Tool]), |p| {
        sponge(p).pose.translation.z += 1e-5
    }),
    Case("wash_paths[].curve.rings", Breaks(&[PathDeviation]), |p| {
        curve(p).pattern = WashPattern::Spiral
    }),
    Case("wash_paths[].curve.rings.count", Breaks(&[PathDeviation]), |p| {
        rings(p).count = 4
    }),
    Case("wash_paths[].curve.rings.count", Breaks(&[WashPaths]), |p| {
        rings(p).count = 1
    }),
    Case("wash_paths[].curve.rings.inner_m", Breaks(&[PathDeviation]), |p| {
        rings(p).inner_m += 1e-3
    }),
    Case("wash_paths[].curve.rings.inner_m", Breaks(&[WashPaths]), |p| {
        rings(p).inner_m = 0.2
    }),
    Case("wash_paths[].curve.rings.lead_rad", Breaks(&[PathDeviation]), |p| {
        rings(p).lead_rad += 0.05
    }),
    Case("wash_paths[].curve.rings.lead_rad", Breaks(&[WashPaths]), |p| {
        rings(p).lead_rad = 7.0
    }),
    Case("wash_paths[].curve.rings.blend_rad", Breaks(&[PathDeviation]), |p| {
        rings(p).blend_rad += 0.05
    }),
    Case("wash_paths[].curve.rings.blend_rad", Breaks(&[WashPaths]), |p| {
        rings(p).blend_rad = 0.0
    }),
    Case("wash_paths[].curve.radius_m", Breaks(&[PathDeviation]), |p| {
        curve(p).radius_m -= 5e-4
    }),
    Case("wash_paths[].curve.closing_ring", Breaks(&[PathDeviation]), |p| {
        curve(p).closing_ring = false
    }),
    Case("wash_paths[].curve.trim_rad", Breaks(&[PathDeviation]), |p| {
        curve(p).trim_rad = 0.0
    }),
    Case("wash_paths[].curve.trim_rad", Breaks(&[WashPaths]), |p| {
        curve(p).trim_rad = 2.0
    }),
    Case("wash_paths[].curve.start_angle_rad", Breaks(&[PathDeviation]), |p| {
        curve(p).start_angle_rad += 0.05
    }),
    Case(
        "wash_paths[].curve.turns",
        Kept("rings say themselves how far round they go: the curve is the same"),
        |p| curve(p).turns = 3.0,
    ),
    Case("wash_paths[].cone_rad", Refused(&[Tilt]), |p| {
        p.wash_paths[0].cone_rad = 0.078
    }),
    Case(
        "job.plates[].foot",
        Kept("below the plate, over the floor, where nothing comes"),
        |p| p.job.plates[0].foot = Some(FOOT),
    ),
    Case("job.plates[].foot", Refused(&[Plates]), |p| {
        p.job.plates[0].foot = Some(Foot { height_m: 0.4, ..FOOT })
    }),
    Case("job.plates[].foot", NoPlan("plate 1"), |p| {
        p.job.plates[0].foot = Some(Foot { radius_m: 0.2, ..FOOT })
    }),
    Case("job.planner.wash.pattern", Kept(PLANNED), |p| {
        settings(p).pattern = Some(PatternName::Spiral)
    }),
    Case("job.planner.wash.tilt_rad", Kept(PLANNED), |p| {
        settings(p).tilt_rad = Some(0.01)
    }),
    Case("job.planner.wash.axis_share", Kept(PLANNED), |p| {
        settings(p).axis_share = Some(0.9)
    }),
    Case("job.simulation.plant.contact", Kept(SIMULATED), |p| {
        p.job.simulation.plant.contact = Some(FoamContact {
            stiffness_pa: 2e4,
            damping_pa_s: 1.0,
        })
    }),
];

/// Edits of `rim`, seed 1, with one plate: a face that is not flat.
const RIM: [Case; 7] = [
    // The wall rises steeper, or begins farther out.
    Case(
        "job.plates[].surface.knots[].slope_rad",
        Breaks(&[ContactHeight, PathDeviation]),
        |p| knots(p, |k| k[1].slope_rad += 0.1),
    ),
    Case(
        "job.plates[].surface.knots[].radius_m",
        Breaks(&[ContactHeight, PathDeviation]),
        |p| knots(p, |k| k[1].radius_m += 2e-3),
    ),
    Case("job.plates[].surface.knots[]", Breaks(&[PathDeviation]), |p| {
        p.job.plates[0].surface = Surface::Disc { radius_m: 0.135 }
    }),
    Case(
        "job.plates[].thickness_m",
        Kept("below the face, over the floor, where nothing comes"),
        |p| p.job.plates[0].thickness_m += 2e-3,
    ),
    Case(
        "job.plates[].foot",
        Kept("below the plate, over the floor, where nothing comes"),
        |p| p.job.plates[0].foot = Some(FOOT),
    ),
    Case("job.plates[].pose", Breaks(&[ContactHeight]), |p| {
        p.job.plates[0].pose.translation.z += 5e-4
    }),
    Case("job.requirements.tilt_rad", Breaks(&[Tilt]), |p| {
        p.job.requirements.tilt_rad = 20_f64.to_radians();
        p.wash_paths
            .iter_mut()
            .for_each(|path| path.cone_rad = 20_f64.to_radians());
    }),
];

const FOOT: Foot = Foot {
    radius_m: 0.08,
    height_m: 9e-3,
};

fn wanted(plan: &mut Plan) -> &mut ContactRequirements {
    plan.job.requirements.contact.as_mut().unwrap()
}

/// States a fixture by its force and torque, or a ring by its friction and radius.
fn holder(plan: &mut Plan, fixture: Option<[f64; 2]>, ring: Option<[f64; 2]>) {
    plan.job.requirements.holder = Some(HolderTerms {
        sponge_friction: 1.0,
        plate_mass_kg: Some(0.6),
        fixture: fixture.map(|[force_n, torque_nm]| FixtureTerms { force_n, torque_nm }),
        ring: ring.map(|[friction, radius_m]| RingTerms { friction, radius_m }),
    });
}

fn sponge(plan: &mut Plan) -> &mut Sponge {
    &mut plan.job.workcell.tool.sponge
}

fn curve(plan: &mut Plan) -> &mut WashCurve {
    &mut plan.wash_paths[0].curve
}

fn rings(plan: &mut Plan) -> &mut Rings {
    match &mut curve(plan).pattern {
        WashPattern::Rings(rings) => rings,
        WashPattern::Spiral => panic!("a spiral has no rings"),
    }
}

fn settings(plan: &mut Plan) -> &mut PlannerSettings {
    match &mut plan.job.planner {
        Planner::Wash(settings) => settings,
        Planner::Paper(_) => panic!("the job is one of a washing"),
    }
}

fn knots(plan: &mut Plan, change: fn(&mut [Knot])) {
    let Surface::Profile(meridian) = plan.job.plates[0].surface else {
        panic!("a profile")
    };
    let mut knots = meridian.knots().to_vec();
    change(&mut knots);
    plan.job.plates[0].surface = Surface::profile(&knots).unwrap();
}

struct PlannedCell {
    plan: Plan,
    robot: RobotModel,
}

static PLANS: LazyLock<[PlannedCell; 2]> = LazyLock::new(|| {
    ["kitchen", "rim"].map(|name| {
        let mut scenario = scenario((name, 1));
        // What costs time is the proof of every edit: of one plate it costs a quarter.
        scenario.layout.count = 1;
        let job = scenario.job().unwrap();
        let robot = job.arm().clone();
        PlannedCell {
            plan: plan(&job).unwrap().plan,
            robot,
        }
    })
});

fn refused(certificate: &Certificate) -> Vec<Requirement> {
    certificate.broken().map(|check| check.requirement).collect()
}

/// What is wrong with the outcome of a case.
fn complaint(Case(field, outcome, change): &Case, good: &PlannedCell) -> Option<String> {
    let mut plan = good.plan.clone();
    change(&mut plan);
    // Whatever is changed, the hash says so; and nothing else says so where there is a number that JSON has none for.
    let seal = plan.seal().ok();
    if seal.is_some() && seal == good.plan.hash {
        return Some(format!("{field}: the hash stays"));
    }
    plan.hash = seal;
    let found = prove(&plan, &good.robot);
    let names = found.as_ref().map(refused);
    let right = match (outcome, &names) {
        (Refused(wanted), Ok(names)) => names == wanted,
        (Breaks(wanted), Ok(names)) => wanted.iter().all(|name| names.contains(name)),
        (NoPlan(word), Err(error)) => error.to_string().contains(word),
        (Kept(reason), Ok(names)) => names.is_empty() && !reason.is_empty(),
        _ => false,
    };
    let found = names.map_err(ToString::to_string);
    (!right).then(|| format!("{field}: {found:?}"))
}

#[test]
fn a_field_of_contact_that_is_edited_is_refused_or_kept_for_a_reason() {
    let [kitchen, rim] = &*PLANS;
    let of_kitchen = KITCHEN.par_iter().map(|case| (case, kitchen));
    let of_rim = RIM.par_iter().map(|case| (case, rim));
    let complaints: Vec<_> = of_kitchen
        .chain(of_rim)
        .filter_map(|(c, good)| complaint(c, good))
        .collect();
    assert!(complaints.is_empty(), "{complaints:#?}");
}

/// A plan whose fields were edited and whose hash was left as it was.
#[test]
fn an_edit_without_a_seal_is_found_by_the_hash() {
    let good = &PLANS[0];
    let mut plan = good.plan.clone();
    wanted(&mut plan).share = 0.9;
    let certificate = prove(&plan, &good.robot).unwrap();
    assert_eq!(certificate.hash.status, Status::Violated);
    assert!(!certificate.passes() && refused(&certificate).is_empty());
}

/// The paths of all that is neither a list nor an object in a value, list indices left out.
fn leaves(value: &Value, path: &str, all: &mut BTreeSet<String>) {
    match value {
        Value::Object(fields) => fields
            .iter()
            .for_each(|(key, value)| leaves(value, &format!("{path}.{key}"), all)),
        _ => _ = all.insert(path.to_owned()),
    }
}

/// No field of what the tables are about is left out of them, and each has an edit that is not kept.
#[test]
fn every_field_of_contact_has_its_edits() {
    let plan = serde_json::to_value(&PLANS[0].plan).unwrap();
    let mut fields = BTreeSet::new();
    for (path, name) in [
        ("/job/requirements/contact", "job.requirements.contact"),
        ("/job/workcell/tool/sponge", "job.workcell.tool.sponge"),
        ("/wash_paths/0/curve", "wash_paths[].curve"),
    ] {
        leaves(plan.pointer(path).unwrap(), name, &mut fields);
    }
    let asked = plan.pointer("/job/requirements").unwrap();
    for key in ["landing_m_s", "lifting_m_s", "wrist_rad"] {
        assert!(asked.get(key).is_some(), "{key}");
        fields.insert(format!("job.requirements.{key}"));
    }
    assert!(fields.len() >= 20, "{fields:?}");
    for field in &fields {
        let is_about = |case: &&Case| field.starts_with(case.0) && !matches!(case.1, Kept(_));
        let named = KITCHEN
            .iter()
            .filter(is_about)
            .any(|case| case.0 == field || case.0.ends_with("pose"));
        let same_curve = field == "wash_paths[].curve.turns";
        assert!(named || same_curve, "{field} has no edit that is refused");
    }
}

/// Joint 5 on the other side at one knot, a plate 0.3 mm lower, all of it a ninth faster.
#[test]
fn a_flipped_wrist_a_lower_plate_and_a_faster_motion_are_refused() {
    let [kitchen, _] = &*PLANS;
    let mut flipped = kitchen.plan.clone();
    let wash = flipped.segments.iter().find(|s| s.kind == SegmentKind::Wash).unwrap();
    let half_s = 0.5 * (wash.t_start_s + wash.t_end_s);
    let middle = flipped.knots.t_s.iter().position(|t| *t > half_s).unwrap();
    flipped.knots.q_rad[middle][4] *= -1.0;
    let found = refused(&prove(&flipped, &kitchen.robot).unwrap());
    assert!(found.contains(&Wrist), "{found:?}");
    let mut lower = kitchen.plan.clone();
    lower.job.plates[0].pose.translation.vector -= Vector3::z() * 3e-4;
    let found = refused(&prove(&lower, &kitchen.robot).unwrap());
    assert!(found.contains(&ContactHeight), "{found:?}");
    let mut faster = kitchen.plan.clone();
    faster.knots.t_s.iter_mut().for_each(|t| *t *= 0.9);
    for segment in &mut faster.segments {
        (segment.t_start_s, segment.t_end_s) = (segment.t_start_s * 0.9, segment.t_end_s * 0.9);
    }
    faster.knots.qd_rad_s.iter_mut().for_each(|v| *v /= 0.9);
    let found = refused(&prove(&faster, &kitchen.robot).unwrap());
    assert!(found.contains(&WashSpeed) && found.contains(&ContactSpeed), "{found:?}");
}
