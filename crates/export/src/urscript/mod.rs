//! URScript, the language of Universal Robots' controllers: `servoj` at fixed steps.
//!
//! `servoj` rather than `movej` with times and blends: `movej` has ramps of its own between two points, and blends of neighbours must not
//! overlap, which they do where points lie as close as a plan's. `servoj` is handed a position a control cycle or some, which is also
//! how the maker's own driver follows a trajectory.
//!
//! | concept | module |
//! | --- | --- |
//! | a program's text | `write` |
//! | a program that is read | `read` |
//! | the assumed actions of the controller | `controller` |

mod controller;
mod read;
mod write;

use crate::dialect::language::{Dialect, Points};
use crate::program::{Program, ProgramFile};
use crate::reading::Reading;
use crate::refusal::Refusal;
use crate::tool_frame;
use platewash_kinematics::RobotModel;
use platewash_motion_proof::ReadError;
use platewash_workcell::job::JobTerms;

/// Time between two points \[s\]: a control cycle of the CB3 series, four of the e-Series.
const STEP_S: f64 = 0.008;

/// Ending of a program's file name.
const ENDING: &str = ".script";

/// URScript.
#[derive(Debug, Clone, Copy)]
pub struct UrScript;

impl Dialect for UrScript {
    fn name(&self) -> &'static str {
        "urscript"
    }

    fn is_in(&self, file: &ProgramFile) -> bool {
        file.ends_in(ENDING)
    }

    fn points(&self) -> Points {
        Points::Steps { step_s: STEP_S }
    }

    fn assumptions(&self) -> &'static [&'static str] {
        &[
            "Nobody has run this program on a controller of Universal Robots or in its simulator.",
            "Between two points the joints are assumed to move evenly, and to be at each point at its time. The arm really follows servoj \
             late, by about lookahead_time (0.03 s) and more at a lower gain, and rounds what bends within that time.",
            "A servoj is assumed to take its t, a multiple of the control cycle (8 ms for CB3, 2 ms for e-Series); where t is none, at \
             points of rest alone, the controller may wait up to a cycle longer.",
            "The speed slider is assumed to stand at 100 %, and no safety limit to slow the arm down: where the controller slows it, the \
             points come as fast as before, the arm falls behind them and leaves the path. For a slower run, export at another share.",
            "The controller's tool flange is assumed to be the frame that carries the plan's tool (tool0 of the arm's description, unless \
             the line of the tool names another), and its joints to have the description's order, zeros and signs.",
            "A controller is assumed to load a program of this many lines; nobody has tried how many it takes.",
        ]
    }

    fn accepts(&self, job: &JobTerms, arm: &RobotModel) -> Result<(), Refusal> {
        if !is_of_the_maker(arm.name()) {
            return Err(Refusal::Arm {
                dialect: "URScript",
                expected: "an arm of Universal Robots, whose description has a name such as ur5e or ur10_robot",
                found: arm.name().to_owned(),
            });
        }
        tool_frame::check_mount(&job.workcell.tool, arm)?;
        match &job.workcell.tool.mass {
            Some(mass) if mass.mass_kg > 0.0 && mass.mass_kg.is_finite() => Ok(()),
            Some(mass) => Err(Refusal::Load(format!(
                "set_payload needs a mass above 0; the tool has {} kg: state its mass",
                mass.mass_kg
            ))),
            None => Err(Refusal::Load(
                "set_payload needs the tool's mass, and the tool has none: state its mass and length".to_owned(),
            )),
        }
    }

    fn write(&self, program: &Program<'_>) -> Vec<ProgramFile> {
        let name = format!("{}{ENDING}", program.name);
        let text = write::text(program);
        vec![ProgramFile { name, text }]
    }

    fn read(&self, files: &[ProgramFile], _arm: &RobotModel) -> Result<Reading, ReadError> {
        read::reading(ProgramFile::only(files, "program", ENDING)?)
    }
}

/// Checks, by its name, that an arm's description is one of the maker's: `ur`, and behind it nothing, a digit or a separator.
fn is_of_the_maker(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    name.strip_prefix("ur")
        .is_some_and(|rest| rest.is_empty() || rest.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '_' | '-')))
}
