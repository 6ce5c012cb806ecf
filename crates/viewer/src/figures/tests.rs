//! Tests against faults of figures: texts that are cut or lie on each other, paths that are not the plan's, bytes that differ.

use super::page::SIZE;
use super::svg::{Rect, width};
use super::*;
use nalgebra::Vector3;
use platewash_bodies::job::WashJob;
use platewash_certificate::{Certificate, prove};
use platewash_fixtures::{kitchen, kitchen_plate};
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{Pose, RobotModel};
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::{PlanSegment, SegmentKind};
use platewash_planner::plan;
use platewash_simulator::{Execution, SimulationReport, simulate};
use platewash_workcell::wash_path::WashPath;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::LazyLock;

/// A washing with all data on it.
struct WashExample {
    job: WashJob,
    plan: Plan,
    certificate: Certificate,
    execution: Execution,
    report: SimulationReport,
}

impl WashExample {
    fn data(&self) -> FigureData<'_> {
        let data = FigureData::new(&self.plan, self.job.arm()).unwrap();
        let mut data = data.executed(&self.execution, &self.report).unwrap();
        data.certificate = Some(&self.certificate);
        data.region.base_circle_m = Some(0.28);
        data.region.polygon_m = Some(vec![[0.0, -0.38], [0.3, -0.38], [0.3, 0.38], [0.0, 0.38]]);
        data
    }
}

static KNOWN: LazyLock<WashExample> = LazyLock::new(|| {
    let job = kitchen()
        .on_plates(vec![kitchen_plate([0.29, 0.11]), kitchen_plate([0.05, -0.34])])
        .unwrap()
        .named("two plates");
    let plan = plan(&job).unwrap().plan;
    let settings = &plan.job.simulation;
    let execution = simulate(&plan, job.arm(), settings).unwrap();
    WashExample {
        certificate: prove(&plan, job.arm()).unwrap(),
        report: SimulationReport::new(&plan, job.arm(), settings, &execution).unwrap(),
        job,
        plan,
        execution,
    }
});

/// The value of an attribute of an element.
fn attribute<'s>(element: &'s str, name: &str) -> Option<&'s str> {
    let from = element.find(&format!(" {name}=\""))? + name.len() + 3;
    element[from..].split('"').next()
}

/// The texts of a drawing that run across it, and about where they are.
fn texts(svg: &str) -> Vec<(String, Rect)> {
    let is_level = |line: &&str| line.starts_with("<text ") && !line.contains("x=\"0\" y=\"0\"");
    let text = |line: &str| {
        let (element, words) = line.split_once('>').unwrap();
        let words = words.trim_end_matches("</text>").replace("&quot;", "\"");
        let number = |name: &str| attribute(element, name).unwrap().parse::<f64>().unwrap();
        let (size, [x, y]) = (number("font-size"), [number("x"), number("y")]);
        // Estimates are on the wide side.
        let wide = 0.88 * width(&words, size);
        let left = match attribute(element, "text-anchor") {
            Some("middle") => x - 0.5 * wide,
            Some("end") => x - wide,
            _ => x,
        };
        (words, Rect::new(left, y - 0.75 * size, wide, 0.8 * size))
    };
    svg.lines().filter(is_level).map(text).collect()
}

/// Texts keep within the sheet, and off each other.
#[track_caller]
fn assert_readable(svg: &str, name: &str) {
    let texts = texts(svg);
    assert!(texts.len() > 5, "{name}: {} texts", texts.len());
    for (k, (words, at)) in texts.iter().enumerate() {
        let holds = (0..2).all(|axis| at.at[axis] >= 0.0 && at.end()[axis] <= SIZE[axis]);
        assert!(holds, "{name}: \"{words}\" at {at:?}");
        let meets = |other: &Rect| (0..2).all(|k| at.at[k] < other.end()[k] && other.at[k] < at.end()[k]);
        let other = texts[..k].iter().find(|(_, other)| meets(other));
        assert_eq!(other.map(|(other, _)| (other, words)), None, "{name}");
    }
}

/// The points of a path element, in the order in which they stand.
fn points(path: &str) -> Vec<[f64; 2]> {
    let pairs = path.split(['M', 'L']).filter(|pair| !pair.is_empty());
    let number = |text: &str| text.trim_end_matches('Z').parse::<f64>().unwrap();
    pairs
        .map(|pair| {
            let (x, y) = pair.split_once(' ').unwrap();
            [number(x), number(y)]
        })
        .collect()
}

#[test]
fn no_text_is_cut_or_lies_on_another() {
    let data = KNOWN.data();
    for figure in Figure::ALL {
        assert_readable(&draw(&data, figure).unwrap(), figure.name());
    }
}

#[test]
fn escapes_a_hostile_name_and_keeps_it_within_the_sheet() {
    let mut plan = KNOWN.plan.clone();
    plan.provenance.scenario = "</title><script>\"&\u{202e}\u{7}\n".repeat(400);
    let data = FigureData::new(&plan, KNOWN.job.arm()).unwrap();
    for figure in [Figure::Layout, Figure::Joints, Figure::Spiral] {
        let svg = draw(&data, figure).unwrap();
        assert_readable(&svg, figure.name());
        assert!(!svg.contains("<script"), "{figure:?}");
        assert!(svg.chars().all(|c| !c.is_control() || c == '\n'), "{figure:?}");
    }
}

#[test]
fn the_layout_has_the_plans_wash_paths_and_transits() {
    let data = KNOWN.data();
    let svg = draw(&data, Figure::Layout).unwrap();
    let group = |name: &str| {
        let from = svg.find(&format!("<g class=\"{name}\">")).unwrap();
        &svg[from..from + svg[from..].find("</g>").unwrap()]
    };
    let paths = |group: &str| -> Vec<Vec<[f64; 2]>> {
        let all = group.split(" d=\"").skip(1);
        all.map(|path| points(path.split('"').next().unwrap())).collect()
    };
    let washes = paths(group("washes"));
    assert_eq!(washes.len(), 2);
    // All ways together are drawn on white, and each in two halves, with an arrow between.
    assert_eq!(paths(group("transits")).len(), 1 + 2 * 3);
    // Seen from above: a similarity that turns a quarter takes the plan's places to the drawing's.
    let ends = |wash: &[[f64; 2]]| [wash[0], wash[wash.len() - 1]];
    let drawn: Vec<[f64; 2]> = washes.iter().flat_map(|wash| ends(wash)).collect();
    let planned: Vec<Vector3<f64>> = data
        .washes()
        .flat_map(|(segment, _)| {
            let way = &data.planned[segment];
            [way[0].at, way[way.len() - 1].at]
        })
        .collect();
    let scale = |a: usize, b: usize| {
        let (p, q) = (drawn[a], drawn[b]);
        let pixels = ((p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2)).sqrt();
        pixels / (planned[a] - planned[b]).xy().norm()
    };
    for (a, b) in [(0, 1), (0, 2), (1, 3)] {
        assert!((scale(a, b) / scale(2, 3) - 1.0).abs() < 2e-3, "{a} {b}");
    }
    // x of the world is up, y to the left.
    let (from, to) = (planned[0], planned[2]);
    assert_eq!((drawn[0][1] - drawn[2][1]) > 0.0, to.x > from.x);
    assert_eq!((drawn[0][0] - drawn[2][0]) > 0.0, to.y > from.y);
}

#[test]
fn the_spiral_that_is_drawn_is_the_wash_path() {
    let data = KNOWN.data();
    for ideal in &data.ideal {
        let plate = &data.plan.job.plates[ideal.plate];
        let path = data.plan.wash_path_of(ideal.plate).unwrap();
        let [first, last] = path.feet(plate);
        assert!((ideal.points[0] - first).norm() < 1e-12);
        assert!((ideal.points[ideal.points.len() - 1] - last).norm() < 1e-12);
        let farthest = ideal
            .points
            .iter()
            .map(|at| plate.local(at).xy().norm())
            .fold(0.0, f64::max);
        assert!((farthest - path.curve.radius_m).abs() < 1e-12);
        // The planned tip follows it.
        let (segment, _) = data.washes().find(|(_, wash)| wash.plate == ideal.plate).unwrap();
        for point in &data.planned[segment] {
            let near = ideal.points.iter().map(|at| (at - point.at).norm()).fold(1.0, f64::min);
            assert!(near < 5e-3, "{near} m at {} s", point.t_s);
        }
    }
}

#[test]
fn the_same_plan_gives_the_same_bytes_for_every_number_of_threads() {
    let data = KNOWN.data();
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let all = [Figure::Layout, Figure::Joints, Figure::Coverage];
            all.map(|figure| draw(&data, figure).unwrap())
        })
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn reports_figures_that_cannot_be_drawn() {
    let known = &*KNOWN;
    let said = |name| Figure::named(name).unwrap_err().to_string();
    assert_eq!(
        said("layuot"),
        "there is no figure \"layuot\"; there are layout, joints, coverage, spiral"
    );
    let refused = |change: &dyn Fn(&mut Plan)| {
        let mut plan = known.plan.clone();
        change(&mut plan);
        FigureData::new(&plan, known.job.arm()).map(|_| ()).unwrap_err()
    };
    let none = |plan: &mut Plan| {
        plan.knots.t_s.clear();
        plan.knots.q_rad.clear();
        plan.knots.qd_rad_s.clear();
    };
    assert!(matches!(refused(&none), FigureError::NoMotion { knots: 0 }));
    assert!(matches!(
        refused(&|plan| plan.knots.t_s[3] = f64::NAN),
        FigureError::Knots(_)
    ));
    assert!(matches!(
        refused(&|plan| plan.segments[1].plate = 7),
        FigureError::Segment { plate: 7, .. }
    ));
    assert!(matches!(
        refused(&|plan| plan.segments[0].t_end_s = 1e9),
        FigureError::Segment { segment: 0, .. }
    ));
    let lost = |plan: &mut Plan| plan.job.plates[0].pose.translation.x = f64::INFINITY;
    assert!(matches!(refused(&lost), FigureError::NoPlate { plate: 0 }));
    let mut plan = known.plan.clone();
    plan.segments.retain(|segment| segment.kind != SegmentKind::Wash);
    let data = FigureData::new(&plan, known.job.arm()).unwrap();
    for figure in [Figure::Coverage, Figure::Spiral] {
        let refused = draw(&data, figure).unwrap_err();
        assert!(matches!(refused, FigureError::NothingWashed { .. }), "{figure:?}");
    }
    draw(&data, Figure::Layout).unwrap();
}

#[test]
fn a_hundred_plates_are_drawn_legibly() {
    let mut plan = KNOWN.plan.clone();
    let [wash, other] = [plan.wash_paths[0], plan.wash_paths[1]];
    let segments: Vec<_> = plan
        .segments
        .iter()
        .copied()
        .filter(|s| s.kind == SegmentKind::Wash)
        .collect();
    plan.job.plates = (0..100)
        .map(|k| kitchen_plate([0.35 * f64::from(k % 10), 0.35 * f64::from(k / 10)]))
        .collect();
    plan.order = (0..100).collect();
    plan.wash_paths = (0..100)
        .map(|plate| WashPath {
            plate,
            ..if plate == 0 { wash } else { other }
        })
        .collect();
    // As many short washes as plates, all in the time of the first one.
    let [from, to] = [segments[0].t_start_s, segments[0].t_end_s];
    let at = |k: usize| from + (to - from) * k as f64 / 100.0;
    let short = |k: usize| PlanSegment {
        kind: SegmentKind::Wash,
        plate: k,
        t_start_s: at(k),
        t_end_s: at(k + 1),
    };
    plan.segments = (0..100).map(short).collect();
    let data = FigureData::new(&plan, KNOWN.job.arm()).unwrap();
    for figure in [Figure::Layout, Figure::Spiral, Figure::Coverage, Figure::Joints] {
        assert_readable(&draw(&data, figure).unwrap(), figure.name());
    }
}

/// A colour of the page's light theme.
fn page_colour(key: &str) -> &'static str {
    let page = include_str!("../../page/src/palette.ts");
    let light = page.split("const LIGHT").nth(1).unwrap();
    light
        .split(&format!(" {key}: \""))
        .nth(1)
        .unwrap()
        .split('"')
        .next()
        .unwrap()
}

#[test]
fn colours_that_mean_something_are_those_of_the_page() {
    use super::svg::{BAD, EXECUTED, GOOD, GREY, HOME, INK, JOINTS, LIFT, TRANSIT, WASH};
    let both = [
        ("ink", INK),
        ("muted", GREY),
        ("wash", WASH),
        ("transit", TRANSIT),
        ("approach", LIFT),
        ("retreat", LIFT),
        ("depart", HOME),
        ("return", HOME),
        ("proved", GOOD),
        ("planned", TRANSIT),
        ("executed", EXECUTED),
        ("limit", BAD),
    ];
    for (key, colour) in both {
        assert_eq!(page_colour(key), colour, "{key}");
    }
    let page = include_str!("../../page/src/palette.ts");
    let joints = JOINTS.map(|colour| format!("\"{colour}\"")).join(", ");
    assert!(page.contains(&format!("joints: [{joints}]")), "{joints}");
}

#[test]
fn text_has_enough_contrast_on_white() {
    let light = |colour: &str| {
        let part = |k: usize| {
            let share = f64::from(u8::from_str_radix(&colour[k..k + 2], 16).unwrap()) / 255.0;
            if share <= 0.04045 {
                share / 12.92
            } else {
                ((share + 0.055) / 1.055).powf(2.4)
            }
        };
        0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5)
    };
    let data = KNOWN.data();
    for figure in Figure::ALL {
        let svg = draw(&data, figure).unwrap();
        for text in svg.lines().filter(|line| line.starts_with("<text ")) {
            let colour = attribute(text, "fill").unwrap();
            // White letters lie on the colour of washing.
            let ground = if colour == svg::PAPER { svg::WASH } else { svg::PAPER };
            let [a, b] = [light(colour), light(ground)];
            let contrast = (a.max(b) + 0.05) / (a.min(b) + 0.05);
            assert!(contrast >= 4.5, "{}: {contrast} of {text}", figure.name());
        }
    }
}

/// Checks for a place within a convex outline, counter-clockwise, or on its edge.
fn holds(outline: &Outline, at: [f64; 2]) -> bool {
    let next = outline.iter().cycle().skip(1);
    let left = |([ax, ay], [bx, by]): (&[f64; 2], &[f64; 2])| (bx - ax) * (at[1] - ay) - (by - ay) * (at[0] - ax);
    outline.iter().zip(next).all(|edge| left(edge) >= -1e-4)
}

/// An arm without visuals, whose collision shapes are small balls far apart.
fn arm_of_balls() -> RobotModel {
    let link = |k: usize| {
        format!("<link name=\"l{k}\"><collision><geometry><sphere radius=\"0.01\"/></geometry></collision></link>")
    };
    let joint = |k: usize| {
        let (to, axis, x) = (k + 1, ["0 0 1", "0 1 0"][k % 2], if k == 0 { 0.0 } else { 0.2 });
        format!(
            "<joint name=\"j{to}\" type=\"revolute\"><parent link=\"l{k}\"/><child link=\"l{to}\"/><origin xyz=\"{x} 0 0.1\"/>\
             <axis xyz=\"{axis}\"/><limit lower=\"-3\" upper=\"3\" velocity=\"3\" effort=\"9\"/></joint>"
        )
    };
    let parts: String = (0..=6).map(link).chain((0..6).map(joint)).collect();
    let tool0 =
        "<link name=\"tool0\"/><joint name=\"t\" type=\"fixed\"><parent link=\"l6\"/><child link=\"tool0\"/></joint>";
    RobotModel::from_urdf(
        &format!("<robot name=\"balls\">{parts}{tool0}</robot>"),
        &MeshSource::none(),
    )
    .unwrap()
}

#[test]
fn the_outline_of_an_arm_holds_its_frames_and_the_tip_for_every_mount() {
    let terms = KNOWN.job.terms();
    let (tool, q) = (&terms.workcell.tool, terms.home_rad[0]);
    let mounts = [Vector3::zeros(), Vector3::y() * FRAC_PI_2, Vector3::x() * PI].map(Pose::rotation);
    let mounts = mounts.map(|turned| Pose::translation(0.3, -0.2, 0.5) * turned);
    for (arm, mount) in [KNOWN.job.arm(), &arm_of_balls()]
        .into_iter()
        .flat_map(|arm| mounts.map(|mount| (arm, mount)))
    {
        let outlines = arm_outlines(arm, tool, &mount, &q);
        let poses = arm.fk(&q);
        let shown = |at: [f64; 2]| outlines.iter().any(|outline| holds(outline, at));
        let links = arm.links().iter().filter(|link| link.frame.body() > 0);
        for frame in links.map(|link| link.frame).chain([tool.tip_frame(arm)]) {
            let at: [f64; 2] = (mount * poses.pose(&frame)).translation.vector.xy().into();
            assert!(shown(at), "{frame:?} at {at:?}");
        }
        assert!(!shown([5.0, 5.0]));
        // The arm is in one piece: all outlines are met from the first.
        let mut apart: Vec<&Outline> = outlines.iter().collect();
        let mut met = vec![apart.remove(0)];
        while let Some(next) = apart.iter().position(|one| met.iter().any(|other| meet(one, other))) {
            met.push(apart.remove(next));
        }
        assert!(apart.is_empty(), "{}: {} outlines stand apart", arm.name(), apart.len());
    }
}

/// Checks for two outlines that have a place in common.
fn meet(a: &Outline, b: &Outline) -> bool {
    let inside = |a: &Outline, b: &Outline| a.iter().any(|at| holds(b, *at));
    inside(a, b) || inside(b, a) || crosses(a, b)
}

/// Checks for edges of two outlines that cross.
fn crosses(a: &Outline, b: &Outline) -> bool {
    let edges =
        |of: &Outline| -> Vec<[[f64; 2]; 2]> { (0..of.len()).map(|k| [of[k], of[(k + 1) % of.len()]]).collect() };
    let side = |[p, q]: [[f64; 2]; 2], at: [f64; 2]| (q[0] - p[0]) * (at[1] - p[1]) - (q[1] - p[1]) * (at[0] - p[0]);
    let parts = |edge, [p, q]: [[f64; 2]; 2]| side(edge, p) * side(edge, q) <= 0.0;
    let of_b = edges(b);
    edges(a)
        .into_iter()
        .any(|one| of_b.iter().any(|&other| parts(one, other) && parts(other, one)))
}

#[test]
fn plates_are_numbered_from_one() {
    let data = KNOWN.data();
    for figure in [Figure::Joints, Figure::Coverage, Figure::Spiral] {
        let said = draw(&data, figure).unwrap();
        assert!(
            said.contains("plate 1") && said.contains("plate 2"),
            "{}",
            figure.name()
        );
        assert!(!said.contains("plate 0"), "{}", figure.name());
    }
}

#[test]
fn washing_is_shaded_in_every_diagram_over_its_time() {
    let data = KNOWN.data();
    let svg = draw(&data, Figure::Joints).unwrap();
    let shades: Vec<f64> = svg
        .lines()
        .filter(|line| line.contains("fill-opacity=\"0.07\""))
        .map(|line| attribute(line, "width").unwrap().parse().unwrap())
        .collect();
    let washes: Vec<f64> = data.washes().map(|(_, wash)| wash.t_end_s - wash.t_start_s).collect();
    assert_eq!(shades.len(), 5 * washes.len());
    for (k, shade) in shades.iter().enumerate() {
        let scale = shades[0] / washes[0];
        assert!(
            (shade - scale * washes[k % washes.len()]).abs() < 0.2,
            "{k}: {shade} px"
        );
    }
}
