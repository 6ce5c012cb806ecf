//! Files that descriptions name: limits of their size, and files that are kept or not there.

use platewash_kinematics::urdf::Files;
use platewash_kinematics::urdf::file::{FileError, read_bytes, read_text};
use std::path::Path;
use std::sync::Arc;

#[test]
fn the_size_limit_counts_bytes_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("text");
    std::fs::write(&path, "12345").unwrap();
    assert_eq!(read_text(&path, 5), Ok("12345".to_owned()));
    assert_eq!(read_text(&path, 4), Err(FileError::TooLong { limit: 4 }));
    std::fs::write(&path, b"12\xff").unwrap();
    assert_eq!(read_text(&path, 5), Err(FileError::NotText { position: 2, line: 1 }));
    assert_eq!(read_bytes(folder.path(), 5), Err(FileError::NotRegular));
    assert!(matches!(
        read_bytes(&folder.path().join("none"), 5),
        Err(FileError::System { .. })
    ));
}

/// `/dev/zero` never ends; files below `/proc` state a length of zero.
#[cfg(target_os = "linux")]
#[test]
fn rejects_devices_and_ignores_stated_lengths() {
    assert_eq!(read_bytes(Path::new("/dev/zero"), 5), Err(FileError::NotRegular));
    assert_eq!(
        read_bytes(Path::new("/proc/self/status"), 5),
        Err(FileError::TooLong { limit: 5 })
    );
}

#[test]
fn keeps_read_files_after_they_leave_the_disk() {
    let folder = tempfile::tempdir().unwrap();
    let [path, none] = ["a.urdf", "none"].map(|name| folder.path().join(name));
    std::fs::write(&path, "abc").unwrap();
    let recording = Files::recording();
    assert_eq!(recording.read_text(&path, 3).unwrap(), "abc");
    let held = Files::held(Arc::new(recording.recorded().unwrap()));
    std::fs::remove_file(&path).unwrap();
    assert!(held.is_file(&path) && !held.is_file(&none) && !recording.is_file(&path));
    assert_eq!(held.read_bytes(&path, 3).unwrap(), b"abc");
    assert_eq!(held.read_bytes(&path, 2), Err(FileError::TooLong { limit: 2 }));
    assert!(matches!(held.read_text(&none, 3), Err(FileError::System { .. })));
    assert!(recording.read_bytes(&none, 3).is_err());
    assert_eq!(recording.recorded().unwrap_err().0, none);
}

#[test]
fn a_source_without_files_refuses_those_of_the_disk() {
    let file = tempfile::NamedTempFile::new().unwrap();
    assert!(!Files::none().is_file(file.path()));
    assert_eq!(Files::none().read_bytes(file.path(), 3), Err(FileError::NoFiles));
}
