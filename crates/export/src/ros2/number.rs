//! Numbers in messages: a written number reads back exactly, and as a float by readers of YAML 1.1, YAML 1.2 and JSON.

/// A finite number as a float's text: always with a point, an exponent always with its sign, never a negative zero.
///
/// YAML 1.1, which ROS 2 reads, takes `1e-05` and `1e16` for texts; `1.0e-5` is a number to everybody.
pub(crate) fn float(value: f64) -> String {
    let value = if value == 0.0 { 0.0 } else { value };
    let shortest = format!("{value:?}");
    let Some((mantissa, exponent)) = shortest.split_once('e') else {
        return shortest;
    };
    let point = if mantissa.contains('.') { "" } else { ".0" };
    let sign = if exponent.starts_with('-') { "" } else { "+" };
    format!("{mantissa}{point}e{sign}{exponent}")
}

/// A text in double quotes, as JSON and YAML read it: characters beyond ASCII are escaped, as far as four digits can state them.
pub(crate) fn quoted(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            ' '..='~' | '\u{10000}'.. => out.push(c),
            _ => out.push_str(&format!("\\u{:04x}", u32::from(c))),
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use platewash_motion_proof::message::number::{ParsedNumber, read};
    use proptest::prelude::*;

    #[test]
    fn every_yaml_reader_takes_written_numbers_for_floats() {
        let texts = [0.0, -0.0, 1.0, -2.0, 1e-5, 1.5e-7, 1e16, 1e300, 0.1].map(float);
        let expected = [
            "0.0", "0.0", "1.0", "-2.0", "1.0e-5", "1.5e-7", "1.0e+16", "1.0e+300", "0.1",
        ];
        assert_eq!(texts, expected);
    }

    #[test]
    fn reports_numbers_that_are_no_floats() {
        for (text, said) in [
            ("1", ParsedNumber::Whole(1)),
            ("-3", ParsedNumber::Whole(-3)),
            ("1e-05", ParsedNumber::TextInYaml11(1e-5)),
            ("1.0e5", ParsedNumber::TextInYaml11(1e5)),
            ("1.0e+5", ParsedNumber::Float(1e5)),
            ("+0.5", ParsedNumber::Float(0.5)),
        ] {
            assert_eq!(read(text), said, "{text}");
        }
        let nothing = [
            "",
            "-",
            ".",
            ".5",
            "5.",
            "1_000.0",
            "010",
            "00.5",
            "0x1F",
            "nan",
            ".nan",
            ".inf",
            "inf",
            "NaN",
            "1.0e999",
            "1.0e",
            "1.0e+",
            "--1.0",
            "1.0 ",
            "1,0",
            "~",
            "9223372036854775808",
            "é",
        ];
        for text in nothing {
            assert_eq!(read(text), ParsedNumber::Nothing, "{text}");
        }
    }

    #[test]
    fn names_are_quoted_for_both_languages() {
        assert_eq!(quoted("joint_1"), "\"joint_1\"");
        assert_eq!(quoted("a\"\\\n\u{85}é😀"), "\"a\\\"\\\\\\u000a\\u0085\\u00e9😀\"");
    }

    proptest! {
        #[test]
        fn a_written_number_reads_back_exactly(bits in any::<u64>()) {
            let value = f64::from_bits(bits);
            prop_assume!(value.is_finite());
            let text = float(value);
            prop_assert_eq!(read(&text), ParsedNumber::Float(if value == 0.0 { 0.0 } else { value }), "{}", text);
            prop_assert_eq!(serde_json::from_str::<f64>(&text).unwrap(), value);
        }

        #[test]
        fn reading_takes_any_text(text in "[-+0-9.eE_]{0,12}|\\PC{0,8}") {
            let _ = read(&text);
        }
    }
}
