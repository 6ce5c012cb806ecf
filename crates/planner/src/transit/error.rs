//! Why there is no transit.

use crate::joint_path::JointPathError;
use crate::timing::TimingError;
use crate::transit::shortfall::ClearanceShortfall;
use platewash_kinematics::LimitViolation;
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::words::plate_name;

/// Reason that there is no transit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TransitError {
    /// No free transit was found.
    #[error(
        "no free transit from {} to {} was found: direct, raised, arc and {nodes} sampled configurations all fail{}",
        name(.from), name(.to), first(.blocked.as_deref())
    )]
    NotFound {
        /// The plate it leaves; `None` for home.
        from: Option<usize>,
        /// The plate it leads to; `None` for home.
        to: Option<usize>,
        /// Configurations sampled.
        nodes: usize,
        /// Obstruction at which the first of the direct candidates ends.
        blocked: Option<Box<TransitObstruction>>,
    },
    /// The line over a plate is not free.
    #[error("the line over {} is not clear at {height_m:.3} m{}", plate_name(*.plate), line(.too_near.as_deref()))]
    Line {
        /// The plate.
        plate: usize,
        /// Height on the line \[m\].
        height_m: f64,
        /// The bodies that are too near there.
        too_near: Option<Box<ClearanceShortfall>>,
    },
    /// Home is not free.
    #[error("the arm is not clear at home{}", colon(.too_near.as_deref()))]
    Home {
        /// The bodies that are too near there.
        too_near: Option<Box<ClearanceShortfall>>,
    },
    /// A path that cannot be splined.
    #[error(transparent)]
    Path(#[from] JointPathError),
    /// A path that cannot be timed.
    #[error(transparent)]
    Timing(#[from] TimingError),
    /// The search was given up.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Obstruction that ends a direct transit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TransitObstruction {
    /// A joint would be beyond its limit.
    #[error("{0}")]
    Limit(LimitViolation),
    /// Two bodies would be too near.
    #[error("{0}")]
    TooNear(ClearanceShortfall),
}

impl TransitError {
    /// Returns true where no transit exists or none was found, as opposed to numbers with which none can be computed.
    #[must_use]
    pub fn is_infeasible(&self) -> bool {
        matches!(self, Self::NotFound { .. } | Self::Line { .. } | Self::Home { .. })
    }
}

fn name(end: &Option<usize>) -> String {
    end.map_or_else(|| "home".to_owned(), plate_name)
}

fn first(blocked: Option<&TransitObstruction>) -> String {
    blocked.map_or_else(String::new, |blocked| format!("; on the direct one {blocked}"))
}

fn colon(too_near: Option<&ClearanceShortfall>) -> String {
    too_near.map_or_else(String::new, |too_near| format!(": {too_near}"))
}

/// Words on a line, with a hint where the lift decides: at the top of the line the sponge must be clear of the plates.
fn line(too_near: Option<&ClearanceShortfall>) -> String {
    let touches = |too_near: &&ClearanceShortfall| {
        let names = [&too_near.pair.a, &too_near.pair.b];
        names.iter().any(|n| *n == "sponge") && names.iter().any(|n| n.starts_with("plate "))
    };
    let hint = too_near.filter(touches).map_or(
        "",
        |_| "; at its top a tilted sponge must be as far off, too: lift it higher",
    );
    colon(too_near) + hint
}
