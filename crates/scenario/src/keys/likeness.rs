//! Words that are like another one.

/// Less like any word than this, nothing is suggested.
const LEAST_LIKENESS: f64 = 0.6;

/// Returns the most similar one of the known words, where it is similar enough.
pub(crate) fn nearest<'a>(word: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let ranked = known.map(|other| (strsim::normalized_damerau_levenshtein(other, word), other));
    let nearest = ranked.max_by(|a, b| a.0.total_cmp(&b.0));
    nearest
        .filter(|(likeness, _)| *likeness > LEAST_LIKENESS)
        .map(|(_, other)| other)
}
