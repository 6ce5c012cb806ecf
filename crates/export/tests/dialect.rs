//! The list of all dialects.

use platewash_export::dialect::Dialect;
use platewash_export::dialects::{DIALECTS, by_name};
use platewash_export::program::ProgramFile;

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
