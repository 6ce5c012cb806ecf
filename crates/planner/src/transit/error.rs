//! Why there is no transit.

use super::too_near::TooNear;
use crate::joint_path::JointPathError;
use crate::timing::TimingError;
use platewash_kinematics::LimitViolation;
use platewash_workcell::cancel::Cancelled;
use std::fmt;

/// Why there is no transit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TransitError {
    /// None that is free was found.
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
        /// Where the first of the direct ones ends.
        blocked: Option<Box<Blocked>>,
    },
    /// The line over a plate is not free.
    #[error("the line over plate {plate} is not clear at {height_m:.3} m{}", line(.too_near.as_deref()))]
    Line {
        /// The plate.
        plate: usize,
        /// Height on the line \[m\].
        height_m: f64,
        /// The bodies that are too near there.
        too_near: Option<Box<TooNear>>,
    },
    /// Home is not free.
    #[error("the arm is not clear at home{}", colon(.too_near.as_deref()))]
    Home {
        /// The bodies that are too near there.
        too_near: Option<Box<TooNear>>,
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

/// What ends a direct transit.
#[derive(Debug, Clone, PartialEq)]
pub enum Blocked {
    /// A joint would be beyond its limit.
    Limit(LimitViolation),
    /// Two bodies would be too near.
    TooNear(TooNear),
}

impl TransitError {
    /// Whether there is none, as opposed to numbers with which none can be computed.
    #[must_use]
    pub fn is_infeasible(&self) -> bool {
        matches!(self, Self::NotFound { .. } | Self::Line { .. } | Self::Home { .. })
    }
}

impl fmt::Display for Blocked {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Limit(violation) => violation.fmt(f),
            Self::TooNear(too_near) => too_near.fmt(f),
        }
    }
}

fn name(end: &Option<usize>) -> String {
    end.map_or_else(|| "home".to_owned(), |plate| format!("plate {plate}"))
}

fn first(blocked: Option<&Blocked>) -> String {
    blocked.map_or_else(String::new, |blocked| format!("; on the direct one {blocked}"))
}

fn colon(too_near: Option<&TooNear>) -> String {
    too_near.map_or_else(String::new, |too_near| format!(": {too_near}"))
}

/// With a hint where it is the lift that decides: at the top of the line the sponge must be clear of the plates.
fn line(too_near: Option<&TooNear>) -> String {
    let touches = |too_near: &&TooNear| {
        let names = [&too_near.pair.a, &too_near.pair.b];
        names.iter().any(|n| *n == "sponge") && names.iter().any(|n| n.starts_with("plate "))
    };
    let hint = too_near.filter(touches).map_or(
        "",
        |_| "; at its top a tilted sponge must be as far off, too: lift it higher",
    );
    colon(too_near) + hint
}
