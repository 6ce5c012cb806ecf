//! A page: a document in the bundle that all pages share, as one file of HTML that needs no other.
//!
//! Every document is text. It stands in a data block in which every `<` is written `\u003c`, so that nothing in it ends the
//! block. The name of the subject stands in the title with its markup escaped. Placeholders are searched for in the template
//! alone.

use crate::bundle::Bundle;
use crate::view::View;
use platewash_workcell::words::printable;
use serde::Serialize;

/// Text before a placeholder's name.
const OPEN: &str = "<!--platewash:";
const CLOSE: &str = "-->";

/// Longest name in a title, in characters.
const LONGEST_TITLE: usize = 120;

/// Reason that there is no page.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PageError {
    /// The document cannot be written as JSON.
    #[error("the page's document cannot be written: {0}")]
    Document(#[from] serde_json::Error),
    /// A template with an unknown placeholder, or without one that it needs.
    #[error("the page's template {what} the placeholder \"{name}\": it was made for another version")]
    Template {
        /// Verb for the fault: it lacks or has the placeholder.
        what: &'static str,
        /// The placeholder.
        name: String,
    },
    /// A part of the bundle that would end before its end.
    #[error("the page's {part} has \"{end}\" in it")]
    Ends {
        /// The part.
        part: &'static str,
        /// Text that ends it.
        end: &'static str,
    },
}

/// The placeholders of a template.
const PLACEHOLDERS: [&str; 5] = ["title", "style", "data", "script", "notices"];

/// A document as a page.
///
/// # Errors
/// [`PageError`], for a bundle that is none: documents can always be written.
pub fn html(view: &View, bundle: &Bundle) -> Result<String, PageError> {
    filled(&title(view), &data_block("view", view)?, bundle)
}

/// A document as a page on which the scenario behind it can be edited, as a second document says: `platewash-edit`.
///
/// # Errors
/// [`PageError`], for a bundle that is none, or a second document that cannot be written as JSON.
pub fn html_with(view: &View, edit: &impl Serialize, bundle: &Bundle) -> Result<String, PageError> {
    let data = data_block("view", view)? + &data_block("edit", edit)?;
    filled(&title(view), &data, bundle)
}

/// The bundle with title and data blocks in their places.
fn filled(title: &str, data: &str, bundle: &Bundle) -> Result<String, PageError> {
    refuse_end("style", &bundle.style, "</style")?;
    refuse_end("script", &bundle.script, "</script")?;
    let mut page = String::with_capacity(
        data.len() + bundle.template.len() + bundle.style.len() + bundle.script.len() + 2 * bundle.notices.len(),
    );
    let mut filled = Vec::new();
    let mut rest: &str = &bundle.template;
    while let Some((before, name, after)) = next_placeholder(rest) {
        page.push_str(before);
        match name {
            "title" => page.push_str(&escaped(title)),
            "style" => page.extend(["<style>", &bundle.style, "</style>"]),
            "data" => page.push_str(data),
            "script" => page.extend(["<script>", &bundle.script, "</script>"]),
            "notices" => page.push_str(&escaped(&bundle.notices)),
            _ => return Err(template("does not know", name)),
        }
        filled.push(name);
        rest = after;
    }
    page.push_str(rest);
    match PLACEHOLDERS.into_iter().find(|name| !filled.contains(name)) {
        Some(missing) => Err(template("lacks", missing)),
        None => Ok(page),
    }
}

fn template(what: &'static str, name: &str) -> PageError {
    let name = name.to_owned();
    PageError::Template { what, name }
}

/// Returns the text before the first placeholder, its name, and the text behind it.
fn next_placeholder(text: &str) -> Option<(&str, &str, &str)> {
    let (before, inside) = text.split_once(OPEN)?;
    let (name, after) = inside.split_once(CLOSE)?;
    Some((before, name, after))
}

/// Refuses a part that contains the end of its own element, in any case of letters.
fn refuse_end(part: &'static str, text: &str, end: &'static str) -> Result<(), PageError> {
    let ends = |window: &[u8]| window.eq_ignore_ascii_case(end.as_bytes());
    let mut places = text.bytes().enumerate().filter(|(_, byte)| *byte == b'<');
    match places.any(|(at, _)| text.as_bytes().get(at..at + end.len()).is_some_and(ends)) {
        true => Err(PageError::Ends { part, end }),
        false => Ok(()),
    }
}

/// The title: the name of the subject, and of the program.
fn title(view: &View) -> String {
    let name = printable(&view.heading.scenario);
    let before = view.heading.dry_run.as_ref().map_or("", |_| "Dry run: ");
    match name.char_indices().nth(LONGEST_TITLE) {
        Some((end, _)) => format!("{before}{}… · platewash", &name[..end]),
        None => format!("{before}{name} · platewash"),
    }
}

/// A document in a data block of its own.
fn data_block(name: &str, document: &impl Serialize) -> Result<String, PageError> {
    let json = in_data_block(&serde_json::to_string(document)?);
    Ok(format!(
        r#"<script type="application/json" id="platewash-{name}">{json}</script>"#
    ))
}

/// JSON as it may stand in a data block: the same values, and nothing that HTML or a script would read as markup or the end of a line.
fn in_data_block(json: &str) -> String {
    json.replace('<', "\\u003c")
        .replace('\u{2028}', "\\u2028")
        .replace('\u{2029}', "\\u2029")
}

/// Text as it stands in HTML or SVG, between elements or in an attribute in double quotes.
pub(crate) fn escaped_but_for_apostrophes(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// Text as it stands in HTML, between elements or in an attribute.
fn escaped(text: &str) -> String {
    escaped_but_for_apostrophes(text).replace('\'', "&#39;")
}
