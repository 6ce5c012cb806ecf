//! Vertices and triangles of OBJ files.
//!
//! Known not to matter: comments, normals and places in textures, materials, names of groups and objects, smoothing, and lines and single
//! points, which have no surface. Free-form surfaces, further files and unknown words are refused with their line: they may be a part of the body.

use crate::urdf::mesh_text::{point, text, words};
use nalgebra::Point3;

/// Words that begin lines that do not matter.
const WITHOUT_BODY: [&str; 18] = [
    "vt",
    "vn",
    "vp",
    "g",
    "o",
    "s",
    "mg",
    "usemtl",
    "mtllib",
    "usemap",
    "maplib",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "l",
    "p",
];

/// Words that begin lines of free-form curves and surfaces, and of other files.
const NOT_HANDLED: [&str; 22] = [
    "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim", "hole", "scrv", "sp", "end", "con",
    "ctech", "stech", "bsp", "bzp", "cdc", "cdp", "res", "call",
];

/// Line of an OBJ file that has a body: its words behind the first one, and its number.
enum Line<'t> {
    Vertex(Vec<&'t str>, usize),
    Face(Vec<&'t str>, usize),
}

/// Shows the lines that have a body until `see` returns false.
fn each_line(bytes: &[u8], mut see: impl FnMut(Line<'_>) -> Result<bool, String>) -> Result<(), String> {
    let text = text(bytes)?;
    let mut lines = (1..).zip(text.lines());
    while let Some((number, line)) = lines.next() {
        let mut line = line.to_owned();
        // A backslash at its end joins the next line.
        while line.ends_with('\\') {
            line.pop();
            line.push(' ');
            line.push_str(lines.next().map_or("", |(_, more)| more));
        }
        let line = line.split('#').next().unwrap_or_default();
        let mut words = words(line);
        let Some(first) = words.next() else { continue };
        let more = match first {
            "v" => see(Line::Vertex(words.collect(), number))?,
            // `fo` is an older word for `f`.
            "f" | "fo" => see(Line::Face(words.collect(), number))?,
            word if WITHOUT_BODY.contains(&word) => true,
            word if NOT_HANDLED.contains(&word) => {
                return Err(format!(
                    "line {number}: '{word}' (free-form surfaces, further files) is not handled; export triangles"
                ));
            }
            word => {
                return Err(format!(
                    "line {number}: '{word}' is no word of an OBJ file; expected v, f, vn, vt, g, o, s, usemtl, …"
                ));
            }
        };
        if !more {
            break;
        }
    }
    Ok(())
}

/// Reads the corners of the faces, three per triangle; a face with more corners is a fan about its first one. Reading stops once there are
/// more than `most` triangles.
///
/// # Errors
/// The reason, with its line.
pub(crate) fn corners(bytes: &[u8], most: usize) -> Result<Vec<Point3<f64>>, String> {
    let mut vertices = Vec::new();
    let mut corners = Vec::new();
    each_line(bytes, |line| {
        match line {
            Line::Vertex(words, number) => vertices.push(point(words.into_iter(), number)?),
            Line::Face(words, number) => {
                let face = words.iter().map(|word| vertex(word, &vertices, number));
                let face: Vec<_> = face.collect::<Result<_, _>>()?;
                if face.len() < 3 {
                    return Err(format!(
                        "line {number}: a face has {} corners; expected 3 or more",
                        face.len()
                    ));
                }
                let fan = face[1..].windows(2).map(|edge| [face[0], edge[0], edge[1]]);
                // One more than is shown, so that it is seen that there are more.
                corners.extend(fan.take(most + 1).flatten());
            }
        }
        Ok(corners.len() <= 3 * most)
    })?;
    Ok(corners)
}

/// Reads the vertices, used by a face or not.
///
/// # Errors
/// The reason, with its line.
pub(crate) fn vertices(bytes: &[u8]) -> Result<Vec<Point3<f64>>, String> {
    let mut vertices = Vec::new();
    each_line(bytes, |line| {
        if let Line::Vertex(words, number) = line {
            vertices.push(point(words.into_iter(), number)?);
        }
        Ok(true)
    })?;
    Ok(vertices)
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
        format!("line {line}: '{word}' is none of the {count} vertices before it")
    })
}
