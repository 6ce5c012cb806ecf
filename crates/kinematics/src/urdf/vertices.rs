//! Vertices of STL and OBJ files. Their convex hull is what counts, so faces, normals and materials are not
//! read; what could make the hull smaller than the part (a cut file, a wrong count) is refused.

use super::triangles;
use nalgebra::Point3;
use std::collections::BTreeSet;

/// The vertices, or what is wrong with the file.
type Vertices = Result<Vec<Point3<f64>>, String>;

/// Vertices of a binary or ASCII STL file, each once.
pub(super) fn stl(bytes: &[u8]) -> Vertices {
    Ok(distinct(triangles::stl(bytes)?.into_iter()))
}

/// Vertices of an OBJ file, used by a face or not, each once.
pub(super) fn obj(bytes: &[u8]) -> Vertices {
    let text = String::from_utf8_lossy(bytes);
    let vertex = |(index, line): (usize, &str)| {
        let mut words = line.split_whitespace();
        (words.next() == Some("v")).then(|| triangles::point(words, index))
    };
    let points: Vec<_> = text.lines().enumerate().filter_map(vertex).collect::<Result<_, _>>()?;
    Ok(distinct(points.into_iter()))
}

fn distinct(points: impl Iterator<Item = Point3<f64>>) -> Vec<Point3<f64>> {
    let mut seen = BTreeSet::new();
    points
        .filter(|p| seen.insert([p.x, p.y, p.z].map(f64::to_bits)))
        .collect()
}
