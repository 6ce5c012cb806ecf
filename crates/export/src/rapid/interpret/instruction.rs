//! Instructions: the program's own procedures, and those of the controller.

use super::argument::{Signature, Taken};
use super::machine::{Machine, Run};
use super::unmodelled::why_not;
use super::value::Value;
use crate::rapid::syntax::ast::{Argument, Expression, Name};
use std::rc::Rc;

/// Most messages that are kept, the last ones.
const MOST_MESSAGES: usize = 20;

const TP_ERASE: Signature = Signature {
    name: "TPErase",
    required: 0,
    options: &[],
};
const TP_WRITE: Signature = Signature {
    name: "TPWrite",
    required: 1,
    options: &[("num", 1), ("bool", 1)],
};
const ERR_WRITE: Signature = Signature {
    name: "ErrWrite",
    required: 2,
    options: &[("w", 0), ("i", 0), ("rl2", 2), ("rl3", 2), ("rl4", 2)],
};
/// Of supervision of configurations and singularities, which a motion in the joints knows none of.
const SWITCHED: Signature = Signature {
    name: "ConfJ, ConfL or SingArea",
    required: 0,
    options: &[("on", 0), ("off", 0), ("wrist", 0), ("lockaxis4", 0)],
};
const ACC_SET: Signature = Signature {
    name: "AccSet",
    required: 2,
    options: &[],
};
const VEL_SET: Signature = Signature {
    name: "VelSet",
    required: 2,
    options: &[],
};
/// What sets accelerations or speeds to those of the arm \[%\].
const FULL: f32 = 100.0;
/// The speed of the tip that controllers allow where nothing else is set \[mm/s\].
const USUAL_MM_S: f32 = 5000.0;

impl<'a> Machine<'a> {
    /// Runs an instruction or a procedure.
    pub fn instruction(&mut self, name: &'a Name, arguments: &'a [Argument]) -> Run<()> {
        match &*name.key {
            "moveabsj" => self.move_abs_j(name, arguments),
            "waittime" => self.wait(name, arguments),
            "tperase" => self.taken(name.at, &TP_ERASE, arguments).map(|_| self.messages.clear()),
            "tpwrite" => self.message(name, &TP_WRITE, arguments),
            "errwrite" => self.message(name, &ERR_WRITE, arguments),
            "confj" | "confl" | "singarea" => self.taken(name.at, &SWITCHED, arguments).map(|_| ()),
            "accset" => self.full_only(name, (&ACC_SET, FULL), arguments),
            "velset" => self.full_only(name, (&VEL_SET, USUAL_MM_S), arguments),
            _ => match self.routine(self.module(), &name.key) {
                Some((module, routine)) => self.call(name, module, routine, arguments).map(|_| ()),
                None => self.refuse(name.at, why_not(name)),
            },
        }
    }

    fn message(&mut self, name: &'a Name, signature: &Signature, arguments: &'a [Argument]) -> Run<()> {
        let taken = self.taken(name.at, signature, arguments)?;
        let mut texts = Vec::new();
        for part in &taken.required {
            texts.push(self.text(part)?.to_string());
        }
        texts.extend(self.message_value(&taken)?);
        if self.messages.len() >= MOST_MESSAGES {
            self.messages.remove(0);
        }
        self.messages.push(Rc::from(texts.join(" ")));
        Ok(())
    }

    fn message_value(&mut self, taken: &Taken<'a>) -> Run<Option<String>> {
        let value = |option| taken.option(option).and_then(|(_, value)| value);
        let numbers: [Option<&'a Expression>; 2] = [value("num"), value("bool")];
        let Some(expression) = numbers.into_iter().flatten().next() else {
            return Ok(None);
        };
        match self.evaluate(expression)? {
            Value::Num(number) => Ok(Some(number.to_string())),
            Value::Truth(truth) => Ok(Some(truth.to_string().to_uppercase())),
            other => self.refuse(
                expression.at,
                format!("expected a num or a bool, found {}", other.kind()),
            ),
        }
    }

    /// An override of accelerations or speeds is modelled where it changes nothing.
    fn full_only(
        &mut self,
        name: &'a Name,
        (signature, least): (&Signature, f32),
        arguments: &'a [Argument],
    ) -> Run<()> {
        let taken = self.taken(name.at, signature, arguments)?;
        let [first, second] = taken.required[..] else {
            return self.refuse(name.at, "expected two numbers");
        };
        let (share, second) = (self.number(first)?, self.number(second)?);
        if share == FULL && second >= least {
            return Ok(());
        }
        self.refuse(
            name.at,
            format!(
                "{} other than 100 % changes how long motions take, which is not modelled: expected 100 and {least} or more",
                signature.name
            ),
        )
    }
}
