//! The port, and the thread that accepts.

use crate::answer::Refusal;
use crate::connection::{self, ServerState};
use crate::connections::{Connections, Turns};
use crate::error::ServerError;
use crate::names::Names;
use crate::site::Site;
use std::io::Read;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{Builder, JoinHandle, sleep};
use std::time::{Duration, Instant};

/// Rest after the system has given no connection, as where there are too many open files.
const AFTER_A_FAULT: Duration = Duration::from_millis(50);

/// Longest time for a client that is turned away to ask, so that it reads the answer before the connection is closed.
const TO_BE_TURNED_AWAY: Duration = Duration::from_millis(10);

/// Longest time that the end of the server waits for threads whose connections are closed.
const TO_END: Duration = Duration::from_secs(1);

/// A port that is taken, on which nothing is answered yet: who connects waits.
#[derive(Debug)]
pub struct Listener {
    listener: TcpListener,
    address: SocketAddr,
}

/// A site that is served until this is dropped.
#[derive(Debug)]
pub struct Server {
    address: SocketAddr,
    ends: Arc<AtomicBool>,
    served: Arc<ServerState>,
    connections: Arc<Connections>,
    accepting: Option<JoinHandle<()>>,
}

impl Listener {
    /// Takes a port; port 0 stands for any free one.
    ///
    /// # Errors
    /// [`ServerError::Bind`]: the port is taken or may not be, or the address is none of this machine.
    pub fn bind(address: SocketAddr) -> Result<Self, ServerError> {
        let cannot = |source| ServerError::Bind { address, source };
        let listener = TcpListener::bind(address).map_err(cannot)?;
        let address = listener.local_addr().map_err(cannot)?;
        Ok(Self { listener, address })
    }

    /// Address that a browser on this machine opens.
    #[must_use]
    pub fn url(&self) -> String {
        url(self.address)
    }

    /// Answers from now on.
    ///
    /// # Errors
    /// [`ServerError::Thread`].
    pub fn serve(self, site: Site) -> Result<Server, ServerError> {
        let (names, turns) = (Names::new(self.address), Turns::default());
        let mut server = Server {
            address: self.address,
            ends: Arc::default(),
            served: Arc::new(ServerState { site, names, turns }),
            connections: Arc::default(),
            accepting: None,
        };
        let (ends, served, connections) = (server.ends.clone(), server.served.clone(), server.connections.clone());
        let accept = move || accept(&self.listener, &ends, &served, &connections);
        let accepting = Builder::new().name("page".to_owned()).spawn(accept);
        server.accepting = Some(accepting.map_err(ServerError::Thread)?);
        Ok(server)
    }
}

impl Server {
    /// Address that a browser on this machine opens.
    #[must_use]
    pub fn url(&self) -> String {
        url(self.address)
    }
}

impl Drop for Server {
    /// Closes the port and all connections, within seconds for any behaviour of the clients.
    fn drop(&mut self) {
        self.ends.store(true, Ordering::Relaxed);
        // The thread waits for a connection; this is one. Where none can be made, the thread is busy with others and checks by
        // itself.
        let woken = TcpStream::connect_timeout(&reachable(self.address), TO_END);
        let begin = Instant::now();
        if let Some(accepting) = self.accepting.take() {
            while !accepting.is_finished() && begin.elapsed() < TO_END {
                sleep(Duration::from_millis(1));
            }
        }
        drop(woken);
        if let Some(live) = &self.served.site.live {
            live.close();
        }
        self.connections.close(TO_END);
    }
}

fn accept(listener: &TcpListener, ends: &AtomicBool, served: &Arc<ServerState>, all: &Arc<Connections>) {
    while !ends.load(Ordering::Relaxed) {
        match listener.accept() {
            Ok(_) if ends.load(Ordering::Relaxed) => {}
            Ok((stream, _)) => start_connection(stream, served, all),
            Err(_) => sleep(AFTER_A_FAULT),
        }
    }
}

/// Gives a connection a thread. A connection without a place gets an answer that says so; one without a thread is closed.
fn start_connection(stream: TcpStream, served: &Arc<ServerState>, all: &Arc<Connections>) {
    let Some(place) = all.enter(&stream) else {
        return turn_away(stream);
    };
    let served = served.clone();
    let serve = move || {
        // Small events are not held back to be sent together; where that cannot be had, they come later.
        let _ = stream.set_nodelay(true);
        connection::serve(&stream, &served, &place);
    };
    let _ = Builder::new().name("page client".to_owned()).spawn(serve);
}

/// Tells a client that all places are taken.
fn turn_away(mut stream: TcpStream) {
    // The short answer fits into the system's buffer for a new connection.
    let _ = stream.set_read_timeout(Some(TO_BE_TURNED_AWAY));
    let _ = stream.read(&mut [0; 1 << 14]);
    let _ = stream.set_nonblocking(true);
    let _ = Refusal::Full.write(&mut stream, true);
}

fn url(address: SocketAddr) -> String {
    format!("http://{}/", reachable(address))
}

/// An address to which this machine can connect.
fn reachable(mut address: SocketAddr) -> SocketAddr {
    if address.ip().is_unspecified() {
        address.set_ip(match address.ip() {
            IpAddr::V4(_) => Ipv4Addr::LOCALHOST.into(),
            IpAddr::V6(_) => Ipv6Addr::LOCALHOST.into(),
        });
    }
    address
}
