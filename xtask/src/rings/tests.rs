use super::*;
use std::path::Path;

/// The rings of a crate of these files; a use in a ring is shown as the line `a uses b`.
fn rings_of(files: &[(&str, &str)]) -> Vec<String> {
    let open = |path: &Path| {
        let found = files.iter().find(|(name, _)| Path::new("/c/src").join(name) == path);
        found.map(|(_, text)| (*text).to_owned())
    };
    let modules = read(Path::new("/c/src/lib.rs"), &open).unwrap();
    rings(&modules, Path::new("/c"))
}

/// Fails unless there is one ring, of these members in the order of the tree.
fn assert_ring(members: &str, files: &[(&str, &str)]) {
    let rings = rings_of(files);
    assert_eq!(rings.len(), 1, "{rings:#?}");
    assert_eq!(rings[0].lines().next(), Some(members), "{rings:#?}");
}

fn assert_none(files: &[(&str, &str)]) {
    assert_eq!(rings_of(files), Vec::<String>::new());
}

const TWO: &str = "mod a; mod b;";

#[test]
fn a_ring_of_two_is_named_with_a_line_for_each_use() {
    let files = [
        ("lib.rs", TWO),
        ("a.rs", "\nuse crate::b::B;\npub struct A(B);"),
        ("b.rs", "pub struct B;\nimpl B { fn f(_: &super::a::A) {} }"),
    ];
    let expected = "crate::a ↔ crate::b\n    crate::a uses crate::b: src/a.rs:2 (`crate::b::B`)\n    \
                    crate::b uses crate::a: src/b.rs:2 (`super::a::A`)";
    assert_eq!(rings_of(&files), [expected]);
}

#[test]
fn one_way_is_no_ring() {
    assert_none(&[
        ("lib.rs", TWO),
        ("a.rs", "use crate::b::B; pub struct A(B);"),
        ("b.rs", "pub struct B;"),
    ]);
}

#[test]
fn a_ring_of_three_is_one_ring() {
    let files = [
        ("lib.rs", "mod a; mod b; mod c; mod d;"),
        ("a.rs", "pub fn a() { crate::b::b() }"),
        ("b.rs", "pub fn b() { crate::c::c() }"),
        ("c.rs", "pub fn c() { crate::a::a(); crate::d::d() }"),
        ("d.rs", "pub fn d() {}"),
    ];
    assert_ring("crate::a ↔ crate::b ↔ crate::c", &files);
}

#[test]
fn reexports_are_followed_to_the_definition() {
    let files = [
        ("lib.rs", "mod a; mod b; pub use b::{B as Renamed, inner};"),
        ("a.rs", "pub fn a() -> crate::Renamed { crate::inner::make() }"),
        (
            "b.rs",
            "pub struct B; pub mod inner { pub use crate::b::make; } pub fn make() -> B { crate::a::a() }",
        ),
    ];
    let rings = rings_of(&files);
    assert!(
        rings.iter().any(|ring| ring.starts_with("crate::a ↔ crate::b\n")),
        "{rings:#?}"
    );
}

#[test]
fn a_name_that_only_passes_through_a_module_is_no_use_of_it() {
    let files = [
        ("lib.rs", "mod a; mod b; mod c;"),
        ("a.rs", "pub use crate::c::C; pub fn a() { crate::b::b() }"),
        ("b.rs", "pub fn b() { let _: Option<crate::a::C>; }"),
        ("c.rs", "pub struct C;"),
    ];
    assert_none(&files);
}

#[test]
fn a_function_of_a_modules_name_is_apart_from_it() {
    let files = |b: &'static str| {
        [
            ("lib.rs", "mod a; mod b; mod c; use c::b;"),
            ("a.rs", b),
            ("b.rs", "pub struct B;"),
            C,
        ]
    };
    const C: (&str, &str) = ("c.rs", "pub fn b() { crate::a::a() }");
    assert_none(&files("pub fn a() -> crate::b::B { }"));
    assert_ring("crate::a ↔ crate::c", &files("pub fn a() { crate::b() }"));
}

#[test]
fn a_function_is_found_in_the_module_of_its_name() {
    let files = [
        ("lib.rs", "mod a; mod b;"),
        ("a/mod.rs", "mod make; pub use make::make;"),
        ("a/make.rs", "pub fn make() { crate::b::b() }"),
        ("b.rs", "use crate::a; pub fn b() { a::make() }"),
    ];
    assert_ring("crate::a ↔ crate::b", &files);
}

#[test]
fn globs_are_followed() {
    let files = [
        ("lib.rs", "mod a; mod b; pub use b::*;"),
        ("a.rs", "use super::*; pub fn a(_: B) {}"),
        ("b.rs", "use crate::a::*; pub struct B; fn b() { a(B) }"),
    ];
    assert_ring("crate::a ↔ crate::b", &files);
}

#[test]
fn globs_do_not_bring_what_is_private_elsewhere() {
    let files = [
        ("lib.rs", "mod a; mod b; mod c;"),
        ("a.rs", "use crate::b::*; pub fn a() { b(); c() } fn c() {}"),
        ("b.rs", "use crate::c::Thing; pub fn b() -> Thing { Thing }"),
        ("c.rs", "pub struct Thing; fn f() { crate::a::a() }"),
    ];
    assert_ring("crate::a ↔ crate::b ↔ crate::c", &files);
    let apart = [
        files[0],
        ("a.rs", "use crate::b::*; fn a() -> Thing {}"),
        files[2],
        files[3],
    ];
    assert_none(&apart);
}

#[test]
fn imports_that_lead_round_end() {
    assert_none(&[
        ("lib.rs", TWO),
        ("a.rs", "pub use crate::b::*; fn f(_: X) {}"),
        ("b.rs", "pub use crate::a::*;"),
    ]);
    assert_none(&[
        ("lib.rs", TWO),
        ("a.rs", "pub use crate::b::X;"),
        ("b.rs", "pub use crate::a::X;"),
    ]);
}

#[test]
fn a_child_and_its_parents_own_file_are_a_ring() {
    let parent = "mod child; pub struct Shared; pub fn go() { child::go(&Shared) }";
    let child = ("a/child.rs", "use super::Shared; pub fn go(_: &Shared) {}");
    assert_ring(
        "crate::a's own file ↔ crate::a::child",
        &[("lib.rs", "mod a;"), ("a/mod.rs", parent), child],
    );
    let handed_on = "mod child; pub struct Shared; pub use child::go;";
    assert_none(&[("lib.rs", "mod a;"), ("a/mod.rs", handed_on), child]);
}

#[test]
fn a_parent_that_uses_what_it_hands_on_counts() {
    let parent = "mod child; pub struct Shared; pub use child::go; fn f() { go(&Shared) }";
    let child = ("a/child.rs", "use super::Shared; pub fn go(_: &Shared) {}");
    assert_ring(
        "crate::a's own file ↔ crate::a::child",
        &[("lib.rs", "mod a;"), ("a/mod.rs", parent), child],
    );
}

#[test]
fn a_ring_over_the_parents_own_file_is_found() {
    let files = [
        ("lib.rs", "mod a; mod b; pub struct Top; fn top() { b::b() }"),
        ("a.rs", "pub fn a(_: crate::Top) {}"),
        ("b.rs", "pub fn b() { super::a::a(todo!()) }"),
    ];
    assert_ring("crate's own file ↔ crate::a ↔ crate::b", &files);
}

#[test]
fn what_is_deep_inside_counts_for_the_level_where_they_part() {
    let files = [
        ("lib.rs", "mod a; mod b;"),
        ("a/mod.rs", "pub mod deep;"),
        ("a/deep.rs", "pub struct A; fn f() { super::super::b::b() }"),
        ("b.rs", "mod low; pub use low::b;"),
        ("b/low.rs", "use crate::a::deep; pub fn b() { let _: deep::A; }"),
    ];
    assert_ring("crate::a ↔ crate::b", &files);
}

#[test]
fn code_for_tests_does_not_count() {
    let b =
        "pub fn b() {} #[cfg(test)] use crate::a::a; #[cfg(all(test, unix))] mod checks { fn f() { crate::a::a() } }
        #[cfg(test)] mod tests; struct S; impl S { #[cfg(test)] fn f() { crate::a::a() } }
        fn g() { #[cfg(test)] crate::a::a(); #[cfg(test)] { crate::a::a() } #[cfg(test)] let _ = crate::a::a(); }";
    let a = ("a.rs", "pub fn a() { crate::b::b() }");
    assert_none(&[("lib.rs", TWO), a, ("b.rs", b)]);
    for counts in ["not(test)", "unix", "any(test, unix)", "all(unix, not(test))"] {
        let b = format!("pub fn b() {{}} #[cfg({counts})] use crate::a::a;");
        assert_ring("crate::a ↔ crate::b", &[("lib.rs", TWO), a, ("b.rs", &b)]);
    }
}

#[test]
fn inline_modules_and_files_by_path_are_modules() {
    let inline = "mod a { pub fn a() { super::b::b() } } mod b { pub fn b() { crate::a::a() } }";
    assert_ring("crate::a ↔ crate::b", &[("lib.rs", inline)]);
    let files = [
        ("lib.rs", "#[path = \"other/place.rs\"] mod a; mod b;"),
        ("other/place.rs", "mod near; pub use near::a;"),
        ("other/near.rs", "pub fn a() { crate::b::b() }"),
        ("b.rs", "pub fn b() { crate::a::a() }"),
    ];
    assert_ring("crate::a ↔ crate::b", &files);
}

#[test]
fn a_path_begins_at_the_folder_of_its_file_or_inline_module() {
    let files = [
        ("lib.rs", "mod a; mod b;"),
        (
            "a.rs",
            "#[path = \"near.rs\"] mod x; mod inline { #[path = \"far.rs\"] mod y; }",
        ),
        ("near.rs", "fn f() { crate::b::b() }"),
        ("a/inline/far.rs", "pub fn y() {}"),
        ("b.rs", "pub fn b() {}"),
    ];
    assert_none(&files);
}

#[test]
fn macros_attributes_and_imports_inside_functions_are_seen() {
    let a = ("a.rs", "pub fn a() { crate::b::b() } pub const A: u8 = 1;");
    for b in [
        "pub fn b() { println!(\"{}\", crate::a::A) }",
        "pub fn b() { use crate::a::A; assert!(A == 1) }",
        "use super::*; pub fn b() { assert!(a::A == 1) }",
        "pub fn b() {} #[derive(Serialize)] struct S { #[serde(serialize_with = \"crate::a::a\")] x: u8 }",
        "pub fn b() {} #[derive(Debug)] #[error(\"{}\", crate::a::A)] struct S;",
        "pub fn b() {} macro_rules! m { () => { $crate::a::a() } }",
    ] {
        assert_ring("crate::a ↔ crate::b", &[("lib.rs", TWO), a, ("b.rs", b)]);
    }
}

#[test]
fn a_variable_is_no_function_of_its_name() {
    let parent = |code: &str| format!("mod child; pub use child::go; pub struct Shared; {code}");
    let rings = |code: &str| {
        let files = [
            ("lib.rs", "mod a;"),
            ("a.rs", &parent(code)),
            ("a/child.rs", "pub fn go(_: &super::Shared) {}"),
        ];
        rings_of(&files).len()
    };
    assert_eq!(rings("fn f(go: u8) -> u8 { go + 1 }"), 0);
    assert_eq!(rings("fn f() { let go = 1; println!(\"{}\", go) }"), 0);
    assert_eq!(rings("fn f() { let go = go(&Shared); }"), 1);
    assert_eq!(rings("fn f() { [Shared].iter().for_each(go) }"), 1);
}

#[test]
fn paths_that_cannot_be_followed_are_named() {
    let text = "mod m { pub struct S; }\nuse crate::m::S;\nuse m::S as T;\nuse std::fmt;\n\
                fn f() { self::fmt::Debug; fmt::x(); other::y(); S::new(); T }\n\
                fn g() { crate::made::g() }\nfn h() { m::gone() }\n";
    let modules = read(Path::new("/c/src/lib.rs"), &|_| Some(text.to_owned())).unwrap();
    let expected = ["6: `crate::made::g`", "7: `m::gone`"].map(|path| format!("src/lib.rs:{path} cannot be followed"));
    assert_eq!(lost(&modules, Path::new("/c")), expected);
}

#[test]
fn what_cannot_be_read_is_named() {
    let error = |files: &[(&str, &str)]| {
        let open = |path: &Path| Some(files.iter().find(|(name, _)| path.ends_with(name))?.1.to_owned());
        read(Path::new("/c/src/lib.rs"), &open).unwrap_err().to_string()
    };
    assert_eq!(error(&[("lib.rs", "mod a;")]), "/c/src/lib.rs: module a has no file");
    assert!(error(&[("lib.rs", "mod a;"), ("a.rs", "\nfn f( {}")]).starts_with("/c/src/a.rs:2: "));
}
