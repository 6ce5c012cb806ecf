//! Bodies in projection: their facets are sorted, shaded and drawn, what is behind first.
//!
//! | concept | file |
//! | --- | --- |
//! | a body's facets | `shapes.rs` |
//! | where a place of the world is seen | `camera.rs` |
//! | facets and lines that are to be drawn | `scene.rs` |
//! | which of them are behind which | `order.rs` |
//! | shapes of one look, drawn as one | `paint.rs` |
//! | how light a facet is, and where its body's shadow falls | `light.rs` |

pub mod camera;
pub mod light;
mod order;
mod paint;
pub mod scene;
pub mod shapes;
