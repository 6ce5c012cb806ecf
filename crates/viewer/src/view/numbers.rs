//! Arrays of numbers as the page reads them: little-endian and in base64, with their shape.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use nalgebra::SVector;
use serde::Serialize;
use ts_rs::TS;

/// An array of numbers, row by row.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, TS)]
pub struct Numbers {
    /// Its extent along each axis.
    pub shape: Vec<usize>,
    /// The numbers.
    #[serde(flatten)]
    pub data: Data,
}

/// The bytes of an array in base64, under the type of its numbers.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Data {
    /// Double precision.
    F64(String),
    /// Single precision.
    F32(String),
    /// Whole numbers of 16 bits without sign.
    U16(String),
    /// Unsigned numbers of 8 bits.
    U8(String),
}

impl Numbers {
    /// Numbers in double precision.
    #[must_use]
    pub fn f64(shape: impl Into<Vec<usize>>, values: impl Iterator<Item = f64>) -> Self {
        Self::new(shape, Data::F64(base64(values.map(f64::to_le_bytes))))
    }

    /// Numbers in single precision.
    #[must_use]
    pub fn f32(shape: impl Into<Vec<usize>>, values: impl Iterator<Item = f32>) -> Self {
        Self::new(shape, Data::F32(base64(values.map(f32::to_le_bytes))))
    }

    /// Rows of N in single precision.
    #[must_use]
    pub fn f32_rows<'a, const N: usize>(rows: impl ExactSizeIterator<Item = &'a SVector<f64, N>>) -> Self {
        let shape = [rows.len(), N];
        Self::f32(shape, rows.flat_map(|row| row.iter()).map(|value| *value as f32))
    }

    /// Whole numbers of 16 bits.
    #[must_use]
    pub fn u16(shape: impl Into<Vec<usize>>, values: impl Iterator<Item = u16>) -> Self {
        Self::new(shape, Data::U16(base64(values.map(u16::to_le_bytes))))
    }

    /// Whole numbers of 8 bits.
    #[must_use]
    pub fn u8(shape: impl Into<Vec<usize>>, values: impl Iterator<Item = u8>) -> Self {
        Self::new(shape, Data::U8(base64(values.map(u8::to_le_bytes))))
    }

    fn new(shape: impl Into<Vec<usize>>, data: Data) -> Self {
        let shape = shape.into();
        Self { shape, data }
    }
}

fn base64<const N: usize>(values: impl Iterator<Item = [u8; N]>) -> String {
    let mut bytes = Vec::new();
    values.for_each(|value| bytes.extend_from_slice(&value));
    STANDARD.encode(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector2;

    /// By hand: 1.0 is 00 00 00 00 00 00 f0 3f, and as a single 00 00 80 3f.
    #[test]
    fn numbers_are_little_endian_under_their_type_and_shape() {
        let json = |numbers: &Numbers| serde_json::to_string(numbers).unwrap();
        assert_eq!(
            json(&Numbers::f64([1], [1.0].into_iter())),
            r#"{"shape":[1],"f64":"AAAAAAAA8D8="}"#
        );
        assert_eq!(
            json(&Numbers::f32([1], [1.0].into_iter())),
            r#"{"shape":[1],"f32":"AACAPw=="}"#
        );
        let rows = [Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0)];
        assert_eq!(
            json(&Numbers::f32_rows(rows.iter())),
            r#"{"shape":[2,2],"f32":"AACAPwAAAAAAAAAAAACAPw=="}"#
        );
        let whole = Numbers::u16([1, 2], [1, 0x0203].into_iter());
        assert_eq!(json(&whole), r#"{"shape":[1,2],"u16":"AQADAg=="}"#);
        assert_eq!(json(&Numbers::f64([0], [].into_iter())), r#"{"shape":[0],"f64":""}"#);
    }
}
