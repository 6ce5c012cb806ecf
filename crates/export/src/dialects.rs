//! All dialects. Another one is a line here, beside its file and its fixture.

use crate::csv::Csv;
use crate::dialect::Dialect;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::ProgramFile;

    #[test]
    fn a_name_or_a_file_is_of_one_dialect() {
        for dialect in DIALECTS {
            let found = by_name(dialect.name()).map(Dialect::name);
            assert_eq!(found, Some(dialect.name()));
            assert!(!dialect.assumptions().is_empty(), "{dialect:?}");
        }
        assert!(by_name("krl").is_none());
        let text = "t_s,q1_rad".to_owned();
        for name in ["a.script", "a.csv"] {
            let file = ProgramFile {
                name: name.to_owned(),
                text: text.clone(),
            };
            assert_eq!(
                DIALECTS.iter().filter(|dialect| dialect.is_in(&file)).count(),
                1,
                "{name}"
            );
        }
    }
}
