//! Files that appear whole: leftovers go, and one process at a time changes a folder.

use platewash_workcell::atomic_file::*;
use std::io::Write;
use std::path::Path;

fn names(folder: &Path) -> Vec<String> {
    let files = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = files
        .map(|file| file.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort_unstable();
    names
}

#[test]
fn removes_leftovers_and_keeps_files_being_written() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("a.txt");
    std::fs::write(folder.path().join(".platewash-left"), "x").unwrap();
    std::fs::write(folder.path().join("mine"), "x").unwrap();
    FolderLock::new(folder.path()).unwrap().remove_leftovers();
    let mut writing = staged_in(folder.path()).unwrap();
    writing.write_all(b"first").unwrap();
    write(&place, b"second").unwrap();
    FolderLock::new(folder.path()).unwrap().remove_leftovers();
    assert_eq!(names(folder.path()).len(), 3, "{:?}", names(folder.path()));
    writing.persist(&place).unwrap();
    assert_eq!(names(folder.path()), ["a.txt", "mine"]);
    assert_eq!(std::fs::read(&place).unwrap(), b"first");
}

#[test]
fn only_one_process_changes_a_folder_at_a_time() {
    let folder = tempfile::tempdir().unwrap();
    let held = FolderLock::new(folder.path()).unwrap();
    let place = folder.path().join("a.txt");
    std::thread::scope(|scope| {
        let other = scope.spawn(|| write(&place, b"x"));
        std::thread::sleep(std::time::Duration::from_millis(50));
        assert!(!place.exists());
        drop(held);
        other.join().unwrap().unwrap();
    });
    assert!(place.exists());
}
