//! The program of the paper: its motion, its figures and its verdict.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod knots;
mod paper_facts;
mod verdict;
