use core::ops::Range;
use std::path::Path;

use light_scene::{ChannelFile, Diagnostic, Files, write_atomically};
use lights::glam::Vec3;

use crate::exact_sum_words::{LOW_WORDS, WORDS, from_words, words};
use crate::file_checksum::{self, CHECKSUM, NO_CHECKSUM};
use crate::partial_error::PartialPictureError;
use crate::{ExactSum, Film, PictureIdentity};

/// A picture of some of its samples, with exact sums: parts of one picture add up to the same bits
/// as if it had been rendered at once.
///
/// In a file it is an ordinary OpenEXR picture (R, G, B: the mean) with further channels that hold
/// the sums, the picture's identity, and a checksum of all bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PartialPicture {
    /// The sums.
    pub film: Film,
    /// The numbers of the samples.
    pub samples: Range<u32>,
    /// The identity of the picture: equal only for its parts.
    pub identity: PictureIdentity,
}

/// What an OpenEXR file begins with.
const EXR: &[u8] = &[0x76, 0x2f, 0x31, 0x01];

const SAMPLES: &str = "lights.samples";
const IDENTITY: &str = "lights.picture";
const COLORS: [&str; 3] = ["R", "G", "B"];

impl PartialPicture {
    /// Bytes a pixel that are taken to write or read a file, the film itself left out.
    pub(crate) const FILE_BYTES_PER_PIXEL: u64 = 90;

    /// Reads the part in a file.
    ///
    /// # Errors
    /// When the file cannot be read, holds no part or is damaged.
    pub fn read(path: &Path) -> Result<Self, Diagnostic> {
        Self::parse(path, &Files::DISK.read(path)?)
    }

    /// As [`read`](Self::read), from the bytes of the file; `path` names it in messages.
    ///
    /// # Errors
    /// When the bytes hold no part or are damaged.
    pub fn parse(path: &Path, bytes: &[u8]) -> Result<Self, Diagnostic> {
        let refuse = |error: PartialPictureError| Diagnostic::file(path, error.to_string());
        match file_checksum::is_whole(bytes) {
            Some(true) => {}
            Some(false) => return Err(refuse(PartialPictureError::Damaged)),
            None => {
                // A picture that is cut off is not told by what it lacks.
                if bytes.starts_with(EXR) {
                    ChannelFile::parse(path, bytes)?;
                }
                return Err(refuse(PartialPictureError::NoPart));
            }
        }
        let file = ChannelFile::parse(path, bytes)?;
        Self::from_file(&file).ok_or_else(|| refuse(PartialPictureError::NoPart))
    }

    /// Writes the part.
    ///
    /// # Errors
    /// When the file cannot be written; nothing is left behind then.
    pub fn write(&self, path: &Path) -> Result<(), Diagnostic> {
        write_atomically(path, &self.to_bytes(path)?)
    }

    /// What [`write`](Self::write) writes; `path` names the file in messages.
    ///
    /// # Errors
    /// When the picture has no pixels.
    pub fn to_bytes(&self, path: &Path) -> Result<Vec<u8>, Diagnostic> {
        let mut bytes = self.to_file().into_bytes(path)?;
        if file_checksum::seal(&mut bytes) {
            Ok(bytes)
        } else {
            Err(Diagnostic::file(path, "no room for a checksum"))
        }
    }

    fn to_file(&self) -> ChannelFile {
        let (width, height) = self.film.resolution();
        let means = self.film.develop();
        let channels = (0..3).zip(COLORS).map(|(i, color)| {
            let numbers = means.iter().map(|mean: &Vec3| mean[i]);
            (color.to_owned(), numbers.collect())
        });
        let channels = channels.collect();
        let is_low = self.film.sums().all(|sum| {
            let words = sum.steps().map(words);
            words.iter().all(|words| words[LOW_WORDS..] == [0; 2])
        });
        let count = if is_low { LOW_WORDS } else { WORDS };
        let names = (0..count).flat_map(|word| (0..3).map(move |color| (word, color)));
        let integers = names.map(|(word, color)| {
            let numbers = self.film.sums().map(|sum| words(sum.steps()[color])[word]);
            (channel_name(word, color), numbers.collect())
        });
        let Range { start, end } = self.samples;
        ChannelFile {
            width,
            height,
            channels,
            integers: integers.collect(),
            notes: vec![
                (SAMPLES.into(), format!("{start}..{end}")),
                (IDENTITY.into(), self.identity.to_string()),
                (CHECKSUM.into(), NO_CHECKSUM.into()),
            ],
        }
    }

    fn from_file(file: &ChannelFile) -> Option<Self> {
        let (start, end) = file.note(SAMPLES)?.split_once("..")?;
        let samples: Range<u32> = start.parse().ok()?..end.parse().ok()?;
        let count = samples.end.checked_sub(samples.start)?;
        let pixels = file.width as usize * file.height as usize;
        let channel = |word: usize, color: usize| {
            let numbers = file.integers(&channel_name(word, color));
            numbers.filter(|numbers| numbers.len() == pixels)
        };
        let mut channels = [[None; 3]; WORDS];
        for (word, colors) in channels.iter_mut().enumerate() {
            for (color, numbers) in colors.iter_mut().enumerate() {
                *numbers = channel(word, color);
                if word < LOW_WORDS && numbers.is_none() {
                    return None;
                }
            }
        }
        let steps = |pixel: usize, color: usize| {
            let word = |colors: &[Option<&[u32]>; 3]| colors[color].map_or(0, |n| n[pixel]);
            from_words(channels.each_ref().map(word))
        };
        let sums = (0..pixels)
            .map(|pixel| ExactSum::from_steps([steps(pixel, 0), steps(pixel, 1), steps(pixel, 2)]));
        Some(Self {
            film: Film::from_sums((file.width, file.height), count, sums)?,
            samples,
            identity: PictureIdentity::parse(file.note(IDENTITY)?)?,
        })
    }

    /// Adds the samples that follow those of the part, as many as `film` has.
    ///
    /// # Panics
    /// Panics if `film` has another size.
    pub(crate) fn append(&mut self, film: &Film) {
        self.samples.end += film.samples();
        self.film.add(film);
    }

    /// Makes sure that this is a part of the picture that is `expected`.
    ///
    /// # Errors
    /// [`PartialPictureError::OtherPicture`] when it is not.
    pub fn expect(&self, expected: &PictureIdentity) -> Result<(), PartialPictureError> {
        match self.identity.difference(expected) {
            Some(difference) => Err(PartialPictureError::OtherPicture { difference }),
            None => Ok(()),
        }
    }

    /// The film that all parts make together. Each is taken when the one before is added, so that
    /// there are never more than two.
    ///
    /// # Errors
    /// When they are not parts of one picture, overlap, or are none.
    pub fn merge(parts: impl IntoIterator<Item = Self>) -> Result<Film, PartialPictureError> {
        Self::add_up(parts).map(|(film, ..)| film)
    }

    /// The part that holds the samples of all `parts`, which come in any order.
    ///
    /// # Errors
    /// As for [`merge`](Self::merge), and when samples between theirs are missing.
    pub fn join(parts: impl IntoIterator<Item = Self>) -> Result<Self, PartialPictureError> {
        let (film, mut ranges, identity) = Self::add_up(parts)?;
        ranges.sort_by_key(|range| range.start);
        for pair in ranges.windows(2) {
            let missing = pair[0].end..pair[1].start;
            if !missing.is_empty() {
                return Err(PartialPictureError::Gap { samples: missing });
            }
        }
        let ends = ranges.first().zip(ranges.last());
        let (first, last) = ends.ok_or(PartialPictureError::Nothing)?;
        Ok(Self {
            samples: first.start..last.end,
            film,
            identity,
        })
    }

    /// The film of all parts, their samples, and what they are parts of.
    fn add_up(
        parts: impl IntoIterator<Item = Self>,
    ) -> Result<(Film, Vec<Range<u32>>, PictureIdentity), PartialPictureError> {
        let mut parts = parts.into_iter();
        let first = parts.next().ok_or(PartialPictureError::Nothing)?;
        let mut film = first.film;
        let mut ranges = vec![first.samples];
        for part in parts {
            part.expect(&first.identity)?;
            if part.film.resolution() != film.resolution() {
                let difference = "size".into();
                return Err(PartialPictureError::OtherPicture { difference });
            }
            let samples = part.samples;
            let overlaps =
                |other: &Range<u32>| samples.start < other.end && other.start < samples.end;
            if ranges.iter().any(overlaps) {
                return Err(PartialPictureError::Overlap { samples });
            }
            film.add(&part.film);
            ranges.push(samples);
        }
        Ok((film, ranges, first.identity))
    }
}

/// The name of the channel with word `word`, from the lowest, of a colour's sums.
fn channel_name(word: usize, color: usize) -> String {
    format!("sum.{word}.{}", COLORS[color])
}

#[cfg(test)]
mod tests;
