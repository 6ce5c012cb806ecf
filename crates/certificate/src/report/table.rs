//! The certificate as a text table.

use crate::clearance::pairs::{PairBound, PairRule};
use crate::report::certificate::Certificate;
use crate::report::check::{Check, Measure, Sense, Status, WorstCase};
use crate::report::requirement::Requirement;
use crate::report::unit::Unit;
use crate::report::words::{decimals, number, rounded_bound};
use crate::washing::holder_load::HolderLoad;
use crate::washing::plate_contact::{PlateContact, ProvedShare};
use crate::washing::plate_coverage::PlateCoverage;
use platewash_kinematics::trig::acos;
use platewash_kinematics::words::{decimals_down, decimals_up, distinct_decimals, percent};
use platewash_workcell::words::{plate_name, printable, quoted};
use std::fmt;

/// Requirements that the short report always shows.
const MAIN: [Requirement; 4] = [
    Requirement::JointSpeed,
    Requirement::TipSpeed,
    Requirement::Clearance,
    Requirement::ReducedClearance,
];

/// Requirements that it also shows for a washing. A dry run washes nothing.
const OF_WASHING: [Requirement; 3] = [Requirement::Swept, Requirement::Pressed, Requirement::ContactForce];

/// Note on the plate names in the table of a dry run.
const IN_THE_AIR: &str = "dry run: \"plate 1\" is the raised plate, where nothing is; the plate on the table is the obstacle \"real plate 1\"";

impl fmt::Display for Certificate {
    /// Short report: verdict, main bounds, broken requirements and assumptions. The alternate form (`{:#}`) shows everything.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.headline)?;
        writeln!(f, "scenario {}, as the plan names it", quoted(&self.scenario))?;
        if f.alternate() {
            f.write_str(&self.basis())?;
            self.bounds(f)
        } else {
            writeln!(f)?;
            self.main_bounds(f)
        }
    }
}

impl Certificate {
    /// Returns the basis of the verdict in words. The first line is the finding on the hash.
    #[must_use]
    pub fn basis(&self) -> String {
        format!("{}\n{}\n", self.hash.words(), self.rests_on)
    }

    /// Writes the main bounds, each requirement that is not kept, and the assumptions.
    ///
    /// # Errors
    /// [`fmt::Error`] from `f`.
    pub fn main_bounds(&self, f: &mut impl fmt::Write) -> fmt::Result {
        let kept = self
            .checks
            .iter()
            .filter(|check| check.status == Status::Proved)
            .count();
        if self.hash.status != Status::Proved {
            writeln!(f, "{}; the plan as it is now:", self.hash.words())?;
        }
        writeln!(f, "{kept} of {} requirements proved, the main ones:", self.checks.len())?;
        self.head_of_checks(f)?;
        let washes = self.rests_on.dry_run.is_none();
        let is_main = |which: &Requirement| MAIN.contains(which) || (washes && OF_WASHING.contains(which));
        let is_shown = |check: &&Check| check.status != Status::Proved || is_main(&check.requirement);
        self.checks
            .iter()
            .filter(is_shown)
            .try_for_each(|check| row(f, check))?;
        writeln!(f, "\nassumed, not proved")?;
        let mut assumptions = self.rests_on.assumptions.iter();
        assumptions.try_for_each(|what| writeln!(f, "  {}", printable(what)))
    }

    /// Writes every bound: requirements, plates and pairs of bodies.
    ///
    /// # Errors
    /// [`fmt::Error`] from `f`.
    pub fn bounds(&self, f: &mut impl fmt::Write) -> fmt::Result {
        self.head_of_checks(f)?;
        for check in &self.checks {
            row(f, check)?;
            let is_force = check.requirement == Requirement::ContactForce && check.measure.is_some();
            if let Some(both) = both_sides(self).filter(|_| is_force) {
                writeln!(f, "  {both}")?;
            }
        }
        let is_dry_run = self.rests_on.dry_run.is_some();
        let swept = if is_dry_run { "would be swept" } else { "swept" };
        writeln!(f, "\n{swept}, at least")?;
        for plate in &self.swept {
            plate_row(f, plate)?;
        }
        if !self.contact.is_empty() {
            writeln!(f, "\ncontact, at least, for plates within the stated height error")?;
        }
        self.contact.iter().try_for_each(|contact| contact_row(f, contact))?;
        pairs(f, &self.clearance)
    }

    fn head_of_checks(&self, f: &mut impl fmt::Write) -> fmt::Result {
        if self.rests_on.dry_run.is_some() {
            writeln!(f, "{IN_THE_AIR}\n")?;
        }
        writeln!(
            f,
            "{:<22} {:<10} {:>12} {:>12} {:<6}  worst",
            "requirement", "status", "bound", "limit", "unit"
        )
    }
}

/// Writes all pairs of bodies: those that do not keep clear, then the nearest, then those that may touch.
fn pairs(f: &mut impl fmt::Write, all: &[PairBound]) -> fmt::Result {
    let mut sorted: Vec<_> = all.iter().collect();
    let rank = |line: &PairBound| {
        let may_touch = line.rule == PairRule::Touching;
        (
            may_touch,
            line.status.is_kept(),
            line.at_least_m.unwrap_or(f64::NEG_INFINITY),
        )
    };
    sorted.sort_by(|a, b| {
        let ((a_touches, a_kept, a), (b_touches, b_kept, b)) = (rank(a), rank(b));
        (a_touches, a_kept).cmp(&(b_touches, b_kept)).then(a.total_cmp(&b))
    });
    writeln!(f, "\nclearance, at least")?;
    sorted.into_iter().try_for_each(|line| pair_row(f, line))
}

fn row(f: &mut impl fmt::Write, check: &Check) -> fmt::Result {
    let (name, status) = (check.requirement.words(), status_word(check.status));
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

/// Formats the worst value found, where the limit is not proved to be kept.
fn found(check: &Check) -> Option<String> {
    let measure = check.measure.as_ref().filter(|_| check.status != Status::Proved)?;
    let (scale, unit) = measure.unit.scale();
    let [seen, _] = distinct_decimals(measure.seen? * scale, measure.limit * scale, decimals(measure.unit));
    Some(format!("found: {seen} {unit}"))
}

impl Check {
    /// Returns the table's detail about the requirement in one line, without name, status and worst place: bound and limit, the value found
    /// where it is not proved, and the discrepancies. Empty if there is nothing to add.
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

impl fmt::Display for WorstCase {
    /// Writes pair, joint, segment, plate, time and position, as far as they apply.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&place(self))
    }
}

fn plate_row(f: &mut impl fmt::Write, plate: &PlateCoverage) -> fmt::Result {
    let tilt = acos(plate.cos_tilt.clamp(0.0, 1.0)).to_degrees();
    let tilt = decimals_up(tilt, 2);
    let reach = plate
        .beyond_rim_m
        .map_or("not bounded beyond the rim".to_owned(), beyond_rim);
    let allowed_m = plate.beyond_rim_allowed_m;
    let allowed = format!("{:.2} mm {}", 1e3 * allowed_m.abs(), side(allowed_m));
    writeln!(
        f,
        "  {:<10} {:>8} %  with the tool at most {tilt}° from the normal, {reach} (allowed: {allowed})",
        plate_name(plate.plate),
        percent(plate.at_least)
    )?;
    plate.touches.iter().try_for_each(|touched| {
        let depth = decimals_up(1e3 * touched.depth_m, 2);
        writeln!(
            f,
            "             while washing it, the sponge may touch {}, up to {depth} mm over its rim",
            plate_name(touched.plate)
        )
    })
}

fn contact_row(f: &mut impl fmt::Write, contact: &PlateContact) -> fmt::Result {
    let share = |share: &ProvedShare, scale: f64, unit: &str| {
        format!(
            "{} % with {:.4} {unit} or more",
            percent(share.at_least),
            scale * share.threshold
        )
    };
    let up = |v: Option<f64>, unit: &str| {
        v.map_or("not bounded".to_owned(), |v| {
            format!("up to {}{unit}", decimals_up(v, 2))
        })
    };
    writeln!(
        f,
        "  {:<10} pressed: {}; contact time: {}; contact dose: {}; strain {}, contact force {}, friction torque {} (friction coefficient 0.3 to 1.0, assumed)",
        plate_name(contact.plate),
        share(&contact.pressed, 1e3, "mm"),
        share(&contact.time, 1.0, "s"),
        share(&contact.dose, 1.0, "Pa·m"),
        contact.strain.bound.map_or("not bounded".to_owned(), |strain| format!(
            "up to {} %",
            decimals_up(100.0 * strain, 1)
        )),
        force([contact.least_force_n.bound, contact.greatest_force_n.bound]),
        up(contact.friction_torque_nm.map(|[_, most]| most), " N·m"),
    )?;
    let held = contact.holder_load.as_ref().map_or("not bounded".to_owned(), held);
    writeln!(f, "             holder takes: {held}")
}

/// Formats what holds a plate takes, for the greatest friction of the sponge, and whether the plate stays on its ring.
fn held(load: &HolderLoad) -> String {
    let [_, friction] = load.sponge_friction;
    let weight = load.weight_n.map_or(String::new(), |[_, across_n]| {
        format!(", with {} N of the plate's weight", decimals_up(across_n, 2))
    });
    let ring = load.ring.map_or(String::new(), |ring| {
        let percent = |share: Option<f64>| {
            share.map_or("not bounded".to_owned(), |s| {
                format!("up to {} %", decimals_up(100.0 * s, 1))
            })
        };
        format!(
            "; on its ring: pressed down off the axis by {} of the radius, friction needed {}{}",
            percent(ring.tipping),
            percent(ring.friction),
            ring.fault().map_or(String::new(), |fault| format!(": {fault}"))
        )
    });
    format!(
        "across the plate's axis up to {} N{weight}, about it up to {} N·m (friction coefficient of the sponge up to {}, assumed){ring}",
        decimals_up(load.lateral_n[1], 2),
        decimals_up(load.torque_nm[1], 2),
        number(friction)
    )
}

/// Formats the range of the forces \[N\].
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

/// Returns a note with the least and the greatest force over all plates. The row on force shows only the one nearer to its limit.
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
        "all plates: {}; required: {least_n} to {most_n} N",
        force(both)
    ))
}

/// Measure formatted for people.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MeasureWords {
    /// Proved bound; `none` where nothing finite is proved.
    pub bound: String,
    /// Sign of comparison and limit.
    pub limit: String,
    /// Unit of both.
    pub unit: &'static str,
}

impl Measure {
    /// Formats the measure in mm, degrees and per cent.
    #[must_use]
    pub fn words(&self) -> MeasureWords {
        let (scale, unit) = self.unit.scale();
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
            Some(bound) if self.is_within_limit(bound) => [rounded_bound(self, bound, decimals), exact],
            Some(bound) => distinct_decimals(bound * scale, limit, decimals),
            None => ["none".to_owned(), exact],
        };
        MeasureWords {
            bound,
            limit: format!("{sign} {limit}"),
            unit,
        }
    }
}

/// Formats an upper bound of the reach beyond a rim; a negative reach ends within it.
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

fn status_word(status: Status) -> &'static str {
    match status {
        Status::Proved => "proved",
        Status::Violated => "VIOLATED",
        Status::NotProved => "NOT PROVED",
        Status::Waived => "waived",
    }
}

fn place(worst: &WorstCase) -> String {
    let parts = [
        worst
            .pair
            .as_ref()
            .map(|[a, b]| format!("{} and {}", printable(a), printable(b))),
        worst.joint.map(|joint| format!("joint {}", joint + 1)),
        worst.segment.map(|(i, kind)| format!("segment {i} ({})", kind.name())),
        worst.plate.map(plate_name),
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
    let required = line.required_m.map(|m| format!(" ({} mm required)", number(1e3 * m)));
    let (bound, status) = (mm(line.at_least_m), status_word(line.status));
    writeln!(
        f,
        "  {pair:<26} {bound:>9} mm  {status:<10} {time}{}",
        required.unwrap_or_default()
    )
}
