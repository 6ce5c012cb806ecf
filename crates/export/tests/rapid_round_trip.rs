//! What is written in RAPID is read back as it was meant.

use crate::rapid::{every, kitchen, program, rapid};
use platewash_export::Joint3;
use platewash_export::program::Point;
use platewash_export::reading::{Reading, SegmentShape};
use platewash_fixtures::kitchen_tool;
use platewash_kinematics::{JointVector, Pose};
use platewash_workcell::tool::{Tool, ToolMass};
use proptest::prelude::*;

/// Half the last digit of an angle, and what a single misses of it \[°\].
const ANGLE_DEG: f64 = 1e-4;
/// What singles of steps of minutes miss \[s\].
const TIME_S: f64 = 1e-4;

fn assert_as_meant(points: &[Point], share: f64, reading: &Reading, within_s: f64) {
    assert_eq!(reading.points.len(), points.len());
    assert_eq!(reading.interpolation, SegmentShape::RoundedLines);
    // It is a single, told by its shortest decimal.
    assert!((reading.share() / share - 1.0).abs() < f64::from(f32::EPSILON));
    for (index, (point, read)) in points.iter().zip(&reading.points).enumerate() {
        let off_deg = (point.q_rad - read.q_rad).map(f64::to_degrees).amax();
        assert!(off_deg < ANGLE_DEG, "point {index}: {off_deg}°");
        let off_s = (point.t_s / share - read.t_s).abs();
        assert!(off_s < within_s, "point {index}: {off_s} s");
        if point.rests {
            assert_eq!(read.corner_m, None, "point {index}");
        }
    }
    let (first, last) = (&reading.points[0], reading.points.last().unwrap());
    assert_eq!((first.t_s, first.corner_m, last.corner_m), (0.0, None, None));
}

#[test]
fn reads_back_the_kitchen_program() {
    for share in [1.0, 0.1] {
        let program = program(every(3), share);
        let files = rapid().write(&program);
        assert_eq!(files.len(), 1);
        let text = &files[0].text;
        assert!(text.is_ascii() && !text.contains('\r') && !text.contains("-0.0000,"));
        assert!(text.lines().all(|line| line.trim_end() == line));
        let reading = rapid().read(&files, program.arm).unwrap();
        assert_as_meant(&program.points, share, &reading, 1e-6 / share);
        let duration = reading.points.last().unwrap().t_s;
        assert!((duration - program.duration_s()).abs() < 1e-3);
        let tool = reading.tool.unwrap();
        let stated = program.tool();
        assert!((tool.mass_kg - stated.mass.unwrap().mass_kg).abs() < 1e-7);
        assert!((tool.com_m[2] - stated.mass.unwrap().com_m[2]).abs() < 1e-7);
        let tip = tool.tip.unwrap();
        assert!((tip.translation.vector - stated.tip.translation.vector).amax() < 1e-7);
        assert!(tip.rotation.angle_to(&stated.tip.rotation) < 1e-6);
        assert_eq!(files, rapid().write(&program), "the same program, the same bytes");
        assert!(rapid().is_in(&files[0]));
    }
}

#[test]
fn the_header_states_everything_once_in_short_lines() {
    let mut program = program(every(50), 1.0);
    let assumed = rapid().assumptions().iter().map(|sentence| (*sentence).to_owned());
    program.header.extend(assumed);
    program.header.push("top speed 0.25 m/s²\nPROC main()".to_owned());
    let files = rapid().write(&program);
    let head: Vec<&str> = files[0]
        .text
        .lines()
        .skip(1)
        .take_while(|line| line.starts_with("  !"))
        .collect();
    assert!(head.iter().all(|line| line.len() <= 78), "{head:?}");
    let words: Vec<&str> = head
        .iter()
        .flat_map(|line| line.split_whitespace().filter(|word| *word != "!"))
        .collect();
    let told = words.join(" ");
    for sentence in rapid().assumptions() {
        assert_eq!(told.matches(sentence).count(), 1, "{sentence}");
    }
    for sentence in ["Units: mm, degrees", "top speed 0.25 m/s^2 PROC main()"] {
        assert_eq!(told.matches(sentence).count(), 1, "{sentence}");
    }
    assert!(rapid().read(&files, program.arm).is_ok());
}

#[test]
fn each_segment_is_a_routine_and_stops_where_the_plan_rests() {
    let program = program(every(3), 1.0);
    let files = rapid().write(&program);
    let plan = &kitchen().0;
    for plate in &plan.order {
        for routine in ["Approach", "Wash", "Retreat"] {
            let name = format!("PROC pw{routine}{}()", plate + 1);
            assert_eq!(files[0].text.matches(&name).count(), 1, "{name}");
        }
    }
    let rests = program.points.iter().filter(|point| point.rests).count();
    assert!(rests >= 2 + 2 * plan.order.len(), "{rests}");
    let reading = rapid().read(&files, program.arm).unwrap();
    let stops = reading.points.iter().filter(|point| point.corner_m.is_none()).count();
    assert_eq!(stops, rests);
    assert!(
        reading
            .points
            .iter()
            .all(|point| point.corner_m.is_none_or(|corner_m| corner_m == 0.005))
    );
}

#[test]
fn finds_one_changed_digit_in_its_line() {
    let program = program(every(20), 1.0);
    let files = rapid().write(&program);
    let before = rapid().read(&files, program.arm).unwrap();
    let index = files[0].text.lines().position(|line| line.contains("\\T:=0.")).unwrap();
    let line = files[0].text.lines().nth(index).unwrap();
    let time = line.split("\\T:=").nth(1).unwrap().split('/').next().unwrap();
    let later = format!("{:.6}", time.parse::<f64>().unwrap() + 0.01);
    let edited = files[0]
        .text
        .replacen(&format!("\\T:={time}/"), &format!("\\T:={later}/"), 1);
    assert_ne!(edited, files[0].text);
    let after = rapid().read(&[crate::rapid::file(&edited)], program.arm).unwrap();
    let differ = before
        .points
        .iter()
        .zip(&after.points)
        .position(|(a, b)| (a.t_s - b.t_s).abs() > 1e-4);
    assert_eq!(after.points[differ.unwrap()].place.line, index + 1);
}

#[test]
fn finds_a_changed_digit_of_the_start_in_its_line() {
    let program = program(every(20), 1.0);
    let files = rapid().write(&program);
    let index = files[0]
        .text
        .lines()
        .position(|line| line.contains("pwStart:="))
        .unwrap();
    let edited = files[0].text.replacen("pwStart:=[[0.0000", "pwStart:=[[0.0010", 1);
    assert_ne!(edited, files[0].text);
    let reading = rapid().read(&[crate::rapid::file(&edited)], program.arm).unwrap();
    assert!((reading.points[0].q_rad[0].to_degrees() - 0.001).abs() < 1e-6);
    assert_eq!(reading.points[0].place.line, index + 1);
}

#[test]
fn a_large_program_is_several_modules() {
    let mut points = every(40);
    let (mut at, kept) = (*points.last().unwrap(), points.clone());
    // Round and round, with two segments that are longer than a module.
    for step in 0..10_000 {
        at.t_s += 0.02;
        at.rests = false;
        at.q_rad[0] = 0.3 * f64::from(step % 7) / 7.0;
        at.segment = step as usize / 5500;
        points.push(at);
    }
    assert_ne!(points, kept);
    let program = program(points, 0.5);
    let files = rapid().write(&program);
    assert_eq!(files[0].name, "kitchen.mod");
    assert!(files.len() >= 3, "{}", files.len());
    for file in &files {
        assert!(
            file.text.lines().count() < 4200,
            "{}: {}",
            file.name,
            file.text.lines().count()
        );
    }
    let reading = rapid().read(&files, program.arm).unwrap();
    assert_as_meant(&program.points, 0.5, &reading, 2e-6);
    // Without one of them, the first missing routine is named.
    let error = rapid().read(&files[..2], program.arm).unwrap_err();
    assert!(
        error.reason.contains("is neither a procedure of the program"),
        "{error}"
    );
}

/// Points as a plan could have them: any joints, steps of time from 1 ms to 10 s, some rests, some waits.
fn points() -> impl Strategy<Value = Vec<Point>> {
    let joints = proptest::array::uniform6(-6.0..6.0_f64);
    let step = (joints, -3.0..1.0_f64, 0_u8..4);
    proptest::collection::vec(step, 2..40).prop_map(|steps| {
        let mut t_s = 0.0;
        let mut points: Vec<Point> = Vec::new();
        for (index, (q, exponent, kind)) in steps.into_iter().enumerate() {
            let before = points.last().copied();
            let waits = kind == 0 && before.is_some();
            let q_rad = before
                .filter(|_| waits)
                .map_or(JointVector::from(q), |point| point.q_rad);
            let rests = index == 0 || waits || kind == 1;
            points.push(Point {
                t_s,
                q_rad,
                qd_rad_s: JointVector::zeros(),
                rests,
                segment: index / 7,
            });
            t_s += 10_f64.powf(exponent);
        }
        points
    })
}

/// Any tool that a controller takes.
fn tools() -> impl Strategy<Value = Tool> {
    let array = proptest::array::uniform3::<std::ops::Range<f64>>;
    let inertia = proptest::array::uniform6(-0.01..0.01_f64);
    (
        array(-0.5..0.5),
        array(-3.0..3.0),
        0.001..50.0_f64,
        array(-0.3..0.3),
        inertia,
    )
        .prop_map(|(tip_m, turn_rad, mass_kg, com_m, off)| Tool {
            tip: Pose::new(tip_m.into(), turn_rad.into()),
            mass: Some(ToolMass {
                mass_kg,
                com_m,
                inertia_kg_m2: [off[0] + 0.1, off[1], off[2], off[3] + 0.1, off[4], off[5] + 0.1],
            }),
            ..kitchen_tool()
        })
}

proptest! {
    #[test]
    fn reads_back_any_points(
        points in points(),
        share in 0.05..1.0_f64,
        corner_m in 0.0001..0.3_f64,
        joint_3 in proptest::sample::select(&Joint3::ALL),
    ) {
        let mut program = program(points, share);
        program.corner_m = corner_m;
        program.joint_3 = joint_3;
        program.header.push(format!("platewash setting: joint_3 = {}", joint_3.name()));
        let files = rapid().write(&program);
        let reading = rapid().read(&files, program.arm).unwrap();
        assert_as_meant(&program.points, share, &reading, TIME_S);
        for read in &reading.points {
            prop_assert!(read.corner_m.is_none_or(|read_m| (read_m - corner_m).abs() < 1e-6));
        }
    }

    #[test]
    fn reads_back_any_tool(tool in tools()) {
        let mut plan = kitchen().0.clone();
        plan.job.workcell.tool = tool.clone();
        let mut program = program(every(500), 1.0);
        program.plan = &plan;
        let files = rapid().write(&program);
        let read = rapid().read(&files, program.arm).unwrap().tool.unwrap();
        let (tip, mass) = (read.tip.unwrap(), tool.mass.unwrap());
        // A `num` of 500 mm is good to 0.03 µm.
        prop_assert!((tip.translation.vector - tool.tip.translation.vector).amax() < 1e-7);
        prop_assert!(tip.rotation.angle_to(&tool.tip.rotation) < 1e-6);
        prop_assert!((read.mass_kg / mass.mass_kg - 1.0).abs() < 1e-6);
        prop_assert!(read.com_m.iter().zip(mass.com_m).all(|(read_m, com_m)| (read_m - com_m).abs() < 1e-7));
    }
}
