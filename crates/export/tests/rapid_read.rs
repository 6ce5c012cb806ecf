//! RAPID programs that were edited: what people add is read, and everything else is refused with its line.

use crate::rapid::{every, file, program, rapid, read};
use platewash_export::dialect::ReadError;
use platewash_export::reading::Reading;
use proptest::prelude::*;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// A program as it is written: 20 targets and more.
static WRITTEN: LazyLock<String> = LazyLock::new(|| rapid().write(&program(every(30), 1.0))[0].text.clone());

/// The line, from 1, of the first text that contains these words.
fn line_of(text: &str, words: &str) -> usize {
    text.lines().position(|line| line.contains(words)).unwrap() + 1
}

/// The written program with `from` replaced once by `to`.
fn edited(from: &str, to: &str) -> String {
    assert!(WRITTEN.contains(from), "{from}");
    WRITTEN.replacen(from, to, 1)
}

/// The text of the `k`-th timed motion, with its line end.
fn motion(k: usize) -> &'static str {
    let mut motions = WRITTEN.split_inclusive('\n').filter(|line| line.contains("\\T:="));
    motions.nth(k).unwrap()
}

/// The number of the first timed motion that stops.
fn stop() -> usize {
    let mut motions = WRITTEN.lines().filter(|line| line.contains("\\T:="));
    motions.position(|line| line.contains(",fine,")).unwrap()
}

fn refused(text: &str, line: usize, words: &str) {
    let error: ReadError = read(text).map(|_| text).unwrap_err();
    assert!(error.reason.contains(words), "expected {words:?}: {error}");
    assert_eq!((error.place.line, &*error.place.file), (line, "program.mod"), "{error}");
}

/// What is added stands before the second motion, in its line.
fn added(what: &str) -> String {
    edited(motion(1), &format!("{what}\n{}", motion(1)))
}

#[test]
fn reads_usual_additions() {
    let points = |text: &str| read(text).unwrap_or_else(|error| panic!("{error}")).points;
    let expected = points(&WRITTEN);
    let same = [
        added("! a note"),
        added("TPErase;"),
        added("TPWrite \"Washing; ! not a comment\";"),
        added("TPWrite \"share \"\\Num:=pwShare;"),
        added("ErrWrite \"a\",\"b\"\\RL2:=\"c\";"),
        added("SetDO doWater,1;"),
        added("Set doWater; PulseDO\\PLength:=0.2,doBell; Reset doWater;"),
        added("ConfJ\\Off; SingArea\\Wrist;"),
        added("AccSet 100,100; VelSet 100,5000;"),
        edited("\\NoEOffs,v100", "\\NoEOffs,v50"),
        edited("\\NoEOffs,v100", ",[100,500,5000,1000]"),
        edited("pwCheckShare;\n", "pwcheckshare;\r\n"),
        edited("MODULE kitchen", "MODULE kitchen(SYSMODULE)"),
        edited("PERS tooldata", "TASK PERS tooldata"),
        edited(
            "MODULE kitchen",
            "%%%\r\n  VERSION:1\r\n  LANGUAGE:ENGLISH\r\n%%%\r\nMODULE kitchen",
        ),
        edited(
            "VAR num pwRunning:=0;",
            "VAR num pwRunning; CONST string note:=\"a\"\"b\"; PERS bool done:=FALSE;",
        ),
    ];
    for text in same {
        assert!(text != *WRITTEN);
        let found = points(&text);
        let alike = found
            .iter()
            .zip(&expected)
            .all(|(a, b)| (a.t_s, a.q_rad, a.corner_m) == (b.t_s, b.q_rad, b.corner_m));
        assert!(alike && found.len() == expected.len(), "{text}");
    }
    let count = expected.len();
    assert_eq!(points(&edited(motion(3), "")).len(), count - 1, "a dropped target");
    assert_eq!(points(&added(motion(0))).len(), count + 1, "an added target");
    let zone = points(&edited("z5,pwTool", "z10,pwTool"));
    assert!(zone.iter().any(|point| point.corner_m == Some(0.01)));
    let zone = points(&edited("z5,pwTool", "[FALSE,4,8,8,0.8,8,0.8],pwTool"));
    assert!(zone.iter().any(|point| point.corner_m == Some(0.004)));
    let waits = edited(
        motion(stop()),
        &format!("{}WaitTime 0.5;\nWaitTime\\InPos,0.25/pwRunning;\n", motion(stop())),
    );
    let waits = points(&waits);
    assert_eq!(waits.len(), count + 2);
    let longer_s = waits.last().unwrap().t_s - expected.last().unwrap().t_s;
    assert!((longer_s - 0.75).abs() < 1e-9, "{longer_s}");
    let called = edited(motion(1), &format!("Mine;\n{}", motion(1)));
    let called = called.replacen("ENDMODULE", &format!("PROC Mine()\n{}ENDPROC\nENDMODULE", motion(0)), 1);
    assert_eq!(points(&called).len(), count + 1, "a procedure of one's own");
    assert!(read(&added("EXIT;")).is_err(), "it ends in a zone");
}

/// What is added, and words of the reason.
const ADDED: [(&str, &str); 32] = [
    ("FOR k FROM 1 TO 3 DO ENDFOR", "loops, conditions and jumps"),
    ("WHILE TRUE DO ENDWHILE", "loops, conditions and jumps"),
    ("IF pwShare<0.4 EXIT;", "loops, conditions and jumps"),
    ("TEST 1 CASE 1: EXIT; ENDTEST", "loops, conditions and jumps"),
    ("GOTO again;", "loops, conditions and jumps"),
    ("again: EXIT;", "loops, conditions and jumps"),
    ("RETURN;", "loops, conditions and jumps"),
    ("RAISE;", "loops, conditions and jumps"),
    ("CONNECT i WITH t;", "loops, conditions and jumps"),
    ("VAR num i:=0;", "data in a procedure are not read"),
    ("pwRunning:=0.1;", "assignments are not read"),
    ("pwStart.robax.rax_1:=0;", "assignments are not read"),
    ("ERROR TRYNEXT;", "handlers are not read"),
    ("UNDO EXIT;", "handlers are not read"),
    ("MoveL pStart,v100,z5,pwTool;", "only MoveAbsJ with \\T is read"),
    ("MoveJ pStart,v100,z5,pwTool;", "only MoveAbsJ with \\T is read"),
    ("TriggL p,v100,t,z5,pwTool;", "only MoveAbsJ with \\T is read"),
    ("WaitDI diReady,1;", "waits for an unknown time"),
    ("Stop;", "waits for an unknown time"),
    ("%\"Mine\"%;", "expected an instruction"),
    ("Unknown;", "neither a procedure of the program"),
    ("SoftAct 1,50;", "neither a procedure of the program"),
    ("AccSet 50,100;", "expected 100,100"),
    ("VelSet 100,100;", "expected 100,5000"),
    ("pwCheckShare;", "must stand before the first motion"),
    ("pwCheckStart;", "must stand before the first motion"),
    ("WaitTime 0.5;", "expected `fine` before it"),
    ("WaitTime -0.5;", "expected a time of 0 s or more"),
    ("WaitTime 1*2;", "expected `;`"),
    ("WaitTime Sqrt(2);", "expected a number"),
    ("TPWrite \"a", "without its closing quotation mark"),
    ("SetDO doWater 1", "expected `,` or `;`"),
];

#[test]
fn rejects_other_additions_with_their_line() {
    // Before the last motion of a routine that passes its targets in zones.
    let at = line_of(&WRITTEN, motion(1).trim());
    for (what, words) in ADDED {
        let text = added(what);
        let error = read(&text).map(|_| what).unwrap_err();
        assert!(error.reason.contains(words), "{what}: {error}");
        assert!((at..=at + 1).contains(&error.place.line), "{what}: {error}");
    }
}

/// What is replaced and by what, and words of the reason; the line is that of the change.
const CHANGED: [(&str, &str, &str); 34] = [
    ("\\T:=", "\\V:=", "\\V leaves the time of the motion to the controller"),
    ("MoveAbsJ pwStart", "MoveAbsJ\\Conc,pwStart", "\\Conc"),
    ("\\NoEOffs,v100", "\\ID:=10,v100", "\\ID"),
    ("z5,pwTool", "z5\\Inpos:=inpos50,pwTool", "\\Inpos"),
    ("z5,pwTool", "z5\\Z:=3,pwTool", "\\Z"),
    ("z5,pwTool", "z7,pwTool", "expected a zonedata"),
    ("z5,pwTool", "v5,pwTool", "expected a zonedata"),
    ("z5,pwTool", "[FALSE,5,50,50,5,50,5],pwTool", "zone for turning"),
    ("pwTool\\WObj:=wobj0", "pwTool\\TLoad:=load0", "\\TLoad"),
    (
        "v20,fine",
        "v20,z5",
        "the first motion leads to the start and must stop",
    ),
    ("MoveAbsJ pwStart", "MoveAbsJ pwShare", "expected a jointtarget"),
    ("MoveAbsJ [[", "MoveAbsJ Offs([[", "expected a jointtarget"),
    (
        "9E9,9E9]]\\NoEOffs,v100",
        "9E9,0]]\\NoEOffs,v100",
        "external axes are not read",
    ),
    (
        "9E9,9E9]]\\NoEOffs,v100",
        "9E9]]\\NoEOffs,v100",
        "expected a joint target",
    ),
    ("/pwRunning", "/pwShare", "expected `pwRunning`"),
    ("/pwRunning", "*pwRunning", "expected `,`"),
    ("v100\\T:=", "v100\\T:=0*", "expected `,`"),
    ("v100\\T:=", "v100\\T:=-", "expected a time of 0 s or more"),
    ("v20,fine", "v21,fine", "expected a speeddata"),
    (
        "PERS tooldata pwTool:=[TRUE",
        "PERS tooldata pwTool:=[FALSE",
        "a tool that the arm holds",
    ),
    (
        "PERS num pwShare:=1",
        "PERS num pwShare:=1.5",
        "pwShare is 1.5. It must be above 0 and at most 1",
    ),
    (
        "PERS num pwShare:=1",
        "PERS num pwShare:=0",
        "pwShare is 0. It must be above 0",
    ),
    ("VAR num pwRunning", "CONST num pwRunning", "declared as VAR num"),
    (
        "IF pwShare>0 AND",
        "IF pwShare>-1 AND",
        "pwCheckShare is read only as it is exported",
    ),
    (
        "pwRunning:=pwShare;",
        "pwRunning:=pwShareMost;",
        "pwCheckShare is read only as it is exported",
    ),
    (
        "<=0.5 RETURN",
        "<=50 RETURN",
        "pwCheckJoint is read only as it is exported",
    ),
    (
        "now:=CJointT();",
        "now:=pwStart;",
        "pwCheckStart is read only as it is exported",
    ),
    ("PROC pwDepart", "LOCAL PROC pwDepart", "PROC without LOCAL"),
    ("PROC main()", "FUNC num main()", "CONST, PERS, VAR, PROC"),
    ("PROC main()", "TRAP main", "CONST, PERS, VAR, PROC"),
    (
        "VAR num pwRunning",
        "RECORD a num x; ENDRECORD VAR num pwRunning",
        "CONST, PERS, VAR, PROC",
    ),
    (
        "CONST num pwShareMost",
        "CONST num z5:=1; CONST num pwShareMost",
        "the controller's own",
    ),
    (
        "CONST num pwShareMost",
        "CONST num pwStart:=1; CONST num pwShareMost",
        "declared twice",
    ),
    ("PROC main()", "PROC main(num x)", "has parameters"),
];

#[test]
fn rejects_other_changes() {
    for (from, to, words) in CHANGED {
        let error = read(&edited(from, to)).map(|_| to).unwrap_err();
        assert!(error.reason.contains(words), "{to}: {error}");
        assert!(
            error.place.line >= 1 && error.place.line <= WRITTEN.lines().count(),
            "{to}: {error}"
        );
    }
    for (name, declaration) in [("WaitTime", "PROC WaitTime()"), ("Abs", "PROC Abs()")] {
        let text = edited("ENDMODULE", &format!("{declaration}\nENDPROC\nENDMODULE"));
        refused(
            &text,
            line_of(&text, declaration),
            &format!("the name {name} is the controller's own"),
        );
    }
    let text = edited("ENDMODULE", "PROC a() b; ENDPROC PROC b() a; ENDPROC\nENDMODULE").replacen(
        "pwCheckStart;\n",
        "pwCheckStart; a;\n",
        1,
    );
    refused(&text, line_of(&text, "PROC a()"), "runs itself");
    refused(
        &edited(
            "    EXIT;\n  ENDPROC\n\n  PROC pwCheckShare",
            "  ENDPROC\n\n  PROC pwCheckShare",
        ),
        line_of(&WRITTEN, "PROC main"),
        "main ends without EXIT",
    );
}

/// The checks count where they stand before the first motion and compare with where it leads.
#[test]
fn counts_the_start_check_only_before_the_motion() {
    let read = |text: String| -> Result<Reading, ReadError> { read(&text) };
    assert!(read(WRITTEN.clone()).unwrap().start_within_deg.is_some());
    assert!(
        read(edited("    pwCheckStart;\n", ""))
            .unwrap()
            .start_within_deg
            .is_none()
    );
    let error = read(edited("    pwCheckShare;\n", "")).unwrap_err();
    assert!(
        error
            .reason
            .contains("expected pwCheckShare before the first use of `pwRunning`"),
        "{error}"
    );
    let error = read(edited(
        "MoveAbsJ pwStart",
        "MoveAbsJ [[1,0,0,0,90,0],[9E9,9E9,9E9,9E9,9E9,9E9]]",
    ))
    .unwrap_err();
    assert!(
        error.reason.contains("expected the first motion to lead there"),
        "{error}"
    );
    let text = edited(
        "PROC pwCheckJoint(num joint,num found,num expected)",
        "PROC pwOther(num joint,num found,num expected)",
    );
    assert!(read(text).is_err());
}

#[test]
fn rejects_comments_that_other_readers_end_earlier() {
    for end in ["\r", "\u{85}", "\u{2028}", "\u{2029}", "\u{b}", "\u{c}", "\u{1a}"] {
        let text = added(&format!("! a note{end}{}", motion(0).trim()));
        refused(&text, line_of(&WRITTEN, motion(1).trim()), "found the character");
    }
    let header = format!("%%%\n  VERSION:1\n{}%%%\nMODULE kitchen", motion(0));
    refused(&edited("MODULE kitchen", &header), 3, "expected `MODULE`");
}

#[test]
fn finds_a_tool_with_another_inertia() {
    let tool = |text: &str| read(text).unwrap().tool;
    assert_ne!(tool(&WRITTEN), tool(&edited("0.0005925,0.0005925", "5,5")));
    let second = edited(
        "PERS num pwShare",
        "PERS tooldata other:=[TRUE,[[0,0,100],[1,0,0,0]],[0.3,[0,0,75],[1,0,0,0],0,0,0]];\n  PERS num pwShare",
    );
    let error = read(&second.replacen("z5,pwTool", "z5,other", 1)).unwrap_err();
    assert!(error.reason.contains("the tool of the motions before"), "{error}");
}

#[test]
fn a_slower_share_is_read_as_slower_times() {
    let reading = read(&edited("pwShare:=1;", "pwShare:=0.1;")).unwrap();
    assert_eq!(reading.speed_share, Some(0.1));
    let [slow_s, whole_s] = [&reading, &read(&WRITTEN).unwrap()].map(|reading| reading.points.last().unwrap().t_s);
    assert!((slow_s - 10.0 * whole_s).abs() < 1e-3);
}

#[test]
fn modules_may_be_in_several_files() {
    let (first, routine) = WRITTEN.split_at(WRITTEN.rfind("\n  PROC ").unwrap());
    let routine = routine.replacen("ENDMODULE", "", 1);
    let files = [
        file(&format!("{first}\nENDMODULE\n")),
        file(&format!("MODULE more\n{routine}\nENDMODULE\n")),
    ];
    let arm = platewash_kinematics::RobotModel::irb120().unwrap();
    assert_eq!(
        rapid().read(&files, &arm).unwrap().points.len(),
        read(&WRITTEN).unwrap().points.len()
    );
    let error = rapid().read(&files[..1], &arm).unwrap_err();
    assert!(error.reason.contains("neither a procedure of the program"), "{error}");
}

proptest! {
    /// A damaged program is read or refused, soon and without a panic.
    #[test]
    fn damaged_programs_are_read_or_refused(
        edits in proptest::collection::vec((any::<prop::sample::Index>(), 0_u8..6, any::<u8>()), 1..6),
    ) {
        let mut bytes = WRITTEN.as_bytes().to_vec();
        for (index, kind, byte) in edits {
            let at = index.index(bytes.len());
            match kind {
                0 => bytes[at] ^= 1 << (byte % 8),
                1 => bytes[at] = byte,
                2 => bytes.truncate(at.max(1)),
                3 => { bytes.remove(at); if bytes.is_empty() { bytes.push(b' '); } }
                4 => bytes.splice(at..at, b"9E38*9".iter().copied()).for_each(drop),
                _ => bytes.splice(at..at, "([{IF NOT -".repeat(usize::from(byte)).into_bytes()).for_each(drop),
            }
        }
        let started = Instant::now();
        if let Ok(reading) = read(&String::from_utf8_lossy(&bytes)) {
            prop_assert!(reading.points.iter().all(|point| point.t_s.is_finite() && point.q_rad.iter().all(|q| q.is_finite())));
            prop_assert!(reading.points.windows(2).all(|pair| pair[1].t_s >= pair[0].t_s));
        }
        prop_assert!(started.elapsed() < Duration::from_secs(120));
    }
}
