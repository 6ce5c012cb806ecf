//! Data by their names: found, made when they are first needed, read and changed.

use super::machine::{Machine, Run};
use super::store::{Binding, Content, Frame, Part, Slot, part, part_mut};
use super::value::{Value, component_index};
use crate::rapid::syntax::At;
use crate::rapid::syntax::ast::{Access, Data, Designator, Expression, ExpressionKind, Name, Storage};

/// Most elements of an array.
const MOST_ELEMENTS: usize = 100_000;

impl<'a> Machine<'a> {
    /// What a name stands for; `None` where it is not declared.
    pub fn binding(&self, key: &str) -> Option<Binding> {
        let in_routine = self.frames.last().and_then(|frame| frame.names.get(key));
        if let Some(binding) = in_routine {
            return Some(binding.clone());
        }
        let in_module = self.locals.get(self.module()).and_then(|names| names.get(key));
        let slot = in_module.or_else(|| self.globals.get(key))?;
        Some(Binding::Data(Part::whole(*slot)))
    }

    /// The data that a designator is, or a part of them; `None` where the name is not declared.
    pub fn part_of(&mut self, designator: &'a Designator) -> Run<Option<Part>> {
        let name = &designator.name;
        let mut found = match self.binding(&name.key) {
            Some(Binding::Data(part)) => part,
            Some(Binding::Absent) => {
                return self.refuse(name.at, format!("the optional parameter {} was not given", name.text));
            }
            Some(Binding::Given) => return self.refuse(name.at, format!("the switch {} has no value", name.text)),
            None => return Ok(None),
        };
        self.make_ready(found.slot)?;
        for access in &designator.path {
            self.follow(&mut found, access)?;
        }
        Ok(Some(found))
    }

    fn follow(&mut self, found: &mut Part, access: &'a Access) -> Run<()> {
        match access {
            Access::Component(component) => {
                let value = self.value(found);
                let index = value.and_then(|value| component_index(value, &component.key));
                let Some(index) = index else {
                    let kind = value.map_or_else(String::new, Value::kind);
                    return self.refuse(component.at, format!("{kind} has no component {}", component.text));
                };
                found.path.push(index);
            }
            Access::Index(indices) => {
                for expression in indices {
                    let index = self.number(expression)?;
                    let count = match self.value(found) {
                        Some(Value::Array(elements)) => elements.len(),
                        Some(other) => {
                            let kind = other.kind();
                            return self.refuse(expression.at, format!("expected an array before `{{`, found {kind}"));
                        }
                        None => 0,
                    };
                    found.path.push(self.index(expression.at, index, count)?);
                }
            }
        }
        Ok(())
    }

    /// An index from 0 for one from 1.
    fn index(&self, at: At, index: f32, count: usize) -> Run<usize> {
        let is_whole = index.fract() == 0.0 && index >= 1.0;
        // Exact: arrays are smaller than 2²⁴.
        if !is_whole || index as usize > count {
            return self.refuse(at, format!("expected an index from 1 to {count}, found {index}"));
        }
        Ok(index as usize - 1)
    }

    /// A value that is kept.
    pub fn value(&self, at: &Part) -> Option<&Value> {
        match &self.slots.get(at.slot)?.content {
            Content::Ready(value) => part(value, &at.path),
            Content::Declared(..) | Content::Busy => None,
        }
    }

    /// Puts a value where one of the same type is.
    pub fn assign(&mut self, line: At, to: &Part, value: Value) -> Run<()> {
        self.count(line, value.size())?;
        let Some(slot) = self.slots.get_mut(to.slot) else {
            return Ok(());
        };
        if slot.storage == Storage::Const {
            return self.refuse(line, "expected a variable or a persistent, found a constant");
        }
        if slot.storage == Storage::Pers {
            return self.refuse(
                line,
                "a persistent keeps what it is given for the next run, which is not judged: expected a variable (VAR)",
            );
        }
        let Content::Ready(kept) = &mut slot.content else {
            return Ok(());
        };
        let Some(target) = part_mut(kept, &to.path) else {
            return Ok(());
        };
        match target.replaced_by(value) {
            Ok(value) => *target = value,
            Err(misfit) => return self.refuse(line, misfit.to_string()),
        }
        Ok(())
    }

    /// Where data of a module are declared that an expression is, with the index of the module.
    pub fn declared(&self, expression: &Expression) -> Option<(usize, At)> {
        let ExpressionKind::Read(designator) = &expression.kind else {
            return None;
        };
        match self.binding(&designator.name.key) {
            Some(Binding::Data(part)) => self.slots.get(part.slot)?.declared,
            _ => None,
        }
    }

    /// Keeps a value.
    pub fn keep(&mut self, value: Value, storage: Storage) -> usize {
        self.slots.push(Slot {
            content: Content::Ready(value),
            storage,
            declared: None,
        });
        self.slots.len() - 1
    }

    /// Works out what declared data begin with, if that has not been needed yet.
    pub fn make_ready(&mut self, slot: usize) -> Run<()> {
        let Some(kept) = self.slots.get_mut(slot) else {
            return Ok(());
        };
        let (data, module) = match &kept.content {
            Content::Ready(_) | Content::Busy => return Ok(()),
            Content::Declared(data, module) => (*data, *module),
        };
        kept.content = Content::Busy;
        // Values of a module's data see its names, not those of the routine that needs them first.
        self.frames.push(Frame {
            module,
            ..Frame::default()
        });
        let value = self.deeper(data.name.at, |this| this.first_value(data));
        self.frames.pop();
        if let Some(kept) = self.slots.get_mut(slot) {
            kept.content = Content::Ready(value?);
        }
        Ok(())
    }

    /// What data begin with.
    pub fn first_value(&mut self, data: &'a Data) -> Run<Value> {
        let name = &data.name;
        let mut default = self.default_of(&data.type_name)?;
        let mut dims = Vec::new();
        for expression in &data.dims {
            let size = self.number(expression)?;
            dims.push(self.index(expression.at, size, MOST_ELEMENTS)? + 1);
        }
        let in_all = dims
            .iter()
            .fold(default.size(), |product, size| product.saturating_mul(*size));
        if in_all > MOST_ELEMENTS {
            let text = &name.text;
            return self.refuse(
                name.at,
                format!("expected at most {MOST_ELEMENTS} values in {text}, found {in_all}"),
            );
        }
        for size in dims.iter().rev() {
            default = Value::Array(vec![default; *size]);
        }
        self.count(name.at, default.size())?;
        match &data.value {
            Some(expression) => {
                let value = self.evaluate(expression)?;
                self.fitted(expression.at, &default, value)
            }
            None if data.storage == Storage::Pers => {
                let text = &name.text;
                self.refuse(
                    name.at,
                    format!("the persistent {text} has no value here: another task or module has it"),
                )
            }
            None => Ok(default),
        }
    }

    /// What data of a type are by default.
    pub fn default_of(&self, type_name: &Name) -> Run<Value> {
        match self.types.default_of(&type_name.key) {
            Some(value) => Ok(value.clone()),
            None => self.refuse(
                type_name.at,
                format!("data of the type {} are not modelled", type_name.text),
            ),
        }
    }

    /// A value where one like that goes.
    pub fn fitted(&self, at: At, like: &Value, value: Value) -> Run<Value> {
        match like.replaced_by(value) {
            Ok(value) => Ok(value),
            Err(misfit) => self.refuse(at, misfit.to_string()),
        }
    }
}
