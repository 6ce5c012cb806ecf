//! Arguments of the controller's own instructions and functions, found by place and name.

use super::machine::{Machine, Run};
use crate::rapid::syntax::At;
use crate::rapid::syntax::ast::{Argument, Expression, Name};

/// What an instruction or function takes.
#[derive(Debug, Clone, Copy)]
pub struct Signature {
    /// Its name, for messages.
    pub name: &'static str,
    /// How many arguments it must have.
    pub required: usize,
    /// Its options, in small letters, each with how many of the others stand before it.
    pub options: &'static [(&'static str, usize)],
}

/// Arguments as an instruction takes them.
#[derive(Debug)]
pub struct Taken<'a> {
    /// Those that must be there.
    pub required: Vec<&'a Expression>,
    /// Options that are there, with their values.
    options: Vec<(&'a Name, Option<&'a Expression>)>,
}

impl<'a> Taken<'a> {
    /// An option that is there.
    #[must_use]
    pub fn option(&self, key: &str) -> Option<(At, Option<&'a Expression>)> {
        let found = self.options.iter().find(|(name, _)| &*name.key == key);
        found.map(|(name, value)| (name.at, *value))
    }
}

impl<'a> Machine<'a> {
    /// Arguments as an instruction takes them.
    pub fn taken(&self, at: At, signature: &Signature, arguments: &'a [Argument]) -> Run<Taken<'a>> {
        let Signature {
            name: what,
            required: most,
            ..
        } = *signature;
        let mut required = Vec::new();
        let mut options: Vec<(&Name, Option<&Expression>)> = Vec::new();
        for argument in arguments {
            let (name, value) = match argument {
                Argument::Required(value) => {
                    required.push(value);
                    continue;
                }
                Argument::Optional(name, value) => (name, value.as_ref()),
                Argument::Passed(name, _) => {
                    return self.refuse(name.at, format!("\\{} handed on with `?` is not modelled", name.text));
                }
            };
            let known = signature.options.iter().find(|(option, _)| *option == &*name.key);
            let Some((_, before)) = known else {
                return self.refuse(
                    name.at,
                    format!("{what} has no option \\{} that is modelled", name.text),
                );
            };
            if required.len() != *before {
                let (text, found) = (&name.text, required.len());
                return self.refuse(
                    name.at,
                    format!("expected \\{text} after {before} arguments of {what}, found it after {found}"),
                );
            }
            if options.iter().any(|(other, _)| other.key == name.key) {
                return self.refuse(name.at, format!("\\{} is there twice", name.text));
            }
            options.push((name, value));
        }
        if required.len() != most {
            let found = required.len();
            return self.refuse(at, format!("expected {most} arguments of {what}, found {found}"));
        }
        Ok(Taken { required, options })
    }
}
