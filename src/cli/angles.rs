//! Angles on the command line: degrees or radians, always said which.

use super::failure::Failure;
use anyhow::{Context, anyhow};
use clap::Args;
use platewash::JointVector;
use platewash::kinematics::AXES;
use platewash::kinematics::urdf::file::read_text;
use std::path::{Path, PathBuf};

/// Longest file of configurations that is read \[bytes\].
const MAX_BYTES: u64 = 64 << 20;

/// Most configurations that are read: seconds of work.
const MAX_CONFIGURATIONS: usize = 100_000;

/// The unit in which angles are given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    Degrees,
    Radians,
}

impl Unit {
    /// An angle in this unit, in radians.
    pub fn to_radians(self, angle: f64) -> f64 {
        match self {
            Self::Degrees => angle.to_radians(),
            Self::Radians => angle,
        }
    }

    fn symbol(self) -> &'static str {
        match self {
            Self::Degrees => "°",
            Self::Radians => " rad",
        }
    }
}

/// Joint positions: six numbers, or a file of many.
#[derive(Debug, Args)]
#[group(required = true, multiple = false)]
pub struct JointArguments {
    /// Joint positions in degrees (with --file, no values: the file's unit)
    #[arg(long, num_args = 0..=6, allow_negative_numbers = true, value_name = "Q")]
    pub deg: Option<Vec<f64>>,
    /// Joint positions in radians (with --file, no values: the file's unit)
    #[arg(long, num_args = 0..=6, allow_negative_numbers = true, value_name = "Q")]
    pub rad: Option<Vec<f64>>,
}

impl JointArguments {
    /// The configurations asked for \[rad\].
    pub fn configurations(&self, file: Option<&PathBuf>) -> Result<Vec<JointVector>, Failure> {
        let (unit, given) = match (&self.deg, &self.rad) {
            (Some(given), _) => (Unit::Degrees, given),
            (None, Some(given)) => (Unit::Radians, given),
            (None, None) => return Err(Failure::input(anyhow!("give --deg or --rad"))),
        };
        match file {
            Some(_) if !given.is_empty() => Err(Failure::input(anyhow!("give joint positions or --file, not both"))),
            Some(file) => read(file, unit).map_err(Failure::input),
            None => Ok(vec![
                joints(given, unit).context("joint positions").map_err(Failure::input)?,
            ]),
        }
    }
}

/// Largest joint position that is taken, either way, as of a scenario's `robot.start_deg` \[°\].
const MOST_DEG: f64 = 36_000.0;

/// Six joint positions.
pub fn joints(values: &[f64], unit: Unit) -> anyhow::Result<JointVector> {
    let six = <[f64; AXES]>::try_from(values).map_err(|_| anyhow!("six numbers are needed; found {}", values.len()))?;
    let positions = JointVector::from(six).map(|angle| unit.to_radians(angle));
    match positions
        .iter()
        .position(|rad| !(0.0..=MOST_DEG.to_radians()).contains(&rad.abs()))
    {
        Some(joint) => Err(anyhow!(
            "joint {} must be from -{MOST_DEG} to {MOST_DEG} degrees; found {:?}{}",
            joint + 1,
            six[joint],
            unit.symbol()
        )),
        None => Ok(positions),
    }
}

/// A file with six numbers a line, separated by blanks or commas; empty lines and lines from `#` on are skipped.
fn read(file: &Path, unit: Unit) -> anyhow::Result<Vec<JointVector>> {
    let name = file.display();
    let text = read_text(file, MAX_BYTES).with_context(|| format!("{name}: cannot be read"))?;
    let mut all = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let at = || format!("{name}, line {}", index + 1);
        let content = line.split('#').next().unwrap_or_default();
        let words = content
            .split(|c: char| c.is_whitespace() || c == ',')
            .filter(|w| !w.is_empty());
        let values = words.map(|w| w.parse().map_err(|_| anyhow!("'{w}' is not a number")));
        let values = values.collect::<anyhow::Result<Vec<f64>>>().with_context(at)?;
        if !values.is_empty() {
            all.push(joints(&values, unit).with_context(at)?);
        }
        if all.len() > MAX_CONFIGURATIONS {
            return Err(anyhow!("more than {MAX_CONFIGURATIONS} configurations; split the file")).with_context(at);
        }
    }
    if all.is_empty() {
        return Err(anyhow!("{name}: has no configuration: write six numbers a line"));
    }
    Ok(all)
}
