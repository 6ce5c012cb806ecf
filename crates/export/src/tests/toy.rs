//! The plainest of dialects: a line a point, with its time, its joints in radians and whether the arm stops.

use crate::comment::wrapped;
use crate::dialect::language::{Dialect, Points};
use crate::program::{Place, Program, ProgramFile};
use crate::reading::{ReadPoint, Reading, SegmentShape};
use crate::refusal::Refusal;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_motion_proof::ReadError;
use platewash_workcell::job::JobTerms;

#[derive(Debug)]
pub struct Toy;

impl Dialect for Toy {
    fn name(&self) -> &'static str {
        "toy"
    }

    fn is_in(&self, file: &ProgramFile) -> bool {
        file.name.ends_with(".toy")
    }

    fn points(&self) -> Points {
        Points::Chords { least_s: 0.01 }
    }

    fn assumptions(&self) -> &'static [&'static str] {
        &["nothing of it is true"]
    }

    fn accepts(&self, _: &JobTerms, _: &RobotModel) -> Result<(), Refusal> {
        Ok(())
    }

    fn write(&self, program: &Program<'_>) -> Vec<ProgramFile> {
        let mut text = wrapped("#", program.header.iter().map(String::as_str));
        for point in &program.points {
            let corner = if point.rests {
                "stop".to_owned()
            } else {
                program.corner_m.to_string()
            };
            let q: Vec<_> = point.q_rad.iter().map(f64::to_string).collect();
            text += &format!("{} {corner} {}\n", point.t_s / program.speed_share, q.join(" "));
        }
        text += &format!("share {}\n", program.speed_share);
        let name = format!("{}.toy", program.name);
        vec![ProgramFile { name, text }]
    }

    fn read(&self, files: &[ProgramFile], _: &RobotModel) -> Result<Reading, ReadError> {
        let mut speed_share = None;
        let mut points = Vec::new();
        let lines = files
            .iter()
            .flat_map(|file| file.text.lines().enumerate().map(move |line| (file, line)));
        for (file, (i, line)) in lines.filter(|(_, (_, line))| !line.starts_with('#') && !line.trim().is_empty()) {
            let place = Place {
                file: file.name.clone(),
                line: i + 1,
            };
            let error = || ReadError {
                place: place.clone(),
                reason: "no point".to_owned(),
            };
            let number = |word: &str| word.parse::<f64>().map_err(|_| error());
            let words: Vec<_> = line.split_whitespace().collect();
            match words.as_slice() {
                ["share", share] => speed_share = Some(number(share)?),
                [t, corner, q @ ..] if q.len() == 6 => {
                    let q: Vec<_> = q.iter().map(|q| number(q)).collect::<Result<_, _>>()?;
                    points.push(ReadPoint {
                        t_s: number(t)?,
                        q_rad: JointVector::from_row_slice(&q),
                        qd_rad_s: None,
                        corner_m: if *corner == "stop" { None } else { Some(number(corner)?) },
                        place,
                    });
                }
                _ => return Err(error()),
            }
        }
        Ok(Reading {
            speed_share,
            points,
            interpolation: SegmentShape::RoundedLines,
            tool: None,
            start_within_deg: None,
            most_share: None,
            settings: Vec::new(),
        })
    }
}
