//! The page's bundle: the common parts of all pages, namely script, style and a template that a document goes into.

use std::borrow::Cow;

/// The page without a document. The build makes it from `crates/viewer/page`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Bundle {
    /// The page in HTML, with placeholders for title, style, data, script and notices.
    pub template: Cow<'static, str>,
    /// Its style sheet.
    pub style: Cow<'static, str>,
    /// Its program, without a `</script` in it.
    pub script: Cow<'static, str>,
    /// The licences of its third-party parts, as text.
    pub notices: Cow<'static, str>,
}

impl Bundle {
    /// The bundle in this program; none where there was none when it was compiled.
    pub fn embedded() -> Option<Self> {
        #[cfg(embedded_page)]
        return Some(Self {
            template: Cow::Borrowed(include_str!(concat!(env!("OUT_DIR"), "/index.html"))),
            style: Cow::Borrowed(include_str!(concat!(env!("OUT_DIR"), "/page.css"))),
            script: Cow::Borrowed(include_str!(concat!(env!("OUT_DIR"), "/page.js"))),
            notices: Cow::Borrowed(include_str!(concat!(env!("OUT_DIR"), "/notices.txt"))),
        });
        #[cfg(not(embedded_page))]
        None
    }

    /// The reason why this program was built without a bundle, and what to install and to run before the next build. `None` where it has
    /// one.
    pub fn reason_absent() -> Option<&'static str> {
        if cfg!(embedded_page) {
            return None;
        }
        Some(option_env!("PLATEWASH_NO_PAGE").unwrap_or("run `cargo xtask page`"))
    }
}
