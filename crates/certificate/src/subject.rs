//! What is judged: a job with its arm, the limits that follow from both, and how each plate is washed.

use crate::limits::Limits;
use platewash_kinematics::RobotModel;
use platewash_workcell::job::JobTerms;
use platewash_workcell::plate::Plate;
use platewash_workcell::wash_path::WashPath;

/// A job that is judged.
#[derive(Debug)]
pub(crate) struct Subject<'a> {
    pub job: &'a JobTerms,
    pub robot: &'a RobotModel,
    pub limits: Limits,
    paths: Vec<Option<WashPath>>,
}

impl<'a> Subject<'a> {
    /// A job for an arm, with the wash paths of its plates as far as there are any.
    pub fn new(job: &'a JobTerms, robot: &'a RobotModel, paths: Vec<Option<WashPath>>) -> Self {
        let mut limits = Limits::new(job, robot);
        // A path may state a narrower cone than the job allows; what one states, all keep.
        let cones = paths.iter().flatten().map(|path| path.cone_rad);
        limits.tilt_rad = cones.fold(limits.tilt_rad, f64::min);
        Self {
            job,
            robot,
            limits,
            paths,
        }
    }

    /// The plates.
    pub fn plates(&self) -> &'a [Plate] {
        &self.job.plates
    }

    /// How a plate is washed; `None` where that cannot be judged.
    pub fn path_of(&self, plate: usize) -> Option<&WashPath> {
        self.paths.get(plate)?.as_ref()
    }

    /// How far the wash path of a plate gets from its axis \[m\]; `None` where that cannot be judged.
    pub fn path_radius_m(&self, plate: usize) -> Option<f64> {
        let surface = &self.plates().get(plate)?.surface;
        let curve = self.path_of(plate)?.curve;
        Some(surface.at_arc(curve.radius_m).radius_m)
    }

    /// Radius of the sponge \[m\].
    pub fn sponge_m(&self) -> f64 {
        self.job.workcell.tool.sponge.radius_m
    }
}
