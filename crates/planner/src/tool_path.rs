//! What the tip shall do: segments of waypoints, as poses of the tip frame.
//!
//! The tip frame stands at the centre of the sponge's far face with z leaving the tool; without a tool body it is
//! the mounting frame (`tool0`). Washing, it points straight down.

use crate::cubic;
use crate::order::order;
use crate::scenario::{Interpolation, Scenario};
use crate::spiral::Spiral;
use nalgebra::Vector3;
use platewash_workcell::arc;
use platewash_workcell::layout::{Layout, Plate};
pub use platewash_workcell::segment::SegmentKind;
use platewash_workcell::stroke::Stroke;
use serde::{Deserialize, Serialize};

/// How the waypoints of a segment come about, as parameters (base frame, m).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "shape", rename_all = "snake_case")]
pub enum Shape {
    /// A spiral about a plate's centre.
    Spiral {
        /// Centre, at the height of the tip \[m\].
        centre_m: [f64; 3],
        /// Normal of the plane of the spiral.
        normal: [f64; 3],
        /// The spiral.
        #[serde(flatten)]
        spiral: Spiral,
    },
    /// A continuous spiral about a plate's centre, with the tool within a cone about the normal.
    Stroke {
        /// Centre, at the height of the tip \[m\].
        centre_m: [f64; 3],
        /// Normal of the plate.
        normal: [f64; 3],
        /// The spiral.
        #[serde(flatten)]
        stroke: Stroke,
    },
    /// A straight line along a plate's normal: downwards for an approach, upwards for a retreat.
    Line {
        /// Its lower end \[m\].
        foot_m: [f64; 3],
        /// Its direction upwards.
        normal: [f64; 3],
        /// Its length \[m\].
        height_m: f64,
    },
    /// However the joints move.
    Free,
    /// A curve through points.
    Curve {
        /// The points \[m\].
        through_m: Vec<[f64; 3]>,
        /// The curve.
        interpolation: Interpolation,
        /// Samples along it, both ends included.
        samples: usize,
    },
}

/// A stretch of the tool path.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Segment {
    /// What it is for.
    pub kind: SegmentKind,
    /// The plate washed, or the plate it leads to.
    pub plate: usize,
    /// Where its waypoints come from.
    #[serde(flatten)]
    pub shape: Shape,
    /// Positions of the tip \[m\]; none for the shapes of a certified job.
    #[serde(skip)]
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
    /// The path that a scenario asks for on a layout: each plate's spiral, and transitions between. There is none
    /// before the first plate and none after the last: neither has the paper's program, which starts at
    /// the position (0, 0) it believes in.
    #[must_use]
    pub fn new(scenario: &Scenario, layout: &Layout) -> Self {
        let spiral = spiral(scenario);
        let end = |p: &Plate| {
            spiral
                .waypoints([p.x_m, p.y_m])
                .last()
                .copied()
                .unwrap_or([p.x_m, p.y_m])
        };
        let order = order(&layout.plates, scenario.job.order, [0.0, 0.0], end);
        let mut segments: Vec<Segment> = Vec::new();
        for &plate in &order {
            let wash = wash_segment(scenario, &layout.plates[plate], plate);
            let from = segments.last().and_then(|s| s.waypoints.last()).copied();
            if let (Some(from), Some(&to)) = (from, wash.waypoints.first()) {
                segments.push(transition_segment(scenario, from, to, plate));
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

    /// Whether there is no waypoint at all.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

fn spiral(scenario: &Scenario) -> Spiral {
    let wash = &scenario.wash;
    Spiral {
        points: wash.points,
        turns: wash.turns,
        radius_m: wash.path_radius_m,
        closing_ring: wash.closing_ring,
    }
}

fn wash_segment(scenario: &Scenario, plate: &Plate, index: usize) -> Segment {
    let spiral = spiral(scenario);
    let z = plate.z_m + scenario.wash.height_m;
    let waypoints = spiral.waypoints([plate.x_m, plate.y_m]);
    Segment {
        kind: SegmentKind::Wash,
        plate: index,
        waypoints: waypoints.into_iter().map(|[x, y]| Vector3::new(x, y, z)).collect(),
        shape: Shape::Spiral {
            centre_m: [plate.x_m, plate.y_m, z],
            normal: [0.0, 0.0, 1.0],
            spiral,
        },
    }
}

fn transition_segment(scenario: &Scenario, from: Vector3<f64>, to: Vector3<f64>, plate: usize) -> Segment {
    let section = &scenario.transition;
    let through = arc::waypoints(from, to, &scenario.arc());
    Segment {
        kind: SegmentKind::Transition,
        plate,
        waypoints: cubic::sample(&through, section.interpolation, section.samples),
        shape: Shape::Curve {
            through_m: through.into_iter().map(Into::into).collect(),
            interpolation: section.interpolation,
            samples: section.samples,
        },
    }
}
