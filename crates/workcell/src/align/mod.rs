//! Where an arm stands at a table: points touched with its tip give the mount.
//!
//! A touched point is known twice: in the drawing of the table, which is the world (`p`), and as the pendant shows the tip there, in the
//! base frame (`b`). The mount `T_world_base` is the rotation R and the translation t for which Σ |p − (R b + t)|² is least (Kabsch 1976,
//! Umeyama 1991): with the singular values of the covariance, and with the sign that makes R a rotation and no mirror.
//!
//! | concept | module |
//! | --- | --- |
//! | the fit, and how well the points fix it | `fit` |
//! | touched in another order than drawn | `order` |
//! | points in text | `table` |
//! | why there is none | `error` |

mod error;
mod fit;
mod order;
mod table;
pub use error::{AlignError, Unit};
pub use fit::{Alignment, Touch, align};
pub use order::fitting_order;
pub use table::{DrawnPoint, TouchedPoint, drawn_points, touched_points};
