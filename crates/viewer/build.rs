//! Takes the page's bundle into the library. It makes the bundle where it is missing or old, for which it takes Node and the network.
//!
//! Without them the crate builds as well: cargo prints why, `Bundle::embedded` has nothing, and `Bundle::reason_absent` says why.

use platewash_bundler::stamp;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

/// Variables that say with these values that no bundle is to be made.
const SWITCHES: [(&str, &str); 3] = [
    ("PLATEWASH_MAKE_PAGE", "0"),
    ("CARGO_NET_OFFLINE", "true"),
    ("DOCS_RS", "1"),
];

fn main() -> io::Result<()> {
    println!("cargo::rustc-check-cfg=cfg(embedded_page)");
    println!("cargo::rerun-if-changed=build.rs");
    let (page, bundle) = (Path::new("page"), Path::new("dist"));
    for name in stamp::entries(page)? {
        println!("cargo::rerun-if-changed=page/{name}");
    }
    let wanted = stamp::compute(page)?;
    if stamp::found(bundle).as_ref() != Some(&wanted) {
        match make() {
            // Cargo is not told of files that this run made: it takes them for changes.
            Ok(()) => {}
            Err(why) => {
                let why = why.replace('\n', " ");
                println!("cargo::warning=this build has no page in 3-D: {why}");
                println!("cargo::rustc-env=PLATEWASH_NO_PAGE={why}");
                // The folder around the bundle changes when `cargo xtask page` makes it.
                println!("cargo::rerun-if-changed=.");
                return Ok(());
            }
        }
    }
    let out = PathBuf::from(env::var_os("OUT_DIR").ok_or_else(|| io::Error::other("cargo sets no OUT_DIR"))?);
    for name in stamp::FILES {
        fs::copy(bundle.join(name), out.join(name))?;
    }
    println!("cargo::rustc-cfg=embedded_page");
    Ok(())
}

/// Makes the bundle; else says why there is none, and what to do.
fn make() -> Result<(), String> {
    let set = |(name, value): &(&str, &str)| env::var_os(name).is_some_and(|found| found == *value);
    match SWITCHES.iter().find(|switch| set(switch)) {
        Some((name, value)) => Err(format!(
            "{name}={value} kept the build from making it; run `cargo xtask page`"
        )),
        None => platewash_bundler::make().map(drop).map_err(|why| format!("{why:#}")),
    }
}
