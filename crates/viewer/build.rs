//! Takes the page's bundle into the program, where there is one that was made from these sources.
//!
//! It starts no program and uses no network: `cargo xtask page` makes the bundle. Without one the crate builds as well, and
//! `Bundle::embedded` has nothing.

use std::io;
use std::path::Path;

mod stamp;

fn main() -> io::Result<()> {
    let (page, bundle) = (Path::new("page"), Path::new("dist"));
    for name in stamp::entries(page)? {
        println!("cargo::rerun-if-changed=page/{name}");
    }
    // A file that is missing counts as changed each time. The folder around it changes when the bundle comes.
    let watched = if bundle.join(stamp::STAMP).is_file() {
        "dist/stamp"
    } else {
        "."
    };
    println!("cargo::rerun-if-changed={watched}");
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=stamp.rs");

    let wanted = stamp::of(page)?;
    println!("cargo::rustc-check-cfg=cfg(embedded_page)");
    if stamp::found(bundle).as_ref() == Some(&wanted) {
        println!("cargo::rustc-cfg=embedded_page");
    }
    println!("cargo::rustc-env=PLATEWASH_PAGE_STAMP={wanted}");
    Ok(())
}
