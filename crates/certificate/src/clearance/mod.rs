//! Clearance of every pair of bodies over the whole motion.
//!
//! | concept | module |
//! | --- | --- |
//! | every pair, with what each must keep | `pairs` |
//! | pairs that need not keep clear | `exclusions` |
//! | one pair: branch and bound over time | `search` |
//! | obstacles that are far from a part all the time | `far` |
//! | poses of the arm at the moments looked at | `poses` |
//! | the rule at a single moment, for a viewer | `moments` |

pub(crate) mod exclusions;
pub(crate) mod far;
pub(crate) mod moments;
pub(crate) mod pairs;
pub(crate) mod poses;
pub(crate) mod search;
