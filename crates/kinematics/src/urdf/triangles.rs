//! Triangles of STL and OBJ files, as corners in a row (Collada: `collada.rs`). Errors that could leave a part out (a cut file, a wrong count, an index of no
//! vertex) are refused; normals, textures and materials are not read.

use nalgebra::Point3;

/// Corners, three per triangle, or the error in the file.
type Corners = Result<Vec<Point3<f64>>, String>;

/// Header, count, then 50 bytes a triangle.
const BINARY_HEADER: usize = 80;
const BINARY_START: usize = 84;
const BINARY_TRIANGLE: usize = 50;

/// Reads the corners of the triangles of a binary or ASCII STL file, three each.
///
/// Some programs begin the header of a binary file with `solid`, like an ASCII file: the length decides.
pub(crate) fn stl(bytes: &[u8]) -> Corners {
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

fn binary_stl(data: &[u8], count: usize) -> Corners {
    let triangles = data.len() / BINARY_TRIANGLE;
    if triangles != count {
        return Err(format!("it states {count} triangles and holds {triangles}"));
    }
    let number = |b: &[u8]| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    let corner = |b: &[u8]| Point3::new(number(&b[0..4]), number(&b[4..8]), number(&b[8..12]));
    let triangles = data.chunks_exact(BINARY_TRIANGLE);
    // A triangle: normal (12 bytes), three corners (36 bytes), two bytes more.
    Ok(triangles.flat_map(|t| t[12..48].chunks_exact(12).map(corner)).collect())
}

fn ascii_stl(text: &str) -> Corners {
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
    Ok(points)
}

/// Reads the corners of the faces of an OBJ file, three per triangle; a face with more corners is a fan about its first one. Reading stops
/// once there are more than `most` triangles.
pub(crate) fn obj(bytes: &[u8], most: usize) -> Corners {
    let text = String::from_utf8_lossy(bytes);
    let mut vertices = Vec::new();
    let mut corners = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => vertices.push(point(words, index)?),
            Some("f") => {
                let face = words.map(|word| vertex(word, &vertices, index));
                let face: Vec<_> = face.collect::<Result<_, _>>()?;
                let fan = face
                    .get(1..)
                    .unwrap_or_default()
                    .windows(2)
                    .map(|edge| [face[0], edge[0], edge[1]]);
                // One more than is shown, so that it is seen that there are more.
                corners.extend(fan.take(most + 1).flatten());
            }
            _ => {}
        }
        if corners.len() > 3 * most {
            break;
        }
    }
    Ok(corners)
}

/// Returns the vertex of a face's corner, given by its index from 1, or from the last one backwards as a negative number; more may follow
/// after a slash.
fn vertex(word: &str, vertices: &[Point3<f64>], line: usize) -> Result<Point3<f64>, String> {
    let index = word.split('/').next().and_then(|index| index.parse::<i64>().ok());
    let from_1 = match index {
        Some(back) if back < 0 => back.checked_add(vertices.len() as i64 + 1),
        index => index,
    };
    let at = from_1.and_then(|from_1| usize::try_from(from_1).ok()?.checked_sub(1));
    at.and_then(|at| vertices.get(at)).copied().ok_or_else(|| {
        let count = vertices.len();
        format!("line {}: '{word}' is none of the {count} vertices before it", line + 1)
    })
}

/// Reads three numbers of a line, counted from 0; more may follow (OBJ has weights and colours).
pub(crate) fn point<'a>(mut words: impl Iterator<Item = &'a str>, line: usize) -> Result<Point3<f64>, String> {
    let mut number = || {
        let word = words.next().unwrap_or_default();
        word.parse::<f64>()
            .map_err(|_| format!("line {}: '{word}' is not a coordinate", line + 1))
    };
    Ok(Point3::new(number()?, number()?, number()?))
}
