//! The `[control]` section.
//!
//! The `[plant]` section.

use platewash_keys::Section;
use platewash_kinematics::JointFriction;
use platewash_workcell::simulation::{
    ControlLawName, ControlSettings, FeedForward, FoamContact, Integrator, PlantSettings,
};
use platewash_workcell::tool::Sponge;
use serde::{Deserialize, Serialize};

/// The least and the greatest time step \[s\], of waypoints and of tables.
pub const TIME_STEPS_S: [f64; 2] = [1e-6, 10.0];

/// `[control]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("control")]
#[serde(default, deny_unknown_fields)]
pub struct ControlSection {
    /// Control law: the paper's law or exact tracking, without a plant; or a law that gives torques (certified). Without it, "paper" for
    /// the paper's program, "computed_torque" for a certified job.
    #[key(domain = Word(&ControlLawName::NAMES))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub law: Option<ControlLawName>,
    /// Proportional gain of the paper's law.
    #[key(unit = "1/s", domain = Number(0.0, 1e6), default = ControlSettings::default().kp)]
    pub kp: f64,
    /// Derivative gain of the paper's law.
    #[key(domain = Number(0.0, 1e6), default = ControlSettings::default().kd)]
    pub kd: f64,
    /// Time between waypoints.
    #[key(unit = "s", domain = Number(TIME_STEPS_S[0], TIME_STEPS_S[1]), default = ControlSettings::default().dt_s)]
    pub dt_s: f64,
    /// Samples of a torque law; its torque is held between them.
    #[key(unit = "Hz", domain = Number(1.0, 1e5), default = ControlSettings::default().rate_hz)]
    pub rate_hz: f64,
    /// Natural frequency ω of a torque law: kp = M ω², M each joint's largest inertia, or 1 for computed torque.
    #[key(unit = "rad/s", domain = NumberAbove(0.0, 1e5), default = ControlSettings::default().frequency_rad_s)]
    pub frequency_rad_s: f64,
    /// Damping ratio ζ of a torque law: kd = 2 ζ ω M.
    #[key(domain = Number(0.0, 100.0), default = ControlSettings::default().damping_ratio)]
    pub damping_ratio: f64,
    /// Proportional gains of a torque law in place of those; in 1/s² for computed torque.
    #[key(unit = "N·m/rad", domain = Joints(0.0, 1e9))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_kp: Option<[f64; 6]>,
    /// Derivative gains of a torque law in place of those; in 1/s for computed torque.
    #[key(unit = "N·m·s/rad", domain = Joints(0.0, 1e9))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_kd: Option<[f64; 6]>,
    /// Feed-forward of a torque law: the parts of the commanded motion that it uses besides positions; computed torque takes accelerations
    /// with speeds.
    #[key(domain = Word(&["none", "velocity"]), default = ControlSettings::default().feed_forward)]
    pub feed_forward: FeedForward,
}

impl ControlSection {
    /// The gains and the sampling.
    #[must_use]
    pub fn settings(&self) -> ControlSettings {
        ControlSettings {
            kp: self.kp,
            kd: self.kd,
            dt_s: self.dt_s,
            rate_hz: self.rate_hz,
            frequency_rad_s: self.frequency_rad_s,
            damping_ratio: self.damping_ratio,
            joint_kp: self.joint_kp,
            joint_kd: self.joint_kd,
            feed_forward: self.feed_forward,
        }
    }
}

/// `[plant]`: the arm as a physical system, where a law gives torques. Friction and torque limits are those of the arm's description unless
/// given: for the IRB 120 there are no published figures. Plates push back by the sponge's foam where its stiffness is stated.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("plant")]
#[serde(default, deny_unknown_fields)]
pub struct PlantSection {
    /// Integration scheme: speeds then positions, or the classical fourth-order scheme.
    #[key(domain = Word(&["semi_implicit_euler", "rk4"]), default = PlantSettings::default().integrator)]
    pub integrator: Integrator,
    /// Steps of integration to a sample of the law.
    #[key(domain = Integer(1, 1000), default = PlantSettings::default().substeps)]
    pub substeps: usize,
    /// Friction torque per joint speed; without it, the damping of the arm's description, where none is 0.
    #[key(unit = "N·m·s/rad", domain = Joints(0.0, 1e6))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub viscous_friction_n_m_s: Option<[f64; 6]>,
    /// Friction torque against any motion; without it, the friction of the arm's description, where none is 0.
    #[key(unit = "N·m", domain = Joints(0.0, 1e6))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coulomb_friction_n_m: Option<[f64; 6]>,
    /// Largest joint torques; without it, those of the arm's description, where an effort of 0 means unknown, not a limit.
    #[key(unit = "N·m", domain = JointsAbove(0.0, 1e6))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque_limit_n_m: Option<[f64; 6]>,
    /// Stiffness with which plates push the sponge's foam back, wherever it touches: an assumption, within tool.sponge_stiffness_kpa. Without
    /// it, the geometric mean of that range; where neither is stated, and no force, plates do not push back.
    #[key(unit = "Pa", domain = NumberAbove(0.0, 1e9))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact_stiffness_pa: Option<f64>,
    /// Damping of that foam, pressure over the speed of strain: off by default, as none is published.
    #[key(unit = "Pa·s", domain = Number(0.0, 1e9))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact_damping_pa_s: Option<f64>,
    /// A constant force of a plate on the sponge while it washes, along the plate's normal, in place of the foam; 0 where plates shall not
    /// push back.
    #[key(unit = "N", domain = Number(0.0, 1e4))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact_force_n: Option<f64>,
}

impl PlantSection {
    /// The plant of an arm that holds a sponge, if it does. The friction of its description counts where the section states none.
    #[must_use]
    pub fn settings(&self, sponge: Option<&Sponge>, described: &JointFriction) -> PlantSettings {
        PlantSettings {
            integrator: self.integrator,
            substeps: self.substeps,
            viscous_friction_n_m_s: self.viscous_friction_n_m_s.unwrap_or(described.viscous),
            coulomb_friction_n_m: self.coulomb_friction_n_m.unwrap_or(described.coulomb),
            torque_limit_n_m: self.torque_limit_n_m,
            contact_force_n: self.contact_force_n.unwrap_or(0.0),
            contact: self.contact(sponge),
        }
    }

    /// The foam: of the stiffness stated, otherwise of the sponge's own unless a constant force stands in its place.
    fn contact(&self, sponge: Option<&Sponge>) -> Option<FoamContact> {
        let stated = self.contact_stiffness_pa.map(|stiffness_pa| FoamContact {
            stiffness_pa,
            damping_pa_s: 0.0,
        });
        let own = || match self.contact_force_n {
            Some(_) => None,
            None => sponge.and_then(FoamContact::from_sponge),
        };
        let damping_pa_s = self.contact_damping_pa_s.unwrap_or(0.0);
        stated.or_else(own).map(|foam| FoamContact { damping_pa_s, ..foam })
    }
}

impl From<&PlantSettings> for PlantSection {
    /// The section that states all of a plant.
    fn from(plant: &PlantSettings) -> Self {
        Self {
            integrator: plant.integrator,
            substeps: plant.substeps,
            viscous_friction_n_m_s: Some(plant.viscous_friction_n_m_s),
            coulomb_friction_n_m: Some(plant.coulomb_friction_n_m),
            torque_limit_n_m: plant.torque_limit_n_m,
            contact_stiffness_pa: plant.contact.map(|foam| foam.stiffness_pa),
            contact_damping_pa_s: plant
                .contact
                .map(|foam| foam.damping_pa_s)
                .filter(|damping| *damping != 0.0),
            contact_force_n: plant.contact.is_none().then_some(plant.contact_force_n),
        }
    }
}

/// All keys of `[plant]` with the values that state a plant, for callers without a scenario file.
#[must_use]
pub fn plant_keys(plant: &PlantSettings) -> impl Serialize + use<> {
    PlantSection::from(plant)
}
