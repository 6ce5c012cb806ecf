//! Good plates are accepted whatever their triangles: profiles by numbers of segments, steps, placements and units.

use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use platewash_scenario::measured::*;
use platewash_workcell::surface::{SHIPPED_PROFILES, Surface};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, TAU};

type Triangle = [Point3<f64>; 3];

/// Face of a plate: its half section from the pole to the rim, and where its knots are.
struct Shape {
    name: &'static str,
    rim_m: f64,
    height_m: Box<dyn Fn(f64) -> f64>,
    knots_m: Vec<f64>,
    /// Radius of a lip that rolls down behind the rim \[m\].
    roll_m: f64,
}

fn shapes() -> Vec<Shape> {
    let shipped = SHIPPED_PROFILES.into_iter().map(|name| {
        let surface = Surface::shipped(name).unwrap();
        Shape {
            name,
            rim_m: surface.rim_m(),
            height_m: Box::new(move |rho| surface.height_m(rho)),
            knots_m: Vec::new(),
            roll_m: 0.0,
        }
    });
    let flat = Shape {
        name: "flat",
        rim_m: 0.13,
        height_m: Box::new(|_| 0.0),
        knots_m: Vec::new(),
        roll_m: 0.0,
    };
    let rolled = Shape {
        name: "rolled rim",
        rim_m: 0.13,
        height_m: Box::new(|rho| 0.2 * rho * rho / 0.13),
        knots_m: Vec::new(),
        roll_m: 2e-3,
    };
    let well = Shape {
        name: "well and cone",
        rim_m: 0.125,
        height_m: Box::new(|rho| (rho - 0.075_f64).max(0.0) * 15.6_f64.to_radians().tan()),
        knots_m: vec![0.075],
        roll_m: 0.0,
    };
    [flat, rolled, well].into_iter().chain(shipped).collect()
}

impl Shape {
    /// The half section of the whole plate, about `step_m` apart; a step of 0 has its knots alone.
    fn outline(&self, step_m: f64) -> Vec<[f64; 2]> {
        let mut radii = vec![0.0];
        for end in self.knots_m.iter().copied().chain([self.rim_m]) {
            let from = radii[radii.len() - 1];
            let parts = if step_m > 0.0 {
                ((end - from) / step_m).ceil() as usize
            } else {
                1
            };
            radii.extend((1..=parts).map(|k| from + (end - from) * k as f64 / parts as f64));
        }
        let mut points: Vec<[f64; 2]> = radii.iter().map(|rho| [*rho, (self.height_m)(*rho)]).collect();
        if self.roll_m > 0.0 {
            let lean = (0.4_f64).atan();
            let centre = [
                self.rim_m + self.roll_m * lean.sin(),
                (self.height_m)(self.rim_m) - self.roll_m * lean.cos(),
            ];
            points.extend((1..=16).map(|k| {
                let (s, c) = (FRAC_PI_2 + lean - (FRAC_PI_2 + FRAC_PI_2) * f64::from(k) / 16.0).sin_cos();
                [centre[0] + self.roll_m * c, centre[1] + self.roll_m * s]
            }));
        }
        let thickness_m = 0.004_f64.max(2.0 * self.roll_m);
        points.extend(
            radii
                .iter()
                .rev()
                .map(|rho| [*rho * 0.999, (self.height_m)(*rho) - thickness_m]),
        );
        points
    }

    /// Mesh of the plate with its seam closed by corners that differ by rounding alone.
    fn mesh(&self, segments: usize, step_m: f64) -> Vec<Triangle> {
        let at = |k: usize, [rho, z]: [f64; 2]| {
            let (s, c) = (TAU * k as f64 / segments as f64).sin_cos();
            Point3::new(rho * c, rho * s, z)
        };
        let mut mesh = Vec::new();
        for pair in self.outline(step_m).windows(2) {
            for k in 0..segments {
                let [a, b, c, d] = [at(k, pair[0]), at(k, pair[1]), at(k + 1, pair[1]), at(k + 1, pair[0])];
                mesh.extend([[a, b, c], [a, c, d]].into_iter().filter(|t| {
                    let apart = |a: &Point3<f64>, b: &Point3<f64>| (a - b).norm() > 1e-9;
                    apart(&t[0], &t[1]) && apart(&t[1], &t[2]) && apart(&t[2], &t[0])
                }));
            }
        }
        mesh
    }

    /// True if the rim has eight corners and the message states its least and its greatest radius, but for a ring of the grid.
    fn is_octagon(&self, segments: usize, [least, most]: [f64; 2]) -> bool {
        let (_, c) = (TAU / 16.0).sin_cos();
        segments == 8 && (least - c * self.rim_m).abs() < 2.5e-3 && (most - self.rim_m).abs() < 2e-3
    }

    /// Half of the range of the facets' heights over the face, from chords across segments and along steps \[m\].
    fn allowed_m(&self, segments: usize, step_m: f64) -> f64 {
        let outline = self.outline(step_m);
        let [mut high, mut low] = [0.0_f64; 2];
        for pair in outline
            .windows(2)
            .take_while(|pair| pair[1][0] > pair[0][0] && pair[1][0] <= self.rim_m + 1e-12)
        {
            for radial in 0..=16 {
                let share = f64::from(radial) / 16.0;
                let [rho, z] = [0, 1].map(|i| pair[0][i] + (pair[1][i] - pair[0][i]) * share);
                for around in 0..=4 {
                    let (_, c) = (TAU / segments as f64 * f64::from(around) / 8.0).sin_cos();
                    let (_, most) = (0.5 * TAU / segments as f64).sin_cos();
                    // On a chord between two corners at this radius, from its middle to its end.
                    let at = rho * most / c;
                    let off = z - (self.height_m)(at);
                    (high, low) = (high.max(off), low.min(off));
                }
            }
        }
        // Behind the edge of the face the roll reaches farther out, by 0.3 of its radius.
        0.5 * (high - low) + 0.3 * self.roll_m
    }
}

/// Change of a mesh, triangle by triangle.
type Change = Box<dyn Fn(&Triangle) -> Triangle>;

/// Placements that must not matter: name, change of the mesh in metres, and the unit of the file.
fn changes(seed: u64) -> Vec<(&'static str, Change, Unit)> {
    let mut rng = Pcg64::seed_from_u64(seed);
    let axis = Vector3::from_fn(|_, _| rng.random_range(-1.0..1.0_f64)).normalize() * rng.random_range(0.2..3.0);
    let by = Isometry3::from_parts(
        Translation3::new(0.31, -0.2, 0.05),
        UnitQuaternion::from_scaled_axis(axis),
    );
    fn all(change: impl Fn(&Point3<f64>) -> Point3<f64> + 'static) -> Change {
        Box::new(move |t: &Triangle| [0, 1, 2].map(|k| change(&t[k])))
    }
    let jitter: Change = Box::new(move |t: &Triangle| {
        let mut k = 0_u64;
        t.map(|p| {
            k += 1;
            let bits = p.x.to_bits()
                ^ p.y.to_bits().rotate_left(21)
                ^ p.z.to_bits().rotate_left(42)
                ^ t[0].y.to_bits().rotate_left(7)
                ^ t[1].x.to_bits().rotate_left(13)
                ^ k;
            let mut rng = Pcg64::seed_from_u64(bits);
            p + Vector3::from_fn(|_, _| rng.random_range(-1.2e-10..1.2e-10))
        })
    });
    vec![
        ("plain", all(|p| *p), Unit::Metre),
        ("moved", all(|p| p + Vector3::new(0.1234567, -0.71, 0.333)), Unit::Metre),
        ("turned", all(move |p| by * p), Unit::Metre),
        ("mm", all(|p| Point3::from(p.coords * 1e3)), Unit::Millimetre),
        ("inch", all(|p| Point3::from(p.coords / 0.0254)), Unit::Inch),
        ("mirrored", all(|p| Point3::new(-p.x, p.y, p.z)), Unit::Metre),
        ("jittered", jitter, Unit::Metre),
    ]
}

/// Answer of a cell of the matrix.
fn judged(
    shape: &Shape,
    segments: usize,
    step_m: f64,
    (change, unit): (&dyn Fn(&Triangle) -> Triangle, Unit),
    side: Option<FaceSide>,
) -> Result<MeasuredPlate, MeasuredError> {
    let mesh: Vec<_> = shape.mesh(segments, step_m).iter().map(change).collect();
    from_mesh(&mesh, Some(unit), side)
}

fn matrix(segments: &[usize], steps_mm: &[f64], only: &[&str]) -> (BTreeMap<String, usize>, Vec<String>) {
    let (mut counts, mut faults) = (BTreeMap::new(), Vec::new());
    for shape in shapes() {
        for &around in segments {
            for &step_mm in steps_mm {
                let step_m = 1e-3 * step_mm;
                let allowed_m = shape.allowed_m(around, step_m);
                for (k, (name, change, unit)) in changes(around as u64)
                    .iter()
                    .enumerate()
                    .filter(|(_, (name, ..))| only.is_empty() || only.contains(name))
                {
                    // A flat plate does not tell its side where it is turned.
                    let side = (shape.name == "flat" && k == 2).then(|| {
                        let up = change(&[Point3::origin(), Point3::new(0.0, 0.0, 1.0), Point3::origin()]);
                        let axis = up[1] - up[0];
                        let at = (0..3).max_by(|a, b| axis[*a].abs().total_cmp(&axis[*b].abs())).unwrap();
                        match (at, axis[at] > 0.0) {
                            (0, true) => FaceSide::PlusX,
                            (0, false) => FaceSide::MinusX,
                            (1, true) => FaceSide::PlusY,
                            (1, false) => FaceSide::MinusY,
                            (_, true) => FaceSide::PlusZ,
                            (_, false) => FaceSide::MinusZ,
                        }
                    });
                    let cell = format!("{}, {around} segments, {step_mm} mm, {name}", shape.name);
                    let answer = judged(&shape, around, step_m, (change, *unit), side);
                    let verdict = match &answer {
                        Ok(found) if found.deviation_m <= allowed_m + 1e-4 => "accepted".to_owned(),
                        Ok(found) => {
                            faults.push(format!(
                                "{cell}: deviation {:.3} mm, allowed {:.3} mm",
                                1e3 * found.deviation_m,
                                1e3 * allowed_m
                            ));
                            "accepted, off".to_owned()
                        }
                        // Of eight corners, the rim is an octagon.
                        Err(MeasuredError::NotRound {
                            rim_m: [least, most], ..
                        }) if shape.is_octagon(around, [*least, *most]) => "refused: an octagon".to_owned(),
                        Err(why) if allowed_m + 1e-4 > 2e-3 => format!("refused, coarse: {}", kind(why)),
                        Err(why) => {
                            faults.push(format!("{cell}: {why} (allowed {:.3} mm)", 1e3 * allowed_m));
                            format!("refused: {}", kind(why))
                        }
                    };
                    *counts.entry(format!("{}: {verdict}", shape.name)).or_insert(0) += 1;
                }
            }
        }
    }
    (counts, faults)
}

fn kind(why: &MeasuredError) -> String {
    let debug = format!("{why:?}");
    debug.split([' ', '{', '(']).next().unwrap_or_default().to_owned()
}

/// All of the matrix; `cargo test --release -p platewash-scenario matrix -- --ignored --nocapture` prints it.
#[test]
#[ignore = "half an hour"]
fn good_plates_are_accepted_whatever_their_triangles_all() {
    let (counts, faults) = matrix(
        &[8, 12, 23, 24, 36, 48, 90, 120, 180, 360],
        &[0.0, 1.0, 2.0, 3.0, 5.0, 8.0, 10.0, 15.0, 20.0],
        &[],
    );
    faults.iter().for_each(|fault| println!("{fault}"));
    counts.iter().for_each(|(cell, count)| println!("{count:5} {cell}"));
    assert_eq!(faults.len(), 0);
}

/// A part of it: corners on grid lines and in sectors' borders, seams of rounded corners, cell borders, units, a mirror image, jitter.
#[test]
fn good_plates_are_accepted_wherever_they_lie_and_in_every_unit() {
    let (counts, faults) = matrix(&[24], &[8.0], &[]);
    assert!(faults.is_empty(), "{faults:#?}");
    let accepted = counts.iter().filter(|(cell, _)| cell.ends_with(": accepted"));
    assert_eq!(accepted.map(|(_, count)| count).sum::<usize>(), 49, "{counts:?}");
}

/// Another part: few and many segments, corners at the profile's knots alone, far apart and nearer.
#[test]
fn good_plates_are_accepted_whatever_their_triangles() {
    let (counts, faults) = matrix(&[8, 12, 90, 180], &[0.0, 5.0, 20.0], &["jittered"]);
    assert!(faults.is_empty(), "{faults:#?} {counts:#?}");
}

/// A drawing as CAD programs write it: corners at the knots of the profile alone.
#[test]
fn a_drawing_with_corners_at_its_knots_alone_is_accepted() {
    let all = shapes();
    let well = all.iter().find(|shape| shape.name == "well and cone").unwrap();
    let mesh = well.mesh(120, 0.0);
    let found = from_mesh(&mesh, Some(Unit::Metre), None).unwrap();
    assert!(found.deviation_m < 3e-4, "{}", found.deviation_m);
    let off = |rho: f64| (found.surface.height_m(rho) - (well.height_m)(rho)).abs();
    assert!([0.03, 0.06, 0.09, 0.12].into_iter().all(|rho| off(rho) < 4e-4));
}
