//! The tool's mass against the arm's rated payload.

use crate::simulate::rounding::rounded_for_display;
use platewash_kinematics::RobotModel;
use platewash_kinematics::irb120::IRB120_URDF;
use platewash_kinematics::words::distinct_decimals;
use platewash_workcell::tool::Tool;
use serde::Serialize;

/// Rated payload of the ABB IRB 120 \[kg\] (ABB's data sheet).
pub const IRB120_PAYLOAD_KG: f64 = 3.0;

/// Verdict on the weight of the tool for the arm.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PayloadVerdict {
    /// The tool weighs no more than the rated payload.
    Within,
    /// The tool weighs more.
    Exceeded,
    /// No payload is known for this arm, and none is stated.
    Unknown,
}

/// The tool's mass against the arm's rated payload.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PayloadCheck {
    /// Mass of the tool \[kg\].
    pub tool_kg: f64,
    /// Rated payload \[kg\], where known.
    pub rated_kg: Option<f64>,
    /// Verdict.
    pub verdict: PayloadVerdict,
}

impl PayloadCheck {
    /// A tool on an arm: against the payload that is stated \[kg\], otherwise 3 kg for the built-in IRB 120.
    #[must_use]
    pub fn new(tool: &Tool, payload_kg: Option<f64>, robot: &RobotModel) -> Self {
        let is_built_in = robot.sha256() == platewash_kinematics::sha256_hex(IRB120_URDF.as_bytes());
        let built_in = is_built_in.then_some(IRB120_PAYLOAD_KG);
        let rated_kg = payload_kg.or(built_in);
        let tool_kg = tool.mass.map_or(0.0, |mass| mass.mass_kg);
        let verdict = match rated_kg {
            Some(rated) if tool_kg <= rated => PayloadVerdict::Within,
            Some(_) => PayloadVerdict::Exceeded,
            None => PayloadVerdict::Unknown,
        };
        Self {
            tool_kg,
            rated_kg,
            verdict,
        }
    }

    /// Says in words that the tool is too heavy: `tool 5 kg, rated 3 kg`; `None` where it is not, or no payload is known.
    #[must_use]
    pub fn overload(&self) -> Option<String> {
        let rated_kg = self.rated_kg.filter(|_| self.verdict == PayloadVerdict::Exceeded)?;
        let mut told = [self.tool_kg, rated_kg].map(|mass| rounded_for_display(mass).to_string());
        if told[0] == told[1] {
            told = distinct_decimals(self.tool_kg, rated_kg, 0);
        }
        let [tool, rated] = told;
        Some(format!("tool {tool} kg, rated {rated} kg"))
    }
}
