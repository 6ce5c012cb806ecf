//! What the arm's base covers.

use super::BaseFootprint;
use nalgebra::Matrix3;
use platewash_kinematics::rotation::Rigid;
use platewash_kinematics::{Pose, RobotModel};

/// Half the side of the footprint assumed for an arm whose base has no collision geometry \[m\].
const DEFAULT_HALF_SIDE_M: f64 = 0.09;

/// Sine of the angle to the vertical up to which a base stands upright.
const UPRIGHT: f64 = 1e-9;

/// The rectangle around what stands on the floor and never moves: the bounds of the base's collision shapes, or
/// ± 90 mm where there are none.
#[must_use]
pub fn base_footprint(robot: &RobotModel) -> BaseFootprint {
    turned_footprint(robot, &Matrix3::identity())
}

/// The same of an arm mounted at `T_world_base`, in the frame of the layout; `None` where its base does not stand upright, so that no plate
/// lies level with it.
#[must_use]
pub fn mounted_footprint(robot: &RobotModel, mount: &Pose) -> Option<BaseFootprint> {
    let turned = Rigid::from(mount).rotation;
    let [across, along] = [turned.m13.abs().max(turned.m23.abs()), turned.m33];
    (across <= UPRIGHT && along > 0.0).then(|| turned_footprint(robot, &turned))
}

/// The footprint of an arm whose base is turned.
fn turned_footprint(robot: &RobotModel, turned: &Matrix3<f64>) -> BaseFootprint {
    let mut bounds = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    let base = robot.fk(&nalgebra::Vector6::zeros());
    for link in robot.links().iter().filter(|link| link.frame.body() == 0) {
        let placed = base.rigid(&link.frame);
        for primitive in &link.collision {
            let shape = placed.then(&Rigid::from(&primitive.pose));
            let shape = Rigid {
                rotation: turned * shape.rotation,
                translation: turned * shape.translation,
            };
            for (axis, [least, most]) in bounds.iter_mut().enumerate() {
                let along = shape.rotation.row(axis).transpose();
                let centre = shape.translation[axis];
                *least = least.min(centre - primitive.shape.support(&-along));
                *most = most.max(centre + primitive.shape.support(&along));
            }
        }
    }
    let [x_m, y_m] = bounds.map(|[least, most]| {
        if least < most {
            [least, most]
        } else {
            [-DEFAULT_HALF_SIDE_M, DEFAULT_HALF_SIDE_M]
        }
    });
    BaseFootprint { x_m, y_m }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_irb_120_stands_on_its_bounds() {
        let foot = base_footprint(&RobotModel::irb120().unwrap());
        let close = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9;
        assert!(close(foot.x_m, [-0.2115, 0.0905]), "{foot:?}");
        assert!(close(foot.y_m, [-0.0905, 0.0905]), "{foot:?}");
    }
}
