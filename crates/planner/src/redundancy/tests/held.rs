//! How the wrist is held by tools that lean.

use crate::placed_arm::Stance;
use crate::redundancy::tests::*;
use platewash_bodies::tool_chain::{Handle, ToolChain};
use platewash_kinematics::Pose;

/// Least distance of joint 5 from 0 \[rad\]: 3°.
const WRIST_RAD: f64 = 0.0524;

/// A tool 35 mm before the flange that leans by 30°.
fn leaning() -> Tool {
    let chain = ToolChain {
        straight: StraightTool {
            length_m: 0.15,
            ..StraightTool::default()
        },
        mount: Pose::new(0.035 * Vector3::z(), 30_f64.to_radians() * Vector3::y()),
        handle: Handle::Round,
        bodies: Vec::new(),
    };
    chain.tool().unwrap()
}

/// Joint 5 on the line over an end of a wash \[rad\].
fn wrist_on_line(world: &World<'_>, path: &WashPath, washing: &Washing, end: usize) -> Vec<f64> {
    let placed = &world.placed;
    let k = end * (washing.q.len() - 1);
    let height = |step: i32| path.lift_m * f64::from(step) / 60.0;
    let pose = |step| placed.tip_pose(&washing.feet[end].raised(height(step)), washing.tilt_rad[k]);
    let poses: Vec<_> = (0..=60).map(pose).collect();
    let line = placed.solver.solve_path(&poses, &washing.q[k]).unwrap();
    line.q.iter().map(|q| q[4]).collect()
}

/// Held the wrong way round, the wrist of a leaning tool is near 0: no wash is taken whose line comes nearer than the wash may.
#[test]
fn the_wrist_is_held_on_the_lines_as_on_the_path() {
    let (mut washed, mut refused) = (0, 0);
    for k in 0..30 {
        let rho = 0.22 + 0.01 * f64::from(k);
        within(&leaning(), &[plate_at(rho, 20.0)], |world| {
            let stance = Stance {
                wrist_rad: Some(WRIST_RAD),
                ..Stance::default()
            };
            let held = |placed: PlacedArm<'_>| -> bool {
                let world = World {
                    placed: placed.with_stance(stance).half_turned(),
                    clearance: world.clearance,
                };
                let path = path(curve(0.08), 15.0);
                let Ok(washing) = world.washing(&path) else {
                    return false;
                };
                for end in [0, 1] {
                    let wrist = wrist_on_line(&world, &path, &washing, end);
                    let side = wrist[0].signum();
                    assert!(wrist.iter().all(|q| q * side >= WRIST_RAD), "{rho}: {wrist:?}");
                }
                true
            };
            if held(world.placed.clone()) {
                washed += 1;
            } else {
                refused += 1;
            }
        });
    }
    assert!(washed >= 5 && refused >= 5, "{washed} {refused}");
}

/// On the correct side, joint 5 is bent by the lean of the tool more than with a straight tool.
#[test]
fn a_leaning_tool_bends_the_wrist() {
    let bend = |tool: &Tool| {
        within(tool, &[plate_at(0.35, 0.0)], |world| {
            let washing = world.washing(&path(curve(RADIUS_M), 15.0)).unwrap();
            washing.q.iter().map(|q| q[4].abs()).fold(f64::INFINITY, f64::min)
        })
    };
    let [straight, leaning] = [bend(&straight(0.15, 0.02)), bend(&leaning())];
    assert!(leaning > straight + 0.3, "{straight} {leaning}");
}
