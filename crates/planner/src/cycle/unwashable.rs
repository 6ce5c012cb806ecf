//! A plate for which no way was found to wash it whole: which part of it, why, whether that is known, and where it could be washed.

use super::activity::Activity;
use super::arm::Arm;
use super::stages::Stages;
use super::{CycleError, visit};
use crate::crossing::Terminal;
use crate::posture::elsewhere::{Move, SEARCHED_M};
use crate::posture::elsewhere::{RING_M, RINGS};
use crate::posture::washable::{self, Cause, Washable};
use crate::posture::{self, Conclusion, PostureError};
use nalgebra::{Vector2, Vector3};
use platewash_kinematics::JointVector;
use platewash_workcell::stroke::Stroke;
use serde::Serialize;
use std::fmt;

/// What is known of a plate that cannot be washed whole, or for which no way to was found.
#[derive(Debug, Clone, PartialEq)]
pub struct UnwashablePlate {
    /// The plate.
    pub plate: usize,
    /// Its centre \[m\].
    pub centre_m: [f64; 2],
    /// Where the planning of its posture ended.
    pub error: PostureError,
    /// Whether it is known that it cannot be.
    pub conclusion: Conclusion,
    /// Share of the stroke for which a posture was found, point by point.
    pub share: Option<f64>,
    /// What keeps the rest from being washed, the most frequent first.
    pub causes: Vec<Cause>,
    /// The nearest centre found at which it can be washed whole, and the arm gets there and away \[m\]; on a grid of a
    /// millimetre, so that what is printed is what was tried.
    pub nearest_m: Option<[f64; 2]>,
    /// How that was looked for.
    pub elsewhere: Elsewhere,
}

/// How another place for a plate was looked for.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Elsewhere {
    /// On rings up to this distance from where it lies \[m\].
    Within(f64),
    /// Not at all: plates that are sampled are not moved.
    Sampled,
}

impl Stages<'_> {
    /// Looks into a plate whose posture could not be planned.
    pub(super) fn unwashable(
        &self,
        arm: &Arm<'_>,
        plate: usize,
        (centre, stroke): (Vector3<f64>, &Stroke),
        near: &JointVector,
        error: PostureError,
    ) -> UnwashablePlate {
        (self.listener)(&Activity::Cause { plate });
        let part = washable::washable_part(&arm.cell, stroke, centre, plate, &self.posture, near);
        let (share, causes, conclusion) = match part {
            Ok(Washable::Part {
                share,
                causes,
                conclusion,
            }) => (Some(share), causes, conclusion),
            _ => (None, Vec::new(), Conclusion::NotFound),
        };
        let elsewhere = match self.scenario.layout.positions_m {
            Some(_) => Elsewhere::Within(SEARCHED_M),
            None => Elsewhere::Sampled,
        };
        let place = Move {
            robot: self.robot,
            tool: &self.scenario.tool,
            plates: self.plates,
            plate,
            stroke,
            height_m: self.scenario.wash.height_m,
            settings: &self.posture,
            near,
        };
        let mut holds = |centre: &Vector2<f64>| {
            let centre_m = (*centre).into();
            (self.listener)(&Activity::Trial { plate, centre_m });
            self.washes_at(plate, centre).unwrap_or(false)
        };
        let tell = |ring: u32| {
            let (of, away_m) = (RINGS, RING_M * f64::from(ring));
            (self.listener)(&Activity::Elsewhere {
                plate,
                ring,
                of,
                away_m,
            });
        };
        let nearest = match elsewhere {
            Elsewhere::Within(_) => place.nearest_washable_telling(&mut holds, &tell).ok().flatten(),
            Elsewhere::Sampled => None,
        };
        UnwashablePlate {
            plate,
            centre_m: [centre.x, centre.y],
            error,
            conclusion,
            share,
            causes,
            nearest_m: nearest.map(Into::into),
            elsewhere,
        }
    }

    /// Whether the job would wash plate number `plate` with its centre there \[m\]: planned as the job is, up to the
    /// crossings to it and from it. Other plates that cannot be washed are left out.
    fn washes_at(&self, plate: usize, centre: &Vector2<f64>) -> Result<bool, CycleError> {
        let mut plates = self.plates.to_vec();
        (plates[plate].x_m, plates[plate].y_m) = (centre.x, centre.y);
        let moved = self.among(&plates);
        moved.check_homes()?;
        let arm = moved.arm()?;
        let (order, _) = moved.order(&arm);
        let mut near = moved.homes[0];
        let (mut lines, mut at): (Vec<[Terminal; 2]>, _) = (Vec::new(), None);
        for k in 0..order.len() {
            let (centre, stroke) = moved.stroke(&arm, &order, k);
            let washing = match posture::washing(&arm.cell, &stroke, centre, order[k], &moved.posture, &near) {
                Ok(washing) => washing,
                Err(_) if order[k] != plate => continue,
                Err(_) => return Ok(false),
            };
            near = washing.q.last().copied().unwrap_or(near);
            if order[k] == plate {
                at = Some(lines.len());
            }
            lines.push(visit::lines(
                self.scenario,
                &arm,
                order[k],
                (centre, &stroke),
                &washing,
            )?);
        }
        let [start, end] = moved.homes.map(Terminal::home);
        let leaving = std::iter::once(&start).chain(lines.iter().map(|[_, exit]| exit));
        let entering = lines.iter().map(|[entry, _]| entry).chain(std::iter::once(&end));
        let beside = |k: usize| at.is_some_and(|at| k == at || k == at + 1);
        moved.crossings(&arm, leaving, entering, beside)?;
        Ok(true)
    }
}

impl fmt::Display for UnwashablePlate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([x, y], plate) = (self.centre_m, self.plate);
        let percent = self.share.map(|share| 100.0 * share);
        match (self.conclusion.is_proved(), percent) {
            (true, Some(percent)) => write!(
                f,
                "plate {plate} at ({x:.3}, {y:.3}) m cannot be washed whole: {percent:.1} % of its stroke can"
            )?,
            (false, Some(percent)) => write!(
                f,
                "no way to wash plate {plate} at ({x:.3}, {y:.3}) m whole was found, which does not prove that there is none: \
                 a posture was found for {percent:.1} % of its stroke"
            )?,
            (_, None) => write!(
                f,
                "no way to wash plate {plate} at ({x:.3}, {y:.3}) m whole was found, which does not prove that there is none: {}",
                self.error
            )?,
        }
        for cause in &self.causes {
            write!(f, "; {}", cause.words(self.conclusion))?;
        }
        match (self.nearest_m, self.elsewhere) {
            (Some([x, y]), _) => write!(f, "; the nearest position found where it can is ({x:.3}, {y:.3}) m"),
            (None, Elsewhere::Within(most_m)) => {
                write!(f, "; no position where it can was found within {most_m} m of it")
            }
            (None, Elsewhere::Sampled) => f.write_str(
                "; plates are sampled, so that no other position was looked for: another seed or layout.only_washable may do",
            ),
        }
    }
}
