//! Where a page is served, and the browser that opens it, for `view` and `run --live`.

use super::failure::Failure;
use super::options::Options;
use super::output;
use clap::Args;
use platewash::viewer::server::Listener;
use std::io::Write;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::time::Duration;
use tempfile::NamedTempFile;

/// For how long what opens the browser is looked at; one that goes on is taken to have opened it.
const TO_OPEN: Duration = Duration::from_secs(3);

/// Where a page is served.
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
    /// The first of them that is given.
    pub fn given(&self) -> Option<&'static str> {
        let given = [
            (self.port.is_some(), "--port"),
            (self.bind.is_some(), "--bind"),
            (self.no_open, "--no-open"),
        ];
        given.into_iter().find_map(|(is_given, name)| is_given.then_some(name))
    }

    /// Whether this machine alone reaches the page.
    pub fn is_loopback(&self) -> bool {
        self.bind.is_none_or(|ip| ip.is_loopback())
    }

    /// Takes the port, before any long work.
    pub fn listen(&self, options: &Options) -> Result<Listener, Failure> {
        let ip = self.bind.unwrap_or(Ipv4Addr::LOCALHOST.into());
        let address = SocketAddr::new(ip, self.port.unwrap_or(0));
        let listener = Listener::bind(address).map_err(|error| self.refused(error))?;
        if !self.is_loopback() {
            let warning =
                format!("warning: --bind {ip}: whoever reaches this address sees the page; it asks for no password");
            output::message(options.quiet, &warning);
        }
        Ok(listener)
    }

    /// Opens an address that nobody else may see: by way of a file that only this user reads, as others see what programs are called with. The
    /// file goes with what is returned.
    pub fn open_privately(&self, options: &Options, url: &str) -> Result<Option<NamedTempFile>, Failure> {
        if self.no_open {
            return Ok(None);
        }
        let page = format!(
            "<!DOCTYPE html><meta charset=\"utf-8\"><meta http-equiv=\"refresh\" content=\"0;url={url}\"><a href=\"{url}\">platewash</a>\n"
        );
        let file = tempfile::Builder::new().prefix("platewash-").suffix(".html").tempfile();
        let file = file.and_then(|mut file| file.write_all(page.as_bytes()).map(|()| file));
        let file = file.map_err(Failure::internal)?;
        self.open(options, &file.path().display().to_string());
        Ok(Some(file))
    }

    /// Opens a page in the browser, where that is asked for. A browser that cannot be opened is no failure: the address is printed.
    pub fn open(&self, options: &Options, url: &str) {
        if self.no_open {
            return;
        }
        let (quiet, url) = (options.quiet, url.to_owned());
        // What opens it may take its time.
        std::thread::spawn(move || {
            if let Err(error) = open::that_detached_with_timeout(&url, TO_OPEN) {
                output::message(
                    quiet,
                    &format!("no browser can be opened ({error}): open {url} yourself"),
                );
            }
        });
    }

    fn refused(&self, error: impl Into<anyhow::Error>) -> Failure {
        let which = match (self.port, self.bind) {
            (Some(_), None) => "--port",
            (None, Some(_)) => "--bind",
            _ => "--bind, --port",
        };
        Failure::input(error.into().context(which))
    }
}
