//! The certificate and its texts.
//!
//! | concept | module |
//! | --- | --- |
//! | what is required | `requirement` |
//! | what came of one requirement; units | `check`; `unit` |
//! | the requirement, its formula and whose its limit is, for readers | `explanation` |
//! | all of it; places in the world frame | `certificate` |
//! | the first line, with what is laxer than usual | `headline` |
//! | the table | `table` |
//! | what the verdict rests on | `verdict_basis` |
//! | numbers and plates in words | `words` |

pub(crate) mod certificate;
pub(crate) mod check;
pub(crate) mod explanation;
pub(crate) mod headline;
pub(crate) mod requirement;
pub(crate) mod table;
pub(crate) mod unit;
pub(crate) mod verdict_basis;
pub(crate) mod words;
