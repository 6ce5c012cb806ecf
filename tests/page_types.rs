//! The types by which the page reads what the program writes: made from the Rust types.

use platewash_editor::{FirstContents, protocol};
use platewash_server::{LiveEnd, SamplesEvent, StateEvent};
use std::collections::BTreeMap;
use ts_rs::{Config, TS, TypeVisitor};

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/crates/viewer/page/src/protocols.ts");

const HEAD: &str = "\
// Types of the documents, questions and answers that the page and the program exchange, made from the Rust types, where they are
// documented. `cargo xtask docs` writes this file.

/** A value of a scenario's key, as TOML has it. */
export type Value = string | number | boolean | readonly Value[] | Readonly<{ [name: string]: number }>;
";

/// Declarations by name.
struct Declarations {
    config: Config,
    found: BTreeMap<String, String>,
}

impl TypeVisitor for Declarations {
    fn visit<T: TS + 'static + ?Sized>(&mut self) {
        // Numbers, text and lists have no declaration.
        if T::output_path().is_none() {
            return;
        }
        let text = without_comments(&T::decl(&self.config));
        let name = T::ident(&self.config);
        match self.found.insert(name.clone(), text.clone()) {
            None => T::visit_dependencies(self),
            Some(other) => assert_eq!(other, text, "two types are called {name}"),
        }
    }
}

/// Takes out the documentation and the ends of lines beside it.
fn without_comments(declaration: &str) -> String {
    let code = declaration
        .split("/**")
        .map(|part| part.split_once("*/").map_or(part, |(_, code)| code));
    code.collect::<String>().replace('\n', "")
}

#[test]
fn the_types_of_the_page_are_those_of_rust() {
    let mut all = Declarations {
        config: Config::new().with_large_int("number").with_array_tuple_limit(4),
        found: BTreeMap::new(),
    };
    all.visit::<FirstContents>();
    all.visit::<protocol::CellQuestion>();
    all.visit::<protocol::CellLine>();
    all.visit::<protocol::MapQuestion>();
    all.visit::<protocol::MapLine>();
    all.visit::<protocol::RecoveryQuestion>();
    all.visit::<protocol::RecoveryLine>();
    all.visit::<protocol::SaveQuestion>();
    all.visit::<protocol::SaveLine>();
    all.visit::<protocol::DiskQuestion>();
    all.visit::<protocol::DiskLine>();
    all.visit::<protocol::HelloLine>();
    all.visit::<protocol::EndLine>();
    all.visit::<StateEvent>();
    all.visit::<SamplesEvent>();
    all.visit::<LiveEnd>();
    let lines = all.found.values().map(|declaration| format!("export {declaration}\n"));
    let current = HEAD.to_owned() + &lines.collect::<String>();
    if std::env::var_os("PLATEWASH_WRITE_DOCS").is_some() {
        std::fs::write(FILE, &current).unwrap();
    }
    let committed = std::fs::read_to_string(FILE).unwrap();
    assert!(committed == current, "{FILE} is out of date: run `cargo xtask docs`");
}
