//! Contact of the sponge with a plate: pressed, contact time and contact dose, and the load on the sponge.
//!
//! Requirements 27–31, formulas (27.1) to (31.2) in `docs/contact.md`.

use crate::error::ProveError;
use crate::judged_job::JudgedJob;
use crate::motion::piece::Piece;
use crate::plan_statements::schedule::Schedule;
use crate::report::check::{Check, Measure, Sense, WorstCase, finite, tighter};
use crate::report::requirement::Requirement;
use crate::report::unit::Unit;
use crate::washing::face_shares::{Fineness, Share, Shares, shares};
use crate::washing::holding::holder_load;
use crate::washing::instants::Instants;
use crate::washing::plate_contact::{PlateContact, ProvedExtreme, ProvedShare, are_of_all_plates};
use crate::washing::pressing::{self, DiscWashBounds, Extreme, FRICTION, Pressing};
use crate::washing::wash_inputs::ContactInputs;
use nalgebra::Vector3;

/// Edge of the smallest cells for contact, time and dose, where coarser ones do not suffice \[m\]. Dose and time change fast from place to
/// place where passes only graze it.
const SMALLEST_CELL_M: f64 = 6.25e-5;

impl ContactInputs<'_> {
    /// Bounds the contact: the shares of 27 to 29, strain (30.1), force (31.1), friction torque (31.2) and the holder's load (33.1), (33.2).
    ///
    /// # Errors
    /// [`ProveError::Cancelled`].
    pub fn judge(&self) -> Result<PlateContact, ProveError> {
        let (wanted, foundation, washing) = (self.wanted, self.foundation, self.washing);
        let plate = washing.plate;
        let meets = washing.meets_from_above();
        let mut pressing = if plate.surface.is_flat() {
            let known = DiscWashBounds {
                height_m: washing.tips.greatest_height_of(washing.span),
                cosine: washing.tips.least_upright_cosine_of(washing.span),
                distance_m: self.distance_m,
                error_m: wanted.height_error_m,
            };
            Pressing::on_disc(plate, foundation, self.instants, &known)
        } else if !meets {
            Pressing::unknown()
        } else {
            pressing::on_face(plate, foundation, self.instants, wanted.height_error_m)
        };
        washing.cancel.check()?;
        // The losses between moments are bounded only while no column is compressed by more than its height.
        let known = meets && pressing.deepest.bound <= foundation.free_height_m;
        let found = known.then(|| self.shares());
        for instants in self.around {
            let around = self.around(instants, &pressing);
            pressing.cover_load(&around);
            washing.cancel.check()?;
        }
        let share = |of: fn(&Shares) -> Share, required: f64, threshold: f64| {
            let share = found.as_ref().map(of);
            ProvedShare {
                at_least: share.map_or(0.0, |share| share.at_least),
                required,
                threshold,
                worst: share.and_then(|share| share.worst),
                worst_m: share.and_then(|share| share.worst_m).map(|place| self.world(place)),
            }
        };
        let [softest, stiffest] = foundation.pressure_pa_m();
        let extreme = |of: &Extreme, scale: f64| ProvedExtreme {
            bound: finite(of.bound * scale),
            seen: finite(of.seen * scale),
            time_s: of.time_s,
            place_m: self.world(of.place_m),
        };
        let torque = FRICTION.map(|friction| friction * stiffest * pressing.twist_m4);
        Ok(PlateContact {
            plate: washing.index,
            pressed: share(|s| s.contact, wanted.share, wanted.compression_m),
            time: share(|s| s.time, wanted.time_share, wanted.time_s),
            dose: share(|s| s.dose, wanted.dose_share, wanted.dose_pa_m),
            strain: extreme(&pressing.deepest, 1.0 / foundation.free_height_m),
            least_force_n: extreme(&pressing.volume[0], softest),
            greatest_force_n: extreme(&pressing.volume[1], stiffest),
            friction_torque_nm: Some(torque).filter(|t| t.iter().all(|t| t.is_finite())),
            holder_load: holder_load(self, &pressing),
        })
    }

    /// Bounds the load before or after the wash (30 and 31).
    fn around(&self, instants: &Instants, wash: &Pressing) -> Pressing {
        let (plate, foundation, error_m) = (self.washing.plate, self.foundation, self.wanted.height_error_m);
        if plate.surface.is_flat() {
            Pressing::around_disc(plate, foundation, instants, error_m)
        } else if self.washing.meets_at(self.washing.around_cosine) {
            pressing::around_face(plate, foundation, instants, wash, error_m)
        } else {
            Pressing::unknown()
        }
    }

    /// Computes the shares of 27 to 29, refined until they suffice or the smallest cells are reached.
    fn shares(&self) -> Shares {
        let wanted = self.wanted;
        let asked = wanted.thresholds();
        let fineness = Fineness {
            cell_m: SMALLEST_CELL_M,
            enough: [wanted.share, wanted.time_share, wanted.dose_share],
        };
        let moments = (&self.instants.moments[..], &self.instants.sags[..]);
        shares(&self.washing.plate.surface, self.foundation, moments, &asked, &fineness)
    }

    fn world(&self, place: [f64; 3]) -> [f64; 3] {
        self.washing.plate.world(&Vector3::from(place)).into()
    }
}

/// Checks the contact requirements, where the job has any.
pub(crate) fn checks(
    judged: &JudgedJob<'_>,
    pieces: &[Piece],
    schedule: Option<&Schedule>,
    all: &[PlateContact],
) -> Vec<Check> {
    let Some(wanted) = &judged.job.requirements.contact else {
        return Vec::new();
    };
    let asked = [
        Requirement::Pressed,
        Requirement::ContactTime,
        Requirement::ContactDose,
        Requirement::Strain,
        Requirement::ContactForce,
    ];
    if !are_of_all_plates(judged, all) {
        return asked.map(Check::not_judged).into();
    }
    let share = |requirement, of: fn(&PlateContact) -> &ProvedShare| {
        let least = all.iter().min_by(|a, b| of(a).at_least.total_cmp(&of(b).at_least));
        least.map_or_else(
            || Check::not_judged(requirement),
            |worst| of_share(requirement, worst.plate, of(worst)),
        )
    };
    let strain = (Requirement::Strain, wanted.strain, Sense::AtMost, Unit::Share);
    // Plates with the same window of forces are judged together.
    let window = |plate: usize| {
        let own = judged
            .plates()
            .get(plate)
            .and_then(|plate| judged.job.contact_of(plate));
        own.map_or(wanted.force_n, |own| own.force_n)
    };
    let mut windows: Vec<[f64; 2]> = Vec::new();
    for contact in all {
        let own = window(contact.plate);
        if !windows.contains(&own) {
            windows.push(own);
        }
    }
    let force = |[least_n, most_n]: [f64; 2]| {
        let alike: Vec<_> = all
            .iter()
            .filter(|c| window(c.plate) == [least_n, most_n])
            .copied()
            .collect();
        let side = |limit, sense, of: fn(&PlateContact) -> &ProvedExtreme| {
            let asked = (Requirement::ContactForce, limit, sense, Unit::Newton);
            of_extreme(asked, pieces, schedule, &alike, of)
        };
        tighter(
            side(least_n, Sense::AtLeast, |c| &c.least_force_n),
            side(most_n, Sense::AtMost, |c| &c.greatest_force_n),
        )
    };
    let forces = windows.into_iter().map(force).reduce(tighter);
    vec![
        share(Requirement::Pressed, |c| &c.pressed),
        share(Requirement::ContactTime, |c| &c.time),
        share(Requirement::ContactDose, |c| &c.dose),
        of_extreme(strain, pieces, schedule, all, |c| &c.strain),
        forces.unwrap_or_else(|| Check::not_judged(Requirement::ContactForce)),
    ]
}

fn of_share(requirement: Requirement, plate: usize, share: &ProvedShare) -> Check {
    let measure = Measure::new(
        Sense::AtLeast,
        share.required,
        Unit::Share,
        [Some(share.at_least), None],
    );
    let worst = WorstCase {
        place_m: share.worst_m,
        ..WorstCase::on_plate(plate)
    };
    Check::measured(requirement, measure, worst)
}

/// Checks that an extreme keeps its limit on every plate. Reports the plate with the worst bound.
fn of_extreme(
    (requirement, limit, sense, unit): (Requirement, f64, Sense, Unit),
    pieces: &[Piece],
    schedule: Option<&Schedule>,
    all: &[PlateContact],
    of: impl Fn(&PlateContact) -> &ProvedExtreme,
) -> Check {
    // By how bad it is: what is not known is the worst.
    let sign = if sense == Sense::AtLeast { -1.0 } else { 1.0 };
    let badness = |c: &PlateContact| of(c).bound.map_or(f64::INFINITY, |bound| sign * bound);
    let Some(worst) = all.iter().max_by(|a, b| badness(a).total_cmp(&badness(b))) else {
        return Check::not_judged(requirement);
    };
    let seen = all
        .iter()
        .filter_map(|c| of(c).seen)
        .max_by(|a, b| (sign * a).total_cmp(&(sign * b)));
    let measure = Measure::new(sense, limit, unit, [of(worst).bound, seen]);
    let segment = schedule.and_then(|s| s.at_plate(pieces, worst.plate, of(worst).time_s));
    let place = WorstCase {
        time_s: Some(of(worst).time_s),
        place_m: Some(of(worst).place_m),
        segment,
        ..WorstCase::on_plate(worst.plate)
    };
    Check::measured(requirement, measure, place)
}
