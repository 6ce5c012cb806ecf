//! Question to the linker of a build: does it keep equal functions once? The wheel and the command have a largest size.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

/// Folds functions that are equal; Rust does not promise that functions have addresses of their own.
const FOLD: &str = "-Wl,--icf=all";

/// Tells cargo, in the build script of the package, to link its targets of a kind with equal functions once, where the linker can: `cdylib`
/// or `bin`.
pub fn fold_equal_functions(kind: &str) {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=RUSTC_LINKER");
    if links_with(FOLD, kind).unwrap_or(false) {
        let name = if kind == "bin" {
            "link-arg-bins"
        } else {
            "cdylib-link-arg"
        };
        println!("cargo::rustc-{name}={FOLD}");
    }
}

/// Tries the argument on an empty program or library, with the compiler, the target and the linker of this build.
fn links_with(argument: &str, kind: &str) -> Option<bool> {
    let [rustc, target, folder] = ["RUSTC", "TARGET", "OUT_DIR"].map(std::env::var_os);
    let mut compile = Command::new(rustc?);
    compile.args(["-", "--crate-name", "probe", "--crate-type", kind, "--edition", "2024"]);
    compile
        .arg("--target")
        .arg(target?)
        .arg("-C")
        .arg(format!("link-arg={argument}"));
    compile.arg("-o").arg(Path::new(&folder?).join("probe"));
    if let Some(linker) = std::env::var_os("RUSTC_LINKER") {
        let mut stated = std::ffi::OsString::from("linker=");
        stated.push(linker);
        compile.arg("-C").arg(stated);
    }
    let flags = std::env::var("CARGO_ENCODED_RUSTFLAGS").unwrap_or_default();
    compile.args(flags.split('\u{1f}').filter(|flag| !flag.is_empty()));
    let silent = compile
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    let mut running = silent.spawn().ok()?;
    let program = b"#![allow(missing_docs)]\nfn main() {}\n";
    running.stdin.take()?.write_all(program).ok()?;
    Some(running.wait().ok()?.success())
}
