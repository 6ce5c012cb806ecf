//! Collision meshes: found through package folders, read as vertices (their convex hull is what counts).

use super::error::UrdfError;
use super::numbers::length;
use super::{file, vertices};
use nalgebra::Point3;
use std::path::{Path, PathBuf};

/// Longest mesh file that is read \[bytes\].
const MAX_BYTES: u64 = 64 << 20;

/// Where mesh files are looked for.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct MeshSource {
    package_paths: Vec<PathBuf>,
    urdf_folder: Option<PathBuf>,
}

impl MeshSource {
    /// No folder at all: descriptions without meshes still load.
    #[must_use]
    pub fn none() -> Self {
        Self::default()
    }

    /// Looks for `package://NAME/…` in each folder (as `FOLDER/NAME/…`, or `FOLDER/…` when the folder is
    /// called NAME), and for relative files beside the URDF.
    #[must_use]
    pub fn new(package_paths: &[PathBuf], urdf_folder: Option<&Path>) -> Self {
        Self {
            package_paths: package_paths.to_vec(),
            urdf_folder: urdf_folder.map(Path::to_path_buf),
        }
    }

    /// The scaled vertices of a mesh file.
    pub(super) fn load(&self, link: &str, name: &str, scale: [f64; 3]) -> Result<Vec<Point3<f64>>, UrdfError> {
        let path = self.find(link, name)?;
        let wrong = |detail: String| UrdfError::Mesh {
            link: link.to_owned(),
            file: path.display().to_string(),
            detail,
        };
        if !scale.iter().all(|s| s.is_finite() && *s != 0.0) {
            return Err(wrong(format!("its scale {scale:?} must be finite and not zero")));
        }
        let bytes = file::read_bytes(&path, MAX_BYTES).map_err(|e| wrong(e.to_string()))?;
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
        let mut points = match extension.to_lowercase().as_str() {
            "stl" => vertices::stl(&bytes),
            "obj" => vertices::obj(&bytes),
            other => Err(format!("format '{other}' is not handled; convert it to STL or OBJ")),
        }
        .map_err(wrong)?;
        for point in &mut points {
            *point = Point3::new(point.x * scale[0], point.y * scale[1], point.z * scale[2]);
            length(&format!("link '{link}'"), "mesh vertex", point.coords.as_slice())?;
        }
        if points.len() < 4 {
            return Err(wrong(format!(
                "it has {} vertices; a hull needs at least 4",
                points.len()
            )));
        }
        Ok(points)
    }

    fn find(&self, link: &str, file: &str) -> Result<PathBuf, UrdfError> {
        let candidates = self.candidates(file);
        candidates
            .iter()
            .find(|path| path.is_file())
            .cloned()
            .ok_or_else(|| UrdfError::MeshNotFound {
                link: link.to_owned(),
                file: file.to_owned(),
                searched: candidates.iter().map(|path| path.display().to_string()).collect(),
            })
    }

    fn candidates(&self, file: &str) -> Vec<PathBuf> {
        if let Some(inside) = file.strip_prefix("package://") {
            let (package, rest) = inside.split_once('/').unwrap_or((inside, ""));
            let place = |folder: &PathBuf| {
                let named = folder.file_name().is_some_and(|name| name == package);
                [Some(folder.join(inside)), named.then(|| folder.join(rest))]
            };
            return self.package_paths.iter().flat_map(place).flatten().collect();
        }
        let path = Path::new(file.strip_prefix("file://").unwrap_or(file));
        match &self.urdf_folder {
            Some(folder) if path.is_relative() => vec![folder.join(path)],
            _ => vec![path.to_path_buf()],
        }
    }
}
