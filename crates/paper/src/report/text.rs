//! The report as a person reads it.

use super::{ClosestApproach, MotionReport, PaperReport, UnreachedWaypoint, Violation, ViolationKind};
use platewash_bodies::coverage::Coverage;
use platewash_kinematics::words::{angles_told_apart, distinct_decimals, rounded};
use platewash_workcell::words::{plate_name, plate_number, quoted};
use std::fmt::{self, Display, Formatter};

/// Violations listed one by one for a motion before the rest is only counted.
const LISTED_VIOLATIONS: usize = 12;

/// Significant digits of stated values.
const SHOWN_DIGITS: usize = 6;

impl Display for PaperReport {
    /// One screen. The alternate form (`{:#}`) shows everything.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}\n", self.headline)?;
        let (name, seed, robot) = (quoted(&self.scenario), self.seed, quoted(&self.robot));
        writeln!(
            f,
            "scenario {name}, seed {seed}, robot {robot}, {:.2} s of motion",
            self.duration_s
        )?;
        self.write_plates(f)?;
        self.write_transits(f)?;
        if !f.alternate() {
            let [planned, executed] = [&self.planned, &self.executed].map(|motion| motion.violations.len());
            return writeln!(
                f,
                "\nViolations: {planned} in the planned motion, {executed} in the executed one"
            );
        }
        writeln!(
            f,
            "\nWhole job, largest share of each joint's limit (1 to 6; acceleration limits are assumptions), of the cubics\n\
             through the waypoints (their speeds there are central differences: the program commands positions only)"
        )?;
        let motions = [("planned", &self.planned), ("executed", &self.executed)];
        motions.iter().try_for_each(|(what, report)| motion(f, what, report))?;
        motions
            .iter()
            .try_for_each(|(what, report)| violations(f, what, &report.violations))?;
        if !self.findings.is_empty() {
            writeln!(f, "\nFindings")?;
        }
        self.findings
            .iter()
            .try_for_each(|finding| writeln!(f, "  - {finding}"))
    }
}

impl PaperReport {
    fn write_plates(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let shown = |value: f64| rounded(value, SHOWN_DIGITS);
        let (sponge, wanted) = (shown(1e3 * self.sponge_radius_m), shown(100.0 * self.coverage_required));
        writeln!(
            f,
            "\nPlates, in the order of washing (swept by a sponge of radius {sponge} mm; {wanted} % wanted)"
        )?;
        let mut row = |cells: [&str; 9]| {
            let [plate, centre, reached, ik, ideal, done, error, contact, washed] = cells;
            writeln!(
                f,
                "  {plate:<6} {centre:>16} {reached:>9} {ik:>12} {ideal:>11} {done:>11} {error:>19} {contact:>8} {washed:>7}"
            )
        };
        let [ik, error] = ["worst IK, mm", "error rms, max, mm"];
        row([
            "plate",
            "centre, mm",
            "reached",
            ik,
            "ideal, %",
            "done, %",
            error,
            "contact",
            "washed",
        ])?;
        for p in &self.plates {
            row([
                &plate_number(p.plate).to_string(),
                &format!("({:.0}, {:.0})", 1e3 * p.centre_m[0], 1e3 * p.centre_m[1]),
                &format!("{}/{}", p.reached, p.waypoints),
                &format!("{:.4}", 1e3 * p.worst_ik_position_error_m),
                &percent(&p.ideal_coverage),
                &percent(&p.executed_coverage),
                &format!("{:.1}, {:.1}", 1e3 * p.tracking_rms_m, 1e3 * p.tracking_max_m),
                &format!("{}/{}", p.in_contact, p.waypoints),
                if p.washed { "yes" } else { "no" },
            ])?;
        }
        for p in &self.plates {
            let what = plate_name(p.plate);
            unreached(f, &what, p.waypoints - p.reached, p.worst_unreached.as_ref())?;
        }
        writeln!(
            f,
            "\nSmallest clearance (pair, place, time; {:.1} mm wanted)",
            1e3 * self.clearance_required_m
        )?;
        for p in &self.plates {
            let what = plate_name(p.plate);
            nearest(f, &what, [&p.planned_clearance, &p.executed_clearance])?;
        }
        Ok(())
    }

    fn write_transits(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let t = &self.transits;
        if t.waypoints == 0 {
            return Ok(());
        }
        nearest(f, "transitions", [&t.planned_clearance, &t.executed_clearance])?;
        let (rms, most) = (1e3 * t.tracking_rms_m, 1e3 * t.tracking_max_m);
        writeln!(
            f,
            "\nTransitions: {}/{} waypoints reached, tracking error {rms:.1} mm rms, {most:.1} mm at most",
            t.reached, t.waypoints
        )?;
        unreached(f, "transitions", t.waypoints - t.reached, t.worst_unreached.as_ref())
    }
}

/// A share that is swept with half the width of its proven interval, in percent.
fn percent(c: &Coverage) -> String {
    format!("{:.1} ± {:.1}", 100.0 * c.fraction, 50.0 * c.error())
}

fn unreached(f: &mut Formatter<'_>, what: &str, count: usize, worst: Option<&UnreachedWaypoint>) -> fmt::Result {
    let Some(u) = worst else { return Ok(()) };
    let [x, y, z] = u.target_m.map(|v| 1e3 * v);
    writeln!(
        f,
        "  {what}: {count} waypoints not reached; worst is waypoint {} at ({x:.0}, {y:.0}, {z:.0}) mm ({}), {:.1} mm and {:.1}° off",
        u.waypoint,
        u.cause,
        1e3 * u.position_error_m,
        u.orientation_error_rad.to_degrees()
    )
}

fn nearest(f: &mut Formatter<'_>, what: &str, approaches: [&Option<ClosestApproach>; 2]) -> fmt::Result {
    for (motion, approach) in ["planned", "executed"].into_iter().zip(approaches) {
        let what = format!("{what}, {motion}");
        let Some(ClosestApproach { t_s, pair }) = approach else {
            writeln!(f, "  {what:<22} nothing to check")?;
            continue;
        };
        let [x, y, z] = pair.place_m.map(|v| 1e3 * v);
        let (bodies, distance_mm) = (format!("{} – {}", pair.a, pair.b), 1e3 * pair.distance_m);
        writeln!(
            f,
            "  {what:<22} {distance_mm:>7.1} mm  {bodies:<22} at ({x:.0}, {y:.0}, {z:.0}) mm, t = {t_s:.2} s"
        )?;
    }
    Ok(())
}

fn motion(f: &mut Formatter<'_>, what: &str, report: &MotionReport) -> fmt::Result {
    for (quantity, shares) in [
        ("speed", &report.speed_share),
        ("acceleration", &report.acceleration_share),
    ] {
        write!(f, "  {what:<9} {quantity:<12}")?;
        for share in shares.iter() {
            if *share < 1e4 {
                write!(f, "{share:>10.2}")?;
            } else {
                write!(f, "{share:>10.2e}")?;
            }
        }
        writeln!(f)?;
    }
    Ok(())
}

fn violations(f: &mut Formatter<'_>, what: &str, all: &[Violation]) -> fmt::Result {
    if all.is_empty() {
        return writeln!(f, "\nViolations, {what} motion: none");
    }
    writeln!(f, "\nViolations, {what} motion: {}", all.len())?;
    // The worst of each kind and body first, so that the list says something before it is cut.
    let mut ranked: Vec<_> = all.iter().collect();
    ranked.sort_by(|a, b| b.severity().total_cmp(&a.severity()));
    ranked
        .iter()
        .take(LISTED_VIOLATIONS)
        .try_for_each(|v| writeln!(f, "  - {v}"))?;
    match all.len().saturating_sub(LISTED_VIOLATIONS) {
        0 => Ok(()),
        more => writeln!(f, "  - and {more} more; all of them in the JSON report"),
    }
}

impl Violation {
    /// Rank of the violation by severity: contacts first, then by the share of the limit.
    fn severity(&self) -> f64 {
        match self.kind {
            ViolationKind::Clearance => 1e9 - self.worst,
            ViolationKind::Position => 1e6 + (self.worst - self.limit).abs(),
            ViolationKind::Speed | ViolationKind::Acceleration => self.worst / self.limit,
        }
    }
}

impl Display for Violation {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (worst, limit) = (self.worst, self.limit);
        let (what, [worst, limit], of, unit) = match self.kind {
            ViolationKind::Position => ("position", angles_told_apart(worst, limit, 2), "beyond", ""),
            ViolationKind::Speed => ("speed", distinct_decimals(worst, limit, 2), "rad/s of", ""),
            ViolationKind::Acceleration => ("acceleration", distinct_decimals(worst, limit, 1), "rad/s² of", ""),
            ViolationKind::Clearance => (
                "clearance",
                distinct_decimals(1e3 * worst, 1e3 * limit, 1),
                "mm of",
                " mm",
            ),
        };
        let [from, to] = [self.t_start_s, self.t_end_s];
        write!(
            f,
            "{} {what} {worst} {of} {limit}{unit}, t = {from:.2} … {to:.2} s",
            self.who
        )
    }
}
