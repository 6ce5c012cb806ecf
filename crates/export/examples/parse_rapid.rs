//! Parses RAPID modules and says which of them are none, and why: `cargo run --example parse_rapid -- FILE…`.

#![allow(clippy::print_stdout, reason = "this is a command")]

use platewash_export::rapid::syntax::parse;

fn main() -> std::io::Result<()> {
    let (mut read, mut all) = (0, 0);
    for path in std::env::args().skip(1) {
        all += 1;
        let bytes = std::fs::read(&path)?;
        // Older files are in ISO 8859-1, whose characters are the first of Unicode.
        let text =
            String::from_utf8(bytes).unwrap_or_else(|error| error.into_bytes().into_iter().map(char::from).collect());
        match parse(&text) {
            Ok(_) => read += 1,
            Err(error) => println!("{path}:{}:{}: {error}", error.at().line, error.at().column),
        }
    }
    println!("{read} of {all} files are modules");
    Ok(())
}
