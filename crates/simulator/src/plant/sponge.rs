//! A sponge that plates push back.
//!
//! The sums are over every column of the sponge's face ([`Columns`], turning with the tool) that a plate compresses by w. With a
//! the tool's axis, n the normal and x the point where the column meets the face, dA its cross-section and g the share of it that
//! is on the plate,
//!
//! energy  g Ψ(w) dA,  force  g p(w) dA n/(−a·n) − Ψ(w) dA g′(ρ) (ρ̂ + n (ρ̂·a)/(−a·n)),
//!
//! the force at x: exactly the loss of energy with any motion of the tool ([`super::foam`] has Ψ and p). The second part is the
//! rim's: g falls from 1 to 0 over the width of a column, and foam that bulges over the rim is pushed off it. Without friction.
//!
//! The law is one of the sponge's face. Where the tool leans more than about 50° from a plate's axis its side would meet the plate; energy and
//! force then fade, to nothing at about 65°, with the moment about the tip that goes with it. No plan comes there.

use crate::dynamics::{DynamicsModel, FrameMotion, MassMatrix};
use crate::plant::foam::{DENSE_FACTOR, Foam, FoamLoad, Wrench, falling, share_within};
use crate::plant::level::LevelColumns;
use crate::plant::state::PlantState;
use nalgebra::{Matrix3, Vector3};
use platewash_bodies::contact::{Columns, Foundation, SpongePose};
use platewash_kinematics::{Frame, JointVector, RobotModel};
use platewash_workcell::plate::Plate;
use platewash_workcell::simulation::FoamContact;
use platewash_workcell::tool::Tool;

/// Columns that meet a face at a smaller cosine do not count: they run along it.
const LEAST_COSINE: f64 = 1e-3;

/// Cosines of the angle between the tool and a plate's axis at which the law begins to fade, and where nothing is left.
const FADES: [f64; 2] = [0.64, 0.42];

/// A sponge of foam among plates.
#[derive(Debug, Clone)]
pub struct SpongeOnPlates {
    tip: Frame,
    columns: Columns,
    level: LevelColumns,
    foam: Foam,
    plates: Vec<Target>,
    /// No column meets a plate farther from the tip \[m\].
    reach_m: f64,
}

/// A plate, with its constant data.
#[derive(Debug, Clone)]
struct Target {
    plate: Plate,
    /// Rotation from the plate's frame to the base's.
    turn: Matrix3<f64>,
    /// Position of its pole, base frame \[m\].
    pole: Vector3<f64>,
    /// The tip touches it only where its distance from the plate's axis, squared, is below this \[m²\], ...
    far_squared: f64,
    /// ... and its height over the pole between these \[m\].
    heights_m: [f64; 2],
}

/// Effect of plates on a sponge.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Push {
    /// Torques at the joints \[N·m\].
    pub torque: JointVector,
    /// Load on the foam: the sum of forces along the tool's axis, and the greatest compression.
    pub load: FoamLoad,
    /// Energy in the foam \[J\].
    pub energy_j: f64,
}

/// Slopes of the foam's torques about a configuration, every column on the plate taken as compressed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactSlope {
    /// −∂τ/∂q \[N·m/rad\], the part that grows with the stiffness: symmetric and not negative.
    pub stiffness: MassMatrix,
    /// −∂τ/∂q̇ \[N·m·s/rad\].
    pub damping: MassMatrix,
}

impl Target {
    fn new(plate: &Plate, reach_m: f64) -> Self {
        let [least, most] = plate.surface.height_bounds_m();
        let far_m = plate.rim_m() + reach_m;
        Self {
            plate: *plate,
            turn: *plate.pose.rotation.to_rotation_matrix().matrix(),
            pole: plate.pose.translation.vector,
            far_squared: far_m * far_m,
            heights_m: [least - reach_m, most + reach_m],
        }
    }

    /// Checks that a column might meet the plate, by the height and distance of the tip alone.
    #[inline]
    fn may_touch(&self, at: &FrameMotion) -> bool {
        let away = at.pose.translation - self.pole;
        let height_m = self.turn.column(2).dot(&away);
        let [low_m, high_m] = self.heights_m;
        height_m < high_m && height_m > low_m && away.norm_squared() - height_m * height_m < self.far_squared
    }

    /// The sponge from the plate's frame: where it stands, and across which directions.
    fn in_plate_frame(&self, at: &FrameMotion) -> (SpongePose, [Vector3<f64>; 2]) {
        let seen = |k: usize| self.turn.tr_mul(&at.pose.rotation.column(k).into_owned());
        let pose = SpongePose {
            tip: self.turn.tr_mul(&(at.pose.translation - self.pole)),
            axis: seen(2),
        };
        (pose, [seen(0), seen(1)])
    }
}

impl SpongeOnPlates {
    /// The sponge of a tool among plates; `None` without a tool body.
    #[must_use]
    pub fn new(robot: &RobotModel, tool: &Tool, plates: &[Plate], settings: &FoamContact) -> Option<Self> {
        if !tool.is_present() {
            return None;
        }
        let sponge = &tool.sponge;
        let free_height_m = sponge.free_height_m();
        let foundation = Foundation::stiff(sponge, [settings.stiffness_pa; 2]);
        // A column is at most the radius aside and acts up to twice its height along; one radius more for the width of columns.
        let reach_m = 2.0 * (sponge.radius_m + free_height_m);
        let columns = Columns::new(&foundation);
        Some(Self {
            tip: tool.tip_frame(robot),
            level: LevelColumns::new(&columns),
            columns,
            foam: Foam::new(settings, free_height_m),
            plates: plates.iter().map(|plate| Target::new(plate, reach_m)).collect(),
            reach_m,
        })
    }

    /// The foam.
    #[must_use]
    pub fn foam(&self) -> &Foam {
        &self.foam
    }

    /// Effect of all plates at a state of the arm.
    #[must_use]
    pub fn push(&self, model: &DynamicsModel, state: &PlantState) -> Push {
        let at = model.frame_motion(&state.q, &self.tip);
        let mut push = Push::default();
        for target in &self.plates {
            if !target.may_touch(&at) {
                continue;
            }
            let wrench = self.pressed(target, &at, &state.qd);
            push.torque += at.torque(&wrench.force, &wrench.moment);
            push.energy_j += wrench.energy_j;
            push.load.force_n += wrench.load.force_n;
            push.load.deepest_m = push.load.deepest_m.max(wrench.load.deepest_m);
        }
        push
    }

    /// Load on the foam from one plate that is raised by `higher_m` along its axis, at rest at `q` \[rad\].
    #[must_use]
    pub fn load_at_rest(&self, model: &DynamicsModel, q: &JointVector, plate: usize, higher_m: f64) -> FoamLoad {
        let Some(target) = self.plates.get(plate) else {
            return FoamLoad::default();
        };
        let mut raised = target.plate;
        raised.pose.translation.vector += raised.axis() * higher_m;
        let raised = Target::new(&raised, self.reach_m);
        let at = model.frame_motion(q, &self.tip);
        if raised.may_touch(&at) {
            self.pressed(&raised, &at, &JointVector::zeros()).load
        } else {
            FoamLoad::default()
        }
    }

    /// Slopes at `q` \[rad\] on a plate: those of foam within its limit, and of foam that bottoms out.
    #[must_use]
    pub fn slopes(&self, model: &DynamicsModel, q: &JointVector, plate: usize) -> [ContactSlope; 2] {
        let mut sum = MassMatrix::zeros();
        if let Some(target) = self.plates.get(plate) {
            let at = model.frame_motion(q, &self.tip);
            let ((pose, across), turn) = (target.in_plate_frame(&at), target.turn);
            for column in self.columns.turned(&target.plate.surface, &pose, across) {
                let cosine = -column.normal.dot(&pose.axis);
                if cosine <= LEAST_COSINE || self.share_on(&target.plate, &column.point).0 == 0.0 {
                    continue;
                }
                // −∂w/∂q: the torque of a unit of pressure over an area of one.
                let push = column.normal / cosine;
                let away = column.point - pose.tip;
                let slope = at.torque(&(turn * push), &(turn * away.cross(&push)));
                sum += slope * slope.transpose() * column.area_m2;
            }
        }
        let Foam {
            stiffness_pa,
            damping_pa_s,
            free_height_m,
        } = self.foam;
        [1.0, DENSE_FACTOR].map(|factor| ContactSlope {
            stiffness: sum * (factor * stiffness_pa / free_height_m),
            damping: sum * (damping_pa_s / free_height_m),
        })
    }

    /// The share of a column that is on a plate, and its slope by ρ \[1/m\].
    fn share_on(&self, plate: &Plate, point: &Vector3<f64>) -> (f64, f64) {
        share_within(point.xy().norm_squared(), plate.rim_m(), self.columns.half_width_m())
    }

    /// One plate's push, base frame.
    fn pressed(&self, target: &Target, at: &FrameMotion, qd: &JointVector) -> Wrench {
        let ((pose, across), turn) = (target.in_plate_frame(at), &target.turn);
        if -pose.axis.z <= FADES[1] {
            return Wrench::default();
        }
        let twist = (self.foam.damping_pa_s > 0.0).then(|| at.twist(qd).map(|v| turn.tr_mul(&v)));
        let plate = &target.plate;
        let wrench = if plate.surface.is_flat() {
            let rim_m = plate.rim_m();
            self.level.pressed(&self.foam, rim_m, (&pose, &across), twist.as_ref())
        } else {
            self.summed(plate, &pose, &across, twist.as_ref())
        };
        let (left, slope) = fade(-pose.axis.z);
        // Leaning by a rotation vector r changes the cosine by r·(ẑ × a).
        let upright = pose.axis.cross(&Vector3::z()) * (wrench.energy_j * slope);
        Wrench {
            force: turn * wrench.force * left,
            moment: turn * (wrench.moment * left + upright),
            load: FoamLoad {
                force_n: wrench.load.force_n * left,
                ..wrench.load
            },
            energy_j: wrench.energy_j * left,
        }
    }

    /// Effect of a plate of any shape on the columns, summed one by one, in its frame.
    fn summed(
        &self,
        plate: &Plate,
        pose: &SpongePose,
        across: &[Vector3<f64>; 2],
        twist: Option<&[Vector3<f64>; 2]>,
    ) -> Wrench {
        let mut wrench = Wrench::default();
        for column in self.columns.turned(&plate.surface, pose, *across) {
            let (w, normal) = (column.compression_m, &column.normal);
            let cosine = -normal.dot(&pose.axis);
            if !self.foam.is_pressed(w) || cosine <= LEAST_COSINE {
                continue;
            }
            let (share, slope) = self.share_on(plate, &column.point);
            if share == 0.0 {
                continue;
            }
            let (energy, mut pressure) = self.foam.energy_and_pressure(w);
            let away = column.point - pose.tip;
            if let Some([speed, turning]) = twist {
                let closing = -normal.dot(&(speed + turning.cross(&away))) / cosine;
                pressure = self.foam.damped(w, pressure, closing);
            }
            let mut force = normal * (share * pressure * column.area_m2 / cosine);
            if slope != 0.0 {
                let rho = column.point.xy().norm();
                let out = Vector3::new(column.point.x / rho, column.point.y / rho, 0.0);
                force -= (out + normal * (out.dot(&pose.axis) / cosine)) * (energy * column.area_m2 * slope);
            }
            wrench.force += force;
            wrench.moment += away.cross(&force);
            wrench.energy_j += share * energy * column.area_m2;
            wrench.load.force_n += share * pressure * column.area_m2;
            wrench.load.deepest_m = wrench.load.deepest_m.max(w);
        }
        wrench
    }
}

/// Remaining share of the law at a cosine between tool and plate's axis, and its slope by the cosine.
fn fade(cosine: f64) -> (f64, f64) {
    let [from, to] = FADES;
    falling((from - cosine) / (from - to), to - from)
}

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Rotation3, Unit};
    use platewash_workcell::tool::StraightTool;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        /// On a flat face the closed form equals the sum over columns that are met one by one: on the face and over the rim,
        /// pressed in part, wholly and too hard, upright and leaning, damped and not.
        #[test]
        fn a_flat_face_is_summed_as_any_other(
            rho in 0.0..0.19_f64,
            azimuth in -3.1..3.1_f64,
            height in -0.02..0.006_f64,
            lean in prop_oneof![Just(0.0), 0.0..0.2_f64, 0.0..1.0_f64],
            towards in -3.1..3.1_f64,
            spin in -3.1..3.1_f64,
            damping_pa_s in prop_oneof![Just(0.0), 0.0..300.0_f64],
            speeds in prop::array::uniform6(-0.3..0.3_f64),
        ) {
            let tool = Tool::from(StraightTool { length_m: 0.15, sponge_compression_m: 0.005, ..StraightTool::default() });
            let settings = FoamContact { stiffness_pa: 2e4, damping_pa_s };
            let plate = Plate::level_disc([0.0; 3], 0.145, 0.02);
            let sponge = SpongeOnPlates::new(&RobotModel::irb120().unwrap(), &tool, &[plate], &settings).unwrap();
            let side = Unit::new_normalize(Vector3::new(towards.cos(), towards.sin(), 0.0));
            let turn = Rotation3::from_axis_angle(&side, lean) * Rotation3::from_axis_angle(&Vector3::z_axis(), spin);
            let pose = SpongePose {
                tip: Vector3::new(rho * azimuth.cos(), rho * azimuth.sin(), height),
                axis: -(turn * Vector3::z()),
            };
            let across = [turn * Vector3::x(), turn * -Vector3::y()];
            let [a, b, c, d, e, f] = speeds;
            let twist = (damping_pa_s > 0.0).then_some([Vector3::new(a, b, c), Vector3::new(d, e, f)]);
            let one_by_one = sponge.summed(&plate, &pose, &across, twist.as_ref());
            let at_once = sponge.level.pressed(&sponge.foam, plate.rim_m(), (&pose, &across), twist.as_ref());
            let scale = one_by_one.load.force_n.max(1.0);
            prop_assert!((at_once.force - one_by_one.force).amax() < 1e-9 * scale, "{at_once:?} {one_by_one:?}");
            prop_assert!((at_once.moment - one_by_one.moment).amax() < 1e-10 * scale, "{at_once:?} {one_by_one:?}");
            prop_assert!((at_once.energy_j - one_by_one.energy_j).abs() < 1e-12 * scale);
            prop_assert!((at_once.load.force_n - one_by_one.load.force_n).abs() < 1e-9 * scale);
            prop_assert!((at_once.load.deepest_m - one_by_one.load.deepest_m).abs() < 1e-13);
        }
    }
}
