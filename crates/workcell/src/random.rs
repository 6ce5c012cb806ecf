//! Named random streams: every stochastic stage draws from its own, so that one stage never shifts another.

use rand::SeedableRng;
use rand_pcg::Pcg64;
use sha2::{Digest, Sha256};

/// Returns the stream that belongs to a scenario's `seed` and a stage's `name`; portable across machines.
#[must_use]
pub fn stream(seed: u64, name: &str) -> Pcg64 {
    let digest = Sha256::new()
        .chain_update(seed.to_le_bytes())
        .chain_update(name.as_bytes())
        .finalize();
    Pcg64::from_seed(digest.into())
}
