//! Motions through knots: continuity, extremes, and knots that form no motion.

use platewash_kinematics::JointVector;
use platewash_motion::trajectory::*;
use proptest::prelude::*;

fn motion() -> impl Strategy<Value = Trajectory> {
    let knot = prop::array::uniform6(-2.0..2.0f64).prop_map(JointVector::from);
    prop::collection::vec(knot, 2..8).prop_map(|q| Trajectory::through(q, 0.1))
}

proptest! {
    #[test]
    fn the_motion_passes_its_knots_with_a_continuous_speed(motion in motion()) {
        for (k, &t) in motion.times().iter().enumerate() {
            let here = motion.at(t).unwrap();
            prop_assert!((here.q - motion.positions()[k]).amax() < 1e-12);
            prop_assert!((here.qd - motion.speeds()[k]).amax() < 1e-9);
            let before = motion.at(t - 1e-9).unwrap();
            prop_assert!((before.qd - here.qd).amax() < 1e-4);
        }
    }

    #[test]
    fn extremes_bound_a_dense_sampling_and_are_attained(motion in motion()) {
        for segment in motion.extremes() {
            let [from, to] = segment.span_s;
            let mut seen = (JointVector::zeros(), JointVector::zeros(), JointVector::repeat(f64::NEG_INFINITY));
            for k in 0..=1000 {
                let state = motion.at(from + (to - from - 1e-12) * f64::from(k) / 1000.0).unwrap();
                seen = (seen.0.sup(&state.qd.abs()), seen.1.sup(&state.qdd.abs()), seen.2.sup(&state.q));
                prop_assert!((0..6).all(|j| state.q[j] >= segment.position[0][j] - 1e-12));
            }
            for (bound, seen) in [(segment.speed, seen.0), (segment.acceleration, seen.1), (segment.position[1], seen.2)] {
                for j in 0..6 {
                    prop_assert!(seen[j] <= bound[j] + 1e-8 * (1.0 + bound[j].abs()));
                    prop_assert!(seen[j] >= bound[j] - 1e-3 * (1.0 + bound[j].abs()));
                }
            }
        }
    }

    #[test]
    fn jerk_is_the_slope_of_the_acceleration(motion in motion()) {
        for segment in motion.extremes() {
            let [from, to] = segment.span_s;
            let [start, end] = [from, from + 0.5 * (to - from)].map(|t| motion.at(t).unwrap().qdd);
            let slope = ((end - start) / (0.5 * (to - from))).abs();
            prop_assert!((slope - segment.jerk).amax() < 1e-6 * (1.0 + segment.jerk.amax()));
        }
    }

    #[test]
    fn speed_is_the_derivative_of_position(motion in motion(), share in 0.01..0.99f64) {
        let (t, h) = (motion.duration_s() * share, 1e-6);
        let [before, here, after] = [t - h, t, t + h].map(|t| motion.at(t).unwrap());
        prop_assert!(((after.q - before.q) / (2.0 * h) - here.qd).amax() < 1e-3);
    }
}

#[test]
fn rejects_knots_that_form_no_motion() {
    let (still, nan) = (JointVector::zeros(), JointVector::repeat(f64::NAN));
    let knots = |t: &[f64], q: &[JointVector]| Trajectory::from_knots(t.to_vec(), q.to_vec(), vec![still; t.len()]);
    assert!(knots(&[], &[]).is_ok());
    assert!(knots(&[0.0, 1.0], &[still; 2]).is_ok());
    assert!(matches!(knots(&[0.0], &[]), Err(KnotError::Count { positions: 0, .. })));
    assert_eq!(knots(&[0.0, 1.0], &[still, nan]), Err(KnotError::NotFinite { knot: 1 }));
    assert_eq!(knots(&[f64::INFINITY], &[still]), Err(KnotError::NotFinite { knot: 0 }));
    assert_eq!(knots(&[1.0], &[still]), Err(KnotError::Time { knot: 0, t_s: 1.0 }));
    assert_eq!(
        knots(&[0.0, 0.0], &[still; 2]),
        Err(KnotError::Time { knot: 1, t_s: 0.0 })
    );
}

#[test]
fn accepts_short_motions_and_times_outside() {
    assert_eq!(Trajectory::default().at(0.0), None);
    let single = Trajectory::through(vec![JointVector::repeat(0.5)], 0.01);
    assert_eq!(single.at(3.0).map(|s| s.q), Some(JointVector::repeat(0.5)));
    let two = Trajectory::through(vec![JointVector::zeros(), JointVector::repeat(1.0)], 0.01);
    assert_eq!(two.at(-1.0).map(|s| s.q), Some(JointVector::zeros()));
    assert_eq!(two.at(9.0).map(|s| s.q), Some(JointVector::repeat(1.0)));
    assert_eq!(two.at(f64::NAN), None);
}

#[test]
fn outside_its_time_the_arm_rests_at_the_nearer_end() {
    let knot = |q, qd| (JointVector::repeat(q), JointVector::repeat(qd));
    let [(q0, v0), (q1, v1)] = [knot(0.2, 1.0), knot(0.9, -2.0)];
    let motion = Trajectory::from_knots(vec![0.0, 0.5], vec![q0, q1], vec![v0, v1]).unwrap();
    let still = JointVector::zeros();
    for (t, q) in [
        (-1e-12, q0),
        (-3.0, q0),
        (0.5 + 1e-12, q1),
        (9.0, q1),
        (f64::INFINITY, q1),
    ] {
        let outside = motion.at(t).unwrap();
        assert!((outside.q - q).amax() < 1e-14, "at {t} s");
        assert_eq!((outside.qd, outside.qdd), (still, still), "at {t} s");
    }
    assert_eq!(motion.at(0.0).map(|s| s.qd), Some(v0));
    assert!((motion.at(0.5).unwrap().qd - v1).amax() < 1e-12);
}
