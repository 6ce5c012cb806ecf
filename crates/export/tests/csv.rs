//! Tables: written, read back, refused.

use crate::programs::{damaged, edited, file, plan, points, program, ur5};
use platewash_export::csv::Csv;
use platewash_export::dialect::{Dialect, ReadError};
use platewash_export::reading::{Reading, SegmentShape};
use platewash_kinematics::{JointVector, RobotModel};
use proptest::prelude::*;
use std::sync::LazyLock;

const BY_HAND: &str = include_str!("fixtures/csv/by_hand.csv");

static ARM: LazyLock<RobotModel> = LazyLock::new(ur5);

fn read(text: &str) -> Result<Reading, ReadError> {
    Csv.read(&[file("x.csv", text)], &ARM)
}

proptest! {
    /// What is written says the same points and speeds at the same times.
    #[test]
    fn reads_back_the_written_program((points, share) in points()) {
        let plan = plan(&ARM);
        let program = program(&plan, &ARM, points, share);
        let files = Csv.write(&program);
        prop_assert_eq!(&files, &Csv.write(&program));
        for file in &files {
            prop_assert!(file.text.is_ascii() && !file.text.contains('\r'));
            prop_assert!(!file.text.contains("-0.000000000"));
        }
        let reading = Csv.read(&files, &ARM).unwrap();
        prop_assert_eq!(reading.points.len(), program.points.len());
        prop_assert!((reading.share() - share).abs() < 1e-5);
        let last_s = program.points.last().unwrap().t_s;
        prop_assert!((reading.share() - share).abs() * last_s < 1e-8);
        prop_assert_eq!((reading.interpolation, reading.tool), (SegmentShape::Cubics, None));
        for (read, point) in reading.points.iter().zip(&program.points) {
            prop_assert!((read.t_s - point.t_s / share).abs() < 1e-6);
            prop_assert!((read.q_rad - point.q_rad).amax() < 1e-7);
            prop_assert!((read.qd_rad_s.unwrap() - point.qd_rad_s * share).amax() < 1e-7);
            prop_assert_eq!(read.corner_m.is_none(), point.rests);
        }
    }

    /// A damaged table is read or refused at a line that it has.
    #[test]
    fn a_damaged_table_is_read_or_refused(text in damaged(BY_HAND)) {
        if let Err(error) = read(&text) {
            prop_assert!(error.place.line >= 1 && error.place.line <= text.lines().count().max(1), "{}", error);
            prop_assert!(!error.reason.contains('\n'));
        }
    }

    /// Noise is refused.
    #[test]
    fn rejects_random_text(text in any::<String>()) {
        prop_assert!(read(&text).is_err());
    }
}

#[test]
fn reads_a_table_written_by_hand() {
    // Spreadsheets begin a file with a mark of its encoding and end lines as they like.
    for text in [BY_HAND.to_owned(), format!("\u{feff}{}", BY_HAND.replace('\n', "\r\n"))] {
        let reading = read(&text).unwrap();
        assert_eq!(
            (reading.speed_share, reading.interpolation, reading.tool),
            (Some(0.25), SegmentShape::Cubics, None)
        );
        let [first, second, third] = reading.points.as_slice() else {
            panic!("{reading:?}")
        };
        assert_eq!((first.t_s, second.t_s, third.t_s), (0.0, 0.004, 0.010));
        assert_eq!([first, second, third].map(|point| point.place.line), [2, 3, 4]);
        assert_eq!(
            [first, second, third].map(|point| point.corner_m),
            [None, Some(0.0), None]
        );
        assert_eq!(first.q_rad, JointVector::from([0.1, -1.5, 1.5, 0.0, 1e-3, -0.5]));
        assert_eq!(
            second.qd_rad_s,
            Some(JointVector::from([0.25, 0.0, 0.0, 0.0, 0.0, 0.0]))
        );
    }
}

#[test]
fn a_table_of_times_and_positions_alone_is_straight_between_its_rows() {
    let text = "t_s,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad\n0,0,0,0,0,0,0\n1,1,0,0,0,0,0\n2,1,2,0,0,0,0\n";
    let reading = read(text).unwrap();
    assert_eq!(
        (reading.speed_share, reading.interpolation),
        (None, SegmentShape::Lines)
    );
    let corners: Vec<Option<f64>> = reading.points.iter().map(|point| point.corner_m).collect();
    assert_eq!(corners, [None, Some(0.0), None]);
    assert!(reading.points.iter().all(|point| point.qd_rad_s.is_none()));
}

/// A line, what is changed there, the line that is refused, and words of the reason.
#[test]
fn rejects_faults_with_their_line() {
    let faults = [
        (1, "t_s", "time", 1, "column \"time\" is unknown"),
        (1, "q3_rad", "q3_deg", 1, "column \"q3_deg\" is unknown"),
        (1, "qd6_rad_s", "qd6_rad_s,tau1", 1, "column \"tau1\" is unknown"),
        (1, ",qd6_rad_s", "", 1, "column \"qd6_rad_s\" is missing"),
        (1, "t_s,", ",", 1, "column \"\" is unknown"),
        (
            2,
            "0,0,",
            "0.1,0,",
            2,
            "column 1 (t_s): expected 0 in the first row, found 0.1",
        ),
        (
            2,
            "1e-3",
            "NaN",
            2,
            "column 7 (q5_rad): expected a number from -1e6 to 1e6, with a point for decimals; found \"NaN\"",
        ),
        (2, "1e-3", "inf", 2, "column 7 (q5_rad)"),
        (3, "0.101", "1e7", 3, "column 3 (q1_rad)"),
        (
            3,
            "0.101",
            "",
            3,
            "column 3 (q1_rad): expected a number from -1e6 to 1e6, with a point for decimals; found \"\"",
        ),
        (3, "0.101", "0,101", 3, "found 15 columns; expected 14"),
        (3, ",0.25", "", 3, "found 13 columns; expected 14"),
        (
            3,
            "0.001,",
            "0.002,",
            3,
            "column 2 (plan_t_s): expected 0.001000000, the last row's share of t_s, found 0.002",
        ),
        (4, "0.010", "0.004", 4, "(t_s): 0.004 s must come after 0.004 s"),
        (4, "0.010", "-1", 4, "(t_s): -1 s must come after"),
        (
            4,
            "0.0025",
            "0.02",
            4,
            "column 2 (plan_t_s): expected above 0 and at most t_s, 0.01 s, found 0.02",
        ),
        (4, "0.0025", "0", 4, "column 2 (plan_t_s): expected above 0"),
        (4, "0,0,0,0,0,0", "0,0,0,0,0,0\n", 5, "found 1 column; expected 14"),
    ];
    for (line, from, to, at, said) in faults {
        let error = read(&edited(BY_HAND, line, from, to)).expect_err(to);
        assert_eq!(error.place.line, at, "{to}: {error}");
        assert!(error.reason.contains(said), "{to}: {error}");
    }
    let header = BY_HAND.lines().next().unwrap();
    for text in [
        String::new(),
        header.to_owned(),
        BY_HAND.lines().take(2).collect::<Vec<_>>().join("\n"),
    ] {
        assert!(read(&text).is_err());
    }
}

#[test]
fn exports_a_table_with_its_explanation() {
    let plan = plan(&ARM);
    let still = platewash_export::program::Point {
        t_s: 0.0,
        q_rad: JointVector::zeros(),
        qd_rad_s: JointVector::zeros(),
        rests: true,
        segment: 0,
    };
    let then = platewash_export::program::Point { t_s: 0.004, ..still };
    let [table, about] = <[_; 2]>::try_from(Csv.write(&program(&plan, &ARM, vec![still, then], 0.5))).unwrap();
    assert_eq!((table.name.as_str(), about.name.as_str()), ("small.csv", "small.txt"));
    assert!(Csv.is_in(&table) && !Csv.is_in(&about));
    let trajectory = platewash_motion::csv::HEADER;
    assert!(
        !Csv.is_in(&file("trajectory.csv", trajectory)),
        "a table of another kind"
    );
    let words = about.text.replace("\n-   ", " ");
    for said in ["PROVED: two segments", "q1 is shoulder_pan", "after 0.008 s"] {
        assert!(words.contains(said), "{said}: {words}");
    }
}

/// The text beside a table promises rest at both ends.
#[test]
fn a_table_that_begins_or_ends_at_speed_is_refused() {
    let rest = "0,0,0,0,0,0";
    let table = |first: &str, last: &str| {
        let names: Vec<_> = (1..7)
            .map(|k| format!("q{k}_rad"))
            .chain((1..7).map(|k| format!("qd{k}_rad_s")))
            .collect();
        read(&format!(
            "t_s,{}\n0,{rest},{first}\n1,{rest},0.1,0,0,0,0,0\n2,{rest},{last}\n",
            names.join(",")
        ))
    };
    assert!(table(rest, rest).is_ok());
    let refused = table(rest, "0,0,0.5,0,0,0").unwrap_err().to_string();
    assert_eq!(
        refused,
        "x.csv:4: column 10 (qd3_rad_s): expected a speed of 0 in the last row, in which the arm rests; found 0.5 rad/s"
    );
    let refused = table("0,0,0,0,0,-1e-3", rest).unwrap_err().to_string();
    assert!(
        refused.starts_with("x.csv:2: column 13 (qd6_rad_s): expected a speed of 0 in the first row"),
        "{refused}"
    );
}
