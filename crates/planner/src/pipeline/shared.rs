//! Data that the phases of planning share.

use crate::error::PlanError;
use crate::out_of_range::OutOfRange;
use crate::pattern::Patterns;
use crate::placed_arm::{AXIS_SHARE, Contact, PlacedArm, Stance, Stretch, TILT_RESERVE_RAD, TiltPolicy};
use crate::redundancy::places::SEARCHED_M;
use crate::timing::{MotionLimits, TipLimits};
use crate::transit::ClearanceShortfall;
use crate::unwashable_plate::PlaceSearch;
use crate::watch::Watch;
use nalgebra::Vector3;
use platewash_bodies::clearance::ClearanceModel;
use platewash_bodies::job::{End, WashJob};
use platewash_kinematics::trig::sin_cos;
use platewash_kinematics::{Axes, JointVector, Pose, RobotModel};
use platewash_workcell::job::{JobTerms, PlannerSettings};
use platewash_workcell::plate::Plate;
use platewash_workcell::wash_path::WashPath;
use std::f64::consts::TAU;
use std::sync::Arc;

/// The longest line over a plate \[m\].
const LONGEST_LIFT_M: f64 = 10.0;

/// Most waypoints of the arc round the base.
const MOST_ARC_POINTS: f64 = 1e4;

/// Number of directions in which the acceleration of the tip is computed.
const DIRECTIONS: u32 = 16;

/// Data that the phases of planning share.
#[derive(Debug, Clone)]
pub(crate) struct Pipeline<'a> {
    pub robot: &'a RobotModel,
    /// `T_world_base`: everything else is in the frame of the base.
    pub mount: Pose,
    pub terms: &'a JobTerms,
    pub settings: &'a PlannerSettings,
    pub plates: &'a [Plate],
    pub clearance: ClearanceModel,
    /// The configuration not far from which the first plate is washed \[rad\].
    pub near_rad: JointVector,
    /// Reserve between the largest tilt planned and the largest allowed \[rad\].
    pub tilt_reserve_rad: f64,
    /// Limits while washing, and elsewhere.
    pub washing: MotionLimits,
    pub transit: MotionLimits,
    /// Extent of the search for another place where a plate cannot be washed.
    pub place_search: PlaceSearch,
    /// True where the cause is investigated that keeps a plate from being washed.
    pub explains: bool,
    /// The patterns to try on each plate.
    pub patterns: Vec<Arc<Patterns>>,
    /// The order of the plates, where it is not for the settings to decide.
    pub asked_order: Option<Vec<usize>>,
    /// Wash paths whose curves are taken as given: they are not turned towards the next place.
    pub asked_paths: Vec<WashPath>,
    pub watch: Watch<'a>,
}

impl<'a> Pipeline<'a> {
    /// A job as its arm sees it.
    pub fn from_job(job: &'a WashJob, watch: &Watch<'a>) -> Result<Self, PlanError> {
        let (seen, mount) = (job.seen_from_base(), &job.terms().workcell.mount);
        Self::new(job.arm(), (seen, mount), &seen.plates, watch)
    }

    /// Terms on plates, which need not be those of the terms, both in the frame of the base, and `T_world_base`.
    pub fn new(
        robot: &'a RobotModel,
        (terms, mount): (&'a JobTerms, &Pose),
        plates: &'a [Plate],
        watch: &Watch<'a>,
    ) -> Result<Self, PlanError> {
        let settings = terms.planner_settings().ok_or(PlanError::PaperJob)?;
        if !terms.workcell.tool.is_present() {
            return Err(PlanError::NoTool);
        }
        OutOfRange::check("lift_m", settings.lift_m, [0.0, LONGEST_LIFT_M])?;
        OutOfRange::check("arc.points", settings.arc.points as f64, [2.0, MOST_ARC_POINTS])?;
        for (end, q) in ends(terms) {
            if let Some(violation) = robot.limits().violation(q) {
                return Err(PlanError::Home { end, violation });
            }
        }
        let of_tip = |speed_m_s, acceleration_m_s2| MotionLimits {
            velocity: robot.limits().velocity,
            acceleration: terms.limits.joint_acceleration_rad_s2.into(),
            tip: Some(TipLimits {
                speed_m_s,
                acceleration_m_s2,
            }),
        };
        let mut pipeline = Self {
            robot,
            mount: *mount,
            terms,
            settings,
            plates,
            clearance: ClearanceModel::new(robot, &terms.workcell, plates)?,
            washing: of_tip(terms.wash_speed_m_s(), terms.wash_acceleration_m_s2()),
            transit: of_tip(terms.limits.tip_speed_m_s, terms.limits.tip_acceleration_m_s2),
            place_search: if settings.relocate {
                PlaceSearch::Within(SEARCHED_M)
            } else {
                PlaceSearch::Off
            },
            near_rad: terms.home_rad[0],
            tilt_reserve_rad: TILT_RESERVE_RAD,
            explains: true,
            patterns: Vec::new(),
            asked_order: None,
            asked_paths: Vec::new(),
            watch: *watch,
        };
        pipeline.patterns = pipeline.patterns_by_plate()?;
        Ok(pipeline)
    }

    /// A job as it stands, its plates in that order, and along those paths as far as there are any.
    pub fn in_order(
        job: &'a WashJob,
        order: &[usize],
        paths: &[WashPath],
        watch: &Watch<'a>,
    ) -> Result<Self, PlanError> {
        let mut pipeline = Self::here(job, watch)?;
        for path in paths {
            if let Some(patterns) = pipeline.patterns.get_mut(path.plate) {
                *patterns = Arc::new(patterns.along(path));
            }
        }
        let mut sorted = order.to_vec();
        sorted.sort_unstable();
        if !sorted.into_iter().eq(pipeline.terms.plates_to_wash()) {
            let count = pipeline.terms.plates_to_wash().count();
            return Err(PlanError::Order { count });
        }
        Ok(Self {
            asked_order: Some(order.to_vec()),
            asked_paths: paths.to_vec(),
            ..pipeline
        })
    }

    /// A job as it stands: no other place is looked for.
    pub fn here(job: &'a WashJob, watch: &Watch<'a>) -> Result<Self, PlanError> {
        let pipeline = Self::from_job(job, watch)?;
        let place_search = match pipeline.place_search {
            PlaceSearch::Within(_) => PlaceSearch::Later,
            never => never,
        };
        Ok(Self {
            place_search,
            ..pipeline
        })
    }

    /// The same pipeline from turns away from home, without explanations: joints of many turns that are near a limit at home are moved by whole
    /// turns to where they can turn both ways. `None` where that moves none.
    pub fn turned_inside(&self) -> Option<Self> {
        let limits = self.robot.limits();
        let inside = |joint: usize| {
            limits
                .turned_inside(joint, self.near_rad[joint])
                .filter(|_| limits.is_wide(joint))
        };
        let near_rad = JointVector::from_fn(|joint, _| inside(joint).unwrap_or(self.near_rad[joint]));
        (near_rad != self.near_rad).then(|| Self {
            near_rad,
            explains: false,
            place_search: PlaceSearch::Off,
            ..self.among(self.plates)
        })
    }

    /// The same pipeline among as many plates at other places, without a listener.
    pub fn among<'b>(&self, plates: &'b [Plate]) -> Pipeline<'b>
    where
        'a: 'b,
    {
        let mut among: Pipeline<'b> = self.clone();
        among.plates = plates;
        among.clearance.lay(plates);
        among.watch = Watch::silent(self.watch.cancel);
        among
    }

    /// The arm among the plates.
    pub fn placed(&self) -> Result<PlacedArm<'_>, PlanError> {
        let (tool, reach) = (&self.terms.workcell.tool, self.settings.reach);
        let placed = PlacedArm::new(self.robot, tool, &self.clearance, self.plates, reach)?;
        let stance = Stance {
            axis_share: self.settings.axis_share.unwrap_or(AXIS_SHARE),
            wrist_rad: self.terms.requirements.wrist_rad,
            tilt_reserve_rad: self.tilt_reserve_rad,
            aside_rad: 0.0,
        };
        Ok(placed
            .mounted(self.mount)
            .with_stance(stance)
            .with_cancel(self.watch.cancel))
    }

    /// The tilt that suits each place.
    pub fn policy(&self) -> TiltPolicy {
        TiltPolicy::upright(self.terms.tilt_max_rad(), &self.settings.reach)
    }

    /// The clearance asked for \[m\].
    pub fn clearance_m(&self) -> f64 {
        self.terms.requirements.clearance_m
    }

    /// Limits of the wash of a plate.
    pub fn washing_of(&self, plate: usize) -> MotionLimits {
        let mut limits = self.washing;
        if let (Some(tip), Some(plate)) = (&mut limits.tip, self.plates.get(plate)) {
            tip.speed_m_s = self.terms.wash_speed_of(plate);
        }
        limits
    }

    /// Position of the tip at an end \[m\], in the frame of the base.
    pub fn home_tip(&self, placed: &PlacedArm<'_>, home: &JointVector) -> Vector3<f64> {
        self.robot.fk(home).rigid(&placed.tip).translation
    }

    /// The patterns of each plate; of equal faces they are the same.
    fn patterns_by_plate(&self) -> Result<Vec<Arc<Patterns>>, PlanError> {
        let placed = self.placed()?;
        let mut all: Vec<Arc<Patterns>> = Vec::with_capacity(self.plates.len());
        for (k, plate) in self.plates.iter().enumerate() {
            let is_like = |other: &&Plate| other.surface == plate.surface && other.terms == plate.terms;
            all.push(match self.plates[..k].iter().position(|other| is_like(&other)) {
                Some(like) => all[like].clone(),
                None => {
                    let alike = self.plates.iter().filter(is_like);
                    let most = alike
                        .filter_map(|plate| self.tip_acceleration(&placed, plate))
                        .reduce(f64::max);
                    let most_m_s2 = most.unwrap_or(f64::INFINITY);
                    let cancel = self.watch.cancel;
                    Arc::new(Patterns::new(self.terms, self.settings, plate, most_m_s2, cancel))
                }
            });
        }
        Ok(all)
    }

    /// The configuration near another one with the tool upright at a point of a plate's face \[m\].
    pub fn configuration_at(
        &self,
        placed: &PlacedArm<'_>,
        plate: &Plate,
        point: Vector3<f64>,
        near: &JointVector,
    ) -> Option<JointVector> {
        let contact = Contact::on_normal(point, plate.normal_at(&point));
        placed.configuration(&contact, &self.policy(), near)
    }

    /// Acceleration of the tip \[m/s²\] along the face at the centre of a plate that the accelerations of the joints allow, with the tool
    /// upright and not turning: the time on a circle is that of this acceleration in every direction.
    fn tip_acceleration(&self, placed: &PlacedArm<'_>, plate: &Plate) -> Option<f64> {
        let q = self.configuration_at(placed, plate, plate.centre(), &self.terms.home_rad[0])?;
        let inverse = self.robot.fk(&q).jacobian(&placed.tip, Axes::Base).try_inverse()?;
        let axes =
            [Vector3::x(), Vector3::y()].map(|axis| inverse.fixed_columns::<3>(0) * (plate.pose.rotation * axis));
        let slowness = |k: u32| {
            let (s, c) = sin_cos(TAU * f64::from(k) / f64::from(DIRECTIONS));
            let needed = (axes[0] * c + axes[1] * s).component_div(&self.washing.acceleration);
            needed.amax().sqrt()
        };
        let mean = (0..DIRECTIONS).map(slowness).sum::<f64>() / f64::from(DIRECTIONS);
        Some(1.0 / (mean * mean))
    }

    /// Refuses a plate that is not there.
    pub fn check_plate(&self, plate: usize) -> Result<(), PlanError> {
        let count = self.plates.len();
        if plate < count {
            return Ok(());
        }
        Err(PlanError::Plate { plate, count })
    }

    /// Refuses end configurations at which the arm is too near something.
    pub fn check_homes(&self) -> Result<(), PlanError> {
        self.check_homes_among(&self.clearance)
    }

    /// Checks that both homes are clear of the given bodies.
    pub fn check_homes_among(&self, bodies: &ClearanceModel) -> Result<(), PlanError> {
        for (end, q) in ends(self.terms) {
            let too_near = ClearanceShortfall::at(bodies, q, Stretch::Free, self.clearance_m());
            if let Some(too_near) = too_near.map(Box::new) {
                return Err(PlanError::HomeNotClear { end, too_near });
            }
        }
        Ok(())
    }
}

fn ends(terms: &JobTerms) -> impl Iterator<Item = (End, &JointVector)> {
    [End::Start, End::End].into_iter().zip(&terms.home_rad)
}
