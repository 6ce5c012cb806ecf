//! Tool assembled from parts: a straight one, mounted at any pose on the flange, with further bodies beside its handle.
//!
//! Poses of bodies are in the frame of the tool: at [`ToolChain::mount`] on the flange, z along the handle.

#[cfg(test)]
mod tests;

use crate::uniform::{UniformBody, steiner};
use nalgebra::{Matrix3, Point3, Vector3};
use platewash_kinematics::Pose;
use platewash_kinematics::geometry::Shape;
use platewash_workcell::tool::{StraightTool, Tool, ToolBody, ToolMass};
use platewash_workcell::words::millimetres;

/// Rounding allowed in a sum of masses, as a part of the sum.
const ROUNDING: f64 = 1e-9;

/// Tool assembled from parts.
#[derive(Debug, Clone, PartialEq)]
pub struct ToolChain {
    /// Sponge, tip, mass and, if it has one, the handle, in the frame of the tool.
    pub straight: StraightTool,
    /// Pose of the tool's frame on the flange, `T_flange_tool`.
    pub mount: Pose,
    /// Handle between the flange and the sponge, besides [`Self::bodies`].
    pub handle: Handle,
    /// Further bodies.
    pub bodies: Vec<ChainBody>,
}

/// Handle of a tool.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Handle {
    /// Round handle from the origin of the tool's frame to the sponge.
    Round,
    /// No handle: only the bodies of the chain.
    None,
}

/// Body of a tool chain.
#[derive(Debug, Clone, PartialEq)]
pub struct ChainBody {
    /// Name, for messages.
    pub name: String,
    /// Shape in the body's frame.
    pub shape: Shape,
    /// Pose in the tool's frame, `T_tool_body`.
    pub pose: Pose,
    /// Mass \[kg\]; `None` for a share, by volume, of the mass that the others leave of the tool's.
    pub mass_kg: Option<f64>,
}

/// Reason that a chain is no valid tool.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ToolError {
    /// No body holds the sponge.
    #[error("nothing holds the sponge: the tool has no handle, and no other body")]
    Bare,
    /// A body has no volume.
    #[error("body \"{body}\" of the tool has no volume: its points lie in a plane, or are not finite")]
    Flat {
        /// Name of the body.
        body: String,
    },
    /// Two bodies have the same name.
    #[error("two bodies of the tool are named \"{name}\"; a pair of bodies is told by its names")]
    SameName {
        /// The shared name.
        name: String,
    },
    /// A body has the name of a link of the arm that holds the tool.
    #[error("body \"{body}\" of the tool has the name of a link of the arm; a pair of bodies is told by its names")]
    OfLink {
        /// Name of the body.
        body: String,
    },
    /// The bodies weigh more than the tool.
    #[error("the bodies of the tool weigh {bodies_kg} kg, more than the {tool_kg} kg that it has in all")]
    Heavier {
        /// Sum of the stated masses \[kg\].
        bodies_kg: f64,
        /// Mass of the tool \[kg\].
        tool_kg: f64,
    },
    /// The bodies weigh less than the tool, and all of them state a mass.
    #[error("the bodies of the tool weigh {bodies_kg} kg, and nothing is left to weigh the rest of its {tool_kg} kg")]
    Lighter {
        /// Sum of the stated masses \[kg\].
        bodies_kg: f64,
        /// Mass of the tool \[kg\].
        tool_kg: f64,
    },
    /// A body reaches into the sponge.
    #[error("body \"{body}\" of the tool reaches {} into the sponge, all of which counts as foam", millimetres(*.by_m))]
    InSponge {
        /// Name of the body.
        body: String,
        /// Depth \[m\].
        by_m: f64,
    },
}

impl ToolChain {
    /// Builds the tool.
    ///
    /// Its mass is that of the straight tool. Without further bodies the mass is spread as in the straight tool. With further bodies each
    /// has its stated mass, and those without one, including the handle with the sponge as one cylinder, share the rest by volume. A sponge
    /// without a handle has no mass. A given centre of mass and inertia replace the computed ones.
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

    /// Spreads the mass of the straight tool over the bodies, in the frame of the tool.
    fn spread(&self, whole: ToolMass) -> Result<ToolMass, ToolError> {
        let mut parts = Vec::new();
        for body in &self.bodies {
            let flat = || ToolError::Flat {
                body: body.name.clone(),
            };
            let uniform = UniformBody::from_shape(&body.shape).ok_or_else(flat)?;
            parts.push((uniform.placed(&body.pose), body.mass_kg));
        }
        if self.handle == Handle::Round {
            let half_length_m = 0.5 * self.straight.length_m;
            let shape = Shape::Cylinder {
                radius_m: self.straight.radius_m,
                half_length_m,
            };
            let uniform =
                UniformBody::from_shape(&shape).map(|u| u.placed(&Pose::translation(0.0, 0.0, half_length_m)));
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

/// Combines bodies with their densities into one, by the parallel-axis theorem.
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

/// Returns the tool with its frame at `T_flange_tool`; unchanged to the bit if that is the flange.
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

/// Entries ixx, ixy, ixz, iyy, iyz, izz of an inertia matrix.
fn entries(inertia: &Matrix3<f64>) -> [f64; 6] {
    [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)].map(|at| inertia[at])
}
