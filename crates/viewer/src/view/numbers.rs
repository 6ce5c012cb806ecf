//! Arrays of numbers as the page reads them: little-endian and in base64, with their shape.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use nalgebra::SVector;
use serde::Serialize;

/// An array of numbers, row by row.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Numbers {
    /// Its extent along each axis.
    pub shape: Vec<usize>,
    /// The numbers.
    #[serde(flatten)]
    pub data: Data,
}

/// The bytes of an array in base64, under the type of its numbers.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Data {
    /// Double precision.
    F64(String),
    /// Single precision.
    F32(String),
    /// Whole numbers of 32 bits without sign.
    U32(String),
    /// Of 16 bits.
    U16(String),
    /// Of 8 bits.
    U8(String),
}

impl Numbers {
    /// A list in double precision.
    #[must_use]
    pub fn f64(values: &[f64]) -> Self {
        let data = Data::F64(base64(values.iter().flat_map(|v| v.to_le_bytes())));
        let shape = vec![values.len()];
        Self { shape, data }
    }

    /// Rows of N in double precision.
    #[must_use]
    pub fn f64_rows<'a, const N: usize>(rows: impl ExactSizeIterator<Item = &'a SVector<f64, N>>) -> Self {
        let shape = vec![rows.len(), N];
        let data = Data::F64(base64(rows.flat_map(|row| row.iter()).flat_map(|v| v.to_le_bytes())));
        Self { shape, data }
    }

    /// A list in single precision.
    #[must_use]
    pub fn f32(values: impl ExactSizeIterator<Item = f64>) -> Self {
        let shape = vec![values.len()];
        let data = Data::F32(base64(values.flat_map(|v| (v as f32).to_le_bytes())));
        Self { shape, data }
    }

    /// Rows of N in single precision.
    #[must_use]
    pub fn f32_rows<'a, const N: usize>(rows: impl ExactSizeIterator<Item = &'a SVector<f64, N>>) -> Self {
        let shape = vec![rows.len(), N];
        let numbers = rows.flat_map(|row| row.iter());
        let data = Data::F32(base64(numbers.flat_map(|v| (*v as f32).to_le_bytes())));
        Self { shape, data }
    }

    /// Numbers in single precision under a shape of as many.
    pub(super) fn f32_shaped(shape: Vec<usize>, values: impl Iterator<Item = f32>) -> Self {
        let data = Data::F32(base64(values.flat_map(f32::to_le_bytes)));
        Self { shape, data }
    }

    /// Whole numbers of 16 bits under a shape of as many.
    pub(super) fn u16_shaped(shape: Vec<usize>, values: impl Iterator<Item = u16>) -> Self {
        let data = Data::U16(base64(values.flat_map(u16::to_le_bytes)));
        Self { shape, data }
    }

    /// Whole numbers of 8 bits under a shape of as many.
    pub(super) fn u8_shaped(shape: Vec<usize>, values: impl Iterator<Item = u8>) -> Self {
        let data = Data::U8(base64(values));
        Self { shape, data }
    }
}

fn base64(bytes: impl Iterator<Item = u8>) -> String {
    STANDARD.encode(bytes.collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector2;

    /// By hand: 1.0 is 00 00 00 00 00 00 f0 3f, and as a single 00 00 80 3f.
    #[test]
    fn numbers_are_little_endian_under_their_type_and_shape() {
        let json = |numbers: &Numbers| serde_json::to_string(numbers).unwrap();
        assert_eq!(json(&Numbers::f64(&[1.0])), r#"{"shape":[1],"f64":"AAAAAAAA8D8="}"#);
        assert_eq!(
            json(&Numbers::f32([1.0].into_iter())),
            r#"{"shape":[1],"f32":"AACAPw=="}"#
        );
        let rows = [Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0)];
        assert_eq!(
            json(&Numbers::f32_rows(rows.iter())),
            r#"{"shape":[2,2],"f32":"AACAPwAAAAAAAAAAAACAPw=="}"#
        );
        assert_eq!(Numbers::f64_rows(rows.iter()).shape, [2, 2]);
        let whole = Numbers::u16_shaped(vec![1, 2], [1, 0x0203].into_iter());
        assert_eq!(json(&whole), r#"{"shape":[1,2],"u16":"AQADAg=="}"#);
        assert_eq!(json(&Numbers::f64(&[])), r#"{"shape":[0],"f64":""}"#);
    }
}
