//! The program of the paper: its motion, its figures and its verdict.

// Tests compare with tolerances: the last bit of the C library's functions is of no matter.
#![allow(clippy::disallowed_methods)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod cubic;
mod knots;
mod order;
mod paper_facts;
mod settings;
mod spiral;
mod verdict;
