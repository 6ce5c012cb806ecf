//! The paper's arc round the base, as a way of the joints.

use super::Terminal;
use super::route::Way;
use nalgebra::Vector3;
use platewash_kinematics::Pose;
use platewash_kinematics::ik::IkSolver;
use platewash_workcell::arc::{self, Arc};

/// The arc, and how its points become configurations.
#[derive(Clone, Copy)]
pub struct PaperArc<'a> {
    /// Points, radius and height.
    pub arc: Arc,
    /// Solves for the tip.
    pub solver: &'a IkSolver<'a>,
    /// Pose of the tip at a position \[m\].
    pub pose: &'a dyn Fn(Vector3<f64>) -> Pose,
}

impl PaperArc<'_> {
    /// The way over the arc; `None` where a point of it is out of reach, or reached by a jump only.
    pub(super) fn way(&self, from: &Terminal, to: &Terminal) -> Option<Way> {
        let tip = |q| self.solver.robot().fk(q).rigid(self.solver.frame()).translation;
        let (start, end) = (tip(from.top()), tip(to.top()));
        let points = arc::waypoints(start, end, &self.arc);
        let inner = &points[1..points.len() - 1];
        let poses: Vec<Pose> = inner.iter().map(|&p| (self.pose)(p)).collect();
        let q = self.solver.solve_path(&poses, from.top()).ok()?.q;
        let mut length = 0.0;
        let u = points[..points.len() - 1].windows(2).map(|ends| {
            length += (ends[1] - ends[0]).norm().max(1e-4);
            length
        });
        let u: Vec<f64> = u.collect();
        let last = (end - points[points.len() - 2]).norm().max(1e-4);
        Some(Way {
            length: u.last()? + last,
            u,
            q,
        })
    }
}
