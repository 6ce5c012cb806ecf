//! The words of a certificate, and of errors for plans that cannot be judged.

use crate::contact::{disc, rings};
use crate::maker::{good, irb120, resealed};
use platewash_certificate::{Certificate, PairRule, ProveError, Requirement, Sense, Unit, prove};
use platewash_kinematics::JointVector;
use platewash_kinematics::words::{decimals_down, decimals_up};
use platewash_motion::plan::Plan;
use platewash_workcell::Obstacle;
use platewash_workcell::job::Overlap;
use platewash_workcell::wash_path::WashPath;

fn certificate() -> Certificate {
    prove(&good(), &irb120()).unwrap()
}

fn refused(change: impl FnOnce(&mut Plan)) -> ProveError {
    let mut plan = good();
    change(&mut plan);
    prove(&plan, &irb120()).unwrap_err()
}

/// Eight plates 1 mm apart: 28 pairs overlap, and in 56 washes a neighbour is swept.
#[test]
fn the_headline_counts_waived_requirements_after_failed_ones() {
    let mut plan = good();
    let first = plan.job.plates[0];
    plan.job.plates = vec![first; 8];
    for (i, plate) in plan.job.plates.iter_mut().enumerate() {
        plate.pose.translation.x += 1e-3 * i as f64;
    }
    plan.order = (0..8).collect();
    plan.wash_paths = (0..8)
        .map(|plate| WashPath {
            plate,
            ..plan.wash_paths[0]
        })
        .collect();
    plan.job.requirements.overlap = Overlap::Report;
    let certificate = prove(&resealed(plan), &irb120()).unwrap();
    let line = &certificate.headline;
    let (verdict, waived) = line.split_once("; waived by the job: ").unwrap();
    assert!(
        verdict.starts_with("NOT PROVED: 8 plates in ") && verdict.contains("; violated: "),
        "{line}"
    );
    assert!(!line.contains("BUT FOR"), "{line}");
    assert!(
        waived.starts_with("every plate once, plate 2 while plate 1 is washed"),
        "{line}"
    );
    assert!(
        waived.contains(" and 55 more cases; plates apart, gap between plate 1 and plate 2 -289.0 mm"),
        "{line}"
    );
    assert!(waived.ends_with(" and 27 more cases"), "{line}");
    let table = format!("{certificate:#}");
    assert!(
        table.contains("  … and 36 more\n") && table.contains("  … and 8 more\n"),
        "{table}"
    );
    for (name, more) in [(Requirement::EveryPlateOnce, 36), (Requirement::PlatesApart, 8)] {
        let data = serde_json::to_value(certificate.check(name).unwrap()).unwrap();
        assert_eq!(data["discrepancies"].as_array().unwrap().len(), 20);
        assert_eq!(data["more_discrepancies"], more);
    }
}

/// The number before a unit in a line of the table.
fn number(line: &str, unit: &str) -> f64 {
    line.split(unit)
        .next()
        .unwrap()
        .split_whitespace()
        .last()
        .unwrap()
        .parse()
        .unwrap()
}

#[test]
fn the_table_claims_no_more_than_is_proved() {
    let certificate = certificate();
    let table = format!("{certificate:#}");
    let lines = |from: &str| {
        table
            .split(from)
            .nth(1)
            .unwrap()
            .lines()
            .skip(1)
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    let pairs = lines("clearance, at least");
    for pair in certificate
        .clearance
        .iter()
        .filter(|pair| pair.rule == PairRule::Clearance)
    {
        let name = format!("  {} – {} ", pair.pair[0], pair.pair[1]);
        let line = pairs.iter().find(|line| line.starts_with(&name)).unwrap();
        let at_least = 1e3 * pair.at_least_m.unwrap();
        let told = number(line, " mm");
        assert!(told <= at_least && at_least < told + 0.0101, "{line} {at_least}");
    }
    for (line, plate) in lines("\nswept, at least").iter().zip(&certificate.swept) {
        let told = number(line, " %");
        assert!(told <= 100.0 * plate.at_least + 1e-7 && told > 99.0, "{line}");
        assert!(
            number(line, " mm beyond") >= 1e3 * plate.beyond_rim_m.unwrap(),
            "{line}"
        );
        assert!(
            number(line, "° from").to_radians().cos() <= plate.cos_tilt + 1e-12,
            "{line}"
        );
    }
    for check in certificate.checks.iter().filter(|p| p.measure.is_some()) {
        let measure = check.measure.unwrap();
        let scale = match measure.unit {
            Unit::Radian => 180.0 / std::f64::consts::PI,
            Unit::Metre => 1e3,
            Unit::Share => 100.0,
            _ => 1.0,
        };
        let (sign, side) = match measure.sense {
            Sense::AtMost => ("≤", 1.0),
            Sense::AtLeast => ("≥", -1.0),
            Sense::Above => (">", -1.0),
        };
        let is_its = |line: &&str| line.starts_with(&check.requirement.words()) && line.contains(sign);
        let line = table.lines().find(is_its).unwrap();
        let (told, bound) = (number(line, sign), measure.bound.unwrap() * scale);
        let as_limit = format!("{told:.4}") == format!("{:.4}", measure.limit * scale);
        assert!(as_limit || side * (told - bound) >= -1e-7, "{line} {bound}");
    }
}

#[test]
fn words_for_one_plate_are_singular_and_reach_within_the_rim_is_inside() {
    let mut certificate = certificate();
    (
        certificate.swept[0].beyond_rim_m,
        certificate.swept[0].beyond_rim_allowed_m,
    ) = (Some(-0.02), -0.0198);
    let told = "20.00 mm inside the rim (allowed: 19.80 mm inside the rim)";
    assert!(format!("{certificate:#}").contains(told), "{certificate:#}");
    let mut plan = good();
    plan.order = vec![0];
    let told = format!("{:#}", prove(&plan, &irb120()).unwrap());
    assert!(told.contains("expected 5 for 1 plate\n"), "{told}");
    let cut = refused(|p| {
        p.knots.t_s.truncate(1);
        p.knots.q_rad.truncate(1);
        p.knots.qd_rad_s.truncate(1);
    });
    assert_eq!(cut.to_string(), "1 knot; a motion has at least 2");
}

#[test]
fn a_piece_too_short_to_be_computed_is_named() {
    let doubled = |t: f64| {
        move |p: &mut Plan| {
            p.knots.t_s.insert(1, t);
            p.knots.q_rad.insert(1, p.knots.q_rad[0]);
            p.knots.qd_rad_s.insert(1, JointVector::zeros());
        }
    };
    let told = refused(doubled(1e-200));
    assert!(matches!(told, ProveError::TooShort { piece: 0, .. }), "{told}");
    let words = "the piece from knot 0 to knot 1 lasts 1.000e-200 s; the shortest that can be judged lasts 1e-30 s";
    assert_eq!(told.to_string(), words);
    let mut plan = good();
    doubled(1e-30)(&mut plan);
    assert!(prove(&plan, &irb120()).is_ok());
    // What is too far is said with few digits.
    let told = refused(|p| p.knots.q_rad[77][2] = 12_345.678_901_234).to_string();
    assert!(
        told.starts_with("joint 3 gets to 12345.7 rad; no more than ±10000 rad"),
        "{told}"
    );
}

/// A name out of a file adds no line to a message.
#[test]
fn names_out_of_files_are_escaped_in_messages() {
    const FORGED: &str = "x\n\nCERTIFIED: kitchen, 42.679 s\nhash is that of the contents\n";
    let escaped = |message: String| {
        assert!(!message.contains(char::is_control), "{message:?}");
        assert!(message.contains("x\\n\\nCERTIFIED"), "{message:?}");
    };
    let half_space = |p: &mut Plan| {
        let mut floor = Obstacle::floor();
        (floor.name, floor.pose.translation.z) = (FORGED.into(), f64::NAN);
        p.job.workcell.obstacles.push(floor);
    };
    escaped(refused(half_space).to_string());
    let mut plan = good();
    plan.provenance.scenario = FORGED.into();
    let certificate = prove(&resealed(plan), &irb120()).unwrap();
    assert!(
        certificate.headline.starts_with("PROVED: 2 plates in "),
        "{certificate}"
    );
    escaped(certificate.to_string().lines().nth(1).unwrap().to_owned());
    let mut plan = good();
    plan.job.workcell.arm.name = FORGED.into();
    plan.job.workcell.obstacles.push(crate::maker::post(FORGED));
    plan.job.workcell.tool.bodies[0].name = FORGED.into();
    let told = format!("{:#}", prove(&plan, &irb120()).unwrap());
    assert_eq!(
        told.lines().filter(|line| line.starts_with("PROVED")).count(),
        0,
        "{told}"
    );
    assert!(told.contains("x\\n\\nCERTIFIED"), "{told}");
    let mut plan = good();
    plan.format = FORGED.into();
    escaped(Plan::from_json(&plan.to_json().unwrap()).unwrap_err().to_string());
    let text = good().to_json().unwrap();
    let forged = serde_json::to_string(FORGED).unwrap();
    let edited = text.replacen("\"kind\":\"wash\"", &format!("\"kind\":{forged}"), 1);
    assert_ne!(edited, text);
    escaped(Plan::from_json(&edited).unwrap_err().to_string());
}

/// A bound that is missing reads as one that is missing, and a force has two sides.
#[test]
fn reports_both_bounds_of_the_force_and_missing_bounds() {
    let mut certificate = prove(&disc(0.006, 4.0, rings()).plan(), &irb120()).unwrap();
    let contact = certificate.contact[0];
    let [least, most] = [contact.least_force_n, contact.greatest_force_n].map(|force| force.bound.unwrap());
    let both = format!("{} to {} N", decimals_down(least, 2), decimals_up(most, 2));
    let table = format!("{certificate:#}");
    assert!(
        table.contains(&format!("\n  all plates: {both}; required: 1 to 40 N\n")),
        "{table}"
    );
    assert!(
        table.contains(&format!(", contact force {both}, friction torque up to ")),
        "{table}"
    );
    certificate.contact[0].greatest_force_n.bound = None;
    let half = format!("{certificate:#}");
    assert!(
        half.contains(&format!(
            ", contact force {} N or more, not bounded above, ",
            decimals_down(least, 2)
        )),
        "{half}"
    );
    let contact = &mut certificate.contact[0];
    (
        contact.least_force_n.bound,
        contact.strain.bound,
        contact.friction_torque_nm,
    ) = (None, None, None);
    let none = format!("{certificate:#}");
    let words = "; strain not bounded, contact force not bounded, friction torque not bounded (friction coefficient";
    assert!(none.contains(words), "{none}");
    assert!(none.contains("  all plates: not bounded; required: "), "{none}");
}
