//! The terms of a job: everything about it but the arm itself.
//!
//! The frame of a job can be changed to that of the arm's base.

use crate::dry_run::DryRun;
use crate::job::error::TermsError;
use crate::job::kind::{self, PlanKind, Statement, StatementRule};
use crate::job::measured_shape::MeasuredShape;
use crate::job::recovery::Recovery;
use crate::job::requirements::{
    FixtureTerms, HolderTerms, Limits, Planner, PlannerSettings, Requirements, RingTerms, Treatment,
};
use crate::job::soil::Soil;
use crate::layout::MAX_PLATES;
use crate::plate::{GREATEST_M, LEAST_PLATE_M, Plate};
use crate::pose;
use crate::simulation::SimulationSettings;
use crate::workcell::{MOST_BODIES, Workcell};
use platewash_kinematics::{JointVector, Pose};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::f64::consts::FRAC_PI_2;

/// Largest seed. Up to here every whole number is a distinct JSON number (RFC 8785 writes them all as doubles), so that no two seeds have
/// the same text in a plan file.
pub const MAX_SEED: u64 = (1 << 53) - 1;

/// Greatest stiffness of a sponge \[Pa\].
const STIFFEST_PA: f64 = 1e9;

/// Greatest force that a job may state \[N\].
const GREATEST_N: f64 = 1e6;

/// Greatest mass of a plate \[kg\].
const GREATEST_KG: f64 = 1e3;

/// The terms of a job: everything about it but the arm itself, as a plan file states it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JobTerms {
    /// Workcell: arm, mount, tool and obstacles.
    pub workcell: Workcell,
    /// Plates, by index.
    pub plates: Vec<Plate>,
    /// Requirements of the washing.
    pub requirements: Requirements,
    /// Limits of joints and tip, in addition to those of the arm's description.
    pub limits: Limits,
    /// Joint positions at the start and at the end \[rad\].
    pub home_rad: [JointVector; 2],
    /// Planner and its settings: hashed, not judged.
    pub planner: Planner,
    /// Seed of every random stream.
    pub seed: u64,
    /// Settings of the simulation: hashed, not judged.
    pub simulation: SimulationSettings,
    /// Parent plan and height of a dry run; left out of files if the job is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dry_run: Option<DryRun>,
    /// Parent plan and plates left out after a stop; left out of files if the job is no recovery.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub recovery: Option<Recovery>,
    /// Kinds of soil on the plates.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub soils: Vec<Soil>,
    /// Measured shapes of plates, for pictures and reports: hashed, not judged.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub measured: Vec<MeasuredShape>,
}

impl JobTerms {
    /// Returns the treatment of the plates by the job.
    #[must_use]
    pub fn treatment(&self) -> Treatment {
        match (&self.dry_run, &self.requirements.contact) {
            _ if self.is_motion_home() => Treatment::SweptInAir,
            (Some(_), _) => Treatment::SweptInAir,
            (None, Some(_)) => Treatment::Washed,
            (None, None) => Treatment::Swept,
        }
    }

    /// Returns true where the job washes a plate. All plates are washed, but those that a recovery leaves out.
    #[must_use]
    pub fn washes(&self, plate: usize) -> bool {
        let left_out = |recovery: &Recovery| recovery.left_out.contains(&plate);
        !self.recovery.as_ref().is_some_and(left_out)
    }

    /// Returns true for the motion from a stop to home, which washes nothing.
    #[must_use]
    pub fn is_motion_home(&self) -> bool {
        self.recovery.as_ref().is_some_and(Recovery::is_motion_home)
    }

    /// Notices of a dry run and of a recovery, which stand before every verdict and caption; each ends with "; ". Empty for other jobs.
    #[must_use]
    pub fn notices(&self) -> String {
        let dry_run = self.dry_run.iter().map(DryRun::words);
        let all = dry_run.chain(self.recovery.iter().map(Recovery::words));
        all.map(|words| words + "; ").collect()
    }

    /// Returns the requirements that a proof of the job judges: those of the job, without what only the planner follows.
    #[must_use]
    pub fn judged_requirements(&self) -> Requirements {
        let kind = PlanKind::of(self);
        let is_judged = |statement| kind.rule(statement) != StatementRule::Planned;
        let wanted = &self.requirements;
        Requirements {
            contact: wanted.contact.filter(|_| is_judged(Statement::Contact)),
            holder: wanted.holder.filter(|_| is_judged(Statement::Holder)),
            ..*wanted
        }
    }

    /// Indices of the plates that are washed, ascending.
    pub fn plates_to_wash(&self) -> impl Iterator<Item = usize> {
        (0..self.plates.len()).filter(|plate| self.washes(*plate))
    }

    /// Returns the settings of the planner; `None` for a run of the paper's program.
    #[must_use]
    pub fn planner_settings(&self) -> Option<&PlannerSettings> {
        match &self.planner {
            Planner::Wash(settings) => Some(settings),
            Planner::Paper(_) => None,
        }
    }

    /// Largest angle of the tool from a plate's normal \[rad\]: the required one, or that of the sponge if it is smaller.
    #[must_use]
    pub fn tilt_max_rad(&self) -> f64 {
        let sponge = self.workcell.tool.sponge.greatest_tilt_rad();
        self.requirements.tilt_rad.min(sponge)
    }

    /// Largest speed of the tip while it washes \[m/s\], never above that for the whole motion.
    #[must_use]
    pub fn wash_speed_m_s(&self) -> f64 {
        self.requirements.wash_speed_m_s.min(self.limits.tip_speed_m_s)
    }

    /// Largest acceleration of the tip while it washes \[m/s²\], never above that for the whole motion.
    #[must_use]
    pub fn wash_acceleration_m_s2(&self) -> f64 {
        let anywhere = self.limits.tip_acceleration_m_s2;
        self.requirements.wash_acceleration_m_s2.min(anywhere)
    }

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
        kind::check(self)?;
        self.recovery
            .as_ref()
            .map_or(Ok(()), |recovery| recovery.validate(self))?;
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

pub(crate) fn within(name: &'static str, found: f64, [least, most]: [f64; 2]) -> Result<(), TermsError> {
    if (least..=most).contains(&found) {
        return Ok(());
    }
    let expected = format!("from {least} to {most}");
    Err(TermsError::Number { name, expected, found })
}

fn positive(name: &'static str, found: f64) -> Result<(), TermsError> {
    if found > 0.0 && found.is_finite() {
        return Ok(());
    }
    let expected = "finite and above 0".to_owned();
    Err(TermsError::Number { name, expected, found })
}

impl JobTerms {
    /// Returns the terms in the frame of the arm's base: the arm is mounted at the origin, and obstacles and plates are moved accordingly.
    /// Terms whose world frame is that of the base are returned unchanged.
    ///
    /// Joint positions, requirements and limits do not change: a plan, proof or simulation for one is valid for the other.
    #[must_use]
    pub fn seen_from_base(&self) -> Cow<'_, Self> {
        if self.workcell.is_in_base_frame() {
            return Cow::Borrowed(self);
        }
        let to_base = self.workcell.mount.inverse();
        Cow::Owned(Self {
            workcell: self.workcell.seen_from_base().into_owned(),
            plates: self.plates.iter().map(|plate| plate.seen_from(&to_base)).collect(),
            ..self.clone()
        })
    }
}
