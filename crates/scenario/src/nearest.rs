//! The word that was probably meant.

/// Less like any word than this, nothing is suggested.
const LEAST_LIKENESS: f64 = 0.6;

/// Of the words known the one most like another, where it is like it.
pub(crate) fn nearest(word: &str, known: impl Iterator<Item = &'static str>) -> Option<&'static str> {
    let ranked = known.map(|other| (strsim::normalized_damerau_levenshtein(other, word), other));
    let nearest = ranked.max_by(|a, b| a.0.total_cmp(&b.0));
    nearest
        .filter(|(likeness, _)| *likeness > LEAST_LIKENESS)
        .map(|(_, other)| other)
}
