//! Words that are no names.

/// All keywords, in capitals, sorted.
const KEYWORDS: [&str; 58] = [
    "ALIAS",
    "AND",
    "BACKWARD",
    "CASE",
    "CONNECT",
    "CONST",
    "DEFAULT",
    "DIV",
    "DO",
    "ELSE",
    "ELSEIF",
    "ENDFOR",
    "ENDFUNC",
    "ENDIF",
    "ENDMODULE",
    "ENDPROC",
    "ENDRECORD",
    "ENDTEST",
    "ENDTRAP",
    "ENDWHILE",
    "ERROR",
    "EXIT",
    "FALSE",
    "FOR",
    "FROM",
    "FUNC",
    "GOTO",
    "IF",
    "INOUT",
    "LOCAL",
    "MOD",
    "MODULE",
    "NOSTEPIN",
    "NOT",
    "NOVIEW",
    "OR",
    "PERS",
    "PROC",
    "RAISE",
    "READONLY",
    "RECORD",
    "RETRY",
    "RETURN",
    "STEP",
    "SYSMODULE",
    "TASK",
    "TEST",
    "THEN",
    "TO",
    "TRAP",
    "TRUE",
    "TRYNEXT",
    "UNDO",
    "VAR",
    "VIEWONLY",
    "WHILE",
    "WITH",
    "XOR",
];

/// Length of the longest keyword.
const LONGEST: usize = 9;

/// The keyword that a word is, in any case of letters.
#[must_use]
pub fn keyword(word: &str) -> Option<&'static str> {
    if word.len() > LONGEST {
        return None;
    }
    let capitals = word.to_ascii_uppercase();
    let index = KEYWORDS.binary_search(&capitals.as_str()).ok()?;
    KEYWORDS.get(index).copied()
}

/// Whether a word is none that a program may name something by.
#[must_use]
pub fn is_reserved(word: &str) -> bool {
    keyword(word).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keywords_are_sorted_and_found_in_any_case() {
        assert!(KEYWORDS.is_sorted());
        for word in KEYWORDS {
            assert_eq!(keyword(&word.to_lowercase()), Some(word));
            assert!(word.len() <= LONGEST);
        }
        assert_eq!([keyword("endmodul"), keyword("pwWash3"), keyword("")], [None; 3]);
    }
}
