//! The certificate against a hand-made plan, its mutations, an independent sampler, and files that are no plans.

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
mod program;
mod proofs;
mod rests_on;
mod words;
