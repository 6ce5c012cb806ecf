//! The build script of the viewer, in a workspace of its own with a page that needs no packages.

use std::fs;
use std::path::Path;
use std::process::Command;

const REPOSITORY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

/// Makes the page that the test takes for the real one: its script is the text of `main.ts`.
const BUILD: &str = r#"
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
const out = process.argv[3];
mkdirSync(out, { recursive: true });
for (const name of ["index.html", "page.js", "page.css", "notices.txt"]) {
  writeFileSync(`${out}/${name}`, readFileSync("main.ts"));
}
"#;

const MAIN: &str = r#"
fn main() {
    #[cfg(embedded_page)]
    print!("{}", include_str!(concat!(env!("OUT_DIR"), "/page.js")));
}
"#;

fn write(place: &Path, text: &str) {
    fs::create_dir_all(place.parent().unwrap()).unwrap();
    fs::write(place, text).unwrap();
}

/// The workspace: the bundler, and a program in the place of the viewer.
fn workspace(root: &Path) {
    let read = |name: &str| fs::read_to_string(Path::new(REPOSITORY).join(name)).unwrap();
    for entry in fs::read_dir(Path::new(REPOSITORY).join("crates/bundler/src")).unwrap() {
        let name = format!(
            "crates/bundler/src/{}",
            entry.unwrap().file_name().into_string().unwrap()
        );
        write(&root.join(&name), &read(&name));
    }
    for name in ["crates/bundler/Cargo.toml", "crates/viewer/build.rs", "Cargo.lock"] {
        write(&root.join(name), &read(name));
    }
    let manifest = read("Cargo.toml");
    let rest = manifest.split_once("default-members").unwrap().1;
    let rest = rest.split_once('\n').unwrap().1.split_once("\n[profile").unwrap().0;
    let members = "[workspace]\nresolver = \"3\"\nmembers = [\"crates/bundler\", \"crates/viewer\"]\n";
    write(&root.join("Cargo.toml"), &format!("{members}{rest}"));
    let viewer = root.join("crates/viewer");
    let package = "[package]\nname = \"viewer\"\nedition = \"2024\"\n\n[build-dependencies]\nplatewash-bundler.workspace = true\n";
    write(&viewer.join("Cargo.toml"), package);
    write(&viewer.join("src/main.rs"), MAIN);
    write(
        &viewer.join("page/package.json"),
        "{\"name\": \"page\", \"private\": true}\n",
    );
    let lock = "{\"name\": \"page\", \"lockfileVersion\": 3, \"requires\": true, \"packages\": {\"\": {\"name\": \"page\"}}}\n";
    write(&viewer.join("page/package-lock.json"), lock);
    write(&viewer.join("page/build.mjs"), BUILD);
    write(&viewer.join("page/main.ts"), "first");
}

/// What the program prints after a build, and whether the build compiled anything.
fn built(root: &Path, variables: &[(&str, &str)]) -> (String, bool) {
    let output = Command::new(env!("CARGO"))
        .args(["build", "--offline", "--bin", "viewer"])
        .current_dir(root)
        .env("CARGO_TARGET_DIR", root.join("target"))
        .env_remove("PLATEWASH_MAKE_PAGE")
        .env_remove("CARGO_NET_OFFLINE")
        .env_remove("CARGO_MANIFEST_DIR")
        .envs(variables.iter().copied())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{said}");
    let program = root
        .join("target/debug")
        .join(format!("viewer{}", std::env::consts::EXE_SUFFIX));
    let printed = Command::new(program).output().unwrap().stdout;
    (String::from_utf8(printed).unwrap(), said.contains("Compiling"))
}

#[test]
fn every_build_has_the_page_and_the_second_compiles_nothing() {
    let root = tempfile::tempdir().unwrap();
    let root = root.path();
    workspace(root);
    assert_eq!(
        built(root, &[("PLATEWASH_MAKE_PAGE", "0")]),
        (String::new(), true),
        "none was asked for"
    );

    let viewer = root.join("crates/viewer");
    write(&viewer.join("page/main.ts"), "second");
    assert_eq!(built(root, &[]), ("second".to_owned(), true));
    assert_eq!(built(root, &[]), ("second".to_owned(), false));

    write(&viewer.join("page/main.ts"), "third");
    assert_eq!(
        built(root, &[]),
        ("third".to_owned(), true),
        "the page follows its sources"
    );
    assert_eq!(built(root, &[]), ("third".to_owned(), false));
    assert!(viewer.join("dist/stamp").is_file(), "other builds find it");
}
