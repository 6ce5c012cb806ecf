//! Collada meshes: placed as their scene says, read whole or refused.

use nalgebra::Point3;
use platewash_kinematics::urdf::MeshSource;
use proptest::prelude::*;
use tempfile::TempDir;

type Triangles = Vec<[[f64; 3]; 3]>;

const ARRAY: &str = "<float_array id=\"a\" count=\"12\">0 0 0 1 0 0 0 1 0 0 0 1</float_array>";
const ACCESSOR: &str = "<accessor source=\"#a\" count=\"4\" stride=\"3\"><param name=\"X\"/><param name=\"Y\"/><param name=\"Z\"/></accessor>";
const INPUTS: &str = "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>";
const FACES: &str = "<p>0 2 1 0 1 3 0 3 2 1 2 3</p>";

/// A tetrahedron of some faces, with these corners: origin, x, y, z.
fn mesh(faces: &str) -> String {
    format!(
        "<geometry id=\"g\"><mesh><source id=\"s\">{ARRAY}<technique_common>{ACCESSOR}</technique_common></source>\
         <vertices id=\"v\"><input semantic=\"POSITION\" source=\"#s\"/></vertices>{faces}</mesh></geometry>"
    )
}

fn triangles_of(faces: &str) -> String {
    mesh(&format!("<triangles count=\"4\">{INPUTS}{faces}</triangles>"))
}

/// A file with a scene of these nodes.
fn file(geometries: &str, nodes: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\
         <asset><unit name=\"meter\" meter=\"1\"/><up_axis>Y_UP</up_axis></asset>\
         <library_geometries>{geometries}</library_geometries>\
         <library_visual_scenes><visual_scene id=\"scene\">{nodes}</visual_scene></library_visual_scenes>\
         <scene><instance_visual_scene url=\"#scene\"/></scene></COLLADA>"
    )
}

const SHOWN: &str = "<instance_geometry url=\"#g\"/>";

/// The file that all tests change.
fn tetrahedron() -> String {
    file(&triangles_of(FACES), &format!("<node>{SHOWN}</node>"))
}

fn read(text: &[u8]) -> Result<Triangles, String> {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("part.dae"), text).unwrap();
    let found = MeshSource::new(&[], Some(folder.path())).solid("part.dae", None);
    let plain = |corners: [Point3<f64>; 3]| corners.map(|p| [p.x, p.y, p.z]);
    found
        .map(|all| all.into_iter().map(plain).collect())
        .map_err(|e| e.to_string())
}

/// Corners of the tetrahedron by index, each changed in the same way.
fn expected(faces: &[[usize; 3]], change: impl Fn([f64; 3]) -> [f64; 3]) -> Triangles {
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    faces.iter().map(|face| face.map(|k| change(corners[k]))).collect()
}

const ALL: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

fn assert_near(found: &Triangles, expected: &Triangles) {
    assert_eq!(found.len(), expected.len());
    let pairs = found
        .iter()
        .flatten()
        .flatten()
        .zip(expected.iter().flatten().flatten());
    assert!(
        pairs.clone().all(|(a, b)| (a - b).abs() < 1e-12),
        "{found:?}\n{expected:?}"
    );
}

// ---- what is read ----

#[test]
fn units_count_and_the_up_axis_does_not() {
    let text = tetrahedron();
    assert_eq!(read(text.as_bytes()).unwrap(), expected(&ALL, |p| p));
    for axis in ["X_UP", "Z_UP"] {
        let turned = text.replace("Y_UP", axis);
        assert_eq!(read(turned.as_bytes()).unwrap(), expected(&ALL, |p| p));
    }
    let inches = text.replace("meter=\"1\"", "meter=\"0.0254\"");
    assert_eq!(
        read(inches.as_bytes()).unwrap(),
        expected(&ALL, |p| p.map(|c| 0.0254 * c))
    );
    let unstated = text.replace("<unit name=\"meter\" meter=\"1\"/>", "");
    assert_eq!(
        read(format!("\u{feff}{unstated}").as_bytes()).unwrap(),
        expected(&ALL, |p| p)
    );
}

#[test]
fn transforms_apply_in_order_through_nodes() {
    let matrix = "<matrix>0 -1 0 10  1 0 0 20  0 0 1 30  0 0 0 1</matrix>";
    let nodes = format!(
        "<node>{matrix}<node><translate>1 2 3</translate><rotate>0 0 2 90</rotate><scale>2 3 4</scale>{SHOWN}</node></node>\
         <node type=\"JOINT\"><instance_light url=\"#l\"/></node>"
    );
    let place = |[x, y, z]: [f64; 3]| {
        let [x, y, z] = [2.0 * x, 3.0 * y, 4.0 * z];
        let [x, y, z] = [1.0 - y, 2.0 + x, 3.0 + z];
        [10.0 - y, 20.0 + x, 30.0 + z]
    };
    assert_near(
        &read(file(&triangles_of(FACES), &nodes).as_bytes()).unwrap(),
        &expected(&ALL, place),
    );
}

#[test]
fn mirrored_nodes_keep_the_outside() {
    let nodes = format!("<node><scale>1 -1 1</scale>{SHOWN}</node>");
    let mirrored = ALL.map(|[a, b, c]| [a, c, b]);
    let found = read(file(&triangles_of(FACES), &nodes).as_bytes()).unwrap();
    assert_eq!(found, expected(&mirrored, |[x, y, z]| [x, -y, z]));
    let volume = |t: &[[f64; 3]; 3]| {
        let [a, b, c] = t.map(nalgebra::Vector3::from);
        a.dot(&b.cross(&c)) / 6.0
    };
    assert!((found.iter().map(volume).sum::<f64>() - 1.0 / 6.0).abs() < 1e-15);
}

#[test]
fn nodes_of_the_library_stand_where_they_are_shown() {
    let nodes =
        "<node><instance_node url=\"#n\"/></node><node><translate>5 0 0</translate><instance_node url=\"#n\"/></node>";
    let library = format!("<library_nodes><node id=\"n\"><translate>0 1 0</translate>{SHOWN}</node></library_nodes>");
    let text = file(&triangles_of(FACES), nodes).replace("<scene>", &format!("{library}<scene>"));
    let both = [0.0, 5.0].map(|far| expected(&ALL, |[x, y, z]| [x + far, y + 1.0, z]));
    assert_eq!(read(text.as_bytes()).unwrap(), both.concat());
}

#[test]
fn without_a_scene_all_geometries_are_taken() {
    let text = format!(
        "<COLLADA><library_geometries>{}</library_geometries></COLLADA>",
        triangles_of(FACES)
    );
    assert_eq!(read(text.as_bytes()).unwrap(), expected(&ALL, |p| p));
}

#[test]
fn faces_of_all_kinds_become_triangles() {
    let more = "<input semantic=\"NORMAL\" source=\"#n\" offset=\"1\"/>";
    let cases = [
        (
            format!("<triangles count=\"1\">{more}{INPUTS}<p>0 9 1 9 2 9</p></triangles>"),
            vec![[0, 1, 2]],
        ),
        (
            format!("<polylist count=\"2\">{INPUTS}<vcount>4 3</vcount><p>0 1 2 3 3 2 1</p></polylist>"),
            vec![[0, 1, 2], [0, 2, 3], [3, 2, 1]],
        ),
        (
            format!("<polygons count=\"2\">{INPUTS}<p>0 1 2 3</p><p>3 2 1</p></polygons>"),
            vec![[0, 1, 2], [0, 2, 3], [3, 2, 1]],
        ),
        (
            format!("<trifans count=\"1\">{INPUTS}<p>0 1 2 3</p></trifans>"),
            vec![[0, 1, 2], [0, 2, 3]],
        ),
        (
            format!("<tristrips count=\"1\">{INPUTS}<p>0 1 2 3 0</p></tristrips>"),
            vec![[0, 1, 2], [2, 1, 3], [2, 3, 0]],
        ),
        (
            format!(
                "<lines count=\"1\">{INPUTS}<p>0 9</p></lines><triangles count=\"1\">{INPUTS}<p>3 2 <!-- --> 1</p></triangles>"
            ),
            vec![[3, 2, 1]],
        ),
    ];
    for (faces, triangles) in cases {
        let found = read(file(&mesh(&faces), &format!("<node>{SHOWN}</node>")).as_bytes());
        assert_eq!(found.as_ref(), Ok(&expected(&triangles, |p| p)), "{faces}");
    }
}

// ---- what is refused ----

#[test]
fn names_what_is_wrong() {
    let polygons = |rest: &str| format!("<polygons count=\"1\">{INPUTS}{rest}</polygons>");
    let whole_triangles = format!("<triangles count=\"4\">{INPUTS}{FACES}</triangles>");
    let nested = |levels: usize| format!("{}{SHOWN}{}", "<node>".repeat(levels), "</node>".repeat(levels));
    let many = |kind: &str, count: usize| kind.repeat(count);
    // Twice as many at each level.
    let library: String = (0..40)
        .map(|k| {
            format!(
                "<node id=\"n{k}\">{}</node>",
                many(&format!("<instance_node url=\"#n{}\"/>", k + 1), 2)
            )
        })
        .collect();
    let cases: &[(&str, &str, &str)] = &[
        ("COLLADA", "collada", "it begins with <collada>, not <COLLADA>"),
        ("meter=\"1\"", "meter=\"0\"", "unit of '0' m"),
        ("meter=\"1\"", "meter=\"nan\"", "unit of 'nan' m"),
        ("meter=\"1\"", "meter=\"inch\"", "unit of 'inch' m"),
        ("<unit ", "<unit/><unit ", "more than one <unit> in <asset>"),
        ("url=\"#scene\"", "url=\"#none\"", "'#none' is no <visual_scene>"),
        (
            "<instance_visual_scene url=\"#scene\"/>",
            "",
            "does not say which visual scene",
        ),
        (
            "url=\"#g\"",
            "url=\"other.dae#g\"",
            "'other.dae#g' is no <geometry> of this file",
        ),
        ("url=\"#g\"", "", "<instance_geometry> has no url"),
        (
            "<geometry ",
            "<geometry id=\"g\"/><geometry ",
            "more than one <geometry> is called '#g'",
        ),
        (SHOWN, "", "it has no triangles"),
        (
            SHOWN,
            "<instance_controller url=\"#c\"/>",
            "<instance_controller> in a node is not handled",
        ),
        (
            SHOWN,
            "<lookat>0 0 1 0 0 0 0 1 0</lookat>",
            "<lookat> in a node is not handled",
        ),
        (SHOWN, "<skew>1 0 0 0 1 0 0</skew>", "<skew> in a node is not handled"),
        (SHOWN, &nested(70), "more than 64 deep"),
        (SHOWN, &nested(200), "nested more than 100 deep"),
        (
            "<node>",
            "<node id=\"n\"><instance_node url=\"#n\"/>",
            "or one stands in itself",
        ),
        (
            SHOWN,
            &format!("{library}<node id=\"n40\"/>"),
            "its scene has more than 100000 elements",
        ),
        (SHOWN, &many(SHOWN, 50_001), "it has more than 200000 triangles"),
        (SHOWN, &format!("<scale>1 1 0</scale>{SHOWN}"), "make its part flat"),
        (
            SHOWN,
            &format!("<scale>1 1</scale>{SHOWN}"),
            "numbers of a <scale> are no transform",
        ),
        (
            SHOWN,
            &format!("<rotate>0 0 0 90</rotate>{SHOWN}"),
            "a <rotate> has no axis",
        ),
        (
            SHOWN,
            &format!("<translate>1 nan 2</translate>{SHOWN}"),
            "'nan' in <translate>",
        ),
        (
            SHOWN,
            &format!("<translate>1 1e3 2</translate>{SHOWN}"),
            "up to 100 m either way",
        ),
        (
            SHOWN,
            &format!("<matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1</matrix>{SHOWN}"),
            "<matrix> are no transform",
        ),
        (
            &mesh(&whole_triangles),
            "<geometry id=\"g\"><spline/></geometry>",
            "geometry 'g': it has no <mesh>",
        ),
        (
            "<vertices ",
            "<vertices/><vertices ",
            "more than one <vertices> in <mesh>",
        ),
        ("<mesh>", "<mesh/><mesh>", "more than one <mesh> in <geometry>"),
        ("POSITION", "NORMAL", "no POSITION"),
        (
            "<source id=\"s\"",
            "<source id=\"t\"",
            "<source> of its positions is missing",
        ),
        (ARRAY, "", "no <float_array> or no <accessor>"),
        ("source=\"#a\"", "source=\"#b\"", "not one of X, Y and Z"),
        ("name=\"Z\"", "name=\"S\"", "not one of X, Y and Z"),
        ("0 0 1</float", "0 NaN 1</float", "'NaN' in <float_array>"),
        ("0 0 1</float", "0 1e999 1</float", "coordinates must be numbers"),
        ("0 0 1</float", "0 1&#32;1</float", "'1&1' in <float_array>"),
        (
            "0 0 1</float",
            "0 1</float",
            "12 numbers are stated; its positions have 11",
        ),
        ("count=\"12\"", "count=\"99999999999999999999\"", "is no valid number"),
        ("stride=\"3\"", "stride=\"2\"", "4 positions of 2 numbers"),
        ("stride=\"3\"", "stride=\"4\"", "4 positions of 4 numbers"),
        ("stride=\"3\"", "stride=\"3\" offset=\"1\"", "are not in its 12 numbers"),
        (
            "stride=\"3\"",
            "stride=\"18446744073709551615\"",
            "are not in its 12 numbers",
        ),
        ("source=\"#v\"", "source=\"#w\"", "no VERTEX that is <vertices>"),
        ("offset=\"0\"", "", "<input> has no offset"),
        (
            "offset=\"0\"",
            "offset=\"18446744073709551615\"",
            "are no corners of 18446744073709551615 each",
        ),
        ("offset=\"0\"", "offset=\"4\"", "12 indices are no corners of 5 each"),
        ("1 2 3</p>", "1 2 4</p>", "<triangles>: '4' is none of 4 vertices"),
        ("1 2 3</p>", "1 2 -1</p>", "'-1' in <p> is no valid number"),
        ("1 2 3</p>", "1 2</p>", "4 faces are stated; its 11 corners"),
        (
            "<triangles count=\"4\"",
            "<triangles count=\"3\"",
            "3 faces are stated; its 12 corners",
        ),
        (
            "<triangles count=\"4\"",
            "<triangles count=\"4000000000\"",
            "it has more than 200000 triangles",
        ),
        ("<triangles count=\"4\"", "<triangles", "<triangles> has no count"),
        ("</triangles>", "<ph><p>0 1 2</p></ph></triangles>", "faces with holes"),
        (
            &whole_triangles,
            &polygons("<p>0 1</p>"),
            "its 2 corners are not 1 faces of 3 and more",
        ),
        (
            &whole_triangles,
            &polygons(""),
            "1 faces are stated; its 0 corners are not 0 faces",
        ),
        (
            &whole_triangles,
            &polygons("<p>0 1 2</p><p>1 2 3</p>"),
            "1 faces are stated",
        ),
        (
            &whole_triangles,
            &polygons("<p>0 1 2</p>").replace("polygons", "polylist"),
            "1 faces are stated",
        ),
        (
            &whole_triangles,
            &polygons("<vcount>18446744073709551615 3</vcount><p>0 1 2</p>")
                .replace("count=\"1", "count=\"2")
                .replace("polygons", "polylist"),
            "2 faces are stated; its 3 corners are not 2 faces",
        ),
        (
            &whole_triangles,
            &polygons("<vcount>18446744073709551615</vcount><p>0 1 2</p>").replace("polygons", "polylist"),
            "its 3 corners are not 1 faces",
        ),
        ("</COLLADA>", "", "it is cut off in <COLLADA>"),
        ("</COLLADA>", "</COLLADA><a/>", "no XML with one outermost element"),
        ("</mesh>", "</mash>", "it is no whole XML"),
        ("<?xml version=\"1.0\"?>", "<!-- ", "it is no whole XML"),
    ];
    for (from, to, words) in cases {
        let text = tetrahedron();
        assert!(text.contains(from), "{from}");
        let said = read(text.replace(from, to).as_bytes()).unwrap_err();
        assert!(said.contains("part.dae") && said.contains(words), "{to:.300}: {said}");
    }
    assert!(read(b"").unwrap_err().contains("no XML with one outermost element"));
    let tags = format!("<a>{}</a>", many("<b/>", 2_000_000));
    assert!(read(tags.as_bytes()).unwrap_err().contains("more than 2000000 tags"));
}

proptest! {
    /// A cut file is refused, and a damaged one has other triangles, the same, or a message.
    #[test]
    fn damaged_files_never_panic(cut in 1_usize..800, at in 0_usize..2000, bytes in "[-<>/0-9a-z\"# ]{0,4}", length in 0_usize..40) {
        let text = tetrahedron();
        prop_assert!(read(&text.as_bytes()[..text.len().saturating_sub(cut)]).is_err());
        let from = at % text.len();
        let to = (from + length).min(text.len());
        let mut damaged = text.into_bytes();
        damaged.splice(from..to, bytes.bytes());
        if let Ok(triangles) = read(&damaged) {
            prop_assert!(!triangles.is_empty() && triangles.iter().flatten().flatten().all(|c| c.abs() <= 100.0));
        }
    }
}
