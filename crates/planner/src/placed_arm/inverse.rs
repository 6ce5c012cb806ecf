//! Configurations for a pose of the tip: all to start from, and the one that continues a path.

use crate::placed_arm::hindrance::Hindrance;
use platewash_kinematics::ik::analytic::{AnalyticArm, Degeneracies, Elbow, Label, Rejection, Shoulder, Solution};
use platewash_kinematics::ik::{IkSettings, IkSettingsError, IkSolver};
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::{AXES, Frame, JointLimits, JointVector, Pose, RobotModel};
use std::f64::consts::PI;

/// Tolerance of the numeric solver on a pose \[m and rad\]: far below the tolerances of a plan.
const TOLERANCE: f64 = 1e-9;

/// Configurations on one named branch this near to each other start the same path \[rad\].
const SAME_START_RAD: f64 = 0.5 * PI;

/// The same tolerance where branches have no names \[rad\].
const SAME_UNNAMED_RAD: f64 = 0.5;

/// Starts of the numeric solver's list that are tried for all branches of a pose.
const LISTED: usize = 96;

/// Sides of shoulder and elbow that an arm with named branches stays on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Sides {
    pub shoulder: Shoulder,
    pub elbow: Elbow,
    /// Number of the branch among those on these sides: [`Label::number`].
    pub number: u8,
}

impl From<Label> for Sides {
    fn from(label: Label) -> Self {
        let Label {
            shoulder,
            elbow,
            number,
            ..
        } = label;
        Self {
            shoulder,
            elbow,
            number,
        }
    }
}

/// A configuration to start from, and the branch to stay on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Start {
    /// \[rad\].
    pub q: JointVector,
    /// Shoulder and elbow, where the arm has named branches. The wrist follows by continuity: where axes 4 and 6 are
    /// parallel in the arm's plane, the names of its branches change and joint 4 does not.
    pub sides: Option<Sides>,
}

/// The inverse kinematics of an arm.
#[derive(Debug)]
pub(crate) enum Inverse<'a> {
    /// Closed form.
    Analytic {
        arm: AnalyticArm,
        tip: Frame,
        limits: &'a JointLimits,
    },
    /// Iteration, from the current configuration of a path.
    Numeric(Box<IkSolver<'a>>),
}

/// Width of the search for configurations to start from, on arms where they are searched for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Width {
    /// Starts from a configuration nearby, turned towards the target, and its mirrored branches.
    Near,
    /// Starts from the solver's list, too.
    Everywhere,
}

/// Settings of a solver that meets a pose to [`TOLERANCE`].
pub(crate) fn exact() -> IkSettings {
    IkSettings {
        position_tolerance_m: TOLERANCE,
        orientation_tolerance_rad: TOLERANCE,
        ..IkSettings::default()
    }
}

impl<'a> Inverse<'a> {
    pub fn new(robot: &'a RobotModel, tip: Frame) -> Result<Self, IkSettingsError> {
        if let (Ok(arm), AXES) = (AnalyticArm::recognise(robot), tip.body()) {
            return Ok(Self::Analytic {
                arm,
                tip,
                limits: robot.limits(),
            });
        }
        let settings = IkSettings {
            // A path goes on from where it is; an answer from anywhere else would be a jump.
            listed_starts: 0,
            ..exact()
        };
        Ok(Self::Numeric(Box::new(IkSolver::new(robot, tip, settings)?)))
    }

    /// The configuration for `target` that is nearest to `start`, on its branch and within the limits.
    ///
    /// # Errors
    /// [`Hindrance::Reach`], [`Hindrance::Limit`], [`Hindrance::Unsolved`] or [`Hindrance::NotFinite`].
    pub fn continuing(&self, target: &RigidTransform, start: &Start) -> Result<JointVector, Hindrance> {
        let (arm, tip, limits) = match self {
            Self::Analytic { arm, tip, limits } => (arm, tip, limits),
            Self::Numeric(solver) => return Ok(solver.solve(&Pose::from(target), &start.q)?.q),
        };
        let body = AnalyticArm::body_target(tip, target).ok_or(Hindrance::NotFinite)?;
        let found = arm.nearest(&body, &start.q, limits);
        let Some(Sides { shoulder, elbow, .. }) = start.sides else {
            return Ok(found?.q);
        };
        if let Ok(found) = found
            && on_sides(found.label, found.degenerate, shoulder, elbow)
        {
            return Ok(found.q);
        }
        let all = arm.solve_all(&body, &start.q, limits)?;
        let mut best: Result<JointVector, Option<Rejection>> = Err(None);
        for slot in all.on_sides(shoulder, elbow) {
            match slot {
                Ok(solution) => {
                    let q = solution.nearest(&start.q);
                    best = Ok(match best {
                        Ok(other) if (other - start.q).norm() <= (q - start.q).norm() => other,
                        _ => q,
                    });
                }
                Err(rejection) => best = best.map_err(|other| lesser(other, rejection)),
            }
        }
        best.map_err(|rejection| rejection.map_or(Hindrance::NotFinite, Hindrance::from))
    }

    /// Returns true where [`Inverse::starts`] knows every branch of the arm. On a rounded arm a branch near a singularity can be missing.
    pub fn knows_all_branches(&self) -> bool {
        matches!(self, Self::Analytic { arm, .. } if arm.rounding().is_none())
    }

    /// The configurations for `target` within the limits, one a branch, nearest to `near` \[rad\]: with shoulder in front (or on either
    /// side, where they are alike) and elbow up first (there the arm stays above what lies around it), then the nearest. In closed form these are all there are;
    /// otherwise those that a search of the given width finds, the nearest first.
    ///
    /// # Errors
    /// As [`Inverse::continuing`], when there is none.
    pub fn starts(&self, target: &RigidTransform, near: &JointVector, width: Width) -> Result<Vec<Start>, Hindrance> {
        let anywhere = Start { q: *near, sides: None };
        let (arm, tip, limits) = match self {
            Self::Analytic { arm, tip, limits } => (arm, tip, limits),
            Self::Numeric(solver) => {
                let listed = match width {
                    Width::Near => 0,
                    Width::Everywhere => LISTED,
                };
                let found = solver.spread(&Pose::from(target), near, listed)?;
                if found.is_empty() {
                    self.continuing(target, &anywhere)?;
                }
                return Ok(found.into_iter().map(|q| Start { q, sides: None }).collect());
            }
        };
        let body = AnalyticArm::body_target(tip, target).ok_or(Hindrance::NotFinite)?;
        let all = arm.solve_all(&body, near, limits)?;
        // A farther turn of a joint has the same pose and clearances, and would merge with the nearest one.
        let of_branch = |solution: &Solution| {
            let sides = Some(Sides::from(solution.label));
            solution.nearest_configurations(near).map(move |q| Start { q, sides })
        };
        let mut found: Vec<_> = all.iter().flat_map(of_branch).collect();
        let above = |sides: Sides| {
            sides.elbow == Elbow::Up && (sides.shoulder == Shoulder::Front || arm.shoulder_sides_are_alike())
        };
        let rank = |start: &Start| !start.sides.is_some_and(above);
        let far = |start: &Start| (start.q - near).norm();
        found.sort_by(|a, b| rank(a).cmp(&rank(b)).then(far(a).total_cmp(&far(b))));
        let mut starts = Vec::new();
        merge_starts(&mut starts, found);
        if starts.is_empty() {
            self.continuing(target, &anywhere)?;
        }
        Ok(starts)
    }
}

/// Adds the starts that no start there already stands for: of the turns of a joint only the first, nearest one counts.
pub(crate) fn merge_starts(starts: &mut Vec<Start>, more: Vec<Start>) {
    for start in more {
        let same = |other: &Start| {
            let turned = (start.q - other.q).map(|d| (d - 2.0 * PI * (d / (2.0 * PI)).round()).abs());
            let near = if start.sides.is_some() {
                SAME_START_RAD
            } else {
                SAME_UNNAMED_RAD
            };
            start.sides == other.sides && turned.amax() < near
        };
        if !starts.iter().any(same) {
            starts.push(start);
        }
    }
}

fn on_sides(label: Label, meets: Degeneracies, shoulder: Shoulder, elbow: Elbow) -> bool {
    (label.shoulder == shoulder || meets.shoulder) && (label.elbow == elbow || meets.elbow)
}

fn lesser(other: Option<Rejection>, rejection: Rejection) -> Option<Rejection> {
    let by = |r: &Rejection| Hindrance::from(*r).shortfall();
    match other {
        Some(other) if by(&other) <= by(&rejection) => Some(other),
        _ => Some(rejection),
    }
}
