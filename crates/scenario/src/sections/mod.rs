//! The sections of a scenario file: their keys with unit, range, default and meaning.
//!
//! | section | module |
//! | --- | --- |
//! | `[robot]`, `[[reduced_clearance]]` | `robot` |
//! | `[tool]`, `[[tool_body]]` | `tool` |
//! | `[layout]`, `[[plate]]` | `layout` |
//! | `[floor]`, `[table]`; `[[obstacle]]` | `room`; `obstacle` |
//! | `[wash]` | `wash` |
//! | `[holder]` | `holder` |
//! | `[ik]`, `[transition]`, `[limits]`, `[job]` | `motion` |
//! | `[control]`, `[plant]` | `simulation` |
//! | shapes of bodies, in several sections | `body_shape` |

pub(crate) mod body_shape;
pub(crate) mod holder;
pub(crate) mod layout;
pub(crate) mod motion;
pub(crate) mod obstacle;
pub(crate) mod robot;
pub(crate) mod room;
pub(crate) mod simulation;
pub(crate) mod tool;
pub(crate) mod wash;
