//! Points in memory, and the motion that a controller makes of them.

use crate::time::ExactTime;
use platewash_kinematics::urdf::FixedJoints;
use platewash_kinematics::words::rounded;
use platewash_kinematics::{AXES, JointVector, RobotModel};
use platewash_motion::piecewise::{MotionPiece, PiecewiseMotion};
use platewash_motion::trajectory::KnotError;
use std::f64::consts::{PI, TAU};

/// Points that an arm reaches one after the other, with the joints in the arm's order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct JointPoints {
    /// Joint positions \[rad\].
    pub q_rad: Vec<JointVector>,
    /// Times after [`JointPoints::start`] \[s\], in ascending order; `None` where the points have none.
    pub t_s: Option<Vec<f64>>,
    /// Time from which the others count: that of the first point in a file, and else 0.
    pub start: ExactTime,
    /// Joint speeds \[rad/s\]; `None` where the points have none.
    pub qd_rad_s: Option<Vec<JointVector>>,
    /// Joint accelerations \[rad/s²\]; `None` where the points have none.
    pub qdd_rad_s2: Option<Vec<JointVector>>,
    /// Number of rates that each point states, where some state fewer than others: 0, 1 (speeds) or 2 (speeds and accelerations). Rates that a
    /// point does not state count for nothing.
    pub rates: Option<Vec<usize>>,
    /// Joints that were stated not to move, axes of the arm or not.
    pub fixed: FixedJoints,
    /// Statements of a file beside the motion that a reader of the verdict should know; one clause each.
    pub notes: Vec<String>,
}

/// Motion of each joint between two points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Interpolation {
    /// At constant speed: a straight line in joint space. The speed jumps at the points.
    Linear,
    /// Along the cubic that has the positions and the speeds of both points.
    Cubic,
    /// Along the quintic that has the positions, speeds and accelerations of both points.
    Quintic,
}

impl Interpolation {
    /// Every way, the simplest first.
    pub const ALL: [Self; 3] = [Self::Linear, Self::Cubic, Self::Quintic];

    /// Returns its word: `linear`, `cubic` or `quintic`.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Cubic => "cubic",
            Self::Quintic => "quintic",
        }
    }
}

/// Motion through points.
#[derive(Debug, Clone, PartialEq)]
pub struct PointMotion {
    /// The motion, from 0 s. Without times each piece takes 1 s.
    pub motion: PiecewiseMotion,
    /// Motion between two points, one for each piece.
    pub shapes: Vec<Interpolation>,
    /// Time of the first point; `None` where the points have no times.
    pub start: Option<ExactTime>,
    /// Joints that were stated not to move, axes of the arm or not.
    pub fixed: FixedJoints,
    /// Statements of the file beside the motion: [`JointPoints::notes`].
    pub notes: Vec<String>,
}

impl PointMotion {
    /// Motion between two points that state all that any point states.
    #[must_use]
    pub fn interpolation(&self) -> Interpolation {
        self.shapes.iter().copied().max().unwrap_or(Interpolation::Linear)
    }

    /// Returns true where the motion begins or ends with a straight line: no speed is stated there, and the arm rests outside.
    #[must_use]
    pub fn rests_outside(&self) -> bool {
        [self.shapes.first(), self.shapes.last()].contains(&Some(&Interpolation::Linear))
    }

    /// Number of pieces that are simpler than others, as one of their points states fewer rates.
    #[must_use]
    pub fn simpler(&self) -> usize {
        let most = self.interpolation();
        self.shapes.iter().filter(|shape| **shape < most).count()
    }
}

/// Reason that points are no motion. Points are counted from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PointsError {
    /// There are fewer than two points.
    #[error(
        "expected two points at least; found {found}{}",
        if *.found == 1 { ": where the arm moves from is not stated; add it as the first point" } else { "" }
    )]
    TooFew {
        /// Number of points found.
        found: usize,
    },
    /// There are not as many times, speeds or accelerations as positions.
    #[error("expected as many {what} as positions, {expected}; found {found}")]
    Count {
        /// Times, speeds or accelerations.
        what: &'static str,
        /// Number of positions.
        expected: usize,
        /// Number found.
        found: usize,
    },
    /// A number is NaN or infinite.
    #[error("point {point}: expected finite numbers; found NaN or infinity")]
    NotFinite {
        /// Index of the point.
        point: usize,
    },
    /// A time is not after the one before.
    #[error("point {point}: expected a time after {before_s} s, that of the point before; found {t_s} s")]
    TimeOrder {
        /// Index of the point.
        point: usize,
        /// Its time \[s\].
        t_s: f64,
        /// Time of the point before \[s\].
        before_s: f64,
    },
    /// Positions are so far beyond their limits that they must be degrees.
    #[error(
        "point {point}: joint {joint} at {found} rad, far beyond its limits of {} to {} rad; these look like degrees, and positions must be \
         in radians",
        told(.limits_rad)[0], told(.limits_rad)[1]
    )]
    Degrees {
        /// Index of the point.
        point: usize,
        /// Name of the joint.
        joint: String,
        /// Number found.
        found: f64,
        /// Limits of the joint \[rad\].
        limits_rad: [f64; 2],
    },
    /// A path without times turns a joint that has no limits by more than half a turn.
    #[error(
        "point {point}: joint {joint} has no limits and turns by {} rad from the point before; planners that keep such joints within half a \
         turn of 0 mean the {} rad the other way: state positions that do not jump by a whole turn, a point between, or times",
        rounded(*.by_rad, 6), rounded(other_way(*.by_rad), 6)
    )]
    LongTurn {
        /// Index of the point.
        point: usize,
        /// Name of the joint.
        joint: String,
        /// Turn from the point before \[rad\].
        by_rad: f64,
    },
    /// The points have speeds and no times, or accelerations and no speeds.
    #[error("the points have {what} and no {missing}; give {missing}, or leave the {what} out")]
    Without {
        /// Speeds or accelerations.
        what: &'static str,
        /// Times or speeds.
        missing: &'static str,
    },
    /// The chosen interpolation needs more than the points have.
    #[error("{} interpolation needs {} at every point; the points have no {missing}", .choice.word(), needs(*.choice))]
    Incomplete {
        /// The interpolation that was chosen.
        choice: Interpolation,
        /// Times, speeds or accelerations.
        missing: &'static str,
    },
}

/// Quantities that an interpolation needs besides positions, in words.
fn needs(choice: Interpolation) -> &'static str {
    match choice {
        Interpolation::Linear => "nothing else",
        Interpolation::Cubic => "times and speeds",
        Interpolation::Quintic => "times, speeds and accelerations",
    }
}

/// The turn to the same place the other way \[rad\].
fn other_way(by_rad: f64) -> f64 {
    by_rad - TAU.copysign(by_rad)
}

/// Rounds limits \[rad\] for a message.
fn told(limits_rad: &[f64; 2]) -> [f64; 2] {
    limits_rad.map(|limit| (1e4 * limit).round() / 1e4)
}

impl PointsError {
    /// Index of the point at fault, if it is a single one.
    #[must_use]
    pub fn point(&self) -> Option<usize> {
        match self {
            Self::NotFinite { point }
            | Self::TimeOrder { point, .. }
            | Self::Degrees { point, .. }
            | Self::LongTurn { point, .. } => Some(*point),
            _ => None,
        }
    }
}

/// Least distance beyond a joint's limits at which a position may be one in degrees \[rad\].
const FAR_RAD: f64 = PI;

impl JointPoints {
    /// Returns the motion through the points. Without a choice it is quintic between points with speeds and accelerations, cubic between points
    /// with speeds, and otherwise linear, as ROS 2's joint_trajectory_controller moves.
    ///
    /// # Errors
    /// [`PointsError`] with the first fault.
    pub fn motion(&self, arm: &RobotModel, choice: Option<Interpolation>) -> Result<PointMotion, PointsError> {
        self.check(arm)?;
        let most = choice.unwrap_or(match (&self.qd_rad_s, &self.qdd_rad_s2) {
            (Some(_), Some(_)) => Interpolation::Quintic,
            (Some(_), None) => Interpolation::Cubic,
            (None, _) => Interpolation::Linear,
        });
        let shape = |k: usize| match (&self.rates, choice) {
            (Some(rates), None) => Interpolation::ALL[rates[k].min(rates[k + 1]).min(2)],
            _ => most,
        };
        let first_s = self.t_s.as_ref().and_then(|all| all.first()).copied();
        let time = |k: usize| match (&self.t_s, first_s) {
            (Some(all), Some(first_s)) => all[k] - first_s,
            _ => k as f64,
        };
        let [speeds, accelerations] = self.rates_for(most, choice.is_some())?;
        let piece = |k: usize| {
            let (t_s, q_rad) = ([time(k), time(k + 1)], [self.q_rad[k], self.q_rad[k + 1]]);
            // Times that differ by less than rounding once they start from 0.
            if t_s[1] <= t_s[0] {
                return Err(self.time_order(k + 1));
            }
            let both = |rows: &[JointVector]| [rows[k], rows[k + 1]];
            Ok(match speeds.filter(|_| shape(k) > Interpolation::Linear) {
                None => MotionPiece::line(t_s, q_rad),
                Some(speeds) => MotionPiece {
                    qdd_rad_s2: accelerations.filter(|_| shape(k) == Interpolation::Quintic).map(both),
                    ..MotionPiece::cubic(t_s, q_rad, both(speeds))
                },
            })
        };
        let pieces: Vec<_> = (0..self.q_rad.len() - 1).map(piece).collect::<Result<_, _>>()?;
        let motion = PiecewiseMotion::new(pieces).map_err(|error| PointsError::NotFinite {
            point: match error {
                KnotError::NotFinite { knot } | KnotError::Apart { knot } | KnotError::Time { knot, .. } => knot,
                _ => 0,
            },
        })?;
        let mut motion = PointMotion {
            motion,
            shapes: (0..self.q_rad.len() - 1).map(shape).collect(),
            start: first_s.map(|first_s| self.start.later(first_s)),
            fixed: self.fixed.clone(),
            notes: self.notes.clone(),
        };
        if let simpler @ 1.. = motion.shapes.iter().filter(|shape| **shape < most).count() {
            let missing = if most == Interpolation::Cubic {
                "speeds"
            } else {
                "speeds or accelerations"
            };
            motion.notes.push(format!(
                "{simpler} of {} simpler than {}, as some points state no {missing}",
                match motion.shapes.len() {
                    1 => "1 piece is".to_owned(),
                    count => format!("{count} pieces are"),
                },
                most.word()
            ));
        }
        let unused: Vec<_> = [
            ("speeds", Interpolation::Cubic, self.qd_rad_s.is_some()),
            ("accelerations", Interpolation::Quintic, self.qdd_rad_s2.is_some()),
        ]
        .into_iter()
        .filter_map(|(what, needed, is_there)| (is_there && most < needed).then_some(what))
        .collect();
        if !unused.is_empty() {
            let (unused, word) = (unused.join(" and "), most.word());
            motion
                .notes
                .push(format!("its {unused} are not used, as {word} interpolation was chosen"));
        }
        Ok(motion)
    }

    /// Checks that there are two points at least, as many times and speeds, and that all numbers make sense.
    fn check(&self, arm: &RobotModel) -> Result<(), PointsError> {
        let expected = self.q_rad.len();
        let times = ("times", self.t_s.as_ref().map(Vec::len));
        let rates = ("rates", self.rates.as_ref().map(Vec::len));
        let rows = self.rows().map(|(what, rows)| (what, rows.map(<[_]>::len)));
        let counts = [times].into_iter().chain(rows).chain([rates]);
        for (what, found) in counts.filter_map(|(what, found)| Some((what, found?))) {
            if found != expected {
                return Err(PointsError::Count { what, expected, found });
            }
        }
        let is_finite = |point: usize| {
            let rates = self.rows().into_iter().filter_map(|(_, rows)| rows);
            let numbers = self.q_rad[point].iter().chain(rates.flat_map(|all| all[point].iter()));
            let time = self.t_s.iter().map(|all| &all[point]);
            numbers.chain(time).all(|v| v.is_finite())
        };
        if let Some(point) = (0..expected).find(|point| !is_finite(*point)) {
            return Err(PointsError::NotFinite { point });
        }
        if let Some(times) = &self.t_s
            && let Some(point) = (1..expected).find(|&point| times[point] <= times[point - 1])
        {
            return Err(self.time_order(point));
        }
        let there = [
            ("times", self.t_s.is_some()),
            ("speeds", self.qd_rad_s.is_some()),
            ("accelerations", self.qdd_rad_s2.is_some()),
        ];
        if let Some([(missing, _), (what, _)]) = there.array_windows().find(|[before, after]| after.1 && !before.1) {
            return Err(PointsError::Without { what, missing });
        }
        if let Some(error) = self.degrees(arm) {
            return Err(error);
        }
        match expected {
            0 | 1 => Err(PointsError::TooFew { found: expected }),
            _ => self.long_turn(arm).map_or(Ok(()), Err),
        }
    }

    /// Speeds and accelerations, as far as an interpolation needs them.
    fn rates_for(
        &self,
        choice: Interpolation,
        at_every_point: bool,
    ) -> Result<[Option<&[JointVector]>; 2], PointsError> {
        let missing = |missing| PointsError::Incomplete { choice, missing };
        let least = self.rates.iter().flatten().copied().min().filter(|_| at_every_point);
        match (choice, least) {
            (Interpolation::Cubic | Interpolation::Quintic, Some(0)) => return Err(missing("speeds at some of them")),
            (Interpolation::Quintic, Some(1)) => return Err(missing("accelerations at some of them")),
            _ => {}
        }
        if choice != Interpolation::Linear && self.t_s.is_none() {
            return Err(missing("times"));
        }
        let [speeds, accelerations] = self.rows().map(|(what, rows)| rows.ok_or_else(|| missing(what)));
        Ok(match choice {
            Interpolation::Linear => [None, None],
            Interpolation::Cubic => [Some(speeds?), None],
            Interpolation::Quintic => [Some(speeds?), Some(accelerations?)],
        })
    }

    /// Speeds and accelerations, with their names.
    fn rows(&self) -> [(&'static str, Option<&[JointVector]>); 2] {
        [
            ("speeds", self.qd_rad_s.as_deref()),
            ("accelerations", self.qdd_rad_s2.as_deref()),
        ]
    }

    fn time_order(&self, point: usize) -> PointsError {
        let [before_s, t_s] = [point - 1, point].map(|k| self.t_s.as_ref().map_or(f64::NAN, |all| all[k]));
        PointsError::TimeOrder { point, t_s, before_s }
    }

    /// Finds the first turn of more than half a turn of a joint without limits, in a path without times.
    fn long_turn(&self, arm: &RobotModel) -> Option<PointsError> {
        let limits = arm.limits();
        let is_endless = |joint: &usize| limits.lower[*joint].is_infinite() && limits.upper[*joint].is_infinite();
        let endless: Vec<usize> = (0..AXES).filter(is_endless).collect();
        let pairs = self.q_rad.windows(2).filter(|_| self.t_s.is_none());
        let mut turns = pairs.enumerate().flat_map(|(k, both)| {
            let turn = both[1] - both[0];
            endless.iter().map(move |&joint| (k + 1, joint, turn[joint]))
        });
        let (point, joint, by_rad) = turns.find(|(.., by_rad)| by_rad.abs() > PI)?;
        let joint = arm.joints()[joint].name.clone();
        Some(PointsError::LongTurn { point, joint, by_rad })
    }

    /// Finds the first position far beyond the joint's limits, where all positions are within their limits if they are read as degrees.
    fn degrees(&self, arm: &RobotModel) -> Option<PointsError> {
        let limits = arm.limits();
        let beyond =
            |q: &JointVector, joint: usize| (limits.lower[joint] - q[joint]).max(q[joint] - limits.upper[joint]);
        let is_far = |q: &JointVector| (0..AXES).find(|&joint| beyond(q, joint) > FAR_RAD);
        let (point, joint) = (0..)
            .zip(&self.q_rad)
            .find_map(|(point, q)| Some((point, is_far(q)?)))?;
        let fits = |q: &JointVector| (0..AXES).all(|joint| beyond(&q.map(f64::to_radians), joint) <= 1e-6);
        self.q_rad.iter().all(fits).then(|| PointsError::Degrees {
            point,
            joint: arm.joints()[joint].name.clone(),
            found: self.q_rad[point][joint],
            limits_rad: [limits.lower[joint], limits.upper[joint]],
        })
    }
}
