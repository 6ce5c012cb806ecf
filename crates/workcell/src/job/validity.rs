//! Validity of a job: its terms can be computed with, and do not contradict each other.

use crate::dry_run::is_hash;
use crate::job::error::TermsError;
use crate::job::kind::{Statement, StatementRule};
use crate::job::planner_settings::Planner;
use crate::job::ranges::{positive, within};
use crate::job::recovery::{Recovery, RecoveryPart};
use crate::job::requirements::{FixtureTerms, HolderTerms, RingTerms};
use crate::job::soil::Soil;
use crate::job::terms::{JobTerms, MAX_SEED};
use crate::layout::MAX_PLATES;
use crate::plate::{GREATEST_M, LEAST_PLATE_M, Plate};
use crate::pose;
use crate::workcell::{MOST_BODIES, Workcell};
use platewash_kinematics::Pose;
use std::f64::consts::FRAC_PI_2;

/// Greatest stiffness of a sponge \[Pa\].
const STIFFEST_PA: f64 = 1e9;

/// Greatest force that a job may state \[N\].
const GREATEST_N: f64 = 1e6;

/// Greatest mass of a plate \[kg\].
const GREATEST_KG: f64 = 1e3;

/// Least length of a retreat \[m\].
const LEAST_RETREAT_M: f64 = 1e-4;

impl JobTerms {
    /// Checks that the terms can be computed with. NaN and infinity are refused.
    ///
    /// # Errors
    /// [`TermsError`] with the first error.
    pub fn validate(&self) -> Result<(), TermsError> {
        let wanted = &self.requirements;
        within("requirements.coverage", wanted.coverage, [0.0, 1.0])?;
        within("requirements.clearance_m", wanted.clearance_m, [0.0, 1.0])?;
        within("requirements.tilt_rad", wanted.tilt_rad, [0.0, FRAC_PI_2])?;
        positive("requirements.wash_speed_m_s", wanted.wash_speed_m_s)?;
        positive("requirements.wash_acceleration_m_s2", wanted.wash_acceleration_m_s2)?;
        self.check_contact()?;
        self.check_holder()?;
        for joint in self.limits.joint_acceleration_rad_s2 {
            positive("limits.joint_acceleration_rad_s2", joint)?;
        }
        positive("limits.tip_speed_m_s", self.limits.tip_speed_m_s)?;
        positive("limits.tip_acceleration_m_s2", self.limits.tip_acceleration_m_s2)?;
        for joint in self.home_rad.iter().flatten() {
            within("home_rad", *joint, [-1e3, 1e3])?;
        }
        if self.seed > MAX_SEED {
            return Err(TermsError::Seed { found: self.seed });
        }
        self.check_tool()?;
        check_workcell(&self.workcell, self.plates.len())?;
        for reduced in &self.workcell.reduced_clearances {
            let (name, by_m) = ("workcell.reduced_clearances.by_m", reduced.by_m);
            positive(name, by_m)?;
            if by_m >= wanted.clearance_m {
                let expected = format!("below requirements.clearance_m, {}", wanted.clearance_m);
                return Err(TermsError::Number {
                    name,
                    expected,
                    found: by_m,
                });
            }
        }
        self.check_dry_run()?;
        check_statements(self)?;
        self.recovery
            .as_ref()
            .map_or(Ok(()), |recovery| check_recovery(recovery, self))?;
        self.check_soils()?;
        let count = self.plates.len();
        if !(1..=MAX_PLATES).contains(&count) {
            return Err(TermsError::PlateCount { found: count });
        }
        match self.plates.iter().position(|plate| !plate.is_sound()) {
            Some(plate) => Err(TermsError::NoPlate { plate }),
            None => Ok(()),
        }
    }

    fn check_tool(&self) -> Result<(), TermsError> {
        let tool = &self.workcell.tool;
        for (name, size) in [
            ("workcell.tool.sponge.radius_m", tool.sponge.radius_m),
            ("workcell.tool.sponge.height_m", tool.sponge.height_m),
        ] {
            positive(name, size)?;
            within(name, size, [0.0, GREATEST_M])?;
        }
        let most = tool.sponge.height_m;
        within(
            "workcell.tool.sponge.compression_m",
            tool.sponge.compression_m,
            [0.0, most],
        )?;
        for at in tool
            .tip
            .translation
            .vector
            .iter()
            .chain(&tool.sponge.pose.translation.vector)
        {
            within("workcell.tool.tip", *at, [-10.0, 10.0])?;
        }
        Ok(())
    }

    fn check_contact(&self) -> Result<(), TermsError> {
        let (wanted, sponge) = (&self.requirements, &self.workcell.tool.sponge);
        for (name, speed) in [
            ("requirements.landing_m_s", wanted.landing_m_s),
            ("requirements.lifting_m_s", wanted.lifting_m_s),
        ] {
            speed.map_or(Ok(()), |speed| positive(name, speed))?;
        }
        if let Some(wrist) = wanted.wrist_rad {
            within("requirements.wrist_rad", wrist, [0.0, FRAC_PI_2])?;
        }
        if let Some([least, most]) = sponge.stiffness_pa {
            positive("workcell.tool.sponge.stiffness_pa", least)?;
            within("workcell.tool.sponge.stiffness_pa", most, [least, STIFFEST_PA])?;
        }
        let Some(contact) = &wanted.contact else { return Ok(()) };
        if sponge.stiffness_pa.is_none() {
            return Err(TermsError::NoStiffness);
        }
        within(
            "requirements.contact.compression_m",
            contact.compression_m,
            [0.0, GREATEST_M],
        )?;
        within(
            "requirements.contact.height_error_m",
            contact.height_error_m,
            [0.0, GREATEST_M],
        )?;
        within("requirements.contact.strain", contact.strain, [0.0, 1.0])?;
        for (name, share) in [
            ("requirements.contact.share", contact.share),
            ("requirements.contact.time_share", contact.time_share),
            ("requirements.contact.dose_share", contact.dose_share),
        ] {
            within(name, share, [0.0, 1.0])?;
        }
        let [least, most] = contact.force_n;
        within("requirements.contact.force_n", least, [0.0, GREATEST_N])?;
        within("requirements.contact.force_n", most, [least, GREATEST_N])?;
        within("requirements.contact.time_s", contact.time_s, [0.0, 1e6])?;
        within("requirements.contact.dose_pa_m", contact.dose_pa_m, [0.0, 1e9])
    }

    fn check_holder(&self) -> Result<(), TermsError> {
        let Some(holder) = &self.requirements.holder else {
            return Ok(());
        };
        let HolderTerms {
            sponge_friction,
            plate_mass_kg,
            fixture,
            ring,
        } = *holder;
        let fault = match (fixture, ring) {
            _ if self.requirements.contact.is_none() => "needs requirements.contact: without it no force is proved",
            (Some(_), Some(_)) => "is a fixture or a ring, not both",
            (None, None) => "states neither a fixture nor a ring",
            (None, Some(_)) if plate_mass_kg.is_none() => {
                "needs plate_mass_kg: the weight presses a plate onto its ring"
            }
            _ => "",
        };
        if !fault.is_empty() {
            return Err(TermsError::Holder(fault));
        }
        within("requirements.holder.sponge_friction", sponge_friction, [0.0, 10.0])?;
        within(
            "requirements.holder.plate_mass_kg",
            plate_mass_kg.unwrap_or(0.0),
            [0.0, GREATEST_KG],
        )?;
        if let Some(FixtureTerms { force_n, torque_nm }) = fixture {
            within("requirements.holder.fixture.force_n", force_n, [0.0, GREATEST_N])?;
            within("requirements.holder.fixture.torque_nm", torque_nm, [0.0, GREATEST_N])?;
        }
        if let Some(RingTerms { friction, radius_m }) = ring {
            let has_back = |plate: &Plate| self.plates.iter().any(|other| plate.is_back_of(other));
            if self.plates.iter().any(has_back) {
                let fault =
                    "is a ring, and both faces of a plate are washed: it would stand on one of them; state a fixture";
                return Err(TermsError::Holder(fault));
            }
            within("requirements.holder.ring.friction", friction, [0.0, 10.0])?;
            // No wider than any plate, nor than the foot of one that has a foot.
            let outer = |plate: &Plate| plate.foot.map_or(plate.rim_m(), |foot| foot.radius_m);
            let most_m = self.plates.iter().map(outer).fold(GREATEST_M, f64::min);
            within("requirements.holder.ring.radius_m", radius_m, [LEAST_PLATE_M, most_m])?;
        }
        Ok(())
    }

    fn check_dry_run(&self) -> Result<(), TermsError> {
        let Some(dry_run) = &self.dry_run else { return Ok(()) };
        let (name, found) = ("dry_run.height_m", dry_run.height_m);
        positive(name, found)?;
        within(name, found, [0.0, GREATEST_M])?;
        match (&self.planner, dry_run.names_a_hash()) {
            (Planner::Paper(_), _) => Err(TermsError::PaperDryRun),
            (_, false) => Err(TermsError::Parent),
            _ => Ok(()),
        }
    }

    /// Checks the soils, and that every plate's terms name one that there is.
    fn check_soils(&self) -> Result<(), TermsError> {
        self.soils.iter().try_for_each(Soil::validate)?;
        let names_one = |index: Option<usize>, of: usize| index.is_none_or(|index| index < of);
        let lost = |plate: &Plate| {
            !names_one(plate.terms.soil, self.soils.len()) || !names_one(plate.terms.measured, self.measured.len())
        };
        match self.plates.iter().position(lost) {
            Some(plate) => Err(TermsError::NoPlate { plate }),
            None => Ok(()),
        }
    }
}

/// Checks that the mount, the bodies and the obstacles of a workcell with `plates` plates are valid.
///
/// # Errors
/// [`TermsError`] with the first error.
pub fn check_workcell(workcell: &Workcell, plates: usize) -> Result<(), TermsError> {
    let is_near = |pose: &Pose| pose.translation.vector.iter().all(|at| at.abs() <= GREATEST_M);
    if !(pose::is_sound(&workcell.mount) && is_near(&workcell.mount)) {
        return Err(TermsError::Mount);
    }
    let found = workcell.bodies();
    if found > MOST_BODIES {
        return Err(TermsError::TooManyBodies { found });
    }
    for obstacle in &workcell.obstacles {
        if let Some(fault) = obstacle.fault(plates) {
            let name = obstacle.name.clone();
            return Err(TermsError::Obstacle { name, fault });
        }
    }
    Ok(())
}

/// Checks that a job makes the statements that its kind needs, and none that it has no use for. Order and wash paths are for the
/// certificate.
///
/// # Errors
/// [`TermsError::Statement`] with the first fault.
fn check_statements(job: &JobTerms) -> Result<(), TermsError> {
    let kind = job.kind();
    for statement in Statement::ALL {
        let is_needed = match (kind.rule(statement), is_made(statement, job)) {
            (StatementRule::Needed, Some(false)) => true,
            (StatementRule::Refused, Some(true)) => false,
            _ => continue,
        };
        return Err(TermsError::Statement {
            kind,
            path: statement.path(),
            is_needed,
        });
    }
    Ok(())
}

/// Returns true if a job makes the statement; `None` for a statement of the plan outside of its job.
fn is_made(statement: Statement, job: &JobTerms) -> Option<bool> {
    let wanted = &job.requirements;
    match statement {
        Statement::Order | Statement::WashPaths => None,
        Statement::DryRun => Some(job.dry_run.is_some()),
        Statement::NearAtStop => Some(job.workcell.reduced_clearances.iter().any(|pair| pair.at_stop)),
        Statement::Contact => Some(wanted.contact.is_some()),
        Statement::Holder => Some(wanted.holder.is_some()),
        Statement::LandingSpeed => Some(wanted.landing_m_s.is_some()),
        Statement::LiftingSpeed => Some(wanted.lifting_m_s.is_some()),
        Statement::Wrist => Some(wanted.wrist_rad.is_some()),
    }
}

/// Checks that the statement about a recovery fits the job.
fn check_recovery(recovery: &Recovery, job: &JobTerms) -> Result<(), TermsError> {
    let refused = |fault| Err(TermsError::Recovery { fault });
    let count = job.plates.len();
    if !is_hash(&recovery.parent) {
        return refused("parent must be the hash of a plan, 64 digits of lower-case hexadecimal");
    }
    if matches!(job.planner, Planner::Paper(_)) {
        return refused("a run of the paper's program cannot be one");
    }
    let ascends = recovery.left_out.windows(2).all(|pair| pair[0] < pair[1]);
    if !ascends || recovery.left_out.last().is_some_and(|last| *last >= count) {
        return refused("left_out must list indices of plates, ascending");
    }
    match recovery.part {
        RecoveryPart::Rest if recovery.left_out.is_empty() || recovery.left_out.len() == count => {
            refused("the rest leaves out some plates and not all")
        }
        RecoveryPart::Home { .. } if recovery.left_out.len() != count => {
            refused("the motion home leaves out all plates")
        }
        RecoveryPart::Home { retreat: Some(line) } if line.plate >= count => {
            refused("retreat.plate must be the index of a plate")
        }
        RecoveryPart::Home { retreat: Some(line) } => within(
            "recovery.part.home.retreat.length_m",
            line.length_m,
            [LEAST_RETREAT_M, GREATEST_M],
        ),
        _ => Ok(()),
    }
}
