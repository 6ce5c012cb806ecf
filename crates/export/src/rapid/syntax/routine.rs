//! Routines: parameters, own data, bodies, handlers.

use super::ast::{Handler, HandlerKind, Parameter, Passing, Presence, Routine, RoutineKind, Scope};
use super::cursor::Cursor;
use super::error::SyntaxError;
use super::token::Token;

const PASSINGS: [(&str, Passing); 3] = [
    ("INOUT", Passing::InOut),
    ("VAR", Passing::Var),
    ("PERS", Passing::Pers),
];
const HANDLERS: [(&str, HandlerKind); 3] = [
    ("ERROR", HandlerKind::Error),
    ("UNDO", HandlerKind::Undo),
    ("BACKWARD", HandlerKind::Backward),
];

impl Cursor<'_> {
    /// Whether a routine is declared next.
    pub fn is_routine(&self) -> bool {
        ["PROC", "FUNC", "TRAP"].into_iter().any(|word| self.is(word))
    }

    /// A routine, after its scope.
    pub fn routine(&mut self, scope: Scope) -> Result<Routine, SyntaxError> {
        let (kind, end) = if self.eat("PROC") {
            (RoutineKind::Proc, "ENDPROC")
        } else if self.eat("FUNC") {
            (RoutineKind::Func(self.name("the type of the function")?), "ENDFUNC")
        } else {
            self.need("TRAP")?;
            (RoutineKind::Trap, "ENDTRAP")
        };
        let name = self.name("a name for the routine")?;
        let parameters = match kind {
            RoutineKind::Trap => Vec::new(),
            RoutineKind::Proc | RoutineKind::Func(_) => self.parameters()?,
        };
        let mut data = Vec::new();
        while self.is_data() {
            data.push(self.data(Scope::Local)?);
        }
        let body = self.statements()?;
        let mut handlers = Vec::new();
        while let Some(kind) = self.eat_one(&HANDLERS) {
            let errors = if self.eat("(") {
                self.expressions(")")?
            } else {
                Vec::new()
            };
            let body = self.statements()?;
            handlers.push(Handler { kind, errors, body });
        }
        if !self.eat(end) {
            return Err(self.unexpected(&format!("a statement or `{end}`")));
        }
        Ok(Routine {
            scope,
            kind,
            name,
            parameters,
            data,
            body,
            handlers,
        })
    }

    fn parameters(&mut self) -> Result<Vec<Parameter>, SyntaxError> {
        self.need("(")?;
        let mut found = Vec::new();
        while !self.eat(")") {
            let comma = !found.is_empty() && self.eat(",");
            if self.eat("\\") {
                found.push(self.parameter(Presence::Optional)?);
                // Of those between bars one is given at most.
                while self.eat("|") {
                    found.push(self.parameter(Presence::Optional)?);
                }
            } else if comma || found.is_empty() {
                found.push(self.parameter(Presence::Required)?);
            } else {
                return Err(self.unexpected("`,`, `\\` or `)`"));
            }
        }
        Ok(found)
    }

    fn parameter(&mut self, presence: Presence) -> Result<Parameter, SyntaxError> {
        let passing = self.eat_one(&PASSINGS).unwrap_or(Passing::In);
        let type_name = self.name("the type of a parameter")?;
        let name = self.name("the name of a parameter")?;
        let presence = match presence {
            Presence::Optional if &*type_name.key == "switch" => Presence::Switch,
            other => other,
        };
        let mut dims = 0;
        if self.eat("{") {
            loop {
                self.need("*")?;
                dims += 1;
                if self.eat("}") {
                    break;
                }
                self.need(",")?;
            }
        }
        Ok(Parameter {
            passing,
            presence,
            type_name,
            name,
            dims,
        })
    }

    /// Whether the next token is a name that a label is made of.
    pub fn is_label(&self) -> bool {
        matches!(self.peek(), Token::Name(_)) && *self.ahead(1) == Token::Fixed(":")
    }
}
