//! Where the reason of a row is.

use platewash_certificate::{Certificate, Requirement};
use platewash_kinematics::ik::IkPathError;
use platewash_planner::{InfeasibleReport, PlanError};
use platewash_scenario::Failure;
use serde::{Deserialize, Serialize};

/// The place of a reason; what does not apply is `None`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// The requirement that is not kept, as in a certificate.
    pub requirement: Option<Requirement>,
    /// Index of the plate.
    pub plate: Option<usize>,
    /// Index of the plan's segment.
    pub segment: Option<usize>,
    /// Index of the waypoint, from 0, on the line over the plate that the arm does not follow.
    pub waypoint: Option<usize>,
    /// Time in the plan \[s\].
    pub time_s: Option<f64>,
    /// The place, world frame \[m\]: of a plan, where it is worst; of a plate that cannot be washed, the first point of its wash path
    /// for which no configuration was found.
    pub point_m: Option<[f64; 3]>,
}

impl Place {
    /// Of the first requirement that is not kept.
    pub(crate) fn of_certificate(certificate: &Certificate) -> Self {
        let place = certificate.broken().next().map(|check| Self {
            requirement: Some(check.requirement),
            plate: check.worst.plate,
            segment: check.worst.segment.map(|(index, _)| index),
            waypoint: None,
            time_s: check.worst.time_s,
            point_m: check.worst.place_m,
        });
        place.unwrap_or_default()
    }

    /// Of what stood in the way of a plan.
    pub(crate) fn of_failure(error: &Failure) -> Self {
        let Failure::Plan(error) = error else {
            return Self::default();
        };
        let report = InfeasibleReport::new("", 0, error);
        let point_m = match error {
            PlanError::Unwashable(plate) => plate.dead_m.first().copied(),
            _ => None,
        };
        let waypoint = match error {
            PlanError::Line { error, .. } => waypoint(error),
            _ => None,
        };
        Self {
            plate: report.and_then(|report| Some(report.plates.first()?.plate)),
            waypoint,
            point_m,
            ..Self::default()
        }
    }
}

fn waypoint(error: &IkPathError) -> Option<usize> {
    match error {
        IkPathError::Waypoint { waypoint, .. } | IkPathError::Broken { waypoint, .. } => Some(*waypoint),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use platewash_kinematics::ik::PathBreak;

    #[test]
    fn a_line_that_breaks_off_is_told_by_plate_and_waypoint() {
        let error = IkPathError::Broken {
            waypoint: 7,
            reason: PathBreak::Limit { joint: 4 },
            solved: Vec::new(),
        };
        let error = Box::new(error);
        let line = PlanError::Line {
            plate: 2,
            lift_m: 0.05,
            error,
        };
        let place = Place::of_failure(&Failure::Plan(line));
        assert_eq!((place.plate, place.waypoint), (Some(2), Some(7)));
    }
}
