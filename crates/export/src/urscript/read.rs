//! Motion of a program: its lines from the first on, each of which a [`Controller`] carries out.
//!
//! It reads the programs that [`super::write`] makes, and usual additions by hand: motions with `servoj`, messages, outputs and
//! comments. The check of the start is read as it is written. Everything else is refused with its line: loops, other conditions,
//! threads, functions with parameters, and computed values.

use crate::dialect::start_within::START_WITHIN_DEG;
use crate::program::{Place, ProgramFile};
use crate::reading::{self, Line, MOST_LINES, Reading, Token};
use crate::urscript::controller::{Controller, Value};
use platewash_kinematics::{AXES, JointVector};
use platewash_motion_proof::ReadError;
use std::collections::BTreeMap;

/// Largest excess of the limit of the check over [`START_WITHIN_DEG`], for its digits.
const NEARLY: f64 = 1e-6;

/// The share of the plan's speed that a program states.
const SHARE: &str = "speed_share";

/// Joint positions that the arm measures.
const MEASURED: &str = "get_actual_joint_positions";

/// Words that begin a block, which `end` closes.
const BLOCKS: [&str; 6] = ["def", "if", "while", "for", "thread", "sec"];

/// Interprets a program.
///
/// # Errors
/// [`ReadError`] with the line that is not read.
pub(crate) fn reading(file: &ProgramFile) -> Result<Reading, ReadError> {
    let lines = reading::lines(file, '#', |_, _| false)?;
    let at = |line: usize, reason: String| ReadError::at(&file.name, line, reason);
    let Some((first, rest)) = lines.split_first() else {
        return Err(at(1, "expected a program `def NAME():`, found nothing".to_owned()));
    };
    head(&first.tokens).map_err(|reason| at(first.number, reason))?;
    let end = end_of(rest).ok_or_else(|| at(first.number, "this `def` has no `end`".to_owned()))?;
    if let Some(line) = rest.get(end + 1) {
        return Err(at(
            line.number,
            "expected one program, which ends before this line".to_owned(),
        ));
    }
    let mut run = Run {
        file: &file.name,
        line: 1,
        share_at: 1,
        ..Run::default()
    };
    run.block(&rest[..end])?;
    let share = match run.globals.get(SHARE) {
        None => None,
        Some(Value::Number(share)) if *share > 0.0 && *share <= 1.0 => Some(*share),
        Some(_) => return Err(at(run.share_at, format!("expected {SHARE} above 0 and at most 1"))),
    };
    let within_rad = run
        .within_rad
        .into_iter()
        .try_fold(0.0_f64, |most, within| Some(most.max(within?)));
    let start_within_deg = within_rad.filter(|_| run.start.is_some()).map(f64::to_degrees);
    let last = run.line;
    let read = run.controller.reading(share).map_err(|reason| at(last, reason))?;
    Ok(Reading {
        start_within_deg,
        ..read
    })
}

/// The index of the `end` of a block that has begun.
fn end_of(lines: &[Line]) -> Option<usize> {
    let mut depth = 1_usize;
    lines.iter().position(|line| {
        match line.first_word() {
            Some(word) if BLOCKS.contains(&word) => depth += 1,
            Some("end") => depth -= 1,
            _ => {}
        }
        depth == 0
    })
}

/// The name in `def NAME():`.
fn head(tokens: &[Token]) -> Result<&str, String> {
    match tokens {
        [Token::Word(def), Token::Word(name), open, close, colon]
            if def == "def" && open.is("(") && close.is(")") && colon.is(":") =>
        {
            Ok(name)
        }
        _ => Err("expected `def NAME():`; functions with parameters are not read".to_owned()),
    }
}

/// A program that is carried out.
#[derive(Default)]
struct Run<'a> {
    file: &'a str,
    controller: Controller,
    functions: BTreeMap<&'a str, &'a [Line]>,
    globals: BTreeMap<&'a str, Value>,
    /// The variable that holds the measured joints of the arm.
    measured: Option<&'a str>,
    /// Configuration in which the check expects the arm \[rad\], and the joints that it checks.
    start: Option<JointVector>,
    within_rad: [Option<f64>; AXES],
    /// Functions that run.
    calls: Vec<&'a str>,
    line: usize,
    share_at: usize,
    steps: usize,
    is_over: bool,
}

impl<'a> Run<'a> {
    fn refused(&self, reason: impl Into<String>) -> ReadError {
        ReadError::at(self.file, self.line, reason)
    }

    fn block(&mut self, lines: &'a [Line]) -> Result<(), ReadError> {
        let mut rest = lines;
        while let Some((line, behind)) = rest.split_first() {
            (self.line, rest) = (line.number, behind);
            self.steps += 1;
            if self.steps > MOST_LINES {
                return Err(self.refused(format!("more than {MOST_LINES} steps, the most that are carried out")));
            }
            match line.first_word() {
                Some("def") => {
                    let name = head(&line.tokens).map_err(|reason| self.refused(reason))?;
                    let Some(end) = end_of(rest) else {
                        return Err(self.refused("this `def` has no `end`"));
                    };
                    let opens = |line: &&Line| line.first_word().is_some_and(|word| BLOCKS.contains(&word));
                    if let Some(line) = rest[..end].iter().find(opens) {
                        self.line = line.number;
                        return Err(self.refused("in functions, only instructions are read: write out what moves"));
                    }
                    if is_taken(name) {
                        return Err(self.refused(format!("`{name}` is the controller's own")));
                    }
                    if self.functions.insert(name, &rest[..end]).is_some() || self.globals.contains_key(name) {
                        return Err(self.refused(format!("`{name}` is given twice")));
                    }
                    rest = &rest[end + 1..];
                }
                Some("if") => {
                    self.check(line, rest)?;
                    rest = &rest[3..];
                }
                Some("halt") if line.tokens.len() == 1 => self.is_over = true,
                _ => self.statement(&line.tokens)?,
            }
            if self.is_over {
                break;
            }
        }
        Ok(())
    }

    /// The check of a joint: a message and `halt` where the arm is too far from the start.
    fn check(&mut self, line: &Line, behind: &[Line]) -> Result<(), ReadError> {
        let [found, joint, start, limit] = [3, 5, 8, 14].map(|place| line.tokens.get(place));
        let (Some(Token::Word(found)), Some(Token::Number(joint))) = (found, joint) else {
            return Err(self.refused(ONLY));
        };
        let (Some(Token::Word(start)), Some(Token::Number(limit))) = (start, limit) else {
            return Err(self.refused(ONLY));
        };
        let written = format!("if norm({found}[{joint}] - {start}[{joint}]) > {limit}:");
        let is_written = reading::line(&written, '#').is_ok_and(|written| written == line.tokens);
        let is_shape = is_written && is_popup_and_halt(behind);
        let j = (0..AXES).find(|j| *j as f64 == *joint);
        let Some(j) = j.filter(|_| is_shape && self.measured == Some(found)) else {
            return Err(self.refused(ONLY));
        };
        if !self.controller.points().is_empty() {
            return Err(self.refused("this check must stand before the first motion"));
        }
        let start = match self.globals.get(start.as_str()).map(Value::list) {
            Some(Ok(start)) => JointVector::from(start),
            _ => return Err(self.refused(ONLY)),
        };
        if self.start.is_some_and(|before| before != start) {
            return Err(self.refused("the joints are compared with different starts"));
        }
        self.start = Some(start);
        if (0.0..=START_WITHIN_DEG[0].to_radians() * (1.0 + NEARLY)).contains(limit) {
            self.within_rad[j] = Some(self.within_rad[j].map_or(*limit, |before| before.min(*limit)));
        }
        // The message in it must be readable, too.
        let message = behind.first().map_or(&[][..], |line| &line.tokens[..]);
        self.arguments(&message[1..], Controller::parameters("popup").unwrap_or_default())
            .map(|_| ())
            .map_err(|reason| self.refused(reason))
    }

    fn statement(&mut self, tokens: &'a [Token]) -> Result<(), ReadError> {
        let done = match tokens {
            [Token::Word(name), open, ..] if open.is("(") => self.call(name, &tokens[1..]),
            [Token::Word(scope), Token::Word(name), is, value @ ..]
                if ["global", "local"].contains(&scope.as_str()) && is.is("=") =>
            {
                self.assign(name, value)
            }
            [Token::Word(name), is, value @ ..] if is.is("=") => self.assign(name, value),
            [Token::Word(name), ..] => Err(refusal_reason(name)),
            _ => Err("expected an instruction".to_owned()),
        };
        done.map_err(|reason| self.refused(reason))
    }

    fn assign(&mut self, name: &'a str, tokens: &'a [Token]) -> Result<(), String> {
        if !self.calls.is_empty() || !self.controller.points().is_empty() {
            return Err("variables are read before the first motion alone, outside of functions".to_owned());
        }
        if is_taken(name) {
            return Err(format!("`{name}` is the controller's own"));
        }
        if self.globals.contains_key(name) || self.functions.contains_key(name) || self.measured == Some(name) {
            return Err(format!("`{name}` is given twice"));
        }
        if name == SHARE {
            self.share_at = self.line;
        }
        if let [Token::Word(function), open, close] = tokens
            && function == MEASURED
            && open.is("(")
            && close.is(")")
        {
            self.measured = Some(name);
            return Ok(());
        }
        let (value, rest) = self.value(tokens)?;
        end(rest)?;
        self.globals.insert(name, value);
        Ok(())
    }

    fn call(&mut self, name: &'a str, arguments: &'a [Token]) -> Result<(), String> {
        if let Some(parameters) = Controller::parameters(name) {
            let given = self.arguments(arguments, parameters)?;
            let place = Place::new(self.file, self.line);
            let is_first = self.controller.points().is_empty();
            self.controller.instruction(name, &given, place)?;
            return match (is_first, self.controller.points(), self.start) {
                (true, [first], Some(start)) if first.q_rad != start => {
                    Err("the check compares with another start: expected the first movej to lead there".to_owned())
                }
                _ => Ok(()),
            };
        }
        let Some(lines) = self.functions.get(name).copied() else {
            return Err(refusal_reason(name));
        };
        if arguments.len() != 2 || !arguments[1].is(")") {
            return Err(format!("expected `{name}()`"));
        }
        if self.calls.contains(&name) {
            return Err(format!("`{name}` runs itself, which never ends"));
        }
        self.calls.push(name);
        let line = self.line;
        // A fault within the function has its own line.
        let done = self.block(lines);
        self.calls.pop();
        done.map_err(|error| {
            self.line = error.place.line;
            error.reason
        })?;
        self.line = line;
        Ok(())
    }

    /// Values of an instruction's parameters, in their order, out of `(…)`.
    fn arguments(&self, tokens: &[Token], parameters: &[&str]) -> Result<Vec<Option<Value>>, String> {
        let mut given = vec![None; parameters.len()];
        let mut rest = match tokens {
            [open, rest @ ..] if open.is("(") => rest,
            _ => return Err("expected `(`".to_owned()),
        };
        let mut position = 0;
        while !rest.first().is_some_and(|token| token.is(")")) {
            let index = match rest {
                [Token::Word(name), is, behind @ ..] if is.is("=") => {
                    rest = behind;
                    let index = parameters.iter().position(|parameter| parameter == name);
                    index.ok_or_else(|| format!("no argument `{name}` is read here"))?
                }
                _ => position,
            };
            position = index + 1;
            let (value, behind) = self.value(rest)?;
            let slot = given
                .get_mut(index)
                .ok_or_else(|| format!("expected {} arguments at most", parameters.len()))?;
            if slot.replace(value).is_some() {
                return Err(format!("`{}` is given twice", parameters[index]));
            }
            rest = match behind {
                [comma, behind @ ..] if comma.is(",") => behind,
                [close, ..] if close.is(")") => behind,
                _ => return Err("expected `,` or `)`".to_owned()),
            };
        }
        end(&rest[1..])?;
        Ok(given)
    }

    /// A literal, or the value of a variable, and the tokens behind it.
    fn value<'t>(&self, tokens: &'t [Token]) -> Result<(Value, &'t [Token]), String> {
        match tokens {
            [Token::Text(_), rest @ ..] => Ok((Value::Text, rest)),
            [Token::Word(word), rest @ ..] if ["True", "False"].contains(&word.as_str()) => Ok((Value::Bool, rest)),
            [Token::Word(p), open, ..] if p == "p" && open.is("[") => {
                let (numbers, rest) = numbers(&tokens[1..])?;
                let found = numbers.len();
                let pose = numbers
                    .try_into()
                    .map_err(|_| format!("expected a pose of 6 numbers, found {found}"))?;
                Ok((Value::Pose(pose), rest))
            }
            [Token::Word(name), rest @ ..] => match self.globals.get(name.as_str()) {
                Some(value) => Ok((value.clone(), rest)),
                None => Err(format!("there is no variable `{name}` with a value")),
            },
            [open, ..] if open.is("[") => numbers(tokens).map(|(numbers, rest)| (Value::List(numbers), rest)),
            _ => number(tokens).map(|(number, rest)| (Value::Number(number), rest)),
        }
    }
}

/// Checks that a name is an instruction or a function of the controller, which a program must not replace.
fn is_taken(name: &str) -> bool {
    Controller::parameters(name).is_some() || [MEASURED, "norm", "halt"].contains(&name)
}

fn end(rest: &[Token]) -> Result<(), String> {
    match rest.first() {
        None => Ok(()),
        Some(token) => Err(format!(
            "expected the end of the line, found {token}; computed values are not read"
        )),
    }
}

fn number(tokens: &[Token]) -> Result<(f64, &[Token]), String> {
    match tokens {
        [Token::Number(number), rest @ ..] => Ok((*number, rest)),
        [minus, Token::Number(number), rest @ ..] if minus.is("-") => Ok((-number, rest)),
        [other, ..] => Err(format!(
            "expected a number, found {other}; computed values are not read"
        )),
        [] => Err("expected a number, found the end of the line".to_owned()),
    }
}

fn numbers(tokens: &[Token]) -> Result<(Vec<f64>, &[Token]), String> {
    let (mut all, mut rest) = (Vec::new(), &tokens[1..]);
    loop {
        let (next, behind) = number(rest)?;
        all.push(next);
        rest = match behind {
            [comma, rest @ ..] if comma.is(",") => rest,
            [close, rest @ ..] if close.is("]") => return Ok((all, rest)),
            _ => return Err("expected `,` or `]` in a list of numbers; computed values are not read".to_owned()),
        };
    }
}

/// Explains why a word is refused.
fn refusal_reason(name: &str) -> String {
    let why = match name {
        "while" | "for" | "break" | "continue" | "elif" | "else" | "return" => {
            "loops, conditions and jumps are not read: write out what moves"
        }
        "thread" | "run" | "sec" | "struct" => "what runs beside the motion is not read",
        "movel" | "movep" | "movec" | "speedl" | "speedj" | "servoc" | "servol" => {
            "the controller plans or times this motion; only servoj is read"
        }
        "sleep" | "sync" => {
            "how the arm moves on while the program waits is not known; write out servoj to where it stays"
        }
        "end" => "this closes nothing",
        _ => "it is neither a function of this program nor an instruction that is read",
    };
    format!("`{name}`: {why}")
}

/// Reason for refusing any other block.
const ONLY: &str =
    "only the check of the start is read, as it is exported: `if norm(found[0] - start[0]) > LIMIT:`, popup, halt, end";

/// Checks that the lines of a block are `popup(…)`, `halt` and `end`.
fn is_popup_and_halt(block: &[Line]) -> bool {
    let [popup, halt, end, ..] = block else { return false };
    let is_alone = |line: &Line, word: &str| line.first_word() == Some(word) && line.tokens.len() == 1;
    popup.first_word() == Some("popup") && is_alone(halt, "halt") && is_alone(end, "end")
}
