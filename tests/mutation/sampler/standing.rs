//! Obstacles in plates and in the base: points of each obstacle, and how deep they are in cylinders and boxes, in closed form.

use super::findings::Findings;
use nalgebra::{Point3, Vector3};
use platewash::Plan;
use platewash::certificate::Requirement;
use platewash::kinematics::geometry::Shape;
use platewash::workcell::workcell::{Obstacle, ObstacleShape};

/// Points along each edge of an obstacle.
const POINTS: usize = 33;

/// The base from its drawing: a cylinder about the axis, radius and height \[m\].
const BASE_M: [f64; 2] = [0.0905, 0.1665];

/// How far obstacles that reach into a plate, or into the base, do so, as a gap below 0.
pub fn standing(plan: &Plan, findings: &mut Findings) {
    let base = |p: &Point3<f64>| cylinder(p, [0.0, 0.0], BASE_M[0], [0.0, BASE_M[1]]);
    for obstacle in &plan.job.workcell.obstacles {
        for (i, plate) in plan.job.plates.iter().enumerate() {
            if obstacle.holds_plates.contains(&i) {
                continue;
            }
            let top = plate.centre().z;
            let sdf = |p: &Point3<f64>| cylinder(p, plate.centre_xy(), plate.rim_m(), [top - plate.thickness_m, top]);
            note(findings, gap(obstacle, &sdf));
        }
        note(findings, gap(obstacle, &base));
    }
}

fn note(findings: &mut Findings, gap_m: Option<f64>) {
    if let Some(gap_m) = gap_m {
        findings.at_least(Requirement::PlatesApart, gap_m, -1e-6, 1e-9);
    }
}

/// The least signed distance of an obstacle's points \[m\]; `None` of a half-space and of shapes that no edit has.
fn gap(obstacle: &Obstacle, sdf: &dyn Fn(&Point3<f64>) -> f64) -> Option<f64> {
    let ObstacleShape::Convex(shape) = &obstacle.shape else {
        return None;
    };
    if let Shape::Sphere { radius_m } = shape {
        return Some(sdf(&obstacle.pose.translation.vector.into()) - radius_m);
    }
    let half = match shape {
        Shape::Box { half_m } => Vector3::from(*half_m),
        Shape::Cylinder {
            radius_m,
            half_length_m,
        } => Vector3::new(*radius_m, *radius_m, *half_length_m),
        _ => return None,
    };
    let share = |k: usize| 2.0 * k as f64 / (POINTS - 1) as f64 - 1.0;
    let mut least = f64::INFINITY;
    for k in 0..POINTS.pow(3) {
        let at = Vector3::new(
            share(k % POINTS),
            share(k / POINTS % POINTS),
            share(k / POINTS / POINTS),
        );
        if matches!(shape, Shape::Cylinder { .. }) && at.xy().norm() > 1.0 {
            continue;
        }
        least = least.min(sdf(&(obstacle.pose * Point3::from(at.component_mul(&half)))));
    }
    Some(least)
}

/// The signed distance of an upright cylinder.
fn cylinder(p: &Point3<f64>, [x, y]: [f64; 2], radius: f64, [low, high]: [f64; 2]) -> f64 {
    let out = (p.x - x).hypot(p.y - y) - radius;
    let over = (low - p.z).max(p.z - high);
    out.max(over).min(0.0) + out.max(0.0).hypot(over.max(0.0))
}
