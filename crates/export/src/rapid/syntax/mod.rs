//! The language: text → tokens → syntax tree.
//!
//! Declarations, procedures, control flow and expressions are read in full, also those that the interpreter then refuses: what is
//! refused is refused by name and line, not as a riddle of the grammar.

pub mod ast;
mod cursor;
mod data;
mod error;
mod expression;
mod keyword;
mod lexer;
mod module;
mod routine;
mod statement;
mod token;

pub use error::SyntaxError;
pub use keyword::is_reserved;
pub use module::parse;
pub use token::At;
