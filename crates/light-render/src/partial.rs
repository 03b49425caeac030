use core::error::Error;
use core::fmt;
use core::ops::Range;

use light_scene::ChannelFile;
use lights::glam::Vec3;

use crate::{ExactSum, Film};

/// A picture of some of its samples, with exact sums: parts of one picture add up to the same bits as if it had been
/// rendered at once.
///
/// In a file it is an ordinary OpenEXR picture (R, G, B: the mean) with further channels that hold the sums.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PartialPicture {
    /// The sums.
    pub film: Film,
    /// The numbers of the samples.
    pub samples: Range<u32>,
    /// What was rendered, in words that are equal only for parts of the same picture.
    pub subject: String,
}

/// Why pictures do not add up.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PartialPictureError {
    /// The file holds no sums: it was not rendered as a part.
    NoPart,
    /// The parts are not of one picture: scene, size or settings differ.
    OtherPicture,
    /// Two parts hold the same samples.
    Overlap {
        /// The samples of the later part.
        samples: Range<u32>,
    },
    /// There is nothing to add.
    Nothing,
}

const SAMPLES: &str = "lights.samples";
const SUBJECT: &str = "lights.subject";
const COLORS: [&str; 3] = ["R", "G", "B"];

impl PartialPicture {
    /// The file that holds this part.
    #[must_use]
    pub fn to_file(&self) -> ChannelFile {
        let (width, height) = self.film.resolution();
        let mut channels = color_channels("", self.film.develop());
        let lanes: Vec<_> = self.film.sums().iter().map(|sum| sum.to_lanes()).collect();
        for lane in 0..ExactSum::LANES {
            let colors = lanes.iter().map(|lanes| lanes[lane]).collect();
            channels.extend(color_channels(&lane_prefix(lane), colors));
        }
        let Range { start, end } = self.samples;
        ChannelFile {
            width,
            height,
            channels,
            notes: vec![
                (SAMPLES.into(), format!("{start}..{end}")),
                (SUBJECT.into(), self.subject.clone()),
            ],
        }
    }

    /// The part that a file holds.
    ///
    /// # Errors
    /// [`PartialPictureError::NoPart`] when it holds none.
    pub fn from_file(file: &ChannelFile) -> Result<Self, PartialPictureError> {
        Self::parse(file).ok_or(PartialPictureError::NoPart)
    }

    fn parse(file: &ChannelFile) -> Option<Self> {
        let (start, end) = file.note(SAMPLES)?.split_once("..")?;
        let samples: Range<u32> = start.parse().ok()?..end.parse().ok()?;
        let pixels = file.width as usize * file.height as usize;
        let mut sums = vec![ExactSum::default(); pixels];
        for lane in 0..ExactSum::LANES {
            let prefix = lane_prefix(lane);
            let [r, g, b] = COLORS.map(|color| file.channel(&format!("{prefix}{color}")));
            let colors = r?.iter().zip(g?).zip(b?);
            for (sum, ((&r, &g), &b)) in sums.iter_mut().zip(colors) {
                *sum += Vec3::new(r, g, b);
            }
        }
        let count = samples.end.checked_sub(samples.start)?;
        Some(Self {
            film: Film::from_sums((file.width, file.height), count, sums)?,
            samples,
            subject: file.note(SUBJECT)?.into(),
        })
    }

    /// Adds the samples that follow those of the part, as many as `film` has.
    ///
    /// # Panics
    /// Panics if `film` has another size.
    pub fn append(&mut self, film: &Film) {
        self.samples.end += film.samples();
        self.film.add(film);
    }

    /// The film that all parts make together.
    ///
    /// # Errors
    /// When they are not parts of one picture, overlap, or are none.
    pub fn merge(parts: Vec<Self>) -> Result<Film, PartialPictureError> {
        let mut parts = parts.into_iter();
        let first = parts.next().ok_or(PartialPictureError::Nothing)?;
        let mut film = first.film;
        let mut ranges = vec![first.samples];
        for part in parts {
            let same_size = part.film.resolution() == film.resolution();
            if part.subject != first.subject || !same_size {
                return Err(PartialPictureError::OtherPicture);
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
        Ok(film)
    }
}

fn lane_prefix(lane: usize) -> String {
    format!("sum.{lane}.")
}

/// Three channels with the given prefix.
fn color_channels(prefix: &str, colors: Vec<Vec3>) -> Vec<(String, Vec<f32>)> {
    (0..3)
        .zip(COLORS)
        .map(|(i, color)| {
            let numbers = colors.iter().map(|c| c[i]).collect();
            (format!("{prefix}{color}"), numbers)
        })
        .collect()
}

impl fmt::Display for PartialPictureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoPart => f.write_str("expected a picture rendered with --samples"),
            Self::OtherPicture => {
                f.write_str("expected a part of the same picture: scene, size or settings differ")
            }
            Self::Overlap { samples } => {
                let Range { start, end } = samples;
                write!(f, "samples {start}..{end} are in another part too")
            }
            Self::Nothing => f.write_str("expected at least one part"),
        }
    }
}

impl Error for PartialPictureError {}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(samples: Range<u32>, subject: &str) -> PartialPicture {
        let mut film = Film::new(2, 1);
        for sample in samples.clone() {
            let x = 1.0 / (sample as f32 + 3.0);
            for sum in film.expose(1) {
                *sum += Vec3::new(x, x * 1e9, x * 1e-9);
            }
        }
        PartialPicture {
            film,
            samples,
            subject: subject.into(),
        }
    }

    #[test]
    fn parts_add_up_to_the_whole_through_files() {
        let back = |part: &PartialPicture| PartialPicture::from_file(&part.to_file());
        let parts = [3..7, 0..3, 7..20].map(|range| back(&part(range, "a")).expect("a part"));
        let whole = part(0..20, "a").film;
        assert_eq!(
            PartialPicture::merge(parts.into()),
            Ok(whole),
            "to the last bit"
        );
    }

    #[test]
    fn what_does_not_belong_together_is_refused() {
        let merge = |parts: &[PartialPicture]| PartialPicture::merge(parts.to_vec()).err();
        let a = part(0..4, "a");
        let other = Some(PartialPictureError::OtherPicture);
        assert_eq!(
            merge(&[a.clone(), part(4..5, "b")]),
            other,
            "another subject"
        );
        let samples = 3..5;
        let overlap = Some(PartialPictureError::Overlap { samples });
        assert_eq!(
            merge(&[a.clone(), part(3..5, "a")]),
            overlap,
            "sample 3 twice"
        );
        assert_eq!(merge(&[]), Some(PartialPictureError::Nothing), "nothing");
        let mut file = a.to_file();
        file.notes.clear();
        let no_part = Err(PartialPictureError::NoPart);
        assert_eq!(
            PartialPicture::from_file(&file),
            no_part,
            "an ordinary picture"
        );
    }
}
