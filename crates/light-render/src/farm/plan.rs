use core::error::Error;
use core::fmt;
use core::num::NonZeroU32;
use core::ops::Range;

use super::FarmFrames;

/// A picture in parts, or each frame of an animation, for engines that start each part when and
/// where they like.
///
/// Parts are ranges of samples: part `i` of `n` takes those from `samples * i / n` to
/// `samples * (i + 1) / n`. Above [`GROUP`](Self::GROUP) parts, groups of them are merged first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FarmPlan {
    name: String,
    folder: String,
    working_folder: String,
    render: Vec<String>,
    samples: u32,
    parts: u32,
    threads: Option<NonZeroU32>,
    frames: Option<FarmFrames>,
}

/// Why there is no plan.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FarmPlanError {
    /// A part would have no sample.
    TooManyParts {
        /// How many samples a pixel there are.
        samples: u32,
    },
    /// A word of the command or a folder holds a line break or `{{`, which engines read.
    Unprintable {
        /// The word.
        word: String,
    },
}

impl FarmPlan {
    /// Parts that one merge takes.
    pub const GROUP: u32 = 32;

    /// A plan for the picture that `lights render` makes with the words `render`, which say neither
    /// which samples nor where to write.
    ///
    /// `name` is what engines show; `folder` holds the job, the parts and the picture;
    /// `working_folder` is where relative paths of `render` begin: both are absolute paths that all
    /// machines see. Each part runs on `threads` threads, or has a machine for itself.
    ///
    /// # Errors
    /// More parts than samples, or a word that an engine would read otherwise.
    pub fn new(
        name: impl Into<String>,
        [folder, working_folder]: [String; 2],
        render: Vec<String>,
        (samples, parts): (u32, NonZeroU32),
        threads: Option<NonZeroU32>,
    ) -> Result<Self, FarmPlanError> {
        if parts.get() > samples {
            return Err(FarmPlanError::TooManyParts { samples });
        }
        let plan = Self {
            name: name.into(),
            folder,
            working_folder,
            render,
            samples,
            parts: parts.get(),
            threads,
            frames: None,
        };
        match plan.unprintable() {
            Some(word) => Err(FarmPlanError::Unprintable { word }),
            None => Ok(plan),
        }
    }

    /// The same for each of these frames: a word of the command that is their pattern stands for the
    /// scene.
    #[must_use]
    pub fn with_frames(self, frames: FarmFrames) -> Self {
        Self {
            frames: Some(frames),
            ..self
        }
    }

    /// A word that an engine would not take as it is.
    fn unprintable(&self) -> Option<String> {
        let words = [&self.name, &self.folder, &self.working_folder];
        let is_read = |word: &&String| word.contains("{{") || word.contains(char::is_control);
        words.into_iter().chain(&self.render).find(is_read).cloned()
    }

    /// What engines show.
    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// The path of a file in the folder of the job.
    pub(super) fn path(&self, file: &str) -> String {
        format!("{}/{file}", self.folder)
    }

    /// Where relative paths of the command begin.
    pub(super) fn working_folder(&self) -> &str {
        &self.working_folder
    }

    /// The words of `lights render`.
    pub(super) fn render(&self) -> &[String] {
        &self.render
    }

    /// Samples a pixel of the whole picture.
    pub(super) const fn samples(&self) -> u32 {
        self.samples
    }

    /// How many parts there are.
    #[must_use]
    pub const fn parts(&self) -> u32 {
        self.parts
    }

    /// The samples of a part.
    ///
    /// # Panics
    /// Panics if there are not as many parts.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "at most the samples")]
    pub fn part(&self, index: u32) -> Range<u32> {
        assert!(index < self.parts, "a part of the plan");
        let start = |index: u32| {
            let before = u64::from(self.samples) * u64::from(index);
            (before / u64::from(self.parts)) as u32
        };
        start(index)..start(index + 1)
    }

    /// The frames, if the pictures are those of an animation.
    pub(super) const fn frames(&self) -> Option<&FarmFrames> {
        self.frames.as_ref()
    }

    /// How many groups of parts are merged first; none if there are few parts.
    pub(super) const fn groups(&self) -> Option<u32> {
        if self.parts > Self::GROUP {
            Some(self.parts.div_ceil(Self::GROUP))
        } else {
            None
        }
    }

    /// Threads of a part; a whole machine's if none.
    pub(super) const fn threads(&self) -> Option<NonZeroU32> {
        self.threads
    }
}

impl fmt::Display for FarmPlanError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooManyParts { samples } => {
                write!(f, "expected at most {samples} parts, one a sample")
            }
            Self::Unprintable { word } => {
                write!(f, "expected no line break and no {{{{ in {word:?}")
            }
        }
    }
}

impl Error for FarmPlanError {}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan(samples: u32, parts: u32) -> Result<FarmPlan, FarmPlanError> {
        let folders = ["/farm/job".into(), "/home/it's".into()];
        let render = vec!["scene.obj".into(), "--group".into(), "a=b*".into()];
        let parts = NonZeroU32::new(parts).expect("parts");
        FarmPlan::new("scene", folders, render, (samples, parts), None)
    }

    #[test]
    fn parts_cover_every_sample_once() {
        for (samples, parts) in [(1, 1), (7, 7), (64, 3), (1000, 33), (u32::MAX, 7)] {
            let plan = plan(samples, parts).expect("a plan");
            let mut next = 0;
            for index in 0..parts {
                let part = plan.part(index);
                assert_eq!(part.start, next, "part {index} of {parts}");
                assert!(!part.is_empty(), "part {index} of {parts}");
                next = part.end;
            }
            assert_eq!(next, samples, "{parts} parts");
        }
        let error = FarmPlanError::TooManyParts { samples: 7 };
        assert_eq!(plan(7, 8), Err(error), "a part without a sample");
    }

    #[test]
    fn words_that_engines_read_are_refused() {
        for word in ["a\nb", "{{Param.A}}", "a\u{7}"] {
            let folders = [word.into(), "/".into()];
            let parts = (8, NonZeroU32::MIN);
            let error = FarmPlan::new("a", folders, Vec::new(), parts, None).expect_err(word);
            assert!(error.to_string().contains("{{"), "{error}");
        }
    }

    #[test]
    fn groups_are_of_many_parts_alone() {
        assert_eq!(plan(99, 32).map(|plan| plan.groups()), Ok(None), "few");
        assert_eq!(plan(99, 33).map(|plan| plan.groups()), Ok(Some(2)), "many");
    }
}
