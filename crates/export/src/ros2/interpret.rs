//! A message as a reading; several files are one program where they say the same.

use super::language::Language;
use super::message::{At, Message, MessagePoint};
use super::node::{self, Fault};
use super::number::{self, Said};
use super::timing::seconds_between;
use super::{parse, rules, write};
use crate::dialect::ReadError;
use crate::file::{Place, ProgramFile};
use crate::reading::{Between, ReadPoint, Reading};
use platewash_kinematics::{AXES, JointVector, RobotModel};

/// A fault of a file.
pub(super) fn refused(file: &ProgramFile, Fault { line, reason }: Fault) -> ReadError {
    let file = file.name.clone();
    ReadError {
        place: Place {
            file,
            line: line.max(1),
        },
        reason,
    }
}

/// What messages do. All of them must do the same.
pub(super) fn reading(files: &[&ProgramFile], arm: &RobotModel) -> Result<Reading, ReadError> {
    let mut first: Option<(&ProgramFile, Reading)> = None;
    for file in files {
        let found = one(file, arm).map_err(|fault| refused(file, fault))?;
        match &first {
            None => first = Some((file, found)),
            Some((other, expected)) => same(&other.name, expected, &found).map_err(|fault| refused(file, fault))?,
        }
    }
    let stated = files.iter().find_map(|file| speed_share(&file.text));
    match (first, stated) {
        (Some((_, reading)), None) => Ok(reading),
        (Some((_, reading)), Some(Ok(share))) => Ok(Reading {
            speed_share: Some(share),
            ..reading
        }),
        (Some((file, _)), Some(Err(fault))) => Err(refused(file, fault)),
        (None, _) => Err(ReadError {
            place: Place {
                file: "joint_trajectory.yaml".to_owned(),
                line: 1,
            },
            reason: "expected a message in YAML or JSON; found none".to_owned(),
        }),
    }
}

fn one(file: &ProgramFile, arm: &RobotModel) -> Result<Reading, Fault> {
    let Some(language) = Language::of(&file.name) else {
        return Err(Fault::new(
            1,
            "expected a file .yaml, .yml or .json, or play.py; found another name",
        ));
    };
    if language == Language::Json && file.text.len() <= node::MAX_BYTES {
        let json = serde_json::from_str::<serde::de::IgnoredAny>(&file.text);
        json.map_err(|e| Fault::new(e.line(), format!("not JSON: {e}")))?;
    }
    let message = parse::message(&node::read(&file.text, language)?)?;
    rules::check(&message, arm).map_err(|breach| Fault::new(breach.line, breach.sentence()))?;
    let order = order(&message, arm);
    let start = message
        .points
        .value
        .first()
        .map_or(0, |point| point.time_from_start.nanoseconds());
    let read = |point: &MessagePoint| ReadPoint {
        place: Place {
            file: file.name.clone(),
            line: point.line,
        },
        t_s: seconds_between(start, point.time_from_start.nanoseconds()),
        q_rad: joints(&point.positions, &order),
        qd_rad_s: Some(joints(&point.velocities, &order)),
        corner_m: None,
    };
    Ok(Reading {
        speed_share: None,
        points: message.points.value.iter().map(read).collect(),
        between: Between::Cubics,
        tool: None,
        checks_start: false,
    })
}

/// Where each of the arm's joints stands among the names of a message that keeps the rules.
fn order(message: &Message, arm: &RobotModel) -> [usize; AXES] {
    let names = &message.joint_names.value;
    std::array::from_fn(|joint| {
        let name = &arm.joints()[joint].name;
        names.iter().position(|other| other.value == *name).unwrap_or(joint)
    })
}

fn joints(row: &At<Vec<f64>>, order: &[usize; AXES]) -> JointVector {
    JointVector::from_fn(|joint, _| row.value.get(order[joint]).copied().unwrap_or(f64::NAN))
}

/// Refuses a message that does not do what another one does.
fn same(other: &str, expected: &Reading, found: &Reading) -> Result<(), Fault> {
    let same = |a: &ReadPoint, b: &ReadPoint| a.t_s == b.t_s && a.q_rad == b.q_rad && a.qd_rad_s == b.qd_rad_s;
    let pairs = expected.points.iter().zip(&found.points).enumerate();
    for (k, (a, b)) in pairs {
        if !same(a, b) {
            let reason = format!(
                "expected point {k} as {other}:{} has it; found another one",
                a.place.line
            );
            return Err(Fault::new(b.place.line, reason));
        }
    }
    let [many, few] = [expected.points.len(), found.points.len()];
    match many == few {
        true => Ok(()),
        false => {
            let line = found.points.last().map_or(1, |point| point.place.line);
            Err(Fault::new(
                line,
                format!("expected {many} points, as many as {other} has; found {few}"),
            ))
        }
    }
}

/// The share of the speed that the head of a YAML file states.
fn speed_share(text: &str) -> Option<Result<f64, Fault>> {
    let head = text.lines().enumerate().take_while(|(_, line)| line.starts_with('#'));
    let (line, stated) = head
        .into_iter()
        .find_map(|(k, line)| Some((k + 1, line.strip_prefix(write::SPEED_SHARE)?)))?;
    Some(match number::read(stated.trim_end()) {
        Said::Float(share) if share > 0.0 && share <= 1.0 => Ok(share),
        _ => Err(Fault::new(
            line,
            "expected a speed share above 0.0 and at most 1.0; found another value",
        )),
    })
}
