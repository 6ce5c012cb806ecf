//! A scenario key: its path, unit, range and meaning.

use Domain::{
    Bool, Integer, Joints, JointsAbove, Knots, Names, Number, NumberAbove, Pair, PairAbove, Path, Paths, Plates,
    Points, Positions, Range, Scale, Text, Triple, TripleAbove, Word,
};
use platewash_workcell::job::MAX_SEED;
use platewash_workcell::surface::MOST_KNOTS;

/// Domain of the values of a key.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Domain {
    /// Text that is not empty and has no control characters, which a terminal would obey.
    Text,
    /// A path of a file, relative to the scenario's folder.
    Path,
    /// A list of folder paths.
    Paths,
    /// A list of names, each a [`Domain::Text`].
    Names,
    /// A table of numbers by name, each name a [`Domain::Text`] and each number within the range.
    Positions(f64, f64),
    /// One of some words.
    Word(&'static [&'static str]),
    /// `true` or `false`.
    Bool,
    /// A whole number, both ends included.
    Integer(i64, i64),
    /// A number, both ends included.
    Number(f64, f64),
    /// A number above the first and up to the second.
    NumberAbove(f64, f64),
    /// `[least, greatest]`, least below greatest, both within the range.
    Range(f64, f64),
    /// Six numbers, one a joint, each within the range.
    Joints(f64, f64),
    /// Six numbers, each above the first and up to the second.
    JointsAbove(f64, f64),
    /// A list of 1 to 1000 points `[x, y]`, coordinates within the range.
    Points(f64, f64),
    /// Two numbers, each above the first and up to the second.
    PairAbove(f64, f64),
    /// Two numbers, each within the range.
    Pair(f64, f64),
    /// Three numbers, each within the range.
    Triple(f64, f64),
    /// Three numbers, each above the first and up to the second.
    TripleAbove(f64, f64),
    /// Three numbers that are not 0, each within the range.
    Scale(f64, f64),
    /// `"all"`, or a list of plates by their index, each once and growing.
    Plates,
    /// The knots of a profile, from the pole on: a list of `[radius in m, slope in degrees]`, radii growing up to the first, slopes up to the
    /// second, either way.
    Knots(f64, f64),
}

/// A key of the scenario file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Key {
    /// Dotted path.
    pub path: &'static str,
    /// Unit; empty for none.
    pub unit: &'static str,
    /// Values it takes.
    pub domain: Domain,
    /// Meaning of the key.
    pub meaning: &'static str,
}

/// A row of the table.
pub(crate) const fn key(path: &'static str, unit: &'static str, domain: Domain, meaning: &'static str) -> Key {
    Key {
        path,
        unit,
        domain,
        meaning,
    }
}

impl Domain {
    /// The range in words, as messages and the reference print it.
    #[must_use]
    pub fn describe(&self) -> String {
        match self {
            Text => "text, not empty, without control or direction characters".to_owned(),
            Path => "a path".to_owned(),
            Paths => "a list of folders".to_owned(),
            Names => format!("a list of names, each {}", Text.describe()),
            Positions(least, most) => {
                format!("a table of numbers from {least} to {most} by name, {{ name = number, … }}")
            }
            Word(words) => {
                let quoted: Vec<_> = words.iter().map(|w| format!("\"{w}\"")).collect();
                quoted.join(" or ")
            }
            Bool => "true or false".to_owned(),
            Integer(least, most) if *most == MAX_SEED as i64 => {
                format!("a whole number from {least} to {most} (2^53 − 1)")
            }
            Integer(least, most) => format!("a whole number from {least} to {most}"),
            Number(least, most) => format!("a number from {least} to {most}"),
            NumberAbove(above, most) => format!("a number above {above}, up to {most}"),
            Range(least, most) => format!("[least, greatest] with least < greatest, from {least} to {most}"),
            Joints(least, most) => format!("six numbers from {least} to {most}"),
            JointsAbove(above, most) => format!("six numbers above {above}, up to {most}"),
            Points(least, most) => format!("a list of 1 to 1000 [x, y], coordinates from {least} to {most}"),
            PairAbove(above, most) => format!("two numbers above {above}, up to {most}"),
            Pair(least, most) => format!("two numbers from {least} to {most}"),
            Scale(least, most) => format!("three numbers from {least} to {most}, none of them 0"),
            Plates => "\"all\" or a list of plates by their index from 0, growing".to_owned(),
            Triple(least, most) => format!("three numbers from {least} to {most}"),
            TripleAbove(above, most) => format!("three numbers above {above}, up to {most}"),
            Knots(most_m, most_deg) => format!(
                "a list of 1 to {MOST_KNOTS} [radius, slope]: radii above 0 m and each above the one before, up to {most_m} m, slopes \
                 from −{most_deg} to {most_deg} degrees"
            ),
        }
    }
}

/// The name of a key within its section.
pub(crate) fn own_name(key: &Key) -> &'static str {
    key.path.rsplit('.').next().unwrap_or(key.path)
}
