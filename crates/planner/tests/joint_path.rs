//! Paths of the joints through samples: smooth splines, and samples that form no path.

use platewash_kinematics::JointVector;
use platewash_planner::joint_path::{Ends, JointPath, JointPathError};
use proptest::prelude::*;

fn samples(least: usize) -> impl Strategy<Value = (Vec<f64>, Vec<JointVector>)> {
    let sample = (
        0.01..3.0f64,
        prop::array::uniform6(-2.0..2.0f64).prop_map(JointVector::from),
    );
    prop::collection::vec(sample, least..12).prop_map(|samples| {
        let mut u = -1.0;
        let ascending = samples.iter().map(|(step, _)| {
            u += step;
            u
        });
        (ascending.collect(), samples.iter().map(|(_, q)| *q).collect())
    })
}

fn ends() -> impl Strategy<Value = Ends> {
    let slope = || prop::array::uniform6(-2.0..2.0f64).prop_map(JointVector::from);
    prop_oneof![
        (slope(), slope()).prop_map(|(a, b)| Ends::Clamped([a, b])),
        Just(Ends::NotAKnot)
    ]
}

proptest! {
    #[test]
    fn the_curve_passes_its_samples_with_continuous_derivatives((u, q) in samples(2), ends in ends()) {
        let path = JointPath::through(u.clone(), q.clone(), ends).unwrap();
        for (u, q) in u.iter().zip(&q) {
            prop_assert_eq!(path.at(*u).q, *q);
        }
        for &sample in &u[1..u.len() - 1] {
            // The next numbers beside a sample are on the pieces before and after it.
            let [left, right] = [path.at(sample.next_down()), path.at(sample.next_up())];
            prop_assert!((left.first - right.first).amax() <= 1e-11 * (1.0 + left.first.amax()));
            prop_assert!((left.second - right.second).amax() <= 1e-9 * (1.0 + left.second.amax()), "{left:?} {right:?}");
        }
        if let Ends::Clamped([first, last]) = ends {
            prop_assert_eq!(path.at(u[0]).first, first);
            prop_assert_eq!(path.at(u[u.len() - 1]).first, last);
        }
    }

    #[test]
    fn derivatives_are_those_of_the_position((u, q) in samples(2), ends in ends(), share in 0.0..1.0f64) {
        let path = JointPath::through(u.clone(), q, ends).unwrap();
        let (here, h) = (u[0] + share * (u[u.len() - 1] - u[0]), 1e-6);
        // Inside one piece only: the third derivative jumps at the samples.
        prop_assume!(u.iter().all(|sample| (sample - here).abs() > 2.0 * h));
        let [before, at, after] = [here - h, here, here + h].map(|u| path.at(u));
        let scale = 1.0 + at.first.amax() + at.second.amax() * 100.0;
        prop_assert!(((after.q - before.q) / (2.0 * h) - at.first).amax() < 1e-7 * scale);
        prop_assert!(((after.first - before.first) / (2.0 * h) - at.second).amax() < 1e-7 * scale);
    }

    /// Not-a-knot reproduces any cubic, clamping with its own slopes too.
    #[test]
    fn a_cubic_is_its_own_spline((u, _) in samples(4), c in prop::array::uniform4(-1.0..1.0f64)) {
        let cubic = |u: f64| JointVector::repeat(c[0] + (c[1] + (c[2] + c[3] * u) * u) * u);
        let slope = |u: f64| JointVector::repeat(c[1] + (2.0 * c[2] + 3.0 * c[3] * u) * u);
        let last = u[u.len() - 1];
        let q: Vec<_> = u.iter().map(|&u| cubic(u)).collect();
        let size = 1.0 + last.abs().powi(3);
        for ends in [Ends::NotAKnot, Ends::Clamped([slope(u[0]), slope(last)])] {
            let path = JointPath::through(u.clone(), q.clone(), ends).unwrap();
            for k in 0..=50 {
                let at = u[0] + (last - u[0]) * f64::from(k) / 50.0;
                prop_assert!((path.at(at).q - cubic(at)).amax() < 1e-8 * size, "{ends:?} at {at}");
            }
        }
    }
}

#[test]
fn two_samples_are_a_line_and_three_a_parabola() {
    let at = |u: f64| JointVector::repeat(1.0 + u * (2.0 - 3.0 * u));
    let line = JointPath::through(vec![1.0, 3.0], vec![at(1.0), at(3.0)], Ends::NotAKnot).unwrap();
    assert!((line.at(2.0).q - (at(1.0) + at(3.0)) / 2.0).amax() < 1e-14);
    assert_eq!(line.at(2.0).second, JointVector::zeros());
    let samples = vec![0.0, 0.5, 2.0];
    let parabola = JointPath::through(samples.clone(), samples.into_iter().map(at).collect(), Ends::NotAKnot).unwrap();
    for u in [0.1, 0.7, 1.9] {
        assert!((parabola.at(u).q - at(u)).amax() < 1e-13);
        assert!((parabola.at(u).second - JointVector::repeat(-6.0)).amax() < 1e-12);
    }
}

#[test]
fn returns_the_ends_outside_the_path_and_passes_nan_on() {
    let path = JointPath::through(
        vec![0.0, 1.0],
        vec![JointVector::zeros(), JointVector::repeat(1.0)],
        Ends::NotAKnot,
    )
    .unwrap();
    assert_eq!(path.at(-5.0).q, JointVector::zeros());
    assert_eq!(path.at(f64::INFINITY).q, JointVector::repeat(1.0));
    assert!(path.at(f64::NAN).q.iter().all(|v| v.is_nan()));
}

#[test]
fn rejects_samples_that_form_no_path() {
    let q = JointVector::zeros();
    let through = |u: &[f64], q: &[JointVector]| JointPath::through(u.to_vec(), q.to_vec(), Ends::NotAKnot);
    assert_eq!(through(&[], &[]), Err(JointPathError::TooFew { samples: 0 }));
    assert_eq!(through(&[1.0], &[q]), Err(JointPathError::TooFew { samples: 1 }));
    assert!(matches!(
        through(&[0.0, 1.0], &[q]),
        Err(JointPathError::Count { positions: 1, .. })
    ));
    assert!(matches!(
        through(&[0.0, 1.0, 1.0], &[q; 3]),
        Err(JointPathError::Order { sample: 2, .. })
    ));
    for bad in [f64::NAN, f64::INFINITY] {
        assert_eq!(
            through(&[0.0, bad], &[q; 2]),
            Err(JointPathError::NotFinite { sample: 1 })
        );
        let bad = JointVector::repeat(bad);
        assert_eq!(
            through(&[0.0, 1.0], &[q, bad]),
            Err(JointPathError::NotFinite { sample: 1 })
        );
        let clamped = JointPath::through(vec![0.0, 1.0], vec![q; 2], Ends::Clamped([q, bad]));
        assert_eq!(clamped, Err(JointPathError::EndNotFinite));
    }
    let steep = through(&[0.0, 5e-324, 1.0, 2.0], &[q, JointVector::repeat(1.0), q, q]);
    assert!(matches!(steep, Err(JointPathError::Overflow { .. })), "{steep:?}");
    assert!(through(&[-1e308, 1e308], &[q; 2]).is_err());
}
