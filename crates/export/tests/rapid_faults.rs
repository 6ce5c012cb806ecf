//! Programs that a controller would not run, or whose motion cannot be judged: each is refused with its line and the reason. And

//! programs at random, which must end one way or the other.

use crate::rapid::{every, program, rapid, read};
use proptest::prelude::*;
use std::time::{Duration, Instant};

const SOUND: &str = include_str!("fixtures/rapid/sound.mod");
const CONSTRUCTS: &str = include_str!("fixtures/rapid/constructs.mod");

/// What is edited, what it becomes, the line that is refused, and words of the reason.
const FAULTS: [(&str, &str, usize, &str); 52] = [
    (
        "T:=0.25/pwShare,z5",
        "T:=0/pwShare,z5",
        23,
        "expected a time above 0 s after \\T, found 0",
    ),
    (
        "T:=0.25/pwShare,z5",
        "T:=-0.25/pwShare,z5",
        23,
        "expected a time above 0 s",
    ),
    (
        "v100\\T:=0.25/pwShare,z5",
        "v100,z5",
        23,
        "expected \\T after the speed, found none",
    ),
    (
        "v100\\T:=0.25/pwShare,z5",
        "v100\\V:=50,z5",
        23,
        "\\V leaves the time of the motion to the controller",
    ),
    (
        "v100\\T:=0.25/pwShare,z5",
        "v100\\T,z5",
        23,
        "expected \\T:= and a time",
    ),
    (
        "v100\\T:=0.25/pwShare,z5",
        "v100,z5\\T:=0.25",
        23,
        "expected \\T after 2 arguments of MoveAbsJ, found it after 3",
    ),
    (
        "MoveAbsJ aside\\NoEOffs,",
        "MoveAbsJ\\Conc,aside\\NoEOffs,",
        23,
        "\\Conc",
    ),
    ("MoveAbsJ aside\\NoEOffs,", "MoveAbsJ aside\\ID:=10,", 23, "\\ID"),
    ("z5,brush", "z5\\Inpos:=inpos50,brush", 23, "\\Inpos"),
    ("z5,brush", "z5\\Z:=3,brush", 23, "\\Z"),
    ("z5,brush", "z7,brush", 23, "the name z7 is not declared"),
    ("z5,brush", "v5,brush", 23, "expected a zonedata, found a speeddata"),
    (
        "z5,brush",
        "[FALSE,-5,8,8,.8,8,.8],brush",
        23,
        "a zone's radius of 0 mm or more",
    ),
    (
        "z5,brush",
        "z5,other",
        23,
        "expected the tool of the motions before, found another one",
    ),
    ("z5,brush", "z5,tool0", 23, "expected the tool of the motions before"),
    (
        "z5,brush\\WObj:=wobj0",
        "z5,brush\\WObj:=table",
        23,
        "expected the work object wobj0",
    ),
    ("z5,brush\\WObj:=wobj0", "z5,brush\\TLoad:=load0", 23, "\\TLoad"),
    (
        "z5,brush\\WObj:=wobj0",
        "z5",
        23,
        "expected 4 arguments of MoveAbsJ, found 3",
    ),
    (
        "MoveAbsJ aside",
        "MoveAbsJ [[10,0,0,0,9E9,0],[9E9,9E9,9E9,9E9,9E9,9E9]]",
        23,
        "an angle in degrees for joint 5",
    ),
    (
        "MoveAbsJ aside",
        "MoveAbsJ [[10,0,0,0,90,0],[0,9E9,9E9,9E9,9E9,9E9]]",
        23,
        "expected 9E9 for the external axis eax_a",
    ),
    (
        "MoveAbsJ aside",
        "MoveAbsJ [[10,0,0,0,90],[9E9,9E9,9E9,9E9,9E9,9E9]]",
        23,
        "expected 6 elements in a robjoint, found 5",
    ),
    (
        "MoveAbsJ aside",
        "MoveAbsJ [[TRUE,0,0,0,90,0],[9E9,9E9,9E9,9E9,9E9,9E9]]",
        23,
        "expected a num, found a bool",
    ),
    (
        "MoveAbsJ aside\\NoEOffs",
        "MoveL Offs(aside,0,0,1)",
        23,
        "MoveL is not modelled: it needs inverse kinematics",
    ),
    ("MoveAbsJ aside\\NoEOffs", "MoveJ aside", 23, "MoveJ is not modelled"),
    (
        "MoveAbsJ aside\\NoEOffs",
        "MoveC aside,aside",
        23,
        "MoveC is not modelled",
    ),
    ("MoveAbsJ aside", "MoveAbsJ asid", 23, "the name asid is not declared"),
    (
        "MoveAbsJ aside",
        "MoveAbsJX aside",
        23,
        "MoveAbsJX is no procedure of the program",
    ),
    (
        "v20,fine,brush",
        "v20,z5,brush",
        13,
        "must stop there: expected `fine`, found a zone",
    ),
    (
        "T:=0.5/pwShare,fine,brush",
        "T:=0.5/pwShare,z1,brush",
        16,
        "the last motion must stop",
    ),
    (
        "T:=0.25/pwShare,fine,brush",
        "T:=0.25/pwShare,z5,brush",
        15,
        "WaitTime after a motion that does not stop",
    ),
    ("WaitTime 0.5", "WaitTime -0.5", 15, "expected a time of 0 s or more"),
    (
        "WaitTime 0.5",
        "WaitUntil i=6",
        15,
        "WaitUntil is not modelled: it waits",
    ),
    ("WaitTime 0.5", "Stop", 15, "Stop is not modelled: it waits"),
    (
        "WaitTime 0.5",
        "SetDO water,1",
        15,
        "SetDO is not modelled: it sets a signal",
    ),
    (
        "WaitTime 0.5",
        "ActUnit TRACK",
        15,
        "ActUnit is not modelled: it changes what motions mean",
    ),
    ("WaitTime 0.5", "GripLoad load0", 15, "GripLoad is not modelled"),
    (
        "WaitTime 0.5",
        "pwShare:=0.5",
        15,
        "a persistent keeps what it is given",
    ),
    ("WaitTime 0.5", "i:=1/(i-6)", 15, "expected a divisor other than 0"),
    ("WaitTime 0.5", "GOTO nowhere", 15, "there is no label nowhere"),
    (
        "AccSet 100,100",
        "AccSet 50,100",
        12,
        "other than 100 % changes how long motions take",
    ),
    ("AccSet 100,100", "VelSet 50,5000", 12, "other than 100 %"),
    (
        "AccSet 100,100",
        "RAISE 3",
        12,
        "not modelled: what is done after an error",
    ),
    (
        "AccSet 100,100",
        "start:=aside",
        12,
        "expected a variable or a persistent, found a constant",
    ),
    (
        "pwShare:=1",
        "pwShare:=1.5",
        13,
        "expected a share of the speed above 0 and at most 1 in pwShare, found 1.5",
    ),
    ("pwShare:=1", "pwShare:=0", 13, "expected a share of the speed"),
    ("pwShare:=1", "pwShare", 5, "the persistent pwShare has no value here"),
    (
        "brush:=[TRUE",
        "brush:=[FALSE",
        13,
        "expected a tool that the arm holds",
    ),
    (
        "brush:=[TRUE,[[0,0,150],[1,0,0,0]],[0.3,",
        "brush:=[TRUE,[[0,0,150],[1,0,0,0]],[0,",
        13,
        "mass of at least 0.001 kg",
    ),
    (
        "[0.3,[0,0,75],",
        "[0.3,[0,0,0],",
        13,
        "expected a centre of mass away from the flange",
    ),
    (
        "brush:=[TRUE,[[0,0,150],[1,0,0,0]]",
        "brush:=[TRUE,[[0,0,150],[1,1,0,0]]",
        13,
        "a quaternion of length 1",
    ),
    (
        "now.robax.rax_1-",
        "now.robax.rax_7-",
        30,
        "a robjoint has no component rax_7",
    ),
    ("i:=i+n", "i:=i+\"n\"", 21, "expected operands that Plus is for"),
];

#[test]
fn the_sound_program_is_read() {
    let reading = read(SOUND).unwrap();
    let times: Vec<f64> = reading.points.iter().map(|point| point.t_s).collect();
    assert_eq!(times, [0.0, 0.25, 0.5, 1.0, 1.5]);
    let corners: Vec<_> = reading.points.iter().map(|point| point.corner_m).collect();
    assert_eq!(corners, [None, Some(0.005), None, None, None]);
}

#[test]
fn each_fault_is_refused_with_its_line() {
    for (from, to, line, words) in FAULTS {
        let edited = SOUND.replacen(from, to, 1);
        assert_ne!(edited, SOUND, "{from}");
        let error = read(&edited).map(|_| to).unwrap_err();
        assert_eq!(error.place.line, line, "{to}: {error}");
        assert!(error.reason.contains(words), "{to}: {error}");
        assert_eq!(error.place.file, "program.mod");
    }
}

/// Whole declarations that are added, with the reason.
const ADDED: [(&str, &str); 15] = [
    (
        "PROC WaitTime(num t) ENDPROC",
        "the name WaitTime is the controller's own",
    ),
    ("PROC main()\nENDPROC", "the name main is declared twice"),
    ("VAR num i;", "the name i is declared twice"),
    ("RECORD pos num x; ENDRECORD", "the type pos is declared twice"),
    (
        "VAR num b:=c; VAR num c:=b; PROC Moves2() i:=b; ENDPROC",
        "depends on itself",
    ),
    (
        "VAR dnum b:=1; PROC Moves2() b:=b; ENDPROC",
        "data of the type dnum are not modelled",
    ),
    ("PROC Moves2() Moves2; ENDPROC", "deep within each other"),
    (
        "PROC Moves2() WHILE TRUE DO i:=0; ENDWHILE ENDPROC",
        "has not ended after 10000000 steps",
    ),
    (
        "PROC Moves2() again: GOTO again; ENDPROC",
        "has not ended after 10000000 steps",
    ),
    (
        "PROC Moves2() FOR k FROM 1 TO 9E9 DO ENDFOR ENDPROC",
        "has not ended after 10000000 steps",
    ),
    (
        "VAR num b{100000,100000}; PROC Moves2() b{1,1}:=1; ENDPROC",
        "expected at most 100000 values in b",
    ),
    (
        "VAR num b{3}; PROC Moves2() b{4}:=1; ENDPROC",
        "expected an index from 1 to 3, found 4",
    ),
    (
        "PROC Moves2() i:=9E9*9E9*9E9*9E9*9E9; ENDPROC",
        "expected a result within",
    ),
    (
        "PROC Moves2() VAR string s; WHILE TRUE DO s:=s+\"x\"; ENDWHILE ENDPROC",
        "at most 80 characters, found 81",
    ),
    (
        "FUNC num f() ENDFUNC PROC Moves2() i:=f(); ENDPROC",
        "f ends without a value",
    ),
];

#[test]
fn declarations_that_cannot_be_are_refused_and_loops_end() {
    for (added, words) in ADDED {
        let mut edited = SOUND.replace("ENDMODULE", &format!("{added}\nENDMODULE"));
        if added.contains("Moves2()") {
            edited = edited.replacen("    Moves;", "    Moves2;", 1);
        }
        assert_ne!(edited, SOUND);
        let started = Instant::now();
        let error = read(&edited).map(|_| added).unwrap_err();
        assert!(error.reason.contains(words), "{added}: {error}");
        assert!(
            started.elapsed() < Duration::from_secs(20),
            "{added}: {:?}",
            started.elapsed()
        );
    }
}

#[test]
fn what_is_told_about_the_start_is_what_is_moved_to() {
    // The check is told the first target of the text; a program that then moves elsewhere is refused.
    let edited = SOUND.replacen(
        "    MoveAbsJ start",
        "    IF i>0 MoveAbsJ aside,v20,fine,brush;\n    MoveAbsJ start",
        1,
    );
    let error = read(&edited).unwrap_err();
    assert!(
        error.reason.contains("before any motion; it says: Joint 1 is away"),
        "{error}"
    );
    let edited = edited.replacen(
        "MoveAbsJ aside",
        "MoveAbsJ [[0.2,0,0,0,90,0],[9E9,9E9,9E9,9E9,9E9,9E9]]",
        1,
    );
    let error = read(&edited).unwrap_err();
    assert_eq!(error.place.line, 14);
    assert!(error.reason.contains("it moves elsewhere first"), "{error}");
}

#[test]
fn a_share_that_is_too_large_ends_the_program_that_is_written_with_its_message() {
    let program = program(every(30), 1.0);
    let files = rapid().write(&program);
    for share in ["0", "-1", "1.01"] {
        let edited = files[0].text.replacen("pwShare:=1;", &format!("pwShare:={share};"), 1);
        assert_ne!(edited, files[0].text);
        let error = read(&edited).unwrap_err();
        assert!(
            error
                .reason
                .contains(&format!("it says: pwShare is {share}. It must be above 0")),
            "{error}"
        );
    }
    let away = files[0]
        .text
        .replacen("now:=CJointT();", "now:=CJointT();now.robax.rax_4:=-0.6;", 1);
    assert_ne!(away, files[0].text);
    let error = read(&away).unwrap_err();
    let words =
        "it says: Joint 4 stands at -0.6000 deg. The program starts at 0.0000 deg. That is more than 0.5 deg away";
    assert!(error.reason.contains(words), "{error}");
}

#[test]
fn a_slower_share_is_read_as_slower_times() {
    let program = program(every(30), 1.0);
    let files = rapid().write(&program);
    let edited = files[0].text.replacen("pwShare:=1;", "pwShare:=0.1;", 1);
    let reading = read(&edited).unwrap();
    assert_eq!(reading.speed_share, Some(0.1));
    let slow_s = reading.points.last().unwrap().t_s;
    assert!((slow_s - 10.0 * program.duration_s()).abs() < 1e-3);
}

proptest! {
    #[test]
    fn damaged_programs_end_one_way_or_the_other(
        which in 0_usize..3,
        edits in proptest::collection::vec((any::<prop::sample::Index>(), 0_u8..6, any::<u8>()), 1..6),
    ) {
        let written;
        let text = match which {
            0 => SOUND,
            1 => CONSTRUCTS,
            _ => {
                written = rapid().write(&program(every(200), 1.0));
                &written[0].text
            }
        };
        let mut bytes = text.as_bytes().to_vec();
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
        // Either is right; a panic or a hang is not.
        let outcome = read(&String::from_utf8_lossy(&bytes));
        if let Ok(reading) = &outcome {
            prop_assert!(reading.points.iter().all(|point| point.t_s.is_finite() && point.q_rad.iter().all(|q| q.is_finite())));
            prop_assert!(reading.points.windows(2).all(|pair| pair[1].t_s >= pair[0].t_s));
        }
        prop_assert!(started.elapsed() < Duration::from_secs(20));
    }
}
