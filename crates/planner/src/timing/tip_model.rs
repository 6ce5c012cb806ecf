//! Motion of the tip when the joints move, and bounds on its rates.
//!
//! With c_k = z_k × (p − p_k), the columns of the geometric Jacobian, the tip's velocity is `ṗ = Σ c_k q̇_k`, and its
//! acceleration `p̈ = Σ c_k q̈_k + b(q̇)`, `b = Σ_k q̇_k (2 Σ_{j<k} z_j q̇_j + z_k q̇_k) × c_k` (Siciliano et al.,
//! *Robotics*, §3.1, written for one point). The same holds with derivatives by the path's parameter.

use nalgebra::{Matrix3x6, Vector3};
use platewash_kinematics::{AXES, Axes, Frame, JointVector, RobotModel};

/// The tip on the arm.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TipModel<'a> {
    robot: &'a RobotModel,
    frame: Frame,
    /// Bounds on the distance of the tip from each joint's axis, in every configuration \[m\].
    levers: [f64; AXES],
}

/// The tip's derivatives at one configuration.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TipRates {
    /// Linear part of the Jacobian \[m\].
    pub jacobian: Matrix3x6<f64>,
    /// Angular part of the Jacobian: the axes of the joints.
    axes: Matrix3x6<f64>,
    /// b of the joints' first derivative.
    pub bias: Vector3<f64>,
}

/// Sums of the joints' magnitudes within a stretch of time: speeds, accelerations, jerks.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Magnitudes {
    /// Largest speeds \[rad/s\].
    pub speed: JointVector,
    /// Largest accelerations \[rad/s²\].
    pub acceleration: JointVector,
    /// Jerks \[rad/s³\].
    pub jerk: JointVector,
}

impl<'a> TipModel<'a> {
    /// The frame `tip` on `robot`.
    pub fn new(robot: &'a RobotModel, tip: &Frame) -> Self {
        Self {
            robot,
            frame: *tip,
            levers: levers(robot, tip),
        }
    }

    /// The tip's derivatives at `q` \[rad\] when the joints' first derivative is `first`.
    pub fn rates(&self, q: &JointVector, first: &JointVector) -> TipRates {
        let jacobian = self.robot.fk(q).jacobian(&self.frame, Axes::Base);
        let rows = |first| jacobian.fixed_rows::<3>(first).into_owned();
        let rates = TipRates {
            jacobian: rows(0),
            axes: rows(3),
            bias: Vector3::zeros(),
        };
        rates.moving(first)
    }

    /// Bounds on the tip's third and fourth derivatives \[m/s³, m/s⁴\] while the joints move as cubics in time within the magnitudes.
    ///
    /// A k-th derivative of p by joints `j₁ ≤ … ≤ j_k` is `z_{j₁} × (… × c_{j_k})`, no longer than the lever of the
    /// last joint. So each term of the chain rule,
    /// `p⃛ = D³p[q̇, q̇, q̇] + 3 D²p[q̇, q̈] + Dp[q⃛]`,
    /// `p⁗ = D⁴p[q̇, …] + 6 D³p[q̇, q̇, q̈] + 4 D²p[q̇, q⃛] + 3 D²p[q̈, q̈]`,
    /// is at most a product of sums of magnitudes; its tuples whose last joint is m, with lever r_m, are what the
    /// product over joints ≤ m exceeds that over joints < m by.
    pub fn higher_rates(&self, most: &Magnitudes) -> [f64; 2] {
        let (mut v, mut a, mut j) = (0.0, 0.0, 0.0);
        let mut last = [0.0; 2];
        let mut bounds = [0.0; 2];
        for m in 0..AXES {
            v += most.speed[m];
            a += most.acceleration[m];
            j += most.jerk[m];
            let terms = [
                v * v * v + 3.0 * v * a + j,
                v * v * (v * v + 6.0 * a) + 4.0 * v * j + 3.0 * a * a,
            ];
            for i in 0..2 {
                bounds[i] += self.levers[m] * (terms[i] - last[i]);
            }
            last = terms;
        }
        bounds
    }
}

impl TipRates {
    /// The same configuration with another first derivative of the joints.
    pub fn moving(mut self, first: &JointVector) -> Self {
        let mut turning = Vector3::zeros();
        self.bias = Vector3::zeros();
        for (k, (axis, column)) in self.axes.column_iter().zip(self.jacobian.column_iter()).enumerate() {
            let own = axis * first[k];
            self.bias += (turning * 2.0 + own).cross(&column) * first[k];
            turning += own;
        }
        self
    }

    /// Velocity for the joint speeds `qd`.
    pub fn velocity(&self, qd: &JointVector) -> Vector3<f64> {
        self.jacobian * qd
    }

    /// Acceleration for the joint accelerations `qdd`, at the speeds that the bias is for.
    pub fn acceleration(&self, qdd: &JointVector) -> Vector3<f64> {
        self.jacobian * qdd + self.bias
    }
}

/// Bounds on the distance of the tip from each axis: the way to it along the origins of the joints beyond, whose
/// distances no joint changes. The last joint's is exact.
fn levers(robot: &RobotModel, tip: &Frame) -> [f64; AXES] {
    let poses = robot.fk(&JointVector::zeros());
    let point = poses.rigid(tip).translation;
    let mut levers = [0.0; AXES];
    let mut beyond = point;
    let mut way = 0.0;
    for joint in (0..tip.body().min(AXES)).rev() {
        let name = &robot.joints()[joint].child;
        // A child link's frame has its origin on the axis of its joint (URDF).
        let Some(link) = robot.links().iter().find(|link| &link.name == name) else {
            levers[joint] = 2.0 * robot.reach_bound(tip).1;
            continue;
        };
        let origin = poses.rigid(&link.frame).translation;
        way += (beyond - origin).norm();
        beyond = origin;
        levers[joint] = way;
    }
    if let Some(last) = tip.body().checked_sub(1) {
        let column = poses.jacobian(tip, Axes::Base).fixed_view::<3, 1>(0, last).norm();
        levers[last] = levers[last].min(column * (1.0 + 1e-12));
    }
    levers
}

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests {
    use super::*;

    use platewash_fixtures::kitchen_tool;
    use proptest::prelude::*;

    /// The IRB 120 and the tip of a tool 150 mm long.
    fn arm() -> (RobotModel, Frame) {
        let robot = RobotModel::irb120().unwrap();
        let tip = kitchen_tool().tip_frame(&robot);
        (robot, tip)
    }

    fn vector(most: f64) -> impl Strategy<Value = JointVector> {
        prop::array::uniform6(-most..most).prop_map(JointVector::from)
    }

    proptest! {
        #[test]
        fn acceleration_is_the_derivative_of_velocity(q in vector(2.0), qd in vector(2.0), qdd in vector(5.0)) {
            let (robot, tip) = arm();
            let model = TipModel::new(&robot, &tip);
            let at = |t: f64| {
                let (q, qd) = (q + qd * t + qdd * (0.5 * t * t), qd + qdd * t);
                model.rates(&q, &qd).velocity(&qd)
            };
            let h = 1e-5;
            let differences = (at(h) - at(-h)) / (2.0 * h);
            prop_assert!((model.rates(&q, &qd).acceleration(&qdd) - differences).norm() < 1e-6);
        }

        #[test]
        fn levers_bound_the_distance_from_the_axes(q in vector(3.0)) {
            let (robot, tip) = arm();
            let model = TipModel::new(&robot, &tip);
            let jacobian = model.rates(&q, &JointVector::zeros()).jacobian;
            for joint in 0..AXES {
                prop_assert!(jacobian.column(joint).norm() <= model.levers[joint] + 1e-12, "joint {joint}");
            }
        }

        /// Central differences of the exact acceleration of a cubic motion.
        #[test]
        fn higher_rates_bound_differences(q in vector(2.0), qd in vector(2.0), qdd in vector(5.0), jerk in vector(50.0)) {
            let (robot, tip) = arm();
            let model = TipModel::new(&robot, &tip);
            let at = |t: f64| {
                let speed = qd + qdd * t + jerk * (0.5 * t * t);
                let q = q + qd * t + qdd * (0.5 * t * t) + jerk * (t * t * t / 6.0);
                let rates = model.rates(&q, &speed);
                (rates.velocity(&speed), rates.acceleration(&(qdd + jerk * t)))
            };
            let h = 1e-3;
            let (before, here, after) = (at(-h), at(0.0), at(h));
            let bounds = model.higher_rates(&Magnitudes {
                speed: qd.abs() + qdd.abs() * h + jerk.abs() * h * h,
                acceleration: qdd.abs() + jerk.abs() * h,
                jerk: jerk.abs(),
            });
            let third = (before.0 + after.0 - here.0 * 2.0).norm() / (h * h);
            let fourth = (before.1 + after.1 - here.1 * 2.0).norm() / (h * h);
            prop_assert!(third <= bounds[0] + 1e-6, "{third} {bounds:?}");
            prop_assert!(fourth <= bounds[1] + 1e-6, "{fourth} {bounds:?}");
        }
    }
}
