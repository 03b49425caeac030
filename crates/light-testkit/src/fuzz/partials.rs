use std::path::Path;

use light_render::{ExactSum, Film, PartialPicture, PictureIdentity};
use light_scene::{ChannelFile, Diagnostic};

use super::input::Input;

/// Parts that one input may hold.
const MAX_PARTS: usize = 4;

/// Parts of a picture come back from their files bit for bit, add up to the same picture in any
/// order or to none, and no changed byte goes unnoticed; other bytes are refused in one line.
///
/// # Panics
/// If a guarantee is violated.
pub fn partials(data: &[u8]) {
    let path = Path::new("part.exr");
    for error in [
        PartialPicture::parse(path, data).err(),
        ChannelFile::parse(path, data).err(),
    ] {
        error.iter().for_each(one_line);
    }
    let mut input = Input::new(data);
    let flip = input.u32();
    let mut parts = Vec::new();
    while !input.is_empty() && parts.len() < MAX_PARTS {
        parts.extend(part(&mut input));
    }
    // One file an input: writing takes most of the time.
    if let Some(part) = parts.first() {
        check_file(part, path, flip);
    }
    let merged = PartialPicture::merge(parts.clone());
    parts.reverse();
    let again = PartialPicture::merge(parts.clone());
    assert_eq!(merged.is_ok(), again.is_ok(), "of {parts:?}");
    if let (Ok(a), Ok(b)) = (merged, again) {
        assert_eq!(a, b, "the order of {parts:?}");
        let samples: u32 = parts.iter().map(|part| part.samples.len() as u32).sum();
        assert_eq!(a.samples(), samples, "all of {parts:?}");
    }
}

/// A part of a few pixels; `None` where it has none.
fn part(input: &mut Input<'_>) -> Option<PartialPicture> {
    let size = [input.below(3), input.below(3)].map(|n| n as u32 + 1);
    let start = u32::from(input.byte());
    let count = u32::from(input.byte() % 8);
    let mut step = || i128::from(input.u32()) << (input.byte() % 90);
    let pixels = size[0] * size[1];
    let sums: Vec<ExactSum> = (0..pixels)
        .map(|_| ExactSum::from_steps([step(), step(), step()]))
        .collect();
    let scene = ["a", "b"][usize::from(input.byte() == 7)];
    Some(PartialPicture {
        film: Film::from_sums((size[0], size[1]), count, sums)?,
        samples: start..start + count,
        identity: PictureIdentity::new([("scene", scene.to_owned())]),
    })
}

/// Written, read, and read with one bit changed.
fn check_file(part: &PartialPicture, path: &Path, flip: u32) {
    let mut bytes = match part.to_bytes(path) {
        Ok(bytes) => bytes,
        Err(error) => return one_line(&error),
    };
    let back = PartialPicture::parse(path, &bytes);
    assert_eq!(back.as_ref(), Ok(part), "comes back");
    let bit = flip as usize % (8 * bytes.len());
    bytes[bit / 8] ^= 1 << (bit % 8);
    let broken = PartialPicture::parse(path, &bytes);
    assert!(broken.is_err(), "bit {bit} changed unnoticed in {part:?}");
}

fn one_line(diagnostic: &Diagnostic) {
    let shown = diagnostic.to_string();
    assert_eq!(shown.lines().count(), 1, "one line: {shown:?}");
}
