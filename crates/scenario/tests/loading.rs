//! Reading scenarios: texts, files and paths, and messages about them.

use platewash_scenario::{SHIPPED, Scenario, source};

#[test]
fn control_characters_reach_no_terminal() {
    for text in [
        "name = \"a\\u001b[31m\"\n",
        "\"k\\u001b[2J\" = 1\n",
        "seed = \"\\u0007\"\n",
    ] {
        let message = Scenario::parse(text, "case").unwrap_err().to_string();
        assert!(!message.contains(char::is_control), "{message:?}");
        assert!(message.contains("\\u{"), "{message:?}");
    }
}

#[test]
fn lengths_in_millimetres_are_refused_with_their_metres() {
    let refused = |line: &str| Scenario::parse(line, "case").unwrap_err().to_string();
    for (line, metres) in [
        (
            "layout.plate_radius_m = 145",
            "; found 145 (metres are expected; 0.145 if",
        ),
        ("tool.length_m = 150.5", "; found 150.5 (metres are expected; 0.1505 if"),
    ] {
        let message = refused(line);
        assert!(message.contains(metres), "{message}");
    }
    for line in [
        "layout.plate_radius_m = -0.145",
        "layout.plate_radius_m = 1e300",
        "wash.turns = -1",
    ] {
        let message = refused(line);
        assert!(!message.contains("millimetres"), "{message}");
    }
}

#[test]
fn the_text_is_that_of_the_file_byte_for_byte() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.toml");
    let text = "\u{feff}# no scenario, but a text\r\nname = 3";
    std::fs::write(&path, text).unwrap();
    let read = source(&path.to_string_lossy()).unwrap();
    assert_eq!(read.text, text);
    assert_eq!(read.file.as_deref(), Some(&*path));
    assert_eq!(read.folder.as_deref(), Some(folder.path()));
    let shipped = source("kitchen").unwrap();
    assert_eq!((shipped.file, shipped.folder), (None, None));
    assert_eq!(shipped.text, SHIPPED[0].text);
}

#[cfg(unix)]
#[test]
fn accepts_any_path_of_the_system() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;

    let mut scenario = Scenario::load("paper-text").unwrap();
    let path = OsStr::from_bytes(b"arm\xff.urdf");
    scenario.robot.urdf = Some(path.into());
    scenario.robot.package_path = vec![path.into()];
    assert_eq!(scenario.validate(), Ok(()));
    assert!(serde_json::to_string(&scenario).unwrap().contains("arm\u{fffd}.urdf"));
}
