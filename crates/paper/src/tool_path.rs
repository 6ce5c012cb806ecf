//! Path of the tip: segments of waypoints, as positions of the tip frame.
//!
//! The tip frame stands at the centre of the sponge's far face with z leaving the tool; without a tool body it is
//! the mounting frame (`tool0`). It points straight down everywhere.

use crate::cubic;
use crate::order::order;
use crate::settings::PaperSettings;
use nalgebra::Vector3;
use platewash_motion::trajectory::SegmentKind;
use platewash_workcell::arc;
use platewash_workcell::plate::Plate;

/// A stretch of the tool path.
#[derive(Debug, Clone, PartialEq)]
pub struct Segment {
    /// Kind of the segment.
    pub kind: SegmentKind,
    /// The plate washed, or the plate it leads to.
    pub plate: usize,
    /// Positions of the tip \[m\].
    pub waypoints: Vec<Vector3<f64>>,
}

/// The whole tool path, plate after plate.
#[derive(Debug, Clone, PartialEq)]
pub struct ToolPath {
    /// Plate indices in the order of washing.
    pub order: Vec<usize>,
    /// The segments in time order.
    pub segments: Vec<Segment>,
}

impl ToolPath {
    /// The path over some plates: each plate's spiral, and transits between. There is none before the first plate and none after the
    /// last: neither has the paper's program, which starts at the position (0, 0) it believes in.
    #[must_use]
    pub fn new(settings: &PaperSettings, plates: &[Plate]) -> Self {
        let end = |plate: &Plate| {
            let centre = plate.centre_xy();
            settings.spiral.waypoints(centre).last().copied().unwrap_or(centre)
        };
        let order = order(plates, settings.order, [0.0, 0.0], end);
        let mut segments: Vec<Segment> = Vec::new();
        for &plate in &order {
            let wash = wash_segment(settings, &plates[plate], plate);
            let from = segments.last().and_then(|s| s.waypoints.last()).copied();
            if let (Some(from), Some(&to)) = (from, wash.waypoints.first()) {
                segments.push(transit_segment(settings, from, to, plate));
            }
            segments.push(wash);
        }
        Self { order, segments }
    }

    /// Waypoints of all segments.
    #[must_use]
    pub fn len(&self) -> usize {
        self.segments.iter().map(|s| s.waypoints.len()).sum()
    }

    /// Returns true where there is no waypoint at all.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

fn wash_segment(settings: &PaperSettings, plate: &Plate, index: usize) -> Segment {
    let z = plate.centre().z + settings.height_m;
    let waypoints = settings.spiral.waypoints(plate.centre_xy());
    Segment {
        kind: SegmentKind::Wash,
        plate: index,
        waypoints: waypoints.into_iter().map(|[x, y]| Vector3::new(x, y, z)).collect(),
    }
}

fn transit_segment(settings: &PaperSettings, from: Vector3<f64>, to: Vector3<f64>, plate: usize) -> Segment {
    let through = arc::waypoints(from, to, &settings.arc);
    Segment {
        kind: SegmentKind::Transit,
        plate,
        waypoints: cubic::sample(&through, settings.transit.interpolation, settings.transit.samples),
    }
}
