//! A plan with its certificate, for people and as data.

use platewash_certificate::{self as certificate, Certificate};
use platewash_kinematics::AXES;
use platewash_kinematics::trig::acos;
use platewash_kinematics::words::decimals_up;
use platewash_planner::redundancy::TiltChoice;
use platewash_planner::{PlannedJob, TourSummary, TransitSummary, VisitSummary};
use platewash_workcell::layout::Finding;
use platewash_workcell::verdict::Verdict;
use platewash_workcell::words::{plate_name, quoted};
use serde::Serialize;
use std::fmt;

/// A plan and its proof. Lengths in metres, times in seconds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WashReport {
    /// Name of the scenario.
    pub scenario: String,
    /// Its seed.
    pub seed: u64,
    /// Name of the arm.
    pub robot: String,
    /// Verdict on the washing.
    pub verdict: Verdict,
    /// The first line, that of the certificate.
    pub headline: String,
    /// Duration \[s\].
    pub duration_s: f64,
    /// One entry a plate, in the order of washing.
    pub visits: Vec<VisitSummary>,
    /// From home, between the plates, and home.
    pub transits: Vec<TransitSummary>,
    /// Estimated travel time of the order, compared with a simple one.
    pub tour: TourSummary,
    /// Largest jerk of each joint between knots \[rad/s³\]: reported, not judged. At knots the acceleration may jump.
    pub jerk_rad_s3: [f64; AXES],
    /// Findings about the plates.
    pub findings: Vec<Finding>,
    /// The proof.
    pub certificate: Certificate,
}

impl WashReport {
    /// Sums up a plan and its certificate; `findings` are those of its layout.
    #[must_use]
    pub fn new(planned: &PlannedJob, findings: &[Finding], certificate: Certificate) -> Self {
        let verdict = match certificate.verdict {
            certificate::Verdict::Pass if certificate.rests_on.dry_run.is_some() => Verdict::DryRun,
            certificate::Verdict::Pass if certificate.rests_on.requirements.contact.is_none() => Verdict::Swept,
            certificate::Verdict::Pass => Verdict::Washed,
            certificate::Verdict::Fail => Verdict::NotVerified,
        };
        let plan = &planned.plan;
        let duration_s = plan.duration_s();
        Self {
            scenario: plan.provenance.scenario.clone(),
            seed: plan.job.seed,
            robot: plan.job.workcell.arm.name.clone(),
            verdict,
            headline: certificate.headline.clone(),
            duration_s,
            visits: planned.visits.clone(),
            transits: planned.transits.clone(),
            tour: planned.tour,
            jerk_rad_s3: planned.largest_jerk.into(),
            findings: findings.to_vec(),
            certificate,
        }
    }
}

/// Pattern of a wash, and direction of the sponge's axis.
fn how(visit: &VisitSummary, certificate: &Certificate) -> String {
    format!("{}, {}", visit.pattern(), leaning(visit, certificate))
}

/// Direction of the sponge's axis while a plate is washed, in words. On a face that is not flat the axis takes a share of the slope; the
/// words give the proved bound on its angle from the normal, and any further tilt.
fn leaning(visit: &VisitSummary, certificate: &Certificate) -> String {
    let plate = certificate.rests_on.plates.get(visit.plate);
    if plate.is_none_or(|plate| plate.surface.is_flat()) {
        return tilt(visit);
    }
    let swept = certificate.swept.iter().find(|swept| swept.plate == visit.plate);
    let within = swept.map_or_else(String::new, |swept| {
        let angle_rad = acos(swept.cos_tilt.clamp(0.0, 1.0));
        format!(", up to {}° from the normal", decimals_up(angle_rad.to_degrees(), 1))
    });
    let besides = match visit.tilt {
        TiltChoice::Policy(policy) if policy.tilt_rad == 0.0 && visit.aside_rad == 0.0 => String::new(),
        _ => format!("; {}", tilt(visit)),
    };
    format!("axis at a share of the slope{within}{besides}")
}

/// Tilt of the tool in the arm's plane, and across it where there is any, in words.
fn tilt(visit: &VisitSummary) -> String {
    let aside = visit.aside_rad.abs().to_degrees();
    if aside == 0.0 {
        return visit.tilt.to_string();
    }
    format!("{}, and {aside:.1}° aside", visit.tilt)
}

impl fmt::Display for WashReport {
    /// One screen. The alternate form (`{:#}`) shows everything.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.headline)?;
        let [scenario, robot] = [&self.scenario, &self.robot].map(|name| quoted(name));
        writeln!(f, "scenario {scenario}, seed {}, arm {robot}", self.seed)?;
        self.findings
            .iter()
            .try_for_each(|finding| writeln!(f, "note: {finding}"))?;
        if f.alternate() {
            f.write_str(&self.certificate.basis())?;
            self.motions(f)?;
            self.certificate.bounds(f)
        } else {
            writeln!(f)?;
            self.washes(f)?;
            self.certificate.main_bounds(f)
        }
    }
}

impl WashReport {
    /// Writes one line for each plate: the way there and the wash.
    fn washes(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{:<12} {:>9} {:>9}  how", "motion, s", "transit", "wash")?;
        for (transit, visit) in self.transits.iter().zip(&self.visits) {
            let (name, transit_s) = (plate_name(visit.plate), transit.duration_s);
            let how = how(visit, &self.certificate);
            writeln!(f, "{name:<12} {transit_s:>9.2} {:>9.2}  {how}", visit.wash_s)?;
        }
        if let Some(transit) = self.transits.get(self.visits.len()) {
            writeln!(f, "{:<12} {:>9.2}", "home", transit.duration_s)?;
        }
        let washes_s: f64 = self.visits.iter().map(|visit| visit.wash_s).sum();
        let cycle = format!("whole cycle {:.2} s", self.duration_s);
        writeln!(f, "{:<12} {:>9.2} {washes_s:>9.2}  {cycle}\n", "all", self.transits_s())
    }

    /// Total time of the transits \[s\].
    fn transits_s(&self) -> f64 {
        self.transits.iter().map(|transit| transit.duration_s).sum()
    }

    /// Writes every motion with its pattern and what limits it.
    fn motions(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{:<24} {:>9}  how", "motion", "time, s")?;
        for (k, transit) in self.transits.iter().enumerate() {
            let plate = |k: usize| self.visits.get(k).map(|v| plate_name(v.plate));
            let name = match (k.checked_sub(1).and_then(plate), plate(k)) {
                (None, Some(to)) => format!("home to {to}"),
                (Some(from), Some(to)) => format!("{from} to {to}"),
                (Some(from), None) => format!("{from} to home"),
                (None, None) => "home".to_owned(),
            };
            writeln!(f, "{name:<24} {:>9.2}  {}", transit.duration_s, transit.kind)?;
            writeln!(f, "{:<24} {:>9}  {transit}", "", "")?;
            if let Some(visit) = self.visits.get(k) {
                let name = format!("wash {}", plate_name(visit.plate));
                let how = how(visit, &self.certificate);
                writeln!(f, "{name:<24} {:>9.2}  {how}", visit.wash_s)?;
                writeln!(f, "{:<24} {:>9}  {}", "", "", visit.pace)?;
            }
        }
        writeln!(f, "{:<24} {:>9.2}", "all transits", self.transits_s())?;
        writeln!(f, "{:<24} {:>9.2}", "whole cycle", self.duration_s)?;
        let TourSummary {
            travel_s,
            nearest_next_s,
            ..
        } = self.tour;
        writeln!(
            f,
            "order of the plates: {travel_s:.2} s of travel estimated; always going to the nearest plate: {nearest_next_s:.2} s"
        )?;
        let jerk: Vec<_> = self.jerk_rad_s3.iter().map(|j| format!("{j:.0}")).collect();
        writeln!(
            f,
            "largest jerk between knots (not a requirement): {} rad/s³\n",
            jerk.join(", ")
        )
    }
}
