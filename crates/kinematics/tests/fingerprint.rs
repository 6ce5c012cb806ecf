//! SHA-256 of descriptions.

use platewash_kinematics::fingerprint::{Sha256, sha256_hex};

#[test]
fn sha256_agrees_with_the_published_test_vector() {
    // FIPS 180-2, appendix B.1.
    let expected = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
    assert_eq!(sha256_hex(b"abc"), expected);
    let mut pieces = Sha256::default();
    pieces.add(b"a");
    pieces.add(b"bc");
    assert_eq!(pieces.hex(), expected);
}
