//! Numbers on the command line: seeds, amounts, angles in degrees or radians.

use super::input_file::text;
use anyhow::{Context, Result, anyhow, bail, ensure};
use clap::Args;
use platewash::JointVector;
use platewash::kinematics::AXES;
use platewash::workcell::job::MAX_SEED;
use std::ops::RangeBounds;
use std::path::{Path, PathBuf};

/// Longest file of configurations that is read \[bytes\].
const MAX_BYTES: u64 = 64 << 20;

/// Most configurations that are read: seconds of work.
const MAX_CONFIGURATIONS: usize = 100_000;

/// Largest joint position that is taken, either way, as of a scenario's `robot.start_deg` \[°\].
const MOST_DEG: f64 = 36_000.0;

/// Largest number of a pose that is taken, either way \[m, rad, °\].
const MOST_COORDINATE: f64 = 36_000.0;

/// A seed as a scenario may state one.
pub fn seed(text: &str) -> Result<u64> {
    let expected = || format!("must be a whole number from 0 to {MAX_SEED} (2^53 − 1)");
    let seed = text.parse().with_context(expected)?;
    ensure!(seed <= MAX_SEED, expected());
    Ok(seed)
}

/// A number in a range, or what is expected.
pub fn within(text: &str, range: impl RangeBounds<f64>, expected: &str) -> Result<f64> {
    let number = text.trim().parse().with_context(|| expected.to_owned())?;
    ensure!(range.contains(&number), "{expected}");
    Ok(number)
}

/// A finite number above 0.
pub fn positive(text: &str) -> Result<f64> {
    within(text, f64::MIN_POSITIVE..=f64::MAX, "must be a finite number above 0")
}

/// A number of a pose.
pub fn coordinate(text: &str) -> Result<f64> {
    within(
        text,
        -MOST_COORDINATE..=MOST_COORDINATE,
        &format!("must be a number from -{MOST_COORDINATE} to {MOST_COORDINATE}"),
    )
}

/// As many finite numbers as asked, between commas.
pub fn between_commas<const N: usize>(text: &str) -> Result<[f64; N]> {
    let all: Result<Vec<f64>, _> = text.split(',').map(|number| number.trim().parse()).collect();
    let all = all.map_err(|_| anyhow!("expected {N} numbers between commas"))?;
    ensure!(
        all.iter().all(|number| number.is_finite()),
        "the numbers must be finite"
    );
    <[f64; N]>::try_from(all).map_err(|all| anyhow!("expected {N} numbers between commas; found {}", all.len()))
}

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
    deg: Option<Vec<f64>>,
    /// Joint positions in radians (with --file, no values: the file's unit)
    #[arg(long, num_args = 0..=6, allow_negative_numbers = true, value_name = "Q")]
    rad: Option<Vec<f64>>,
}

impl JointArguments {
    /// The configurations asked for \[rad\].
    pub fn configurations(&self, file: Option<&PathBuf>) -> Result<Vec<JointVector>> {
        let (unit, given) = match (&self.deg, &self.rad) {
            (Some(given), _) => (Unit::Degrees, given),
            (None, Some(given)) => (Unit::Radians, given),
            (None, None) => bail!("give --deg or --rad"),
        };
        match file {
            Some(_) if !given.is_empty() => bail!("give joint positions or --file, not both"),
            Some(file) => read(file, unit),
            None => Ok(vec![joints(given, unit).context("joint positions")?]),
        }
    }
}

/// Six joint positions.
pub fn joints(values: &[f64], unit: Unit) -> Result<JointVector> {
    let six = <[f64; AXES]>::try_from(values).map_err(|_| anyhow!("six numbers are needed; found {}", values.len()))?;
    let positions = JointVector::from(six).map(|angle| unit.to_radians(angle));
    let is_taken = |rad: &f64| (0.0..=MOST_DEG.to_radians()).contains(&rad.abs());
    if let Some(joint) = positions.iter().position(|rad| !is_taken(rad)) {
        bail!(
            "joint {} must be from -{MOST_DEG} to {MOST_DEG} degrees; found {:?}{}",
            joint + 1,
            six[joint],
            unit.symbol()
        );
    }
    Ok(positions)
}

/// A file with six numbers a line, separated by blanks or commas; empty lines and lines from `#` on are skipped.
fn read(file: &Path, unit: Unit) -> Result<Vec<JointVector>> {
    let name = file.display();
    let text = text(file, MAX_BYTES)?;
    let mut all = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let at = || format!("{name}, line {}", index + 1);
        let content = line.split('#').next().unwrap_or_default();
        let words = content
            .split(|c: char| c.is_whitespace() || c == ',')
            .filter(|w| !w.is_empty());
        let values = words.map(|w| w.parse().map_err(|_| anyhow!("'{w}' is not a number")));
        let values = values.collect::<Result<Vec<f64>>>().with_context(at)?;
        if !values.is_empty() {
            all.push(joints(&values, unit).with_context(at)?);
        }
        if all.len() > MAX_CONFIGURATIONS {
            return Err(anyhow!("more than {MAX_CONFIGURATIONS} configurations; split the file")).with_context(at);
        }
    }
    ensure!(
        !all.is_empty(),
        "{name}: has no configuration: write six numbers a line"
    );
    Ok(all)
}
