//! The report and its numbers, as a person reads them.

use crate::simulate::measures::{Effort, Tracking};
use crate::simulate::payload::PayloadVerdict;
use crate::simulate::pressing::{AS_STATED, ForceRange, HEIGHT_ERRORS_M, Pressing};
use crate::simulate::report::{SimulationReport, SimulationVerdict};
use crate::simulate::rounding::rounded_for_display;
use platewash_kinematics::words::{distinct_decimals, percent};
use platewash_workcell::words::{plate_name, plate_number};
use std::fmt::{self, Display, Formatter};

impl Display for SimulationReport {
    /// One screen. The alternate form (`{:#}`) shows everything.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let verdict = self.verdict.words().to_uppercase();
        let altered = match self.verdict {
            SimulationVerdict::Altered => ", the hash does not match the contents",
            _ => "",
        };
        writeln!(f, "{verdict}{altered}: {}", self.headline)?;
        let rate = 1.0 / self.period_s;
        writeln!(
            f,
            "simulated: {:.2} s in {} samples at {rate:.0} Hz\n",
            self.duration_s, self.samples
        )?;
        plates(self, f)?;
        if !f.alternate() {
            return payload(self, f);
        }
        pressing(self, f)?;
        tracking(self, f)?;
        if let Some(effort) = &self.effort {
            joints(effort, &self.tracking, f)?;
        }
        payload(self, f)?;
        for assumption in &self.assumptions {
            writeln!(f, "assumed: {assumption}")?;
        }
        Ok(())
    }
}

fn plates(report: &SimulationReport, f: &mut Formatter<'_>) -> fmt::Result {
    writeln!(
        f,
        "{:<10} {:>16} {:>17} {:>12} {:>10}  verdict",
        "plate", "swept, planned %", "swept, executed %", "in contact %", "tilt °"
    )?;
    for plate in &report.plates {
        let contact = 100.0 * plate.in_contact as f64 / plate.samples.max(1) as f64;
        writeln!(
            f,
            "{:<10} {:>16} {:>17} {contact:>12.1} {:>10.2}  {}",
            plate_number(plate.plate),
            percent(plate.planned.fraction),
            percent(plate.executed.fraction),
            plate.tilt_rad.to_degrees(),
            plate.verdict.words()
        )?;
        for cause in &plate.causes {
            writeln!(f, "           {cause}")?;
        }
    }
    writeln!(f)
}

/// Writes the force, the contact kept, and the force at other heights, one table each.
fn pressing(report: &SimulationReport, f: &mut Formatter<'_>) -> fmt::Result {
    let pressed: Vec<_> = report
        .plates
        .iter()
        .filter_map(|plate| Some((plate_name(plate.plate), plate.pressing.as_ref()?)))
        .collect();
    if pressed.is_empty() {
        return writeln!(f, "force on plates: not simulated\n");
    }
    forces(&pressed, f)?;
    contact(&pressed, f)?;
    heights(&pressed, f)
}

fn forces(pressed: &[(String, &Pressing)], f: &mut Formatter<'_>) -> fmt::Result {
    writeln!(
        f,
        "{:<24} {:>8} {:>8} {:>8} {:>8} {:>10} {:>8} {:>8}",
        "force on plates, N", "least", "mean", "most", "planned", "of planned", "strain %", "lost s"
    )?;
    for (plate, pressing) in pressed {
        let ForceRange {
            least_n,
            mean_n,
            most_n,
        } = pressing.force;
        let planned_n = pressing.planned[AS_STATED].force.mean_n;
        let share = if planned_n > 0.0 {
            format!("{:.0} %", 100.0 * mean_n / planned_n)
        } else {
            "-".to_owned()
        };
        let lost_s = pressing.lost.map_or(0.0, |lost| lost.time_s);
        writeln!(
            f,
            "{plate:<24} {least_n:>8.2} {mean_n:>8.2} {most_n:>8.2} {planned_n:>8.2} {share:>10} {:>8.1} {lost_s:>8.3}",
            100.0 * pressing.strain
        )?;
        if let Some(lost) = pressing.lost {
            writeln!(
                f,
                "           contact is lost for {:.1} % of the wash, first at {:.3} s",
                100.0 * lost.share,
                lost.first_t_s
            )?;
        }
    }
    writeln!(f)
}

/// Writes the contact; nothing where the job asks for no contact.
fn contact(pressed: &[(String, &Pressing)], f: &mut Formatter<'_>) -> fmt::Result {
    let found: Vec<_> = pressed
        .iter()
        .filter_map(|(plate, pressing)| Some((plate, pressing.contact?)))
        .collect();
    if found.is_empty() {
        return Ok(());
    }
    writeln!(
        f,
        "{:<24} {:>12} {:>14} {:>16}",
        "kept in contact", "pressed %", "contact time %", "contact dose %"
    )?;
    for (plate, kept) in found {
        let [pressed, time, dose] = [kept.contact, kept.time, kept.dose].map(percent);
        writeln!(f, "{plate:<24} {pressed:>12} {time:>14} {dose:>16}")?;
    }
    writeln!(f, "measured at samples, the plates where they are stated; not proved\n")
}

/// The force of the plan's own poses, and how much of it a millimetre makes.
fn heights(pressed: &[(String, &Pressing)], f: &mut Formatter<'_>) -> fmt::Result {
    write!(f, "{:<24}", "planned N, plate higher")?;
    for higher_m in HEIGHT_ERRORS_M {
        write!(f, " {:>13}", format!("{:+.0} mm", 1e3 * higher_m))?;
    }
    writeln!(f, " {:>9}", "N per mm")?;
    for (plate, pressing) in pressed {
        write!(f, "{plate:<24}")?;
        for at in &pressing.planned {
            let ForceRange { least_n, most_n, .. } = at.force;
            write!(f, " {:>13}", format!("{least_n:.1} to {most_n:.1}"))?;
        }
        let [lower, higher] = [AS_STATED - 1, AS_STATED + 1].map(|k| &pressing.planned[k]);
        let per_m = (higher.force.mean_n - lower.force.mean_n) / (higher.higher_m - lower.higher_m);
        writeln!(f, " {:>9.2}", 1e-3 * per_m)?;
    }
    writeln!(f)
}

fn tracking(report: &SimulationReport, f: &mut Formatter<'_>) -> fmt::Result {
    writeln!(f, "{:<22} {:>9} {:>9} {:>9}", "tip error, mm", "rms", "95 %", "largest")?;
    let mut row = |name: &str, tracking: &Tracking| {
        let tip = &tracking.tip_m;
        let [rms, p95, max] = [tip.rms, tip.p95, tip.max].map(|length| 1e3 * length);
        writeln!(f, "{name:<22} {rms:>9.3} {p95:>9.3} {max:>9.3}")
    };
    for segment in &report.segments {
        row(
            &format!("{}, {}", segment.kind.name(), plate_name(segment.plate)),
            &segment.tracking,
        )?;
    }
    row("all", &report.tracking)?;
    writeln!(f)
}

fn joints(effort: &Effort, tracking: &Tracking, f: &mut Formatter<'_>) -> fmt::Result {
    writeln!(
        f,
        "{:<6} {:>10} {:>10} {:>10} {:>10} {:>10} {:>9} {:>9} {:>9}",
        "joint", "rms mrad", "max mrad", "rms N·m", "max N·m", "of limit", "work J", "braking J", "power W"
    )?;
    for (k, (joint, error)) in effort.joints.iter().zip(&tracking.joints_rad).enumerate() {
        let share = joint
            .share_of_limit
            .map_or_else(|| "unknown".to_owned(), |share| format!("{:.1} %", 100.0 * share));
        writeln!(
            f,
            "{:<6} {:>10.3} {:>10.3} {:>10.3} {:>10.3} {share:>10} {:>9.2} {:>9.2} {:>9.2}",
            k + 1,
            1e3 * error.rms,
            1e3 * error.max,
            joint.torque_n_m.rms,
            joint.torque_n_m.max,
            joint.work_j,
            joint.braking_j,
            joint.power_w
        )?;
    }
    let saturated = match effort.saturated_share {
        share if share > 0.0 => format!("; torque limits cut in at {:.2} % of the samples", 100.0 * share),
        _ => String::new(),
    };
    writeln!(f, "work of all motors {:.1} J{saturated}\n", effort.work_j)
}

fn payload(report: &SimulationReport, f: &mut Formatter<'_>) -> fmt::Result {
    let payload = &report.payload;
    let rated = |verdict: &str| {
        let [tool, rated] = distinct_decimals(payload.tool_kg, payload.rated_kg.unwrap_or_default(), 2);
        format!("the tool weighs {tool} kg, {verdict} the rated payload of {rated} kg")
    };
    let line = match payload.verdict {
        PayloadVerdict::Within => rated("within"),
        PayloadVerdict::Exceeded => rated("above"),
        PayloadVerdict::Unknown => format!(
            "the tool weighs {} kg; no payload is known for this arm, and none is stated",
            rounded_for_display(payload.tool_kg)
        ),
    };
    writeln!(f, "payload: {line}")
}
