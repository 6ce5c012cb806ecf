//! `platewash compare`: two plan files side by side: job, cycle time and proved margins.

use super::failure::ExitCode;
use super::options::Options;
use super::plan_file::PlanFile;
use super::verify::fields_differ;
use anyhow::Result;
use clap::Args;
use platewash::certificate::{Measure, MeasureWords, Requirement, differences, paper_headline};
use platewash::motion::plan::Process;
use platewash::motion::trajectory::{PlanSegment, SegmentKind};
use platewash::workcell::words::{count_with_noun, plate_name, quoted};
use platewash::{Certificate, Plan};
use serde::Serialize;
use std::collections::BTreeSet;
use std::fmt::{self, Display};
use std::path::{Path, PathBuf};

/// Arguments of `compare`.
#[derive(Debug, Args)]
pub struct CompareArguments {
    /// First plan file
    pub a: PathBuf,
    /// Second plan file
    pub b: PathBuf,
}

/// Parts of a cycle, by kinds of segments.
const PARTS: [(&str, &[SegmentKind]); 3] = [
    ("washing", &[SegmentKind::Wash]),
    (
        "down to and up from plates",
        &[SegmentKind::Approach, SegmentKind::Retreat],
    ),
    (
        "between plates, from and to home",
        &[SegmentKind::Depart, SegmentKind::Transit, SegmentKind::Return],
    ),
];

/// Time of some segments; `None` where there are none \[s\].
fn time_s(plan: &Plan, is_of: impl Fn(&PlanSegment) -> bool) -> Option<f64> {
    let segments = plan.segments.iter().filter(|segment| is_of(segment));
    let times = segments.map(|segment| segment.t_end_s - segment.t_start_s);
    times.reduce(|a, b| a + b)
}

/// Two plans, side by side.
#[derive(Debug, Serialize)]
struct Comparison {
    a: Side,
    b: Side,
    /// Fields of the job that differ.
    job: Vec<DifferingField>,
    times: Vec<Times>,
    margins: Vec<Margins>,
}

/// A plan by itself.
#[derive(Debug, Serialize)]
struct Side {
    plan: PathBuf,
    scenario: String,
    seed: u64,
    headline: String,
    proved: bool,
    duration_s: f64,
}

/// A field of the job in which the plans differ, as JSON text.
#[derive(Debug, Serialize)]
struct DifferingField {
    key: String,
    a: String,
    b: String,
}

/// A part of the cycle in both plans; `None` where a plan has none.
#[derive(Debug, Serialize)]
struct Times {
    part: String,
    a_s: Option<f64>,
    b_s: Option<f64>,
}

/// A requirement about a number, as each plan keeps it.
#[derive(Debug, Serialize)]
struct Margins {
    requirement: Requirement,
    a: Option<Measure>,
    b: Option<Measure>,
}

/// Compares two plan files, each for the arm that it is for.
pub fn run(options: &Options, arguments: &CompareArguments) -> Result<ExitCode> {
    let [a, b] = [&arguments.a, &arguments.b].map(|path| PlanWithProof::new(options, path));
    let comparison = Comparison::new(a?, b?);
    options.print(&comparison, || comparison.to_string())?;
    Ok(ExitCode::Done)
}

/// A plan and its certificate; a run of the paper's program has none.
struct PlanWithProof {
    side: Side,
    plan: Plan,
    certificate: Option<Certificate>,
}

impl PlanWithProof {
    fn new(options: &Options, path: &Path) -> Result<Self> {
        let file = PlanFile::read(options, path)?;
        let certificate = match file.plan.process {
            Process::Paper => None,
            Process::Wash => Some(file.prove(options)?),
        };
        let (plan, proof) = (file.plan, certificate.as_ref());
        let side = Side {
            plan: path.to_owned(),
            scenario: plan.provenance.scenario.clone(),
            seed: plan.job.seed,
            headline: proof.map_or_else(|| paper_headline(&plan), |proof| proof.headline.clone()),
            proved: proof.is_some_and(Certificate::passes),
            duration_s: plan.duration_s(),
        };
        Ok(Self {
            side,
            plan,
            certificate,
        })
    }

    fn measure(&self, requirement: Requirement) -> Option<Measure> {
        self.certificate.as_ref()?.check(requirement)?.measure
    }
}

impl Comparison {
    fn new(a: PlanWithProof, b: PlanWithProof) -> Self {
        let times = |part: String, time_s: &dyn Fn(&Plan) -> Option<f64>| Times {
            part,
            a_s: time_s(&a.plan),
            b_s: time_s(&b.plan),
        };
        let whole = times("whole cycle".to_owned(), &|plan| Some(plan.duration_s()));
        let parts = PARTS.map(|(part, kinds)| {
            times(part.to_owned(), &|plan| {
                time_s(plan, |segment| kinds.contains(&segment.kind))
            })
        });
        let plates: BTreeSet<usize> = a.plan.order.iter().chain(&b.plan.order).copied().collect();
        let of_plates = plates.into_iter().map(|plate| {
            let is_of = |segment: &PlanSegment| segment.kind == SegmentKind::Wash && segment.plate == plate;
            times(format!("washing {}", plate_name(plate)), &|plan| time_s(plan, is_of))
        });
        let job = differences(&a.plan.job, &b.plan.job).into_iter();
        let job = job.map(|difference| DifferingField {
            key: difference.key,
            a: difference.found,
            b: difference.expected,
        });
        let margins = Requirement::ALL.iter().filter_map(|&requirement| {
            let margins = Margins {
                requirement,
                a: a.measure(requirement),
                b: b.measure(requirement),
            };
            (margins.a.is_some() || margins.b.is_some()).then_some(margins)
        });
        Self {
            job: job.collect(),
            times: [whole].into_iter().chain(parts).chain(of_plates).collect(),
            margins: margins.collect(),
            a: a.side,
            b: b.side,
        }
    }
}

impl Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, side) in [("A", &self.a), ("B", &self.b)] {
            let (plan, scenario, seed) = (side.plan.display(), quoted(&side.scenario), side.seed);
            writeln!(
                f,
                "{name}: {plan}: scenario {scenario}, seed {seed}\n   {}",
                side.headline
            )?;
        }
        writeln!(f, "\njob: {}", fields_differ(self.job.len()))?;
        for DifferingField { key, a, b } in &self.job {
            writeln!(f, "  {key}: A {a}, B {b}")?;
        }
        writeln!(f, "\n{:<34}{:>12}{:>12}{:>18}", "time [s]", "A", "B", "B − A")?;
        for Times { part, a_s, b_s } in &self.times {
            let [a, b] = [a_s, b_s].map(|s| s.map_or("none".to_owned(), |s| format!("{s:.2}")));
            let change = a_s.zip(*b_s).map_or_else(String::new, |(a, b)| change(a, b));
            if a_s.or(*b_s).is_some() {
                writeln!(f, "{part:<34}{a:>12}{b:>12}{change:>18}")?;
            }
        }
        let (same, other): (Vec<_>, Vec<_>) = self.margins.iter().partition(|margins| margins.prints_equal());
        if !other.is_empty() {
            writeln!(f, "\n{:<34}{:>12}{:>12}  limit", "proved bound", "A", "B")?;
        }
        other.iter().try_for_each(|margins| margins.line(f))?;
        if !same.is_empty() {
            writeln!(f, "\nthe same in both: {}", count_with_noun(same.len(), "proved bound"))?;
        }
        Ok(())
    }
}

impl Margins {
    fn words(&self) -> [Option<MeasureWords>; 2] {
        [self.a, self.b].map(|measure| measure.map(|measure| measure.words()))
    }

    fn prints_equal(&self) -> bool {
        let [a, b] = self.words();
        a == b
    }

    fn line(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (name, told) = (self.requirement.words(), self.words());
        let [a, b] = [0, 1].map(|side: usize| told[side].as_ref().map_or("none", |words| &words.bound));
        let limit = |words: &MeasureWords| format!("{} {}", words.limit, words.unit);
        let mut limits: Vec<String> = told.iter().flatten().map(limit).collect();
        limits.dedup();
        writeln!(f, "{name:<34}{a:>12}{b:>12}  {}", limits.join(", in B "))
    }
}

/// Change from time `a` to time `b` \[s\] in words, with its share of `a`.
fn change(a: f64, b: f64) -> String {
    let more = b - a;
    if more.abs() < 0.005 {
        return "the same".to_owned();
    }
    let sign = if more < 0.0 { '−' } else { '+' };
    format!("{sign}{:.2} ({sign}{:.1} %)", more.abs(), 100.0 * more.abs() / a)
}
