//! Findings of a run that no figure shows.

use super::waypoints::PlateReport;
use crate::cubic::Interpolation;
use crate::run::PaperRun;
use platewash_motion::trajectory::SegmentKind;
use platewash_workcell::layout;
use serde::Serialize;
use std::fmt::{self, Display, Formatter};

/// Something worth knowing that no figure shows.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[non_exhaustive]
pub enum PaperFinding {
    /// About the plates.
    Layout {
        /// The finding.
        finding: layout::Finding,
    },
    /// The first waypoint is commanded from where the arm stands, without an approach.
    NoApproach {
        /// Tip position that the program believes in (base frame, m).
        believed_m: [f64; 3],
        /// True tip position (base frame, m).
        tip_m: [f64; 3],
        /// Distance of the first waypoint from the tip \[m\].
        distance_m: f64,
    },
    /// Cubics at rest at every waypoint: acceleration jumps there.
    StopsAtWaypoints {
        /// Waypoints of each transit.
        waypoints: usize,
    },
    /// The sponge is not on the plates while it should wash them.
    NoContact {
        /// Washing waypoints without contact.
        waypoints: usize,
        /// Washing waypoints in all.
        of: usize,
        /// True where there is a tool body at all.
        tool: bool,
    },
    /// Links without collision geometry, which nothing checks.
    Unchecked {
        /// Their names.
        links: Vec<String>,
    },
}

/// A first waypoint nearer than this needs no approach \[m\].
const APPROACHED_M: f64 = 1e-3;

pub(super) fn findings(run: &PaperRun, plates: &[PlateReport]) -> Vec<PaperFinding> {
    let of_layout = run.job.layout.findings.iter().cloned();
    let mut findings: Vec<_> = of_layout.map(|finding| PaperFinding::Layout { finding }).collect();
    findings.extend(no_approach(run));
    findings.extend(stops_at_waypoints(run));
    findings.extend(no_contact(run, plates));
    let links: Vec<_> = run.job.arm.links_without_shapes().map(str::to_owned).collect();
    if !links.is_empty() {
        findings.push(PaperFinding::Unchecked { links });
    }
    findings
}

fn no_approach(run: &PaperRun) -> Option<PaperFinding> {
    let (start, first) = (run.planned.positions().first()?, run.steps.first()?);
    let tip = run.job.workcell.tool.tip_frame(&run.job.arm);
    let tip = run.job.arm.fk(start).rigid(&tip).translation;
    let distance_m = (tip - first.target).norm();
    (distance_m > APPROACHED_M).then(|| PaperFinding::NoApproach {
        believed_m: [0.0; 3],
        tip_m: tip.into(),
        distance_m,
    })
}

fn stops_at_waypoints(run: &PaperRun) -> Option<PaperFinding> {
    let settings = &run.job.settings;
    let any = run.tool_path.segments.iter().any(|s| s.kind == SegmentKind::Transit);
    let waypoints = settings.arc.points + 2;
    (any && settings.transit.interpolation == Interpolation::ZeroVelocity)
        .then_some(PaperFinding::StopsAtWaypoints { waypoints })
}

fn no_contact(run: &PaperRun, plates: &[PlateReport]) -> Option<PaperFinding> {
    let of: usize = plates.iter().map(|p| p.waypoints).sum();
    let waypoints = of - plates.iter().map(|p| p.in_contact).sum::<usize>();
    let tool = run.job.workcell.tool.is_present();
    (waypoints > 0).then_some(PaperFinding::NoContact { waypoints, of, tool })
}

impl Display for PaperFinding {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let mm = |p: &[f64; 3]| format!("({:.0}, {:.0}, {:.0}) mm", 1e3 * p[0], 1e3 * p[1], 1e3 * p[2]);
        match self {
            Self::Layout { finding } => write!(f, "{finding}"),
            Self::NoApproach {
                believed_m,
                tip_m,
                distance_m,
            } => write!(
                f,
                "no approach: the program believes to start at {}; the tip is at {}, {:.0} mm from the first waypoint, \
                 which is commanded at once",
                mm(believed_m),
                mm(tip_m),
                1e3 * distance_m
            ),
            Self::StopsAtWaypoints { waypoints } => write!(
                f,
                "each transition stops at all of its {waypoints} waypoints (zero-velocity cubics): acceleration is not continuous"
            ),
            Self::NoContact { waypoints, of, tool } => {
                let why = if *tool {
                    ""
                } else {
                    " (there is no tool body: the flange hovers)"
                };
                write!(
                    f,
                    "the sponge is off the plate at {waypoints} of {of} washing waypoints{why}; coverage is what it would sweep"
                )
            }
            Self::Unchecked { links } => {
                write!(f, "no collision geometry, so nothing is checked: {}", links.join(", "))
            }
        }
    }
}
