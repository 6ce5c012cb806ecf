//! Closed form of arms with a spherical wrist and parallel axes 2 and 3.
//!
//! | concept | file |
//! | --- | --- |
//! | the arm: its equations, branch by branch, and its recognition | `arm` |
//! | its branches side by side in the lanes of vectors | `branch_lanes` |
//! | both as a closed form | `form` |

pub(crate) mod arm;
mod branch_lanes;
mod form;
