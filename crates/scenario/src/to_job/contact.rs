//! Requirements of `[wash]` on the contact of sponge and plate, with their defaults, and keys of it that contradict each other.

use crate::error::{Problem, conflict};
use crate::keys::stated::first_stated;
use crate::scenario::Scenario;
use crate::sections::motion::Program;
use crate::sections::tool::ASSUMED_STIFFNESS_KPA;
use crate::sections::wash::WashSection;
use platewash_kinematics::trig::sin_cos;
use platewash_workcell::job::{CONTACT_SPEED_M_S, ContactRequirements, PATH_TOLERANCE_M, WRIST_DEG};
use platewash_workcell::tool::Tool;
use platewash_workcell::wash_path::{PatternRules, TurnsRule};
use std::f64::consts::PI;

/// Requirements of a promised contact, where no others are stated.
const PROMISED: ContactRequirements = ContactRequirements {
    compression_m: 0.001,
    height_error_m: 0.001,
    share: 0.995,
    strain: 0.6,
    force_n: [1.0, 40.0],
    time_s: 0.1,
    time_share: 0.99,
    dose_pa_m: 50.0,
    dose_share: 0.99,
};

impl WashSection {
    /// Requirements on the contact; `None` where contact is no part of the job.
    #[must_use]
    pub fn contact_requirements(&self) -> Option<ContactRequirements> {
        self.contact.then(|| ContactRequirements {
            compression_m: self.contact_compression_m.unwrap_or(PROMISED.compression_m),
            height_error_m: self.contact_height_error_m.unwrap_or(PROMISED.height_error_m),
            share: self.contact_share.unwrap_or(PROMISED.share),
            strain: self.contact_strain.unwrap_or(PROMISED.strain),
            force_n: self.contact_force_n.unwrap_or(PROMISED.force_n),
            time_s: self.contact_time_s.unwrap_or(PROMISED.time_s),
            time_share: self.contact_time_share.unwrap_or(PROMISED.time_share),
            dose_pa_m: self.contact_dose_pa_m.unwrap_or(PROMISED.dose_pa_m),
            dose_share: self.contact_dose_share.unwrap_or(PROMISED.dose_share),
        })
    }

    /// Limits of the contact speed: of the free sponge that lands on a plate, and that lifts off \[m/s\]; `None` where there is no limit of its
    /// own.
    #[must_use]
    pub fn landing_and_lifting_m_s(&self) -> [Option<f64>; 2] {
        let promised = self.contact.then_some(CONTACT_SPEED_M_S);
        [self.landing_speed_m_s, self.lifting_speed_m_s].map(|stated| stated.or(promised))
    }

    /// Least angle of joint 5 from 0 at a plate \[rad\]; `None` where no angle is required.
    #[must_use]
    pub fn wrist_rad(&self) -> Option<f64> {
        let promised = self.contact.then_some(WRIST_DEG);
        self.wrist_min_deg.or(promised).map(f64::to_radians)
    }

    /// The keys that say how much contact, of those that are stated.
    fn stated_contact_key(&self) -> Option<&'static str> {
        first_stated(self, Self::KEYS, |name| name.starts_with("contact_")).map(|key| key.path)
    }
}

impl Scenario {
    /// Refuses keys of the wash path and of its contact that contradict each other.
    pub(crate) fn check_contact(&self) -> Result<(), Problem> {
        let (wash, certified) = (&self.wash, self.job.program == Program::Certified);
        if let Some(key) = wash.stated_contact_key().filter(|_| !wash.contact) {
            return conflict(
                key,
                "says how much contact there must be, which wash.contact = true asks for",
            );
        }
        if wash.contact && !certified {
            let detail = "contact is promised of a plan as a whole: it needs job.program = \"certified\"";
            return conflict("wash.contact", detail);
        }
        if let Some(planned) = wash.tilt_deg.filter(|planned| *planned > wash.tilt_max_deg) {
            let most = wash.tilt_max_deg;
            return conflict(
                "wash.tilt_deg",
                format!("what is planned must be at most wash.tilt_max_deg = {most}; found {planned}"),
            );
        }
        if let Some(wanted) = wash.contact_requirements() {
            self.check_promise(&wanted)?;
        }
        match wash.pattern.filter(|_| certified) {
            Some(pattern) => self.check_pattern(&pattern.rules()),
            None => Ok(()),
        }
    }

    /// Refuses a promise that no plan can keep.
    ///
    /// The tip washes on the face, so that the column at the sponge's axis is compressed by c + δ cos τ with the plate at its highest. Nowhere
    /// is the sponge pressed by more than its greatest strain, and its force is then E π s² times that at most. With the plate at its lowest
    /// an inclined sponge presses a flat one by c − δ cos τ + s tan τ at most, which grows with τ; other faces may be hollow.
    fn check_promise(&self, wanted: &ContactRequirements) -> Result<(), Problem> {
        let sponge = Tool::from(self.tool.straight()).sponge;
        let (c, error_m, s) = (sponge.compression_m, wanted.height_error_m, sponge.radius_m);
        let (sine, cosine) = sin_cos(self.wash.tilt_max_deg.to_radians().min(sponge.greatest_tilt_rad()));
        let (most_m, free_m) = (c + error_m * cosine, sponge.free_height_m());
        if most_m > wanted.strain * free_m {
            return conflict(
                "tool.sponge_compression_m, wash.contact_height_error_m, wash.contact_strain",
                format!(
                    "with the plate higher by contact_height_error_m = {error_m} the sponge would be compressed by at least {most_m:.6} m; expected at most \
                     contact_strain = {} of its free height of {free_m:.6} m, {:.6} m",
                    wanted.strain,
                    wanted.strain * free_m
                ),
            );
        }
        let least_m = c + PATH_TOLERANCE_M - error_m * cosine + s * sine / cosine;
        // The shape of a plate out of a file is known once that is read.
        let unread = !self.plate_files.are_read() && !self.plate_paths().is_empty();
        if !unread
            && self.kinds().iter().any(|(_, geometry)| geometry.surface.is_flat())
            && least_m < wanted.compression_m
        {
            return conflict(
                "tool.sponge_compression_m, wash.contact_compression_m, wash.contact_height_error_m",
                format!(
                    "with the plate lower by contact_height_error_m = {error_m} no place would be pressed by more than {least_m:.6} m; expected at least \
                     contact_compression_m = {}",
                    wanted.compression_m
                ),
            );
        }
        let [softest_kpa, _] = self.tool.sponge_stiffness_kpa.unwrap_or(ASSUMED_STIFFNESS_KPA);
        let most_n = 1e3 * softest_kpa * PI * s * s * wanted.strain;
        let [asked_n, _] = wanted.force_n;
        if most_n < asked_n {
            return conflict(
                "wash.contact_force_n, tool.sponge_stiffness_kpa, tool.sponge_radius_m",
                format!(
                    "the softest sponge, of {softest_kpa} kPa, presses with at most {most_n:.3} N at wash.contact_strain = {}; expected at least {asked_n} N",
                    wanted.strain
                ),
            );
        }
        Ok(())
    }

    /// Refuses numbers that the pattern has no use for.
    fn check_pattern(&self, rules: &PatternRules) -> Result<(), Problem> {
        let (wash, name) = (&self.wash, rules.name);
        if rules.always_closes && wash.closing_ring == Some(false) {
            let detail = format!("{name} end with one: leave it out, or state wash.pattern = \"spiral\"");
            return conflict("wash.closing_ring", detail);
        }
        match (rules.turns, wash.turns) {
            (TurnsRule::Whole { counted, most }, Some(turns))
                if turns.fract() != 0.0 || !(1.0..=most as f64).contains(&turns) =>
            {
                conflict(
                    "wash.turns",
                    format!(
                        "with wash.pattern = \"{name}\" these are {counted}, a whole number from 1 to {most}; found {turns:?}"
                    ),
                )
            }
            _ => Ok(()),
        }
    }
}
