//! The language that modules are read in: every construct, and what is wrong with a text.

use crate::rapid::read;
use platewash_export::rapid::syntax::parse;
use platewash_kinematics::JointVector;
use std::fmt::Write;
use std::time::Instant;

const CONSTRUCTS: &str = include_str!("fixtures/rapid/constructs.mod");
const PARSED: &str = include_str!("fixtures/rapid/parsed.mod");

#[test]
fn every_construct_is_run_as_it_should_be() {
    let as_is = read(CONSTRUCTS).unwrap();
    let other_ends = read(&CONSTRUCTS.replace('\n', "\r\n")).unwrap();
    let small_letters = read(&in_small_letters(CONSTRUCTS)).unwrap();
    assert_eq!(as_is.points, other_ends.points);
    assert_eq!(as_is.points, small_letters.points);

    let degrees = [
        [0.0, 0.0, 0.0, 0.0, 90.0, 0.0],
        [-15.0, 0.0, 0.0, 0.0, 90.0, 0.0],
        [10.0, -20.0, 5.5, 0.0, 45.0, -90.0],
    ];
    let [park, turned, low] = degrees.map(|degrees| JointVector::from(degrees).map(f64::to_radians));
    let expected = [
        (0.0, park, None),
        (0.5, turned, Some(0.005)),
        (1.5, low, Some(0.004)),
        (3.0, park, None),
        (3.5, park, None),
    ];
    assert_eq!(as_is.points.len(), expected.len());
    for (point, (t_s, q_rad, corner_m)) in as_is.points.iter().zip(expected) {
        assert_eq!((point.t_s, point.q_rad, point.corner_m), (t_s, q_rad, corner_m));
        let line = CONSTRUCTS.lines().nth(point.place.line - 1).unwrap();
        let words = ["MoveAbsJ", "WaitTime", "jointtarget park:="];
        assert!(words.into_iter().any(|word| line.contains(word)), "{line}");
    }
    assert_eq!(as_is.speed_share, Some(0.5));
    let tool = as_is.tool.unwrap();
    assert_eq!((tool.mass_kg, tool.com_m), (0.75, [0.001, -0.002, 0.06]));
    assert_eq!(tool.tip.unwrap().translation.z, 0.1205);
}

/// All but strings in small letters: names and keywords know no case.
fn in_small_letters(text: &str) -> String {
    let parts = text.split('"').enumerate();
    let lowered = parts.map(|(index, part)| {
        if index % 2 == 0 {
            part.to_lowercase()
        } else {
            part.to_owned()
        }
    });
    lowered.collect::<Vec<_>>().join("\"")
}

#[test]
fn what_is_not_run_is_read_all_the_same() {
    let reading = read(PARSED).unwrap();
    assert_eq!(reading.points.len(), 2);
    let modules = parse(PARSED).unwrap();
    let module = &modules[0];
    assert_eq!(module.attributes, ["SYSMODULE"]);
    assert_eq!(
        module
            .routines
            .iter()
            .map(|routine| routine.handlers.len())
            .collect::<Vec<_>>(),
        [0, 4, 0]
    );
    assert_eq!(module.routines[1].parameters.len(), 4);
}

#[test]
fn a_check_that_fails_is_noticed() {
    let edited = CONSTRUCTS.replace("2+3*4=14", "2+3*4=20");
    assert_ne!(edited, CONSTRUCTS);
    let error = read(&edited).unwrap_err();
    assert!(
        error
            .reason
            .contains("before any motion; it says: Not so: products before sums"),
        "{error}"
    );
}

/// Texts that are no modules: what stands in a module's body, on line 2 of the text or later, and what is said of it.
const NO_RAPID: [(&str, usize, &str); 16] = [
    (
        "PROC main()\nMoveAbsJ park v20;\nENDPROC",
        3,
        "expected `,`, `\\` or `;`, found the name v20",
    ),
    (
        "PROC main()\nIF TRUE THEN\nENDPROC",
        4,
        "expected a statement or `ENDIF`, found `ENDPROC`",
    ),
    ("PROC main()\nEXIT\nENDPROC", 4, "expected `;`, found `ENDPROC`"),
    ("VAR num a:=[1,2;", 2, "expected `,` or `]`, found `;`"),
    ("VAR num a{3:=1;", 2, "expected `,` or `}`, found `:=`"),
    ("CONST num a;", 2, "expected `:=` and the constant's value"),
    ("VAR num while;", 2, "expected a name for the data, found `WHILE`"),
    ("VAR num a:=1+;", 2, "expected an expression, found `;`"),
    ("VAR string a:=\"open;\n", 2, "that ends the string on its line"),
    ("VAR string a:=\"\\q1\";", 2, "two hexadecimal digits after a `\\`"),
    ("VAR num a:=1E99;", 2, "expected a number within"),
    ("VAR num a:=12abc;", 2, "expected a number within"),
    ("VAR num a # 1;", 2, "found the character '#'"),
    (
        "VAR num aNameThatIsLongerThanAnyControllerTakes;",
        2,
        "at most 32 characters, found 39",
    ),
    (
        "PROC main()\nFOR i FROM 1 DO\nENDFOR\nENDPROC",
        3,
        "expected `TO`, found `DO`",
    ),
    (
        "PROC main(num{*} a)\nENDPROC",
        2,
        "expected the name of a parameter, found `{`",
    ),
];

#[test]
fn what_is_no_rapid_is_refused_with_its_line() {
    for (body, line, words) in NO_RAPID {
        let error = read(&format!("MODULE M\n{body}\nENDMODULE\n")).unwrap_err();
        assert_eq!(error.place.line, line, "{body}: {error}");
        assert!(error.reason.contains(words), "{body}: {error}");
    }
    for (text, words) in [
        ("", "found the end of the file"),
        ("MODULE", "the module's name"),
        ("%%%", "found `%`"),
    ] {
        let error = read(text).unwrap_err();
        assert!(error.reason.contains(words), "{error}");
    }
}

#[test]
fn nesting_is_bounded() {
    let many = 100_000;
    let texts = [
        format!(
            "MODULE M\nVAR num a:={}1{};\nENDMODULE",
            "(".repeat(many),
            ")".repeat(many)
        ),
        format!("MODULE M\nVAR num a:={}1;\nENDMODULE", "[".repeat(many)),
        format!("MODULE M\nVAR num a:={}1;\nENDMODULE", "-".repeat(many)),
        format!("MODULE M\nVAR bool a:={}TRUE;\nENDMODULE", "NOT ".repeat(many)),
        format!("MODULE M\nPROC main()\n{}\nENDPROC\nENDMODULE", "IF TRUE ".repeat(many)),
        format!(
            "MODULE M\nPROC main()\n{}\nENDPROC\nENDMODULE",
            "WHILE TRUE DO ".repeat(many)
        ),
        format!(
            "MODULE M\nVAR num a:={}1{};\nENDMODULE",
            "Abs(".repeat(many),
            ")".repeat(many)
        ),
    ];
    for text in texts {
        let error = read(&text).unwrap_err();
        assert!(error.reason.contains("within each other"), "{error}");
    }
    // Long is not deep.
    let sum = vec!["1"; many].join("+");
    assert!(parse(&format!("MODULE M\nVAR num a:={sum};\nENDMODULE")).is_ok());
    let path = ".a".repeat(many);
    assert!(parse(&format!("MODULE M\nPROC main()\nx{path}:=1;\nENDPROC\nENDMODULE")).is_ok());
}

#[test]
fn five_thousand_lines_are_read_at_once() {
    let mut text = String::from("MODULE Long\n");
    text.push_str("  CONST jointtarget s:=[[0,0,0,0,90,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n  PROC main()\n");
    text.push_str("    MoveAbsJ s,v20,fine,tool0;\n");
    for step in 0..5000 {
        let angle = f64::from(step % 180) / 2.0;
        writeln!(
            text,
            "    MoveAbsJ [[{angle},1,2,3,4,5],[9E9,9E9,9E9,9E9,9E9,9E9]],v20\\T:=0.02,z5,tool0;"
        )
        .unwrap();
    }
    text.push_str("    MoveAbsJ s,v20\\T:=1,fine,tool0;\n    EXIT;\n  ENDPROC\nENDMODULE\n");
    let started = Instant::now();
    let reading = read(&text).unwrap();
    assert_eq!(reading.points.len(), 5002);
    assert!(started.elapsed().as_secs_f64() < 1.0, "{:?}", started.elapsed());
}
