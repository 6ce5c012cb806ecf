//! Text of mesh files: line ends of all systems, a byte order mark, coordinates.

use nalgebra::Point3;

/// True where a byte order mark says that a text is in UTF-16.
pub(crate) fn is_utf_16(bytes: &[u8]) -> bool {
    bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff])
}

/// Returns the text of a mesh file with `\n` at the end of each line, and without a byte order mark.
///
/// # Errors
/// The reason, for UTF-16.
pub(crate) fn text(bytes: &[u8]) -> Result<String, String> {
    if is_utf_16(bytes) {
        return Err("it is text in UTF-16; save it in ASCII or UTF-8".to_owned());
    }
    let text = String::from_utf8_lossy(bytes);
    Ok(text
        .trim_start_matches('\u{feff}')
        .replace("\r\n", "\n")
        .replace('\r', "\n"))
}

/// Words of a line; a zero byte, as at the end of some files, is a space.
pub(crate) fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split(|c: char| c.is_whitespace() || c == '\0')
        .filter(|word| !word.is_empty())
}

/// Reads three numbers of a line, counted from 1; more may follow.
pub(crate) fn point<'a>(mut words: impl Iterator<Item = &'a str>, line: usize) -> Result<Point3<f64>, String> {
    let mut number = || {
        let word = words.next().unwrap_or_default();
        word.parse::<f64>()
            .map_err(|_| format!("line {line}: '{word}' is not a coordinate"))
    };
    Ok(Point3::new(number()?, number()?, number()?))
}
