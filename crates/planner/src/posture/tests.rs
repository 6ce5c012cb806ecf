use super::*;
use crate::clearance::ClearanceModel;
use crate::robot::tip_frame;
use crate::scenario::ToolSection;
use platewash_kinematics::RobotModel;
use std::time::Instant;

const TOOL: ToolSection = ToolSection {
    length_m: 0.15,
    radius_m: 0.02,
    sponge_radius_m: 0.025,
    sponge_height_m: 0.025,
};

fn stroke(radius_m: f64) -> Stroke {
    Stroke {
        radius_m,
        turns: 3.5,
        start_angle_rad: 0.0,
        closing_ring: true,
    }
}

fn plate_at(rho: f64, azimuth_deg: f64) -> Plate {
    let (s, c) = crate::trig::sin_cos(azimuth_deg.to_radians());
    Plate {
        x_m: rho * c,
        y_m: rho * s,
        z_m: 0.03,
        radius_m: 0.145,
        thickness_m: 0.02,
    }
}

fn settings(tilt_deg: f64) -> PostureSettings {
    PostureSettings {
        tilt_max_rad: tilt_deg.to_radians(),
        clearance_m: 0.01,
    }
}

fn wash(
    robot: &RobotModel,
    tool: &ToolSection,
    plates: &[Plate],
    radius_m: f64,
    tilt_deg: f64,
) -> Result<Washing, PostureError> {
    let clearance = ClearanceModel::new(robot, tool, plates).unwrap();
    let cell = Cell::new(robot, tip_frame(robot, tool), &clearance, plates).unwrap();
    let centre = Vector3::new(plates[0].x_m, plates[0].y_m, plates[0].z_m);
    let t = Instant::now();
    let w = washing(
        &cell,
        &stroke(radius_m),
        centre,
        0,
        &settings(tilt_deg),
        &JointVector::zeros(),
    );
    println!("   {:.2} ms", 1e3 * t.elapsed().as_secs_f64());
    w
}

#[test]
#[ignore = "a measurement"]
fn at_scale() {
    let robot = RobotModel::irb120().unwrap();
    for (name, handle, radius, tilt) in [("policy", 0.02, 0.12385, 15.0), ("rim", 0.015, 0.145, 30.0)] {
        for azimuth in [0.0, 45.0, -45.0, 90.0, -90.0, 110.0, -110.0, 20.0] {
            for k in 0..8 {
                let rho = 0.25 + 0.035 * f64::from(k);
                let tool = ToolSection {
                    radius_m: handle,
                    ..TOOL
                };
                match wash(&robot, &tool, &[plate_at(rho, azimuth)], radius, tilt) {
                    Ok(w) => println!(
                        "{name} {rho:.3} {azimuth} n {} travel {:.2} {:?}",
                        w.q.len(),
                        w.travel_rad(),
                        w.how
                    ),
                    Err(e) => println!("{name} {rho:.3} {azimuth} FAILED {e}"),
                }
            }
        }
    }
}
