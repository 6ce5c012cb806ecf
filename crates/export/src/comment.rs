//! Sentences as lines of a comment that every controller can show.

/// Longest line, in characters.
const WIDTH: usize = 78;

/// Sentences one after the other, wrapped, each line behind `prefix`; a sentence's further lines are indented. ASCII alone.
pub(crate) fn wrapped<'a>(prefix: &str, sentences: impl IntoIterator<Item = &'a str>) -> String {
    let mut text = String::new();
    for sentence in sentences {
        let mut line = prefix.to_owned();
        for (words, word) in ascii(sentence).split_ascii_whitespace().enumerate() {
            if words > 0 && line.len() + 1 + word.len() > WIDTH {
                text.push_str(&line);
                text.push('\n');
                line = format!("{prefix}   {word}");
            } else {
                line.push(' ');
                line.push_str(word);
            }
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

/// Text of visible ASCII characters and spaces alone; other characters without such a spelling become question marks.
pub(crate) fn ascii(text: &str) -> String {
    let mut told = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            ' '..='~' => told.push(c),
            '°' => told.push_str(" deg"),
            '–' | '−' | '‑' => told.push('-'),
            '—' => told.push_str("--"),
            '·' => told.push('*'),
            '±' => told.push_str("+-"),
            '≤' => told.push_str("<="),
            '≥' => told.push_str(">="),
            '²' => told.push_str("^2"),
            '³' => told.push_str("^3"),
            'µ' | 'μ' => told.push('u'),
            '“' | '”' | '„' => told.push('"'),
            '‘' | '’' => told.push('\''),
            '…' => told.push_str("..."),
            c if c.is_whitespace() => told.push(' '),
            _ => told.push('?'),
        }
    }
    told
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_line_is_a_comment_in_ascii(sentences in proptest::collection::vec(any::<String>(), 0..4)) {
            let text = wrapped("#", sentences.iter().map(String::as_str));
            prop_assert!(text.is_ascii());
            prop_assert!(text.lines().all(|line| line.starts_with('#') && line.trim_end() == line), "{text}");
            prop_assert!(text.is_empty() || text.ends_with('\n'));
        }
    }

    #[test]
    fn long_sentences_are_wrapped_and_keep_their_words() {
        let sentence = "two words ".repeat(40);
        let text = wrapped("#", [sentence.as_str()]);
        assert!(text.lines().all(|line| line.len() <= WIDTH), "{text}");
        assert_eq!(text.replace('#', "").split_whitespace().count(), 80);
        assert_eq!(wrapped("!", ["at 0.5°, 8 m/s²"]), "! at 0.5 deg, 8 m/s^2\n");
    }
}
