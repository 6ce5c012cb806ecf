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
    replaced(json, |c| match c {
        '<' => Some("\\u003c"),
        '\u{2028}' => Some("\\u2028"),
        '\u{2029}' => Some("\\u2029"),
        _ => None,
    })
}

/// Text as it stands in HTML, between elements or in an attribute.
fn escaped(text: &str) -> String {
    replaced(text, |c| match c {
        '&' => Some("&amp;"),
        '<' => Some("&lt;"),
        '>' => Some("&gt;"),
        '"' => Some("&quot;"),
        '\'' => Some("&#39;"),
        _ => None,
    })
}

fn replaced(text: &str, by: impl Fn(char) -> Option<&'static str>) -> String {
    let mut written = String::with_capacity(text.len() + text.len() / 16);
    let mut kept = 0;
    for (at, byte) in text.bytes().enumerate() {
        // Nearly all of a document is ASCII, of which a byte is a character.
        let found = match byte.is_ascii() {
            true => Some(char::from(byte)),
            false => text.get(at..).and_then(|rest| rest.chars().next()),
        };
        if let Some((c, other)) = found.and_then(|c| Some((c, by(c)?))) {
            written.push_str(&text[kept..at]);
            written.push_str(other);
            kept = at + c.len_utf8();
        }
    }
    written.push_str(&text[kept..]);
    written
}

#[cfg(test)]
mod tests {
    use super::*;
    use platewash_kinematics::{JointVector, RobotModel};
    use proptest::prelude::*;

    const TEMPLATE: &str = "<title><!--platewash:title--></title><!--platewash:style--><body><!--platewash:notices-->\
        <!--platewash:data--><!--platewash:script--></body>";
    const DATA: &str = r#"<script type="application/json" id="platewash-view">"#;

    fn bundle() -> Bundle {
        Bundle {
            template: TEMPLATE.into(),
            style: "a > b {}".into(),
            script: "run(1 < 2)".into(),
            notices: "A & B <c@d.example>".into(),
        }
    }

    fn named(name: &str) -> View {
        let robot = RobotModel::irb120().unwrap();
        let mut view = View::of_configuration(&robot, None, &JointVector::zeros());
        view.heading.scenario = name.to_owned();
        view
    }

    /// Returns the data block as a browser reads it: it ends at the first `</script`.
    fn read_back(page: &str) -> serde_json::Value {
        read_back_from(page, DATA)
    }

    fn read_back_from(page: &str, start: &str) -> serde_json::Value {
        let (_, data) = page.split_once(start).unwrap();
        let (data, _) = data.split_once("</script").unwrap();
        serde_json::from_str(data).unwrap()
    }

    #[test]
    fn every_part_of_the_page_stands_in_its_place() {
        let page = html(&named("kitchen"), &bundle()).unwrap();
        let start =
            "<title>kitchen · platewash</title><style>a > b {}</style><body>A &amp; B &lt;c@d.example&gt;<script type=";
        assert!(page.starts_with(start), "{}", &page[..200]);
        assert!(page.ends_with("</script><script>run(1 < 2)</script></body>"));
        assert_eq!(read_back(&page)["heading"]["scenario"], "kitchen");
    }

    #[test]
    fn escapes_a_hostile_name() {
        let names = [
            "</script><script>alert(1)</script>",
            "</ScRiPt ><img src=x onerror=alert(1)>",
            "<!--<script>",
            "<!--platewash:script-->",
            "\" onload='x' &amp;",
            "\u{202e}txet\u{2066}\u{2028}\u{2029}\u{0}",
            "</title><script>",
            &"long ".repeat(2000),
        ];
        for name in names {
            let page = html(&named(name), &bundle()).unwrap();
            assert_eq!(read_back(&page)["heading"]["scenario"], *name);
            assert_eq!(page.matches("<script").count(), 2, "{name}");
            assert_eq!(page.matches("</script").count(), 2, "{name}");
            let (_, title) = page.split_once("<title>").unwrap();
            let (title, _) = title.split_once('<').unwrap();
            assert!(title.len() < 1000 && title.ends_with("· platewash"), "{title}");
            assert!(!page.contains(['\u{2028}', '\u{2029}']));
        }
    }

    #[test]
    fn a_second_document_follows_the_first_and_is_escaped() {
        let texts = [
            "seed = 1\n",
            "# </script><script>alert(1)</script>",
            "# </SCRIPT ><!--<script>",
            "# <!--platewash:data--><!--platewash:script-->",
            "# \u{2028}\u{2029}\u{0}\u{202e} \\u003c",
            "",
        ];
        for text in texts {
            let edit = serde_json::json!({ "format": "platewash-edit/1", "text": text });
            let page = html_with(&named("kitchen"), &edit, &bundle()).unwrap();
            assert_eq!(read_back(&page)["heading"]["scenario"], "kitchen");
            assert_eq!(read_back_from(&page, &DATA.replace("view", "edit")), edit);
            assert_eq!(page.to_lowercase().matches("<script").count(), 3, "{text}");
            assert_eq!(page.to_lowercase().matches("</script").count(), 3, "{text}");
            assert!(!page.contains(['\u{2028}', '\u{2029}']));
        }
        assert!(!html(&named("kitchen"), &bundle()).unwrap().contains("platewash-edit"));
    }

    #[test]
    fn rejects_an_invalid_bundle() {
        let refused = |change: fn(&mut Bundle)| {
            let mut bundle = bundle();
            change(&mut bundle);
            html(&named("kitchen"), &bundle).unwrap_err().to_string()
        };
        assert!(refused(|b| b.script = "x = '</SCRIPT>'".into()).contains("script"));
        assert!(refused(|b| b.style = "</style>".into()).contains("style"));
        assert!(
            refused(|b| b.template = TEMPLATE.replace("<!--platewash:data-->", "").into())
                .contains("lacks the placeholder \"data\"")
        );
        let unknown = refused(|b| b.template = format!("{TEMPLATE}<!--platewash:more-->").into());
        assert!(unknown.contains("does not know the placeholder \"more\""), "{unknown}");
    }

    proptest! {
        #[test]
        fn reads_back_any_name(name in "\\PC*|[<>/!a-z\\-\"'&\u{2028}]{0,60}") {
            let page = html(&named(&name), &bundle()).unwrap();
            prop_assert_eq!(&read_back(&page)["heading"]["scenario"], &name);
            prop_assert_eq!(page.to_lowercase().matches("<script").count(), 2);
        }
    }

    #[test]
    fn the_title_of_a_dry_run_begins_with_that() {
        let mut view = named("kitchen");
        assert!(
            html(&view, &bundle())
                .unwrap()
                .contains("<title>kitchen · platewash</title>")
        );
        view.heading.dry_run = Some("DRY RUN of 221b93b62aa8".to_owned());
        let page = html(&view, &bundle()).unwrap();
        assert!(page.contains("<title>Dry run: kitchen · platewash</title>"), "{page}");
    }
}
