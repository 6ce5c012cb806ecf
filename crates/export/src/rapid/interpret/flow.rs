//! What is done after a statement.

use super::value::Value;
use crate::rapid::syntax::ast::Name;

/// What is done after a statement.
#[derive(Debug)]
pub enum Flow<'a> {
    /// The next one.
    On,
    /// The routine is left.
    Return(Option<Value>),
    /// On after a label.
    Goto(&'a Name),
    /// The program is over.
    Exit,
}
