use super::*;
use nalgebra::{Rotation3, UnitQuaternion};
use platewash_fixtures::{contact_kitchen_terms, kitchen_plate};
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{JointVector, Pose};
use platewash_workcell::dry_run::DryRun;
use platewash_workcell::job::ContactRequirements;
use platewash_workcell::surface::Surface;
use proptest::prelude::*;
use std::f64::consts::TAU;

const UR5: &str = include_str!("../../../../kinematics/tests/fixtures/ur5_lengths.urdf");
const KR5: &str = include_str!("../../../../kinematics/tests/fixtures/kr5_lengths.urdf");

fn arms() -> [RobotModel; 3] {
    let other = |urdf| RobotModel::from_urdf(urdf, &MeshSource::none()).unwrap();
    [RobotModel::irb120().unwrap(), other(UR5), other(KR5)]
}

/// The same tool beside axis 6 and turned on the flange.
fn askew(robot: &RobotModel) -> JobTerms {
    let mut terms = contact_kitchen_terms(robot, vec![kitchen_plate([0.4, 0.0])]);
    let by = Pose::new(Vector3::new(0.25, -0.15, 0.02), Vector3::new(0.4, 0.2, 0.1));
    let tool = &mut terms.workcell.tool;
    (tool.tip, tool.sponge.pose) = (by * tool.tip, by * tool.sponge.pose);
    terms
}

fn joint() -> impl Strategy<Value = f64> {
    0.0..TAU
}

/// Configurations with joints 2 and 3 as they bring the centre of the wrist the farthest from joint 2, or as they are.
fn stretched(robot: &RobotModel, q: JointVector, is_stretched: bool) -> JointVector {
    let wrist = robot.wrist_frame();
    let (centre, _) = robot.sharp_reach_bound(&wrist);
    let bent = (0..360).map(|k| {
        let mut bent = q;
        bent[2] = f64::from(k).to_radians();
        bent
    });
    let far = |q: &JointVector| (robot.fk(q).rigid(&wrist).translation - centre.coords).norm();
    let farthest = bent.max_by(|a, b| far(a).total_cmp(&far(b)));
    farthest.filter(|_| is_stretched).unwrap_or(q)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1024))]

    /// Whatever the joints: with the tip on a plate and the tool leaning as it may, the places under the sponge are not beyond the arm.
    #[test]
    fn places_under_a_sponge_are_within_reach(
        arm in 0usize..3,
        is_askew in any::<bool>(),
        profile in prop::option::of(prop::sample::select(vec!["coupe275", "deep230"])),
        is_stretched in any::<bool>(),
        q in (joint(), -0.6..0.6f64, joint(), joint(), joint(), joint()),
        (lean, towards) in (0.0..1.0f64, joint()),
        (out, around) in (0.0..1.0f64, joint()),
        (aside, direction) in (0.0..1.0f64, joint()),
    ) {
        let robot = &arms()[arm];
        let q = stretched(robot, JointVector::new(q.0, q.1, q.2, q.3, q.4, q.5), is_stretched);
        let mut terms = askew(robot);
        if !is_askew {
            terms.workcell.tool = platewash_fixtures::contact_kitchen_tool();
        }
        let surface = profile.map_or(Surface::Disc { radius_m: 0.145 }, |name| Surface::shipped(name).unwrap());
        let tip = robot.fk(&q).rigid(&terms.workcell.tool.tip_frame(robot));
        // The plate's normal under the tip, leaning by up to the allowed angle from the tool.
        let leaning = Rotation3::new(Vector3::new(towards.cos(), towards.sin(), 0.0) * lean * terms.tilt_max_rad());
        let frame = tip.rotation * leaning.matrix();
        let turned = Rotation3::from_matrix_unchecked(frame) * Rotation3::from_axis_angle(&Vector3::x_axis(), TAU / 2.0);
        let (rho_m, touched_m) = (out * surface.rim_m(), aside * terms.workcell.tool.sponge.radius_m);
        let normal = surface.normal(rho_m, around);
        let upright = Rotation3::rotation_between(&normal, &Vector3::z()).unwrap();
        let rotation = UnitQuaternion::from_rotation_matrix(&(turned * upright));
        let at = surface.point(rho_m, around).coords;
        let mut plate = kitchen_plate([0.0, 0.0]);
        plate.surface = surface;
        plate.pose = Pose::from_parts(
            (tip.translation - rotation * at).into(),
            rotation,
        );
        prop_assert!((plate.world(&at) - tip.translation).norm() < 1e-9);
        // A place of the face that the sponge touches: seen along the tool, within its radius.
        let off = tip.rotation * Vector3::new(direction.cos(), direction.sin(), 0.0) * touched_m;
        let near = plate.local(&(tip.translation + off));
        let from_pole_m = near.xy().norm();
        prop_assume!(from_pole_m < plate.rim_m());
        let place = plate.surface.point(from_pole_m, near.y.atan2(near.x)).coords;
        let bound = FaceBound::new(robot, &terms, &plate);
        // On a steep face the place may lie deeper than the sponge.
        prop_assume!((plate.world(&place) - tip.translation).norm() <= bound.touch_m);
        prop_assert!(!bound.is_beyond(&place, 0.0), "{place}");
    }
}

/// The IRB 120 stretched towards a plate: what is said to be beyond it starts not much later than what it reaches ends.
#[test]
fn the_bound_is_near_what_the_arm_reaches() {
    let robot = RobotModel::irb120().unwrap();
    let share = |x: f64| {
        let terms = contact_kitchen_terms(&robot, vec![kitchen_plate([x, 0.0])]);
        share_beyond_reach(&robot, &terms, &terms.plates[0])
    };
    // The tip reaches 0.635 m from axis 1 at this height and a tilt of 15° (facts of the job: docs/tools-over-the-table.md), the sponge
    // 25 mm more.
    let radius_m = 0.145;
    assert_eq!(share(0.635 + 0.025 - radius_m), 0.0);
    assert!(share(0.635 + 0.025 + 0.01 - radius_m) > 0.0);
    assert!(share(0.635 + 0.025) > 0.4);
    assert!(share(0.635 + 0.025 + 0.01 + radius_m) > 1.0 - 1e-9);
}

/// A share that asks for no time and no dose is there without any contact.
#[test]
fn only_shares_that_need_contact_count_as_required() {
    let robot = RobotModel::irb120().unwrap();
    let mut terms = contact_kitchen_terms(&robot, vec![kitchen_plate([0.4, 0.0])]);
    terms.requirements.coverage = 0.2;
    let required = |change: &dyn Fn(&mut ContactRequirements)| {
        let mut terms = terms.clone();
        let contact = terms.requirements.contact.as_mut().unwrap();
        (contact.share, contact.time_share, contact.dose_share) = (0.3, 0.9, 0.8);
        change(contact);
        required_share(&terms, &terms.plates[0])
    };
    assert_eq!(required(&|_| ()), 0.9);
    assert_eq!(required(&|contact| contact.time_s = 0.0), 0.8);
    assert_eq!(
        required(&|contact| (contact.time_s, contact.dose_pa_m) = (0.0, 0.0)),
        0.3
    );
    let mut dry_run = terms.clone();
    dry_run.dry_run = Some(DryRun {
        parent: "0".repeat(64),
        height_m: 0.05,
    });
    assert_eq!(required_share(&dry_run, &dry_run.plates[0]), 0.2);
}
