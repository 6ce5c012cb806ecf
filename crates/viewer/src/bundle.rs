//! The page's bundle: what all pages have in common, its script, its style and a template that a document goes into.

use std::borrow::Cow;
use std::io;
use std::path::{Path, PathBuf};

/// The stamp of the page's sources that this crate was compiled with.
const WANTED: &str = env!("PLATEWASH_PAGE_STAMP");

/// The page without a document. Made from `crates/viewer/page` by `cargo xtask page`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Bundle {
    /// The page in HTML, with placeholders for title, style, data, script and notices.
    pub template: Cow<'static, str>,
    /// Its style sheet.
    pub style: Cow<'static, str>,
    /// Its program, without a `</script` in it.
    pub script: Cow<'static, str>,
    /// The licences of what others wrote of it, as text.
    pub notices: Cow<'static, str>,
}

/// Why a folder has no bundle for this program.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BundleError {
    /// A file that is missing or cannot be read.
    #[error("{}: the page's bundle cannot be read: {source}", .file.display())]
    Unreadable {
        /// The file.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// It was made from other sources.
    #[error("{}: the page's bundle was made from other sources than this program: run `cargo xtask page`", .folder.display())]
    Stale {
        /// The bundle's folder.
        folder: PathBuf,
    },
}

impl Bundle {
    /// The bundle in this program; none where there was none when it was compiled.
    pub fn embedded() -> Option<Self> {
        #[cfg(embedded_page)]
        return Some(Self {
            template: Cow::Borrowed(include_str!("../dist/index.html")),
            style: Cow::Borrowed(include_str!("../dist/page.css")),
            script: Cow::Borrowed(include_str!("../dist/page.js")),
            notices: Cow::Borrowed(include_str!("../dist/notices.txt")),
        });
        #[cfg(not(embedded_page))]
        None
    }

    /// The bundle in a folder.
    ///
    /// # Errors
    /// One that is not whole, or that was made from other sources than those beside which this program was compiled: it may not
    /// understand the documents that this program writes.
    pub fn read(folder: &Path) -> Result<Self, BundleError> {
        let text = |name: &str| {
            let file = folder.join(name);
            std::fs::read_to_string(&file).map_err(|source| BundleError::Unreadable { file, source })
        };
        if text("stamp")?.trim() != WANTED {
            return Err(BundleError::Stale {
                folder: folder.to_owned(),
            });
        }
        Ok(Self {
            template: text("index.html")?.into(),
            style: text("page.css")?.into(),
            script: text("page.js")?.into(),
            notices: text("notices.txt")?.into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder_with(stamp: &str, files: &[&str]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("stamp"), format!("{stamp}\n")).unwrap();
        for name in files {
            std::fs::write(folder.path().join(name), name).unwrap();
        }
        folder
    }

    const FILES: [&str; 4] = ["index.html", "page.js", "page.css", "notices.txt"];

    #[test]
    fn a_bundle_of_these_sources_is_read() {
        let folder = folder_with(WANTED, &FILES);
        let bundle = Bundle::read(folder.path()).unwrap();
        let read = [bundle.template, bundle.script, bundle.style, bundle.notices];
        assert_eq!(read, FILES);
    }

    #[test]
    fn a_bundle_of_other_sources_is_refused() {
        let folder = folder_with(&WANTED.replace(|c: char| c.is_ascii_digit(), "x"), &FILES);
        let error = Bundle::read(folder.path()).unwrap_err();
        assert!(matches!(error, BundleError::Stale { .. }), "{error}");
        assert!(error.to_string().contains("cargo xtask page"), "{error}");
    }

    #[test]
    fn what_is_missing_is_named() {
        for missing in FILES {
            let others: Vec<_> = FILES.into_iter().filter(|name| *name != missing).collect();
            let folder = folder_with(WANTED, &others);
            let error = Bundle::read(folder.path()).unwrap_err().to_string();
            assert!(error.contains(missing), "{error}");
        }
        let none = tempfile::tempdir().unwrap();
        assert!(Bundle::read(none.path()).unwrap_err().to_string().contains("stamp"));
    }

    /// Both come from one build, so that they can differ only where the embedded one is stale.
    #[test]
    fn the_embedded_bundle_is_that_of_the_folder() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("dist");
        if let Ok(read) = Bundle::read(&folder) {
            assert_eq!(Bundle::embedded(), Some(read));
        }
    }
}
