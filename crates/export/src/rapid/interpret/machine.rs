//! The state of a program that is run, and the bounds that keep it finite.

use super::built_in::is_taken;
use super::moved::Motion;
use super::predefined::predefined;
use super::program::{Source, nothing};
use super::store::{Content, Frame, Slot};
use super::types::Types;
use crate::dialect::ReadError;
use crate::rapid::syntax::At;
use crate::rapid::syntax::ast::{Data, Name, Routine, Scope};
use platewash_kinematics::JointVector;
use std::collections::HashMap;
use std::rc::Rc;

/// Steps after which a program is given up: statements, operations, single values that are copied.
pub const MOST_STEPS: u64 = 10_000_000;
/// How deep calls, blocks and expressions may be within each other while a program runs.
pub const MOST_DEPTH: usize = 256;

/// What comes of a step.
pub type Run<T> = Result<T, ReadError>;

/// The state of a program that is run.
#[derive(Debug)]
pub struct Machine<'a> {
    /// Its modules.
    pub sources: &'a [Source],
    /// Its types.
    pub types: Types,
    /// All data.
    pub slots: Vec<Slot<'a>>,
    /// Data that all modules see.
    pub globals: HashMap<Rc<str>, usize>,
    /// Data that only their module sees, by its index.
    pub locals: Vec<HashMap<Rc<str>, usize>>,
    /// Routines that all modules see, with the index of their module.
    pub routines: HashMap<Rc<str>, (usize, &'a Routine)>,
    /// Routines that only their module sees, by its index.
    pub local_routines: Vec<HashMap<Rc<str>, &'a Routine>>,
    /// Routines that are being run; the last one is the innermost.
    pub frames: Vec<Frame>,
    /// What was moved so far.
    pub motion: Motion,
    /// What was written for the operator so far.
    pub messages: Vec<Rc<str>>,
    /// Where the arm is assumed to stand before the first motion \[rad\], if it can be said.
    pub start_rad: Option<JointVector>,
    /// How far from there it stands \[rad\].
    pub away_rad: JointVector,
    /// Where the main procedure is, with the index of its module.
    pub main_at: Option<(usize, At)>,
    /// Whether the program has asked where the arm stands.
    pub start_asked: bool,
    steps: u64,
    depth: usize,
}

impl<'a> Machine<'a> {
    /// Before its first step.
    pub fn new(sources: &'a [Source]) -> Run<Self> {
        let mut machine = Self {
            sources,
            types: Types::of(sources)?,
            slots: Vec::new(),
            globals: HashMap::new(),
            locals: vec![HashMap::new(); sources.len()],
            routines: HashMap::new(),
            local_routines: vec![HashMap::new(); sources.len()],
            frames: Vec::new(),
            motion: Motion::default(),
            messages: Vec::new(),
            start_rad: None,
            away_rad: JointVector::zeros(),
            main_at: None,
            start_asked: false,
            steps: 0,
            depth: 0,
        };
        let mut names = HashMap::new();
        for (index, source) in sources.iter().enumerate() {
            if names.insert(Rc::clone(&source.module.name.key), index).is_some() {
                let name = &source.module.name;
                return Err(source.refused(name.at, format!("there are two modules of the name {}", name.text)));
            }
            for data in &source.module.data {
                machine.declare(index, data)?;
            }
            for routine in &source.module.routines {
                machine.declare_routine(index, routine)?;
            }
        }
        Ok(machine)
    }

    fn declare(&mut self, module: usize, data: &'a Data) -> Run<()> {
        if predefined(&data.name.key).is_some() {
            let name = &data.name;
            return self.refuse_in(
                module,
                name.at,
                format!("the name {} is the controller's own", name.text),
            );
        }
        let slot = self.slots.len();
        self.slots.push(Slot {
            content: Content::Declared(data, module),
            storage: data.storage,
            declared: Some((module, data.name.at)),
        });
        let names = match data.scope {
            Scope::Local => self.locals.get_mut(module),
            Scope::Global | Scope::Task => Some(&mut self.globals),
        };
        match names.and_then(|names| names.insert(Rc::clone(&data.name.key), slot)) {
            Some(_) => self.declared_twice(module, &data.name),
            None => Ok(()),
        }
    }

    fn declare_routine(&mut self, module: usize, routine: &'a Routine) -> Run<()> {
        let key = Rc::clone(&routine.name.key);
        if is_taken(&key) {
            let name = &routine.name;
            return self.refuse_in(
                module,
                name.at,
                format!("the name {} is the controller's own", name.text),
            );
        }
        let is_data = match routine.scope {
            Scope::Local => self.locals.get(module).is_some_and(|names| names.contains_key(&key)),
            Scope::Global | Scope::Task => self.globals.contains_key(&key),
        };
        let is_known = match routine.scope {
            Scope::Local => {
                let names = self.local_routines.get_mut(module);
                names.is_some_and(|names| names.insert(key, routine).is_some())
            }
            Scope::Global | Scope::Task => self.routines.insert(key, (module, routine)).is_some(),
        };
        if is_data || is_known {
            return self.declared_twice(module, &routine.name);
        }
        Ok(())
    }

    fn declared_twice<T>(&self, module: usize, name: &Name) -> Run<T> {
        self.refuse_in(module, name.at, format!("the name {} is declared twice", name.text))
    }

    /// The index of the module that is being run.
    pub fn module(&self) -> usize {
        self.frames.last().map_or(0, |frame| frame.module)
    }

    /// Refuses a line of the module that is being run.
    pub fn refuse<T>(&self, at: At, reason: impl Into<String>) -> Run<T> {
        self.refuse_in(self.module(), at, reason)
    }

    /// Refuses a line of a module.
    pub fn refuse_in<T>(&self, module: usize, at: At, reason: impl Into<String>) -> Run<T> {
        let reason = reason.into();
        match self.sources.get(module).or(self.sources.first()) {
            Some(source) => Err(source.refused(at, reason)),
            None => Err(nothing(reason)),
        }
    }

    /// Counts steps.
    pub fn count(&mut self, at: At, steps: usize) -> Run<()> {
        self.steps = self.steps.saturating_add(u64::try_from(steps).unwrap_or(u64::MAX));
        if self.steps > MOST_STEPS {
            return self.refuse(at, format!("the program has not ended after {MOST_STEPS} steps"));
        }
        Ok(())
    }

    /// Does something one level deeper.
    pub fn deeper<T>(&mut self, at: At, rule: impl FnOnce(&mut Self) -> Run<T>) -> Run<T> {
        if self.depth >= MOST_DEPTH {
            return self.refuse(
                at,
                format!("calls, blocks and expressions are more than {MOST_DEPTH} deep within each other"),
            );
        }
        self.depth += 1;
        let done = rule(self);
        self.depth -= 1;
        done
    }

    /// The routine of a name, as the module that is being run sees it.
    pub fn routine(&self, module: usize, key: &str) -> Option<(usize, &'a Routine)> {
        let own = self.local_routines.get(module).and_then(|names| names.get(key));
        own.map(|routine| (module, *routine))
            .or_else(|| self.routines.get(key).copied())
    }
}
