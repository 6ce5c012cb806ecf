//! A layout is the positions of the plates, drawn at random or given, with the problems of the result.
//!
//! All positions are in the frame of the layout \[m\]: origin on the base axis, axes along those of the world, z = 0 at the height 0 of the
//! world. For an arm that stands at the world's origin that is its base frame.
//!
//! | concept | module |
//! | --- | --- |
//! | plates in their places; their number | `placed_plates`; `count` |
//! | the geometry that all plates of a layout share, and their spacing | `plate_geometry`, `spacing` |
//! | given plates; a random layout; either | `explicit`; `draw`; `placement` |
//! | rectangle that the base covers | `footprint` |
//! | region in which plates are drawn; its outline for display | `region`, `outline` |
//! | the law of random layouts | `sampling`, `free_cells` |
//! | upper bound on the number of plates: the proof that no arrangement fits | `packing` |
//! | findings about a layout; errors | `findings`, `error` |

mod count;
mod draw;
mod error;
mod explicit;
mod findings;
mod footprint;
mod free_cells;
mod outline;
mod packing;
mod placed_plates;
mod placement;
mod plate_geometry;
mod region;
mod sampling;
mod spacing;

pub use crate::layout::count::MAX_PLATES;
pub use crate::layout::draw::{SampleRequest, sample};
pub use crate::layout::error::{EmptyReason, InputProblem, LayoutError};
pub use crate::layout::explicit::check_explicit;
pub use crate::layout::findings::Finding;
pub use crate::layout::footprint::BaseFootprint;
pub use crate::layout::outline::TaskRegion;
pub use crate::layout::packing::packing_bound;
pub use crate::layout::placed_plates::{Layout, LayoutSource};
pub use crate::layout::placement::Placement;
pub use crate::layout::plate_geometry::PlateGeometry;
pub use crate::layout::region::{Region, base_footprint, mounted_footprint};
pub use crate::layout::sampling::{Attempt, Sampler};
pub use crate::layout::spacing::Spacing;
