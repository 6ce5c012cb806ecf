//! Every scenario key has a unit, a range and a meaning, as the fields of the sections state them.
//!
//! | concept | module |
//! | --- | --- |
//! | a key; the table of all keys and lists; those that a section states | `key`; `table`; `stated` |
//! | a value that fits its key; lists of sections; words for values | `fits`; `listed`; `value` |
//! | a key that does not exist, and a word like it | `unknown`, `likeness` |
//! | lines of a text; values as TOML | `line`; `toml_text` |
//! | the reference page; the form on the live page | `document`; `form` |

pub(crate) mod document;
pub(crate) mod fits;
pub(crate) mod form;
pub(crate) mod key;
pub(crate) mod likeness;
pub(crate) mod line;
pub(crate) mod listed;
pub(crate) mod stated;
pub(crate) mod table;
pub(crate) mod toml_text;
pub(crate) mod unknown;
pub(crate) mod value;

pub use crate::keys::key::{Domain, Key};
pub use crate::keys::table::{KEYS, LISTS, List};
