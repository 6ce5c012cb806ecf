//! A certificate as a table to read.

use super::{Certificate, Measure, PairBound, PairRule, PlateCoverage, Promise, Sense, Status, Unit, Worst};
use crate::words::millimetres;
use std::fmt;

impl fmt::Display for Certificate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.headline)?;
        let hash = match (self.hash.status, &self.hash.stated) {
            (Status::Pass, _) => "is that of the contents",
            (_, Some(_)) => "is NOT that of the contents: the plan was changed after it was sealed",
            (_, None) => "is missing",
        };
        writeln!(f, "hash {hash}\n")?;
        writeln!(
            f,
            "{:<22} {:<10} {:>12} {:>12} {:<6}  worst",
            "promise", "status", "bound", "limit", "unit"
        )?;
        for promise in &self.promises {
            row(f, promise)?;
        }
        writeln!(f, "\ncoverage, at least")?;
        for plate in &self.coverage {
            plate_row(f, plate)?;
        }
        writeln!(f, "\nclearance, at least")?;
        self.clearance.iter().try_for_each(|pair| pair_row(f, pair))
    }
}

fn row(f: &mut fmt::Formatter<'_>, promise: &Promise) -> fmt::Result {
    let (name, status) = (promise.name.words(), word(promise.status));
    let place = place(&promise.worst);
    match &promise.measure {
        Some(measure) => {
            let (bound, limit, unit) = numbers(measure);
            writeln!(f, "{name:<22} {status:<10} {bound:>12} {limit:>12} {unit:<6}  {place}")?;
        }
        None => writeln!(f, "{name:<22} {status}")?,
    }
    if let (Some(Measure { seen: Some(seen), .. }), true) = (&promise.measure, promise.status != Status::Pass) {
        let (scale, unit) = promise.measure.as_ref().map_or((1.0, ""), |m| scale(m.unit));
        writeln!(f, "  found: {:.4} {unit}", seen * scale)?;
    }
    promise.discrepancies.iter().try_for_each(|d| writeln!(f, "  - {d}"))
}

fn plate_row(f: &mut fmt::Formatter<'_>, plate: &PlateCoverage) -> fmt::Result {
    let percent = 100.0 * plate.at_least;
    let tilt = crate::trig::acos(plate.cos_tilt.clamp(0.0, 1.0)).to_degrees();
    let reach = plate
        .beyond_rim_m
        .map_or("nobody knows how far".to_owned(), millimetres);
    let allowed = millimetres(plate.beyond_rim_allowed_m);
    writeln!(
        f,
        "  plate {:<4} {percent:>8.3} %  with the tool at most {tilt:.2}° from the normal, {reach} beyond the rim (allowed {allowed})",
        plate.plate
    )?;
    plate.touches.iter().try_for_each(|touched| {
        let depth = millimetres(touched.depth_m);
        writeln!(
            f,
            "             there it may touch plate {}, up to {depth} over its rim",
            touched.plate
        )
    })
}

fn numbers(measure: &Measure) -> (String, String, &'static str) {
    let (scale, unit) = scale(measure.unit);
    let sign = match measure.sense {
        Sense::AtMost => "≤",
        Sense::AtLeast => "≥",
        Sense::Above => ">",
    };
    let bound = measure.bound.map_or("none".to_owned(), |b| format!("{:.4}", b * scale));
    (bound, format!("{sign} {:.4}", measure.limit * scale), unit)
}

/// Factor and unit in which people read a quantity.
fn scale(unit: Unit) -> (f64, &'static str) {
    match unit {
        Unit::Radian => (180.0 / std::f64::consts::PI, "°"),
        Unit::RadianPerSecond => (1.0, "rad/s"),
        Unit::RadianPerSecondSquared => (1.0, "rad/s²"),
        Unit::Metre => (1e3, "mm"),
        Unit::MetrePerSecond => (1.0, "m/s"),
        Unit::MetrePerSecondSquared => (1.0, "m/s²"),
        Unit::Share => (100.0, "%"),
    }
}

fn word(status: Status) -> &'static str {
    match status {
        Status::Pass => "pass",
        Status::Fail => "FAIL",
        Status::NotProved => "NOT PROVED",
        Status::Exempt => "exempt",
    }
}

fn place(worst: &Worst) -> String {
    let parts = [
        worst.pair.as_ref().map(|[a, b]| format!("{a} and {b}")),
        worst.joint.map(|joint| format!("joint {}", joint + 1)),
        worst.segment.map(|(i, kind)| format!("segment {i} ({})", kind.name())),
        worst.plate.map(|plate| format!("plate {plate}")),
        worst.time_s.map(|t| format!("at {t:.4} s")),
        worst.place_m.map(|[x, y, z]| format!("({x:.3}, {y:.3}, {z:.3}) m")),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

fn pair_row(f: &mut fmt::Formatter<'_>, line: &PairBound) -> fmt::Result {
    let pair = format!("{} – {}", line.pair[0], line.pair[1]);
    if line.rule == PairRule::Exempt {
        let plates: Vec<_> = line.working_on.iter().map(usize::to_string).collect();
        let noun = if plates.len() == 1 { "plate" } else { "plates" };
        return writeln!(
            f,
            "  {pair:<26} exempt while the sponge works on {noun} {}",
            plates.join(", ")
        );
    }
    let mm = |v: Option<f64>| v.map_or("none".to_owned(), |v| format!("{:.2}", 1e3 * v));
    let time = line.time_s.map_or(String::new(), |t| format!("at {t:.3} s"));
    let (bound, status) = (mm(line.at_least_m), word(line.status));
    writeln!(f, "  {pair:<26} {bound:>9} mm  {status:<10} {time}")
}
