//! A program carried out.
//!
//! Where the arm stands is not known beforehand. A program may ask, and may tell something or halt, depending on the answer, before it
//! moves; its motion must not depend on it. So it is carried out without an answer, which gives its motion, and once more by an arm that
//! stands at its start, which must come to the same end.

use super::controller::{Controller, INSTRUCTIONS, not_modelled};
use super::fault::Fault;
use super::parse;
use super::tree::{Branch, Call, Function, Statement, StatementKind};
use super::value::Value;
use super::variables::{self, Variables};
use crate::dialect::ReadError;
use crate::file::{Place, ProgramFile};
use crate::reading::{OFF_START_DEG, Reading};
use platewash_kinematics::{AXES, JointVector};
use platewash_workcell::words::quoted;
use std::collections::BTreeMap;

/// Most statements that are carried out.
const MOST_STEPS: usize = 400_000;

/// Deepest nesting of calls.
const DEEPEST: usize = 32;

/// Instructions that only tell something.
const TELLING: [&str; 2] = ["popup", "textmsg"];

/// The share of the plan's speed that a program states.
const SHARE: &str = "speed_share";

/// What a program does.
pub(super) fn reading(file: &ProgramFile) -> Result<Reading, ReadError> {
    let statements = parse::program(file)?;
    let mut asked = Run::new(file, None);
    asked.whole(&statements)?;
    let line = asked.line;
    let at = |fault: Fault| fault.at(&file.name, line);
    let Some(start) = asked.controller.start().filter(|_| asked.controller.moves()) else {
        let reason = "the program ends here and has not moved; expected movej to its start, then servoj";
        return Err(ReadError::at(&file.name, line, reason));
    };
    let share = asked.share()?;
    let mut answered = Run::new(file, Some(start));
    answered.whole(&statements)?;
    if answered.controller.points() != asked.controller.points() {
        let reason = "the program halts here, though the arm stands where it begins";
        return Err(ReadError::at(&file.name, answered.line, reason));
    }
    let read = asked.controller.reading(share).map_err(at)?;
    Ok(Reading {
        checks_start: stays_elsewhere(file, &statements, start)?,
        ..read
    })
}

/// Whether a program does not move where a joint of the arm is away from the start.
fn stays_elsewhere(file: &ProgramFile, statements: &[Statement], start: JointVector) -> Result<bool, ReadError> {
    let signed = OFF_START_DEG.into_iter().flat_map(|deg| [deg, -deg]);
    for (joint, deg) in signed.flat_map(|deg| (0..AXES).map(move |joint| (joint, deg))) {
        let mut stands = start;
        stands[joint] += deg.to_radians();
        let mut run = Run::new(file, Some(stands));
        run.whole(statements)?;
        if !run.controller.points().is_empty() {
            return Ok(false);
        }
    }
    Ok(true)
}

/// Whether a program goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Flow {
    On,
    Ended,
}

struct Run<'a> {
    file: &'a str,
    controller: Controller,
    functions: BTreeMap<&'a str, &'a Function>,
    variables: Variables,
    /// The statement that runs, and how many have.
    line: usize,
    steps: usize,
    /// The line that a point is told by, where a function was told it.
    told_at: Option<usize>,
}

impl<'a> Run<'a> {
    fn new(file: &'a ProgramFile, measured: Option<JointVector>) -> Self {
        Self {
            file: &file.name,
            controller: Controller::default(),
            functions: BTreeMap::new(),
            variables: Variables::new(measured),
            line: 1,
            steps: 0,
            told_at: None,
        }
    }

    /// A text's statements; one that only defines a function runs it, as the controller does.
    fn whole(&mut self, statements: &'a [Statement]) -> Result<(), ReadError> {
        if let [
            Statement {
                line,
                kind: StatementKind::Function(program),
            },
        ] = statements
        {
            self.line = *line;
            if !program.parameters.is_empty() {
                return Err(self.fault("a program has no parameters"));
            }
            return self.block(&program.body).map(|_| ());
        }
        self.block(statements).map(|_| ())
    }

    fn fault(&self, reason: impl Into<String>) -> ReadError {
        ReadError::at(self.file, self.line, reason)
    }

    fn at<T>(&self, done: Result<T, Fault>) -> Result<T, ReadError> {
        done.map_err(|fault| fault.at(self.file, self.line))
    }

    fn block(&mut self, statements: &'a [Statement]) -> Result<Flow, ReadError> {
        for statement in statements {
            self.line = statement.line;
            self.steps += 1;
            if self.steps > MOST_STEPS {
                return Err(self.fault(format!("more than {MOST_STEPS} steps, the most that are carried out")));
            }
            if self.statement(statement)? == Flow::Ended {
                return Ok(Flow::Ended);
            }
        }
        Ok(Flow::On)
    }

    fn statement(&mut self, statement: &'a Statement) -> Result<Flow, ReadError> {
        match &statement.kind {
            StatementKind::Function(function) => {
                if self.functions.insert(&function.name, function).is_some() {
                    return Err(self.fault(format!("a second function {}", quoted(&function.name))));
                }
                Ok(Flow::On)
            }
            StatementKind::Assignment(scope, name, value) => {
                let value = self.variables.value(value);
                let value = self.at(value)?;
                let done = self.variables.assign(*scope, name, value, self.line);
                self.at(done).map(|()| Flow::On)
            }
            StatementKind::Call(call) => self.call(call),
            StatementKind::If(branches) => self.branches(branches),
            StatementKind::Halt => Ok(Flow::Ended),
        }
    }

    fn branches(&mut self, branches: &'a [Branch]) -> Result<Flow, ReadError> {
        for (k, branch) in branches.iter().enumerate() {
            self.line = branch.line;
            let holds = match &branch.condition {
                None => Value::Bool(true),
                Some(condition) => {
                    let value = self.variables.value(condition);
                    self.at(value)?
                }
            };
            match holds {
                Value::Bool(true) => return self.block(&branch.body),
                Value::Bool(false) => {}
                Value::Unknown => {
                    self.check_telling(branches.get(k..).unwrap_or_default())?;
                    return Ok(Flow::On);
                }
                other => return Err(self.fault(format!("expected True or False, found {}", other.told()))),
            }
        }
        Ok(Flow::On)
    }

    /// What depends on where the arm stands tells something or halts, before it moves, and does nothing else.
    fn check_telling(&mut self, branches: &'a [Branch]) -> Result<(), ReadError> {
        if self.controller.moves() {
            return Err(
                self.fault("what is done here depends on where the arm is; expected that before the motion alone")
            );
        }
        for statement in branches.iter().flat_map(|branch| &branch.body) {
            self.line = statement.line;
            match &statement.kind {
                StatementKind::Halt => {}
                StatementKind::If(inner) => self.check_telling(inner)?,
                StatementKind::Call(call) if TELLING.contains(&call.name.as_str()) => {
                    self.instruction(call)?;
                }
                _ => {
                    let reason = "this depends on where the arm stands; expected popup, textmsg or halt alone";
                    return Err(self.fault(reason));
                }
            }
        }
        Ok(())
    }

    fn call(&mut self, call: &'a Call) -> Result<Flow, ReadError> {
        if let Some(&function) = self.functions.get(call.name.as_str()) {
            return self.function(function, call);
        }
        self.instruction(call).map(|()| Flow::On)
    }

    fn instruction(&mut self, call: &Call) -> Result<(), ReadError> {
        let Some((name, parameters)) = INSTRUCTIONS.into_iter().find(|(name, _)| *name == call.name) else {
            return Err(not_modelled(&call.name).at(self.file, self.line));
        };
        let given = self.variables.arguments(call, parameters);
        let given = self.at(given)?;
        let place = Place {
            file: self.file.to_owned(),
            line: self.told_at.unwrap_or(self.line),
        };
        let done = self.controller.instruction(name, &given, place);
        self.at(done)
    }

    fn function(&mut self, function: &'a Function, call: &'a Call) -> Result<Flow, ReadError> {
        if self.variables.depth() > DEEPEST {
            return Err(self.fault(format!("functions call each other deeper than {DEEPEST}")));
        }
        let parameters: Vec<&str> = function.parameters.iter().map(String::as_str).collect();
        let given = self.variables.arguments(call, &parameters);
        let given = self.at(given)?;
        let mut variables = variables::Function::new();
        for (name, value) in parameters.into_iter().zip(given) {
            match value {
                Some(value) => variables.insert(name.to_owned(), (value, self.line)),
                None => return Err(self.fault(format!("expected an argument {}", quoted(name)))),
            };
        }
        let (line, told_at) = (self.line, self.told_at);
        if !variables.is_empty() {
            self.told_at = told_at.or(Some(line));
        }
        self.variables.enter(variables);
        let flow = self.block(&function.body)?;
        self.variables.leave();
        (self.line, self.told_at) = (line, told_at);
        Ok(flow)
    }

    /// The share of the plan's speed that the program states; 1 where it states none.
    fn share(&self) -> Result<f64, ReadError> {
        let Some((value, line)) = self.variables.of_program(SHARE) else {
            return Ok(1.0);
        };
        match value {
            Value::Number(share) if *share > 0.0 && *share <= 1.0 => Ok(*share),
            _ => Err(ReadError::at(
                self.file,
                *line,
                format!("expected {SHARE} above 0 and at most 1"),
            )),
        }
    }
}
