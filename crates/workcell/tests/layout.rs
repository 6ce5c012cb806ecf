use platewash_workcell::surface::Surface;
use rand::SeedableRng;
use rand_pcg::Pcg64;

use platewash_workcell::layout::*;
use platewash_workcell::plate::{Plate, PlateTerms};

const GEOMETRY: PlateGeometry = PlateGeometry {
    surface: Surface::Disc { radius_m: 0.145 },
    height_m: 0.03,
    thickness_m: 0.02,
    foot: None,
    terms: PlateTerms {
        height_error_m: None,
        deviation_m: None,
        measured: None,
        soil: None,
    },
};
const SPACING: Spacing = Spacing {
    min_distance_m: 0.28,
    base_radius_m: 0.25,
};
const BASE: BaseFootprint = BaseFootprint {
    x_m: [-0.09, 0.09],
    y_m: [-0.09, 0.09],
};

fn request(region: Region, count: usize) -> SampleRequest {
    SampleRequest {
        region,
        spacing: SPACING,
        count,
        geometry: GEOMETRY,
        base: Some(BASE),
    }
}

fn square(side: f64) -> Region {
    Region {
        x_m: [0.0, side],
        y_m: [0.0, side],
        rho_m: None,
        azimuth_deg: None,
    }
}

fn draw(request: &SampleRequest, seed: u64) -> Result<Layout, LayoutError> {
    sample(request, &mut Pcg64::seed_from_u64(seed))
}

fn centres(layout: &Layout) -> Vec<[f64; 2]> {
    layout.plates.iter().map(Plate::centre_xy).collect()
}

fn explicit(positions_m: &[[f64; 2]], region: Option<&Region>) -> Layout {
    check_explicit(positions_m, region, &SPACING, &GEOMETRY, Some(&BASE)).unwrap()
}

fn invalid(key: &'static str, problem: InputProblem) -> LayoutError {
    LayoutError::InvalidInput { key, problem }
}

#[test]
fn a_seed_gives_one_layout_which_keeps_the_rules() {
    for seed in 0..200 {
        let request = request(Region::PAPER_TEXT, 4);
        let layout = draw(&request, seed).unwrap();
        assert_eq!(layout, draw(&request, seed).unwrap());
        assert_ne!(layout.plates, draw(&request, seed + 1).unwrap().plates);
        let again = explicit(&centres(&layout), Some(&Region::PAPER_TEXT));
        assert_eq!((&again.plates, &again.findings), (&layout.plates, &layout.findings));
        let plate = layout.plates[3];
        assert_eq!(
            (plate.centre().z, plate.rim_m(), plate.thickness_m),
            (0.03, 0.145, 0.02)
        );
    }
}

#[test]
fn the_papers_layouts_overlap_as_often_as_measured() {
    // Plates that overlap in 74 % and 82 %, plates over the base in 5.0 % and 6.3 % of layouts.
    for (region, plates, base) in [(Region::PAPER_TEXT, 74.0, 5.0), (Region::PAPER_APPENDIX, 82.0, 6.3)] {
        let n = 2000;
        let layouts: Vec<Layout> = (0..n).map(|seed| draw(&request(region, 4), seed).unwrap()).collect();
        let percent = |is: &dyn Fn(&Finding) -> bool| {
            100.0 * layouts.iter().filter(|layout| layout.findings.iter().any(is)).count() as f64 / n as f64
        };
        let found_plates = percent(&|f| matches!(f, Finding::PlatesOverlap { .. }));
        let found_base = percent(&|f| matches!(f, Finding::OverlapsBase { .. }));
        assert!((found_plates - plates).abs() < 6.0, "{found_plates} %, not {plates} %");
        assert!((found_base - base).abs() < 3.0, "{found_base} %, not {base} %");
    }
}

#[test]
fn a_thousand_plates_are_placed() {
    let request = SampleRequest {
        spacing: Spacing {
            min_distance_m: 0.2,
            base_radius_m: 0.25,
        },
        ..request(square(8.0), 1000)
    };
    let layout = draw(&request, 1).unwrap();
    assert_eq!(layout.plates.len(), 1000);
    let again = check_explicit(
        &centres(&layout),
        Some(&request.region),
        &request.spacing,
        &GEOMETRY,
        Some(&BASE),
    )
    .unwrap();
    assert_eq!(again.findings, layout.findings);
    // No spacing at all: any number fits.
    let loose = SampleRequest {
        spacing: Spacing {
            min_distance_m: 0.0,
            base_radius_m: 0.25,
        },
        ..request
    };
    assert_eq!(draw(&loose, 1).unwrap().plates.len(), 1000);
}

#[test]
fn impossible_requests_end_soon() {
    let impossible = draw(&request(Region::PAPER_TEXT, 8), 1);
    let LayoutError::NoRoom {
        most_placed: placed @ 5..7,
        layouts_tried: 100,
        upper_bound: Some(7),
        ..
    } = impossible.clone().unwrap_err()
    else {
        panic!("{impossible:?}")
    };
    assert_eq!(
        impossible.unwrap_err().to_string(),
        format!(
            "8 plates cannot fit: the best of 100 random layouts held {placed} before no room was left; by area no \
             arrangement holds more than 7 at this spacing"
        )
    );
    let LayoutError::NoRoom {
        count,
        most_placed,
        layouts_tried,
        upper_bound,
    } = draw(&request(Region::PAPER_TEXT, 7), 1).unwrap_err()
    else {
        unreachable!()
    };
    assert_eq!((count, layouts_tried, upper_bound), (7, 1001, Some(7)));
    assert!((5..7).contains(&most_placed));
    // More than random order can hold, less than Oler's bound: steps run out before restarts do.
    let crowded = SampleRequest {
        spacing: Spacing {
            min_distance_m: 0.2,
            base_radius_m: 0.25,
        },
        ..request(square(6.7), 1000)
    };
    let LayoutError::NoRoom {
        most_placed,
        layouts_tried,
        ..
    } = draw(&crowded, 1).unwrap_err()
    else {
        unreachable!()
    };
    assert!(
        (700..1000).contains(&most_placed) && layouts_tried < 1001,
        "{most_placed} {layouts_tried}"
    );
}

#[test]
fn empty_regions_say_why() {
    let within = |base_radius_m| LayoutError::EmptyRegion {
        reason: EmptyReason::WithinBase { base_radius_m },
    };
    let disjoint = LayoutError::EmptyRegion {
        reason: EmptyReason::Disjoint,
    };
    let too_thin = LayoutError::EmptyRegion {
        reason: EmptyReason::TooThin,
    };
    let error = |region| draw(&request(region, 1), 1).unwrap_err();
    let small = Region {
        x_m: [0.0, 0.1],
        y_m: [-0.1, 0.1],
        ..square(1.0)
    };
    assert_eq!(error(small), within(0.25));
    assert_eq!(
        error(Region {
            x_m: [-1.0, 1.0],
            y_m: [-1.0, 1.0],
            rho_m: Some([0.1, 0.25]),
            azimuth_deg: None
        }),
        within(0.25)
    );
    assert_eq!(
        error(Region {
            rho_m: Some([1.5, 2.0]),
            ..square(1.0)
        }),
        disjoint
    );
    assert_eq!(
        error(Region {
            rho_m: Some([0.5, 1.0]),
            x_m: [2.0, 3.0],
            ..square(1.0)
        }),
        disjoint
    );
    // They share one ray only.
    assert_eq!(
        error(Region {
            azimuth_deg: Some([90.0, 180.0]),
            ..square(1.0)
        }),
        too_thin
    );
    assert_eq!(
        error(Region {
            azimuth_deg: Some([100.0, 350.0]),
            ..square(1.0)
        }),
        too_thin
    );
    // A ring that is there, but a tenth of a nanometre wide.
    let ring = |width: f64| Region {
        x_m: [-1.0, 1.0],
        y_m: [-1.0, 1.0],
        rho_m: Some([0.3, 0.3 + width]),
        azimuth_deg: None,
    };
    assert_eq!(error(ring(1e-10)), too_thin);
    assert!(draw(&request(ring(1e-6), 1), 1).is_ok());
}

#[test]
fn senseless_numbers_are_refused_by_key() {
    use InputProblem::{MoreThanATurn, Negative, NoWidth, NotFinite, NotPositive, Reversed, TooLarge};
    let good = request(square(1.0), 1);
    let region = |region| SampleRequest { region, ..good };
    let cases = [
        (
            region(Region {
                x_m: [0.3, 0.0],
                ..square(1.0)
            }),
            "x_m",
            Reversed,
        ),
        (
            region(Region {
                y_m: [0.3, 0.3],
                ..square(1.0)
            }),
            "y_m",
            NoWidth,
        ),
        (
            region(Region {
                y_m: [f64::NAN, 0.3],
                ..square(1.0)
            }),
            "y_m",
            NotFinite,
        ),
        (
            region(Region {
                rho_m: Some([-0.1, 0.3]),
                ..square(1.0)
            }),
            "rho_m",
            Negative,
        ),
        (
            region(Region {
                azimuth_deg: Some([-181.0, 180.0]),
                ..square(1.0)
            }),
            "azimuth_deg",
            MoreThanATurn,
        ),
        (
            SampleRequest {
                spacing: Spacing {
                    min_distance_m: -0.1,
                    ..SPACING
                },
                ..good
            },
            "min_distance_m",
            Negative,
        ),
        (
            SampleRequest {
                spacing: Spacing {
                    base_radius_m: f64::INFINITY,
                    ..SPACING
                },
                ..good
            },
            "base_radius_m",
            NotFinite,
        ),
        (
            SampleRequest {
                geometry: PlateGeometry {
                    surface: Surface::Disc { radius_m: 0.0 },
                    ..GEOMETRY
                },
                ..good
            },
            "plate_radius_m",
            NotPositive,
        ),
        (SampleRequest { count: 0, ..good }, "count", NotPositive),
        (SampleRequest { count: 1001, ..good }, "count", TooLarge { max: 1000 }),
    ];
    for (request, key, problem) in cases {
        assert_eq!(draw(&request, 1), Err(invalid(key, problem)));
    }
    let nan = check_explicit(&[[0.0, 0.0], [0.0, f64::NAN]], None, &SPACING, &GEOMETRY, Some(&BASE));
    assert_eq!(nan, Err(LayoutError::InvalidPosition { plate: 1 }));
    assert_eq!(
        invalid("x_m", Reversed).to_string(),
        "x_m is reversed: its first number is greater than its second"
    );
}

#[test]
fn each_broken_rule_is_its_own_finding() {
    let texts = |positions: &[[f64; 2]], region: Option<&Region>| -> Vec<String> {
        explicit(positions, region)
            .findings
            .iter()
            .map(ToString::to_string)
            .collect()
    };
    let region = Region::PAPER_TEXT;
    assert!(texts(&[[0.3, 0.0], [0.3, -0.3]], Some(&region)).is_empty());
    // The rules are strict, and Ø 290 mm plates 285 mm apart overlap without breaking them.
    assert_eq!(
        texts(&[[0.25, 0.0]], Some(&region)),
        ["plate 1 is 250.0 mm from the base axis; the spacing rule wants more than 250.0 mm"]
    );
    assert_eq!(
        texts(&[[0.3, 0.0], [0.3, -0.285]], Some(&region)),
        ["plate 1 and plate 2 overlap by 5.0 mm"]
    );
    assert_eq!(
        texts(&[[0.3, 0.0], [0.3, -0.25]], Some(&region)),
        [
            "plate 1 and plate 2 are 250.0 mm apart; the spacing rule wants more than 280.0 mm",
            "plate 1 and plate 2 overlap by 40.0 mm",
        ]
    );
    let outside = [[0.5, 0.0]];
    assert_eq!(
        texts(&outside, Some(&region)),
        ["plate 1 at x = 500.0 mm, y = 0.0 mm lies outside the region"]
    );
    assert!(texts(&outside, None).is_empty());
    assert_eq!(
        texts(&[[0.0, -0.2]], Some(&region)),
        [
            "plate 1 is 200.0 mm from the base axis; the spacing rule wants more than 250.0 mm",
            "plate 1 overlaps the robot's base by 35.0 mm",
        ]
    );
}

#[test]
fn an_overlap_with_the_base_states_the_way_out() {
    let overlap_m = |centre| match explicit(&[centre], None).findings.last() {
        Some(Finding::OverlapsBase { overlap_m, .. }) => *overlap_m,
        _ => 0.0,
    };
    // Beside an edge, off a corner, and with the centre over the base.
    assert!((overlap_m([0.2, 0.05]) - 0.035).abs() < 1e-15);
    assert!((overlap_m([0.09 + 0.06, 0.09 + 0.08]) - 0.045).abs() < 1e-15);
    assert!((overlap_m([0.07, 0.0]) - 0.165).abs() < 1e-15);
    assert_eq!(overlap_m([0.25, 0.0]), 0.0);
}

#[test]
fn layouts_survive_serialization() {
    let layout = explicit(&[[0.0, -0.2], [0.1, -0.3]], Some(&Region::PAPER_TEXT));
    assert!(layout.findings.len() > 3);
    let text = serde_json::to_string(&layout).unwrap();
    assert_eq!(serde_json::from_str::<Layout>(&text).unwrap(), layout);
    assert!(
        text.contains(r#""kind":"spacing_broken""#) && text.contains(r#""source":{"kind":"explicit"}"#),
        "{text}"
    );
}
