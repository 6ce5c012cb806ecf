//! Variables, and what expressions come to with them.

use super::controller::{Given, not_modelled};
use super::fault::Fault;
use super::tree::{Call, Expression, Scope};
use super::value::{Value, binary};
use platewash_kinematics::JointVector;
use platewash_workcell::words::quoted;
use std::collections::BTreeMap;

/// Variables of a function, each with the line that set it.
pub(super) type Function = BTreeMap<String, (Value, usize)>;

/// All variables.
#[derive(Debug)]
pub(super) struct Variables {
    /// What the arm measures; `None` where it is not asked.
    measured: Option<JointVector>,
    globals: Function,
    /// Variables of the functions that run, the innermost last; those of the program first.
    locals: Vec<Function>,
}

impl Variables {
    pub(super) fn new(measured: Option<JointVector>) -> Self {
        Self {
            measured,
            globals: Function::new(),
            locals: vec![Function::new()],
        }
    }

    /// How many functions run, the program among them.
    pub(super) fn depth(&self) -> usize {
        self.locals.len()
    }

    /// A function begins with these.
    pub(super) fn enter(&mut self, function: Function) {
        self.locals.push(function);
    }

    /// A function is over.
    pub(super) fn leave(&mut self) {
        self.locals.pop();
    }

    /// A variable of the whole program, with the line that set it.
    pub(super) fn of_program(&self, name: &str) -> Option<&(Value, usize)> {
        let mut variables = self.locals.first().into_iter().chain([&self.globals]);
        variables.find_map(|variables| variables.get(name))
    }

    pub(super) fn assign(&mut self, scope: Scope, name: &str, value: Value, line: usize) -> Result<(), Fault> {
        let is_outer = |variables: &Function| variables.contains_key(name);
        let outer = self
            .locals
            .split_last()
            .is_some_and(|(_, outer)| outer.iter().any(is_outer));
        let is_global = self.globals.contains_key(name);
        let is_local = self.locals.last().is_some_and(is_outer);
        let target = match scope {
            Scope::Global => &mut self.globals,
            Scope::Unsaid if is_global && !is_local => &mut self.globals,
            Scope::Unsaid if outer && !is_local => {
                let reason = format!(
                    "{} is a variable outside, too: expected \"local\" or \"global\" before it",
                    quoted(name)
                );
                return Err(Fault::new(reason));
            }
            _ => match self.locals.last_mut() {
                Some(variables) => variables,
                None => &mut self.globals,
            },
        };
        target.insert(name.to_owned(), (value, line));
        Ok(())
    }

    /// The values of parameters, `None` for those that are not given.
    pub(super) fn arguments(&self, call: &Call, parameters: &[&str]) -> Result<Given, Fault> {
        let mut given: Given = vec![None; parameters.len()];
        let mut behind_named = false;
        for (k, (name, value)) in call.arguments.iter().enumerate() {
            behind_named |= name.is_some();
            let at = match name {
                None if behind_named => {
                    return Err(Fault::new("an argument without a name behind one that has a name"));
                }
                None => k,
                Some(name) => match parameters.iter().position(|parameter| parameter == name) {
                    Some(at) => at,
                    None => {
                        return Err(Fault::new(format!(
                            "{} has no argument {}",
                            quoted(&call.name),
                            quoted(name)
                        )));
                    }
                },
            };
            match given.get_mut(at) {
                None => {
                    let most = parameters.len();
                    return Err(Fault::new(format!(
                        "{} takes {most} arguments at most",
                        quoted(&call.name)
                    )));
                }
                Some(Some(_)) => return Err(Fault::new(format!("argument {} is given twice", at + 1))),
                Some(place) => *place = Some(self.value(value)?),
            }
        }
        Ok(given)
    }

    /// The value of an expression.
    pub(super) fn value(&self, expression: &Expression) -> Result<Value, Fault> {
        match expression {
            Expression::Number(number) => Ok(Value::Number(*number)),
            Expression::Bool(is) => Ok(Value::Bool(*is)),
            Expression::Text(text) => Ok(Value::Text(text.clone())),
            Expression::Name(name) => self.variable(name),
            Expression::List(entries) => Ok(self.numbers(entries)?.map_or(Value::Unknown, Value::List)),
            Expression::Pose(entries) => match self.numbers(entries)? {
                None => Ok(Value::Unknown),
                Some(numbers) => <[f64; 6]>::try_from(numbers.as_slice())
                    .map(Value::Pose)
                    .map_err(|_| Fault::new(format!("expected a pose of 6 numbers, found {}", numbers.len()))),
            },
            Expression::Index(list, index) => self.value(list)?.entry(&self.value(index)?),
            Expression::Negative(inner) => self.value(inner)?.negative(),
            Expression::Not(inner) => self.value(inner)?.not(),
            Expression::Binary(operator, pair) => {
                let [left, right] = [self.value(&pair[0])?, self.value(&pair[1])?];
                binary(*operator, [&left, &right])
            }
            Expression::Call(call) => self.computed(call),
        }
    }

    fn variable(&self, name: &str) -> Result<Value, Fault> {
        let mut variables = self.locals.iter().rev().chain([&self.globals]);
        match variables.find_map(|variables| variables.get(name)) {
            Some((value, _)) => Ok(value.clone()),
            None => Err(Fault::new(format!("no variable {} so far", quoted(name)))),
        }
    }

    /// Numbers of a list; `None` where one is not known.
    fn numbers(&self, entries: &[Expression]) -> Result<Option<Vec<f64>>, Fault> {
        let mut numbers = Vec::with_capacity(entries.len());
        for entry in entries {
            match self.value(entry)? {
                Value::Unknown => return Ok(None),
                value => numbers.push(value.number()?),
            }
        }
        Ok(Some(numbers))
    }

    /// A call within an expression.
    fn computed(&self, call: &Call) -> Result<Value, Fault> {
        match call.name.as_str() {
            "get_actual_joint_positions" => {
                self.arguments(call, &[])?;
                let measured = |q: JointVector| Value::List(q.iter().copied().collect());
                Ok(self.measured.map_or(Value::Unknown, measured))
            }
            name @ ("norm" | "d2r" | "r2d") => match self.arguments(call, &["a"])?.pop().flatten() {
                Some(value) => value.function(name),
                None => Err(Fault::new("expected an argument \"a\"")),
            },
            name => Err(not_modelled(name)),
        }
    }
}
