use crate::tool_chain::*;
use proptest::prelude::*;

fn straight() -> StraightTool {
    StraightTool {
        length_m: 0.15,
        ..StraightTool::default()
    }
}

fn alone(straight: StraightTool, mount: Pose) -> ToolChain {
    ToolChain {
        straight,
        mount,
        handle: Handle::Round,
        bodies: Vec::new(),
    }
}

fn bracket(name: &str, mass_kg: Option<f64>) -> ChainBody {
    ChainBody {
        name: name.to_owned(),
        shape: Shape::Box {
            half_m: [0.03, 0.01, 0.02],
        },
        pose: Pose::translation(0.02, 0.0, 0.05),
        mass_kg,
    }
}

fn symmetric([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> Matrix3<f64> {
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

#[test]
fn a_straight_tool_on_the_flange_is_unchanged() {
    for length_m in [0.0, 0.15] {
        let straight = StraightTool { length_m, ..straight() };
        let chain = alone(straight, Pose::identity());
        assert_eq!(chain.tool(), Ok(Tool::from(straight)));
    }
}

proptest! {
    /// Everything of the tool goes with its frame: seen from there it is the straight one.
    #[test]
    fn a_mounted_tool_is_the_straight_one_from_its_own_frame(at in prop::array::uniform3(-0.2..0.2f64), turn in prop::array::uniform3(-3.0..3.0f64), com in prop::option::of(0.0..0.1f64)) {
        let mount = Pose::new(Vector3::from(at), Vector3::from(turn));
        let straight = StraightTool { com_m: com, ..straight() };
        let (found, plain) = (alone(straight, mount).tool().unwrap(), Tool::from(straight));
        let near = |a: &Pose, b: &Pose| (mount.inverse() * a).to_homogeneous().relative_eq(&b.to_homogeneous(), 1e-12, 1e-12);
        prop_assert!(near(&found.tip, &plain.tip) && near(&found.sponge.pose, &plain.sponge.pose));
        prop_assert!(near(&found.bodies[0].pose, &plain.bodies[0].pose));
        let (found, plain) = (found.mass.unwrap(), plain.mass.unwrap());
        let com = mount * Point3::from(plain.com_m);
        prop_assert!((com.coords - Vector3::from(found.com_m)).norm() < 1e-14);
        let turn = *mount.rotation.to_rotation_matrix().matrix();
        let inertia = turn * symmetric(plain.inertia_kg_m2) * turn.transpose();
        prop_assert!((inertia - symmetric(found.inertia_kg_m2)).amax() < 1e-15);
    }

    /// A handle in two halves, of one density, is the whole; so is one of which a half states its mass.
    #[test]
    fn two_halves_have_the_mass_of_the_whole(cut in 0.1..0.9f64, stated in any::<bool>(), mass_kg in 0.05..3.0f64) {
        let (r, l) = (0.02, 0.15);
        let part = |name: &str, from: f64, to: f64| ChainBody {
            name: name.to_owned(),
            shape: Shape::Cylinder { radius_m: r, half_length_m: 0.5 * l * (to - from) },
            pose: Pose::translation(0.0, 0.0, 0.5 * l * (from + to)),
            mass_kg: stated.then_some(mass_kg * (to - from)),
        };
        // Thinner than a sponge and beside it: what counts is the mass.
        let chain = ToolChain {
            straight: StraightTool { mass_kg, radius_m: r, ..straight() },
            mount: Pose::identity(),
            handle: Handle::None,
            bodies: vec![part("lower", 0.0, cut), part("upper", cut, 1.0)],
        };
        let whole = StraightTool { mass_kg, radius_m: r, ..straight() };
        let [found, expected] = [chain.spread(Tool::from(whole).mass.unwrap()).unwrap(), Tool::from(whole).mass.unwrap()];
        prop_assert!((Vector3::from(found.com_m) - Vector3::from(expected.com_m)).norm() < 1e-12);
        let off = symmetric(found.inertia_kg_m2) - symmetric(expected.inertia_kg_m2);
        prop_assert!(off.amax() < 1e-12 * mass_kg, "{off}");
    }
}

/// By hand: 0.3 kg, of which the box states 0.1; the rest is the cylinder over the whole length.
#[test]
fn a_body_beside_the_handle_takes_its_share() {
    let chain = ToolChain {
        bodies: vec![bracket("bracket", Some(0.1))],
        ..alone(straight(), Pose::identity())
    };
    let mass = chain.tool().unwrap().mass.unwrap();
    let com = [0.02 / 3.0, 0.0, (0.2 * 0.075 + 0.1 * 0.05) / 0.3];
    assert!((Vector3::from(mass.com_m) - Vector3::from(com)).norm() < 1e-15);
    assert_eq!(mass.mass_kg, 0.3);
    // What is given counts.
    let straight = StraightTool {
        com_m: Some(0.04),
        inertia_kg_m2: Some([1.0, 0.0, 0.0, 1.0, 0.0, 1.0]),
        ..straight()
    };
    let mass = ToolChain { straight, ..chain }.tool().unwrap().mass.unwrap();
    assert_eq!(mass.com_m, [0.0, 0.0, 0.04]);
    assert_eq!(mass.inertia_kg_m2, [1.0, 0.0, 0.0, 1.0, 0.0, 1.0]);
}

#[test]
fn invalid_tools_state_the_reason() {
    let plain = alone(straight(), Pose::identity());
    let of = |handle, bodies| {
        let said = ToolChain {
            handle,
            bodies,
            ..plain.clone()
        };
        said.tool().unwrap_err()
    };
    assert_eq!(of(Handle::None, Vec::new()), ToolError::Bare);
    let heavy = of(Handle::Round, vec![bracket("bracket", Some(0.31))]);
    assert!(matches!(heavy, ToolError::Heavier { .. }), "{heavy}");
    let light = of(Handle::None, vec![bracket("bracket", Some(0.29))]);
    assert!(matches!(light, ToolError::Lighter { .. }), "{light}");
    for (first, second) in [("handle", "bracket"), ("arm", "arm"), ("sponge", "arm")] {
        let twice = of(Handle::Round, vec![bracket(first, None), bracket(second, None)]);
        assert!(matches!(twice, ToolError::SameName { .. }), "{twice}");
    }
    let mut deep = bracket("bracket", None);
    deep.pose.translation.z = 0.11;
    let deep = of(Handle::Round, vec![deep]);
    assert!(
        deep.to_string()
            .contains("\"bracket\" of the tool reaches 5.0 mm into the sponge"),
        "{deep}"
    );
    let mut flat = bracket("bracket", None);
    flat.shape = Shape::Hull { points: Vec::new() };
    assert!(matches!(of(Handle::Round, vec![flat]), ToolError::Flat { .. }));
}
