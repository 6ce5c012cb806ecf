//! The arc round the base, as a path of the joints.

use super::free_path::FreePath;
use super::lift_line::LiftLine;
use super::rules::BaseArc;
use crate::scene::{Contact, Scene};
use platewash_kinematics::Pose;
use platewash_workcell::arc;

/// The path over the arc; `None` where a point of it is out of reach, or reached by a jump only.
pub(super) fn path(scene: &Scene<'_>, over: &BaseArc, from: &LiftLine, to: &LiftLine) -> Option<FreePath> {
    let tip = |q| scene.robot.fk(q).rigid(&scene.tip).translation;
    let (start, end) = (tip(from.top()), tip(to.top()));
    let points = arc::waypoints(start, end, &over.arc);
    let inner = &points[1..points.len() - 1];
    let pose = |point: &_| scene.pose(&Contact::level(*point), &over.policy);
    let poses: Vec<Pose> = inner.iter().map(pose).collect();
    let q = scene.solver.solve_path(&poses, from.top()).ok()?.q;
    let mut length = 0.0;
    let u = points[..points.len() - 1].windows(2).map(|ends| {
        length += (ends[1] - ends[0]).norm().max(1e-4);
        length
    });
    let u: Vec<f64> = u.collect();
    let last = (end - points[points.len() - 2]).norm().max(1e-4);
    Some(FreePath {
        length: u.last()? + last,
        u,
        q,
    })
}
