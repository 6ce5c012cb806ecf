//! Declarations of data.

use super::ast::{Data, Scope, Storage};
use super::cursor::Cursor;
use super::error::SyntaxError;

const STORAGES: [(&str, Storage); 3] = [
    ("CONST", Storage::Const),
    ("VAR", Storage::Var),
    ("PERS", Storage::Pers),
];

impl Cursor<'_> {
    /// Whether data are declared next.
    pub fn is_data(&self) -> bool {
        STORAGES.into_iter().any(|(word, _)| self.is(word))
    }

    /// A declaration of data, after its scope.
    pub fn data(&mut self, scope: Scope) -> Result<Data, SyntaxError> {
        let Some(storage) = self.eat_one(&STORAGES) else {
            return Err(self.unexpected("`CONST`, `VAR` or `PERS`"));
        };
        let type_name = self.name("the name of a type")?;
        let name = self.name("a name for the data")?;
        let dims = if self.eat("{") {
            self.expressions("}")?
        } else {
            Vec::new()
        };
        let value = if self.eat(":=") { Some(self.expression()?) } else { None };
        if value.is_none() && storage == Storage::Const {
            return Err(self.unexpected("`:=` and the constant's value"));
        }
        if !self.eat(";") {
            let rest = if value.is_some() { "`;`" } else { "`:=` or `;`" };
            return Err(self.unexpected(rest));
        }
        Ok(Data {
            scope,
            storage,
            type_name,
            name,
            dims,
            value,
        })
    }
}
