//! From a scenario to the job that it states.
//!
//! | concept | module |
//! | --- | --- |
//! | the arm; the tool on it | `arm`; `tool_on_arm` |
//! | the link that a mount and touched places count from | `mount` |
//! | places of the plates; plates and soils out of files | `placement`; `plate_files`, `read_plates` |
//! | bodies around the arm; meshes as convex bodies | `surroundings`; `solids` |
//! | requirements of contact and contact speed | `contact` |
//! | keys with a narrower range in a certified job than in the paper's program | `certified` |
//! | bounds on the amount of work | `work` |

pub(crate) mod arm;
pub(crate) mod certified;
pub(crate) mod contact;
pub(crate) mod mount;
pub(crate) mod placement;
pub(crate) mod plate_files;
pub(crate) mod read_plates;
pub(crate) mod solids;
pub(crate) mod surroundings;
pub(crate) mod tool_on_arm;
pub(crate) mod work;

use crate::error::{Problem, ScenarioError};
use crate::failure::Failure;
use crate::scenario::Scenario;
use crate::sections::motion::Program;
use crate::sections::robot::ReducedClearanceSection;
use crate::sections::wash::{PAPER_RADIUS_M, PAPER_TURNS};
use crate::to_job::arm::load;
use platewash_bodies::assembly;
use platewash_bodies::job::check_standing;
use platewash_bodies::job::{End, JobError, WashJob};
use platewash_kinematics::urdf::{FixedJoints, MeshSource};
use platewash_kinematics::{JointVector, RobotModel};
use platewash_paper::order::PaperOrder;
use platewash_paper::settings::{PaperIk, TransitCurve};
use platewash_paper::{PaperJob, PaperSettings, PaperSpiral};
use platewash_planner::Watch;
use platewash_planner::suggest::suggest_home;
use platewash_workcell::arc::Arc as ArcRoundBase;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::{JobTerms, Limits, OrderRule, Planner, PlannerSettings, ReachBorders, Requirements};
use platewash_workcell::layout::{Finding, Layout};
use platewash_workcell::simulation::{ControlLawName, SimulationSettings};
use platewash_workcell::tool::{Sponge, Tool};
use platewash_workcell::{ReducedClearance, Workcell};
use std::borrow::Cow;
use std::sync::Arc;

impl Scenario {
    /// The arm.
    ///
    /// # Errors
    /// [`Failure::Arm`].
    pub fn arm(&self) -> Result<Arc<RobotModel>, Failure> {
        let arm = load(&self.robot, &self.files, &FixedJoints::new(), &self.solids)?;
        Ok(Arc::new(arm))
    }

    /// Reads every file that the scenario names, as its job would. The job reports the errors in them.
    pub fn read_files(&self) {
        // Errors are dropped on purpose.
        let _ = self.arm();
        let _ = self.plates_read();
        let of_tool = self.tool_body.iter().map(|section| &section.body);
        for body in of_tool.chain(self.obstacle.iter().map(|section| &section.body)) {
            if let Some(mesh) = &body.mesh {
                let _ = self.meshes().solid(&mesh.to_string_lossy(), None);
            }
        }
    }

    /// Source of the meshes of its bodies.
    pub(crate) fn meshes(&self) -> MeshSource {
        MeshSource::new(&self.robot.package_path, None).reading(&self.files)
    }

    /// The washing that the scenario asks for, resolved: the arm loaded, the plates placed.
    ///
    /// # Errors
    /// [`Failure`].
    pub fn job(&self) -> Result<WashJob, Failure> {
        let read = self.plates_read()?;
        let arm = read.arm()?;
        let layout = read.place(&arm, &Watch::silent(&CancelToken::new()))?;
        read.job_on(&arm, &layout)
    }

    /// The washing that the scenario asks for with an arm loaded and plates placed before.
    ///
    /// # Errors
    /// [`Failure`].
    pub fn job_on(&self, arm: &Arc<RobotModel>, layout: &Layout) -> Result<WashJob, Failure> {
        self.validate()?;
        self.check_work()?;
        Ok(WashJob::new(arm.clone(), self.terms(arm, layout)?)?.named(&self.name))
    }

    /// The run of the paper's program that the scenario asks for, resolved.
    ///
    /// # Errors
    /// [`Failure`].
    pub fn paper_job(&self) -> Result<PaperJob, Failure> {
        let arm = self.arm()?;
        let layout = self.layout(&arm)?;
        self.paper_job_on(&arm, layout)
    }

    /// The run of the paper's program that the scenario asks for with an arm loaded and plates placed before.
    ///
    /// # Errors
    /// [`Failure`].
    pub fn paper_job_on(&self, arm: &Arc<RobotModel>, layout: Layout) -> Result<PaperJob, Failure> {
        self.validate()?;
        self.check_work()?;
        let [start, _] = self.homes();
        Ok(PaperJob {
            name: self.name.clone(),
            arm: arm.clone(),
            workcell: self.workcell(arm, layout.plates.len())?,
            layout,
            seed: self.seed,
            start_rad: start.unwrap_or_else(JointVector::zeros),
            requirements: self.requirements(),
            limits: self.limits(arm),
            settings: self.paper_settings(),
            simulation: self.simulation(arm),
        })
    }

    /// Checks a scenario without carrying it out: the arm loads, its ends are within its limits and clear, and the plates have room in
    /// principle (given ones are placed; for sampled ones the region is not empty).
    ///
    /// Returns the arm, and the findings on given plates.
    ///
    /// # Errors
    /// As carrying it out, for the same fault.
    pub fn check(&self) -> Result<(Arc<RobotModel>, Vec<Finding>), Failure> {
        if let Cow::Owned(read) = self.plates_read()? {
            return read.check();
        }
        self.validate()?;
        let arm = self.arm()?;
        let given = self.lists_plates();
        let layout = if given {
            self.layout(&arm)?
        } else {
            self.check_region()?;
            Layout::from_plates(Vec::new())
        };
        let [start, _] = self.homes();
        if let Some(violation) = start.and_then(|start| arm.limits().violation(&start)) {
            return Err(JobError::Home {
                end: End::Start,
                violation,
            }
            .into());
        }
        if given {
            self.check_on(&arm, &layout)?;
        } else if self.job.program == Program::Certified {
            self.check_standing(&arm, &layout)?;
        }
        Ok((arm, layout.findings))
    }

    /// Refuses plates that would be refused before anything is planned.
    ///
    /// # Errors
    /// The error that the job itself would end with.
    pub fn check_on(&self, arm: &Arc<RobotModel>, layout: &Layout) -> Result<(), Failure> {
        match self.job.program {
            Program::Certified => self.check_standing(arm, layout)?,
            Program::Paper => self.paper_job_on(arm, layout.clone())?.validate()?,
        }
        Ok(())
    }

    /// Refuses what stands where it cannot, of a certified job on some plates or on none.
    ///
    /// # Errors
    /// The error that the job itself would end with, with advice on meshes that count as hulls.
    pub fn check_standing(&self, arm: &Arc<RobotModel>, layout: &Layout) -> Result<(), Failure> {
        self.check_as_stated(arm, layout)
            .map_err(|why| self.with_advice_on_hulls(arm, layout, why))
    }

    /// Same as [`Self::check_standing`], without advice on meshes.
    pub(crate) fn check_as_stated(&self, arm: &Arc<RobotModel>, layout: &Layout) -> Result<(), Failure> {
        match layout.plates.is_empty() {
            true => platewash_planner::check(arm, &self.terms(arm, layout)?)?,
            false => platewash_planner::check(arm, self.job_on(arm, layout)?.terms())?,
        }
        Ok(())
    }

    /// The terms of the job on some plates; where no home is stated, one is found for them.
    ///
    /// # Errors
    /// [`Failure`]: a tip that washes off the plates, or an arm with a shape that is none.
    pub fn terms(&self, arm: &RobotModel, layout: &Layout) -> Result<JobTerms, Failure> {
        if let Cow::Owned(read) = self.plates_read()? {
            return read.terms(arm, layout);
        }
        if self.wash.height_m != 0.0 {
            let height_m = self.wash.height_m;
            return Err(Failure::NoContact { height_m });
        }
        let workcell = self.workcell(arm, layout.plates.len())?;
        self.check_bodies(&workcell)?;
        let wash = &self.wash;
        let [start, end] = self.homes();
        let zeros = JointVector::zeros;
        let mut terms = JobTerms {
            workcell,
            plates: layout.plates.clone(),
            requirements: self.requirements(),
            limits: self.limits(arm),
            home_rad: [start.unwrap_or_else(zeros), end.unwrap_or_else(zeros)],
            planner: Planner::Wash(PlannerSettings {
                path_radius_m: wash.path_radius_m,
                turns: wash.turns,
                closing_ring: wash.closing_ring,
                pattern: wash.pattern,
                tilt_rad: wash.tilt_deg.map(f64::to_radians),
                axis_share: wash.axis_share,
                lift_m: wash.lift_m,
                order: self.job.order,
                arc: self.arc(),
                reach: ReachBorders::IRB_120,
                relocate: self.lists_plates(),
            }),
            seed: self.seed,
            simulation: self.simulation(arm),
            dry_run: None,
            recovery: None,
            soils: self.soils().to_vec(),
            measured: self.measured().to_vec(),
        };
        if start.is_none() {
            // A body in an impossible place leaves no home either, and is the better reason.
            check_standing(&terms, arm)?;
            let found = suggest_home(arm, &terms, &CancelToken::new())?.q_rad();
            terms.home_rad = [found, end.unwrap_or(found)];
        }
        Ok(terms)
    }

    /// The settings of the paper's program.
    #[must_use]
    pub fn paper_settings(&self) -> PaperSettings {
        let (wash, transition, ik) = (&self.wash, &self.transition, &self.ik);
        PaperSettings {
            spiral: PaperSpiral {
                points: wash.points,
                turns: wash.turns.unwrap_or(PAPER_TURNS),
                radius_m: wash.path_radius_m.unwrap_or(PAPER_RADIUS_M),
                closing_ring: wash.closing_ring.unwrap_or(false),
            },
            height_m: wash.height_m,
            transit: TransitCurve {
                interpolation: transition.interpolation,
                samples: transition.samples,
            },
            arc: self.arc(),
            ik: PaperIk {
                method: ik.method,
                seed: ik.seed,
                position_tolerance_m: ik.position_tolerance_m,
                orientation_tolerance_rad: ik.orientation_tolerance_rad,
            },
            order: match self.job.order {
                OrderRule::Given => PaperOrder::Given,
                // The least travel time is refused for the paper's program before.
                OrderRule::Nearest | OrderRule::Fastest => PaperOrder::Nearest,
            },
        }
    }

    /// The arm with its tool in its mount, and the bodies around it, for a number of plates.
    ///
    /// # Errors
    /// [`Failure`]: an obstacle that is none, or an arm with a shape that is none.
    pub fn workcell(&self, arm: &RobotModel, plates: usize) -> Result<Workcell, Failure> {
        self.check_mount(arm)?;
        let tool = self.tool_on(arm)?;
        let obstacles = self.obstacles(arm, &tool, plates)?;
        let mut workcell = assembly::workcell(arm, tool, self.robot.mount(arm), obstacles)?;
        workcell.reduced_clearances = self.reduced_clearances()?;
        Ok(workcell)
    }

    fn reduced_clearances(&self) -> Result<Vec<ReducedClearance>, ScenarioError> {
        let required_m = self.wash.clearance_m;
        let reduced = |(index, section): (usize, &ReducedClearanceSection)| {
            let ReducedClearanceSection { a, b, clearance_m } = section;
            if *clearance_m >= required_m {
                let keys = format!("reduced_clearance[{index}].clearance_m, wash.clearance_m");
                let detail = format!("{clearance_m} m is not less than what all pairs keep, {required_m} m");
                return Err(ScenarioError::new(&self.name, None, Problem::conflict(keys, detail)));
            }
            Ok(ReducedClearance {
                pair: [a.clone(), b.clone()],
                by_m: required_m - clearance_m,
                at_stop: false,
            })
        };
        self.reduced_clearance.iter().enumerate().map(reduced).collect()
    }

    fn requirements(&self) -> Requirements {
        let wash = &self.wash;
        let [landing_m_s, lifting_m_s] = wash.landing_and_lifting_m_s();
        Requirements {
            coverage: self.job.required_coverage,
            clearance_m: wash.clearance_m,
            tilt_rad: wash.tilt_max_deg.to_radians(),
            wash_speed_m_s: wash.speed_m_s,
            wash_acceleration_m_s2: wash.acceleration_m_s2,
            overlap: self.layout.overlap,
            as_listed: self.job.order == OrderRule::Given,
            landing_m_s,
            lifting_m_s,
            wrist_rad: wash.wrist_rad(),
            contact: wash.contact_requirements(),
            holder: self.holder.terms(),
        }
    }

    /// Limits of the motion: of joint accelerations the lesser of the scenario's and the description's.
    fn limits(&self, arm: &RobotModel) -> Limits {
        let limits = &self.limits;
        let accelerations = limits.joint_acceleration_rad_s2.into();
        Limits {
            joint_acceleration_rad_s2: arm.limits().within_acceleration(&accelerations).into(),
            tip_speed_m_s: limits.tip_speed_m_s,
            tip_acceleration_m_s2: limits.tip_acceleration_m_s2,
        }
    }

    /// The sponge, where there is a tool that holds one.
    fn sponge(&self) -> Option<Sponge> {
        let tool = Tool::from(self.tool.straight());
        tool.is_present().then_some(tool.sponge)
    }

    fn simulation(&self, arm: &RobotModel) -> SimulationSettings {
        SimulationSettings {
            law: self.law(),
            control: self.control.settings(),
            plant: self.plant.settings(self.sponge().as_ref(), arm.friction()),
            payload_kg: self.robot.payload_kg,
        }
    }

    /// The control law: the one stated, otherwise the paper's for the paper's program and computed torque for a certified job.
    #[must_use]
    pub fn law(&self) -> ControlLawName {
        self.control.law.unwrap_or(match self.job.program {
            Program::Paper => ControlLawName::Paper,
            Program::Certified => ControlLawName::ComputedTorque,
        })
    }

    /// The arc round the base.
    #[must_use]
    pub fn arc(&self) -> ArcRoundBase {
        let section = &self.transition;
        let outside_m = (self.layout.base_radius_m + 0.1).max(0.3);
        ArcRoundBase {
            points: section.mid_points,
            radius_m: section.mid_radius_m.unwrap_or(outside_m),
            height_m: section.mid_height_m,
        }
    }
}
