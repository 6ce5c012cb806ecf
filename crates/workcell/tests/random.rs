//! Named random streams.

use platewash_workcell::random::stream;
use rand::RngExt;

#[test]
fn streams_repeat_and_differ_by_seed_and_name() {
    let first = |seed, name| stream(seed, name).random::<u64>();
    assert_eq!(first(1, "layout"), first(1, "layout"));
    assert_ne!(first(1, "layout"), first(2, "layout"));
    assert_ne!(first(1, "layout"), first(1, "crossing 0"));
}
