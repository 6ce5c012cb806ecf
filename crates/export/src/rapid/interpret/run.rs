//! A program, run from its main procedure to its end.

use super::machine::{Machine, Run};
use super::program::{Source, nothing};
use super::share::SHARE;
use super::store::{Content, Frame};
use super::value::Value;
use crate::dialect::ReadError;
use crate::file::ProgramFile;
use crate::program::START_WITHIN_DEG;
use crate::rapid::syntax::At;
use crate::rapid::syntax::ast::RoutineKind;
use crate::reading::{Between, OFF_START_DEG, ReadPoint, Reading};
use platewash_kinematics::{AXES, JointVector};

/// Where every program begins.
const MAIN: &str = "main";

/// How far from its start the arm is put, a joint at a time, and still stands at it \[°\].
const AT_START_DEG: [f64; 2] = [0.01, 0.4];

/// Parts of the stated share of the speed at which a program is run once more.
const SLOWER: [f64; 2] = [0.5, 0.03];

/// How far times may be off for the rounding of single numbers, as a part of them.
const NEARLY: f64 = 1e-6;

/// What a program does.
///
/// # Errors
/// [`ReadError`], with the line of what is no RAPID, is not modelled, or would not run.
pub fn run(files: &[ProgramFile]) -> Result<Reading, ReadError> {
    let sources = Source::of(files)?;
    let mut machine = Machine::new(&sources)?;
    machine.run_main(JointVector::zeros())?;
    let asks = machine.start_asked;
    let mut read = machine.reading()?;
    if asks {
        read.checks_start = check_elsewhere(&sources, &read)?;
    }
    if let Some(share) = read.speed_share {
        check_slower(&sources, &read, share)?;
    }
    Ok(read)
}

/// A program that states a share of its speed is run at smaller ones without being judged again: it must go the same way
/// then, and be nowhere faster.
fn check_slower(sources: &[Source], read: &Reading, share: f64) -> Run<()> {
    for part in SLOWER {
        let mut machine = Machine::new(sources)?;
        machine.state_share((share * part) as f32);
        machine.run_main(JointVector::zeros())?;
        let points = &machine.motion.points;
        let lasts_s =
            |points: &[ReadPoint], k: usize| points[k].t_s - k.checked_sub(1).map_or(0.0, |before| points[before].t_s);
        let differs = points
            .iter()
            .zip(&read.points)
            .enumerate()
            .find(|(k, (found, expected))| {
                let same =
                    (&found.place, found.q_rad, found.corner_m) == (&expected.place, expected.q_rad, expected.corner_m);
                !same || lasts_s(points, *k) < (1.0 - NEARLY) * lasts_s(&read.points, *k)
            });
        let place = differs.map(|(_, (found, _))| &found.place);
        let shorter = (points.len() != read.points.len()).then(|| points.last()).flatten();
        if let Some(place) = place.or(shorter.map(|last| &last.place)) {
            return Err(ReadError {
                place: place.clone(),
                reason: format!(
                    "at a smaller {SHARE}, {}, the motion is another one from here on, and not only slower",
                    share * part
                ),
            });
        }
    }
    Ok(())
}

/// A program that asks where the arm stands may end because of the answer. Its motion must not depend on it. Answers whether it ends without
/// a motion wherever the arm does not stand at the start.
fn check_elsewhere(sources: &[Source], read: &Reading) -> Run<bool> {
    let mut stays = true;
    let signed = AT_START_DEG
        .into_iter()
        .chain(OFF_START_DEG)
        .flat_map(|deg| [deg, -deg]);
    let away = signed.flat_map(|deg| (0..AXES).map(move |joint| (joint, deg)));
    for (joint, deg) in away {
        let mut machine = Machine::new(sources)?;
        let mut away_rad = JointVector::zeros();
        away_rad[joint] = deg.to_radians();
        machine.run_main(away_rad)?;
        let points = &machine.motion.points;
        stays &= points.is_empty() || deg.abs() < START_WITHIN_DEG;
        if points.is_empty() || *points == read.points {
            continue;
        }
        let differs = points
            .iter()
            .zip(&read.points)
            .find(|(found, expected)| found != expected);
        let last = points.last().map(|point| &point.place);
        if let Some(place) = differs.map(|(found, _)| &found.place).or(last) {
            return Err(ReadError {
                place: place.clone(),
                reason: format!(
                    "the motion depends on where the arm stands: it is another one from here on where joint {} is {deg} deg from the start",
                    joint + 1
                ),
            });
        }
    }
    Ok(stays)
}

impl Machine<'_> {
    /// States another share of the speed than the program does.
    fn state_share(&mut self, share: f32) {
        let key = SHARE.to_lowercase();
        let local = self.locals.iter().filter_map(|module| module.get(key.as_str()));
        let slots: Vec<_> = self
            .globals
            .get(key.as_str())
            .into_iter()
            .chain(local)
            .copied()
            .collect();
        for slot in slots {
            if let Some(slot) = self.slots.get_mut(slot) {
                slot.content = Content::Ready(Value::Num(share));
            }
        }
    }

    /// Runs the program, with the arm so far from its start \[rad\].
    fn run_main(&mut self, away_rad: JointVector) -> Run<()> {
        // The controller begins with the global one.
        let Some((module, main)) = self.routines.get(MAIN).copied() else {
            let missing = "expected a procedure `main` that is not LOCAL, found none in these modules".to_owned();
            return Err(match self.sources.first() {
                Some(source) => source.refused(source.module.name.at, missing),
                None => nothing(missing),
            });
        };
        let name = &main.name;
        if !matches!(main.kind, RoutineKind::Proc) || !main.parameters.is_empty() {
            return self.refuse_in(module, name.at, "expected main to be a procedure without parameters");
        }
        self.start_rad = self.assumed_start(module, main);
        self.away_rad = away_rad;
        self.frames.push(Frame {
            module,
            ..Frame::default()
        });
        self.main_at = Some((module, name.at));
        self.call(name, module, main, &[])?;
        if self.motion.has_begun() && !self.motion.is_over {
            return self.refuse_in(
                module,
                name.at,
                "main ends without EXIT: in continuous mode the program begins again, which is not judged",
            );
        }
        Ok(())
    }

    /// What the program did.
    fn reading(mut self) -> Run<Reading> {
        let (module, at) = self.main_at.unwrap_or((0, At { line: 1, column: 1 }));
        let Some(last) = self.motion.points.last() else {
            let told: Vec<&str> = self.messages.iter().map(|message| &**message).collect();
            let told = if told.is_empty() {
                String::new()
            } else {
                format!("; it says: {}", told.join(" "))
            };
            return self.refuse_in(module, at, format!("the program ends before any motion{told}"));
        };
        if last.corner_m.is_some() {
            return Err(ReadError {
                place: last.place.clone(),
                reason: "the last motion must stop: expected `fine`, found a zone".to_owned(),
            });
        }
        Ok(Reading {
            // The decimal that the program states, not the single next to it.
            speed_share: self.motion.share.and_then(|share| share.to_string().parse().ok()),
            points: std::mem::take(&mut self.motion.points),
            between: Between::RoundedLines,
            tool: self.motion.tool,
            checks_start: false,
        })
    }
}
