//! Triangles of STL files, binary or ASCII.
//!
//! Known not to matter: the header of a binary file, normals, attribute bytes (colours) and names of solids; comments, which outside of
//! solids are all lines that begin with no keyword. All else that is not understood is refused with its line: it may be a part of the body.

use crate::urdf::mesh_text::{is_utf_16, point, text, words};
use nalgebra::Point3;

/// Header, count, then 50 bytes a triangle.
const BINARY_HEADER: usize = 80;
const BINARY_START: usize = 84;
const BINARY_TRIANGLE: usize = 50;

/// Words that begin a line of an ASCII file.
const KEYWORDS: [&str; 8] = [
    "solid", "facet", "outer", "vertex", "endloop", "endfacet", "endsolid", "end",
];

/// Signs that begin a comment.
const COMMENTS: [&str; 3] = ["#", ";", "//"];

/// Reads the corners of the triangles, three each.
///
/// # Errors
/// The reason, with the line of a text.
pub(crate) fn corners(bytes: &[u8]) -> Result<Vec<Point3<f64>>, String> {
    // Up to 16 million triangles, a byte of the count is 0: a text has none. The header of a binary file may begin with `solid`.
    let is_of_text = |byte: &u8| !matches!(byte, 0..9 | 0xff);
    match bytes.get(BINARY_HEADER..BINARY_START) {
        Some(count) if !is_utf_16(bytes) && !count.iter().all(is_of_text) => {
            let count = u32::from_le_bytes([count[0], count[1], count[2], count[3]]);
            binary(&bytes[BINARY_START..], count as usize)
        }
        _ => Text::read(bytes),
    }
}

/// Reads the triangles behind the header. Fewer bytes than a triangle has may follow.
fn binary(data: &[u8], count: usize) -> Result<Vec<Point3<f64>>, String> {
    let triangles = data.len() / BINARY_TRIANGLE;
    if triangles != count {
        return Err(format!(
            "it states {count} triangles and holds {triangles}: it is cut off, or damaged"
        ));
    }
    let number = |b: &[u8]| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    let corner = |b: &[u8]| Point3::new(number(&b[0..4]), number(&b[4..8]), number(&b[8..12]));
    let triangles = data.chunks_exact(BINARY_TRIANGLE);
    // A triangle: normal (12 bytes), three corners (36 bytes), two bytes more.
    Ok(triangles.flat_map(|t| t[12..48].chunks_exact(12).map(corner)).collect())
}

/// Statement of an ASCII file that is open.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Open {
    Nothing,
    Solid,
    Facet,
    Loop,
    /// A facet whose loop is closed.
    FacetEnd,
}

/// Reader of an ASCII file.
struct Text {
    /// Number of the line, from 1.
    line: usize,
    open: Open,
    solids: usize,
    facets: usize,
    corners: Vec<Point3<f64>>,
}

impl Text {
    fn read(bytes: &[u8]) -> Result<Vec<Point3<f64>>, String> {
        let mut reader = Self {
            line: 0,
            open: Open::Nothing,
            solids: 0,
            facets: 0,
            corners: Vec::new(),
        };
        let text = text(bytes)?;
        for line in text.split_inclusive('\n') {
            reader.line += 1;
            let seen = reader.see(&words(line).collect::<Vec<_>>());
            let is_cut = reader.open != Open::Nothing && !line.ends_with('\n');
            seen.map_err(|why| {
                if is_cut {
                    format!("the file is cut off; {why}")
                } else {
                    why
                }
            })?;
        }
        if reader.solids == 0 {
            return Err(format!(
                "its {} bytes are no STL file: a text begins with 'solid', and a binary file has 84 bytes or more",
                bytes.len()
            ));
        }
        if reader.open != Open::Nothing {
            return Err("the file is cut off: it does not end with 'endsolid'".to_owned());
        }
        Ok(reader.corners)
    }

    /// Takes the words of a line, of which a file may have several statements on one.
    fn see(&mut self, mut words: &[&str]) -> Result<(), String> {
        while let Some(first) = words.first() {
            let lower = first.to_ascii_lowercase();
            let is_keyword = KEYWORDS.contains(&lower.as_str());
            // A comment; between solids, and behind all of them, without a sign.
            let is_comment = COMMENTS.iter().any(|sign| first.starts_with(sign));
            if is_comment || self.open == Open::Nothing && !is_keyword {
                return Ok(());
            }
            let mut word = lower.as_str();
            let mut used = 1;
            if let ("end", Some(of)) = (word, words.get(1)) {
                let of = of.to_ascii_lowercase();
                word = match of.as_str() {
                    "solid" => "endsolid",
                    "facet" => "endfacet",
                    "loop" => "endloop",
                    _ => "end",
                };
                used = 2;
            }
            match (word, self.open) {
                ("solid", Open::Nothing) => {
                    self.solids += 1;
                    self.open = Open::Solid;
                    return self.name(&words[used..]);
                }
                ("endsolid", Open::Solid) => {
                    self.open = Open::Nothing;
                    return self.name(&words[used..]);
                }
                ("facet", Open::Solid) => {
                    used = self.normal(words)?;
                    self.open = Open::Facet;
                }
                ("outer", Open::Facet) if words.get(1).is_some_and(|word| word.eq_ignore_ascii_case("loop")) => {
                    used = 2;
                    self.open = Open::Loop;
                }
                ("vertex", Open::Loop) => {
                    let corner = point(words[1..].iter().copied(), self.line)?;
                    self.corners.push(corner);
                    used = 4;
                }
                ("endloop", Open::Loop) => {
                    self.open = Open::FacetEnd;
                }
                ("endfacet", Open::FacetEnd) => {
                    self.facets += 1;
                    let found = self.corners.len() + 3 - 3 * self.facets;
                    if found != 3 {
                        return Err(format!(
                            "line {}: the facet that ends here has {found} corners, expected 3",
                            self.line
                        ));
                    }
                    self.open = Open::Solid;
                }
                _ => return Err(self.unexpected(first)),
            }
            words = &words[used..];
        }
        Ok(())
    }

    /// Number of words of a `facet`, with its normal, which may be no number.
    fn normal(&self, words: &[&str]) -> Result<usize, String> {
        let is = |k: usize, word: &str| words.get(k).is_some_and(|found| found.eq_ignore_ascii_case(word));
        match words.len() {
            1 => Ok(1),
            5.. if is(1, "normal")
                && !words[2..5]
                    .iter()
                    .any(|word| KEYWORDS.contains(&word.to_ascii_lowercase().as_str())) =>
            {
                Ok(5)
            }
            _ => Err(format!(
                "line {}: expected 'facet normal' with three numbers",
                self.line
            )),
        }
    }

    /// Refuses a name that holds statements.
    fn name(&self, words: &[&str]) -> Result<(), String> {
        let is_statement = |pair: &[&str]| {
            let [first, second] = [pair[0], pair[1]].map(str::to_ascii_lowercase);
            matches!(
                (first.as_str(), second.as_str()),
                ("facet", "normal") | ("outer", "loop")
            )
        };
        match words.windows(2).any(is_statement) {
            true => Err(format!(
                "line {}: a facet is on the line of 'solid' or 'endsolid'; expected it on a line of its own",
                self.line
            )),
            false => Ok(()),
        }
    }

    fn unexpected(&self, word: &str) -> String {
        let expected = match self.open {
            Open::Nothing => "'solid'",
            Open::Solid => "'facet' or 'endsolid'",
            Open::Facet => "'outer loop'",
            Open::Loop => "'vertex' or 'endloop'",
            Open::FacetEnd => "'endfacet'",
        };
        format!("line {}: found '{word}', expected {expected}", self.line)
    }
}
