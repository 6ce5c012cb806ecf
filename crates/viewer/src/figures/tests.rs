//! What could be wrong with a figure: texts that are cut or lie on each other, paths that are not the plan's, bytes that differ.

use super::ink::drawing::{Drawing, Rect};
use super::*;
use crate::figures::ink::page::SIZE;
use nalgebra::Vector3;
use platewash_certificate::{Certificate, prove};
use platewash_planner::plan;
use platewash_simulator::{Execution, SimulationReport, simulate};
use platewash_workcell::fixtures::{kitchen, kitchen_plate};
use platewash_workcell::job::WashJob;
use platewash_workcell::plan::Plan;
use platewash_workcell::segment::{PlanSegment, SegmentKind};
use platewash_workcell::wash_path::WashPath;
use std::sync::LazyLock;

/// A washing with all that is known of it.
struct Known {
    job: WashJob,
    plan: Plan,
    certificate: Certificate,
    execution: Execution,
    report: SimulationReport,
}

impl Known {
    fn subject(&self) -> Subject<'_> {
        let subject = Subject::new(&self.plan, self.job.arm()).unwrap();
        let mut subject = subject
            .proved(&self.certificate)
            .executed(&self.execution, &self.report)
            .unwrap();
        subject.base_circle_m = Some(0.28);
        subject.region_m = Some(vec![[0.0, -0.38], [0.3, -0.38], [0.3, 0.38], [0.0, 0.38]]);
        subject
    }
}

static KNOWN: LazyLock<Known> = LazyLock::new(|| {
    let job = kitchen()
        .on_plates(vec![kitchen_plate([0.29, 0.11]), kitchen_plate([0.05, -0.34])])
        .unwrap()
        .named("two plates");
    let plan = plan(&job).unwrap().plan;
    let settings = &plan.job.simulation;
    let execution = simulate(&plan, job.arm(), settings).unwrap();
    Known {
        certificate: prove(&plan, job.arm()).unwrap(),
        report: SimulationReport::new(&plan, job.arm(), settings, &execution).unwrap(),
        job,
        plan,
        execution,
    }
});

/// Texts keep within the sheet, and off each other.
#[track_caller]
fn assert_readable(drawing: &Drawing, name: &str) {
    let sheet = Rect {
        at: [0.0; 2],
        size: SIZE,
    };
    let texts = drawing.texts();
    assert!(texts.len() > 5, "{name}: {} texts", texts.len());
    for (k, text) in texts.iter().enumerate() {
        assert!(
            sheet.holds(&text.bounds),
            "{name}: \"{}\" at {:?}",
            text.words,
            text.bounds
        );
        // Lines may touch, letters may not: their heights are less than those of lines.
        let letters = |rect: Rect| {
            Rect::new(
                rect.at[0],
                rect.at[1] + 0.25 * rect.size[1],
                rect.size[0],
                0.45 * rect.size[1],
            )
        };
        let other = texts[..k]
            .iter()
            .find(|other| letters(other.bounds).meets(&letters(text.bounds)));
        assert_eq!(other.map(|other| (&other.words, &text.words)), None, "{name}");
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
    let subject = KNOWN.subject();
    for figure in Figure::ALL {
        let drawing = drawing(&subject, figure, Some(3.0)).unwrap();
        assert_readable(&drawing, figure.name());
    }
}

#[test]
fn a_hostile_name_is_text_and_keeps_within_the_sheet() {
    let mut plan = KNOWN.plan.clone();
    plan.provenance.scenario = "</title><script>\"&\u{202e}\u{7}\n".repeat(400);
    let subject = Subject::new(&plan, KNOWN.job.arm()).unwrap();
    for figure in [Figure::Layout, Figure::Cleaning, Figure::Joints, Figure::Spiral] {
        let drawing = drawing(&subject, figure, None).unwrap();
        let sheet = Rect {
            at: [0.0; 2],
            size: SIZE,
        };
        assert!(drawing.texts().iter().all(|text| sheet.holds(&text.bounds)));
        let svg = draw(&subject, figure, None).unwrap().svg;
        assert!(!svg.contains("<script"), "{figure:?}");
        assert!(svg.chars().all(|c| !c.is_control() || c == '\n'), "{figure:?}");
        ink::png::png(&svg).unwrap();
    }
}

#[test]
fn the_layout_has_the_plans_wash_paths_and_transits() {
    let subject = KNOWN.subject();
    let svg = draw(&subject, Figure::Layout, None).unwrap().svg;
    let group = |name: &str| {
        let from = svg.find(&format!("<g id=\"{name}\">")).unwrap();
        &svg[from..from + svg[from..].find("</g>").unwrap()]
    };
    let paths = |group: &str| -> Vec<Vec<[f64; 2]>> {
        let all = group.split(" d=\"").skip(1);
        all.map(|path| points(path.split('"').next().unwrap())).collect()
    };
    let washes = paths(group("washes"));
    assert_eq!(washes.len(), 2);
    // Each way is drawn on white, and has an arrow.
    assert_eq!(paths(group("transits")).len(), 3 * 3);
    // Seen from above: a similarity that turns a quarter takes the plan's places to the drawing's.
    let ends = |wash: &[[f64; 2]]| [wash[0], wash[wash.len() - 1]];
    let drawn: Vec<[f64; 2]> = washes.iter().flat_map(|wash| ends(wash)).collect();
    let planned: Vec<Vector3<f64>> = subject
        .washes()
        .flat_map(|(segment, _)| {
            let way = subject.planned.way(segment);
            [way[0], way[way.len() - 1]]
        })
        .collect();
    let scale = |a: usize, b: usize| {
        let (p, q) = (drawn[a], drawn[b]);
        let pixels = ((p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2)).sqrt();
        pixels / (planned[a] - planned[b]).xy().norm()
    };
    for (a, b) in [(0, 1), (0, 2), (1, 3)] {
        assert!((scale(a, b) / scale(2, 3) - 1.0).abs() < 1e-3, "{a} {b}");
    }
    // x of the world is up, y to the left.
    let (from, to) = (planned[0], planned[2]);
    assert_eq!((drawn[0][1] - drawn[2][1]) > 0.0, to.x > from.x);
    assert_eq!((drawn[0][0] - drawn[2][0]) > 0.0, to.y > from.y);
}

#[test]
fn the_spiral_that_is_drawn_is_the_wash_path() {
    let subject = KNOWN.subject();
    for ideal in &subject.ideal {
        let plate = &subject.plan.job.plates[ideal.plate];
        let path = subject.plan.wash_path_of(ideal.plate).unwrap();
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
        let (segment, _) = subject.washes().find(|(_, wash)| wash.plate == ideal.plate).unwrap();
        for point in subject.planned.within(segment) {
            let near = ideal.points.iter().map(|at| (at - point.at).norm()).fold(1.0, f64::min);
            assert!(near < 5e-3, "{near} m at {} s", point.t_s);
        }
    }
}

#[test]
fn the_same_plan_gives_the_same_bytes_for_every_number_of_threads() {
    let subject = KNOWN.subject();
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let all = [Figure::Cleaning, Figure::Joints, Figure::Coverage];
            all.map(|figure| draw(&subject, figure, None).unwrap().svg)
        })
    };
    assert_eq!(with(1), with(3));
    let sheet = draw_flow();
    assert_eq!(sheet.png().unwrap(), sheet.png().unwrap());
}

#[test]
fn a_picture_has_the_size_of_its_drawing_and_its_colours() {
    let png = draw(&KNOWN.subject(), Figure::Layout, None).unwrap().png().unwrap();
    let picture = resvg::tiny_skia::Pixmap::decode_png(&png).unwrap();
    assert_eq!([f64::from(picture.width()), f64::from(picture.height())], SIZE);
    let is_magenta = |p: &&resvg::tiny_skia::PremultipliedColorU8| (p.red(), p.green(), p.blue()) == (0xc2, 0x18, 0x7f);
    assert!(picture.pixels().iter().filter(is_magenta).count() > 1000);
}

#[test]
fn what_cannot_be_drawn_is_said() {
    let known = &*KNOWN;
    let subject = known.subject();
    let said = |figure, at_s| draw(&subject, figure, at_s).unwrap_err().to_string();
    assert!(said(Figure::Moment, None).contains("--at"));
    for at_s in [-1.0, 1e9, f64::NAN, f64::INFINITY] {
        assert!(said(Figure::Moment, Some(at_s)).contains("lasts from 0"), "{at_s}");
    }
    assert!(
        Figure::named("layuot")
            .unwrap_err()
            .to_string()
            .contains("layout, cleaning")
    );
    let refused = |change: &dyn Fn(&mut Plan)| {
        let mut plan = known.plan.clone();
        change(&mut plan);
        Subject::new(&plan, known.job.arm()).map(|_| ()).unwrap_err()
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
    let subject = Subject::new(&plan, known.job.arm()).unwrap();
    for figure in [Figure::Cleaning, Figure::Coverage, Figure::Spiral, Figure::Sheet] {
        assert!(
            draw(&subject, figure, None).unwrap_err().is_of_one_figure(),
            "{figure:?}"
        );
    }
    draw(&subject, Figure::Layout, None).unwrap();
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
    let subject = Subject::new(&plan, KNOWN.job.arm()).unwrap();
    for figure in [Figure::Layout, Figure::Spiral, Figure::Coverage, Figure::Joints] {
        assert_readable(&drawing(&subject, figure, None).unwrap(), figure.name());
    }
}
