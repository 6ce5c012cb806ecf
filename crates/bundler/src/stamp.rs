//! The stamp of the page's bundle: the hash of what it is made from.
//!
//! A bundle whose stamp is not that of the sources is old.

use sha2::{Digest, Sha256};
use std::path::Path;
use std::{fs, io};

/// The files of a bundle, beside its stamp.
pub const FILES: [&str; 4] = ["index.html", "page.js", "page.css", "notices.txt"];

/// The file in the bundle's folder that holds its stamp, a line of hexadecimal digits.
pub const STAMP: &str = "stamp";

/// Folders among the page's sources that the bundle does not depend on.
const LEFT_OUT: [&str; 2] = ["node_modules", "test"];

/// Returns the names of the files and folders in the page's folder from which the bundle is made, sorted. Hidden ones are left out.
///
/// # Errors
/// A folder that cannot be read, or a name that is no Unicode.
pub fn entries(page: &Path) -> io::Result<Vec<String>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(page)? {
        let name = entry?.file_name().into_string();
        let name = name.map_err(|name| io::Error::other(format!("{}: no Unicode", page.join(name).display())))?;
        if !name.starts_with('.') && !LEFT_OUT.contains(&name.as_str()) {
            names.push(name);
        }
    }
    names.sort();
    Ok(names)
}

/// The files that the bundle is made from, relative to the page's folder, with `/` between the parts of a name, in order.
///
/// # Errors
/// As [`entries`].
pub fn sources(page: &Path) -> io::Result<Vec<String>> {
    let mut files = Vec::new();
    let mut left = entries(page)?;
    while let Some(name) = left.pop() {
        if page.join(&name).is_dir() {
            let inside = entries(&page.join(&name))?;
            left.extend(inside.into_iter().map(|inner| format!("{name}/{inner}")));
        } else {
            files.push(name);
        }
    }
    files.sort();
    Ok(files)
}

/// SHA-256 of names, lengths and contents of all sources, in hexadecimal. Line ends count as `\n`, however a checkout has them.
///
/// # Errors
/// A source that cannot be read.
pub fn compute(page: &Path) -> io::Result<String> {
    let mut hash = Sha256::new();
    for name in sources(page)? {
        let content = with_plain_line_ends(&fs::read(page.join(&name))?);
        hash.update(format!("{name}\0{}\0", content.len()));
        hash.update(content);
    }
    Ok(hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
}

/// The stamp of the bundle in a folder, if it has one, and whole: a folder where a file is missing has none.
pub fn found(folder: &Path) -> Option<String> {
    let stamp = fs::read_to_string(folder.join(STAMP)).ok()?;
    let whole = FILES.iter().all(|name| folder.join(name).is_file());
    whole.then(|| stamp.trim().to_owned())
}

fn with_plain_line_ends(content: &[u8]) -> Vec<u8> {
    let ends_a_line = |index: usize| content[index] == b'\r' && content.get(index + 1) == Some(&b'\n');
    let kept = (0..content.len()).filter(|&index| !ends_a_line(index));
    kept.map(|index| content[index]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stamp_of(files: &[(&str, &str)]) -> String {
        let page = tempfile::tempdir().unwrap();
        for (name, content) in files {
            let place = page.path().join(name);
            fs::create_dir_all(place.parent().unwrap()).unwrap();
            fs::write(place, content).unwrap();
        }
        compute(page.path()).unwrap()
    }

    const PAGE: [(&str, &str); 2] = [("package-lock.json", "{}\n"), ("src/a/main.ts", "let a = 1;\nlet b;\n")];

    #[test]
    fn stamp_depends_on_file_names_and_contents() {
        let stamp = stamp_of(&PAGE);
        assert_eq!(stamp, stamp_of(&[PAGE[1], PAGE[0]]), "not their order");
        for other in [
            vec![PAGE[0]],
            vec![PAGE[0], ("src/a/other.ts", PAGE[1].1)],
            vec![PAGE[0], ("src/a/main.ts", "let a = 2;\nlet b;\n")],
            vec![PAGE[0], PAGE[1], ("style.css", "")],
            // What ends one file does not begin the next one.
            vec![PAGE[0], ("src/a/main.ts", ""), ("src/a/main.ts2", PAGE[1].1)],
        ] {
            assert_ne!(stamp, stamp_of(&other), "{other:?}");
        }
    }

    #[test]
    fn stamp_ignores_line_ends_hidden_files_packages_and_tests() {
        let more = [
            ("package-lock.json", "{}\r\n"),
            ("src/a/main.ts", "let a = 1;\r\nlet b;\n"),
            ("src/.main.ts.swp", "x"),
            ("node_modules/three/index.js", "x"),
            ("test/main.test.ts", "x"),
        ];
        assert_eq!(stamp_of(&PAGE), stamp_of(&more));
        assert_eq!(
            with_plain_line_ends(b"\ra\r\r\n\n\r"),
            b"\ra\r\n\n\r",
            "a carriage return alone does not end a line"
        );
    }

    #[test]
    fn a_bundle_with_a_missing_file_has_no_stamp() {
        let folder = tempfile::tempdir().unwrap();
        for name in FILES.into_iter().chain([STAMP]) {
            assert_eq!(found(folder.path()), None, "before {name}");
            fs::write(folder.path().join(name), "abc\n").unwrap();
        }
        assert_eq!(found(folder.path()).as_deref(), Some("abc"));
    }
}
