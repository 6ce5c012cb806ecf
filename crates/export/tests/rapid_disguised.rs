//! Edits after which a controller would do something else than what a plain reading of the text shows: each is refused with its line.

use crate::rapid::read;
use platewash_export::dialect::Dialect;
use platewash_export::file::ProgramFile;
use platewash_export::rapid::Rapid;
use platewash_kinematics::RobotModel;

const SOUND: &str = include_str!("fixtures/rapid/sound.mod");
const ELSEWHERE: &str = "MoveAbsJ aside,v100\\T:=0.5,fine,brush;";

/// The sound program with some texts replaced, each of which must be there.
fn edited(edits: &[(&str, &str)]) -> String {
    edits.iter().fold(SOUND.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1)
    })
}

fn refused(edits: &[(&str, &str)], line: usize, words: &str) {
    let error = read(&edited(edits)).map(|_| ()).unwrap_err();
    assert!(error.reason.contains(words), "{edits:?}: {error}");
    assert_eq!(error.place.line, line, "{error}");
}

#[test]
fn state_that_outlives_the_run_is_refused() {
    let counts = format!("i:=i+1; IF i>1 {ELSEWHERE}");
    refused(
        &[("VAR num i;", "PERS num i:=0;"), ("    Moves;", &counts)],
        14,
        "a persistent keeps what it is given for the next run",
    );
    refused(
        &[(" EXIT;\n  ENDPROC\n\n  PROC Moves", "\n  ENDPROC\n\n  PROC Moves")],
        10,
        "main ends without EXIT",
    );
    refused(
        &[
            ("PERS num pwShare:=1", "VAR num pwShare:=1"),
            ("WaitTime 0.5", "pwShare:=0.5"),
        ],
        16,
        "pwShare was 1 and is 0.5 now",
    );
}

#[test]
fn motion_must_not_depend_on_where_the_arm_stands() {
    for condition in [
        "found.robax.rax_1<>0",
        "Abs(found.robax.rax_5-90)>0.2",
        "found.robax.rax_3<-0.1",
    ] {
        let asks = format!("found:=CJointT(); isAway:={condition}; AccSet 100,100;");
        refused(
            &[
                ("VAR num i;", "VAR num i; VAR bool isAway; VAR jointtarget found;"),
                ("AccSet 100,100;", &asks),
                ("    Moves;", &format!("    IF isAway {ELSEWHERE}\n    Moves;")),
            ],
            14,
            "the motion depends on where the arm stands",
        );
    }
    // Only there it does what is not modelled.
    refused(
        &[("      EXIT;", "      MoveL start,v20,fine,brush;")],
        32,
        "MoveL is not modelled",
    );
}

#[test]
fn the_program_begins_in_the_global_main() {
    let file = |name: &str, text: String| ProgramFile {
        name: name.to_owned(),
        text,
    };
    let files = [
        file("sound.mod", edited(&[("PROC main", "LOCAL PROC main")])),
        file(
            "other.mod",
            format!("MODULE Other\nPROC main()\n{ELSEWHERE}\nEXIT;\nENDPROC\nENDMODULE\n"),
        ),
    ];
    let arm = RobotModel::irb120().unwrap();
    let both = Rapid.read(&files, &arm).unwrap();
    assert_eq!(both.points.len(), 1, "that of the other module, which moves once");
    let error = Rapid.read(&files[..1], &arm).unwrap_err();
    assert!(error.reason.contains("`main` that is not LOCAL"), "{error}");
}

#[test]
fn names_of_the_controller_keep_their_meaning() {
    let z5 = "VAR num i; LOCAL CONST zonedata z5:=[FALSE,5,8,8,.8,8,.8];";
    refused(&[("VAR num i;", z5)], 8, "the name z5 is the controller's own");
    let stop = "\n  PROC Stop()\n  ENDPROC\n  PROC Moves()";
    refused(
        &[("\n  PROC Moves()", stop)],
        19,
        "the name Stop is the controller's own",
    );
}

#[test]
fn limits_that_a_controller_would_apply_are_refused() {
    refused(
        &[("AccSet 100,100", "VelSet 100,100")],
        12,
        "expected 100 and 5000 or more",
    );
    read(&edited(&[("AccSet 100,100", "VelSet 100,5000")])).unwrap();
    refused(&[("z5", "[FALSE,5,50,50,5,50,5]")], 23, "zone for turning (pzone_ori)");
    read(&edited(&[("z5", "[FALSE,5,10,10,1,10,1]")])).unwrap();
}

#[test]
fn what_is_a_comment_here_is_one_for_everybody() {
    for end in ["\r", "\u{85}", "\u{2028}", "\u{2029}", "\u{b}", "\u{c}", "\u{1a}"] {
        let comment = format!("    ! a note{end}{ELSEWHERE}\n    Moves;");
        refused(&[("    Moves;", &comment)], 14, "found the character");
    }
    let header = format!("%%%\n  VERSION:1\n{ELSEWHERE}\n%%%\nMODULE Sound");
    refused(&[("MODULE Sound", &header)], 1, "expected `MODULE`");
    read(&edited(&[(
        "MODULE Sound",
        "%%%\r\n  VERSION:1.0\r\n  LANGUAGE:ENGLISH\r\n%%%\r\nMODULE Sound",
    )]))
    .unwrap();
}

#[test]
fn handlers_are_refused_where_they_could_run() {
    for kind in ["ERROR", "ERROR(ERR_PATH_STOP)", "UNDO", "BACKWARD"] {
        let handler = format!("i:=0;\n  {kind}\n    {ELSEWHERE}\n  ENDPROC\n\n  PROC CheckStart");
        refused(&[("\n  ENDPROC\n\n  PROC CheckStart", &handler)], 26, "handlers");
    }
}

#[test]
fn a_parameter_that_is_handed_on_is_a_copy() {
    let routines = format!(
        "PROC Clear(\\num x)\n x:=0;\n ENDPROC\n PROC Maybe(\\num y)\n Clear\\x?y;\n IF y>0 THEN\n {ELSEWHERE}\n ENDIF\n ENDPROC\n PROC Moves()"
    );
    let text = edited(&[
        ("    Moves;", "    Maybe\\y:=1;\n    Moves;"),
        ("PROC Moves()", &routines),
    ]);
    let [plain, moved] = [SOUND, &text].map(|text| read(text).unwrap().points.len());
    assert_eq!(moved, plain + 1, "y is 1 still, and the arm moves aside");
    let by_reference = text.replace("Clear(\\num x)", "Clear(\\INOUT num x)");
    assert_eq!(read(&by_reference).unwrap().points.len(), plain);
}

#[test]
fn another_inertia_is_another_tool() {
    let [a, b] = ["0.001,0.001,0.0001", "5,5,5"].map(|inertia| {
        let text = edited(&[("0.001,0.001,0.0001", inertia)]);
        read(&text).unwrap().tool
    });
    assert_ne!(a, b);
}

/// At a smaller share of the speed it would leave out a stretch: what is judged at the stated one says nothing of that.
#[test]
fn a_motion_that_depends_on_the_share_is_refused() {
    let asks = format!("    IF pwShare<0.4 {ELSEWHERE}\n    Moves;");
    refused(&[("    Moves;", &asks)], 14, "at a smaller pwShare");
    // As much slower as it says is what a share is for.
    assert!(read(&edited(&[("PERS num pwShare:=1", "PERS num pwShare:=0.7")])).is_ok());
}
