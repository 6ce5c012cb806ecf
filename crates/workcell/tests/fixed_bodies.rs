//! Obstacles that reach into plates or the base.

use nalgebra::{UnitQuaternion, Vector3};
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::{Pose, RobotModel};
use platewash_workcell::clearance::*;
use platewash_workcell::dry_run::DryRun;
use platewash_workcell::fixtures::{kitchen_plate, kitchen_terms};
use platewash_workcell::plate::Plate;
use platewash_workcell::workcell::{Obstacle, ObstacleShape};

fn block(name: &str, half_m: [f64; 3], [x, y, z]: [f64; 3]) -> Obstacle {
    let shape = ObstacleShape::Convex(Shape::Box { half_m });
    Obstacle::new(name, shape, Pose::translation(x, y, z))
}

fn found(obstacles: Vec<Obstacle>) -> Vec<FixedOverlap> {
    let robot = RobotModel::irb120().unwrap();
    let mut terms = kitchen_terms(&robot, vec![kitchen_plate([0.3, 0.2]), kitchen_plate([0.3, -0.2])]);
    terms.workcell.obstacles.extend(obstacles);
    standing_overlaps(&robot, &terms.workcell, &terms.plates, None).unwrap()
}

/// By hand: plates are 20 mm thick and lie at 30 mm, the base stands on 0.
#[test]
fn accepts_touching_bodies_and_names_overlapping_ones() {
    // A table whose top is at the plates' undersides, and one at the foot of the arm.
    let under = |top: f64| block("table", [1.0, 1.0, 0.1], [1.12, 0.0, top - 0.1]);
    let foot = block("slab", [1.0, 1.0, 0.1], [0.0, 0.0, -0.1]);
    assert_eq!(found(vec![under(0.01), foot]), []);
    let wrong = found(vec![under(0.0101)]);
    let names: Vec<_> = wrong.iter().map(|w| (w.body.to_string(), w.other.as_str())).collect();
    assert_eq!(
        names,
        [
            ("obstacle 'table'".to_owned(), "plate 1"),
            ("obstacle 'table'".to_owned(), "plate 2")
        ]
    );
    assert!((wrong[0].by_m - 1e-4).abs() < 1e-9, "{}", wrong[0].by_m);
    // Beside a plate, touching its round wall, and 10 µm into it.
    let beside = |x: f64| block("wall", [0.01, 0.3, 0.2], [x + 0.01, 0.2, 0.2]);
    assert_eq!(found(vec![beside(0.445)]), []);
    let wrong = found(vec![beside(0.44499)]);
    assert_eq!(wrong.len(), 1);
    assert!((wrong[0].by_m - 1e-5).abs() < 1e-8, "{}", wrong[0].by_m);
}

#[test]
fn a_holder_may_reach_into_its_plate() {
    let mut rack = block("rack", [0.2, 0.2, 0.02], [0.3, 0.2, 0.02]);
    assert_eq!(found(vec![rack.clone()]).len(), 1);
    rack.holds_plates = vec![0];
    assert_eq!(found(vec![rack.clone()]), []);
    rack.holds_plates = vec![1];
    assert_eq!(found(vec![rack]).len(), 1);
}

#[test]
fn names_bodies_that_reach_into_the_base() {
    let wrong = found(vec![block("box", [0.05; 3], [-0.1, 0.0, 0.05])]);
    assert_eq!(
        (wrong[0].body.to_string().as_str(), wrong[0].other.as_str()),
        ("obstacle 'box'", "base_link")
    );
    // A floor at another height than 0 is an obstacle as any other.
    let floor = |z: f64| Obstacle::new("raised", ObstacleShape::HalfSpace, Pose::translation(0.0, 0.0, z));
    let wrong = found(vec![floor(1e-3)]);
    let names: Vec<_> = wrong.iter().map(|w| w.other.as_str()).collect();
    assert_eq!(names, ["base_link"]);
    assert_eq!(found(vec![floor(0.0)]), []);
}

#[test]
fn margins_apply_to_moving_bodies_only() {
    let mut table = block("table", [1.0, 1.0, 0.1], [1.12, 0.0, -0.09]);
    table.margin_m = 0.05;
    assert_eq!(found(vec![table]), []);
}

#[test]
fn ignores_raised_plates_of_a_dry_run() {
    let robot = RobotModel::irb120().unwrap();
    let mut terms = kitchen_terms(&robot, vec![kitchen_plate([0.3, 0.2])]);
    terms
        .workcell
        .obstacles
        .push(DryRun::plate_as_obstacle(0, &terms.plates[0]));
    let overlaps = |dry_run| standing_overlaps(&robot, &terms.workcell, &terms.plates, dry_run).unwrap();
    assert_eq!(overlaps(None).len(), 1);
    let dry_run = DryRun {
        parent: "0".repeat(64),
        height_m: 0.01,
    };
    assert_eq!(overlaps(Some(&dry_run)), []);
}

/// A plate that is not level with the base, be it by ever so little, is looked at by its body: by hand, the base reaches 90.5 mm forwards.
#[test]
fn a_plate_in_the_base_is_named_however_it_is_turned() {
    let robot = RobotModel::irb120().unwrap();
    let tilted = |x: f64, angle: f64| {
        let turned = UnitQuaternion::from_scaled_axis(Vector3::new(0.0, angle, 0.0));
        let plate = kitchen_plate([0.0, 0.0]);
        Plate {
            pose: Pose::from_parts(Vector3::new(x, 0.0, 0.03).into(), turned),
            ..plate
        }
    };
    let found = |plates: Vec<Plate>| {
        let mut terms = kitchen_terms(&robot, plates);
        terms.workcell.obstacles.clear();
        standing_overlaps(&robot, &terms.workcell, &terms.plates, None).unwrap()
    };
    for angle in [1e-6, 0.01, 1.0, std::f64::consts::PI] {
        let wrong = found(vec![tilted(0.6, 0.0), tilted(0.12, angle)]);
        assert_eq!(wrong.len(), 1, "{angle}: {wrong:?}");
        assert_eq!(
            (&wrong[0].body, wrong[0].other.as_str()),
            (&FixedBody::Plate(1), "base_link")
        );
        assert_eq!(found(vec![tilted(0.24, angle)]), [], "{angle}");
    }
    // The shortest way out is the longer, the nearer to the axis it lies, but for the one up: the face is 30 mm over the floor.
    for (x, by_m) in [(0.215, 0.0205), (0.2, 0.03)] {
        let wrong = found(vec![tilted(x, 1e-6)]);
        assert!((wrong[0].by_m - by_m).abs() < 1e-6, "{}", wrong[0].by_m);
    }
}
