//! `platewash run --live`: the simulation on a page in the browser, in real time, while it runs.

use super::failure::Failure;
use super::options::Options;
use super::serve::ServeArguments;
use super::{bundle, output, page};
use anyhow::anyhow;
use clap::Args;
use platewash::scenario::Program;
use platewash::simulator::plant::TorqueLimits;
use platewash::viewer::bundle::Bundle;
use platewash::viewer::server::{Feed, Listener, Live, LiveEnd, Page, Server, Site};
use platewash::viewer::view::{Beside, Executed};
use platewash::workcell::layout::TaskRegion;
use platewash::{Certificate, Plan, RobotModel, Scenario};
use std::sync::Arc;
use std::time::Duration;

/// For how long the simulation waits for a page.
const TO_COME: Duration = Duration::from_secs(30);

/// For how long the command waits, at its end, until all pages know it.
const TO_PART: Duration = Duration::from_secs(3);

/// Less than this behind real time is rounding, or a busy machine \[s\].
const NOTICEABLE_S: f64 = 0.5;

/// Arguments of `run` that show it live.
#[derive(Debug, Args, Default)]
pub struct LiveArguments {
    /// Show the simulation in the browser, in real time, while it runs; --port, --bind and --no-open need this option
    #[arg(long)]
    live: bool,
    #[command(flatten)]
    serve: ServeArguments,
}

/// All that a live run needs before there is anything to show.
pub struct Stage<'a> {
    serve: &'a ServeArguments,
    listener: Listener,
    bundle: Bundle,
    region: TaskRegion,
}

/// A page that is served, of a run that has not ended.
pub struct Show {
    live: Arc<Live>,
    /// Serves until it is dropped.
    _server: Server,
}

impl LiveArguments {
    /// Takes the port and finds the page, where the run is to be shown: before any long work, and without a page as if it were not.
    pub fn prepare(&self, options: &Options, scenario: &Scenario) -> Result<Option<Stage<'_>>, Failure> {
        if !self.live {
            return match self.serve.given() {
                Some(name) => Err(Failure::input(anyhow!("{name}: is for --live, which is not given"))),
                None => Ok(None),
            };
        }
        if scenario.job.program == Program::Paper {
            return Err(Failure::input(anyhow!(
                "--live: the paper's program has no simulation to watch; `platewash view` shows its plan"
            )));
        }
        let listener = self.serve.listen(options)?;
        let bundle = bundle::bundle();
        options.cancel.check()?;
        Ok(bundle.map(|bundle| Stage {
            serve: &self.serve,
            listener,
            bundle,
            region: scenario.task_region(),
        }))
    }
}

impl Stage<'_> {
    /// Serves the page of a plan that is about to be simulated, opens it, and waits until it is there.
    pub fn open(
        self,
        options: &Options,
        plan: &Plan,
        arm: &RobotModel,
        certificate: &Certificate,
    ) -> Result<Show, Failure> {
        let live = Live::new(plan.hash.as_deref().unwrap_or_default());
        let page = self.page(plan, arm, certificate, &live).map_err(Failure::internal)?;
        let url = self.listener.url();
        let site = Site {
            live: Some(live.clone()),
            ..Site::of(Page::Fixed(page))
        };
        let server = self.listener.serve(site).map_err(Failure::internal)?;
        output::message(options.quiet, &format!("live at {url}"));
        self.serve.open(options, &url);
        if !live.wait_for_page(TO_COME, &options.cancel) {
            options.cancel.check()?;
            let words = format!(
                "no page has been opened for {} s: simulating without one",
                TO_COME.as_secs()
            );
            output::message(options.quiet, &words);
        }
        Ok(Show { live, _server: server })
    }

    fn page(&self, plan: &Plan, arm: &RobotModel, certificate: &Certificate, live: &Live) -> anyhow::Result<String> {
        let settings = &plan.job.simulation;
        let executed = Executed::live(settings.law, TorqueLimits::new(&settings.plant, arm.limits()).0);
        let events = live.events();
        let beside = Beside {
            certificate: Some(certificate),
            executed: Some(&executed),
            region: Some(&self.region),
            events: Some(&events),
        };
        page::html(plan, arm, &beside, &self.bundle)
    }
}

impl Show {
    /// What takes the samples of the simulation.
    pub fn feed<'a>(&'a self, options: &'a Options, plan: &Plan, arm: &'a RobotModel) -> Feed<'a> {
        Feed::new(&self.live, plan, arm, &options.cancel)
    }

    /// Tells all pages how the simulation ended, and on standard error how late that was.
    pub fn tell_end(&self, options: &Options, late_s: f64, end: LiveEnd) {
        if late_s > NOTICEABLE_S {
            let words = format!("the simulation is slower than real time: it ended {late_s:.1} s late");
            output::message(options.quiet, &words);
        }
        self.live.finish(end);
    }

    /// Waits until all pages know how the run ended.
    pub fn part(self, options: &Options) {
        self.live.wait_until_told(TO_PART, &options.cancel);
    }
}
