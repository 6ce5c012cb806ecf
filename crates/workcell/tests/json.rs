//! Reading JSON: errors that name the key in plain words.

use platewash_workcell::json::read;
use serde::Deserialize;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(dead_code)]
struct Document {
    seed: u64,
    part: Part,
    list: Vec<[f64; 2]>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(dead_code)]
struct Part {
    on: bool,
    name: String,
}

const GOOD: &str = r#"{"seed": 1, "part": {"on": true, "name": "a"}, "list": [[0.5, 1]]}"#;

#[test]
fn skips_a_byte_order_mark() {
    assert_eq!(read::<Document>(&format!("\u{feff}{GOOD}")).unwrap().seed, 1);
}

#[test]
fn errors_name_the_key_in_plain_words() {
    for (from, to, told) in [
        ("1,", "\"one\",", "'seed' must be a whole number; found \"one\""),
        ("1,", "-1,", "'seed' must be a whole number; found -1"),
        ("1,", "1.5,", "'seed' must be a whole number; found 1.5"),
        ("true", "1", "'part.on' must be true or false; found 1"),
        ("\"a\"", "null", "'part.name' must be a text; found null"),
        ("0.5", "\"x\"", "'list[0][0]' must be a number; found \"x\""),
        ("[0.5, 1]", "[0.5]", "'list[0]' must be a list of length 2; found 1"),
        ("[[0.5, 1]]", "3", "'list' must be a list […]; found 3"),
        (
            "{\"on\": true, \"name\": \"a\"}",
            "true",
            "'part' must be a table {…}; found true",
        ),
        ("\"on\": true, ", "", "'part.on' is missing"),
        ("\"on\"", "\"off\"", "unknown key 'part.off': expected 'on' or 'name'"),
        (
            "\"on\": true",
            "\"on\": true, \"on\": true",
            "'part.on' is stated twice",
        ),
        (
            "]}",
            "",
            "it ends in the middle, at line 1, column 64: the file is empty or was cut off",
        ),
        (
            "]}",
            "]} 1",
            "it is not valid JSON: trailing characters at line 1, column 68",
        ),
        (
            "{\"seed\"",
            "seed",
            "it is not valid JSON: expected value at line 1, column 1",
        ),
        (
            GOOD,
            "",
            "it ends in the middle, at line 1, column 0: the file is empty or was cut off",
        ),
        (GOOD, "7", "the whole must be a table {…}; found 7"),
    ] {
        let text = GOOD.replacen(from, to, 1);
        assert_ne!(text, GOOD);
        assert_eq!(read::<Document>(&text).unwrap_err().to_string(), told);
    }
}
