//! How a plan is handed over, and these settings as lines of a program's head, so that it can be made again and compared.

use crate::dialect::language::Dialect;
use crate::joint_3::Joint3;
use crate::maker_joints;
use crate::program::ProgramFile;
use crate::refusal::Refusal;
use platewash_certificate::Requirement;
use platewash_kinematics::{JointVector, Pose, RobotModel};

/// The shortest tolerance that rounding leaves room for \[m\].
const LEAST_TOLERANCE_M: f64 = 2e-5;

/// Largest tolerance \[m\]: a motion farther off is no longer the plan.
const GREATEST_TOLERANCE_M: f64 = 2e-3;

/// The largest corner \[m\].
const GREATEST_CORNER_M: f64 = 0.1;

/// Settings of an export.
#[derive(Debug, Clone, PartialEq)]
pub struct ExportSettings {
    /// Largest deviation of the tip from the plan \[m\].
    pub tolerance_m: f64,
    /// Share of the plan's speed at which the program runs, above 0 and at most 1.
    pub speed_share: f64,
    /// Radius of corners at points that are not stops \[m\].
    pub corner_m: f64,
    /// Requirements whose waiving is accepted.
    pub accepted: Vec<Requirement>,
    /// Count of axis 3 by the controller, which a program in the maker's joints follows; `None` asks where the arm's is not known to be
    /// independent.
    pub joint_3: Option<Joint3>,
    /// Configuration in which the arm stands now, if it is to be compared with the start of the plan, in the joints of the program \[rad\].
    pub stands_rad: Option<JointVector>,
    /// `T_flange_tip` as the controller has it, if that is to be compared with the plan's.
    pub tip: Option<Pose>,
}

impl Default for ExportSettings {
    fn default() -> Self {
        Self {
            tolerance_m: 2e-4,
            speed_share: 1.0,
            corner_m: 5e-3,
            accepted: Vec::new(),
            joint_3: None,
            stands_rad: None,
            tip: None,
        }
    }
}

impl ExportSettings {
    /// Refuses settings that make no sense for a program of a dialect for an arm.
    ///
    /// # Errors
    /// [`Refusal::Setting`], naming the first; [`Refusal::Joint3`].
    pub(crate) fn check(&self, dialect: &dyn Dialect, arm: &RobotModel) -> Result<(), Refusal> {
        maker_joints::check(dialect, arm, self.joint_3)?;
        let own = [
            (
                "tolerance_m",
                self.tolerance_m,
                [LEAST_TOLERANCE_M, GREATEST_TOLERANCE_M],
            ),
            ("speed_share", self.speed_share, [1e-3, 1.0]),
            ("corner_m", self.corner_m, [0.0, GREATEST_CORNER_M]),
        ];
        let stands = self.stands_rad.iter().flatten();
        let mut all = own.into_iter().chain(stands.map(|q| ("stands_rad", *q, [-1e3, 1e3])));
        let Some((name, found, [least, most])) = all.find(|(_, found, [least, most])| !(least..=most).contains(&found))
        else {
            return Ok(());
        };
        let unit = if name.ends_with("_m") { " metres" } else { "" };
        Err(Refusal::Setting {
            name,
            expected: format!("from {least} to {most}{unit}"),
            found: found.to_string(),
        })
    }

    /// The settings that shape the text, a line each.
    pub(crate) fn lines(&self) -> Vec<String> {
        let accepted: Vec<_> = self.accepted.iter().map(|requirement| requirement.name()).collect();
        let mut lines = vec![
            format!("{SETTING} tolerance_m = {}", self.tolerance_m),
            format!("{SETTING} speed_share = {}", self.speed_share),
            format!("{SETTING} corner_m = {}", self.corner_m),
        ];
        if !accepted.is_empty() {
            lines.push(format!("{SETTING} accepted = {}", accepted.join(",")));
        }
        lines.extend(
            self.joint_3
                .map(|count| format!("{SETTING} joint_3 = {}", count.name())),
        );
        lines
    }

    /// Reads the settings of files from such lines, with any text before them; settings that it does not state are taken from
    /// `otherwise`. `None` where a line cannot be read.
    pub(crate) fn stated(files: &[ProgramFile], otherwise: Self) -> Option<Self> {
        let mut settings = otherwise;
        for line in files.iter().flat_map(|file| file.text.lines()) {
            let Some((_, statement)) = line.split_once(SETTING) else {
                continue;
            };
            let (name, value) = statement.split_once('=')?;
            let value = value.trim();
            let number = || value.parse().ok();
            match name.trim() {
                "tolerance_m" => settings.tolerance_m = number()?,
                "speed_share" => settings.speed_share = number()?,
                "corner_m" => settings.corner_m = number()?,
                "joint_3" => settings.joint_3 = Some(Joint3::named(value)?),
                "accepted" => settings.accepted = value.split(',').map(Requirement::named).collect::<Option<_>>()?,
                _ => return None,
            }
        }
        Some(settings)
    }
}

/// Prefix of a line that states a setting.
const SETTING: &str = "platewash setting:";
