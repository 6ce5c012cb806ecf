//! A tool as it is: a straight one, mounted anywhere on the flange and turned in any way, with further bodies beside its handle.
//!
//! Poses of bodies are in the frame of the tool: at [`ToolChain::mount`] on the flange, z along the handle.

#[cfg(test)]
mod tests;

use crate::tool::{StraightTool, Tool, ToolBody, ToolMass};
use crate::uniform::{UniformBody, steiner};
use crate::words::millimetres;
use nalgebra::{Matrix3, Point3, Vector3};
use platewash_kinematics::Pose;
use platewash_kinematics::geometry::Shape;

/// What masses that should add up may miss, as a part of their sum.
const ROUNDING: f64 = 1e-9;

/// A tool that is put together.
#[derive(Debug, Clone, PartialEq)]
pub struct ToolChain {
    /// Sponge, tip, mass and, where it has one, the handle: in the frame of the tool.
    pub straight: StraightTool,
    /// `T_flange_tool`.
    pub mount: Pose,
    /// What is between the flange and the sponge besides [`Self::bodies`].
    pub handle: Handle,
    /// Further bodies.
    pub bodies: Vec<ChainBody>,
}

/// What a tool is held by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Handle {
    /// A round one, from the origin of the tool's frame to the sponge.
    Round,
    /// Nothing but the bodies of the chain.
    None,
}

/// A body of a chain.
#[derive(Debug, Clone, PartialEq)]
pub struct ChainBody {
    /// Its name, in messages.
    pub name: String,
    /// Its shape.
    pub shape: Shape,
    /// `T_tool_body`.
    pub pose: Pose,
    /// Its mass \[kg\]; without it, its share by volume of what the others leave of the tool's.
    pub mass_kg: Option<f64>,
}

/// Why a chain is no tool.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ToolError {
    /// Nothing holds the sponge.
    #[error("nothing holds the sponge: the tool has no handle, and no other body")]
    Bare,
    /// A body without a volume.
    #[error("body \"{body}\" of the tool has no volume: its points lie in a plane, or are not finite")]
    Flat {
        /// The body.
        body: String,
    },
    /// Two bodies of one name.
    #[error("two bodies of the tool are named \"{name}\"; a pair of bodies is told by its names")]
    SameName {
        /// The name.
        name: String,
    },
    /// A body with the name of a link of the arm that holds the tool.
    #[error("body \"{body}\" of the tool has the name of a link of the arm; a pair of bodies is told by its names")]
    OfLink {
        /// The body.
        body: String,
    },
    /// Bodies that weigh more than the tool.
    #[error("the bodies of the tool weigh {bodies_kg} kg, more than the {tool_kg} kg that it has in all")]
    Heavier {
        /// What they state \[kg\].
        bodies_kg: f64,
        /// What the tool has \[kg\].
        tool_kg: f64,
    },
    /// Mass that no body has.
    #[error("the bodies of the tool weigh {bodies_kg} kg, and nothing is left to weigh the rest of its {tool_kg} kg")]
    Lighter {
        /// What they state \[kg\].
        bodies_kg: f64,
        /// What the tool has \[kg\].
        tool_kg: f64,
    },
    /// A body that reaches into the sponge.
    #[error("body \"{body}\" of the tool reaches {} into the sponge, all of which counts as foam", millimetres(*.by_m))]
    InSponge {
        /// The body.
        body: String,
        /// How far \[m\].
        by_m: f64,
    },
}

impl ToolChain {
    /// The tool.
    ///
    /// Its mass is that of the straight tool. Without further bodies it is spread as there; with them each has what it states, and those that
    /// state nothing, the handle with the sponge as one cylinder among them, share the rest by their volumes. A sponge that no handle
    /// holds weighs nothing. A centre of mass and an inertia that are given count instead.
    ///
    /// # Errors
    /// [`ToolError`].
    pub fn tool(&self) -> Result<Tool, ToolError> {
        let mut tool = Tool::from(self.straight);
        let whole = tool.mass.take();
        if self.handle == Handle::None {
            tool.bodies.clear();
        }
        let own = self.bodies.iter().map(|body| ToolBody {
            name: body.name.clone(),
            shape: body.shape.clone(),
            pose: body.pose,
        });
        tool.bodies.extend(own);
        if tool.bodies.is_empty() && (self.handle == Handle::None || self.straight.length_m > 0.0) {
            return Err(ToolError::Bare);
        }
        self.check_names(&tool)?;
        tool.mass = match whole {
            Some(mass) if !self.bodies.is_empty() => Some(self.spread(mass)?),
            whole => whole,
        };
        if let Some((body, by_m)) = tool.in_sponge() {
            let body = body.name.clone();
            return Err(ToolError::InSponge { body, by_m });
        }
        Ok(mounted(tool, &self.mount))
    }

    fn check_names(&self, tool: &Tool) -> Result<(), ToolError> {
        let mut names: Vec<_> = tool.bodies.iter().map(|body| body.name.as_str()).collect();
        names.push("sponge");
        names.sort_unstable();
        match names.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(ToolError::SameName {
                name: pair[0].to_owned(),
            }),
            None => Ok(()),
        }
    }

    /// The mass of the straight tool over the bodies, in the frame of the tool.
    fn spread(&self, whole: ToolMass) -> Result<ToolMass, ToolError> {
        let mut parts = Vec::new();
        for body in &self.bodies {
            let flat = || ToolError::Flat {
                body: body.name.clone(),
            };
            let uniform = UniformBody::of(&body.shape).ok_or_else(flat)?;
            parts.push((uniform.placed(&body.pose), body.mass_kg));
        }
        if self.handle == Handle::Round {
            let half_length_m = 0.5 * self.straight.length_m;
            let shape = Shape::Cylinder {
                radius_m: self.straight.radius_m,
                half_length_m,
            };
            let uniform = UniformBody::of(&shape).map(|u| u.placed(&Pose::translation(0.0, 0.0, half_length_m)));
            parts.extend(uniform.map(|uniform| (uniform, None)));
        }
        let tool_kg = whole.mass_kg;
        let bodies_kg: f64 = parts.iter().filter_map(|(_, mass_kg)| *mass_kg).sum();
        let open_m3: f64 = parts
            .iter()
            .filter(|(_, m)| m.is_none())
            .map(|(u, _)| u.volume_m3)
            .sum();
        let left_kg = tool_kg - bodies_kg;
        let exact = left_kg.abs() <= ROUNDING * tool_kg;
        if left_kg < 0.0 && !exact {
            return Err(ToolError::Heavier { bodies_kg, tool_kg });
        }
        if open_m3 == 0.0 && !exact {
            return Err(ToolError::Lighter { bodies_kg, tool_kg });
        }
        let density = |uniform: &UniformBody, stated: Option<f64>| match stated {
            Some(mass_kg) => mass_kg / uniform.volume_m3,
            None => left_kg.max(0.0) / open_m3,
        };
        let dense: Vec<_> = parts.iter().map(|(u, stated)| (u, density(u, *stated))).collect();
        let summed = sum(tool_kg, &dense);
        Ok(ToolMass {
            mass_kg: tool_kg,
            com_m: self.straight.com_m.map_or(summed.com_m, |z| [0.0, 0.0, z]),
            inertia_kg_m2: self.straight.inertia_kg_m2.unwrap_or(summed.inertia_kg_m2),
        })
    }
}

/// Bodies with their densities as one, by the parallel-axis theorem.
fn sum(mass_kg: f64, dense: &[(&UniformBody, f64)]) -> ToolMass {
    let mass = |(body, density): &(&UniformBody, f64)| body.volume_m3 * density;
    let com: Vector3<f64> = dense.iter().map(|one| one.0.centre_m * (mass(one) / mass_kg)).sum();
    let about = |one: &(&UniformBody, f64)| one.0.inertia_m5 * one.1 + steiner(mass(one), &(one.0.centre_m - com));
    let inertia: Matrix3<f64> = dense.iter().map(about).sum();
    ToolMass {
        mass_kg,
        com_m: com.into(),
        inertia_kg_m2: entries(&inertia),
    }
}

/// The tool with its frame at `T_flange_tool`; to the bit as it is where that is the flange.
fn mounted(tool: Tool, mount: &Pose) -> Tool {
    if *mount == Pose::identity() {
        return tool;
    }
    let mut tool = tool;
    for body in &mut tool.bodies {
        body.pose = mount * body.pose;
    }
    tool.sponge.pose = mount * tool.sponge.pose;
    tool.tip = mount * tool.tip;
    tool.mass = tool.mass.map(|mass| {
        let turn = mount.rotation.to_rotation_matrix();
        let [xx, xy, xz, yy, yz, zz] = mass.inertia_kg_m2;
        let inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        ToolMass {
            mass_kg: mass.mass_kg,
            com_m: (mount * Point3::from(mass.com_m)).coords.into(),
            inertia_kg_m2: entries(&(turn.matrix() * inertia * turn.matrix().transpose())),
        }
    });
    tool
}

/// ixx, ixy, ixz, iyy, iyz, izz.
fn entries(inertia: &Matrix3<f64>) -> [f64; 6] {
    [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)].map(|at| inertia[at])
}
