//! The tip and the sponge on the plates.
//!
//! | concept | module |
//! | --- | --- |
//! | the face of a plate: heights and normals | `face` |
//! | the tip follows its curve | `following` |
//! | how much of a plate is swept; the way of the tip as a polyline | `coverage`; `polyline` |
//! | what is known of a wash before it is judged | `wash_inputs` |
//! | how far the sponge reaches beyond the rim, and which neighbours it may touch | `reach` |
//! | how fast the sponge lands and lifts off | `contact_speed` |
//! | contact: how long, how hard, which share of a plate | `contact`, `face_shares` |
//! | what holds a plate: what it takes, and whether the plate stays | `holding` |
//! | results of it, as the certificate states them | `plate_coverage`, `plate_contact`, `holder_load` |
//! | the moments of a wash; the strain of the foam; a frame that turns with the sponge | `instants`, `pressing`, `turning_frame` |

pub(crate) mod contact;
pub(crate) mod contact_speed;
pub(crate) mod coverage;
pub(crate) mod face;
pub(crate) mod face_shares;
pub(crate) mod following;
pub(crate) mod holder_load;
pub(crate) mod holding;
pub(crate) mod instants;
pub(crate) mod plate_contact;
pub(crate) mod plate_coverage;
pub(crate) mod polyline;
pub(crate) mod pressing;
pub(crate) mod reach;
pub(crate) mod turning_frame;
pub(crate) mod wash_inputs;
