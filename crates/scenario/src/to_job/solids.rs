//! Meshes as convex bodies and as plates, cut and fitted once: a scenario is resolved again and again, for every seed of a sweep and every move on a page.

use crate::body_error::BodyFault;
use crate::cache::Cache;
use crate::measured::{self, FaceSide, MeasuredError, MeasuredPlate, Unit};
use nalgebra::Point3;
use platewash_bodies::clearance::{SolidError, SolidParts, excess_m, solid_parts};
use platewash_kinematics::fingerprint::sha256_hex;
use platewash_kinematics::urdf::{MeshSource, MeshSplitter};
use std::path::Path;
use std::sync::Arc;

/// Meshes that are kept.
const KEPT: usize = 64;

/// The corners of the convex parts of a mesh \[m\].
pub(crate) type Hulls = Arc<Vec<Vec<Point3<f64>>>>;

/// Cache of the convex parts of meshes that were cut before, and of the plates that were fitted, by their triangles. The files are read each time, so that a changed
/// one takes effect at once. Clones share the cache; it decides nothing, and all caches are equal.
#[derive(Debug, Clone, Default)]
pub struct Solids {
    hulls: Cache<String, Hulls, KEPT>,
    plates: Cache<String, MeasuredPlate, KEPT>,
}

impl PartialEq for Solids {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Solids {
    /// The convex parts of the mesh in a file, scaled.
    pub(crate) fn parts(
        &self,
        source: &MeshSource,
        file: &Path,
        scale: Option<[f64; 3]>,
        parts: SolidParts,
    ) -> Result<Hulls, BodyFault> {
        let triangles = source.solid(&file.to_string_lossy(), scale).map_err(BodyFault::Mesh)?;
        self.cut(&triangles, parts).map_err(|why| BodyFault::Solid {
            file: file.display().to_string(),
            why,
        })
    }

    /// The convex parts of a mesh.
    fn cut(&self, triangles: &[[Point3<f64>; 3]], parts: SolidParts) -> Result<Hulls, SolidError> {
        let kind = match parts {
            SolidParts::Hull => "hull",
            SolidParts::Decomposed => "decomposed",
            SolidParts::Few => "few",
        };
        let made = || solid_parts(triangles, parts).map(Arc::new);
        self.hulls.get_or_make(id(triangles, kind), made)
    }

    /// The plate of a mesh, in the unit and with the face stated.
    pub(crate) fn plate(
        &self,
        triangles: &[[Point3<f64>; 3]],
        unit: Option<Unit>,
        face: Option<FaceSide>,
    ) -> Result<MeasuredPlate, MeasuredError> {
        let stated = format!("{}{}", unit.map_or("", Unit::name), face.map_or("", FaceSide::name));
        let made = || measured::from_mesh(triangles, unit, face);
        self.plates.get_or_make(id(triangles, &stated), made)
    }

    /// Upper bound on how far the convex parts of a mesh reach beyond it \[m\]; `None` where there are none.
    pub(crate) fn excess_m(
        &self,
        source: &MeshSource,
        file: &Path,
        scale: Option<[f64; 3]>,
        parts: SolidParts,
    ) -> Option<f64> {
        let triangles = source.solid(&file.to_string_lossy(), scale).ok()?;
        let hulls = self.parts(source, file, scale, parts).ok()?;
        Some(excess_m(&triangles, &hulls))
    }
}

impl MeshSplitter for Solids {
    fn split(&self, triangles: &[[Point3<f64>; 3]]) -> Result<Vec<Vec<Point3<f64>>>, String> {
        let parts = self.cut(triangles, SolidParts::Few);
        parts.map(|parts| parts.to_vec()).map_err(|why| why.to_string())
    }
}

/// Key of what is made of a mesh: its triangles, and a word for what it is.
fn id(triangles: &[[Point3<f64>; 3]], kind: &str) -> String {
    let numbers = triangles.iter().flatten().flat_map(|corner| corner.iter().copied());
    let bytes = numbers.flat_map(f64::to_le_bytes);
    sha256_hex(&bytes.chain(kind.bytes()).collect::<Vec<u8>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

    #[test]
    fn a_mesh_is_decomposed_once_until_it_changes() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.obj");
        std::fs::write(&file, TETRAHEDRON).unwrap();
        let (solids, source) = (Solids::default(), MeshSource::none());
        let parts = |of: &Solids, scale: f64, parts| of.parts(&source, &file, Some([scale; 3]), parts).unwrap();
        let first = parts(&solids, 1.0, SolidParts::Hull);
        assert!(Arc::ptr_eq(&first, &parts(&solids.clone(), 1.0, SolidParts::Hull)));
        assert_eq!(first, parts(&Solids::default(), 1.0, SolidParts::Hull));
        assert!(!Arc::ptr_eq(&first, &parts(&solids, 1.0, SolidParts::Decomposed)));
        assert_ne!(first, parts(&solids, 2.0, SolidParts::Hull));
        // Of the same length, and perhaps within the same tick of the file system's clock.
        std::fs::write(&file, TETRAHEDRON.replace("v 0 0 1", "v 0 0 3")).unwrap();
        let second = parts(&solids, 1.0, SolidParts::Hull);
        assert_ne!(first, second);
        assert_eq!(second, parts(&Solids::default(), 1.0, SolidParts::Hull));
    }
}
