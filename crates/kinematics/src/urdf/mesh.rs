//! Meshes: found through package folders; those that can touch are read as vertices (their convex hull is what counts), those that
//! are looked at as triangles.

use super::error::UrdfError;
use super::numbers::length;
use super::{file, triangles, vertices};
use crate::geometry::Triangle;
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

    /// The scaled vertices of a mesh file, each once.
    pub(super) fn vertices(&self, link: &str, name: &str, scale: [f64; 3]) -> Result<Vec<Point3<f64>>, UrdfError> {
        let file = self.read(link, name, scale)?;
        let points = match file.format()? {
            Format::Stl => vertices::stl(&file.bytes),
            Format::Obj => vertices::obj(&file.bytes),
        };
        let points = file.scaled(points.map_err(|detail| file.wrong(detail))?)?;
        if points.len() < 4 {
            let count = points.len();
            return Err(file.wrong(format!("it has {count} vertices; a hull needs at least 4")));
        }
        Ok(points)
    }

    /// The scaled triangles of a mesh file, three corners each; no more than `most`.
    pub(super) fn triangles(
        &self,
        link: &str,
        name: &str,
        scale: [f64; 3],
        most: usize,
    ) -> Result<Vec<Triangle>, UrdfError> {
        let file = self.read(link, name, scale)?;
        let corners = match file.format()? {
            Format::Stl => triangles::stl(&file.bytes),
            Format::Obj => triangles::obj(&file.bytes, most),
        };
        let corners = corners.map_err(|detail| file.wrong(detail))?;
        let count = corners.len() / 3;
        if count == 0 || count > most {
            let detail = format!("it has {count} triangles; from 1 to {most} are shown");
            return Err(file.wrong(detail));
        }
        let corners = file.scaled(corners)?;
        // A mirrored part keeps its outside.
        let mirrored = scale.iter().filter(|s| **s < 0.0).count() % 2 == 1;
        let triangle = |t: &[Point3<f64>]| {
            let order = if mirrored { [0, 2, 1] } else { [0, 1, 2] };
            order.map(|k| t[k].cast::<f32>())
        };
        Ok(corners.chunks_exact(3).map(triangle).collect())
    }

    /// A mesh file, with its scale.
    fn read(&self, link: &str, name: &str, scale: [f64; 3]) -> Result<MeshFile, UrdfError> {
        let path = self.find(link, name)?;
        let mut file = MeshFile {
            link: link.to_owned(),
            path,
            scale,
            bytes: Vec::new(),
        };
        if !scale.iter().all(|s| s.is_finite() && *s != 0.0) {
            return Err(file.wrong(format!("its scale {scale:?} must be finite and not zero")));
        }
        // What cannot be read anyway is not read at all.
        file.format()?;
        file.bytes = file::read_bytes(&file.path, MAX_BYTES).map_err(|e| file.wrong(e.to_string()))?;
        Ok(file)
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

/// Formats of meshes. Collada is none of them: the readers that there are panic at a wrong index, and put parts elsewhere than the
/// file's nodes say.
enum Format {
    Stl,
    Obj,
}

/// A mesh file that was found.
struct MeshFile {
    link: String,
    path: PathBuf,
    scale: [f64; 3],
    bytes: Vec<u8>,
}

impl MeshFile {
    fn wrong(&self, detail: String) -> UrdfError {
        UrdfError::Mesh {
            link: self.link.clone(),
            file: self.path.display().to_string(),
            detail,
        }
    }

    fn format(&self) -> Result<Format, UrdfError> {
        let extension = self.path.extension().and_then(|e| e.to_str()).unwrap_or_default();
        match extension.to_lowercase().as_str() {
            "stl" => Ok(Format::Stl),
            "obj" => Ok(Format::Obj),
            other => Err(self.wrong(format!("format '{other}' is not handled; convert it to STL or OBJ"))),
        }
    }

    fn scaled(&self, mut points: Vec<Point3<f64>>) -> Result<Vec<Point3<f64>>, UrdfError> {
        let [x, y, z] = self.scale;
        let at = format!("link '{}'", self.link);
        for point in &mut points {
            *point = Point3::new(point.x * x, point.y * y, point.z * z);
            length(&at, "mesh vertex", point.coords.as_slice())?;
        }
        Ok(points)
    }
}
