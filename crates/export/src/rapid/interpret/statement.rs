//! Statements, one after the other.

use super::flow::Flow;
use super::machine::{Machine, Run};
use super::operator::combined;
use super::store::{Binding, Content, Part};
use super::value::Value;
use crate::rapid::syntax::At;
use crate::rapid::syntax::ast::{For, Operator, Statement, StatementKind, Storage};
use std::rc::Rc;

impl<'a> Machine<'a> {
    /// Runs statements.
    pub fn block(&mut self, statements: &'a [Statement]) -> Run<Flow<'a>> {
        let mut next = 0;
        while let Some(statement) = statements.get(next) {
            self.count(statement.at, 1)?;
            next += 1;
            match self.deeper(statement.at, |this| this.statement(statement))? {
                Flow::On if self.motion.is_over => return Ok(Flow::Exit),
                Flow::On => {}
                Flow::Goto(label) => {
                    let is_it =
                        |other: &Statement| matches!(&other.kind, StatementKind::Label(name) if name.key == label.key);
                    match statements.iter().position(is_it) {
                        Some(index) => {
                            self.count(label.at, index)?;
                            next = index;
                        }
                        None => return Ok(Flow::Goto(label)),
                    }
                }
                other => return Ok(other),
            }
        }
        Ok(Flow::On)
    }

    fn statement(&mut self, statement: &'a Statement) -> Run<Flow<'a>> {
        match &statement.kind {
            StatementKind::Assign(target, value) => {
                let value = self.evaluate(value)?;
                let Some(part) = self.part_of(target)? else {
                    let name = &target.name;
                    return self.refuse(name.at, format!("the name {} is not declared", name.text));
                };
                self.assign(statement.at, &part, value)?;
                Ok(Flow::On)
            }
            StatementKind::Call(name, arguments) => {
                self.instruction(name, arguments)?;
                Ok(Flow::On)
            }
            StatementKind::LateCall(name, arguments) => {
                let text = self.text(name)?;
                match self.routine(self.module(), &text.to_lowercase()) {
                    Some((module, routine)) => self.call(&routine.name, module, routine, arguments).map(|_| Flow::On),
                    None => self.refuse(name.at, format!("there is no procedure {text:?}")),
                }
            }
            StatementKind::If(branches, otherwise) => {
                for (condition, body) in branches {
                    if self.truth(condition)? {
                        return self.block(body);
                    }
                }
                self.block(otherwise)
            }
            StatementKind::For(counting) => self.counting(statement.at, counting),
            StatementKind::While(condition, body) => {
                while self.truth(condition)? {
                    match self.block(body)? {
                        Flow::On => {}
                        other => return Ok(other),
                    }
                }
                Ok(Flow::On)
            }
            StatementKind::Test(value, cases, otherwise) => {
                let value = self.evaluate(value)?;
                for (choices, body) in cases {
                    for choice in choices {
                        let other = self.evaluate(choice)?;
                        match combined(value.clone(), Operator::Equal, other) {
                            Ok(Value::Truth(true)) => return self.block(body),
                            Ok(_) => {}
                            Err(reason) => return self.refuse(choice.at, reason.to_string()),
                        }
                    }
                }
                self.block(otherwise)
            }
            StatementKind::Goto(label) => Ok(Flow::Goto(label)),
            StatementKind::Label(_) => Ok(Flow::On),
            StatementKind::Return(None) => Ok(Flow::Return(None)),
            StatementKind::Return(Some(value)) => Ok(Flow::Return(Some(self.evaluate(value)?))),
            StatementKind::Exit => Ok(Flow::Exit),
            StatementKind::Raise(_) | StatementKind::Retry | StatementKind::TryNext => self.refuse(
                statement.at,
                "RAISE, RETRY and TRYNEXT are not modelled: what is done after an error is not judged",
            ),
            StatementKind::Connect(..) => {
                self.refuse(statement.at, "CONNECT is not modelled: a trap may run at any time")
            }
        }
    }

    fn counting(&mut self, at: At, counting: &'a For) -> Run<Flow<'a>> {
        let (from, to) = (self.number(&counting.from)?, self.number(&counting.to)?);
        let step = match &counting.step {
            Some(step) => self.number(step)?,
            None if from <= to => 1.0,
            None => -1.0,
        };
        if step == 0.0 {
            return self.refuse(at, "expected a STEP other than 0, found 0");
        }
        let slot = self.keep(Value::Num(from), Storage::Const);
        let key = Rc::clone(&counting.name.key);
        let hidden = self.set_name(&key, Some(Binding::Data(Part::whole(slot))));
        let mut value = from;
        let mut flow = Flow::On;
        while if step > 0.0 { value <= to } else { value >= to } {
            self.count(at, 1)?;
            if let Some(kept) = self.slots.get_mut(slot) {
                kept.content = Content::Ready(Value::Num(value));
            }
            flow = self.block(&counting.body)?;
            if !matches!(flow, Flow::On) {
                break;
            }
            value += step;
        }
        self.set_name(&key, hidden);
        // Calls and loops within it have taken theirs away: what counts is the last one.
        self.slots.truncate(slot);
        Ok(flow)
    }

    /// Gives a name a meaning in the innermost routine, or none; what it had.
    fn set_name(&mut self, key: &Rc<str>, binding: Option<Binding>) -> Option<Binding> {
        let names = &mut self.frames.last_mut()?.names;
        match binding {
            Some(binding) => names.insert(Rc::clone(key), binding),
            None => names.remove(key),
        }
    }
}
