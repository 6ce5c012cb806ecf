//! Closed form of arms whose axes 2, 3 and 4 are parallel and whose axes 5 and 6 meet.
//!
//! | concept | file |
//! | --- | --- |
//! | the arm: its equations, branch by branch, and its recognition | `arm` |
//! | its branches side by side in the lanes of vectors | `branch_lanes` |
//! | both as a closed form | `form` |

pub(crate) mod arm;
mod branch_lanes;
mod form;
