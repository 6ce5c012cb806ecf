//! The list of all dialects.

use crate::csv::Csv;
use crate::dialect::language::Dialect;
use crate::rapid::Rapid;
use crate::ros2::Ros2;
use crate::urscript::UrScript;

/// All dialects.
pub static DIALECTS: [&dyn Dialect; 4] = [&Rapid, &Ros2, &UrScript, &Csv];

/// The dialect of that name.
#[must_use]
pub fn by_name(name: &str) -> Option<&'static dyn Dialect> {
    DIALECTS.into_iter().find(|dialect| dialect.name() == name)
}

/// The names of all dialects, with commas between.
#[must_use]
pub fn names() -> String {
    DIALECTS.map(Dialect::name).join(", ")
}
