//! The page of a plan or a scenario: what it is made of, where it is served, and the browser that opens it; and for `platewash run --live` the
//! simulation on a page in real time, while it runs.

use super::failure::internal;
use super::options::Options;
use super::output;
use super::simulate::SimulationAnswer;
use anyhow::{Context, Error, Result, anyhow, bail};
use clap::Args;
use platewash::editor::paper_beside;
use platewash::scenario::{Program, SHIPPED};
use platewash::server::{Feed, Listener, LiveRun, Page, Server, Site};
use platewash::simulator::plant::TorqueLimits;
use platewash::viewer::bundle::Bundle;
use platewash::viewer::view::{ExecutedMotion, View, ViewExtras};
use platewash::workcell::layout::TaskRegion;
use platewash::{Certificate, Plan, RobotModel, Scenario};
use std::io::Write;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::sync::Arc;
use std::time::Duration;
use tempfile::NamedTempFile;

/// Longest time to watch the program that opens the browser; one that runs longer is taken to have opened it.
const TO_OPEN: Duration = Duration::from_secs(3);

/// Writes to standard error why no page was written, where the program has no bundle: for the end of a report. `--quiet` does not silence
/// it, as a file is missing.
pub fn explain_absence() {
    if let Some(why) = Bundle::reason_absent() {
        output::message(&format!("no page was written: {why}, and build again"));
    }
}

/// The bundle, for a verb that can do nothing without it.
pub fn needed_bundle() -> Result<Bundle> {
    Bundle::embedded().ok_or_else(|| {
        let why = Bundle::reason_absent().unwrap_or_default();
        internal(anyhow!("there is no page to show: {why}, and build again"))
    })
}

/// The page of a plan.
pub fn html(plan: &Plan, arm: &RobotModel, extras: &ViewExtras<'_>, bundle: &Bundle) -> Result<String> {
    let (view, beside) = rayon::join(|| View::of_plan(plan, arm, extras), || paper_beside(plan, arm));
    let view = View { beside, ..view? };
    Ok(platewash::viewer::page::html(&view, bundle)?)
}

/// The page of a plan, to be written beside its report; `None` without a bundle, which [`explain_absence`] explains.
pub fn render(
    options: &Options,
    plan: &Plan,
    arm: &RobotModel,
    certificate: Option<&Certificate>,
    executed: Option<&ExecutedMotion>,
    region: &TaskRegion,
) -> Result<Option<String>> {
    let Some(bundle) = Bundle::embedded() else {
        return Ok(None);
    };
    options.cancel.check()?;
    let beside = ViewExtras {
        certificate,
        executed,
        region: Some(region),
        events: None,
    };
    let page = html(plan, arm, &beside, &bundle).context("the page of the plan");
    page.map(Some).map_err(internal)
}

/// Region in which a shipped scenario draws its plates, for a plan whose plates lie as that scenario lays them; empty for any other plan.
pub fn region_of_plan(plan: &Plan, arm: &RobotModel) -> TaskRegion {
    let name = plan.provenance.scenario.as_str();
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == name);
    let region = shipped.and_then(|shipped| {
        let mut scenario = Scenario::load(shipped.name).ok()?;
        scenario.seed = plan.job.seed;
        let layout = scenario.layout(arm).ok()?;
        (layout.plates == plan.job.plates).then(|| scenario.task_region(arm))
    });
    region.unwrap_or_default()
}

/// Arguments for serving a page.
#[derive(Debug, Args, Default)]
pub struct ServeArguments {
    /// Port of the page's address [default: any free port]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    port: Option<u16>,
    /// Network address to serve the page on; any but a loopback address lets other machines see it
    /// [default: 127.0.0.1]
    #[arg(long, value_name = "ADDR")]
    bind: Option<IpAddr>,
    /// Print the page's address but open no browser
    #[arg(long)]
    no_open: bool,
}

impl ServeArguments {
    /// Name of the first of these options that is given.
    pub fn first_given_option(&self) -> Option<&'static str> {
        let given = [
            (self.port.is_some(), "--port"),
            (self.bind.is_some(), "--bind"),
            (self.no_open, "--no-open"),
        ];
        given.into_iter().find_map(|(is_given, name)| is_given.then_some(name))
    }

    /// True where only this machine can reach the page.
    pub fn is_loopback(&self) -> bool {
        self.bind.is_none_or(|ip| ip.is_loopback())
    }

    /// Takes the port, before any long work.
    pub fn listen(&self, options: &Options) -> Result<Listener> {
        let ip = self.bind.unwrap_or(Ipv4Addr::LOCALHOST.into());
        let address = SocketAddr::new(ip, self.port.unwrap_or(0));
        let listener = Listener::bind(address).map_err(Error::from);
        let listener = listener.context(match (self.port, self.bind) {
            (Some(_), None) => "--port",
            (None, Some(_)) => "--bind",
            _ => "--bind, --port",
        })?;
        if !self.is_loopback() {
            options.say(&format!(
                "warning: --bind {ip}: whoever reaches this address sees the page; it asks for no password"
            ));
        }
        Ok(listener)
    }

    /// Opens an address that nobody else may see. The browser gets a file that only this user can read, as other users can see the
    /// arguments of programs. The file is removed when the returned value is dropped.
    pub fn open_privately(&self, options: &Options, url: &str) -> Result<Option<NamedTempFile>> {
        if self.no_open {
            return Ok(None);
        }
        let page = format!(
            "<!DOCTYPE html><meta charset=\"utf-8\"><meta http-equiv=\"refresh\" content=\"0;url={url}\"><a href=\"{url}\">platewash</a>\n"
        );
        let file = tempfile::Builder::new().prefix("platewash-").suffix(".html").tempfile();
        let file = file.and_then(|mut file| file.write_all(page.as_bytes()).map(|()| file));
        let file = file.map_err(internal)?;
        self.open(options, &file.path().display().to_string());
        Ok(Some(file))
    }

    /// Opens a page in the browser, where that is asked for. A browser that cannot be opened is no failure: the address is printed.
    pub fn open(&self, options: &Options, url: &str) {
        if self.no_open {
            return;
        }
        let (options, url) = (options.clone(), url.to_owned());
        // What opens it may take its time.
        std::thread::spawn(move || {
            if let Err(error) = open::that_detached_with_timeout(&url, TO_OPEN) {
                options.say(&format!("no browser can be opened ({error}): open {url} yourself"));
            }
        });
    }
}

/// Longest time that the simulation waits for a page to connect.
const TO_COME: Duration = Duration::from_secs(30);

/// Longest time that the command waits at its end until all pages know about it.
const TO_PART: Duration = Duration::from_secs(3);

/// Shortest delay behind real time that is reported \[s\]; less is rounding, or a busy machine.
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

/// Port, bundle and region of a live run, ready before there is anything to show.
pub struct Stage<'a> {
    serve: &'a ServeArguments,
    listener: Listener,
    bundle: Bundle,
}

/// A page that is served, of a run that has not ended.
pub struct LivePage {
    live: Arc<LiveRun>,
    /// Server of the page; it serves until it is dropped.
    _server: Server,
}

impl LiveArguments {
    /// Takes the port and finds the bundle, before any long work. `None` where the run is not to be shown, or there is no bundle.
    pub fn prepare(&self, options: &Options, scenario: &Scenario) -> Result<Option<Stage<'_>>> {
        if !self.live {
            return match self.serve.first_given_option() {
                Some(name) => bail!("{name}: is for --live, which is not given"),
                None => Ok(None),
            };
        }
        if scenario.job.program == Program::Paper {
            bail!("--live: the paper's program has no simulation to watch; `platewash view` shows its plan");
        }
        let listener = self.serve.listen(options)?;
        let bundle = Bundle::embedded();
        options.cancel.check()?;
        Ok(bundle.map(|bundle| Stage {
            serve: &self.serve,
            listener,
            bundle,
        }))
    }
}

impl Stage<'_> {
    /// Serves the page of a plan that is about to be simulated, opens it, and waits until it is there.
    pub fn open(
        self,
        options: &Options,
        (plan, arm): (&Plan, &RobotModel),
        certificate: &Certificate,
        region: &TaskRegion,
    ) -> Result<LivePage> {
        let live = LiveRun::new(plan.hash.as_deref().unwrap_or_default());
        let settings = &plan.job.simulation;
        let executed = ExecutedMotion::live(settings.law, TorqueLimits::new(&settings.plant, arm.limits()).0);
        let beside = ViewExtras {
            certificate: Some(certificate),
            executed: Some(&executed),
            region: Some(region),
            events: Some(&live.events()),
        };
        let page = html(plan, arm, &beside, &self.bundle).map_err(internal)?;
        let url = self.listener.url();
        let site = Site {
            live: Some(live.clone()),
            ..Site::from_page(Page::Fixed(page))
        };
        let server = self.listener.serve(site).map_err(internal)?;
        options.say(&format!("live at {url}"));
        self.serve.open(options, &url);
        if !live.wait_for_page(TO_COME, &options.cancel) {
            options.cancel.check()?;
            let waited_s = TO_COME.as_secs();
            options.say(&format!(
                "no page has been opened for {waited_s} s: simulating without one"
            ));
        }
        Ok(LivePage { live, _server: server })
    }
}

impl LivePage {
    /// Simulates a plan in real time, while it is shown; tells all pages how that ended, and on standard error how late it was.
    pub fn simulated(&self, options: &Options, plan: &Plan, arm: &RobotModel) -> Result<SimulationAnswer> {
        let mut feed = Feed::new(&self.live, plan, arm, &options.cancel);
        let simulated = SimulationAnswer::new(options, plan, arm, &mut |sample| feed.sample(sample))?;
        let late_s = feed.end();
        if late_s > NOTICEABLE_S {
            options.say(&format!(
                "the simulation is slower than real time: it ended {late_s:.1} s late"
            ));
        }
        self.live.finish(simulated.live_end());
        Ok(simulated)
    }

    /// Waits until all pages know how the run ended.
    pub fn part(self, options: &Options) {
        self.live.wait_until_told(TO_PART, &options.cancel);
    }
}
