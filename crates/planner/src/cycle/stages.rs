//! The stages of a cycle, one after the other.

use super::activity::{Activity, Listener, NOBODY};
use super::arm::Arm;
use super::assemble::{self, Assembled};
use super::visit::{self, Visit};
use super::{CrossingSummary, CycleError, TourSummary, VisitSummary, tilt, travel};
use crate::crossing::{self, Crossing, PaperArc, RESERVE_M, Scene, Stage, Terminal, TooNear};
use crate::posture::{self, Cell, PostureSettings};
use crate::scenario::{OrderRule, Scenario};
use crate::timing::{MotionLimits, TipLimits};
use nalgebra::Vector3;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_workcell::clearance::ClearanceModel;
use platewash_workcell::layout::Plate;
use platewash_workcell::random;
use platewash_workcell::stroke::Stroke;
use platewash_workcell::trajectory::Trajectory;

/// What the stages share.
pub(super) struct Stages<'a> {
    pub scenario: &'a Scenario,
    pub robot: &'a RobotModel,
    pub plates: &'a [Plate],
    pub clearance: ClearanceModel,
    /// Limits while washing, and elsewhere.
    washing: MotionLimits,
    crossing: MotionLimits,
    pub posture: PostureSettings,
    /// Configurations at the start and at the end \[rad\].
    pub homes: [JointVector; 2],
    /// Hears what is being done.
    pub listener: Listener<'a>,
}

/// What the stages make.
pub(super) struct Planned {
    pub order: Vec<usize>,
    pub tour: TourSummary,
    pub visits: Vec<VisitSummary>,
    pub crossings: Vec<CrossingSummary>,
    pub whole: Assembled,
}

impl<'a> Stages<'a> {
    pub fn new(scenario: &'a Scenario, robot: &'a RobotModel, plates: &'a [Plate]) -> Result<Self, CycleError> {
        if scenario.tool.length_m <= 0.0 {
            return Err(CycleError::NoTool);
        }
        if let Some(height_m) = scenario.height_off_contact_m() {
            return Err(CycleError::NoContact { height_m });
        }
        let homes = scenario.homes();
        if let Some(violation) = robot.limits().violation(&homes[1]) {
            return Err(CycleError::Home(violation));
        }
        let (wash, limits) = (&scenario.wash, &scenario.limits);
        let of_tip = |speed_m_s, acceleration_m_s2| MotionLimits {
            velocity: robot.limits().velocity,
            acceleration: limits.joint_acceleration_rad_s2.into(),
            tip: Some(TipLimits {
                speed_m_s,
                acceleration_m_s2,
            }),
        };
        Ok(Self {
            scenario,
            robot,
            plates,
            clearance: ClearanceModel::new(robot, &scenario.tool, plates).map_err(CycleError::Clearance)?,
            washing: of_tip(
                wash.speed_m_s.min(limits.tip_speed_m_s),
                wash.acceleration_m_s2.min(limits.tip_acceleration_m_s2),
            ),
            crossing: of_tip(limits.tip_speed_m_s, limits.tip_acceleration_m_s2),
            posture: PostureSettings {
                tilt_max_rad: scenario.tilt_max_rad(),
                clearance_m: wash.clearance_m,
            },
            homes,
            listener: NOBODY,
        })
    }

    /// The same with a listener.
    pub fn telling(self, listener: Listener<'a>) -> Self {
        Self { listener, ..self }
    }

    /// The same among as many plates that lie elsewhere; nobody listens.
    pub fn among<'b>(&self, plates: &'b [Plate]) -> Stages<'b>
    where
        'a: 'b,
    {
        Stages {
            plates,
            clearance: self.clearance.among(plates),
            listener: NOBODY,
            scenario: self.scenario,
            robot: self.robot,
            washing: self.washing,
            crossing: self.crossing,
            posture: self.posture,
            homes: self.homes,
        }
    }

    /// The arm among the plates.
    pub(super) fn arm(&self) -> Result<Arm<'_>, CycleError> {
        let cell =
            Cell::new(self.robot, &self.scenario.tool, &self.clearance, self.plates).map_err(CycleError::Cell)?;
        Ok(Arm::new(cell, self.posture.tilt_max_rad)?)
    }

    /// Refuses end configurations at which the arm is too near something.
    pub(super) fn check_homes(&self) -> Result<(), CycleError> {
        for (key, q) in ["robot.start_deg", "robot.home_deg"].into_iter().zip(&self.homes) {
            if let Some(too_near) = TooNear::free(&self.clearance, q, self.scenario.wash.clearance_m) {
                let too_near = Box::new(too_near);
                return Err(CycleError::HomeNotClear { key, too_near });
            }
        }
        Ok(())
    }

    pub(super) fn carry_out(&self) -> Result<Planned, CycleError> {
        self.check_homes()?;
        let arm = self.arm()?;
        let (order, tour) = self.order(&arm);
        let visits = self.visits(&arm, &order)?;
        let [start, end] = self.homes.map(Terminal::home);
        let leaving = std::iter::once(&start).chain(visits.iter().map(|v| &v.exit));
        let entering = visits.iter().map(|v| &v.entry).chain(std::iter::once(&end));
        let crossings = self.crossings(&arm, leaving, entering, |_| true)?;
        let duration = |motion: &Trajectory| motion.duration_s();
        let whole = assemble::assemble(&visits, &crossings)?;
        tilt::check(&whole, self.robot, &arm.cell.tip, self.posture.tilt_max_rad)?;
        Ok(Planned {
            tour,
            visits: visits
                .iter()
                .map(|visit| VisitSummary {
                    plate: visit.plate,
                    posture: visit.washing.how,
                    wash_s: duration(&visit.wash.motion),
                })
                .collect(),
            crossings: crossings
                .iter()
                .map(|crossing| CrossingSummary {
                    route: crossing.route,
                    duration_s: duration(&crossing.timed.motion),
                })
                .collect(),
            whole,
            order,
        })
    }

    pub(super) fn order(&self, arm: &Arm<'_>) -> (Vec<usize>, TourSummary) {
        let times = travel::times(self.scenario, arm, self.plates, &self.homes, &self.crossing);
        let nearest = times.nearest_next();
        let nearest_next_s = times.of(&nearest);
        let (order, optimality) = match self.scenario.job.order {
            OrderRule::Given => ((0..self.plates.len()).collect(), None),
            OrderRule::Nearest => (nearest, None),
            OrderRule::Fastest => {
                let (order, optimality) = times.best();
                (order, Some(optimality))
            }
        };
        let tour = TourSummary {
            travel_s: times.of(&order),
            nearest_next_s,
            optimality,
        };
        (order, tour)
    }

    fn visits(&self, arm: &Arm<'_>, order: &[usize]) -> Result<Vec<Visit>, CycleError> {
        self.check_unblocked(arm, order)?;
        let mut visits: Vec<Visit> = Vec::with_capacity(order.len());
        for (k, &plate) in order.iter().enumerate() {
            let (turn, of) = (k + 1, order.len());
            (self.listener)(&Activity::Posture { plate, turn, of });
            let (centre, stroke) = self.stroke(arm, order, k);
            let near = visits.last().and_then(|v| v.washing.q.last()).unwrap_or(&self.homes[0]);
            let washing = posture::washing(&arm.cell, &stroke, centre, plate, &self.posture, near)
                .map_err(|error| self.unwashable(arm, plate, (centre, &stroke), near, error))
                .map_err(|plate| CycleError::Unwashable(Box::new(plate)))?;
            visits.push(visit::plan(
                self.scenario,
                arm,
                plate,
                (centre, stroke),
                washing,
                &self.washing,
            )?);
        }
        Ok(visits)
    }

    /// Refuses at once a plate of which a few points tell that it cannot be washed, before others are searched for minutes.
    fn check_unblocked(&self, arm: &Arm<'_>, order: &[usize]) -> Result<(), CycleError> {
        let near = &self.homes[0];
        for (k, &plate) in order.iter().enumerate() {
            let (centre, stroke) = self.stroke(arm, order, k);
            let blocked = posture::is_blocked(&arm.cell, &stroke, centre, plate, &self.posture, near);
            if !blocked.unwrap_or(false) {
                continue;
            }
            let (turn, of) = (k + 1, order.len());
            (self.listener)(&Activity::Posture { plate, turn, of });
            // A tilt between those of the search may still do.
            if let Err(error) = posture::washing(&arm.cell, &stroke, centre, plate, &self.posture, near) {
                let plate = self.unwashable(arm, plate, (centre, &stroke), near, error);
                return Err(CycleError::Unwashable(Box::new(plate)));
            }
        }
        Ok(())
    }

    /// Centre \[m\] and stroke of the `k`-th plate of an order.
    pub(super) fn stroke(&self, arm: &Arm<'_>, order: &[usize], k: usize) -> (Vector3<f64>, Stroke) {
        let home = self.robot.fk(&self.homes[1]).rigid(&arm.cell.tip).translation;
        let centre = visit::centre(&self.plates[order[k]], self.scenario);
        let towards = order
            .get(k + 1)
            .map_or(home, |&next| visit::centre(&self.plates[next], self.scenario));
        (centre, visit::stroke(self.scenario, &centre, &towards))
    }

    /// Crossings from each of `leaving` to the one of `entering` beside it, those that `wanted` names by their index. Each
    /// draws from a stream of its own.
    pub(super) fn crossings<'t>(
        &self,
        arm: &Arm<'_>,
        leaving: impl Iterator<Item = &'t Terminal>,
        entering: impl Iterator<Item = &'t Terminal>,
        wanted: impl Fn(usize) -> bool,
    ) -> Result<Vec<Crossing>, CycleError> {
        let keeps_clear =
            |q: &JointVector, stage: Stage| arm.keeps_clear(q, stage, self.scenario.wash.clearance_m + RESERVE_M);
        let nearest = |q: &JointVector, stage: Stage| arm.too_near(q, stage, self.scenario.wash.clearance_m);
        let pose = |p: Vector3<f64>| arm.pose(p);
        let arc = PaperArc {
            arc: self.scenario.arc(),
            solver: &arm.solver,
            pose: &pose,
        };
        let scene = Scene {
            robot: self.robot,
            tip: &arm.cell.tip,
            keeps_clear: &keeps_clear,
            too_near: &nearest,
            limits: &self.crossing,
            arc: Some(&arc),
        };
        let pairs = leaving.zip(entering).enumerate().filter(|(k, _)| wanted(*k));
        let of = self.plates.len() + 1;
        pairs
            .map(|(k, (from, to))| {
                (self.listener)(&Activity::Crossing { turn: k + 1, of });
                let mut rng = random::stream(self.scenario.seed, &format!("crossing {k}"));
                Ok(crossing::plan(&scene, from, to, &mut rng)?)
            })
            .collect()
    }
}
