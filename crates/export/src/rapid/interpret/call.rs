//! Calls of the program's own procedures and functions.

use super::flow::Flow;
use super::machine::{Machine, Run};
use super::store::{Binding, Frame, Part};
use super::value::Value;
use crate::rapid::syntax::At;
use crate::rapid::syntax::ast::{
    Argument, Expression, ExpressionKind, Name, Parameter, Passing, Presence, Routine, RoutineKind, Storage,
};
use std::collections::HashMap;
use std::rc::Rc;

impl<'a> Machine<'a> {
    /// Runs a routine; the value that a function returns.
    pub fn call(
        &mut self,
        name: &'a Name,
        module: usize,
        routine: &'a Routine,
        arguments: &'a [Argument],
    ) -> Run<Option<Value>> {
        self.deeper(name.at, |this| {
            this.count(name.at, 1)?;
            let kept = this.slots.len();
            let names = this.bound(name, routine, arguments)?;
            this.frames.push(Frame { module, names });
            let result = this.called(routine);
            this.frames.pop();
            // What its data held is gone with it. Data of modules are all older than any call.
            this.slots.truncate(kept);
            result
        })
    }

    fn called(&mut self, routine: &'a Routine) -> Run<Option<Value>> {
        if let Some(handler) = routine.handlers.iter().find(|handler| !handler.body.is_empty()) {
            let at = handler.body.first().map_or(routine.name.at, |statement| statement.at);
            return self.refuse(
                at,
                "handlers of errors are not modelled: what is done after an error is not judged",
            );
        }
        for data in &routine.data {
            let value = self.first_value(data)?;
            let slot = self.keep(value, data.storage);
            self.bind(&data.name, Binding::Data(Part::whole(slot)))?;
        }
        match (self.block(&routine.body)?, &routine.kind) {
            (Flow::On, RoutineKind::Proc | RoutineKind::Trap) | (Flow::Return(None), _) => Ok(None),
            (Flow::Return(Some(value)), RoutineKind::Func(type_name)) => {
                let default = self.default_of(type_name)?;
                self.fitted(routine.name.at, &default, value).map(Some)
            }
            (Flow::On, RoutineKind::Func(_)) => Ok(None),
            (Flow::Return(Some(_)), _) => self.refuse(
                routine.name.at,
                format!("{} is no function, but returns a value", routine.name.text),
            ),
            (Flow::Goto(label), _) => self.refuse(label.at, format!("there is no label {} here", label.text)),
            (Flow::Exit, _) => {
                self.motion.is_over = true;
                Ok(None)
            }
        }
    }

    /// Gives a name a meaning in the innermost routine.
    pub fn bind(&mut self, name: &'a Name, binding: Binding) -> Run<()> {
        let before = match self.frames.last_mut() {
            Some(frame) => frame.names.insert(Rc::clone(&name.key), binding),
            None => None,
        };
        match before {
            Some(_) => self.refuse(
                name.at,
                format!("the name {} is declared twice in the routine", name.text),
            ),
            None => Ok(()),
        }
    }

    /// What the names of a routine's parameters stand for in a call.
    fn bound(
        &mut self,
        name: &'a Name,
        routine: &'a Routine,
        arguments: &'a [Argument],
    ) -> Run<HashMap<Rc<str>, Binding>> {
        let mut names = HashMap::new();
        // Each argument is looked for among the parameters.
        let looked_at = routine.parameters.len().saturating_mul(arguments.len() + 1);
        self.count(name.at, looked_at)?;
        let mut required = routine
            .parameters
            .iter()
            .filter(|parameter| parameter.presence == Presence::Required);
        for argument in arguments {
            let (parameter, binding) = match argument {
                Argument::Required(value) => {
                    let Some(parameter) = required.next() else {
                        return self.refuse(value.at, format!("{} takes no more arguments", name.text));
                    };
                    (parameter, self.passed(parameter, value)?)
                }
                Argument::Optional(option, value) => {
                    let parameter = self.option_of(routine, option)?;
                    let binding = match (parameter.presence, value) {
                        (Presence::Switch, None) => Binding::Given,
                        (Presence::Optional, Some(value)) => self.passed(parameter, value)?,
                        _ => {
                            return self.refuse(
                                option.at,
                                format!("\\{} is given with a value or without, wrongly", option.text),
                            );
                        }
                    };
                    (parameter, binding)
                }
                Argument::Passed(option, from) => {
                    let parameter = self.option_of(routine, option)?;
                    (parameter, self.handed_on(parameter, from)?)
                }
            };
            if names.insert(Rc::clone(&parameter.name.key), binding).is_some() {
                return self.refuse(name.at, format!("the parameter {} is given twice", parameter.name.text));
            }
        }
        for parameter in &routine.parameters {
            if names.contains_key(&parameter.name.key) {
                continue;
            }
            if parameter.presence == Presence::Required {
                let (text, of) = (&parameter.name.text, &name.text);
                return self.refuse(
                    name.at,
                    format!("expected an argument for the parameter {text} of {of}, found none"),
                );
            }
            names.insert(Rc::clone(&parameter.name.key), Binding::Absent);
        }
        Ok(names)
    }

    fn option_of(&self, routine: &'a Routine, option: &Name) -> Run<&'a Parameter> {
        let mut options = routine
            .parameters
            .iter()
            .filter(|parameter| parameter.presence != Presence::Required);
        match options.find(|parameter| parameter.name.key == option.key) {
            Some(parameter) => Ok(parameter),
            None => {
                let text = &routine.name.text;
                self.refuse(option.at, format!("{text} has no option \\{}", option.text))
            }
        }
    }

    /// What an optional argument that is handed on with `?` stands for: as any other argument, or as absent as it is.
    fn handed_on(&mut self, parameter: &'a Parameter, from: &'a Name) -> Run<Binding> {
        let part = match self.binding(&from.key) {
            Some(Binding::Data(part)) => part,
            Some(other) => return Ok(other),
            None => return self.refuse(from.at, format!("the name {} is not declared", from.text)),
        };
        let default = self.default_of(&parameter.type_name)?;
        self.make_ready(part.slot)?;
        let Some(given) = self.value(&part).cloned() else {
            return self.refuse(from.at, "expected data with a value");
        };
        self.count(from.at, given.size())?;
        let fitted = self.fitted_array(from.at, &default, given, parameter.dims)?;
        if parameter.passing == Passing::In {
            let slot = self.keep(fitted, Storage::Var);
            return Ok(Binding::Data(Part::whole(slot)));
        }
        Ok(Binding::Data(part))
    }

    fn passed(&mut self, parameter: &'a Parameter, value: &'a Expression) -> Run<Binding> {
        let default = self.default_of(&parameter.type_name)?;
        if parameter.passing == Passing::In {
            let given = self.evaluate(value)?;
            let fitted = self.fitted_array(value.at, &default, given, parameter.dims)?;
            let slot = self.keep(fitted, Storage::Var);
            return Ok(Binding::Data(Part::whole(slot)));
        }
        let part = match &value.kind {
            ExpressionKind::Read(designator) => self.part_of(designator)?,
            _ => None,
        };
        let Some(part) = part else {
            return self.refuse(
                value.at,
                format!("expected data for the parameter {}, found a value", parameter.name.text),
            );
        };
        let Some(given) = self.value(&part).cloned() else {
            return self.refuse(value.at, "expected data with a value");
        };
        self.count(value.at, given.size())?;
        self.fitted_array(value.at, &default, given, parameter.dims)?;
        Ok(Binding::Data(part))
    }

    /// A value, or an array of such, for a parameter with so many indices.
    fn fitted_array(&self, at: At, default: &Value, given: Value, dims: usize) -> Run<Value> {
        if dims == 0 {
            return self.fitted(at, default, given);
        }
        match given {
            Value::Array(elements) | Value::List(elements) => {
                let fitted = elements
                    .into_iter()
                    .map(|element| self.fitted_array(at, default, element, dims - 1));
                Ok(Value::Array(fitted.collect::<Run<_>>()?))
            }
            other => self.refuse(at, format!("expected an array, found {}", other.kind())),
        }
    }
}
