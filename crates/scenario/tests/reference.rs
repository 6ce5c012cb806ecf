//! The page of all keys.

use platewash_scenario::reference;

#[test]
fn the_committed_page_is_current() {
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/scenario.md");
    if std::env::var_os("PLATEWASH_WRITE_DOCS").is_some() {
        std::fs::write(page, reference()).unwrap();
    }
    let committed = std::fs::read_to_string(page).unwrap();
    assert!(
        committed == reference(),
        "docs/scenario.md is out of date: run `cargo xtask docs`"
    );
}
