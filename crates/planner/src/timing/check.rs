//! Check of the motion against its limits, piece by piece: exactly for the joints, by a bound for the tip.
//!
//! The tip's velocity and acceleration are checked at equal steps of a piece. Between two steps a vector leaves the
//! straight line between its values by at most `τ²/8 · sup |second derivative|`, τ the step, so that the larger norm at
//! the two and this term bound it. Steps are halved until the term is small, or the bound keeps the limit.

use crate::timing::grid::Grid;
use crate::timing::hermite::Piece;
use crate::timing::limits::{MotionLimits, TipLimits};
use crate::timing::tip_model::{Magnitudes, TipModel, TipRates};
use platewash_kinematics::JointVector;

/// Share of a limit that the bound between looks may take at most; then looks are not made denser.
const SLACK: f64 = 1e-4;
/// Looks into a piece at most.
const MOST_STEPS: u32 = 16;

/// Demand over limit, by piece: above 1 the limit is broken.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Demand {
    /// Demand of the speeds of joints and tip, the larger.
    pub speed: f64,
    /// Demand of the accelerations of the joints.
    pub joints: f64,
    /// Demand of the tip's acceleration; 0 without a limit.
    pub tip: f64,
}

impl Demand {
    /// The larger of each; NaN counts as infinite.
    pub fn or(&self, other: &Self) -> Self {
        let larger = |a: f64, b: f64| if b.is_nan() { f64::INFINITY } else { a.max(b) };
        Self {
            speed: larger(self.speed, other.speed),
            joints: larger(self.joints, other.joints),
            tip: larger(self.tip, other.tip),
        }
    }

    /// Factor by which time must be stretched for this demand to be 1.
    pub fn stretch(&self) -> f64 {
        self.speed.max(self.joints.sqrt()).max(self.tip.sqrt())
    }
}

/// The demand of piece k of a grid.
pub(crate) fn demand(k: usize, piece: &Piece, grid: &Grid, limits: &MotionLimits) -> Demand {
    let (speed, acceleration) = (piece.most_speed(), piece.most_acceleration());
    let share = |value: &JointVector, limit: &JointVector| value.component_div(limit).max();
    let mut demand = Demand {
        speed: share(&speed, &limits.velocity),
        joints: share(&acceleration, &limits.acceleration),
        tip: 0.0,
    };
    if let (Some(tip), Some(model)) = (&limits.tip, grid.tip()) {
        let magnitudes = Magnitudes {
            speed,
            acceleration,
            jerk: piece.jerk().abs(),
        };
        let start = grid.knots()[k].tip;
        let [v, a] = tip_demand(piece, (model, start), &magnitudes, tip);
        demand.speed = demand.speed.max(v);
        demand.tip = a;
    }
    demand
}

/// Speed and acceleration of the tip over their limits; `start` has its rates where the piece starts, if they are known.
fn tip_demand(
    piece: &Piece,
    (model, start): (&TipModel, Option<TipRates>),
    magnitudes: &Magnitudes,
    limits: &TipLimits,
) -> [f64; 2] {
    let limits = [limits.speed_m_s, limits.acceleration_m_s2];
    let [third, fourth] = model.higher_rates(magnitudes);
    let between = [third / limits[0], fourth / limits[1]].map(|rate| 0.125 * piece.h * piece.h * rate);
    let look = |share: f64| {
        let [q, qd, qdd] = piece.at(share * piece.h);
        let known = start.filter(|_| share == 0.0);
        let tip = known.map_or_else(|| model.rates(&q, &qd), |known| known.moving(&qd));
        [
            tip.velocity(&qd).norm() / limits[0],
            tip.acceleration(&qdd).norm() / limits[1],
        ]
    };
    let larger = |a: [f64; 2], b: [f64; 2]| [a[0].max(b[0]), a[1].max(b[1])];
    let mut most = larger(look(0.0), look(1.0));
    let mut steps = 1;
    loop {
        let term = between.map(|term| term / f64::from(steps * steps));
        let settled = (0..2).all(|i| term[i] <= SLACK || most[i] + term[i] <= 1.0);
        if settled || steps >= MOST_STEPS {
            return [most[0] + term[0], most[1] + term[1]];
        }
        // The places between the looks so far.
        steps *= 2;
        for k in (1..steps).step_by(2) {
            most = larger(most, look(f64::from(k) / f64::from(steps)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::joint_path::{Ends, JointPath};
    use platewash_kinematics::{RobotModel, ToolFrame};
    use proptest::prelude::*;

    fn vector(most: f64) -> impl Strategy<Value = JointVector> {
        prop::array::uniform6(-most..most).prop_map(JointVector::from)
    }

    proptest! {
        #[test]
        fn the_demand_bounds_a_dense_sampling_and_is_close(
            q in vector(2.0), step in vector(0.05), v in [vector(1.5), vector(1.5)], h in 0.002..0.05f64,
        ) {
            let robot = RobotModel::irb120().unwrap();
            let tip = robot.tool_frame(ToolFrame::Flange).unwrap();
            let model = TipModel::new(&robot, &tip);
            let path = JointPath::through(vec![0.0, 1.0], vec![q, q + step], Ends::NotAKnot).unwrap();
            let grid = Grid::new(&path, Some(model)).unwrap();
            let limits = MotionLimits {
                velocity: JointVector::repeat(2.0),
                acceleration: JointVector::repeat(30.0),
                tip: Some(TipLimits { speed_m_s: 0.5, acceleration_m_s2: 8.0 }),
            };
            let piece = Piece::new(h, [&q, &(q + step)], v);
            let demand = demand(0, &piece, &grid, &limits);
            let mut seen = [0.0f64; 4];
            for k in 0..=500 {
                let [q, qd, qdd] = piece.at(h * f64::from(k) / 500.0);
                let rates = model.rates(&q, &qd);
                seen[0] = seen[0].max(qd.amax() / 2.0);
                seen[1] = seen[1].max(qdd.amax() / 30.0);
                seen[2] = seen[2].max(rates.velocity(&qd).norm() / 0.5);
                seen[3] = seen[3].max(rates.acceleration(&qdd).norm() / 8.0);
            }
            let speed = seen[0].max(seen[2]);
            for (bound, seen) in [(demand.speed, speed), (demand.joints, seen[1]), (demand.tip, seen[3])] {
                prop_assert!(seen <= bound * (1.0 + 1e-12), "{seen} {bound}");
                // Where the limit holds at the first look, the bound need not be close.
                prop_assert!(bound <= 1.0 || bound <= seen * 1.05 + 0.01, "{seen} {bound}");
            }
        }
    }
}
