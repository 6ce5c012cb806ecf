//! A drawing as a picture of points: what its SVG shows, and nothing else.

use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{Options, Tree};

/// Why an SVG became no picture.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the drawing cannot be made a PNG: {0}")]
pub struct PngError(String);

/// An SVG as PNG, a point a pixel of its own size. The same bytes for the same SVG.
///
/// # Errors
/// [`PngError`] for an SVG that is none, or of no size.
pub fn png(svg: &str) -> Result<Vec<u8>, PngError> {
    let wrong = |what: &dyn std::fmt::Display| PngError(what.to_string());
    let tree = Tree::from_str(svg, &Options::default()).map_err(|e| wrong(&e))?;
    let size = tree.size().to_int_size();
    let Some(mut picture) = Pixmap::new(size.width(), size.height()) else {
        return Err(wrong(&"it has no size"));
    };
    picture.fill(Color::WHITE);
    resvg::render(&tree, Transform::identity(), &mut picture.as_mut());
    picture.encode_png().map_err(|e| wrong(&e))
}
