use core::fmt;
use core::ops::RangeInclusive;
use core::str::FromStr;

use super::shell::quoted;

/// Frames of an animation: a scene file for each, whose names differ in a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FarmFrames {
    numbers: RangeInclusive<u32>,
    pattern: String,
    /// Where the number stands in the pattern: a run of `#`.
    hashes: core::ops::Range<usize>,
}

/// The numbers of frames, `A-B` with both of them or one number alone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FrameNumbers(RangeInclusive<u32>);

impl FarmFrames {
    /// The frames of these numbers. A run of `#` in `pattern`, the last one, stands for the number,
    /// with zeros before it up to the length of the run; `None` without such a run.
    #[must_use]
    pub fn new(FrameNumbers(numbers): FrameNumbers, pattern: impl Into<String>) -> Option<Self> {
        let pattern = pattern.into();
        let end = pattern.rfind('#')? + 1;
        let start = pattern[..end].trim_end_matches('#').len();
        Some(Self {
            numbers,
            pattern,
            hashes: start..end,
        })
    }

    /// The numbers of the frames.
    #[must_use]
    pub fn numbers(&self) -> RangeInclusive<u32> {
        self.numbers.clone()
    }

    /// The scene of all frames, with the run of `#`.
    pub(super) fn pattern(&self) -> &str {
        &self.pattern
    }

    /// The scene of a frame.
    #[must_use]
    pub fn scene(&self, frame: u32) -> String {
        let [before, after] = self.around_number();
        format!("{before}{}{after}", self.name(frame))
    }

    /// The number of a frame as it stands in names of files.
    #[must_use]
    pub fn name(&self, frame: u32) -> String {
        format!("{frame:0width$}", width = self.hashes.len())
    }

    /// The scene as a word of a shell in which `$frame` is the number as it stands in names.
    pub(super) fn word(&self) -> String {
        let [before, after] = self.around_number().map(|text| match text {
            "" => String::new(),
            text => quoted(text),
        });
        format!("{before}\"$frame\"{after}")
    }

    /// A command of a shell that sets `$frame` to the name of the number in `$2`.
    pub(super) fn set_frame(&self) -> String {
        format!("frame=$(printf %0{}d \"$2\")", self.hashes.len())
    }

    fn around_number(&self) -> [&str; 2] {
        [
            &self.pattern[..self.hashes.start],
            &self.pattern[self.hashes.end..],
        ]
    }
}

impl FromStr for FrameNumbers {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (first, last) = text.split_once('-').unwrap_or((text, text));
        match (first.parse(), last.parse()) {
            (Ok(first), Ok(last)) if first <= last => Ok(Self(first..=last)),
            _ => Err("expected the first and the last frame, as 1-24".into()),
        }
    }
}

impl fmt::Display for FarmFrames {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (first, last) = (*self.numbers.start(), *self.numbers.end());
        write!(f, "{} to {}", self.name(first), self.name(last))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames(numbers: &str, pattern: &str) -> FarmFrames {
        let numbers = numbers.parse().expect("numbers");
        FarmFrames::new(numbers, pattern).expect("a run of #")
    }

    #[test]
    fn the_last_run_stands_for_the_number() {
        let shot = frames("9-10", "a##/shot.####.pbrt");
        assert_eq!(shot.scene(10), "a##/shot.0010.pbrt", "four digits");
        assert_eq!(shot.scene(12_345), "a##/shot.12345.pbrt", "five");
        assert_eq!(shot.word(), "'a##/shot.'\"$frame\".pbrt", "in a shell");
        assert_eq!(shot.set_frame(), "frame=$(printf %04d \"$2\")", "zeros");
        assert_eq!(shot.to_string(), "0009 to 0010", "both");
        assert_eq!(frames("7", "#").word(), "\"$frame\"", "nothing else");
        let one = FrameNumbers(1..=1);
        assert_eq!(FarmFrames::new(one, "shot.pbrt"), None, "no number");
    }

    #[test]
    fn numbers_are_the_first_and_the_last() {
        assert_eq!(frames("0-3", "#").numbers(), 0..=3, "both are meant");
        assert_eq!(frames("5", "#").numbers(), 5..=5, "one");
        for wrong in [
            "",
            "-",
            "3-",
            "-3",
            "4-3",
            "1-2-3",
            "a",
            "1..3",
            "4294967296",
        ] {
            assert!(wrong.parse::<FrameNumbers>().is_err(), "{wrong}");
        }
    }
}
