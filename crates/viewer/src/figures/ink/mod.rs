//! Drawings: lines, shapes and letters on a sheet, as SVG and as PNG.
//!
//! | concept | file |
//! | --- | --- |
//! | fill and stroke | `style.rs` |
//! | colours | `palette.rs` |
//! | letters | `font.rs` |
//! | shapes and texts one above the other | `drawing.rs` |
//! | title, foot and what is between | `page.rs` |
//! | scales, ticks and grids | `axes.rs` |
//! | what a line or a colour means | `legend.rs` |
//! | a table | `table.rs` |
//! | a picture of points | `png.rs` |

pub mod axes;
pub mod drawing;
pub mod font;
pub mod legend;
pub mod page;
pub mod palette;
pub mod png;
pub mod style;
pub mod table;
