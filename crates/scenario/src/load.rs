//! From a file or a shipped name to a checked [`Scenario`].

use crate::error::{Problem, ScenarioError, conflict};
use crate::keys::line::{byte_of, line_at};
use crate::keys::listed::{Misfit, check_list, check_value};
use crate::keys::stated::first_stated;
use crate::keys::table::{KEYS, LISTS};
use crate::keys::unknown::unknown;
use crate::keys::value::describe;
use crate::scenario::{Scenario, check_seed};
use crate::sections::motion::Program;
use crate::sections::robot::RobotSection;
use crate::source::source;
use crate::to_job::surroundings::in_folder;
use platewash_kinematics::Pose;
use platewash_workcell::job::OrderRule;
use std::path::Path;
use toml::de::{DeTable, DeValue};

impl Scenario {
    /// Reads a scenario: a shipped name (`paper-appendix`), or a file. Paths in a file are taken
    /// relative to its folder.
    ///
    /// # Errors
    /// [`ScenarioError`] with the file, the line, the key, the value expected and the value found.
    pub fn load(name_or_file: &str) -> Result<Self, ScenarioError> {
        let source = source(name_or_file)?;
        Self::parse_in(&source.text, &source.name, source.folder.as_deref())
    }

    /// Reads a scenario from TOML text whose paths are relative to a folder; without one they stay as they are.
    pub(crate) fn parse_in(text: &str, source_name: &str, folder: Option<&Path>) -> Result<Self, ScenarioError> {
        let mut scenario = Self::parse(text, source_name)?;
        if let Some(folder) = folder {
            scenario.resolve_paths(folder);
        }
        Ok(scenario)
    }

    /// Reads a scenario from TOML text; `source_name` appears in errors.
    ///
    /// # Errors
    /// As [`Scenario::load`].
    pub fn parse(text: &str, source_name: &str) -> Result<Self, ScenarioError> {
        let syntax = |e: toml::de::Error| ScenarioError::syntax(source_name, text, &e);
        let table = DeTable::parse(text).map_err(syntax)?;
        check_table(table.get_ref(), "").map_err(|(at, problem)| {
            let line = Some(line_at(text, at));
            ScenarioError::new(source_name, line, problem)
        })?;
        let scenario: Self = toml::from_str(text).map_err(syntax)?;
        scenario.check_conflicts().map_err(|problem| {
            let at = problem.key().and_then(|key| byte_of(table.get_ref(), key));
            ScenarioError::new(source_name, at.map(|at| line_at(text, at)), problem)
        })?;
        Ok(scenario)
    }

    /// Checks a scenario that was built in code: every range, and keys that contradict each other.
    ///
    /// # Errors
    /// As [`Scenario::load`], without a line.
    pub fn validate(&self) -> Result<(), ScenarioError> {
        let syntax = |detail: String| ScenarioError::new(&self.name, None, Problem::Syntax { detail });
        // TOML does not know the upper half of this type.
        check_seed("seed", self.seed).map_err(|problem| ScenarioError::new(&self.name, None, problem))?;
        let text = toml::to_string(self).map_err(|e| syntax(e.to_string()))?;
        Self::parse(&text, &self.name)
            .map(|_| ())
            .map_err(|e| ScenarioError { line: None, ..e })
    }

    pub(crate) fn resolve_paths(&mut self, folder: &Path) {
        let files = [&mut self.robot.urdf, &mut self.robot.srdf].into_iter().flatten();
        for path in files.chain(&mut self.robot.package_path) {
            *path = folder.join(&*path);
        }
        let of_tool = self.tool_body.iter_mut().map(|section| &mut section.body);
        let bodies = of_tool.chain(self.obstacle.iter_mut().map(|section| &mut section.body));
        for mesh in bodies.filter_map(|body| body.mesh.as_mut()) {
            *mesh = in_folder(mesh, folder);
        }
        for path in self.plate_paths_mut() {
            *path = folder.join(&*path);
        }
    }

    fn check_conflicts(&self) -> Result<(), Problem> {
        self.check_plates()?;
        let (layout, tool) = (&self.layout, &self.tool);
        let ranges = [layout.x_m, layout.y_m, layout.rho_m, layout.azimuth_deg];
        if layout.region.is_some() && ranges.iter().any(Option::is_some) {
            return conflict(
                "layout.region",
                "give either a named region or ranges (x_m, y_m, rho_m, azimuth_deg)",
            );
        }
        if layout.azimuth_deg.is_some_and(|[from, to]| to - from > 360.0) {
            return conflict("layout.azimuth_deg", "the range is more than a turn wide");
        }
        let bounded =
            layout.region.is_some() || layout.rho_m.is_some() || (layout.x_m.is_some() && layout.y_m.is_some());
        if !self.lists_plates() && !bounded {
            return conflict(
                "layout",
                "no region to sample from: give region, or x_m and y_m, or rho_m, or positions_m, or [[plate]] sections with at_m",
            );
        }
        if tool.length_m > 0.0 && tool.sponge_height_m >= tool.length_m {
            let (sponge, length) = (tool.sponge_height_m, tool.length_m);
            return conflict(
                "tool.sponge_height_m",
                format!("must be below tool.length_m = {length}; found {sponge}"),
            );
        }
        self.check_tool()?;
        let robot = &self.robot;
        let of_description = |name: &str| ["srdf", "package_path", "split_links", "fixed"].contains(&name);
        if let (None, Some(key)) = (&robot.urdf, first_stated(robot, RobotSection::KEYS, of_description)) {
            return conflict("robot.urdf", format!("{} needs a robot.urdf", key.path));
        }
        if self.job.program == Program::Paper && self.job.order == OrderRule::Fastest {
            return conflict(
                "job.order",
                "\"fastest\" is for job.program = \"certified\"; the paper's program knows \"nearest\" and \"given\"",
            );
        }
        if self.job.program == Program::Paper && self.robot.stated_mount() != Pose::identity() {
            return conflict(
                "robot.mount_m, robot.mount_rpy_deg",
                "the paper's arm stands at the origin of the world: leave them out, or state job.program = \"certified\"",
            );
        }
        if self.job.program == Program::Paper && !layout.surface().is_flat() {
            return conflict(
                layout.shape_key(),
                "the paper's program washes flat plates alone: give plate_radius_m, or job.program = \"certified\"",
            );
        }
        self.check_surroundings()?;
        self.check_control()?;
        self.check_certified()?;
        self.check_contact()?;
        self.holder.check(self.wash.contact)?;
        self.check_waypoints()
    }
}

/// Largest excess of a stiffness over the bounds of a range in another unit, as a part of them: rounding.
const ROUNDING: f64 = 1e-12;

impl Scenario {
    /// Gains come in pairs, and the paper's program needs a law without a plant.
    fn check_control(&self) -> Result<(), Problem> {
        let control = &self.control;
        if control.joint_kp.is_some() != control.joint_kd.is_some() {
            return conflict("control.joint_kp", "give both joint_kp and joint_kd, or neither");
        }
        if self.job.program == Program::Paper && !self.law().is_kinematic() {
            let detail = format!(
                "\"{}\" drives the torques of a plant; following waypoints, as the paper's program does, needs \"paper\" or \"exact\"",
                self.law().name()
            );
            return conflict("control.law", detail);
        }
        self.check_foam()
    }

    /// Plates push back by foam or with a constant force, and foam has a stiffness.
    fn check_foam(&self) -> Result<(), Problem> {
        let (plant, range) = (&self.plant, self.tool.sponge_stiffness_kpa);
        let foam = plant.contact_stiffness_pa.or(plant.contact_damping_pa_s);
        if foam.is_some() && plant.contact_force_n.is_some_and(|force| force > 0.0) {
            let detail = "a constant force stands in place of the foam: give it, or contact_stiffness_pa and contact_damping_pa_s";
            return conflict("plant.contact_force_n", detail);
        }
        if plant.contact_stiffness_pa.is_none() && plant.contact_damping_pa_s.is_some() && range.is_none() {
            let detail = "damps foam of a stiffness that nothing states: give plant.contact_stiffness_pa or tool.sponge_stiffness_kpa";
            return conflict("plant.contact_damping_pa_s", detail);
        }
        if let (Some(found), Some([least, most])) = (plant.contact_stiffness_pa, range)
            && !(1e-3 * found >= least * (1.0 - ROUNDING) && 1e-3 * found <= most * (1.0 + ROUNDING))
        {
            let detail = format!("must be within tool.sponge_stiffness_kpa, {least} to {most} kPa; found {found} Pa");
            return conflict("plant.contact_stiffness_pa", detail);
        }
        Ok(())
    }
}

pub(crate) fn check_table(table: &DeTable<'_>, prefix: &str) -> Result<(), Misfit> {
    for (name, value) in table {
        let path = format!("{prefix}{}", name.get_ref());
        let inside = format!("{path}.");
        let is_section = KEYS.iter().any(|k| k.path.starts_with(&inside));
        if let Some(list) = LISTS.iter().find(|list| list.name == path) {
            check_list(list, value)?;
            continue;
        }
        match (KEYS.iter().find(|k| k.path == path), value.get_ref()) {
            (Some(key), _) => check_value(key, || path.clone(), value)?,
            (None, DeValue::Table(section)) if is_section => check_table(section, &inside)?,
            (None, found) if is_section => {
                let found = describe(found);
                let expected = format!("a section: write [{path}]");
                return Err((
                    value.span().start,
                    Problem::Value {
                        key: path,
                        expected,
                        found,
                    },
                ));
            }
            _ => return Err((name.span().start, unknown(&path))),
        }
    }
    Ok(())
}
