//! Pages as one file: documents that are read back, and names that could end them early.

use platewash_kinematics::{JointVector, RobotModel};
use platewash_viewer::View;
use platewash_viewer::bundle::Bundle;
use platewash_viewer::page::{html, html_with};
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
