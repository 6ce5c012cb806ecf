//! The values of an axis in a summary.

use platewash_study::AxisValue;

#[test]
fn the_values_of_an_axis_are_sorted() {
    let mut values = ["\"rings\"", "10", "2", "-1.5", "1e3", "\"auto\""].map(|text| AxisValue(text.to_owned()));
    values.sort();
    assert_eq!(
        values.map(|value| value.0),
        ["-1.5", "2", "10", "1e3", "\"auto\"", "\"rings\""]
    );
}
