//! The certificate against a hand-made plan, its mutations, an independent sampler, and files that are no plans.

// Tests compare with tolerances: the last bit of the C library's functions is of no matter.
#![allow(clippy::disallowed_methods)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod adversarial;
mod arm_motion;
mod asked;
mod contact;
mod contact_around;
mod contact_edits;
mod contact_spares;
mod contact_untouched;
mod differential;
mod foundation;
mod holding;
mod maker;
mod mutations;
mod obstacles;
mod one_name;
mod program;
mod proofs;
mod rests_on;
mod words;
