//! Types by name, each as the value that its data have by default.

use super::program::Source;
use super::value::{RecordType, Value};
use crate::dialect::ReadError;
use crate::rapid::syntax::ast::TypeKind;
use std::collections::HashMap;
use std::rc::Rc;

/// Most types of a program.
const MOST_TYPES: usize = 1000;
/// Largest record, in single values.
const MOST_VALUES: usize = 1000;

/// Records of the controller: components, and the types that follow each other in them.
pub const RECORDS: [(&str, &[(&str, &str)]); 13] = [
    ("pos", &[("x", "num"), ("y", "num"), ("z", "num")]),
    ("orient", &[("q1", "num"), ("q2", "num"), ("q3", "num"), ("q4", "num")]),
    ("pose", &[("trans", "pos"), ("rot", "orient")]),
    (
        "confdata",
        &[("cf1", "num"), ("cf4", "num"), ("cf6", "num"), ("cfx", "num")],
    ),
    (
        "robjoint",
        &[
            ("rax_1", "num"),
            ("rax_2", "num"),
            ("rax_3", "num"),
            ("rax_4", "num"),
            ("rax_5", "num"),
            ("rax_6", "num"),
        ],
    ),
    (
        "extjoint",
        &[
            ("eax_a", "num"),
            ("eax_b", "num"),
            ("eax_c", "num"),
            ("eax_d", "num"),
            ("eax_e", "num"),
            ("eax_f", "num"),
        ],
    ),
    ("jointtarget", &[("robax", "robjoint"), ("extax", "extjoint")]),
    (
        "robtarget",
        &[
            ("trans", "pos"),
            ("rot", "orient"),
            ("robconf", "confdata"),
            ("extax", "extjoint"),
        ],
    ),
    (
        "loaddata",
        &[
            ("mass", "num"),
            ("cog", "pos"),
            ("aom", "orient"),
            ("ix", "num"),
            ("iy", "num"),
            ("iz", "num"),
        ],
    ),
    (
        "tooldata",
        &[("robhold", "bool"), ("tframe", "pose"), ("tload", "loaddata")],
    ),
    (
        "wobjdata",
        &[
            ("robhold", "bool"),
            ("ufprog", "bool"),
            ("ufmec", "string"),
            ("uframe", "pose"),
            ("oframe", "pose"),
        ],
    ),
    (
        "speeddata",
        &[("v_tcp", "num"), ("v_ori", "num"), ("v_leax", "num"), ("v_reax", "num")],
    ),
    (
        "zonedata",
        &[
            ("finep", "bool"),
            ("pzone_tcp", "num"),
            ("pzone_ori", "num"),
            ("pzone_eax", "num"),
            ("zone_ori", "num"),
            ("zone_leax", "num"),
            ("zone_reax", "num"),
        ],
    ),
];

/// Types by name.
#[derive(Debug)]
pub struct Types {
    known: HashMap<Rc<str>, Value>,
}

impl Types {
    /// Those of the controller and of a program. One that is made of what is not modelled is left out.
    pub fn of(sources: &[Source]) -> Result<Self, ReadError> {
        let mut types = Self::predefined();
        let mut waiting = Vec::new();
        let mut lines: HashMap<Rc<str>, usize> = HashMap::new();
        for source in sources {
            for definition in &source.module.types {
                let name = &definition.name;
                let before = lines.insert(Rc::clone(&name.key), name.at.line);
                if before.is_some() || types.known.contains_key(&name.key) {
                    return Err(source.refused(name.at, format!("the type {} is declared twice", name.text)));
                }
                if waiting.len() >= MOST_TYPES {
                    return Err(source.refused(name.at, format!("expected at most {MOST_TYPES} types, found more")));
                }
                waiting.push(definition);
            }
        }
        // In whatever order they are declared: again and again, until nothing is found any more.
        loop {
            let before = waiting.len();
            waiting.retain(
                |definition| match types.defined(&definition.name.text, &definition.kind) {
                    Some(value) => {
                        types.known.insert(Rc::clone(&definition.name.key), value);
                        false
                    }
                    None => true,
                },
            );
            if waiting.len() == before {
                return Ok(types);
            }
        }
    }

    /// What data of a type are by default; `None` where the type is not modelled.
    pub fn default_of(&self, key: &str) -> Option<&Value> {
        self.known.get(key)
    }

    fn predefined() -> Self {
        let mut types = Self { known: HashMap::new() };
        let zero = Value::Num(0.0);
        let simple = [
            ("num", zero.clone()),
            ("byte", zero.clone()),
            ("errnum", zero),
            ("bool", Value::Truth(false)),
            ("string", Value::Text(Rc::from(""))),
        ];
        for (name, value) in simple {
            types.known.insert(Rc::from(name), value);
        }
        for (name, components) in RECORDS {
            let components = components.iter().filter_map(|(component, of)| {
                let value = types.known.get(*of)?.clone();
                Some((Rc::from(*component), value))
            });
            let record = record(name, components.collect());
            types.known.insert(Rc::from(name), record);
        }
        types
    }

    fn defined(&self, name: &str, kind: &TypeKind) -> Option<Value> {
        match kind {
            TypeKind::Alias(of) => self.known.get(&of.key).cloned(),
            TypeKind::Record(components) => {
                let mut found = Vec::new();
                let mut size = 0;
                for (component, of) in components {
                    let value = self.known.get(&of.key)?;
                    size += value.size();
                    if size > MOST_VALUES {
                        return None;
                    }
                    found.push((Rc::clone(&component.key), value.clone()));
                }
                Some(record(name, found))
            }
        }
    }
}

fn record(name: &str, components: Vec<(Rc<str>, Value)>) -> Value {
    let values = components.iter().map(|(_, value)| value.clone()).collect();
    let name = Rc::from(name);
    Value::Record(Rc::new(RecordType { name, components }), values)
}
