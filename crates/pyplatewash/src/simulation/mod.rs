//! A plan under a control law: settings, execution, report, and many settings.

mod execution;
mod question;
mod settings;
mod tuning;

pub use execution::{Done, ExecutionObject, simulate};
pub use question::Question;
pub use settings::SettingsObject;
pub use tuning::tune;
