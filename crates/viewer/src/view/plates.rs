//! Plates, and the paths that the tip follows on them.

use super::numbers::Numbers;
use super::tips::{Tips, washes};
use nalgebra::Vector3;
use platewash_motion::plan::Plan;
use platewash_workcell::job::{JobTerms, Relief};
use platewash_workcell::plate;
use platewash_workcell::wash_path::{self, WashCurve};
use platewash_workcell::words::plate_name;
use serde::Serialize;
use ts_rs::TS;

/// Largest deviation of a chord from a wash path \[m\].
const CHORD_M: f64 = 5e-5;

/// Radius of a spiral that is drawn at most, as a multiple of the plate's.
const MOST_RIMS: f64 = 10.0;

/// Largest turn of a face between two points of its meridian \[rad\].
const TURN_RAD: f64 = 0.06;

/// A plate.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
#[ts(optional_fields)]
pub struct Plate {
    /// Its name, as the pairs of bodies have it.
    pub name: String,
    /// The face from the pole to the rim: distance from the axis, and height \[m\].
    pub meridian_m: Vec<[f64; 2]>,
    /// Its terms in words, where they differ from those of the job.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub own: Option<String>,
    /// Heights of the measured plate.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relief: Option<Relief>,
    /// The rest of it.
    #[serde(flatten)]
    pub plate: plate::Plate,
}

/// Path that the tip follows on a plate.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct WashPath {
    /// Index of the plate.
    pub plate: usize,
    /// \[n, 3\], world frame \[m\].
    pub points_m: Numbers,
}

impl Plate {
    /// Makes the page's plate with an index.
    #[must_use]
    pub fn new(index: usize, plate: &plate::Plate) -> Self {
        Self {
            name: plate_name(index),
            own: plate.terms_words(&[]),
            relief: None,
            meridian_m: plate.surface.outline_m(TURN_RAD),
            plate: *plate,
        }
    }

    /// Same for a plate of a job, with its soil and its measured shape.
    #[must_use]
    pub fn of_job(index: usize, plate: &plate::Plate, job: &JobTerms) -> Self {
        let measured = plate.terms.measured.and_then(|shape| job.measured.get(shape));
        Self {
            own: plate.terms_words(&job.soils),
            relief: measured.map(|shape| shape.relief.clone()),
            ..Self::new(index, plate)
        }
    }
}

/// The wash paths that a plan states, in the order of washing; where it states none, the paths of the tip while it washes.
pub(super) fn paths(plan: &Plan, tips: &Tips<'_>) -> Vec<WashPath> {
    let path = |plate, points: Vec<Vector3<f64>>| WashPath {
        plate,
        points_m: Numbers::f32_rows(points.iter()),
    };
    if plan.wash_paths.is_empty() {
        let on_way = |[from, to]: [f64; 2]| tips.during(from, to).iter().map(|tip| tip.at).collect();
        let planned = washes(plan).map(|(plate, span)| path(plate, on_way(span)));
        return planned.collect();
    }
    let stated = plan.wash_paths.iter();
    let stated = stated.filter_map(|stated| Some((stated, plan.job.plates.get(stated.plate)?)));
    let drawn = stated.filter(|(stated, plate)| can_be_drawn(&stated.curve, plate));
    drawn
        .map(|(stated, plate)| path(stated.plate, points(stated, plate)))
        .collect()
}

/// Checks that a curve is on a plate, and has few enough points to draw. The proof checks that it is the right curve.
fn can_be_drawn(curve: &WashCurve, plate: &plate::Plate) -> bool {
    curve.is_sound() && curve.radius_m <= MOST_RIMS * plate.rim_m()
}

/// Points of a stated path, world frame \[m\].
fn points(path: &wash_path::WashPath, plate: &plate::Plate) -> Vec<Vector3<f64>> {
    let parameters = path.curve.parameters(&plate.surface, CHORD_M);
    parameters.into_iter().map(|theta| path.contact(plate, theta)).collect()
}
