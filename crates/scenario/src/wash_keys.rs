//! The rows of `[wash]` in the table of keys.

use crate::key::Domain::{Bool, Integer, Number, NumberAbove, Range, Word};
use crate::key::{Key, key};
use platewash_workcell::job::PatternName;

/// The keys of `[wash]`, in the order of the reference.
pub(crate) const WASH_KEYS: &[Key] = &[
    key(
        "wash.points",
        "",
        Integer(2, 100_000),
        "Waypoints of the paper's spiral.",
    ),
    key(
        "wash.pattern",
        "",
        Word(&PatternName::NAMES),
        "Kind of the wash path (certified): a spiral, or rings joined by blends. Without it, a spiral where turns, path_radius_m or \
         closing_ring is stated, otherwise the planner chooses.",
    ),
    key(
        "wash.turns",
        "",
        NumberAbove(0.0, 1000.0),
        "Turns of the spiral, from 0.25 to 200 in a certified job; or rings but the last, a whole number from 1 to 99. Without it, 3 in \
         the paper's program; in a certified job the planner chooses.",
    ),
    key(
        "wash.path_radius_m",
        "m",
        NumberAbove(0.0, 10.0),
        "Outer radius of the wash path, on a plate with a profile along the face; in a certified job at least 0.0001, and \
         π · path_radius_m · (turns + 2) at most 100 m. Without it, 0.145 in the paper's program; in a certified job the planner chooses.",
    ),
    key(
        "wash.height_m",
        "m",
        Number(0.0, 1.0),
        "Height of the tip above the washing surface.",
    ),
    key(
        "wash.closing_ring",
        "",
        Bool,
        "Whether a full circle at the outer radius follows the spiral; rings always end with one. Without it, none in the paper's \
         program; in a certified job the planner chooses.",
    ),
    key(
        "wash.clearance_m",
        "m",
        Number(0.0, 1.0),
        "Least clearance that counts as free; at 0 only contact is a violation. In a certified job the planner keeps 0.5 mm more \
         while washing, and 1 mm more at home, on the lines over plates and between them, because it looks in steps.",
    ),
    key(
        "wash.tilt_max_deg",
        "deg",
        Number(0.0, 60.0),
        "Largest angle of the tool from the plate's normal at a plate (certified), and never above atan(sponge_height_m / sponge_radius_m).",
    ),
    key(
        "wash.tilt_deg",
        "deg",
        Number(0.0, 60.0),
        "Largest angle of the tool from the plate's normal that is planned (certified): at most tilt_max_deg, which is what is judged. \
         Without it, the planner chooses.",
    ),
    key(
        "wash.axis_share",
        "",
        Number(0.0, 1.0),
        "Slope of the sponge's axis as a share of the slope of the face below it (certified): 0 keeps it along the plate's axis, 1 along \
         the normal. Without it, 0.5.",
    ),
    key(
        "wash.speed_m_s",
        "m/s",
        NumberAbove(0.0, 10.0),
        "Largest speed of the tip while it washes, and of the sponge's rim where it touches before and after (certified); at least 0.000001.",
    ),
    key(
        "wash.acceleration_m_s2",
        "m/s²",
        NumberAbove(0.0, 1000.0),
        "Largest acceleration of the tip while it washes (certified); at least 0.000001.",
    ),
    key(
        "wash.lift_m",
        "m",
        NumberAbove(0.0, 1.0),
        "How far the tip approaches and retreats along the plate's normal (certified): more than clearance_m and 1 mm, so that a \
         tilted sponge too is clear of the plate.",
    ),
    key(
        "wash.landing_speed_m_s",
        "m/s",
        NumberAbove(0.0, 10.0),
        "Largest speed at which the free sponge meets a plate (certified); at least 0.000001. Without it, 0.05 where contact is true, \
         otherwise speed_m_s.",
    ),
    key(
        "wash.lifting_speed_m_s",
        "m/s",
        NumberAbove(0.0, 10.0),
        "Largest speed at which the sponge leaves a plate (certified); at least 0.000001. Without it, 0.05 where contact is true, \
         otherwise speed_m_s.",
    ),
    key(
        "wash.wrist_min_deg",
        "deg",
        Number(0.0, 90.0),
        "How far joint 5 keeps from 0, on one side, from approach to retreat (certified), so that the wrist does not flip. Without it, 3 \
         where contact is true, otherwise nothing is asked of it.",
    ),
    key(
        "wash.contact",
        "",
        Bool,
        "Whether the contact of sponge and plate is to be proved (certified): how much of a face is pressed, for how long, how hard. The \
         keys contact_… below say how much; each has a default.",
    ),
    key(
        "wash.contact_compression_m",
        "m",
        Number(0.0, 1.0),
        "The least compression of the sponge that counts as contact. Without it, 0.001 where contact is true.",
    ),
    key(
        "wash.contact_height_error_m",
        "m",
        Number(0.0, 1.0),
        "How much higher or lower than stated a plate may lie: an assumption. Without it, 0.001 where contact is true.",
    ),
    key(
        "wash.contact_share",
        "",
        Number(0.0, 1.0),
        "Least share of a face's area that comes into contact, wherever within the height error the plate lies. Without it, 0.995 where \
         contact is true.",
    ),
    key(
        "wash.contact_strain",
        "",
        NumberAbove(0.0, 1.0),
        "Greatest strain of the sponge anywhere: compression over free height; a sponge pressed further bottoms out. Without it, 0.6 \
         where contact is true.",
    ),
    key(
        "wash.contact_force_n",
        "N",
        Range(0.0, 1e6),
        "Least and greatest force along the sponge's axis while it washes, for every stiffness in its range. Without it, [1, 40] where contact is true.",
    ),
    key(
        "wash.contact_time_s",
        "s",
        Number(0.0, 1e6),
        "Least time in contact, on contact_time_share. Without it, 0.1 where contact is true.",
    ),
    key(
        "wash.contact_time_share",
        "",
        Number(0.0, 1.0),
        "Share of a face's area that is in contact for contact_time_s. Without it, 0.99 where contact is true.",
    ),
    key(
        "wash.contact_dose_pa_m",
        "Pa·m",
        Number(0.0, 1e9),
        "Least dose ∫ p dl of pressure over sliding distance in contact, of the softest sponge, on contact_dose_share. Without it, 50 \
         where contact is true.",
    ),
    key(
        "wash.contact_dose_share",
        "",
        Number(0.0, 1.0),
        "Share of a face's area that gets contact_dose_pa_m. Without it, 0.99 where contact is true.",
    ),
];
