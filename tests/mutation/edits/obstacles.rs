//! What stands around: added, moved and removed.

use crate::mutation::edit::{Edits, ExpectedResult, Kind, good};
use crate::mutation::edits::exclusions::{every_pair, leave_out, restate};
use crate::mutation::edits::{middle, nth, within};
use nalgebra::Vector3;
use platewash::certificate::Requirement::{Clearance, Exclusions};
use platewash::kinematics::geometry::Shape;
use platewash::motion::trajectory::SegmentKind::{Depart, Return, Transit, Wash};
use platewash::workcell::{Obstacle, ObstacleShape};
use platewash::{Plan, Pose};

pub fn add(edits: &mut Edits) {
    far(edits);
    near(edits);
    floor(edits);
    left_out(edits);
}

/// An obstacle with its middle at a place \[m\]; what need not keep clear of it follows.
fn put(plan: &mut Plan, name: &str, shape: Shape, [x, y, z]: [f64; 3]) {
    let pose = Pose::translation(x, y, z);
    let body = Obstacle::new(name, ObstacleShape::Convex(shape), pose);
    plan.job.workcell.obstacles.push(body);
    restate(plan);
}

fn box_of(half_m: [f64; 3]) -> Shape {
    Shape::Box { half_m }
}

fn ball(radius_m: f64) -> Shape {
    Shape::Sphere { radius_m }
}

/// The tip at a knot \[m\].
fn tip(plan: &Plan, knot: usize) -> Vector3<f64> {
    let robot = good()[0].robot;
    let frame = plan.job.workcell.tool.tip_frame(robot);
    robot.fk(&plan.knots.q_rad[knot]).rigid(&frame).translation
}

fn far(edits: &mut Edits) {
    let mut harmless = |what, apply| edits.harmless(Kind::Obstacles, what, apply);
    harmless("a wall behind the arm", |p| {
        put(p, "wall", box_of([0.02, 1.0, 1.0]), [-1.2, 0.0, 1.0])
    });
    harmless("a ceiling", |p| {
        put(p, "ceiling", box_of([2.0, 2.0, 0.05]), [0.0, 0.0, 1.5])
    });
    harmless("a table under the plates", |p| {
        put(p, "table", box_of([0.4, 0.6, 1e-3]), [0.5, 0.0, 2e-3])
    });
    harmless("a post outside", |p| {
        let post = Shape::Capsule {
            radius_m: 0.03,
            half_length_m: 0.5,
        };
        put(p, "post", post, [-0.9, 0.4, 0.5]);
    });
}

fn near(edits: &mut Edits) {
    let mut fails = |what, apply| edits.fails(Kind::Obstacles, what, &[Clearance], apply);
    fails("a low ceiling", |p| {
        put(p, "ceiling", box_of([2.0, 2.0, 0.05]), [0.0, 0.0, 0.5])
    });
    fails("a post in the way", |p| {
        let post = Shape::Cylinder {
            radius_m: 0.02,
            half_length_m: 0.3,
        };
        put(p, "post", post, [0.4, 0.0, 0.3]);
    });
    fails("a ball round the base", |p| put(p, "ball", ball(0.2), [0.0, 0.0, 0.3]));
    fails("a ball on a plate", |p| {
        let [x, y, z] = p.job.plates[1].centre().into();
        put(p, "ball", ball(0.02), [x, y, z]);
    });
    // Beside the tip in free motion, and over it where it washes.
    for (kind, n) in [(Depart, 0), (Transit, 0), (Transit, 1), (Transit, 2), (Return, 0)] {
        for off_m in [0.05, 0.12, 0.3] {
            let what = format!("a ball {off_m} m in front of the tip, {} {n}", kind.name());
            edits.add(Kind::Obstacles, what, ExpectedResult::Sampled, move |p, _| {
                let knots = within(p, nth(p, kind, n));
                let tip = tip(p, knots.start + knots.len() / 2);
                let out = Vector3::new(tip.x, tip.y, 0.0).normalize();
                put(p, "ball", ball(0.04), (tip + out * off_m).into());
            });
        }
    }
    for off_m in [0.04, 0.1, 0.25] {
        let what = format!("a ball {off_m} m beside the handle while it washes");
        edits.add(Kind::Obstacles, what, ExpectedResult::Sampled, move |p, _| {
            let tip = tip(p, middle(p, Wash));
            put(p, "ball", ball(0.02), [tip.x + off_m, tip.y, tip.z + 0.1]);
        });
    }
}

/// The floor, and names.
fn floor(edits: &mut Edits) {
    let mut fails = |what, apply| edits.fails(Kind::Obstacles, what, &[Exclusions], apply);
    fails("no floor, without what follows", |p| p.job.workcell.obstacles.clear());
    fails("the floor renamed, without what follows", |p| {
        p.job.workcell.obstacles[0].name = "ground".to_owned()
    });
    fails("another floor of that name", |p| {
        let floor = p.job.workcell.obstacles[0].clone();
        p.job.workcell.obstacles.push(floor);
        restate(p);
    });
    fails("a wall that is named like a link", |p| {
        put(p, "link_4", box_of([0.02, 1.0, 1.0]), [-1.2, 0.0, 1.0])
    });
    fails("a wall, without what follows", |p| {
        let before = p.job.workcell.exclusions.clone();
        put(p, "wall", box_of([0.02, 1.0, 1.0]), [-1.2, 0.0, 1.0]);
        p.job.workcell.exclusions = before;
    });
    edits.harmless(Kind::Obstacles, "no floor", |p| {
        p.job.workcell.obstacles.clear();
        restate(p);
    });
    edits.harmless(Kind::Obstacles, "the floor renamed", |p| {
        p.job.workcell.obstacles[0].name = "ground".to_owned();
        restate(p);
    });
}

/// What would be in the way is left out, all of it or some.
fn left_out(edits: &mut Edits) {
    let post = |p: &mut Plan| {
        let post = Shape::Cylinder {
            radius_m: 0.02,
            half_length_m: 0.3,
        };
        put(p, "post", post, [0.4, 0.0, 0.3]);
        // Where it stands in a plate it holds that.
        p.job.workcell.obstacles[1].holds_plates = (0..p.job.plates.len()).collect();
    };
    edits.add(
        Kind::Obstacles,
        "a post in the way that nothing need keep clear of",
        ExpectedResult::Waived(vec![Exclusions]),
        move |p, _| {
            post(p);
            let all = every_pair(p)
                .into_iter()
                .filter(|pair| pair.contains(&"post".to_owned()));
            all.collect::<Vec<_>>().iter().for_each(|[a, b]| leave_out(p, [a, b]));
        },
    );
    edits.add(
        Kind::Obstacles,
        "a post in the way that the handle need not keep clear of",
        ExpectedResult::Fails(vec![Clearance]),
        move |p, _| {
            post(p);
            leave_out(p, ["handle", "post"]);
        },
    );
    edits.harmless(
        Kind::Obstacles,
        "a wall behind the arm that nothing need keep clear of",
        |p| {
            put(p, "wall", box_of([0.02, 1.0, 1.0]), [-1.2, 0.0, 1.0]);
            leave_out(p, ["link_2", "wall"]);
            leave_out(p, ["wall", "link_3"]);
        },
    );
}
