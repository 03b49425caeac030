//! A stand-in for the image viewer tev.

use std::collections::HashMap;
use std::io::Read;
use std::net::{TcpListener, TcpStream};
use std::sync::mpsc::{Receiver, channel};
use std::thread::{JoinHandle, spawn};

use light_scene::glam::Vec3;

/// An image of the stand-in: its width, and its pixels.
pub(crate) type Shown = HashMap<String, (u32, Vec<Vec3>)>;

/// A stand-in for tev, written from the description of its protocol: packets that begin with their
/// length and the kind of request.
pub(crate) struct StandIn {
    pub(crate) flag: String,
    pub(crate) first_update: Receiver<()>,
    pub(crate) images: JoinHandle<Shown>,
}

impl StandIn {
    pub(crate) fn listen() -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
        let flag = format!("tev={}", listener.local_addr().expect("an address"));
        let (sender, first_update) = channel();
        let images = spawn(move || {
            let (stream, _) = listener.accept().expect("a connection");
            serve(stream, || {
                // The test may have ended.
                let _ = sender.send(());
            })
        });
        Self {
            flag,
            first_update,
            images,
        }
    }
}

/// The images when the connection ends.
fn serve(mut stream: TcpStream, updated: impl Fn()) -> Shown {
    let mut images = Shown::new();
    let mut length = [0; 4];
    while stream.read_exact(&mut length).is_ok() {
        let mut packet = vec![0; u32::from_le_bytes(length) as usize - 4];
        stream.read_exact(&mut packet).expect("a whole packet");
        let mut fields = Fields(&packet);
        let (kind, _shows, name) = (fields.byte(), fields.byte(), fields.text());
        match kind {
            4 => {
                let (width, height) = (fields.integer(), fields.integer());
                assert_eq!(fields.texts(), ["R", "G", "B"], "channels");
                let pixels = vec![Vec3::ZERO; width as usize * height as usize];
                images.insert(name, (width, pixels));
            }
            6 => {
                assert_eq!(fields.texts(), ["R", "G", "B"], "channels");
                let [x, y, w, h] = [0; 4].map(|_| fields.integer());
                let offsets = [0; 3].map(|_| fields.long());
                let strides = [0; 3].map(|_| fields.long());
                let numbers: Vec<f32> = fields.rest();
                let (width, pixels) = images.get_mut(&name).expect("a created image");
                for (i, (column, row)) in (0..h)
                    .flat_map(|row| (0..w).map(move |c| (c, row)))
                    .enumerate()
                {
                    let at = |c: usize| numbers[offsets[c] + strides[c] * i];
                    let pixel = (y + row) * *width + x + column;
                    pixels[pixel as usize] = Vec3::new(at(0), at(1), at(2));
                }
                updated();
            }
            other => panic!("an unknown kind of packet: {other}"),
        }
    }
    images
}

/// What is left of a packet.
struct Fields<'a>(&'a [u8]);

impl Fields<'_> {
    fn byte(&mut self) -> u8 {
        let byte = self.0[0];
        self.0 = &self.0[1..];
        byte
    }

    fn text(&mut self) -> String {
        let end = self.0.iter().position(|&byte| byte == 0).expect("an end");
        let text = String::from_utf8(self.0[..end].to_vec()).expect("text");
        self.0 = &self.0[end + 1..];
        text
    }

    fn integer(&mut self) -> u32 {
        let (bytes, rest) = self.0.split_first_chunk().expect("four bytes");
        self.0 = rest;
        u32::from_le_bytes(*bytes)
    }

    fn long(&mut self) -> usize {
        let (bytes, rest) = self.0.split_first_chunk().expect("eight bytes");
        self.0 = rest;
        usize::try_from(u64::from_le_bytes(*bytes)).expect("a place in the packet")
    }

    fn texts(&mut self) -> Vec<String> {
        (0..self.integer()).map(|_| self.text()).collect()
    }

    fn rest(&mut self) -> Vec<f32> {
        let numbers = self.0.chunks_exact(4);
        numbers
            .map(|bytes| f32::from_le_bytes(bytes.try_into().expect("four bytes")))
            .collect()
    }
}
