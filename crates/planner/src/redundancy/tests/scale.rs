//! Measurements, not run by default: `cargo test --release -p platewash-planner --lib redundancy -- --ignored --nocapture`.

use crate::redundancy::tests::*;
use platewash_workcell::layout::{BaseFootprint, PlateGeometry, Region, SampleRequest, Spacing, sample};
use platewash_workcell::plate::PlateTerms;
use platewash_workcell::random::stream;
use platewash_workcell::surface::Surface;
use rand::RngExt;
use std::time::{Duration, Instant};

/// Counts of results over many plates.
#[derive(Debug, Default)]
struct Tally {
    gentle: usize,
    other_policy: usize,
    searched: usize,
    failed: usize,
    /// Failures at dead ends of which the exhaustive search finds every one, or not every one, infeasible.
    judged: [usize; 2],
    /// Least distance of the sponge from a plate that it must not touch, and of any other pair \[m\].
    least_m: [f64; 2],
    travel_rad: Vec<f64>,
    times: Vec<Duration>,
    first_failure: Option<String>,
}

impl Tally {
    fn add(&mut self, world: &World<'_>, path: &WashPath) {
        let at = world.placed.plates[path.plate].centre();
        let task = world.task(path);
        let start = Instant::now();
        let answer = washing(&task);
        self.times.push(start.elapsed());
        match answer {
            Ok(washing) => {
                self.travel_rad.push(washing.travel_rad());
                for q in washing.q.iter().step_by(8) {
                    for pair in world.clearance.all(q) {
                        let kind = usize::from(!(pair.a == "sponge" && pair.b.starts_with("plate")));
                        let least = &mut self.least_m[kind];
                        *least = if *least == 0.0 {
                            pair.distance_m
                        } else {
                            least.min(pair.distance_m)
                        };
                    }
                }
                let gentle = TiltPolicy::sloping(
                    path.cone_rad.min(crate::placed_arm::tilt_policy::GENTLE_TILT_RAD),
                    world.placed.distance(&at),
                    path.curve.radius_m,
                );
                match washing.choice {
                    TiltChoice::Policy(policy) if policy == gentle => self.gentle += 1,
                    TiltChoice::Policy(_) => self.other_policy += 1,
                    TiltChoice::Search { .. } => self.searched += 1,
                }
            }
            Err(error) => {
                self.failed += 1;
                let ends = match &error {
                    RedundancyError::NoTilt { ends, .. } => ends.clone(),
                    RedundancyError::Disconnected { end, .. } | RedundancyError::Between { end, .. } => {
                        vec![end.clone()]
                    }
                    _ => Vec::new(),
                };
                let anywhere = |end: &DeadEnd| anywhere(&task, end.theta).unwrap().is_some();
                let feasible = ends.iter().all(anywhere);
                self.judged[usize::from(feasible)] += 1;
                if feasible {
                    println!("   every dead end listed is feasible in some way: {at:?} {error}");
                }
                self.first_failure.get_or_insert_with(|| format!("{at:?}: {error}"));
            }
        }
    }

    fn print(&mut self, name: &str) {
        self.times.sort();
        self.travel_rad.sort_by(f64::total_cmp);
        let quantile = |share: f64| (share * (self.times.len() - 1) as f64) as usize;
        let times = [0.5, 0.95, 1.0].map(|share| self.times[quantile(share)]);
        let travel = [
            self.travel_rad.first(),
            self.travel_rad.get(self.travel_rad.len() / 2),
            self.travel_rad.last(),
        ];
        println!(
            "{name}: {} plates; sloping {}, other policy {}, searched {}, failed {} (arm's own {}, not proven {}); travel {travel:.1?} rad; least distances {:.2?} mm; \
             median, 95 %, longest {times:.1?}; first failure: {:?}",
            self.times.len(),
            self.gentle,
            self.other_policy,
            self.searched,
            self.failed,
            self.judged[0],
            self.judged[1],
            self.least_m.map(|m| 1e3 * m),
            self.first_failure
        );
    }
}

#[test]
#[ignore = "a measurement"]
fn searches_single_plates() {
    for (name, handle_m, radius_m, tilt) in [("ring at 0.12385", 0.02, RADIUS_M, 15.0), ("rim", 0.015, 0.145, 30.0)] {
        let mut tally = Tally::default();
        let tool = straight(0.15, handle_m);
        for azimuth in (-120..=120).step_by(5) {
            for k in 0..=49 {
                let plates = [plate_at(0.25 + 0.005 * f64::from(k), f64::from(azimuth))];
                within(&tool, &plates, |world| tally.add(world, &path(curve(radius_m), tilt)));
            }
        }
        tally.print(name);
    }
}

#[test]
#[ignore = "a measurement"]
fn searches_layouts_of_the_paper() {
    for (name, region) in [("text", Region::PAPER_TEXT), ("appendix", Region::PAPER_APPENDIX)] {
        for min_distance_m in [0.28, 0.30] {
            let mut tally = Tally::default();
            let mut random = stream(1, "posture");
            let request = SampleRequest {
                region,
                spacing: Spacing {
                    min_distance_m,
                    base_radius_m: 0.25,
                },
                count: 4,
                geometry: PlateGeometry {
                    surface: Surface::Disc { radius_m: 0.145 },
                    height_m: 0.03,
                    thickness_m: 0.02,
                    foot: None,
                    terms: PlateTerms::default(),
                },
                base: Some(BaseFootprint {
                    x_m: [-0.2115, 0.0905],
                    y_m: [-0.0905, 0.0905],
                }),
            };
            for _ in 0..200 {
                let plates = sample(&request, &mut random).unwrap().plates;
                within(&kitchen_tool(), &plates, |world| {
                    for plate in 0..plates.len() {
                        let path = path(curve(RADIUS_M), 15.0);
                        tally.add(world, &WashPath { plate, ..path });
                    }
                });
            }
            tally.print(&format!("{name}, spacing {min_distance_m}"));
        }
    }
}

/// Plates and tools of all kinds, many of them beyond the arm's abilities; failures judged by the exhaustive search.
#[test]
#[ignore = "a measurement"]
fn searches_random_plates_and_tools() {
    let mut random = stream(2, "posture");
    let mut tally = Tally::default();
    for _ in 0..400 {
        let mut draw = |[least, most]: [f64; 2]| random.random_range(least..most);
        let plates = [
            plate_at(draw([0.2, 0.58]), draw([-175.0, 175.0])),
            plate_at(draw([0.25, 0.5]), draw([-175.0, 175.0])),
        ];
        let tool = straight(draw([0.04, 0.25]), draw([0.01, 0.025]));
        let path = path(curve(draw([0.03, 0.15])), draw([0.0, 40.0]));
        within(&tool, &plates, |world| tally.add(world, &path));
    }
    tally.print("anything");
}
