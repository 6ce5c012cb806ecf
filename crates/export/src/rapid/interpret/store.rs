//! Where data are kept while a program runs.

use super::value::Value;
use crate::rapid::syntax::At;
use crate::rapid::syntax::ast::{Data, Storage};
use std::collections::HashMap;
use std::rc::Rc;

/// Data.
#[derive(Debug)]
pub struct Slot<'a> {
    /// What is in it.
    pub content: Content<'a>,
    /// How it is kept.
    pub storage: Storage,
    /// Where it is declared, with the index of the module; `None` where it is a value on its way.
    pub declared: Option<(usize, At)>,
}

/// What is in data.
#[derive(Debug)]
pub enum Content<'a> {
    /// A declaration that was not needed so far, and the index of its module.
    Declared(&'a Data, usize),
    /// A declaration whose value is being worked out.
    Busy,
    /// A value.
    Ready(Value),
}

/// Data or a part of them: the slot, and indices into arrays and records.
#[derive(Debug, Clone)]
pub struct Part {
    /// The slot.
    pub slot: usize,
    /// The way into it.
    pub path: Vec<usize>,
}

/// What a name stands for in a routine.
#[derive(Debug, Clone)]
pub enum Binding {
    /// Data.
    Data(Part),
    /// An optional parameter that was not given.
    Absent,
    /// A switch that was given.
    Given,
}

/// A routine that is being run.
#[derive(Debug, Default)]
pub struct Frame {
    /// The index of its module.
    pub module: usize,
    /// Its names, in small letters.
    pub names: HashMap<Rc<str>, Binding>,
}

impl Part {
    /// Data as a whole.
    #[must_use]
    pub fn whole(slot: usize) -> Self {
        Self { slot, path: Vec::new() }
    }
}

/// The part of a value at the end of a path.
pub fn part<'v>(value: &'v Value, path: &[usize]) -> Option<&'v Value> {
    path.iter().try_fold(value, |value, index| match value {
        Value::Record(_, parts) | Value::Array(parts) | Value::List(parts) => parts.get(*index),
        Value::Num(_) | Value::Truth(_) | Value::Text(_) => None,
    })
}

/// The part of a value at the end of a path, to be changed.
pub fn part_mut<'v>(value: &'v mut Value, path: &[usize]) -> Option<&'v mut Value> {
    path.iter().try_fold(value, |value, index| match value {
        Value::Record(_, parts) | Value::Array(parts) | Value::List(parts) => parts.get_mut(*index),
        Value::Num(_) | Value::Truth(_) | Value::Text(_) => None,
    })
}
