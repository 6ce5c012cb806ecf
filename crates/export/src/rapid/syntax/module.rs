//! Modules: attributes, types, data, routines.

use super::ast::{Module, Scope, TypeDefinition, TypeKind};
use super::cursor::Cursor;
use super::error::SyntaxError;
use super::token::Token;

const ATTRIBUTES: [(&str, &str); 5] = [
    ("SYSMODULE", "SYSMODULE"),
    ("NOVIEW", "NOVIEW"),
    ("NOSTEPIN", "NOSTEPIN"),
    ("VIEWONLY", "VIEWONLY"),
    ("READONLY", "READONLY"),
];
const SCOPES: [(&str, Scope); 2] = [("LOCAL", Scope::Local), ("TASK", Scope::Task)];

/// All modules of a text.
///
/// # Errors
/// [`SyntaxError`], the first one.
pub fn parse(text: &str) -> Result<Vec<Module>, SyntaxError> {
    let mut cursor = Cursor::new(text)?;
    let mut modules = vec![cursor.module()?];
    while *cursor.peek() != Token::End {
        modules.push(cursor.module()?);
    }
    Ok(modules)
}

impl Cursor<'_> {
    fn module(&mut self) -> Result<Module, SyntaxError> {
        self.need("MODULE")?;
        let name = self.name("the module's name")?;
        let mut module = Module {
            name,
            attributes: self.attributes()?,
            types: Vec::new(),
            data: Vec::new(),
            routines: Vec::new(),
        };
        while !self.eat("ENDMODULE") {
            let scope = self.eat_one(&SCOPES).unwrap_or(Scope::Global);
            if self.is_data() {
                module.data.push(self.data(scope)?);
            } else if self.is("RECORD") || self.is("ALIAS") {
                module.types.push(self.type_definition(scope)?);
            } else if self.is_routine() {
                module.routines.push(self.routine(scope)?);
            } else {
                return Err(self.unexpected("a declaration of data, a type or a routine, or `ENDMODULE`"));
            }
        }
        Ok(module)
    }

    fn attributes(&mut self) -> Result<Vec<&'static str>, SyntaxError> {
        let mut found = Vec::new();
        if !self.eat("(") {
            return Ok(found);
        }
        loop {
            let attribute = self.eat_one(&ATTRIBUTES);
            found.push(attribute.ok_or_else(|| self.unexpected("an attribute of a module, such as `SYSMODULE`"))?);
            if self.eat(")") {
                return Ok(found);
            }
            self.need(",")?;
        }
    }

    fn type_definition(&mut self, scope: Scope) -> Result<TypeDefinition, SyntaxError> {
        if self.eat("ALIAS") {
            let of = self.name("the name of a type")?;
            let name = self.name("a name for the type")?;
            self.need(";")?;
            let kind = TypeKind::Alias(of);
            return Ok(TypeDefinition { scope, name, kind });
        }
        self.need("RECORD")?;
        let name = self.name("a name for the type")?;
        let mut components = Vec::new();
        while !self.eat("ENDRECORD") {
            let type_name = self.name("the type of a component, or `ENDRECORD`")?;
            components.push((self.name("the name of a component")?, type_name));
            self.need(";")?;
        }
        let kind = TypeKind::Record(components);
        Ok(TypeDefinition { scope, name, kind })
    }
}
