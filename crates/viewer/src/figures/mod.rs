//! Figures of a plan, for pages of print and slides: SVG, and PNG that shows the same.
//!
//! The same plan gives the same bytes on every machine and for every number of threads: letters are outlines.
//!
//! | concept | file |
//! | --- | --- |
//! | the figures by name | `names.rs` |
//! | what they are drawn of; the way of the tip | `subject.rs`, `track.rs` |
//! | from above, with paths and ways (the paper's Fig. 2) | `layout.rs` |
//! | the arm at a moment (Figs. 3 and 4) | `posture.rs`, `bodies.rs` |
//! | joints and tip over time | `joints.rs` |
//! | ideal and executed path | `spiral.rs` |
//! | what is swept, and for how long | `coverage.rs` |
//! | what is required or claimed, and what came of it | `sheet.rs` |
//! | the flow of the program (Fig. 1) | `flow.rs` |
//! | where an arm washes plates | `region.rs` |
//! | words, fields and outlines that figures share | `wording.rs`, `grid.rs`, `outline.rs` |
//! | lines, letters, diagrams, tables | `ink/` |
//! | bodies in projection | `solid/` |

mod bodies;
mod coverage;
mod error;
mod flow;
mod grid;
mod ink;
mod joints;
mod layout;
mod names;
mod outline;
mod posture;
mod region;
mod sheet;
mod solid;
mod spiral;
mod subject;
mod track;
mod wording;

pub use error::FigureError;
pub use ink::png::PngError;
pub use names::{Figure, UnknownFigure};
pub use region::{RegionMap, RegionSheet, draw_region};
pub use subject::{Claim, Ideal, Subject};

use ink::drawing::Drawing;
use platewash_workcell::words::quoted;

/// A figure that was drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    /// Which one.
    pub figure: Figure,
    /// The drawing, a text in SVG.
    pub svg: String,
}

impl Sheet {
    /// The drawing as PNG: what the SVG shows.
    ///
    /// # Errors
    /// [`FigureError::Png`].
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        Ok(ink::png::png(&self.svg)?)
    }
}

/// Draws a figure; `at_s` is the moment of [`Figure::Moment`] \[s\].
///
/// # Errors
/// [`FigureError`]: the plan has nothing to show in this figure, or the moment is none of the motion.
pub fn draw(subject: &Subject<'_>, figure: Figure, at_s: Option<f64>) -> Result<Sheet, FigureError> {
    let drawing = drawing(subject, figure, at_s)?;
    let title = format!("{}: {}", figure.name(), quoted(&subject.plan.provenance.scenario));
    let said: Vec<&str> = drawing.texts().iter().map(|text| text.words.as_str()).collect();
    let svg = drawing.finish(&title, &said.join("; "));
    Ok(Sheet { figure, svg })
}

/// The flow of the program, which needs no plan.
#[must_use]
pub fn draw_flow() -> Sheet {
    let svg = flow::draw().finish("How platewash goes on", "from a scenario to a proved motion");
    Sheet {
        figure: Figure::Flow,
        svg,
    }
}

fn drawing(subject: &Subject<'_>, figure: Figure, at_s: Option<f64>) -> Result<Drawing, FigureError> {
    Ok(match figure {
        Figure::Layout => layout::draw(subject),
        Figure::Cleaning | Figure::Transit => {
            let moment = posture::moment(subject, figure, at_s)?;
            posture::draw(subject, moment, posture::Eye::Aside)?
        }
        Figure::Moment => {
            let moment = posture::moment(subject, figure, at_s)?;
            posture::draw(subject, moment, posture::Eye::Front)?
        }
        Figure::Joints => joints::draw(subject),
        Figure::Spiral => spiral::draw(subject)?,
        Figure::Coverage => coverage::draw(subject)?,
        Figure::Sheet => sheet::draw(subject)?,
        Figure::Flow => flow::draw(),
    })
}

#[cfg(test)]
mod tests;
