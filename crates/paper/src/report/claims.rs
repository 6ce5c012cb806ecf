//! What the paper takes for granted, beside what a run of its program measured.

use super::contents::PaperReport;
use super::nearness::ClosestApproach;
use crate::run::PaperRun;
use crate::tracking::Step;
use platewash_workcell::segment::SegmentKind;

/// Something that the paper takes for granted, and what came of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PaperClaim {
    /// What it is about.
    pub about: &'static str,
    /// What the paper takes for granted.
    pub claimed: String,
    /// What was measured.
    pub measured: String,
    /// Whether it holds.
    pub holds: bool,
}

impl PaperReport {
    /// What the paper takes for granted, beside what this run of its program measured.
    #[must_use]
    pub fn claims(&self, run: &PaperRun) -> Vec<PaperClaim> {
        vec![
            self.plates_apart(run),
            self.points_reached(),
            self.transits_reached(),
            self.free_of_contact(),
            self.followed(run),
            self.radius_kept(run),
            self.within_speeds(),
            self.smooth(),
            self.covered_if_followed(),
            self.covered(),
            self.sponge_on_plate(),
        ]
    }

    fn plates_apart(&self, run: &PaperRun) -> PaperClaim {
        let plates = &run.job.layout.plates;
        let gaps = plates.iter().enumerate().flat_map(|(k, a)| {
            plates[..k].iter().map(|b| {
                let [ax, ay] = a.centre_xy();
                let [bx, by] = b.centre_xy();
                let (dx, dy) = (ax - bx, ay - by);
                (dx * dx + dy * dy).sqrt() - a.rim_m() - b.rim_m()
            })
        });
        let gaps: Vec<f64> = gaps.collect();
        let overlaps = gaps.iter().filter(|gap| **gap < 0.0).count();
        let least = gaps.into_iter().fold(f64::INFINITY, f64::min);
        let measured = match overlaps {
            _ if least.is_infinite() => "there is one plate".to_owned(),
            0 => format!("none overlap; {:.0} mm between the nearest", 1e3 * least),
            1 => format!("1 pair overlaps, by {:.1} mm", -1e3 * least),
            pairs => format!("{pairs} pairs overlap, by up to {:.1} mm", -1e3 * least),
        };
        PaperClaim {
            about: "plates lie apart",
            claimed: "centres farther apart than 0.28 m do".to_owned(),
            measured,
            holds: overlaps == 0,
        }
    }

    fn points_reached(&self) -> PaperClaim {
        let sum = |of: fn(&super::plate::PlateReport) -> usize| self.plates.iter().map(of).sum::<usize>();
        let (reached, all) = (sum(|p| p.reached), sum(|p| p.waypoints));
        let claimed = format!("all {all}");
        reach("points of spirals are reached", claimed, reached, all)
    }

    fn transits_reached(&self) -> PaperClaim {
        let (reached, all) = (self.transits.reached, self.transits.waypoints);
        let claimed = format!("all {all}");
        reach("points of transitions are reached", claimed, reached, all)
    }

    fn free_of_contact(&self) -> PaperClaim {
        let of_plates = self.plates.iter();
        let all = of_plates.flat_map(|plate| [&plate.planned_clearance, &plate.executed_clearance]);
        let of_transits = [&self.transits.planned_clearance, &self.transits.executed_clearance];
        let all = all.chain(of_transits).flatten();
        let nearest = all.min_by(|a, b| a.pair.distance_m.total_cmp(&b.pair.distance_m));
        let holds = nearest.is_none_or(|near| near.pair.distance_m > 0.0);
        PaperClaim {
            about: "the arm touches nothing",
            claimed: "never asked".to_owned(),
            measured: nearest.map_or_else(|| "no pair was checked".to_owned(), nearness),
            holds,
        }
    }

    fn followed(&self, run: &PaperRun) -> PaperClaim {
        // The first one starts from afar.
        let later = run.tool_path.order.first().copied();
        let steps = run.steps.iter().filter(|step| {
            let segment = &run.tool_path.segments[step.segment];
            segment.kind == SegmentKind::Wash && Some(segment.plate) != later
        });
        let squares: Vec<f64> = steps
            .map(|step| (step.executed_tip - step.target).norm_squared())
            .collect();
        let rms = (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt();
        let most = squares.iter().copied().fold(0.0, f64::max).sqrt();
        PaperClaim {
            about: "the control law follows the spirals",
            claimed: "Kp = 20, Kd = 0.1 suffice".to_owned(),
            measured: format!(
                "off by {:.0} mm rms, {:.0} mm at most, from the 2nd on",
                1e3 * rms,
                1e3 * most
            ),
            holds: most < 1e-3,
        }
    }

    fn radius_kept(&self, run: &PaperRun) -> PaperClaim {
        let wanted = run.job.settings.spiral.radius_m;
        let of_plate = |plate: usize| {
            let centre = run.job.layout.plates[plate].centre();
            let here = |step: &&Step| {
                let segment = &run.tool_path.segments[step.segment];
                segment.kind == SegmentKind::Wash && segment.plate == plate
            };
            let out = run
                .steps
                .iter()
                .filter(here)
                .map(|step| (step.executed_tip - centre).xy().norm());
            out.fold(0.0, f64::max)
        };
        // The first one starts from afar.
        let radii: Vec<f64> = run
            .tool_path
            .order
            .iter()
            .skip(1)
            .map(|&plate| of_plate(plate))
            .collect();
        let least = radii.iter().copied().fold(f64::INFINITY, f64::min);
        let most = radii.iter().copied().fold(0.0, f64::max);
        let measured = if radii.is_empty() {
            "there is one plate".to_owned()
        } else {
            format!("{:.0} to {:.0} mm, from the 2nd on", 1e3 * least, 1e3 * most)
        };
        PaperClaim {
            about: "spirals reach out to",
            claimed: format!("{:.0} mm", 1e3 * wanted),
            measured,
            holds: radii.iter().all(|radius| (radius - wanted).abs() < 1e-3),
        }
    }

    fn within_speeds(&self) -> PaperClaim {
        let most = self.executed.speed_share.amax();
        PaperClaim {
            about: "joints keep their speed limits",
            claimed: "never asked".to_owned(),
            measured: format!("up to {most:.1} times the limit"),
            holds: most <= 1.0,
        }
    }

    fn smooth(&self) -> PaperClaim {
        let most = self.planned.acceleration_share.amax();
        PaperClaim {
            about: "the motion is smooth",
            claimed: "“continuous acceleration”".to_owned(),
            measured: format!("it stops at each waypoint; up to {most:.0} times a joint's limit"),
            holds: most <= 1.0,
        }
    }

    fn covered_if_followed(&self) -> PaperClaim {
        let [least, most] = self.shares(|plate| plate.ideal_coverage.fraction);
        PaperClaim {
            about: "coverage, were the spirals followed",
            claimed: "the spiral covers them".to_owned(),
            measured: format!(
                "{} by a sponge of {:.0} mm",
                between(least, most),
                1e3 * self.sponge_radius_m
            ),
            holds: least >= self.coverage_required,
        }
    }

    fn covered(&self) -> PaperClaim {
        let [least, most] = self.shares(|plate| plate.executed_coverage.fraction);
        PaperClaim {
            about: "coverage",
            claimed: "they are clean".to_owned(),
            measured: between(least, most),
            holds: least >= self.coverage_required,
        }
    }

    fn sponge_on_plate(&self) -> PaperClaim {
        let all: usize = self.plates.iter().map(|plate| plate.waypoints).sum();
        let on: usize = self.plates.iter().map(|plate| plate.in_contact).sum();
        PaperClaim {
            about: "the sponge is on the plate",
            claimed: "there is no sponge; the flange hovers".to_owned(),
            measured: format!("at {on} of {all} points"),
            holds: on == all,
        }
    }

    fn shares(&self, of: fn(&super::plate::PlateReport) -> f64) -> [f64; 2] {
        let all = self.plates.iter().map(of);
        all.fold([1.0, 0.0], |[least, most]: [f64; 2], share| {
            [least.min(share), most.max(share)]
        })
    }
}

fn reach(about: &'static str, claimed: String, reached: usize, all: usize) -> PaperClaim {
    PaperClaim {
        about,
        claimed,
        measured: format!("{reached} of {all}"),
        holds: reached == all,
    }
}

fn nearness(near: &ClosestApproach) -> String {
    let (a, b, distance) = (&near.pair.a, &near.pair.b, 1e3 * near.pair.distance_m);
    if distance > 0.0 {
        format!("{a} and {b} come within {distance:.0} mm")
    } else {
        format!("{a} goes into {b}")
    }
}

/// Two shares as per cent, one where they look alike.
fn between(least: f64, most: f64) -> String {
    let [least, most] = [least, most].map(|share| format!("{:.1} %", 100.0 * share));
    if least == most {
        least
    } else {
        format!("{least} to {most}")
    }
}
