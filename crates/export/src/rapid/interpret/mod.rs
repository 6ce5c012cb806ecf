//! What a program does: its procedures are run, and each motion is written down instead of made.
//!
//! Numbers are IEEE singles, as on the controller. Whatever would change when or where the arm moves in a way that is not modelled here
//! is refused by name and line.

mod argument;
mod assumed_start;
mod built_in;
mod call;
mod expression;
mod flow;
mod function;
mod instruction;
mod joints;
mod machine;
mod motion;
mod moved;
mod operator;
mod place;
mod predefined;
mod program;
mod run;
mod share;
mod statement;
mod store;
mod tool;
mod types;
mod unmodelled;
mod value;

pub use built_in::is_taken;
pub use predefined::zone_named;
pub use run::run;
pub use share::SHARE;
pub use tool::LEAST_KG;
