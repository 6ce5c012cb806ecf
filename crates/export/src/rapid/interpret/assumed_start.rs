//! Where the arm is assumed to stand before the first motion: at the target of the first `MoveAbsJ` in the text, from `main` on.

use super::joints;
use super::machine::{MOST_DEPTH, Machine};
use super::store::Frame;
use crate::rapid::syntax::ast::{Argument, Expression, Routine, Statement, StatementKind};
use platewash_kinematics::JointVector;
use std::collections::HashSet;
use std::rc::Rc;

/// A search through the text.
struct Search<'m, 'a> {
    machine: &'m Machine<'a>,
    seen: HashSet<(usize, Rc<str>)>,
}

impl<'a> Machine<'a> {
    /// The target of the first `MoveAbsJ` of a routine or of those that it calls \[rad\], where it is made of constants.
    pub fn assumed_start(&mut self, module: usize, routine: &'a Routine) -> Option<JointVector> {
        let mut search = Search {
            machine: self,
            seen: HashSet::new(),
        };
        let (module, target) = search.in_block(module, &routine.body, 0)?;
        let frame = Frame {
            module,
            ..Frame::default()
        };
        self.frames.push(frame);
        let value = self.of_type(target, "jointtarget");
        self.frames.pop();
        joints::from_value(&value.ok()?).ok()
    }
}

impl<'a> Search<'_, 'a> {
    fn in_block(&mut self, module: usize, block: &'a [Statement], depth: usize) -> Option<(usize, &'a Expression)> {
        if depth > MOST_DEPTH {
            return None;
        }
        block
            .iter()
            .find_map(|statement| self.in_statement(module, statement, depth))
    }

    fn in_statement(
        &mut self,
        module: usize,
        statement: &'a Statement,
        depth: usize,
    ) -> Option<(usize, &'a Expression)> {
        let mut within = |block: &'a [Statement]| self.in_block(module, block, depth + 1);
        match &statement.kind {
            StatementKind::Call(name, arguments) if &*name.key == "moveabsj" => {
                let target = arguments.iter().find_map(|argument| match argument {
                    Argument::Required(target) => Some(target),
                    Argument::Optional(..) | Argument::Passed(..) => None,
                });
                target.map(|target| (module, target))
            }
            StatementKind::Call(name, _) => {
                let (module, routine) = self.machine.routine(module, &name.key)?;
                if !self.seen.insert((module, Rc::clone(&routine.name.key))) {
                    return None;
                }
                self.in_block(module, &routine.body, depth + 1)
            }
            StatementKind::If(branches, otherwise) => {
                let found = branches.iter().find_map(|(_, body)| within(body));
                found.or_else(|| within(otherwise))
            }
            StatementKind::For(counting) => within(&counting.body),
            StatementKind::While(_, body) => within(body),
            StatementKind::Test(_, cases, otherwise) => {
                let found = cases.iter().find_map(|(_, body)| within(body));
                found.or_else(|| within(otherwise))
            }
            _ => None,
        }
    }
}
