//! The tool that a scenario states, on an arm.

use crate::body_error::{BodyError, BodyFault, BodySection};
use crate::error::{Problem, ScenarioError, conflict};
use crate::failure::Failure;
use crate::scenario::Scenario;
use crate::sections::body_shape::{SectionShape, pose};
use crate::sections::tool::{ASSUMED_STIFFNESS_KPA, HandleName, ToolBodySection, tool_keys};
use platewash_bodies::clearance::SolidParts;
use platewash_bodies::tool_chain::{Handle, ToolChain, ToolError};
use platewash_kinematics::RobotModel;
use platewash_kinematics::geometry::Shape;
use platewash_workcell::tool::Tool;
use std::path::Path;

/// Greatest reach of a mesh of the tool from its origin \[m\], like other bodies by the ranges of their sizes.
const GREATEST_M: f64 = 2.0;

impl Scenario {
    /// Refuses bodies that make no tool.
    pub(crate) fn check_tool(&self) -> Result<(), Problem> {
        let tool = &self.tool;
        let moved = tool.mount_m != [0.0; 3] || tool.mount_rpy_deg != [0.0; 3];
        if tool.length_m == 0.0 && (moved || !self.tool_body.is_empty()) {
            let key = if moved { "tool.mount_m" } else { "tool_body" };
            return conflict(key, "there is no tool: tool.length_m is 0");
        }
        let mut shapes = Vec::new();
        for (index, section) in self.tool_body.iter().enumerate() {
            shapes.push(section_shape(index, section)?);
        }
        // The weight and volume of a mesh are known once its file is read.
        let shapes: Option<Vec<_>> = shapes.into_iter().map(Result::ok).collect();
        let Some(shapes) = shapes else {
            return Ok(());
        };
        self.tool_chain(shapes)
            .tool()
            .map_or_else(|error| conflict(tool_keys(&error), error.to_string()), |_| Ok(()))
    }

    /// The chain of bodies of these shapes, one a section.
    fn tool_chain(&self, shapes: Vec<Shape>) -> ToolChain {
        let mount = pose(self.tool.mount_m, self.tool.mount_rpy_deg);
        let bodies = self.tool_body.iter().zip(shapes);
        ToolChain {
            straight: self.tool.straight(),
            mount,
            handle: match self.tool.handle {
                HandleName::Round => Handle::Round,
                HandleName::None => Handle::None,
            },
            bodies: bodies.map(|(section, shape)| section.body(shape, &mount)).collect(),
        }
    }

    /// The shapes of the bodies, hulls of meshes among them.
    fn tool_shapes(&self) -> Result<Vec<Shape>, Failure> {
        let refused = |problem| ScenarioError::new(&self.name, None, problem);
        let mut shapes = Vec::new();
        for (index, section) in self.tool_body.iter().enumerate() {
            shapes.push(match section_shape(index, section).map_err(refused)? {
                Ok(shape) => shape,
                Err(mesh) => self.tool_hull(index, section, mesh)?,
            });
        }
        Ok(shapes)
    }

    fn tool_hull(
        &self,
        index: usize,
        section: &ToolBodySection,
        (file, scale): ScaledMesh<'_>,
    ) -> Result<Shape, BodyError> {
        let source = self.meshes();
        let hulls = self.solids.parts(&source, file, scale, SolidParts::Hull);
        let error = |why| BodySection::ToolBody.error(index, &section.name, why);
        let points: Vec<_> = hulls.map_err(error)?.iter().flatten().copied().collect();
        let reach_m = points.iter().map(|point| point.coords.norm()).fold(0.0, f64::max);
        if reach_m > GREATEST_M {
            let (file, most_m) = (file.display().to_string(), GREATEST_M);
            return Err(error(BodyFault::Large { file, reach_m, most_m }));
        }
        Ok(Shape::Hull { points })
    }

    /// The tool that an arm holds; where contact is promised its sponge has a stiffness.
    ///
    /// # Errors
    /// [`Failure`]: bodies that make no tool, a mesh that cannot be read or is no body.
    pub fn tool_on(&self, arm: &RobotModel) -> Result<Tool, Failure> {
        let mut chain = self.tool_chain(self.tool_shapes()?);
        if self.wash.contact {
            let assumed = ASSUMED_STIFFNESS_KPA.map(|kpa| 1e3 * kpa);
            chain.straight.sponge_stiffness_pa.get_or_insert(assumed);
        }
        let tool = chain.tool()?.mounted(self.tool.mounted_on.clone());
        let tool = tool.on(arm).map_err(|error| {
            let problem = Problem::conflict("tool.mounted_on", error.to_string());
            ScenarioError::new(&self.name, None, problem)
        })?;
        let is_link = |name: &str| arm.links().iter().any(|link| link.name == name);
        match self.tool_body.iter().find(|body| is_link(&body.name)) {
            Some(body) => Err(ToolError::OfLink {
                body: body.name.clone(),
            }
            .into()),
            None => Ok(tool),
        }
    }
}

/// The mesh of a file, and its scale.
type ScaledMesh<'a> = (&'a Path, Option<[f64; 3]>);

/// Body of the tool, as far as its section states it: a convex shape, or a mesh.
fn section_shape(index: usize, section: &ToolBodySection) -> Result<Result<Shape, ScaledMesh<'_>>, Problem> {
    let at = format!("tool_body[{index}]");
    section.check_name(&at)?;
    Ok(match section.body.stated(&at)? {
        SectionShape::Convex(shape) => Ok(shape),
        SectionShape::Mesh { file, scale } => Err((file, scale)),
        SectionShape::HalfSpace => {
            let detail = "a half-space cannot be a body of a tool";
            return Err(Problem::conflict(format!("{at}.shape"), detail));
        }
    })
}
