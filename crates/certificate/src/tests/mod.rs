//! The certificate against a hand-made plan, its mutations, an independent sampler, and files that are no plans.

mod adversarial;
mod asked;
mod differential;
mod made;
mod mutations;
mod program;
mod proofs;
mod rests_on;
mod words;
