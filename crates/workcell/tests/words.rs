//! Words of messages: counts, plates, lengths and quoted names.

use platewash_workcell::words::*;

#[test]
fn one_is_singular_and_any_other_number_plural() {
    assert_eq!(
        [0, 1, 2].map(|n| count_with_noun(n, "plate")),
        ["0 plates", "1 plate", "2 plates"]
    );
    assert_eq!(part_of(1, 1, "plate"), "1 of 1 plate");
    assert_eq!(part_of(1, 4, "plate"), "1 of 4 plates");
}

#[test]
fn plates_are_counted_from_one() {
    assert_eq!([0, 9].map(plate_name), ["plate 1", "plate 10"]);
    assert_eq!(plate_number(usize::MAX), usize::MAX);
}

#[test]
fn lengths_are_printed_in_millimetres() {
    assert_eq!(millimetres(-0.09), "-90.0 mm");
}

#[test]
fn invisible_characters_are_written_out() {
    let edges = [
        0x0a, 0x1b, 0x7f, 0x9b, 0xad, 0x61c, 0x200b, 0x200f, 0x2028, 0x2029, 0x202a, 0x202e, 0x2060, 0x2064, 0x2066,
        0x206f, 0xfeff, 0xe0041,
    ];
    for c in edges.map(|code| char::from_u32(code).unwrap()) {
        assert_eq!(
            printable(&format!("a{c}b")),
            format!("a{}b", c.escape_default()),
            "{c:?}"
        );
    }
    let seen = "link_1 – Spüle, 皿\u{2027}\u{202f}\u{2070}\\\"";
    assert_eq!(printable(seen), seen);
}

#[test]
fn a_quoted_name_ends_where_its_quotes_end() {
    assert_eq!(quoted("floor"), r#""floor""#);
    assert_eq!(quoted(r#"a"; "b"#), r#""a\"; \"b""#);
    assert_eq!(quoted("a\\"), r#""a\\""#);
    assert_eq!(quoted("a\n\u{202e}b"), r#""a\n\u{202e}b""#);
    // A name that spells an escape is not the name with that character.
    assert_ne!(quoted("\\n"), quoted("\n"));
}
