//! Commands that serve a page, and what asks them.

use super::*;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, ChildStderr, ChildStdout, Stdio};
use std::sync::Once;
use std::time::{Duration, Instant};

/// Long after anything that answers or ends has done so, and long before work without end is done.
pub const PATIENCE: Duration = Duration::from_secs(300);

/// A command that goes on; it is ended with the test.
pub struct RunningCommand {
    pub child: Child,
    pub stdout: BufReader<ChildStdout>,
    pub stderr: BufReader<ChildStderr>,
}

impl Drop for RunningCommand {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

pub fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_platewash"));
    command.args(arguments).current_dir(folder);
    command
}

/// These tests may have been started to ignore Ctrl-C, in the background of a shell: that is handed on to what they start. A handler
/// is not.
fn heed_ctrl_c() {
    static HEEDED: Once = Once::new();
    HEEDED.call_once(|| ctrlc::set_handler(|| std::process::exit(130)).unwrap());
}

/// A command whose outputs are read; it heeds Ctrl-C, however these tests were started.
pub fn spawn(command: &mut Command) -> Child {
    heed_ctrl_c();
    command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

/// Sends a signal, such as 2 for Ctrl-C, once the command handles it: before, any program ends by it.
#[cfg(unix)]
pub fn signal(child: &Child, number: u32) {
    let status = format!("/proc/{}/status", child.id());
    let handles = |text: String| {
        let mask = text.lines().find_map(|line| line.strip_prefix("SigCgt:"));
        let mask = mask.and_then(|digits| u64::from_str_radix(digits.trim(), 16).ok());
        mask.is_some_and(|mask| mask >> (number - 1) & 1 == 1)
    };
    let begin = Instant::now();
    // Systems without this file are not waited for.
    while std::fs::read_to_string(&status).is_ok_and(|text| !handles(text)) {
        assert!(begin.elapsed() < PATIENCE, "it does not handle signal {number}");
        std::thread::sleep(Duration::from_millis(5));
    }
    let kill = [format!("-{number}"), child.id().to_string()];
    assert!(Command::new("kill").args(kill).status().unwrap().success());
}

#[cfg(unix)]
pub fn interrupt(child: &Child) {
    signal(child, 2);
}

pub fn start(command: &mut Command) -> RunningCommand {
    let mut child = spawn(command);
    RunningCommand {
        stdout: BufReader::new(child.stdout.take().unwrap()),
        stderr: BufReader::new(child.stderr.take().unwrap()),
        child,
    }
}

/// Reads lines up to one that begins so; what follows in it.
#[track_caller]
pub fn line_after(lines: &mut impl BufRead, begin: &str) -> String {
    let mut all = String::new();
    loop {
        let from = all.len();
        assert_ne!(lines.read_line(&mut all).unwrap(), 0, "no '{begin}' in {all}");
        if let Some(rest) = all[from..].trim_end().strip_prefix(begin) {
            return rest.to_owned();
        }
    }
}

impl RunningCommand {
    #[cfg(unix)]
    pub fn interrupt(&self) {
        interrupt(&self.child);
    }

    /// The exit code, and the rest of what was said.
    pub fn end(mut self) -> (Option<i32>, String, String) {
        let (mut stdout, mut stderr) = (String::new(), String::new());
        self.stdout.read_to_string(&mut stdout).unwrap();
        self.stderr.read_to_string(&mut stderr).unwrap();
        (self.child.wait().unwrap().code(), stdout, stderr)
    }
}

/// Asks the server of a URL for something, with more headers, a line each.
pub fn ask(url: &str, path: &str, headers: &str) -> TcpStream {
    let address = url.strip_prefix("http://").unwrap().strip_suffix('/').unwrap();
    let mut stream = TcpStream::connect(address).unwrap();
    stream.set_read_timeout(Some(PATIENCE)).unwrap();
    let request = format!("GET {path} HTTP/1.1\r\nHost: {address}\r\n{headers}\r\n");
    stream.write_all(request.as_bytes()).unwrap();
    stream
}

pub fn all(mut stream: TcpStream) -> String {
    let mut text = String::new();
    stream.read_to_string(&mut text).unwrap();
    text
}

/// Asks a question of the page's own, with a token.
#[cfg(unix)]
pub fn post(url: &str, path: &str, token: &str, question: &Value) -> String {
    let origin = url.strip_suffix('/').unwrap();
    let host = origin.strip_prefix("http://").unwrap();
    let mut stream = TcpStream::connect(host).unwrap();
    stream.set_read_timeout(Some(PATIENCE)).unwrap();
    let body = question.to_string();
    let request = format!(
        "POST {path} HTTP/1.1\r\nHost: {host}\r\nOrigin: {origin}\r\nX-Platewash-Token: {token}\r\nContent-Type: application/json\r\n\
         Content-Length: {}\r\n\r\n{body}",
        body.len()
    );
    stream.write_all(request.as_bytes()).unwrap();
    all(stream)
}
