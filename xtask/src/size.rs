//! Limits of the size of files.

use anyhow::{Result, bail};
use std::path::Path;

/// Fails if a file is larger than wanted, else tells its size.
pub fn no_larger(file: &Path, most: u64) -> Result<()> {
    let bytes = std::fs::metadata(file)?.len();
    if bytes > most {
        bail!("{} has {bytes} bytes; at most {most} are wanted", file.display());
    }
    println!("    {bytes} bytes");
    Ok(())
}
