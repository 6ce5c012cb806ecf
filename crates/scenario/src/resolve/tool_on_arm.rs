//! The tool that a scenario states, on an arm.

use crate::error::{BodyError, BodyFault, BodySection, Problem, ScenarioError, conflict};
use crate::failure::Failure;
use crate::scenario::Scenario;
use crate::sections::body_shape::{SectionShape, pose};
use crate::sections::tool::{ASSUMED_STIFFNESS_KPA, ToolBodySection, tool_keys};
use platewash_kinematics::RobotModel;
use platewash_kinematics::geometry::Shape;
use platewash_workcell::clearance::SolidParts;
use platewash_workcell::tool::Tool;
use platewash_workcell::tool_chain::{ToolChain, ToolError};
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
        let shapes: Option<Vec<_>> = shapes.into_iter().map(ToolBodySource::convex).collect();
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
            handle: self.tool.handle.into(),
            bodies: bodies.map(|(section, shape)| section.body(shape, &mount)).collect(),
        }
    }

    /// The shapes of the bodies, hulls of meshes among them.
    fn tool_shapes(&self) -> Result<Vec<Shape>, Failure> {
        let refused = |problem| ScenarioError::new(&self.name, None, problem);
        let mut shapes = Vec::new();
        for (index, section) in self.tool_body.iter().enumerate() {
            shapes.push(match section_shape(index, section).map_err(refused)? {
                ToolBodySource::Convex(shape) => shape,
                ToolBodySource::Mesh { file, scale } => self.tool_hull(index, section, file, scale)?,
            });
        }
        Ok(shapes)
    }

    fn tool_hull(
        &self,
        index: usize,
        section: &ToolBodySection,
        file: &Path,
        scale: [f64; 3],
    ) -> Result<Shape, BodyError> {
        let source = self.meshes();
        let hulls = self.solids.parts(&source, file, scale, SolidParts::Hull);
        let error = |why| BodyError {
            section: BodySection::ToolBody,
            index,
            name: section.name.clone(),
            why,
        };
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
            let (keys, detail) = ("tool.mounted_on".to_owned(), error.to_string());
            ScenarioError::new(&self.name, None, Problem::Conflict { keys, detail })
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

/// Body of the tool, as far as its section states it.
enum ToolBodySource<'a> {
    Convex(Shape),
    Mesh { file: &'a Path, scale: [f64; 3] },
}

impl ToolBodySource<'_> {
    fn convex(self) -> Option<Shape> {
        match self {
            Self::Convex(shape) => Some(shape),
            Self::Mesh { .. } => None,
        }
    }
}

fn section_shape(index: usize, section: &ToolBodySection) -> Result<ToolBodySource<'_>, Problem> {
    let at = format!("tool_body[{index}]");
    section.check_name(&at)?;
    Ok(match section.body.stated(&at)? {
        SectionShape::Convex(shape) => ToolBodySource::Convex(shape),
        SectionShape::Mesh { file, scale } => ToolBodySource::Mesh { file, scale },
        SectionShape::HalfSpace => {
            let (keys, detail) = (
                format!("{at}.shape"),
                "a half-space cannot be a body of a tool".to_owned(),
            );
            return Err(Problem::Conflict { keys, detail });
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sections::tool::BodyFrame;
    use platewash_kinematics::Pose;
    use platewash_kinematics::irb120::IRB120_URDF;
    use platewash_kinematics::urdf::MeshSource;

    const HEAD: &str = "layout.region = \"appendix\"\n[tool]\nlength_m = 0.15\n";

    fn refused(text: &str) -> String {
        Scenario::parse(&format!("{HEAD}{text}"), "case")
            .unwrap_err()
            .to_string()
    }

    #[test]
    fn rejects_invalid_tool_sections_with_index_and_line() {
        let bracket = "[[tool_body]]\nname = \"bracket\"\nshape = \"box\"\nsize_m = [0.06, 0.02, 0.04]\n";
        let more = |text: &str| refused(&format!("{bracket}[[tool_body]]\n{text}"));
        for (said, words) in [
            (
                more("nam = \"a\""),
                "line 9: unknown key 'tool_body[1].nam'; did you mean 'tool_body[1].name'?",
            ),
            (
                more("size_m = [0.1, 0.1]"),
                "line 9: tool_body[1].size_m must be three numbers above 0, up to 2; found [0.1, 0.1]",
            ),
            (more("radius_m = inf"), "tool_body[1].radius_m must be a number above 0"),
            (more("shape = \"cone\""), "tool_body[1].shape must be \"box\" or"),
            (more("shape = \"sphere\""), "tool_body[1].name: is missing"),
            (more("name = \"a\""), "tool_body[1].shape: is missing"),
            (
                more("name = \"a\"\nshape = \"sphere\""),
                "tool_body[1].radius_m: is missing; a sphere has one",
            ),
            (
                more("name = \"a\"\nshape = \"capsule\"\nradius_m = 0.1"),
                "tool_body[1].length_m: is missing; a capsule",
            ),
            (
                more("name = \"a\"\nshape = \"sphere\"\nradius_m = 0.01\nlength_m = 0.1"),
                "tool_body[1].length_m: is not a size of a sphere",
            ),
            (
                more("name = \"a\"\nshape = \"box\"\nradius_m = 0.01"),
                "tool_body[1].radius_m: is not a size of a box",
            ),
            (
                more("name = \"plate 2\"\nshape = \"sphere\"\nradius_m = 0.01"),
                "tool_body[1].name: \"plate 2\" is the name of something else",
            ),
            (
                more("name = \"bracket\"\nshape = \"sphere\"\nradius_m = 0.01"),
                "tool_body.name: two bodies of the tool are named \"bracket\"",
            ),
            (
                more("name = \"a\"\nshape = \"sphere\"\nradius_m = 0.01\nat_m = [0, 0, 0.13]"),
                "body \"a\" of the tool reaches 15.0 mm into the sponge",
            ),
            (
                more("name = \"a\"\nshape = \"sphere\"\nradius_m = 0.01\nmass_kg = 0.4"),
                "tool.mass_kg, tool_body.mass_kg: the bodies of the tool weigh 0.4 kg",
            ),
            (
                refused("handle = \"none\""),
                "tool.handle, [[tool_body]]: nothing holds the sponge",
            ),
            (
                refused("mount_m = [0, 0]"),
                "tool.mount_m must be three numbers from -1 to 1",
            ),
            (refused(&"[[tool_body]]\n".repeat(51)), "found 51 of them"),
        ] {
            assert!(said.contains(words), "{words}: {said}");
        }
        let said = Scenario::parse("tool_body = [1]\nlayout.region = \"text\"", "case").unwrap_err();
        assert!(said.to_string().contains("line 1: tool_body must be a list"), "{said}");
        let none = "[[tool_body]]\nname = \"a\"\nshape = \"sphere\"\nradius_m = 0.01\n[layout]\nregion = \"text\"";
        let said = Scenario::parse(none, "case").unwrap_err().to_string();
        assert!(said.contains("tool.length_m is 0"), "{said}");
    }

    #[test]
    fn reads_back_a_tool_chain_and_rejects_names_of_links() {
        let text = "[[tool_body]]\nname = \"link_3\"\nshape = \"capsule\"\nradius_m = 0.01\nlength_m = 0.05\nat_m = [0.03, 0, 0.05]\n\
                rpy_deg = [0, 90, 0]\nmass_kg = 0.1\n";
        let mut scenario = Scenario::parse(&format!("{HEAD}mount_rpy_deg = [30, 0, 0]\n{text}"), "case").unwrap();
        assert_eq!(scenario.validate(), Ok(()));
        let arm = RobotModel::from_urdf(IRB120_URDF, &MeshSource::none()).unwrap();
        let said = scenario.tool_on(&arm).unwrap_err().to_string();
        assert!(
            said.starts_with("tool_body.name: body \"link_3\" of the tool has the name of a link"),
            "{said}"
        );
        scenario.tool_body[0].name = "rod".to_owned();
        let tool = scenario.tool_on(&arm).unwrap();
        assert_eq!(tool.bodies.len(), 2);
        // Placed from the flange, it is there.
        scenario.tool_body[0].frame = BodyFrame::Flange;
        let rod = &scenario.tool_on(&arm).unwrap().bodies[1];
        assert!((rod.pose.translation.vector - Pose::translation(0.03, 0.0, 0.05).translation.vector).norm() < 1e-15);
        // z of the tool turned about x by 30°: (0, −½, √¾).
        let tip = tool.tip.translation.vector;
        assert!(
            (tip.y + 0.075).abs() < 1e-15 && (tip.z - 0.15 * 0.75_f64.sqrt()).abs() < 1e-15,
            "{tip}"
        );
    }
}
