//! A job: plates, workcell, and requirements of the washing. It is resolved: every number is stated; no defaults and no file references are
//! left.
//!
//! | concept | module |
//! | --- | --- |
//! | the terms: everything about a job but the arm; in the frame of the base | `terms` |
//! | kinds of plans, and the statements that each may make | `kind` |
//! | requirements and limits | `requirements` |
//! | settings of the planner | `planner_settings` |
//! | what is left to do after a stop; its jobs | `recovery`; `recovery_terms` |
//! | shapes of plates that were measured | `measured_shape` |
//! | kinds of soil; the requirements of each plate | `soil`; `plate_requirements` |
//! | validity of the terms | `validity`, `ranges` |
//! | errors | `error` |

mod error;
mod kind;
mod measured_shape;
mod planner_settings;
mod plate_requirements;
mod ranges;
mod recovery;
mod recovery_terms;
mod requirements;
mod soil;
mod terms;
mod validity;

pub use crate::job::error::TermsError;
pub use crate::job::kind::{PlanKind, Statement, StatementRule};
pub use crate::job::measured_shape::{MeasuredShape, Relief};
pub use crate::job::planner_settings::{OrderRule, Planner, PlannerSettings, ReachBorders};
pub use crate::job::recovery::{NEARER_M, RETREAT_M_S, Recovery, RecoveryPart, RetreatLine};
pub use crate::job::requirements::{
    CONTACT_SPEED_M_S, ContactRequirements, ContactThresholds, FixtureTerms, HolderTerms, LINE_TOLERANCE_M, Limits,
    Overlap, PATH_TOLERANCE_M, Requirements, RingTerms, Treatment, WRIST_DEG,
};
pub use crate::job::soil::Soil;
pub use crate::job::terms::{JobTerms, MAX_SEED};
pub use crate::job::validity::check_workcell;
