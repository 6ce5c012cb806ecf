//! Figures of a plan, for pages of print and slides, as SVG with texts that can be read and selected.
//!
//! The same plan gives the same bytes on every machine and for every number of threads.
//!
//! | concept | file |
//! | --- | --- |
//! | the figures by name | `names.rs` |
//! | their data | `figure_data.rs` |
//! | from above, with paths and ways (the paper's Fig. 2) | `layout.rs` |
//! | joints and tip over time | `joints.rs` |
//! | ideal and executed path | `spiral.rs` |
//! | swept area and dwell time | `coverage.rs` |
//! | region in which an arm washes plates | `region.rs` |
//! | maps from above, outlines of bodies, fields of equal size | `map.rs`, `outline.rs`, `fields.rs` |
//! | shapes and texts, diagrams, the sheet with its words and legends | `svg.rs`, `axes.rs`, `page.rs` |

mod axes;
mod coverage;
mod error;
mod fields;
mod figure_data;
mod joints;
mod layout;
mod map;
mod names;
mod outline;
mod page;
mod region;
mod spiral;
mod svg;

pub use error::FigureError;
pub use figure_data::{FigureData, IdealPath};
pub use names::{Figure, UnknownFigure};
pub use outline::{Outline, arm_outlines};
pub use region::{RegionMap, draw_region};

use platewash_workcell::words::quoted;

/// Draws a figure: a text in SVG.
///
/// # Errors
/// [`FigureError`]: the plan has nothing to show in this figure.
pub fn draw(data: &FigureData<'_>, figure: Figure) -> Result<String, FigureError> {
    let drawing = match figure {
        Figure::Layout => layout::draw(data),
        Figure::Joints => joints::draw(data),
        Figure::Coverage => coverage::draw(data)?,
        Figure::Spiral => spiral::draw(data)?,
    };
    let scenario = quoted(&data.plan.provenance.scenario);
    Ok(drawing.finish(page::SIZE, &format!("{}: {scenario}", figure.name())))
}

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests;
