//! The solvers that others wrote, beside platewash's own on the problems of `platewash-problems`: an interleaved timing,
//! and a judge of answers.
//!
//! On a shared machine absolute times drift; the ratios come from rounds in which all solvers take turns
//! ([`interleaved`]).

pub mod edges;
pub mod interleaved;
pub mod judged;
pub mod plain_fk;
pub mod scene;
pub mod solvers;
pub mod tilts;
