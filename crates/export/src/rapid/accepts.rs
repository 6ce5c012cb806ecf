//! Jobs that can be handed to an ABB controller: the make of the arm, and the load that it may carry.

use crate::rapid::parse::LEAST_KG;
use crate::refusal::Refusal;
use crate::tool_frame;
use nalgebra::Matrix2;
use platewash_kinematics::irb120::IRB120_URDF;
use platewash_kinematics::words::distinct_decimals;
use platewash_kinematics::{RobotModel, sha256_hex};
use platewash_workcell::job::JobTerms;
use platewash_workcell::tool::ToolMass;

/// Rated payload of the IRB 120 \[kg\] (product specification 3HAC035960).
const PAYLOAD_KG: f64 = 3.0;
/// Distance from the centre of its joint 5 to the flange \[m\].
const JOINT_5_TO_FLANGE_M: f64 = 0.072;
/// Largest inertia of a load about its joint 5 \[kg·m²\].
const JOINT_5_KG_M2: f64 = 0.175;
/// Largest inertia of a load about its joint 6 \[kg·m²\].
const JOINT_6_KG_M2: f64 = 0.085;
/// Least distance of a centre of mass from the flange \[m\]: a tenth of the last digit that is written.
const LEAST_COM_M: f64 = 1e-6;

/// Refuses a job that an ABB controller would not take.
pub fn accepts(job: &JobTerms, arm: &RobotModel) -> Result<(), Refusal> {
    let is_built_in = arm.sha256() == sha256_hex(IRB120_URDF.as_bytes());
    if !is_built_in && !arm.name().to_lowercase().starts_with("abb") {
        return Err(Refusal::Arm {
            dialect: "RAPID",
            expected: "arms of ABB, whose URDF has a name that begins with \"abb\"",
            found: arm.name().to_owned(),
        });
    }
    tool_frame::check_mount(&job.workcell.tool, arm)?;
    let Some(mass) = &job.workcell.tool.mass else {
        return load(
            "the tool has no mass, and a controller takes none without: state its mass in the scenario, and plan again",
        );
    };
    check_mass(mass)?;
    let stated_kg = job.simulation.payload_kg;
    let weighs = |rated_kg| {
        let unit = "kg, the arm's rated payload is";
        within("the tool weighs", mass.mass_kg, rated_kg, unit)
    };
    if !is_built_in {
        return stated_kg.map_or(Ok(()), weighs);
    }
    weighs(stated_kg.map_or(PAYLOAD_KG, |stated_kg| stated_kg.min(PAYLOAD_KG)))?;
    let [about_5, about_6] = inertias_kg_m2(mass);
    for (joint, found, most) in [(5, about_5, JOINT_5_KG_M2), (6, about_6, JOINT_6_KG_M2)] {
        let what = format!("the tool's inertia about joint {joint} is");
        within(&what, found, most, "kg·m², allowed are")?;
    }
    Ok(())
}

fn check_mass(mass: &ToolMass) -> Result<(), Refusal> {
    let mut numbers = [mass.mass_kg].into_iter().chain(mass.com_m).chain(mass.inertia_kg_m2);
    if !numbers.all(f64::is_finite) {
        return load(
            "the tool's mass, centre of mass and inertia must be finite: state them in the scenario, and plan again",
        );
    }
    let (mass_kg, com_m) = (mass.mass_kg, &mass.com_m);
    if mass_kg < LEAST_KG {
        return load(&format!(
            "the tool weighs {mass_kg} kg, a controller takes {LEAST_KG} kg or more: state its mass in the scenario, and plan again"
        ));
    }
    if com_m.iter().all(|coordinate| coordinate.abs() < LEAST_COM_M) {
        return load(
            "the tool's centre of mass is at the flange's origin, which a controller refuses: state where it is in the scenario, and \
             plan again",
        );
    }
    Ok(())
}

/// Inertia of a load about joints 5 and 6 of the IRB 120 \[kg·m²\], at the worst turn of joint 6:
/// `m ((Z + 0.072)² + L²) + max J0` and `m L² + J0z`, the centre of mass at `Z` along the flange's axis and `L` beside it.
fn inertias_kg_m2(mass: &ToolMass) -> [f64; 2] {
    let [x, y, z] = mass.com_m;
    let [ixx, ixy, _, iyy, _, izz] = mass.inertia_kg_m2;
    let beside = x * x + y * y;
    let along = z + JOINT_5_TO_FLANGE_M;
    let across = Matrix2::new(ixx, ixy, ixy, iyy).symmetric_eigenvalues().max();
    let about_5 = mass.mass_kg * (along * along + beside) + across;
    [about_5, mass.mass_kg * beside + izz]
}

fn within(what: &str, found: f64, most: f64, unit: &str) -> Result<(), Refusal> {
    if found <= most {
        return Ok(());
    }
    let [found, most] = distinct_decimals(found, most, 3);
    load(&format!("{what} {found} {unit} {most}: take a lighter or shorter tool"))
}

fn load(reason: &str) -> Result<(), Refusal> {
    Err(Refusal::Load(reason.to_owned()))
}
