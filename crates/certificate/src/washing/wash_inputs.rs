//! Inputs of the judgement of a wash: its motion, its plate, and bounds that are known already.

use crate::judged_job::JudgedJob;
use crate::motion::tip::{Arm, TipPiece};
use crate::motion::tip_limits::Tips;
use crate::washing::instants::Instants;
use platewash_bodies::contact::Foundation;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::ContactRequirements;
use platewash_workcell::plate::Plate;

/// The wash under judgement, with the data it needs.
pub(crate) struct Washing<'a> {
    pub arm: &'a Arm<'a>,
    pub judged: &'a JudgedJob<'a>,
    pub pieces: &'a [TipPiece<'a>],
    /// Pieces of the approaches to the plate and the retreats from it.
    pub around: Vec<&'a [TipPiece<'a>]>,
    /// Lower bound on the cosine of the angle between the tool and the plate's axis, from approach to retreat.
    pub around_cosine: f64,
    pub span: usize,
    pub plate: &'a Plate,
    /// Index of the plate.
    pub index: usize,
    pub tips: &'a Tips,
    pub cancel: &'a CancelToken,
}

impl Washing<'_> {
    /// Checks that every line along the tool's axis meets the face once, and from above: the tilt of the tool from the plate's axis is less
    /// than a right angle minus the steepest slope.
    pub fn meets_from_above(&self) -> bool {
        self.meets_at(self.tips.least_upright_cosine_of(self.span))
    }

    /// Same check, with a lower bound `cosine` on the cosine of the angle between the tool and the plate's axis.
    pub fn meets_at(&self, cosine: f64) -> bool {
        let surface = &self.plate.surface;
        let steepest = surface.patch([0.0, f64::INFINITY]);
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let slope = steepest.sine[0].abs().max(steepest.sine[1].abs());
        cosine * steepest.least_cosine() > sine * slope
    }
}

/// Wash whose contact is judged, with the data it needs.
pub(crate) struct ContactInputs<'a> {
    pub washing: &'a Washing<'a>,
    pub foundation: &'a Foundation,
    pub wanted: &'a ContactRequirements,
    pub instants: &'a Instants,
    /// Moments of the approaches to the plate and the retreats from it.
    pub around: &'a [Instants],
    /// Upper bound on the distance of the tip from the plate's pole during the wash, seen along the plate's axis \[m\].
    pub distance_m: f64,
}
