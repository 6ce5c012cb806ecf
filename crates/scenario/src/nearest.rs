//! The word that was probably meant.

/// Less like any word than this, nothing is suggested.
const LEAST_LIKENESS: f64 = 0.6;

/// Of the words known the one most like another, where it is like it.
pub(crate) fn nearest<'a>(word: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let ranked = known.map(|other| (strsim::normalized_damerau_levenshtein(other, word), other));
    let nearest = ranked.max_by(|a, b| a.0.total_cmp(&b.0));
    nearest
        .filter(|(likeness, _)| *likeness > LEAST_LIKENESS)
        .map(|(_, other)| other)
}

/// What is said of a name that does not exist, beside those `known`, which `in_full` writes out: of a diameter the radius, of others the one
/// most like it, or else what `otherwise` says.
pub(crate) fn hint(
    name: &str,
    known: &[&str],
    in_full: impl Fn(&str) -> String,
    otherwise: impl FnOnce() -> String,
) -> String {
    let of_radius = name.replace("diameter", "radius");
    if of_radius != name && known.contains(&&*of_radius) {
        return format!("half of it, the radius, is stated: '{}'", in_full(&of_radius));
    }
    nearest(name, known.iter().copied()).map_or_else(otherwise, |other| format!("did you mean '{}'?", in_full(other)))
}
