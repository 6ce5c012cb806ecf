//! Files that are hardly plans: an error or a requirement that is not kept, soon, and never a panic.

use crate::maker::{good, irb120, post, resealed};
use nalgebra::Point3;
use platewash_certificate::{Certificate, ProveError, Verdict, prove, prove_with};
use platewash_kinematics::JointVector;
use platewash_kinematics::geometry::Shape;
use platewash_motion::plan::{Plan, Process};
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::Planner;
use platewash_workcell::job::TermsError;
use platewash_workcell::{Obstacle, ObstacleShape};

fn changed(change: impl FnOnce(&mut Plan)) -> Result<Certificate, ProveError> {
    let mut plan = good();
    change(&mut plan);
    prove(&plan, &irb120())
}

#[track_caller]
fn fails(change: impl FnOnce(&mut Plan)) {
    let certificate = changed(change).unwrap();
    assert_eq!(certificate.verdict, Verdict::Fail);
    // Both forms can be written.
    assert!(certificate.to_string().starts_with("NOT PROVED"));
    assert!(serde_json::to_string(&certificate).is_ok());
}

#[test]
fn rejects_knots_that_form_no_motion() {
    let cut = |p: &mut Plan, n: usize| {
        p.knots.t_s.truncate(n);
        p.knots.q_rad.truncate(n);
        p.knots.qd_rad_s.truncate(n);
    };
    assert_eq!(changed(|p| cut(p, 0)), Err(ProveError::NoMotion { found: 0 }));
    assert_eq!(changed(|p| cut(p, 1)), Err(ProveError::NoMotion { found: 1 }));
    fails(|p| cut(p, 2));
    let knots = |change: fn(&mut Plan)| matches!(changed(change), Err(ProveError::Knots(_)));
    assert!(knots(|p| p.knots.t_s.swap(5, 6)));
    assert!(knots(|p| p.knots.t_s[0] = 1e-3));
    assert!(knots(|p| p.knots.q_rad.truncate(9)));
    assert!(knots(|p| p.knots.q_rad[3][3] = f64::NAN));
    assert!(knots(|p| p.knots.qd_rad_s[3][3] = f64::INFINITY));
}

#[test]
fn huge_numbers_end_in_a_clear_error() {
    for size in [1e5, 1e150, 1e300, f64::MAX] {
        let found = changed(|p| p.knots.q_rad[77][2] = size);
        assert!(matches!(found, Err(ProveError::TurnsTooFar { joint: 2, .. })), "{size}");
    }
    assert!(matches!(
        changed(|p| p.knots.qd_rad_s[77][2] = 1e300),
        Err(ProveError::TurnsTooFar { .. })
    ));
    fails(|p| p.knots.q_rad[77][2] = 9e3);
    fails(|p| p.knots.qd_rad_s[77] = JointVector::repeat(1e4));
    fails(|p| p.segments[1].t_end_s = 1e308);
    fails(|p| p.job.workcell.tool.tip.translation.x = 9.0);
    fails(|p| p.wash_paths[0].lift_m = 1e300);
    for wild in [1e300, -1e300, 1e9] {
        let found = changed(|p| p.job.plates[1].pose.translation.x = wild);
        assert_eq!(found, Err(ProveError::Job(TermsError::NoPlate { plate: 1 })));
    }
    let found = changed(|p| p.job.plates[0].thickness_m = 0.0);
    assert_eq!(found, Err(ProveError::Job(TermsError::NoPlate { plate: 0 })));
    let job = |change: fn(&mut Plan)| matches!(changed(change), Err(ProveError::Job(_)));
    assert!(job(|p| p.job.workcell.tool.tip.translation.x = 1e300));
    assert!(job(|p| p.job.requirements.clearance_m = f64::NAN));
    assert!(job(|p| p.job.limits.tip_speed_m_s = f64::INFINITY));
    assert!(job(|p| p.job.workcell.mount.translation.z = f64::NAN));
    assert!(job(|p| p.job.workcell.mount.translation.z = 1e300));
    // An arm that is mounted elsewhere has its plates elsewhere.
    fails(|p| p.job.workcell.mount.translation.z = 1e-3);
    assert!(job(|p| p.job.plates.clear()));
}

#[test]
fn wrong_counts_and_indices_fail() {
    fails(|p| p.segments.clear());
    fails(|p| p.wash_paths.clear());
    fails(|p| p.order.clear());
    fails(|p| p.order = vec![usize::MAX, 1]);
    fails(|p| p.segments[1].plate = usize::MAX);
    fails(|p| p.wash_paths[1].plate = 99);
    fails(|p| p.job.workcell.exclusions.clear());
    fails(|p| p.segments.iter_mut().for_each(|s| s.t_end_s = s.t_start_s));
    let crowded = changed(|p| p.segments = vec![p.segments[0]; 1000]);
    assert!(matches!(
        crowded,
        Err(ProveError::TooMany {
            what: "segments",
            found: 1000,
            ..
        })
    ));
    let crowded = changed(|p| p.wash_paths = vec![p.wash_paths[0]; 33]);
    assert_eq!(
        crowded.unwrap_err().to_string(),
        "33 wash paths for 2 plates; there are 32 at most"
    );
    let crowded = changed(|p| p.order = vec![0; 33]);
    assert!(matches!(crowded, Err(ProveError::TooMany { found: 33, .. })));
}

#[test]
fn rejects_invalid_bodies_by_name() {
    let points = |all: &[[f64; 3]]| Shape::Hull {
        points: all.iter().map(|p| Point3::from(*p)).collect(),
    };
    let round = |radius_m: f64, half_length_m: f64| Shape::Cylinder {
        radius_m,
        half_length_m,
    };
    let corners = [[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0]];
    let bad = [
        Shape::Sphere { radius_m: -1.0 },
        Shape::Sphere { radius_m: f64::NAN },
        Shape::Box {
            half_m: [0.1, 0.0, 0.1],
        },
        Shape::Capsule {
            radius_m: 0.1,
            half_length_m: -0.1,
        },
        round(1e300, 0.1),
        round(0.1, -1.0),
        points(&[]),
        points(&corners),
        points(&[corners[0], corners[1], corners[2], [1e300, 0.0, 0.0]]),
    ];
    let named = Err(ProveError::Body {
        name: "post".to_owned(),
    });
    for shape in bad {
        let mut post = post("post");
        post.shape = ObstacleShape::Convex(shape.clone());
        assert_eq!(changed(|p| p.job.workcell.obstacles.push(post)), named, "{shape:?}");
        let changed = changed(|p| {
            p.job.workcell.tool.bodies[0].name = "post".to_owned();
            p.job.workcell.tool.bodies[0].shape = shape.clone();
        });
        assert_eq!(changed, named, "{shape:?}");
    }
    let mut far = post("post");
    far.pose.translation.x = 1e300;
    assert_eq!(changed(|p| p.job.workcell.obstacles.push(far)), named);
    // Four times one point is no hull, and neither are four points of a plane.
    let flat = [[0.0, -0.2, -0.3], [0.0, 0.2, -0.3], [0.0, 0.2, 0.3], [0.0, -0.2, 0.3]];
    for corners in [[corners[0]; 4], flat] {
        let shape = ObstacleShape::Convex(points(&corners));
        let refused = changed(|p| p.job.workcell.obstacles.push(Obstacle { shape, ..post("post") }));
        assert!(matches!(refused, Err(ProveError::Clearance(_))), "{refused:?}");
    }
    let crowd = changed(|p| p.job.workcell.obstacles = vec![post("post"); 1000]).unwrap_err();
    assert_eq!(
        crowd.to_string(),
        "the plan's job: 1001 bodies of the tool and obstacles; 1000 can be judged at most"
    );
}

#[test]
fn a_run_of_the_papers_program_has_no_certificate() {
    let paper = Planner::Paper(serde_json::Value::Null);
    let words = "the plan is a run of the paper's program; there is no certificate for one";
    for found in [
        changed(|p| p.process = Process::Paper),
        changed(|p| p.job.planner = paper),
    ] {
        assert_eq!(found.clone().unwrap_err().to_string(), words);
        assert_eq!(found, Err(ProveError::PaperRun));
    }
}

#[test]
fn cancelled_work_proves_nothing() {
    let token = CancelToken::new();
    token.cancel();
    assert!(matches!(
        prove_with(&good(), &irb120(), &token),
        Err(ProveError::Cancelled(_))
    ));
    // Half-way, at whatever it is.
    let plan = good();
    for wait_us in (0..40).map(|k| 1500 * k) {
        let token = CancelToken::new();
        let other = token.clone();
        let judged = std::thread::scope(|scope| {
            scope.spawn(move || {
                std::thread::sleep(std::time::Duration::from_micros(wait_us));
                other.cancel();
            });
            prove_with(&plan, &irb120(), &token)
        });
        // Too late, all is proved as ever.
        assert!(matches!(&judged, Err(ProveError::Cancelled(_))) || judged == prove(&plan, &irb120()));
    }
}

#[test]
fn a_thousand_plates_end_soon_and_more_are_refused() {
    let crowd = |count: usize| {
        move |p: &mut Plan| {
            let plate = |k: usize| p.job.plates[0].moved_to([0.3 + 0.001 * k as f64, 0.1]);
            p.job.plates = (0..count).map(plate).collect();
            p.order = (0..count).collect();
        }
    };
    let refused = Err(ProveError::Job(TermsError::PlateCount { found: 1001 }));
    assert_eq!(changed(crowd(1001)), refused);
    fails(crowd(300));
}

#[test]
fn the_certificate_is_the_same_on_one_thread_and_on_many_and_survives_json() {
    let plan = resealed(good());
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| serde_json::to_string(&prove(&plan, &irb120()).unwrap()).unwrap())
    };
    let text = on(1);
    assert_eq!(text, on(4));
    let read: Certificate = serde_json::from_str(&text).unwrap();
    assert_eq!(serde_json::to_string(&read).unwrap(), text);
}
