//! Requirements of a certified job on keys whose ranges are wider for the paper's program, or for messages that name the key.

use crate::error::Problem;
use crate::scenario::Scenario;
use crate::sections::motion::Program;
use crate::to_job::placement::ShapeKeys;
use platewash_workcell::surface::Surface;
use platewash_workcell::wash_path::{LEAST_RADIUS_M, LEAST_TURNS, LONGEST_M, MOST_TURNS, WashCurve, WashPattern};

/// Plates thinner or smaller than this are none to the certificate \[m\].
const LEAST_PLATE_M: f64 = 1e-6;

/// Distance of the windings over the sponge's diameter, as it is estimated where no turns are stated.
const PITCH_SHARE: f64 = 0.8;

/// The slowest tip whose time can be computed \[m/s, m/s²\].
const LEAST_OF_TIP: f64 = 1e-6;

/// The least joint acceleration \[rad/s²\]: a transit then takes a minute or two.
const LEAST_JOINT_ACCELERATION: f64 = 1e-3;

impl Scenario {
    /// The wash curve on a plate, as far as the scenario alone decides it: otherwise a spiral to the rim, its windings as far apart as is
    /// usual, to estimate how much work it is.
    #[must_use]
    pub(crate) fn wash_curve_on(&self, surface: &Surface) -> WashCurve {
        let radius_m = self.wash.path_radius_m.unwrap_or(surface.arc_m());
        let pitch_m = PITCH_SHARE * 2.0 * self.tool.sponge_radius_m;
        WashCurve {
            radius_m,
            turns: self
                .wash
                .turns
                .unwrap_or((radius_m / pitch_m).clamp(LEAST_TURNS, MOST_TURNS)),
            start_angle_rad: 0.0,
            closing_ring: self.wash.closing_ring.unwrap_or(true),
            trim_rad: 0.0,
            pattern: WashPattern::Spiral,
        }
    }

    /// Refuses values with which no certified job can be planned or proved, by key.
    pub(crate) fn check_certified(&self) -> Result<(), Problem> {
        if self.job.program != Program::Certified {
            return Ok(());
        }
        let (wash, limits) = (&self.wash, &self.limits);
        let from = |key, found, least| refuse(key, found, found >= least, format!("at least {least}"));
        for (layout, keys) in self.shapes() {
            let above = |key: &str, found: f64| {
                let expected = format!("above {LEAST_PLATE_M:e}");
                refuse(&keys.called(key), found, found > LEAST_PLATE_M, expected)
            };
            above(layout.shape_key(), layout.surface().rim_m())?;
            above("layout.plate_thickness_m", layout.plate_thickness_m)?;
            for found in layout.plate_foot_m.into_iter().flatten() {
                above("layout.plate_foot_m", found)?;
            }
        }
        let tool = &self.tool;
        refuse(
            "tool.sponge_compression_m",
            tool.sponge_compression_m,
            tool.sponge_compression_m <= tool.sponge_height_m,
            format!("at most tool.sponge_height_m = {}", tool.sponge_height_m),
        )?;
        for (layout, keys) in self.shapes() {
            self.check_curve(&layout.surface(), keys)?;
        }
        from("wash.speed_m_s", wash.speed_m_s, LEAST_OF_TIP)?;
        from("wash.acceleration_m_s2", wash.acceleration_m_s2, LEAST_OF_TIP)?;
        for (key, stated) in [
            ("wash.landing_speed_m_s", wash.landing_speed_m_s),
            ("wash.lifting_speed_m_s", wash.lifting_speed_m_s),
        ] {
            stated.map_or(Ok(()), |found| from(key, found, LEAST_OF_TIP))?;
        }
        from("limits.tip_speed_m_s", limits.tip_speed_m_s, LEAST_OF_TIP)?;
        from(
            "limits.tip_acceleration_m_s2",
            limits.tip_acceleration_m_s2,
            LEAST_OF_TIP,
        )?;
        for found in limits.joint_acceleration_rad_s2 {
            from("limits.joint_acceleration_rad_s2", found, LEAST_JOINT_ACCELERATION)?;
        }
        Ok(())
    }

    /// Refuses a wash curve on a face that cannot be computed with.
    fn check_curve(&self, surface: &Surface, keys: ShapeKeys) -> Result<(), Problem> {
        let curve = self.wash_curve_on(surface);
        refuse(
            "wash.turns",
            curve.turns,
            (LEAST_TURNS..=MOST_TURNS).contains(&curve.turns),
            format!("from {LEAST_TURNS} to {MOST_TURNS}"),
        )?;
        let radius_key = match self.wash.path_radius_m {
            Some(_) => "wash.path_radius_m".to_owned(),
            None => keys.called("layout.plate_radius_m"),
        };
        let expected = format!("at least {LEAST_RADIUS_M}");
        refuse(&radius_key, curve.radius_m, curve.radius_m >= LEAST_RADIUS_M, expected)?;
        let length = curve.length_m();
        let expected = format!("such that the wash curve π · {radius_key} · (wash.turns + 2) is at most {LONGEST_M} m");
        refuse(&radius_key, curve.radius_m, length <= LONGEST_M, expected)
    }
}

fn refuse(key: &str, found: f64, fits: bool, expected: String) -> Result<(), Problem> {
    if fits {
        return Ok(());
    }
    Err(Problem::Value {
        key: key.to_owned(),
        expected: format!("{expected} in a certified job"),
        // As the file may state it: no row of zeros for a tiny number.
        found: format!("{found:?}"),
    })
}
