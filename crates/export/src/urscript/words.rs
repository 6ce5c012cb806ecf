//! A line into words.

use super::fault::Fault;
use platewash_workcell::words::quoted;

/// Most words of a line: what bounds how deep an expression gets.
const MOST: usize = 512;

/// A word of a line.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Word {
    /// A name or keyword.
    Name(String),
    /// A number.
    Number(f64),
    /// What stands between quotes.
    Text(String),
    /// An operator, bracket, comma or colon.
    Sign(&'static str),
}

impl Word {
    /// As a message says it.
    pub(super) fn told(&self) -> String {
        match self {
            Self::Name(name) => quoted(name),
            Self::Number(number) => number.to_string(),
            Self::Text(text) => format!("text {}", quoted(&shortened(text))),
            Self::Sign(sign) => quoted(sign),
        }
    }
}

/// What a message repeats of a text.
pub(super) fn shortened(text: &str) -> String {
    const LONGEST: usize = 40;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", text.get(..end).unwrap_or_default()),
        None => text.to_owned(),
    }
}

/// Signs, the longer ones first.
const SIGNS: [&str; 18] = [
    "==", "!=", "<=", ">=", "<", ">", "=", "+", "-", "*", "/", "%", "(", ")", "[", "]", ",", ":",
];

/// The words of a line, without its comment.
pub(super) fn words(line: &str) -> Result<Vec<Word>, Fault> {
    let mut words = Vec::new();
    let mut rest = line.trim_start();
    while let Some(c) = rest.chars().next() {
        if c == '#' {
            break;
        }
        if words.len() == MOST {
            return Err(Fault::new(format!(
                "more than {MOST} words in a line, the most that are read"
            )));
        }
        let (word, behind) = match c {
            'a'..='z' | 'A'..='Z' | '_' => {
                let (name, behind) = split(rest, |c| c.is_ascii_alphanumeric() || c == '_');
                (Word::Name(name.to_owned()), behind)
            }
            '0'..='9' | '.' => number(rest)?,
            '"' => match rest.get(1..).and_then(|rest| rest.split_once('"')) {
                Some((text, behind)) => (Word::Text(text.to_owned()), behind),
                None => return Err(Fault::new("a text without its closing quotes")),
            },
            _ => match SIGNS
                .into_iter()
                .find_map(|sign| Some((sign, rest.strip_prefix(sign)?)))
            {
                Some((sign, behind)) => (Word::Sign(sign), behind),
                None => {
                    return Err(Fault::new(format!(
                        "{} is no part of URScript as it is read here",
                        quoted(&c.to_string())
                    )));
                }
            },
        };
        words.push(word);
        rest = behind.trim_start();
    }
    Ok(words)
}

/// A decimal number.
fn number(text: &str) -> Result<(Word, &str), Fault> {
    let (mut end, mut last) = (0, ' ');
    for c in text.chars() {
        let sign_of_exponent = matches!(c, '+' | '-') && matches!(last, 'e' | 'E');
        if !(c.is_ascii_alphanumeric() || matches!(c, '.' | '_') || sign_of_exponent) {
            break;
        }
        (end, last) = (end + c.len_utf8(), c);
    }
    let (told, behind) = text.split_at(end);
    // Rust reads "inf", "1_0" and "1e999" in its own way.
    let decimal = told
        .bytes()
        .all(|b| matches!(b, b'0'..=b'9' | b'.' | b'e' | b'E' | b'+' | b'-'));
    match told.parse::<f64>() {
        Ok(number) if decimal && number.is_finite() => Ok((Word::Number(number), behind)),
        _ => Err(Fault::new(format!(
            "expected a decimal number, found {}",
            quoted(&shortened(told))
        ))),
    }
}

fn split(text: &str, belongs: impl Fn(char) -> bool) -> (&str, &str) {
    text.split_at(text.find(|c| !belongs(c)).unwrap_or(text.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_split_and_its_comment_left_out() {
        let found = words("  x=p[1e-3,.5] # \"y\"").unwrap();
        let name = |name: &str| Word::Name(name.to_owned());
        let expected = [
            name("x"),
            Word::Sign("="),
            name("p"),
            Word::Sign("["),
            Word::Number(1e-3),
            Word::Sign(","),
            Word::Number(0.5),
            Word::Sign("]"),
        ];
        assert_eq!(found, expected);
        assert_eq!(
            words("\"# no comment\"").unwrap(),
            [Word::Text("# no comment".to_owned())]
        );
    }

    fn reason(line: &str) -> String {
        words(line).unwrap_err().at("x", 1).reason
    }

    #[test]
    fn what_is_no_word_is_refused() {
        for (line, said) in [
            ("1e999", "decimal number"),
            ("0x1F", "decimal number"),
            ("1.2.3", "decimal number"),
            ("\"open", "closing quotes"),
            ("a ; b", "no part of URScript"),
            ("\u{202e}", "no part of URScript"),
        ] {
            let error = reason(line);
            assert!(error.contains(said), "{line}: {error}");
        }
        assert!(reason(&"1 ".repeat(600)).contains("more than 512 words"));
    }
}
