//! Plate from measurements: a mesh of its surface, such as a scan or a drawing, or points touched on its face with a probe.
//!
//! The face is the side that is stated, otherwise the one that rises towards its rim; of a flat plate the one that looks along the file's z. It ends at the lip, where it
//! falls outwards by more than 45°, or at the greatest radius. Its profile is fitted to the vertices, or where these have few radii to the whole surface. The deviation is measured between the
//! vertices, too, and is an upper bound; of points it is that at the points, and nothing is known between them. The pole is put so that the
//! face is as far above its profile as below it: a dent of 1 mm is a deviation of 0.5 mm.
//!
//! A mesh is a body if it is closed, but for holes of 1 % of its area. Facets must be wound alike, all to the outside or all to the
//! inside; a mirror image does no harm, nor does any placement in the file. Holes in the face narrower than about 3 % of its radius, and those
//! within 2 mm of its rim, are not seen.
//!
//! | concept | file |
//! | --- | --- |
//! | unit of the file, points as text | `unit` |
//! | equal corners joined; sides of a mesh, its face | `mesh` |
//! | side that is the face | `side` |
//! | axis | `axis`, `algebra` |
//! | knots of the profile | `knots` |
//! | heights on a grid: holes, picture | `face` |
//! | plate of a mesh, of probed points | `from_mesh`, `points` |
//! | plate, and the file that it is measured in | `plate`, `file` |
//! | fit of the profile to points | `profile_fit` |
//! | bounds of sizes, deviations and coordinates | `bounds` |
//! | deviation, thickness, foot | `body` |
//! | errors | `error` |

mod algebra;
mod axis;
mod body;
mod bounds;
mod error;
mod face;
mod file;
mod from_mesh;
mod knots;
mod mesh;
mod plate;
mod points;
mod profile_fit;
mod side;
mod unit;

pub use crate::measured::bounds::{LEAST_PLATE_M, MOST_DEVIATION_M, MOST_PLATE_M};
pub use crate::measured::error::{MeasuredError, Place};
pub use crate::measured::face::Relief;
pub use crate::measured::from_mesh::from_mesh;
pub use crate::measured::plate::MeasuredPlate;
pub use crate::measured::points::{LEAST_POINTS, from_ball_centres, from_points};
pub use crate::measured::side::FaceSide;
pub use crate::measured::unit::{Unit, probe_points};
