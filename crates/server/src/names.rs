//! Addresses and origins that requests may name.
//!
//! A page of another site cannot read what this server answers, unless its own name is made to mean this machine once it is open (DNS
//! rebinding). Its requests then still carry its name as Host. So a Host has to be an address, which nobody can give a new meaning,
//! or `localhost`.

use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};

/// Port of an address that states none.
const HTTP_PORT: u16 = 80;

/// The addresses by which this server may be called.
#[derive(Debug, Clone, Copy)]
pub struct Names {
    bound: SocketAddr,
}

impl Names {
    /// Names of a server that listens there.
    pub fn new(bound: SocketAddr) -> Self {
        Self { bound }
    }

    /// Checks that a Host header names this server.
    pub fn is_host(&self, host: &str) -> bool {
        let Some((name, port)) = split(host) else {
            return false;
        };
        port == self.bound.port()
            && (name.eq_ignore_ascii_case("localhost") || address(name).is_some_and(|a| self.is_own(a)))
    }

    /// Checks that an Origin header names this server's page.
    pub fn is_origin(&self, origin: &str) -> bool {
        origin.strip_prefix("http://").is_some_and(|host| self.is_host(host))
    }

    fn is_own(&self, address: IpAddr) -> bool {
        let loopback = [IpAddr::V4(Ipv4Addr::LOCALHOST), IpAddr::V6(Ipv6Addr::LOCALHOST)];
        // Which addresses the machine has is not known; one that leads here is one of them.
        loopback.contains(&address) || address == self.bound.ip() || self.bound.ip().is_unspecified()
    }
}

/// Name and port of `name`, `name:port` or `[v6]:port`.
fn split(host: &str) -> Option<(&str, u16)> {
    let colon = host.rfind(':').filter(|&colon| !host[colon..].contains(']'));
    let Some(colon) = colon else {
        return Some((host, HTTP_PORT));
    };
    let (name, port) = (&host[..colon], &host[colon + 1..]);
    let digits = !port.is_empty() && port.bytes().all(|b| b.is_ascii_digit());
    Some((name, port.parse().ok().filter(|_| digits)?))
}

/// An address as a Host writes it.
fn address(name: &str) -> Option<IpAddr> {
    match name.strip_prefix('[') {
        Some(rest) => rest.strip_suffix(']')?.parse().ok().map(IpAddr::V6),
        None => name.parse().ok().map(IpAddr::V4),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(bound: &str) -> Names {
        Names::new(bound.parse().unwrap())
    }

    #[test]
    fn accepts_three_names_of_the_loopback_with_its_port() {
        let names = names("127.0.0.1:8080");
        for own in ["127.0.0.1:8080", "localhost:8080", "LOCALHOST:8080", "[::1]:8080"] {
            assert!(names.is_host(own), "{own}");
            assert!(names.is_origin(&format!("http://{own}")), "{own}");
            assert!(!names.is_origin(&format!("https://{own}")), "{own}");
        }
    }

    #[test]
    fn other_hosts_are_foreign() {
        let names = names("127.0.0.1:8080");
        let foreign = [
            "",
            ":8080",
            "localhost",
            "localhost:",
            "localhost:+8080",
            "localhost:8081",
            "localhost:808000",
            "localhost:8080:8080",
            "localhost.:8080",
            "evil.example:8080",
            "localhost.evil.example:8080",
            "127.0.0.1.evil.example:8080",
            "127.0.0.1",
            "127.0.0.2:8080",
            "127.1:8080",
            "2130706433:8080",
            "0177.0.0.1:8080",
            "192.168.0.1:8080",
            "[::1]",
            "[::1:8080",
            "::1:8080",
            "[::ffff:127.0.0.1]:8080",
            "user@localhost:8080",
            "localhost:8080/",
            "é:8080",
        ];
        for host in foreign {
            assert!(!names.is_host(host), "{host}");
            assert!(!names.is_origin(&format!("http://{host}")), "{host}");
        }
        assert!(!names.is_origin("null") && !names.is_origin("localhost:8080"));
    }

    #[test]
    fn on_all_addresses_accepts_addresses_but_no_names() {
        for bound in ["0.0.0.0:8080", "[::]:8080"] {
            let names = names(bound);
            for own in ["192.168.0.7:8080", "[fe80::1]:8080", "localhost:8080"] {
                assert!(names.is_host(own), "{own}");
            }
            for host in ["evil.example:8080", "192.168.0.7:8081", "machine:8080"] {
                assert!(!names.is_host(host), "{host}");
            }
        }
    }

    #[test]
    fn the_default_port_is_that_of_http() {
        assert!(names("192.168.0.7:80").is_host("192.168.0.7"));
        assert!(names("192.168.0.7:80").is_host("localhost"));
        assert!(!names("192.168.0.7:80").is_host("192.168.0.8"));
    }
}
