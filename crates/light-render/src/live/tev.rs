use core::fmt;
use core::str::FromStr;
use core::time::Duration;
use std::io::{self, Write};
use std::net::{TcpStream, ToSocketAddrs};
use std::time::Instant;

use crate::Film;

use super::tev_packets::{create_image, update_rows};

/// Where the viewer tev listens.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct TevAddress {
    host: String,
    port: u16,
}

/// The port that tev listens on unless it is told another.
const PORT: u16 = 14158;

/// How long a viewer may keep a rendering waiting.
const PATIENCE: Duration = Duration::from_secs(5);

/// Between two pictures, the sending included: more would cost time and show no more.
const PERIOD: Duration = Duration::from_millis(250);

/// Pixels of a packet at most.
const PIXELS: usize = 1 << 16;

impl FromStr for TevAddress {
    type Err = String;

    /// Reads `tev`, `tev=HOST` or `tev=HOST:PORT`; a host with colons stands in brackets.
    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || "expected tev, tev=HOST or tev=HOST:PORT".to_owned();
        let rest = text.strip_prefix("tev").ok_or_else(expected)?;
        if rest.is_empty() {
            return Ok(Self {
                host: "127.0.0.1".into(),
                port: PORT,
            });
        }
        let place = rest.strip_prefix('=').ok_or_else(expected)?;
        let (host, port) = match place.rsplit_once(':') {
            Some((host, port)) if !host.contains(':') || host.ends_with(']') => {
                (host, port.parse().map_err(|_| expected())?)
            }
            _ => (place, PORT),
        };
        let host = host.trim_start_matches('[').trim_end_matches(']');
        if host.is_empty() {
            return Err(expected());
        }
        Ok(Self {
            host: host.into(),
            port,
        })
    }
}

impl fmt::Display for TevAddress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "tev at {}:{}", self.host, self.port)
    }
}

/// A connection to tev, and the image there.
#[derive(Debug)]
pub(crate) struct TevViewer {
    stream: TcpStream,
    image: String,
    /// When the last picture had been sent.
    sent: Option<Instant>,
}

impl TevViewer {
    /// Connects, and opens an image of that name and size.
    ///
    /// # Errors
    /// When nobody listens there.
    pub(crate) fn open(
        address: &TevAddress,
        image: &str,
        (width, height): (u32, u32),
    ) -> io::Result<Self> {
        let mut error = io::Error::other("the host has no address");
        for place in (address.host.as_str(), address.port).to_socket_addrs()? {
            match TcpStream::connect_timeout(&place, PATIENCE) {
                Ok(stream) => {
                    stream.set_write_timeout(Some(PATIENCE))?;
                    let mut viewer = Self {
                        stream,
                        image: image.into(),
                        sent: None,
                    };
                    let packet = create_image(image, width, height);
                    viewer.stream.write_all(&packet)?;
                    return Ok(viewer);
                }
                Err(other) => error = other,
            }
        }
        Err(error)
    }

    /// Sends the picture so far, unless the last one was sent a moment ago.
    ///
    /// # Errors
    /// When the viewer is gone or takes nothing any more.
    pub(crate) fn show(&mut self, film: &Film) -> io::Result<()> {
        if self.sent.is_some_and(|sent| sent.elapsed() < PERIOD) {
            return Ok(());
        }
        self.show_last(film)
    }

    /// Sends the picture.
    ///
    /// # Errors
    /// As for [`show`](Self::show).
    pub(crate) fn show_last(&mut self, film: &Film) -> io::Result<()> {
        let (width, _) = film.resolution();
        let rows = (PIXELS / width as usize).max(1);
        let pixels = film.develop();
        let mut y = 0;
        for part in pixels.chunks(rows * width as usize) {
            let packet = update_rows(&self.image, y, width, part);
            self.stream.write_all(&packet)?;
            y += u32::try_from(rows).unwrap_or(u32::MAX);
        }
        self.sent = Some(Instant::now());
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_have_a_host_and_a_port() {
        let address = |text: &str| {
            let address: TevAddress = text.parse().expect("an address");
            (address.host, address.port)
        };
        assert_eq!(address("tev"), ("127.0.0.1".into(), PORT), "here");
        assert_eq!(address("tev=far"), ("far".into(), PORT), "a host");
        assert_eq!(address("tev=far:99"), ("far".into(), 99), "and a port");
        assert_eq!(address("tev=[::1]:99"), ("::1".into(), 99), "version 6");
        for bad in [
            "",
            "mpv",
            "tev:1",
            "tev=",
            "tev=far:x",
            "tev=:1",
            "tev=far:70000",
        ] {
            assert!(bad.parse::<TevAddress>().is_err(), "{bad}");
        }
    }
}
