//! Edits after which there is no plan to judge: an error that says where, not a certificate.

use crate::good::good;
use platewash::planner::certificate::verify;
use platewash::{Plan, VerifyError};

#[track_caller]
fn refused(word: &str, edit: fn(&mut Plan)) -> VerifyError {
    let good = &good()[0];
    let mut plan = good.plan.clone();
    edit(&mut plan);
    plan.hash = Some(plan.seal().unwrap());
    let error = verify(&plan, good.robot).unwrap_err();
    assert!(error.to_string().contains(word), "{error}");
    error
}

#[test]
fn what_is_no_plan_is_refused_with_its_place() {
    refused("knot 0: time 0.001", |p| {
        p.knots.t_s.iter_mut().for_each(|t| *t += 1e-3)
    });
    refused("knot 8", |p| p.knots.t_s.swap(7, 8));
    refused("knot 8", |p| p.knots.t_s[8] = p.knots.t_s[7]);
    refused("as many of each", |p| _ = p.knots.q_rad.pop());
    refused("0 knots", |p| {
        p.knots.t_s.clear();
        p.knots.q_rad.clear();
        p.knots.qd_rad_s.clear();
    });
    refused("joint 3 gets to", |p| p.knots.q_rad[40][2] = 1e6);
    refused("plate 2", |p| p.plates[2].radius_m = 0.0);
    refused("segments", |p| p.segments = vec![p.segments[2]; 200]);
    refused("radius_m", |p| p.scenario.tool.radius_m = -0.01);
    refused("clearance_m", |p| p.scenario.wash.clearance_m = -0.01);
}

#[test]
fn what_is_no_number_is_refused() {
    for value in [f64::NAN, f64::INFINITY] {
        let mut plan = good()[1].plan.clone();
        plan.knots.q_rad[100][1] = value;
        assert!(
            verify(&plan, good()[1].robot)
                .unwrap_err()
                .to_string()
                .contains("knot 100")
        );
    }
}
