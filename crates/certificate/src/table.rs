//! A certificate as a table to read.

use crate::amounts::{decimals, kept, number, scale};
use crate::certificate::Certificate;
use crate::check::{Check, Measure, Sense, Status, Unit, Worst};
use crate::clearances::{PairBound, PairRule};
use crate::plate_contact::{PlateContact, ProvedShare};
use crate::requirement::Requirement;
use crate::swept::PlateCoverage;
use platewash_kinematics::trig::acos;
use platewash_kinematics::words::{decimals_down, decimals_up, percent, told_apart};
use platewash_workcell::words::{counted, printable, quoted};
use std::fmt;

/// Pairs that a table lists where it is not asked for all.
const TIGHTEST: usize = 10;

/// How the table of a dry run is to be read.
const IN_THE_AIR: &str = "a plate, and what is said to wash or to touch it, means below the raised plate, where nothing is; the plates\n\
                          that are there are the obstacles \"real plate 0\" and so on";

/// Which pairs a table lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PairsShown {
    /// The ten that come nearest, those that do not keep clear first of all.
    #[default]
    Tightest,
    /// All.
    All,
}

/// A certificate as a table of requirements, coverage, clearance and what it rests on; see [`Certificate::table`].
#[derive(Debug, Clone, Copy)]
pub struct CertificateTable<'a> {
    certificate: &'a Certificate,
    pairs: PairsShown,
}

impl Certificate {
    /// The certificate as a table to read.
    #[must_use]
    pub fn table(&self, pairs: PairsShown) -> CertificateTable<'_> {
        CertificateTable {
            certificate: self,
            pairs,
        }
    }
}

impl fmt::Display for CertificateTable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let certificate = self.certificate;
        writeln!(f, "{}", certificate.headline)?;
        writeln!(f, "scenario {}, as the plan names it", quoted(&certificate.scenario))?;
        f.write_str(&certificate.basis())?;
        f.write_str(&self.judgement())
    }
}

impl fmt::Display for Certificate {
    /// The table with the tightest pairs.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.table(PairsShown::default()).fmt(f)
    }
}

impl CertificateTable<'_> {
    /// The part of the table on what was proved: requirements, plates and pairs.
    #[must_use]
    pub fn judgement(&self) -> String {
        let mut text = String::new();
        // A text that grows cannot fail to be written.
        let _ = self
            .certificate
            .checks(&mut text)
            .and_then(|()| pairs(&mut text, &self.certificate.clearance, self.pairs));
        text
    }
}

impl Certificate {
    /// The part of the table on what the verdict rests on, the hash first.
    #[must_use]
    pub fn basis(&self) -> String {
        format!("{}\n{}\n", self.hash.words(), self.rests_on)
    }

    fn checks(&self, f: &mut impl fmt::Write) -> fmt::Result {
        let dry_run = self.rests_on.dry_run.is_some();
        if dry_run {
            writeln!(f, "{IN_THE_AIR}\n")?;
        }
        writeln!(
            f,
            "{:<22} {:<10} {:>12} {:>12} {:<6}  worst",
            "requirement", "status", "bound", "limit", "unit"
        )?;
        for check in &self.checks {
            row(f, check)?;
            let is_force = check.requirement == Requirement::ContactForce && check.measure.is_some();
            if let Some(both) = both_sides(self).filter(|_| is_force) {
                writeln!(f, "  {both}")?;
            }
        }
        let swept = if dry_run { "would be swept" } else { "swept" };
        writeln!(f, "\n{swept}, at least")?;
        for plate in &self.swept {
            plate_row(f, plate)?;
        }
        if !self.contact.is_empty() {
            writeln!(f, "\ncontact, wherever within its error of height a plate lies")?;
        }
        self.contact.iter().try_for_each(|contact| contact_row(f, contact))
    }
}

/// The pairs: those that must keep clear, the nearest first, where not all are listed; those that may touch, after them.
fn pairs(f: &mut impl fmt::Write, all: &[PairBound], shown: PairsShown) -> fmt::Result {
    let judged = || all.iter().filter(|line| line.rule != PairRule::Touching);
    if shown == PairsShown::All || judged().count() <= TIGHTEST {
        writeln!(f, "\nclearance, at least")?;
        return all.iter().try_for_each(|line| pair_row(f, line));
    }
    let mut nearest: Vec<_> = judged().collect();
    let rank = |line: &PairBound| (line.status.is_kept(), line.at_least_m.unwrap_or(f64::NEG_INFINITY));
    nearest.sort_by(|a, b| {
        let ((a_kept, a), (b_kept, b)) = (rank(a), rank(b));
        a_kept.cmp(&b_kept).then(a.total_cmp(&b))
    });
    let (tightest, rest) = nearest.split_at(TIGHTEST);
    writeln!(
        f,
        "\nclearance, at least: the {TIGHTEST} tightest of {} pairs",
        nearest.len()
    )?;
    tightest.iter().try_for_each(|line| pair_row(f, line))?;
    let broken = rest.iter().filter(|line| !line.status.is_kept()).count();
    if broken > 0 {
        let (other, do_not) = (
            counted(rest.len(), "other pair"),
            if broken == 1 { "does" } else { "do" },
        );
        writeln!(f, "  {broken} of {other} {do_not} not keep clear either")?;
    } else if let Some(at_least) = rest.first().and_then(|line| line.at_least_m) {
        writeln!(
            f,
            "  {}, never nearer than {} mm",
            counted(rest.len(), "other pair"),
            decimals_down(1e3 * at_least, 2)
        )?;
    }
    let touching = all.iter().filter(|line| line.rule == PairRule::Touching);
    touching.into_iter().try_for_each(|line| pair_row(f, line))
}

fn row(f: &mut impl fmt::Write, check: &Check) -> fmt::Result {
    let (name, status) = (check.requirement.words(), word(check.status));
    let place = place(&check.worst);
    match &check.measure {
        Some(measure) => {
            let MeasureWords { bound, limit, unit } = measure.words();
            writeln!(f, "{name:<22} {status:<10} {bound:>12} {limit:>12} {unit:<6}  {place}")?;
        }
        None => writeln!(f, "{name:<22} {status}")?,
    }
    if let Some(found) = found(check) {
        writeln!(f, "  {found}")?;
    }
    check.discrepancies.iter().try_for_each(|d| writeln!(f, "  - {d}"))?;
    match check.more_discrepancies {
        0 => Ok(()),
        more => writeln!(f, "  … and {more} more"),
    }
}

/// The worst value found, where the limit is not proved to be kept.
fn found(check: &Check) -> Option<String> {
    let measure = check.measure.as_ref().filter(|_| check.status != Status::Proved)?;
    let (scale, unit) = scale(measure.unit);
    let [seen, _] = told_apart(measure.seen? * scale, measure.limit * scale, decimals(measure.unit));
    Some(format!("found: {seen} {unit}"))
}

impl Check {
    /// What the table says of it besides its name, its status and its worst place, in one line: bound and limit, what was found where
    /// it is not proved, and what does not agree. Empty where there is nothing to add.
    #[must_use]
    pub fn detail(&self) -> String {
        let measured = self.measure.as_ref().map(|measure| {
            let MeasureWords { bound, limit, unit } = measure.words();
            format!("bound {bound}, limit {limit} {unit}")
        });
        let more = self.more_discrepancies;
        let disagreeing = self.discrepancies.iter().map(ToString::to_string);
        let parts = measured.into_iter().chain(found(self)).chain(disagreeing);
        let parts = parts.chain((more > 0).then(|| format!("and {more} more")));
        printable(&parts.collect::<Vec<_>>().join("; "))
    }
}

impl fmt::Display for Worst {
    /// Pair, joint, segment, plate, time and place, as far as they apply.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&place(self))
    }
}

fn plate_row(f: &mut impl fmt::Write, plate: &PlateCoverage) -> fmt::Result {
    let tilt = acos(plate.cos_tilt.clamp(0.0, 1.0)).to_degrees();
    let tilt = decimals_up(tilt, 2);
    let reach = plate
        .beyond_rim_m
        .map_or("nobody knows how far beyond the rim".to_owned(), beyond_rim);
    let allowed_m = plate.beyond_rim_allowed_m;
    let allowed = format!("{:.2} mm {}", 1e3 * allowed_m.abs(), side(allowed_m));
    writeln!(
        f,
        "  plate {:<4} {:>8} %  with the tool at most {tilt}° from the normal, {reach} (allowed: {allowed})",
        plate.plate,
        percent(plate.at_least)
    )?;
    plate.touches.iter().try_for_each(|touched| {
        let depth = decimals_up(1e3 * touched.depth_m, 2);
        writeln!(
            f,
            "             there it may touch plate {}, up to {depth} mm over its rim",
            touched.plate
        )
    })
}

fn contact_row(f: &mut impl fmt::Write, contact: &PlateContact) -> fmt::Result {
    let share = |share: &ProvedShare, scale: f64, unit: &str| {
        format!("{} % by {:.4} {unit}", percent(share.at_least), scale * share.threshold)
    };
    let up = |v: Option<f64>, unit: &str| {
        v.map_or("not bounded".to_owned(), |v| {
            format!("up to {}{unit}", decimals_up(v, 2))
        })
    };
    writeln!(
        f,
        "  plate {:<4} at least {}, {}, {}; strain {}, force {}, torque of friction {} (friction 0.3 to 1.0, assumed)",
        contact.plate,
        share(&contact.pressed, 1e3, "mm"),
        share(&contact.time, 1.0, "s"),
        share(&contact.dose, 1.0, "Pa·m"),
        contact.strain.bound.map_or("not bounded".to_owned(), |strain| format!(
            "up to {} %",
            decimals_up(100.0 * strain, 1)
        )),
        force([contact.least_force_n.bound, contact.greatest_force_n.bound]),
        up(contact.friction_torque_nm.map(|[_, most]| most), " N·m"),
    )
}

/// Between what forces lie \[N\].
fn force([least_n, most_n]: [Option<f64>; 2]) -> String {
    let least = least_n.map(|v| decimals_down(v, 2));
    let most = most_n.map(|v| decimals_up(v, 2));
    match (least, most) {
        (Some(least), Some(most)) => format!("{least} to {most} N"),
        (Some(least), None) => format!("{least} N or more, not bounded above"),
        (None, Some(most)) => format!("{most} N or less, not bounded below"),
        (None, None) => "not bounded".to_owned(),
    }
}

/// What a row on force leaves out, which has the side that is nearer to its limit: both, of all plates.
fn both_sides(certificate: &Certificate) -> Option<String> {
    let asked = certificate.rests_on.requirements.contact?;
    let worst = |of: fn(&PlateContact) -> Option<f64>, worse: fn(f64, f64) -> f64| {
        let mut all = certificate.contact.iter().map(of);
        let first = all.next().flatten();
        all.fold(first, |worst, next| Some(worse(worst?, next?)))
    };
    let both = [
        worst(|plate| plate.least_force_n.bound, f64::min),
        worst(|plate| plate.greatest_force_n.bound, f64::max),
    ];
    let [least_n, most_n] = asked.force_n;
    Some(format!(
        "both sides, all plates: {}; asked for: {least_n} to {most_n} N",
        force(both)
    ))
}

/// A measure as people read it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MeasureWords {
    /// What is proved; `none` where nothing finite is.
    pub bound: String,
    /// Sign and limit.
    pub limit: String,
    /// The unit of both.
    pub unit: &'static str,
}

impl Measure {
    /// The measure as people read it, in mm, degrees and per cent.
    #[must_use]
    pub fn words(&self) -> MeasureWords {
        let (scale, unit) = scale(self.unit);
        let sign = match self.sense {
            Sense::AtMost => "≤",
            Sense::AtLeast => "≥",
            Sense::Above => ">",
        };
        let (limit, decimals) = (self.limit * scale, decimals(self.unit));
        let exact = match self.unit {
            Unit::Share => number(limit),
            _ => format!("{limit:.decimals$}"),
        };
        let [bound, limit] = match self.bound {
            Some(bound) if self.keeps(bound) => [kept(self, bound, decimals), exact],
            Some(bound) => told_apart(bound * scale, limit, decimals),
            None => ["none".to_owned(), exact],
        };
        MeasureWords {
            bound,
            limit: format!("{sign} {limit}"),
            unit,
        }
    }
}

/// A reach beyond a rim, at most; one that is negative ends within it.
fn beyond_rim(reach_m: f64) -> String {
    let reach_mm = 1e3 * reach_m;
    let told = if reach_m < 0.0 {
        decimals_down(-reach_mm, 2)
    } else {
        decimals_up(reach_mm, 2)
    };
    format!("{told} mm {}", side(reach_m))
}

fn side(reach_m: f64) -> &'static str {
    if reach_m < 0.0 {
        "inside the rim"
    } else {
        "beyond the rim"
    }
}

fn word(status: Status) -> &'static str {
    match status {
        Status::Proved => "proved",
        Status::Violated => "VIOLATED",
        Status::NotProved => "NOT PROVED",
        Status::Waived => "waived",
    }
}

fn place(worst: &Worst) -> String {
    let parts = [
        worst
            .pair
            .as_ref()
            .map(|[a, b]| format!("{} and {}", printable(a), printable(b))),
        worst.joint.map(|joint| format!("joint {}", joint + 1)),
        worst.segment.map(|(i, kind)| format!("segment {i} ({})", kind.name())),
        worst.plate.map(|plate| format!("plate {plate}")),
        worst.time_s.map(|t| format!("at {t:.4} s")),
        worst.place_m.map(|[x, y, z]| format!("({x:.3}, {y:.3}, {z:.3}) m")),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

fn pair_row(f: &mut impl fmt::Write, line: &PairBound) -> fmt::Result {
    let pair = format!("{} – {}", printable(&line.pair[0]), printable(&line.pair[1]));
    if line.rule == PairRule::Touching {
        let plates: Vec<_> = line.working_on.iter().map(usize::to_string).collect();
        let noun = if plates.len() == 1 { "plate" } else { "plates" };
        return writeln!(
            f,
            "  {pair:<26} may touch while the sponge works on {noun} {}",
            plates.join(", ")
        );
    }
    let mm = |v: Option<f64>| v.map_or("none".to_owned(), |v| decimals_down(1e3 * v, 2));
    let time = line.time_s.map_or(String::new(), |t| format!("at {t:.3} s"));
    let (bound, status) = (mm(line.at_least_m), word(line.status));
    writeln!(f, "  {pair:<26} {bound:>9} mm  {status:<10} {time}")
}
