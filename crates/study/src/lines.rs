//! Files of a study: those of whole lines only grow, and a line that was torn at its end is dropped when they are opened again.

use crate::error::StudyError;
use platewash_workcell::atomic_file;
use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, BufReader, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Time between two calls that wait until the disk has the written lines.
const SYNC: Duration = Duration::from_secs(5);

/// The words of a file that the disk does not take.
const UNWRITTEN: &str = "cannot be written";

/// Writes a file whole.
///
/// # Errors
/// [`StudyError::Disk`].
pub(crate) fn write_whole(file: &Path, text: &[u8]) -> Result<(), StudyError> {
    atomic_file::write(file, text).map_err(StudyError::disk(file, UNWRITTEN))
}

/// Destination of a file of lines: a file, and in tests one that fails.
pub(crate) trait Sink: Write + Send {
    /// Cuts it to its first bytes, and goes on there.
    fn cut(&mut self, length: u64) -> io::Result<()>;
    /// Waits until all of it is kept.
    fn sync(&mut self) -> io::Result<()>;
}

impl Sink for File {
    fn cut(&mut self, length: u64) -> io::Result<()> {
        // A file of the right length is not touched.
        if self.metadata()?.len() != length {
            self.set_len(length)?;
        }
        self.seek(SeekFrom::Start(length)).map(|_| ())
    }

    fn sync(&mut self) -> io::Result<()> {
        self.sync_data()
    }
}

/// Lines that are appended, each whole.
pub(crate) struct Lines<S> {
    path: PathBuf,
    sink: S,
    /// Length of the lines that are whole \[bytes\].
    whole: u64,
    synced: Instant,
}

/// Opens a file for reading and appending, made where there is none.
pub(crate) fn open(path: &Path) -> Result<File, StudyError> {
    let mut options = OpenOptions::new();
    let options = options.read(true).write(true).create(true).truncate(false);
    options.open(path).map_err(StudyError::disk(path, "cannot be opened"))
}

/// Reads whole lines, one after the other, with their place in the file; the length of all of them.
pub(crate) fn read(
    path: &Path,
    from: impl io::Read,
    mut each: impl FnMut(u64, &[u8]) -> Result<(), StudyError>,
) -> Result<u64, StudyError> {
    let (mut from, mut line, mut whole) = (BufReader::new(from), Vec::new(), 0);
    loop {
        line.clear();
        let length = from.read_until(b'\n', &mut line);
        let length = length.map_err(StudyError::disk(path, "cannot be read"))?;
        if !line.ends_with(b"\n") {
            return Ok(whole);
        }
        each(whole, &line[..length - 1])?;
        whole += length as u64;
    }
}

impl<S: Sink> Lines<S> {
    /// Continues behind the given number of bytes of whole lines; the bytes beyond them are removed.
    pub fn after(path: &Path, mut sink: S, whole: u64) -> Result<Self, StudyError> {
        sink.cut(whole).map_err(StudyError::disk(path, UNWRITTEN))?;
        Ok(Self {
            path: path.to_owned(),
            sink,
            whole,
            synced: Instant::now(),
        })
    }

    /// Appends a line, and hands it to the system before this returns. Where that fails, the part that was written is removed
    /// again, as far as possible.
    pub fn append(&mut self, line: &str) -> Result<(), StudyError> {
        let line = format!("{line}\n");
        if let Err(error) = self.sink.write_all(line.as_bytes()).and_then(|()| self.sink.flush()) {
            // A torn line that stays is dropped when the file is opened again.
            let _ = self.sink.cut(self.whole);
            return Err(StudyError::disk(&self.path, UNWRITTEN)(error));
        }
        self.whole += line.len() as u64;
        if self.synced.elapsed() >= SYNC {
            self.sync()
        } else {
            Ok(())
        }
    }

    /// Waits until all lines are kept.
    pub fn sync(&mut self) -> Result<(), StudyError> {
        self.synced = Instant::now();
        self.sink.sync().map_err(StudyError::disk(&self.path, UNWRITTEN))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A disk with room for so many bytes.
    struct FullDisk(Vec<u8>, usize);

    impl Write for FullDisk {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            let room = (self.1 - self.0.len()).min(bytes.len());
            if room == 0 {
                return Err(io::ErrorKind::StorageFull.into());
            }
            self.0.extend(&bytes[..room]);
            Ok(room)
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    impl Sink for FullDisk {
        fn cut(&mut self, length: u64) -> io::Result<()> {
            self.0.truncate(length as usize);
            Ok(())
        }

        fn sync(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_full_disk_is_an_error_and_keeps_the_lines_before_whole() {
        let mut lines = Lines::after(Path::new("rows"), FullDisk(Vec::new(), 8), 0).unwrap();
        lines.append("one").unwrap();
        let error = lines.append("three").unwrap_err();
        assert!(matches!(error, StudyError::Disk { cause, .. } if cause.kind() == io::ErrorKind::StorageFull));
        assert_eq!(lines.sink.0, b"one\n");
        lines.append("two").unwrap();
        assert_eq!(lines.sink.0, b"one\ntwo\n");
    }

    #[test]
    fn ignores_a_torn_line() {
        let mut told = Vec::new();
        let whole = read(Path::new("rows"), &b"one\ntwo\nthr"[..], |at, line| {
            told.push((at, line.to_vec()));
            Ok(())
        });
        assert_eq!(whole.unwrap(), 8);
        assert_eq!(told, [(0, b"one".to_vec()), (4, b"two".to_vec())]);
    }
}
