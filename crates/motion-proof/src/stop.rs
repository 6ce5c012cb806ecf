//! Ends of a motion at speed: the stop after the last point.

use platewash_kinematics::{AXES, JointVector};
use platewash_motion::piecewise::{MotionPiece, PiecewiseMotion};

/// Speed below which a joint counts as at rest \[rad/s\].
const REST_RAD_S: f64 = 1e-9;

/// Time below which two joints stop at once \[s\].
const AT_ONCE_S: f64 = 1e-9;

/// Share of the acceleration limits with which the arm stops. The rest is for rounding.
const SHARE: f64 = 1.0 - 1e-9;

/// Greatest joint speeds at the start and at the end of a motion \[rad/s\]; 0 where all joints are at rest.
pub(crate) fn end_speeds(motion: &PiecewiseMotion) -> [f64; 2] {
    let ends = [
        motion.pieces().first().map(|piece| piece.qd_rad_s[0]),
        motion.pieces().last().map(|piece| piece.qd_rad_s[1]),
    ];
    let greatest = |speeds: Option<JointVector>| speeds.map_or(0.0, |speeds| speeds.amax());
    ends.map(|speeds| match greatest(speeds) {
        speed if speed <= REST_RAD_S => 0.0,
        speed => speed,
    })
}

/// Returns a motion with the stop after its end: each joint brakes at its acceleration limit \[rad/s²\], on its own, until it rests. A motion
/// that ends at rest stays as it is.
pub(crate) fn with_stop(motion: &PiecewiseMotion, limits: &JointVector) -> PiecewiseMotion {
    let mut pieces = motion.pieces().to_vec();
    let Some(last) = pieces.last().copied() else {
        return motion.clone();
    };
    let (from_s, q, v) = (last.t_s[1], last.q_rad[1], last.qd_rad_s[1]);
    let limits = limits * SHARE;
    let stop_s = v.abs().component_div(&limits);
    let state = |after_s: f64| {
        let joint = |i: usize| {
            let moves_s = after_s.min(stop_s[i]);
            let speed = if after_s < stop_s[i] {
                v[i] - v[i].signum() * limits[i] * after_s
            } else {
                0.0
            };
            (
                q[i] + (v[i] - v[i].signum() * 0.5 * limits[i] * moves_s) * moves_s,
                speed,
            )
        };
        let all: [(f64, f64); AXES] = std::array::from_fn(joint);
        (
            JointVector::from(all.map(|(q, _)| q)),
            JointVector::from(all.map(|(_, v)| v)),
        )
    };
    let mut ends: Vec<f64> = stop_s.iter().copied().filter(|s| *s > AT_ONCE_S).collect();
    ends.sort_by(f64::total_cmp);
    ends.dedup_by(|later, earlier| *later - *earlier <= AT_ONCE_S);
    let mut before = (from_s, q, v);
    for after_s in ends {
        let (t_s, (q, v)) = (from_s + after_s, state(after_s));
        if t_s > before.0 {
            pieces.push(MotionPiece::cubic([before.0, t_s], [before.1, q], [before.2, v]));
            before = (t_s, q, v);
        }
    }
    PiecewiseMotion::new(pieces).unwrap_or_else(|_| motion.clone())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ending(v: [f64; AXES]) -> PiecewiseMotion {
        let piece = MotionPiece::cubic([0.0, 1.0], [JointVector::zeros(); 2], [JointVector::zeros(), v.into()]);
        PiecewiseMotion::new(vec![piece]).unwrap()
    }

    /// By hand: v²/2a and v/a for each joint.
    #[test]
    fn each_joint_brakes_at_its_limit() {
        let motion = ending([3.0, -1.0, 0.0, 2.0, 0.0, 0.0]);
        let limits = JointVector::from([100.0, 10.0, 1.0, 20.0, 1.0, 1.0]);
        let stopped = with_stop(&motion, &limits);
        let ends: Vec<f64> = stopped.pieces().iter().map(|piece| piece.t_s[1]).collect();
        for (found, expected) in ends.iter().zip([1.0, 1.03, 1.1]) {
            assert!((found - expected).abs() < 1e-8, "{ends:?}");
        }
        let last = stopped.pieces().last().unwrap();
        assert_eq!(last.qd_rad_s[1], JointVector::zeros());
        let expected = JointVector::from([0.045, -0.05, 0.0, 0.1, 0.0, 0.0]);
        assert!((last.q_rad[1] - expected).amax() < 1e-8);
        for piece in &stopped.pieces()[1..] {
            for acceleration in piece.accelerations() {
                assert!((0..AXES).all(|i| acceleration[i].abs() <= limits[i]), "{acceleration}");
            }
        }
        assert_eq!(end_speeds(&motion), [0.0, 3.0]);
        assert_eq!(end_speeds(&stopped), [0.0, 0.0]);
    }

    #[test]
    fn a_motion_that_ends_at_rest_stays_as_it_is() {
        let motion = ending([0.0; AXES]);
        assert_eq!(with_stop(&motion, &JointVector::repeat(1.0)), motion);
        assert_eq!(
            with_stop(&ending([1e-12; AXES]), &JointVector::repeat(1.0))
                .pieces()
                .len(),
            1
        );
        assert_eq!(end_speeds(&PiecewiseMotion::default()), [0.0, 0.0]);
    }
}
