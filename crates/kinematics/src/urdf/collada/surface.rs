//! Surfaces of a Collada geometry, in its own frame.

use crate::urdf::collada::document::Element;
use nalgebra::Point3;

/// Elements of a mesh that are surfaces.
const SURFACES: [&str; 5] = ["triangles", "polylist", "polygons", "trifans", "tristrips"];

/// Reads the corners of a geometry's triangles, three each.
pub(crate) fn mesh(geometry: &Element, most: usize) -> Result<Vec<Point3<f64>>, String> {
    let mesh = geometry
        .child("mesh")
        .ok_or("it has no <mesh>; other kinds are not handled")?;
    let vertices = mesh.child("vertices").ok_or("it has no <vertices>")?;
    let points = positions(mesh, vertices)?;
    let mut corners = Vec::new();
    for surface in &mesh.children {
        if !SURFACES.contains(&surface.name.as_str()) {
            continue;
        }
        let of = |detail: String| format!("<{}>: {detail}", surface.name);
        for index in triangles(surface, vertices, most).map_err(of)? {
            let point = points.get(index as usize).copied();
            corners.push(point.ok_or_else(|| of(format!("'{index}' is none of {} vertices", points.len())))?);
        }
        if corners.len() / 3 > most {
            return Err(too_many(most));
        }
    }
    Ok(corners)
}

/// Reads the positions of a mesh's vertices.
fn positions(mesh: &Element, vertices: &Element) -> Result<Vec<Point3<f64>>, String> {
    let mut inputs = vertices.all("input");
    let input = inputs.find(|input| input.attribute("semantic") == Some("POSITION"));
    let input = input.ok_or("its <vertices> have no POSITION")?;
    let source = mesh.all("source").find(|source| source.is_named_by(input, "source"));
    let source = source.ok_or("the <source> of its positions is missing")?;
    let common = source.child("technique_common");
    let accessor = common.and_then(|common| common.child("accessor"));
    let (Some(array), Some(accessor)) = (source.child("float_array"), accessor) else {
        return Err("the <source> of its positions has no <float_array> or no <accessor>".to_owned());
    };
    let names = accessor.all("param").map(|param| param.attribute("name"));
    if !array.is_named_by(accessor, "source") || !names.take(3).eq(["X", "Y", "Z"].map(Some)) {
        return Err("the <accessor> of its positions is not one of X, Y and Z in their <float_array>".to_owned());
    }
    let values = array.numbers::<f64>()?;
    let stated = array.count("count", None)?;
    if stated != values.len() {
        return Err(format!(
            "{stated} numbers are stated; its positions have {}",
            values.len()
        ));
    }
    let [offset, stride] = [accessor.count("offset", Some(0))?, accessor.count("stride", Some(1))?];
    let count = accessor.count("count", None)?;
    let used = values.get(offset..).unwrap_or_default();
    if stride < 3 || count > used.len() / stride {
        return Err(format!(
            "{count} positions of {stride} numbers each are not in its {stated} numbers"
        ));
    }
    let points = used.chunks_exact(stride).take(count);
    Ok(points.map(|p| Point3::new(p[0], p[1], p[2])).collect())
}

/// Reads the triangles of a surface as indices of vertices, three each. Faces with more corners are fans.
fn triangles(surface: &Element, vertices: &Element, most: usize) -> Result<Vec<u32>, String> {
    if surface.child("ph").is_some() {
        return Err("faces with holes are not handled".to_owned());
    }
    // A corner has an index for each kind of input.
    let (mut stride, mut offset) = (0, None);
    for input in surface.all("input") {
        let at = input.count("offset", None)?;
        stride = stride.max(at.saturating_add(1));
        if input.attribute("semantic") == Some("VERTEX") && vertices.is_named_by(input, "source") {
            offset = Some(at);
        }
    }
    let offset = offset.ok_or("it has no VERTEX that is <vertices> of its mesh")?;
    let (mut indices, mut sizes) = (Vec::new(), Vec::new());
    for list in surface.all("p") {
        let all = list.numbers::<u32>()?;
        if all.len() % stride != 0 {
            return Err(format!("{} indices are no corners of {stride} each", all.len()));
        }
        sizes.push(all.len() / stride);
        indices.extend(all.into_iter().skip(offset).step_by(stride));
    }
    let stated = surface.count("count", None)?;
    let name = surface.name.as_str();
    match name {
        "triangles" if stated > most => return Err(too_many(most)),
        "triangles" => sizes = vec![3; stated],
        "polylist" => sizes = surface.child("vcount").map_or(Ok(Vec::new()), Element::numbers)?,
        _ => {}
    }
    let corners = sizes.iter().try_fold(0_usize, |sum, size| sum.checked_add(*size));
    let (faces, count) = (sizes.len(), indices.len());
    if faces != stated || corners != Some(count) || sizes.iter().any(|size| *size < 3) {
        return Err(format!(
            "{stated} faces are stated; its {count} corners are not {faces} faces of 3 and more"
        ));
    }
    // A face has two triangles fewer than corners.
    if count - 2 * faces > most {
        return Err(too_many(most));
    }
    let (mut rest, mut triangles) = (indices.as_slice(), Vec::new());
    for size in sizes {
        let (face, after) = rest.split_at(size);
        rest = after;
        for k in 2..size {
            triangles.extend(match (name, k % 2) {
                ("tristrips", 0) => [face[k - 2], face[k - 1], face[k]],
                ("tristrips", _) => [face[k - 1], face[k - 2], face[k]],
                _ => [face[0], face[k - 1], face[k]],
            });
        }
    }
    Ok(triangles)
}

pub(crate) fn too_many(most: usize) -> String {
    format!("it has more than {most} triangles")
}
