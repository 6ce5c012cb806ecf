//! The whole of the timing: limits, optimality, structure, and bad input.

use crate::timing_fixture::wash;
use platewash_fixtures::{is_thorough, kitchen_tool};
use platewash_kinematics::{AXES, Frame, JointVector, RobotModel};
use platewash_planner::joint_path::{Ends, JointPath};
use platewash_planner::timing::{Limit, MotionLimits, PATH_ERROR_RAD, TimedPath, TimingError, TipLimits, time_optimal};
use proptest::prelude::*;

/// The IRB 120 and the tip of a tool 150 mm long.
fn arm() -> (RobotModel, Frame) {
    let robot = RobotModel::irb120().unwrap();
    let tip = kitchen_tool().tip_frame(&robot);
    (robot, tip)
}

fn limits(tip: Option<TipLimits>) -> MotionLimits {
    MotionLimits {
        velocity: JointVector::new(250.0, 250.0, 250.0, 320.0, 320.0, 420.0).map(f64::to_radians),
        acceleration: JointVector::new(4.0, 4.0, 4.0, 5.0, 5.0, 6.0),
        tip,
    }
}

const WASH: TipLimits = TipLimits {
    speed_m_s: 0.25,
    acceleration_m_s2: 4.0,
};

/// Largest demands over limits by looking densely, with differences of the tip's positions: nothing of this module.
fn dense(timed: &TimedPath, robot: &RobotModel, tip: &Frame, limits: &MotionLimits) -> [f64; 4] {
    let motion = &timed.motion;
    let mut most = [0.0f64; 4];
    for segment in motion.extremes() {
        most[0] = most[0].max(segment.speed.component_div(&limits.velocity).max());
        most[1] = most[1].max(segment.acceleration.component_div(&limits.acceleration).max());
        let Some(tip_limits) = &limits.tip else { continue };
        let [from, to] = segment.span_s;
        let step = (to - from) / 16.0;
        let at = |t: f64| robot.pose(&motion.at(t).unwrap().q, tip).translation.vector;
        for k in 1..16 {
            let t = from + step * f64::from(k);
            let [before, here, after] = [at(t - step), at(t), at(t + step)];
            most[2] = most[2].max((after - before).norm() / (2.0 * step) / tip_limits.speed_m_s);
            let rounding = 4e-16 * 4.0 / (step * step);
            let acceleration = (after + before - here * 2.0).norm() / (step * step) - rounding;
            most[3] = most[3].max(acceleration / tip_limits.acceleration_m_s2);
        }
    }
    most
}

fn assert_sound(timed: &TimedPath, path: &JointPath) {
    let motion = &timed.motion;
    let last = motion.times().len() - 1;
    assert_eq!(timed.parameters.len(), motion.times().len());
    assert_eq!(motion.times()[0], 0.0);
    for end in [0, last] {
        assert_eq!(motion.speeds()[end], JointVector::zeros());
    }
    assert!(timed.parameters.windows(2).all(|u| u[0] < u[1]));
    for u in path.parameters() {
        let knot = timed
            .parameters
            .iter()
            .position(|have| have == u)
            .expect("a sample is no knot");
        assert_eq!(motion.positions()[knot], path.at(*u).q);
    }
    for (k, u) in timed.parameters.iter().enumerate() {
        // q̇ = q′ ṡ: the joints' speeds are along the path.
        let (slope, speed) = (path.at(*u).first, motion.speeds()[k]);
        assert!((slope * speed.norm() - speed * slope.norm()).norm() <= 1e-9 * slope.norm() * (1.0 + speed.norm()));
    }
    assert!(timed.path_error_rad <= PATH_ERROR_RAD);
}

/// A straight line of joint 2 over `distance` with `samples` samples.
fn line(distance: f64, samples: usize) -> JointPath {
    let u: Vec<f64> = (0..samples).map(|k| k as f64).collect();
    let step = distance / (samples - 1) as f64;
    let q = (0..samples).map(|k| JointVector::new(0.0, step * k as f64, 0.0, 0.0, 0.0, 0.0));
    let q = q.collect();
    JointPath::through(u, q, Ends::NotAKnot).unwrap()
}

fn single(velocity: f64, acceleration: f64) -> MotionLimits {
    MotionLimits {
        velocity: JointVector::repeat(velocity),
        acceleration: JointVector::repeat(acceleration),
        tip: None,
    }
}

/// By hand: from rest to rest over d with acceleration a takes 2√(d/a); with the speed v reached, d/v + v/a.
#[test]
fn one_joint_takes_the_time_of_the_closed_forms() {
    let (robot, tip) = arm();
    for samples in [2, 3, 10, 101, 1000] {
        for (d, v, a) in [(1.0, 100.0, 4.0), (1.0, 0.5, 4.0), (0.1, 4.0, 5.0), (2.0, 1.0, 1e-3)] {
            let path = line(d, samples);
            let timed = time_optimal(&path, &robot, &tip, &single(v, a)).unwrap();
            let top = f64::sqrt(d * a);
            let exact = if top <= v { 2.0 * d / top } else { d / v + v / a };
            let ratio = timed.motion.duration_s() / exact;
            assert!((1.0..1.001).contains(&ratio), "{samples} samples, {d} {v} {a}: {ratio}");
            assert_sound(&timed, &path);
        }
    }
}

#[test]
fn the_wash_of_a_plate_keeps_its_limits_and_uses_them() {
    let (robot, tip) = arm();
    let path = wash(&robot, &tip, 5e-5);
    for limits in [limits(None), limits(Some(WASH))] {
        let timed = time_optimal(&path, &robot, &tip, &limits).unwrap();
        assert_sound(&timed, &path);
        let most = dense(&timed, &robot, &tip, &limits);
        assert!(most.iter().all(|m| *m <= 1.0), "{most:?}");
        let used = busy(&timed, &robot, &tip, &limits);
        println!(
            "{} samples, {} knots, {:.4} s, demands {most:?}, path error {:.2e} rad, busy {used:.3}",
            path.parameters().len(),
            timed.parameters.len(),
            timed.motion.duration_s(),
            timed.path_error_rad
        );
        assert!(used > 0.95, "{used}");
    }
}

/// Share of the time in which some limit is used to within a per cent: all of it in a time-optimal motion.
fn busy(timed: &TimedPath, robot: &RobotModel, tip: &Frame, limits: &MotionLimits) -> f64 {
    let motion = &timed.motion;
    let mut busy = 0.0;
    for segment in motion.extremes() {
        let [from, to] = segment.span_s;
        let mut most = segment.speed.component_div(&limits.velocity).max();
        most = most.max(segment.acceleration.component_div(&limits.acceleration).max());
        if let Some(tip_limits) = &limits.tip {
            for share in [1e-9, 0.5, 1.0 - 1e-9] {
                let state = motion.at(from + (to - from) * share).unwrap();
                // Differences of the tip's positions where the joints go on at the same acceleration, also beyond the segment.
                let h = 1e-4;
                let at = |t: f64| {
                    let q = state.q + state.qd * t + state.qdd * (0.5 * t * t);
                    robot.pose(&q, tip).translation.vector
                };
                let [before, here, after] = [at(-h), at(0.0), at(h)];
                most = most.max((after - before).norm() / (2.0 * h) / tip_limits.speed_m_s);
                most = most.max((after + before - here * 2.0).norm() / (h * h) / tip_limits.acceleration_m_s2);
            }
        }
        if most > 0.99 {
            busy += to - from;
        }
    }
    busy / motion.duration_s()
}

fn samples() -> impl Strategy<Value = (Vec<f64>, Vec<JointVector>)> {
    let sample = (
        0.2..2.0f64,
        prop::array::uniform6(-1.5..1.5f64).prop_map(JointVector::from),
    );
    prop::collection::vec(sample, 2..9).prop_map(|samples| {
        let mut u = 0.0;
        let ascending = samples.iter().map(|(step, _)| {
            u += step;
            u
        });
        (ascending.collect(), samples.iter().map(|(_, q)| *q).collect())
    })
}

/// A smooth path through a few random configurations, sampled `parts` times between them.
fn smooth((u, q): (Vec<f64>, Vec<JointVector>), parts: usize, ends: Ends) -> JointPath {
    let coarse = JointPath::through(u.clone(), q, ends).unwrap();
    let mut fine = vec![u[0]];
    for ends in u.windows(2) {
        fine.extend((1..=parts).map(|k| ends[0] + (ends[1] - ends[0]) * k as f64 / parts as f64));
    }
    fine.dedup();
    let q = fine.iter().map(|&u| coarse.at(u).q).collect();
    JointPath::through(fine, q, Ends::NotAKnot).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(if is_thorough() { 64 } else { 24 }))]
    #[test]
    fn limits_hold_everywhere_on_random_paths(
        samples in samples(), parts in 1usize..40, tip_limits in prop::option::of((0.1..1.0f64, 1.0..8.0f64)),
    ) {
        let (robot, tip) = arm();
        let path = smooth(samples, parts, Ends::NotAKnot);
        let limits = limits(tip_limits.map(|(speed_m_s, acceleration_m_s2)| TipLimits { speed_m_s, acceleration_m_s2 }));
        let timed = time_optimal(&path, &robot, &tip, &limits).unwrap();
        assert_sound(&timed, &path);
        let most = dense(&timed, &robot, &tip, &limits);
        // Differences of the tip's positions are its derivatives but for terms of second order.
        prop_assert!(most[0] <= 1.0 && most[1] <= 1.0 && most[2] <= 1.0 + 1e-9 && most[3] <= 1.0 + 1e-6, "{most:?}");
    }

    #[test]
    fn some_limit_is_always_in_use(samples in samples()) {
        let (robot, tip) = arm();
        let path = smooth(samples, 40, Ends::NotAKnot);
        let limits = limits(Some(TipLimits { speed_m_s: 1.0, acceleration_m_s2: 8.0 }));
        let timed = time_optimal(&path, &robot, &tip, &limits).unwrap();
        let busy = busy(&timed, &robot, &tip, &limits);
        prop_assert!(busy > 0.9, "{busy}");
    }

    /// All limits of speed times k and of acceleration times k²: the same motion, k times as fast.
    #[test]
    fn time_scales_with_the_limits(samples in samples(), k in 0.25..4.0f64) {
        let (robot, tip) = arm();
        let path = smooth(samples, 20, Ends::NotAKnot);
        let slow = limits(Some(WASH));
        let fast = MotionLimits {
            velocity: slow.velocity * k,
            acceleration: slow.acceleration * (k * k),
            tip: Some(TipLimits { speed_m_s: WASH.speed_m_s * k, acceleration_m_s2: WASH.acceleration_m_s2 * k * k }),
        };
        let [slow, fast] = [slow, fast].map(|l| time_optimal(&path, &robot, &tip, &l).unwrap().motion.duration_s());
        prop_assert!((slow / fast / k - 1.0).abs() < 5e-3, "{slow} {fast} {k}");
    }

    /// A path walked backwards takes as long: the greed is forwards, the optimum has no direction.
    #[test]
    fn a_reversed_path_takes_as_long(samples in samples()) {
        let (robot, tip) = arm();
        let path = smooth(samples, 20, Ends::NotAKnot);
        let u: Vec<f64> = path.parameters().iter().rev().map(|u| -u).collect();
        let q = path.positions().iter().rev().copied().collect();
        let reversed = JointPath::through(u, q, Ends::NotAKnot).unwrap();
        let limits = limits(Some(WASH));
        let [there, back] = [&path, &reversed].map(|p| time_optimal(p, &robot, &tip, &limits).unwrap().motion.duration_s());
        prop_assert!((there / back - 1.0).abs() < 5e-3, "{there} {back}");
    }

    #[test]
    fn the_unit_of_the_parameter_does_not_matter(samples in samples(), exponent in -120..120i32) {
        let (robot, tip) = arm();
        let path = smooth(samples, 8, Ends::NotAKnot);
        let unit = 2f64.powi(exponent);
        let u = path.parameters().iter().map(|u| u * unit).collect();
        let other = JointPath::through(u, path.positions().to_vec(), Ends::NotAKnot).unwrap();
        let limits = limits(Some(WASH));
        let [one, two] = [&path, &other].map(|p| time_optimal(p, &robot, &tip, &limits).unwrap());
        prop_assert_eq!(one.motion, two.motion);
    }

    /// Anything at all: an error or a sound motion, no panic, no endless loop.
    #[test]
    fn wild_paths_are_timed_or_refused(
        steps in prop::collection::vec((prop_oneof![1e-9..1e-3f64, 0.1..10.0f64, 1e3..1e9f64], 0usize..4), 1..8),
        size in prop_oneof![Just(0.0), Just(1e-12), Just(1.0), Just(1e6)],
        ends in prop_oneof![Just(Ends::NotAKnot), Just(Ends::Clamped([JointVector::zeros(); 2]))],
    ) {
        let (robot, tip) = arm();
        let mut u = vec![0.0];
        let mut q = vec![JointVector::zeros()];
        for (step, kind) in steps {
            u.push(u[u.len() - 1] + step);
            q.push([q[q.len() - 1], JointVector::zeros(), JointVector::repeat(size), JointVector::x() * -size][kind]);
        }
        let limits = limits(Some(WASH));
        if let Ok(path) = JointPath::through(u, q, ends)
            && let Ok(timed) = time_optimal(&path, &robot, &tip, &limits)
        {
            for segment in timed.motion.extremes() {
                prop_assert!(segment.speed.component_div(&limits.velocity).max() <= 1.0 + 1e-9);
                prop_assert!(segment.acceleration.component_div(&limits.acceleration).max() <= 1.0 + 1e-9);
            }
            prop_assert!(timed.path_error_rad <= PATH_ERROR_RAD);
        }
    }
}

#[test]
fn a_path_at_rest_at_its_ends_is_timed() {
    let (robot, tip) = arm();
    let q = vec![JointVector::zeros(), JointVector::repeat(0.3), JointVector::repeat(0.5)];
    let path = JointPath::through(vec![0.0, 1.0, 2.0], q, Ends::Clamped([JointVector::zeros(); 2])).unwrap();
    let timed = time_optimal(&path, &robot, &tip, &limits(None)).unwrap();
    assert_sound(&timed, &path);
    let exact = 2.0 * f64::sqrt(0.5 / 4.0);
    let ratio = timed.motion.duration_s() / exact;
    assert!((1.0..1.03).contains(&ratio), "{ratio}");
}

#[test]
fn configurations_may_repeat_within_a_path() {
    let (robot, tip) = arm();
    for repeats in 2..6 {
        let mut q = vec![JointVector::zeros(), JointVector::repeat(0.2)];
        q.extend(vec![JointVector::repeat(0.4); repeats]);
        q.push(JointVector::new(0.1, 0.5, 0.4, 0.3, 0.2, 0.1));
        let u = (0..q.len()).map(|k| k as f64).collect();
        let path = JointPath::through(u, q, Ends::NotAKnot).unwrap();
        let timed = time_optimal(&path, &robot, &tip, &limits(Some(WASH))).unwrap();
        assert_sound(&timed, &path);
        let most = dense(&timed, &robot, &tip, &limits(Some(WASH)));
        assert!(most.iter().all(|m| *m <= 1.0 + 1e-6), "{most:?}");
    }
}

#[test]
fn rejects_a_path_without_motion() {
    let (robot, tip) = arm();
    let path = JointPath::through(vec![0.0, 1.0, 2.0], vec![JointVector::repeat(0.1); 3], Ends::NotAKnot).unwrap();
    let refused = time_optimal(&path, &robot, &tip, &limits(None));
    assert_eq!(refused, Err(TimingError::NoMotion { samples: 3 }));
}

#[test]
fn rejects_invalid_limits_by_name() {
    let (robot, tip) = arm();
    let path = line(1.0, 5);
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY, 5e-324] {
        for joint in 0..AXES {
            let mut bad = limits(None);
            bad.acceleration[joint] = value;
            let error = time_optimal(&path, &robot, &tip, &bad).unwrap_err();
            assert!(matches!(error, TimingError::Limit { limit: Limit::JointAcceleration(j), .. } if j == joint));
            assert!(error.to_string().contains(&format!("joint {}", joint + 1)), "{error}");
            let mut bad = limits(None);
            bad.velocity[joint] = value;
            let error = time_optimal(&path, &robot, &tip, &bad).unwrap_err();
            assert!(matches!(error, TimingError::Limit { limit: Limit::JointSpeed(j), .. } if j == joint));
        }
        let bad = [
            (
                TipLimits {
                    speed_m_s: value,
                    ..WASH
                },
                Limit::TipSpeed,
            ),
            (
                TipLimits {
                    acceleration_m_s2: value,
                    ..WASH
                },
                Limit::TipAcceleration,
            ),
        ];
        for (tip_limits, name) in bad {
            let error = time_optimal(&path, &robot, &tip, &limits(Some(tip_limits))).unwrap_err();
            assert!(matches!(error, TimingError::Limit { limit, .. } if limit == name));
        }
    }
}

/// Samples 1e-9 apart on a path of length 5: the motion is so slow that its times round coarsely, which showed in the
/// accelerations after it was stretched.
#[test]
fn coarse_times_are_stretched_until_limits_hold_or_refused() {
    let (robot, tip) = arm();
    let second = 5.34475090086502 + 0.0006948170109641293;
    let u = vec![0.0, 5.34475090086502, second, second + 1e-9];
    let q = vec![
        JointVector::zeros(),
        -JointVector::x(),
        JointVector::zeros(),
        JointVector::zeros(),
    ];
    let path = JointPath::through(u, q, Ends::NotAKnot).unwrap();
    match time_optimal(&path, &robot, &tip, &limits(Some(WASH))) {
        Ok(timed) => {
            let most = timed
                .motion
                .extremes()
                .map(|s| s.acceleration.component_div(&limits(None).acceleration).max());
            assert!(most.fold(0.0, f64::max) <= 1.0);
        }
        // Or says that it cannot.
        Err(error) => assert!(
            matches!(error, TimingError::Unheld { .. } | TimingError::Range { .. }),
            "{error}"
        ),
    }
}
