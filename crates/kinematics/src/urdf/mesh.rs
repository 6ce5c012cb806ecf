//! Meshes, found through package folders. Collision meshes are read as vertices (their convex hull counts), visuals and meshes whose
//! surface counts as triangles.
//!
//! Normals and materials are not read; errors that could make the hull smaller than the part (a cut file, a wrong count) are refused.

use crate::geometry::{Shape, Triangle};
use crate::urdf::collada;
use crate::urdf::error::UrdfError;
use crate::urdf::files::Files;
use crate::urdf::tree::{LARGEST_LENGTH_M, length};
use crate::urdf::{obj, stl};
use nalgebra::Point3;
use percent_encoding::percent_decode_str;
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::fmt::Debug;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Greatest length of a mesh file \[bytes\].
const MAX_BYTES: u64 = 64 << 20;

/// Greatest number of triangles of a Collada mesh whose hull counts: its parts may be shown many times.
const MAX_HULL: usize = 2_000_000;

/// Greatest number of triangles of a mesh whose surface counts.
const MAX_SOLID: usize = 200_000;

/// Greatest length of the mesh file of a measured body \[bytes\], and greatest number of its triangles: scans are fine.
const MAX_SCAN_BYTES: u64 = 256 << 20;
const MAX_SCAN: usize = 2_000_000;

/// Greatest length of a package's manifest, `package.xml` \[bytes\].
const MAX_MANIFEST: u64 = 1 << 20;

/// Number of folders above the working folder in which packages are looked for.
const LEVELS_ABOVE: usize = 6;

/// Cuts meshes into convex parts.
pub trait MeshSplitter: Debug + Send + Sync {
    /// Returns the corners of convex parts that together enclose the triangles \[m\].
    ///
    /// # Errors
    /// Reason that the triangles have no such parts.
    fn split(&self, triangles: &[[Point3<f64>; 3]]) -> Result<Vec<Vec<Point3<f64>>>, String>;
}

/// Triangles of a measured body.
#[derive(Debug, Clone, PartialEq)]
pub struct Scan {
    /// Corners of the triangles, in the order of the file: in metres if it states its unit, otherwise in a unit that is not known.
    pub triangles: Vec<[Point3<f64>; 3]>,
    /// Unit that the file states \[m\]; Collada files can.
    pub unit_m: Option<f64>,
}

/// Folders in which mesh files are looked for, and what becomes of the meshes.
#[derive(Debug, Clone, Default)]
pub struct MeshSource {
    package_paths: Vec<PathBuf>,
    urdf_folder: Option<PathBuf>,
    files: Files,
    visual_shapes: bool,
    split_links: Vec<String>,
    splitter: Option<Arc<dyn MeshSplitter>>,
}

impl MeshSource {
    /// Returns a source without folders: descriptions without meshes still load.
    #[must_use]
    pub fn none() -> Self {
        Self::default()
    }

    /// Looks for `package://NAME/…` in each folder (as `FOLDER/NAME/…`, or `FOLDER/…` when the folder is called NAME), then in the
    /// folders above the URDF (`ABOVE/NAME/…`, or `ABOVE/…` where `ABOVE/package.xml` states the name), then where the
    /// [source](Self::reading) has packages installed; and for relative files beside the URDF.
    #[must_use]
    pub fn new(package_paths: &[PathBuf], urdf_folder: Option<&Path>) -> Self {
        Self {
            package_paths: package_paths.to_vec(),
            urdf_folder: urdf_folder.map(Path::to_path_buf),
            ..Self::default()
        }
    }

    /// Returns the source for descriptions whose links without collision shapes take their visuals, meshes as convex hulls, as such.
    #[must_use]
    pub fn with_visual_shapes(self, visual_shapes: bool) -> Self {
        Self { visual_shapes, ..self }
    }

    /// True where links without collision shapes take their visuals as such.
    pub(crate) fn takes_visual_shapes(&self) -> bool {
        self.visual_shapes
    }

    /// Returns the source for descriptions of which some links count as convex parts that enclose their meshes, and not as the meshes'
    /// convex hulls.
    #[must_use]
    pub fn with_split_links(self, links: &[String], splitter: Arc<dyn MeshSplitter>) -> Self {
        Self {
            split_links: links.to_vec(),
            splitter: Some(splitter),
            ..self
        }
    }

    /// Names of the links whose meshes are cut into parts.
    pub(crate) fn split_links(&self) -> &[String] {
        &self.split_links
    }

    /// Returns the shapes of a link's mesh: its hull, or its parts.
    pub(crate) fn shapes(&self, link: &str, name: &str, scale: [f64; 3]) -> Result<Vec<Shape>, UrdfError> {
        let is_split = self.split_links.iter().any(|split| split == link);
        let Some(splitter) = self.splitter.as_ref().filter(|_| is_split) else {
            let points = self.vertices(link, name, scale)?;
            return Ok(vec![Shape::Hull { points }]);
        };
        let triangles = self.open(name, scale, MAX_BYTES).and_then(|file| file.solid());
        let triangles = triangles.map_err(|error| error.at_link(link))?;
        let parts = splitter.split(&triangles).map_err(|why| UrdfError::Split {
            link: link.to_owned(),
            why: format!("mesh '{name}': {why}"),
        })?;
        Ok(parts.into_iter().map(|points| Shape::Hull { points }).collect())
    }

    /// Returns the source with files from elsewhere than the disk.
    #[must_use]
    pub fn reading(self, files: &Files) -> Self {
        Self {
            files: files.clone(),
            ..self
        }
    }

    /// Returns the scaled vertices of a mesh file, each once \[m\].
    pub(crate) fn vertices(&self, link: &str, name: &str, scale: [f64; 3]) -> Result<Vec<Point3<f64>>, UrdfError> {
        let of = |error: MeshError| error.at_link(link);
        let file = self.open(name, scale, MAX_BYTES).map_err(of)?;
        let points = match file.format().map_err(of)? {
            // Used by a face or not.
            Format::Obj => obj::vertices(&file.bytes).map_err(|detail| file.wrong(detail)),
            Format::Stl | Format::Collada => file.all_corners(MAX_HULL),
        };
        let points = file.scaled_of(link, distinct(points.map_err(of)?))?;
        if points.len() < 4 {
            let count = points.len();
            return Err(of(
                file.wrong(format!("it has {count} vertices; a hull needs at least 4"))
            ));
        }
        Ok(points)
    }

    /// Returns the scaled triangles of a mesh file, three corners each \[m\], no more than `most`.
    pub(crate) fn triangles(
        &self,
        link: &str,
        name: &str,
        scale: [f64; 3],
        most: usize,
    ) -> Result<Vec<Triangle>, UrdfError> {
        let of = |error: MeshError| error.at_link(link);
        let file = self.open(name, scale, MAX_BYTES).map_err(of)?;
        let corners = file.all_corners(most).map_err(of)?;
        let count = corners.len() / 3;
        if count == 0 || count > most {
            let detail = format!("it has {count} triangles; from 1 to {most} are shown");
            return Err(of(file.wrong(detail)));
        }
        let corners = file.scaled_of(link, corners)?;
        // A mirrored part keeps its outside.
        let mirrored = scale.iter().filter(|s| **s < 0.0).count() % 2 == 1;
        let triangle = |t: &[Point3<f64>]| {
            let order = if mirrored { [0, 2, 1] } else { [0, 1, 2] };
            order.map(|k| t[k].cast::<f32>())
        };
        Ok(corners.chunks_exact(3).map(triangle).collect())
    }

    /// Returns the triangles of a mesh file \[m\], three corners each, in the order of the file: those of a mirrored part are seen from inside.
    /// Without a scale they are in the unit that the file states, or in metres.
    ///
    /// # Errors
    /// [`MeshError`]: the file is not found, not STL, OBJ or Collada, damaged, has no triangles or too many, or coordinates that are not lengths;
    /// or it states its unit, and there is a scale, too.
    pub fn solid(&self, name: &str, scale: Option<[f64; 3]>) -> Result<Vec<[Point3<f64>; 3]>, MeshError> {
        let file = self.open(name, scale.unwrap_or([1.0; 3]), MAX_BYTES)?;
        if let (Some(scale), Some(unit_m)) = (scale, file.unit_m()?.filter(|unit_m| *unit_m != 1.0)) {
            return Err(file.wrong(format!(
                "it states its unit, {unit_m} m, and the scale {scale:?} is stated, too: leave out mesh_scale"
            )));
        }
        file.solid()
    }

    /// Returns the triangles of a measured body, as they are: up to two million.
    ///
    /// # Errors
    /// [`MeshError`]: the file is not found, not STL, OBJ or Collada, damaged, or has no triangles or too many. Coordinates are not judged.
    pub fn scan(&self, name: &str) -> Result<Scan, MeshError> {
        let file = self.open(name, [1.0; 3], MAX_SCAN_BYTES)?;
        let corners = file.corners(MAX_SCAN, "measured")?;
        Ok(Scan {
            triangles: corners.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
            unit_m: file.unit_m()?,
        })
    }

    /// Reads a mesh file of at most so many bytes, with its scale.
    fn open(&self, name: &str, scale: [f64; 3], most: u64) -> Result<MeshFile, MeshError> {
        let path = self.find(name)?;
        let mut file = MeshFile {
            path,
            scale,
            bytes: Vec::new(),
        };
        if !scale.iter().all(|s| s.is_finite() && *s != 0.0) {
            return Err(file.wrong(format!("its scale {scale:?} must be finite and not zero")));
        }
        // A file that cannot be used is not read at all.
        file.format()?;
        file.bytes = self
            .files
            .read_bytes(&file.path, most)
            .map_err(|e| file.wrong(e.to_string()))?;
        Ok(file)
    }

    /// Finds a file by its name, or by the name with the characters that its percent signs stand for, as in addresses.
    fn find(&self, file: &str) -> Result<PathBuf, MeshError> {
        self.find_as(file)
            .or_else(|missing| match percent_decode_str(file).decode_utf8_lossy() {
                Cow::Owned(decoded) => self.find_as(&decoded).map_err(|_| missing),
                Cow::Borrowed(_) => Err(missing),
            })
    }

    fn find_as(&self, file: &str) -> Result<PathBuf, MeshError> {
        if self.files.are_none() {
            // Reading it says why it is not there.
            return Ok(file.into());
        }
        let is_file = |path: &PathBuf| self.files.is_file(path);
        let shown = |path: PathBuf| path.display().to_string();
        let Some(inside) = file.strip_prefix("package://") else {
            let path = self.beside(file);
            return match is_file(&path) {
                true => Ok(path),
                false => Err(MeshError::NotFound {
                    file: file.to_owned(),
                    searched: vec![shown(path)],
                }),
            };
        };
        let stated = || in_folders(&self.package_paths, inside);
        let installed = || in_folders(self.files.installed(), inside);
        // Folders above are looked at only where the stated ones lack the file.
        let mut candidates = stated().chain(self.above_urdf(inside)).chain(installed());
        candidates.find(is_file).ok_or_else(|| {
            let above = self.urdf_folder.as_ref().map(|folder| {
                let folder = if folder.as_os_str().is_empty() {
                    Path::new(".")
                } else {
                    folder
                };
                format!("{} and the folders above it", folder.display())
            });
            MeshError::NotFound {
                file: file.to_owned(),
                searched: stated().map(shown).chain(above).chain(installed().map(shown)).collect(),
            }
        })
    }

    /// Returns the paths that `NAME/…` may have in the folders above the URDF.
    fn above_urdf(&self, inside: &str) -> impl Iterator<Item = PathBuf> {
        let (package, rest) = inside.split_once('/').unwrap_or((inside, ""));
        let folders = self.urdf_folder.iter().flat_map(|folder| folders_above(folder));
        folders.flat_map(move |above| {
            let named = self.is_package(&above, package).then(|| above.join(rest));
            std::iter::once(above.join(inside)).chain(named)
        })
    }

    /// True where `package.xml` in the folder states the package's name.
    fn is_package(&self, folder: &Path, name: &str) -> bool {
        let manifest = folder.join("package.xml");
        let text = self
            .files
            .is_file(&manifest)
            .then(|| self.files.read_text(&manifest, MAX_MANIFEST));
        let Some(Ok(text)) = text else { return false };
        let stated = text
            .split_once("<name>")
            .and_then(|(_, rest)| rest.split_once("</name>"));
        stated.is_some_and(|(stated, _)| stated.trim() == name)
    }

    fn beside(&self, file: &str) -> PathBuf {
        let path = Path::new(file.strip_prefix("file://").unwrap_or(file));
        match &self.urdf_folder {
            Some(folder) if path.is_relative() => folder.join(path),
            _ => path.to_path_buf(),
        }
    }
}

/// Returns the paths that `NAME/…` may have in folders: `FOLDER/NAME/…`, and `FOLDER/…` where the folder is called NAME.
fn in_folders(folders: &[PathBuf], inside: &str) -> impl Iterator<Item = PathBuf> {
    let (package, rest) = inside.split_once('/').unwrap_or((inside, ""));
    folders.iter().flat_map(move |folder| {
        let is_named = folder.file_name().is_some_and(|name| name == package);
        std::iter::once(folder.join(inside)).chain(is_named.then(|| folder.join(rest)))
    })
}

/// Returns the folder and those above it, as far as its path tells; for a relative one also [`LEVELS_ABOVE`] above the working folder.
fn folders_above(folder: &Path) -> impl Iterator<Item = PathBuf> {
    let levels = if folder.is_absolute() { 0 } else { LEVELS_ABOVE };
    let beyond = (1..=levels).map(|levels| PathBuf::from("../".repeat(levels)));
    folder.ancestors().map(Path::to_path_buf).chain(beyond)
}

/// Formats of meshes.
enum Format {
    Stl,
    Obj,
    Collada,
}

/// Reason that a mesh was not read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// The file was not found.
    #[error("mesh '{file}' was not found; looked for {}", searched_in(.searched))]
    NotFound {
        /// Name as it was asked for.
        file: String,
        /// Places where it was looked for.
        searched: Vec<String>,
    },
    /// The contents of the file are not a valid mesh.
    #[error("mesh '{file}': {detail}")]
    Wrong {
        /// Name of the file.
        file: String,
        /// Reason.
        detail: String,
    },
}

impl MeshError {
    fn at_link(self, link: &str) -> UrdfError {
        let link = link.to_owned();
        match self {
            Self::NotFound { file, searched } => UrdfError::MeshNotFound { link, file, searched },
            Self::Wrong { file, detail } => UrdfError::Mesh { link, file, detail },
        }
    }
}

fn searched_in(places: &[String]) -> String {
    match places {
        [] => "it in no folder: none is given for packages".to_owned(),
        places => places.join(", "),
    }
}

/// Mesh file that was found.
struct MeshFile {
    path: PathBuf,
    scale: [f64; 3],
    bytes: Vec<u8>,
}

impl MeshFile {
    fn wrong(&self, detail: String) -> MeshError {
        MeshError::Wrong {
            file: self.path.display().to_string(),
            detail,
        }
    }

    fn format(&self) -> Result<Format, MeshError> {
        let extension = self.path.extension().and_then(|e| e.to_str()).unwrap_or_default();
        match extension.to_lowercase().as_str() {
            "stl" => Ok(Format::Stl),
            "obj" => Ok(Format::Obj),
            "dae" => Ok(Format::Collada),
            other => Err(self.wrong(format!(
                "format '{other}' is not handled; convert it to STL, OBJ or Collada (.dae)"
            ))),
        }
    }

    /// Returns the corners of the triangles; of some formats only a few beyond `most` triangles.
    fn all_corners(&self, most: usize) -> Result<Vec<Point3<f64>>, MeshError> {
        let corners = match self.format()? {
            Format::Stl => stl::corners(&self.bytes),
            Format::Obj => obj::corners(&self.bytes, most),
            Format::Collada => collada::corners(&self.bytes, most),
        };
        corners.map_err(|detail| self.wrong(detail))
    }

    /// Returns the corners of the triangles, as many as can be `used`: from 1 to `most` triangles.
    fn corners(&self, most: usize, used: &str) -> Result<Vec<Point3<f64>>, MeshError> {
        let corners = self.all_corners(most)?;
        let count = corners.len() / 3;
        if count == 0 || count > most {
            let found = if count == 0 { "no" } else { "too many" };
            return Err(self.wrong(format!("it has {found} triangles; from 1 to {most} can be {used}")));
        }
        Ok(corners)
    }

    /// Unit that the file states \[m\].
    fn unit_m(&self) -> Result<Option<f64>, MeshError> {
        match self.format()? {
            Format::Collada => collada::stated_unit_m(&self.bytes).map_err(|detail| self.wrong(detail)),
            Format::Stl | Format::Obj => Ok(None),
        }
    }

    fn solid(&self) -> Result<Vec<[Point3<f64>; 3]>, MeshError> {
        let corners = self.scaled(self.corners(MAX_SOLID, "judged")?)?;
        Ok(corners.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect())
    }

    fn scale(&self, points: &mut [Point3<f64>]) {
        let [x, y, z] = self.scale;
        for point in points {
            *point = Point3::new(point.x * x, point.y * y, point.z * z);
        }
    }

    /// Returns the scaled points of a link's mesh; refuses those that are no lengths.
    fn scaled_of(&self, link: &str, mut points: Vec<Point3<f64>>) -> Result<Vec<Point3<f64>>, UrdfError> {
        let at = format!("link '{link}'");
        self.scale(&mut points);
        for point in &points {
            length(&at, "mesh vertex", point.coords.as_slice())?;
        }
        Ok(points)
    }

    fn scaled(&self, mut points: Vec<Point3<f64>>) -> Result<Vec<Point3<f64>>, MeshError> {
        self.scale(&mut points);
        match points.iter().find(|p| !p.iter().all(|c| c.abs() <= LARGEST_LENGTH_M)) {
            Some(p) if p.iter().any(|c| !c.is_finite()) => Err(self.wrong(format!(
                "its vertex ({}, {}, {}) is none: coordinates must be numbers",
                p.x, p.y, p.z
            ))),
            Some(p) => Err(self.wrong(format!(
                "its vertex ({}, {}, {}) is none: coordinates must be numbers up to {LARGEST_LENGTH_M} m either way; these may be \
                 millimetres: scale them by [0.001, 0.001, 0.001] (mesh_scale)",
                p.x, p.y, p.z
            ))),
            None => Ok(points),
        }
    }
}

/// Returns the points, each once.
fn distinct(points: Vec<Point3<f64>>) -> Vec<Point3<f64>> {
    let mut seen = BTreeSet::new();
    points
        .into_iter()
        .filter(|p| seen.insert([p.x, p.y, p.z].map(f64::to_bits)))
        .collect()
}
