//! Obstacles that reach into plates or the base.

use nalgebra::{UnitQuaternion, Vector3};
use platewash_bodies::clearance::*;
use platewash_bodies::job::overlaps_of_fixed_bodies;
use platewash_fixtures::{kitchen_plate, kitchen_terms};
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::{Pose, RobotModel};
use platewash_workcell::dry_run::DryRun;
use platewash_workcell::plate::Plate;
use platewash_workcell::{Obstacle, ObstacleShape};

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

/// Plates of many triangles, turned and rounded as files are, with a corner deep in the base. The collision library makes faces without a
/// normal of some, along which nothing is apart.
#[test]
fn a_mesh_deep_in_the_base_is_named_however_it_is_turned() {
    for seed in 0..150 {
        let k = f64::from(seed);
        let turn = UnitQuaternion::from_euler_angles(0.37 * k, 0.61 * k, 0.83 * k);
        let corner = |i: usize, j: usize, up: usize| {
            // The corner (0, 0, 0) is 50 mm over the foot, on axis 1.
            let local = Vector3::new(0.1 * i as f64, 0.1 * j as f64, 0.004 * up as f64);
            let at = turn * local + Vector3::new(0.0, 0.0, 0.05);
            nalgebra::Point3::from(at.map(|c| (c * 1e6).round() / 1e6))
        };
        let grid = (0..9).flat_map(|i| (0..9).map(move |j| (i, j)));
        let points: Vec<_> = grid.flat_map(|(i, j)| [corner(i, j, 0), corner(i, j, 1)]).collect();
        let shapes = [
            ObstacleShape::Convex(Shape::Hull { points: points.clone() }),
            ObstacleShape::Parts(vec![points.clone(), points]),
        ];
        for shape in shapes {
            let wrong = found(vec![Obstacle::new("plate", shape, Pose::identity())]);
            assert!(
                wrong.iter().any(|w| w.other == "base_link" && w.by_m > 1e-3),
                "{seed}: {wrong:?}"
            );
        }
    }
}

/// The ground is the plane at height 0 of the base, wherever the frame of the half-space stands in it.
#[test]
fn the_ground_may_reach_into_the_base() {
    let robot = RobotModel::irb120().unwrap();
    let turned = UnitQuaternion::from_scaled_axis(Vector3::new(0.0, 0.0, 1.0));
    let plane = |pose: Pose| Obstacle::new("floor", ObstacleShape::HalfSpace, pose);
    let mut ground = plane(Pose::from_parts(Vector3::new(1.0, -2.0, 0.0).into(), turned));
    ground.margin_m = 0.05;
    assert!(ground.is_ground());
    assert!(!plane(Pose::translation(0.0, 0.0, 1e-6)).is_ground());
    let upside_down = UnitQuaternion::from_scaled_axis(Vector3::new(std::f64::consts::PI, 0.0, 0.0));
    assert!(!plane(Pose::from_parts(Vector3::zeros().into(), upside_down)).is_ground());
    // Also where the arm is mounted elsewhere, turned.
    let mut terms = kitchen_terms(&robot, vec![]);
    terms.workcell.mount = Pose::from_parts(Vector3::new(1.0, 0.5, 0.0).into(), turned);
    terms.workcell.obstacles = vec![ground];
    assert_eq!(overlaps_of_fixed_bodies(&terms, &robot).unwrap(), []);
    let still = still_pairs(&robot, &terms.workcell).unwrap();
    assert!(
        still.iter().all(|pair| pair.only_contact && pair.is_clear(0.5)),
        "{still:?}"
    );
}

/// A sheet gets a thickness, with which it reaches into what it touches.
#[test]
fn an_arm_stands_on_a_sheet() {
    let corner = |x: f64, y: f64| nalgebra::Point3::new(x, y, 0.0);
    let [a, b, c, d] = [
        corner(-0.5, -0.5),
        corner(0.5, -0.5),
        corner(0.5, 0.5),
        corner(-0.5, 0.5),
    ];
    let leg = |z: f64| {
        [
            nalgebra::Point3::new(0.5, 0.5, z),
            c,
            nalgebra::Point3::new(0.5, 0.4, z),
        ]
    };
    let parts = solid_parts(&[[a, b, c], [a, c, d], leg(-0.7)], SolidParts::Decomposed).unwrap();
    assert_eq!(
        found(vec![Obstacle::new(
            "bench",
            ObstacleShape::Parts(parts),
            Pose::identity()
        )]),
        []
    );
}
