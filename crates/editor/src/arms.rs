//! Arms that were loaded before: the same description is not read again for every move of a plate.

use platewash_kinematics::RobotModel;
use platewash_kinematics::fingerprint::sha256_hex;
use platewash_scenario::{Failure, Scenario};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::SystemTime;

/// Arms that are kept.
const KEPT: usize = 4;

/// Arms by what decides them.
#[derive(Debug, Default)]
pub struct Arms {
    kept: Mutex<Vec<Loaded>>,
}

/// An arm, and an id of its description.
#[derive(Debug, Clone)]
pub struct Loaded {
    /// The id: another one wherever another arm may come of it.
    pub id: String,
    /// The arm.
    pub arm: Arc<RobotModel>,
}

impl Arms {
    /// The arm of a scenario.
    pub fn of(&self, scenario: &Scenario) -> Result<Loaded, Failure> {
        let id = id(scenario);
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(at) = kept.iter().position(|loaded| loaded.id == id) {
            let loaded = kept.remove(at);
            kept.push(loaded.clone());
            return Ok(loaded);
        }
        drop(kept);
        let arm = scenario.arm()?;
        let loaded = Loaded { id, arm };
        kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        kept.push(loaded.clone());
        if kept.len() > KEPT {
            kept.remove(0);
        }
        Ok(loaded)
    }
}

/// What decides an arm: what the scenario names, and when those files were last written; the accelerations are shown with it.
fn id(scenario: &Scenario) -> String {
    let robot = &scenario.robot;
    let written = [&robot.urdf, &robot.srdf].map(|path| path.as_deref().and_then(written));
    let named = (robot.model, &robot.urdf, &robot.srdf, &robot.package_path);
    let shown = scenario.limits.joint_acceleration_rad_s2;
    sha256_hex(format!("{named:?} {written:?} {shown:?}").as_bytes())
}

fn written(path: &Path) -> Option<(SystemTime, u64)> {
    let file = path.metadata().ok()?;
    Some((file.modified().ok()?, file.len()))
}
