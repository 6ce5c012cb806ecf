//! Vertices of STL and OBJ files. Their convex hull is what counts, so faces, normals and materials are not
//! read; what could make the hull smaller than the part (a cut file, a wrong count) is refused.

use nalgebra::Point3;
use std::collections::BTreeSet;

/// The vertices, or what is wrong with the file.
type Vertices = Result<Vec<Point3<f64>>, String>;

/// Header, count, then 50 bytes a triangle.
const BINARY_HEADER: usize = 80;
const BINARY_START: usize = 84;
const BINARY_TRIANGLE: usize = 50;

/// Vertices of a binary or ASCII STL file, each once.
///
/// Some programs begin the header of a binary file with `solid`, like an ASCII file: the length decides.
pub(super) fn stl(bytes: &[u8]) -> Vertices {
    let stated = bytes
        .get(BINARY_HEADER..BINARY_START)
        .map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as usize);
    let exact = stated
        .and_then(|count| count.checked_mul(BINARY_TRIANGLE))
        .is_some_and(|length| bytes.len() - BINARY_START == length);
    let solid = bytes.trim_ascii_start().starts_with(b"solid");
    match stated {
        _ if solid && !exact => ascii_stl(&String::from_utf8_lossy(bytes)),
        Some(count) => binary_stl(&bytes[BINARY_START..], count),
        None => Err(format!("{} bytes are too few for an STL file", bytes.len())),
    }
}

fn binary_stl(data: &[u8], count: usize) -> Vertices {
    let triangles = data.len() / BINARY_TRIANGLE;
    if triangles != count {
        return Err(format!("it states {count} triangles and holds {triangles}"));
    }
    let number = |b: &[u8]| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    let corner = |b: &[u8]| Point3::new(number(&b[0..4]), number(&b[4..8]), number(&b[8..12]));
    let triangles = data.chunks_exact(BINARY_TRIANGLE);
    // A triangle: normal (12 bytes), three corners (36 bytes), two bytes more.
    Ok(distinct(triangles.flat_map(|t| t[12..48].chunks_exact(12).map(corner))))
}

fn ascii_stl(text: &str) -> Vertices {
    let mut points = Vec::new();
    let mut closed = false;
    for (index, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("vertex") => points.push(point(words, index)?),
            Some(first) => closed = first == "endsolid",
            None => {}
        }
    }
    if !closed || points.len() % 3 != 0 {
        return Err("the file is cut off: it does not end with 'endsolid'".to_owned());
    }
    Ok(distinct(points.into_iter()))
}

/// Vertices of an OBJ file, used by a face or not, each once.
pub(super) fn obj(bytes: &[u8]) -> Vertices {
    let text = String::from_utf8_lossy(bytes);
    let vertex = |(index, line): (usize, &str)| {
        let mut words = line.split_whitespace();
        (words.next() == Some("v")).then(|| point(words, index))
    };
    let points: Vec<_> = text.lines().enumerate().filter_map(vertex).collect::<Result<_, _>>()?;
    Ok(distinct(points.into_iter()))
}

/// Three numbers of a line, counted from 0; more may follow (OBJ has weights and colours).
fn point<'a>(mut words: impl Iterator<Item = &'a str>, line: usize) -> Result<Point3<f64>, String> {
    let mut number = || {
        let word = words.next().unwrap_or_default();
        word.parse::<f64>()
            .map_err(|_| format!("line {}: '{word}' is not a coordinate", line + 1))
    };
    Ok(Point3::new(number()?, number()?, number()?))
}

fn distinct(points: impl Iterator<Item = Point3<f64>>) -> Vec<Point3<f64>> {
    let mut seen = BTreeSet::new();
    points
        .filter(|p| seen.insert([p.x, p.y, p.z].map(f64::to_bits)))
        .collect()
}
