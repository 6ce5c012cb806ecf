//! Tables of motions as CSV: time steps, columns read back, and errors that name line and column.

use platewash_kinematics::JointVector;
use platewash_motion::csv::*;
use proptest::prelude::*;

proptest! {
    /// A suggested time step is accepted when it is entered, and hardly any smaller one is.
    #[test]
    fn a_suggested_time_step_is_accepted(mantissa in 1.0..10.0_f64, exponent in -3..12_i32, share in 1e-9..0.9_f64) {
        let duration_s = mantissa * 10_f64.powi(exponent);
        let refused = check_step(duration_s, share * least_step_s(duration_s)).unwrap_err().to_string();
        let suggested = refused.rsplit("at least ").next().and_then(|s| s.strip_suffix(" s")).unwrap();
        prop_assert_eq!(check_step(duration_s, suggested.parse().unwrap()), Ok(()), "{}", refused);
    }
}

#[test]
fn rejects_an_invalid_time_step() {
    for dt_s in [0.0, -1.0, f64::NAN] {
        assert!(check_step(1.0, dt_s).unwrap_err().to_string().contains("positive"));
    }
}

fn row(t_s: &str, torque: bool) -> String {
    let joints = |first: usize| (first..first + 6).map(|k| k.to_string()).collect::<Vec<_>>().join(",");
    let tail = if torque {
        format!(",{}", joints(30))
    } else {
        String::new()
    };
    format!(
        "{t_s},wash,0,{},{},{},0.1,0.2,0.3{tail}",
        joints(1),
        joints(10),
        joints(20)
    )
}

fn table(rows: &[String], torque: bool) -> String {
    let torques = if torque { TORQUES } else { "" };
    format!("{}{torques}\n{}\n", HEADER, rows.join("\n"))
}

fn error_text(text: &str) -> String {
    RecordedMotion::from_csv(text).unwrap_err().to_string()
}

#[test]
fn reads_columns_back_in_their_places() {
    for torque in [false, true] {
        let text = table(&[row("0", torque), row("0.5", torque)], torque);
        let joints = |first: usize| JointVector::from_fn(|joint, _| (first + joint) as f64);
        let motion = RecordedMotion::from_csv(&text).unwrap();
        let expected = RecordedSample {
            t_s: 0.5,
            q: joints(1),
            qd: joints(10),
            qdd: joints(20),
            torque: torque.then(|| joints(30)),
            force_n: None,
        };
        assert_eq!((motion.samples.len(), motion.samples[1]), (2, expected));
        // As a spreadsheet on another system writes it.
        let other = format!("\u{feff}{}", text.replace('\n', "\r\n"));
        assert_eq!(RecordedMotion::from_csv(&other), Ok(motion));
    }
}

#[test]
fn errors_name_line_and_column() {
    let good = || row("0", true);
    let cases = [
        (String::new(), "empty"),
        ("\n\n".to_owned(), "empty"),
        (table(&[], true).trim_end().to_owned() + "\n", "no rows"),
        (table(&[good()], false), "line 2: found 30 columns; expected 24"),
        (table(&[row("0", false)], true), "line 2: found 24 columns; expected 30"),
        (
            table(&[good(), String::new()], true),
            "line 3: found 1 column; expected 30",
        ),
        (
            table(&[good(), good()], true),
            "line 3, column 1 (t_s): 0 s must come after 0 s",
        ),
        (
            table(&[row("0.2", true), row("0.1", true)], true),
            "line 3, column 1 (t_s): 0.1 s must come after 0.2 s",
        ),
        (
            table(&[row("-0.1", true)], true),
            "line 2, column 1 (t_s): -0.1 s is before 0",
        ),
        (
            table(&[row("NaN", true)], true),
            "line 2, column 1 (t_s): expected a number from -1e6 to 1e6, with a point for decimals; found \"NaN\"",
        ),
        (
            table(&[good().replace(",12,", ",inf,")], true),
            "line 2, column 12 (qd3_rad_s)",
        ),
        (
            table(&[good().replace(",35", ",1e7")], true),
            "line 2, column 30 (tau6_n_m)",
        ),
        (
            table(&[good().replace(",1,", ",,")], true),
            "line 2, column 4 (q1_rad): expected a number from -1e6 to 1e6, with a point for decimals; found \"\"",
        ),
        (
            table(&[good()], true).replace("qd3_rad_s,", "qd3_deg_s,"),
            "line 1: column \"qd3_deg_s\" is unknown",
        ),
        // An arm of seven joints.
        (
            table(&[good()], true).replace("q6_rad,", "q6_rad,q7_rad,"),
            "line 1: column \"q7_rad\" is unknown",
        ),
        ("t_s,segment\n".to_owned(), "line 1: column \"plate\" is missing"),
        (HEADER.to_owned() + TORQUES + ",more\n", "column \"more\" is unknown"),
    ];
    for (text, words) in cases {
        assert!(error_text(&text).contains(words), "{words}: {}", error_text(&text));
    }
}

#[test]
fn a_long_or_hostile_cell_is_repeated_in_part_and_printable() {
    let text = table(
        &[row("0", true).replace(",12,", &format!(",\u{1b}[2J{},", "x".repeat(10_000)))],
        true,
    );
    let said = error_text(&text);
    assert!(said.len() < 200 && !said.contains('\u{1b}'), "{said}");
}

proptest! {
    /// Any damaged table is read or refused, without a panic.
    #[test]
    fn damaged_tables_never_panic(at in 0..600usize, with in "\\PC{0,3}|[,\n]", cut in 0..40usize) {
        let text = table(&[row("0", true), row("0.25", true)], true);
        let start = at.min(text.len());
        let end = (start + cut).min(text.len());
        let damaged = format!("{}{with}{}", &text[..start], &text[end..]);
        if let Ok(motion) = RecordedMotion::from_csv(&damaged) {
            prop_assert!(motion.samples.windows(2).all(|pair| pair[0].t_s < pair[1].t_s));
            prop_assert!(motion.samples.iter().all(|sample| sample.q.iter().all(|q| q.is_finite())));
        }
    }
}
