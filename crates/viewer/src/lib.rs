//! The washing to look at: one page in three dimensions, played back or live, and figures.
//!
//! | concept | module |
//! | --- | --- |
//! | the document that a page shows | [`view`] |
//! | the bundle that all pages share | [`bundle`] |
//! | both as one file of HTML | [`page`] |
//! | figures of a plan, as SVG | [`figures`] |

pub mod bundle;
pub mod figures;
pub mod page;
pub mod view;

pub use view::View;
