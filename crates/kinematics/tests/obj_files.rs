//! OBJ files as programs write them: what has no body is passed over, and what is not understood is refused with its line.

use nalgebra::Point3;
use platewash_kinematics::urdf::MeshSource;

const PLAIN: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

fn read(bytes: &[u8]) -> Result<Vec<[Point3<f64>; 3]>, String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("part.obj"), bytes).unwrap();
    let source = MeshSource::new(&[], Some(folder.path()));
    source.solid("part.obj", None).map_err(|why| why.to_string())
}

#[test]
fn obj_files_of_other_programs_are_read() {
    let expected = read(PLAIN.as_bytes()).unwrap();
    assert_eq!(expected.len(), 4);
    for text in [
        ["\u{feff}", PLAIN].concat(),
        PLAIN.replace('\n', "\r"),
        PLAIN.replace('\n', "\r\n"),
        PLAIN.replace("f 1 3 2", "f 1 \\\n3 \\\n2"),
        PLAIN.replace("f 2 3 4", "fo 2//1 3//1 4//1 # the last one"),
        PLAIN.replace("v 1 0 0", "v 1 0 0 1.0 0.5 0.5 0.5"),
        [
            "mtllib a.mtl\no part\nvn 0 0 1\nvt 0 0\n",
            PLAIN,
            "g a b\ns off\nusemtl paint\nl 1 2\np 3\n",
        ]
        .concat(),
    ] {
        assert_eq!(read(text.as_bytes()).as_ref(), Ok(&expected), "{text}");
    }
}

#[test]
fn lines_of_obj_files_that_are_not_understood_are_refused() {
    for (from, to, why) in [
        ("f 2 3 4", "F 2 3 4", "line 8: 'F' is no word of an OBJ file"),
        ("f 2 3 4", "face 2 3 4", "line 8: 'face' is no word of an OBJ file"),
        (
            "f 2 3 4",
            "surf 0 1 0 1 1 2 3 4",
            "line 8: 'surf' (free-form surfaces, further files) is not handled",
        ),
        ("f 2 3 4", "call part_2.obj", "line 8: 'call'"),
        ("f 2 3 4", "f 2 3", "line 8: a face has 2 corners; expected 3 or more"),
        ("f 2 3 4", "f 2 3 5", "line 8: '5' is none of the 4 vertices before it"),
        ("f 1 3 2\n", "f 1 3 \\\n2\nbad\n", "line 7: 'bad'"),
        ("v 0 0 1", "v 0 0,0 1", "line 4: '0,0' is not a coordinate"),
    ] {
        let changed = PLAIN.replacen(from, to, 1);
        let found = read(changed.as_bytes()).unwrap_err();
        assert!(found.contains(why), "{found}: {why}");
    }
    let utf_16: Vec<u8> = ["\u{feff}", PLAIN]
        .concat()
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    assert!(read(&utf_16).unwrap_err().contains("UTF-16"));
}
