use core::fmt::{self, Write};

/// All that a picture depends on except its samples: parts of equal identities add up to one
/// picture.
///
/// A list of aspects, such as the lights or the seed, each with a value without line breaks: a
/// number, a word, a digest.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PictureIdentity {
    aspects: Vec<(String, String)>,
}

impl PictureIdentity {
    /// The identity with the given aspects.
    #[must_use]
    pub fn new<N: Into<String>>(aspects: impl IntoIterator<Item = (N, String)>) -> Self {
        let aspects = aspects.into_iter();
        Self {
            aspects: aspects.map(|(name, value)| (name.into(), value)).collect(),
        }
    }

    /// The identity that was [displayed](fmt::Display) as `text`.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let aspects = text.lines().map(|line| {
            let (name, value) = line.split_once(": ")?;
            Some((name.to_owned(), value.to_owned()))
        });
        Some(Self {
            aspects: aspects.collect::<Option<_>>()?,
        })
    }

    /// Where `self` differs from what is `expected`, in words; `None` where they are equal.
    #[must_use]
    pub fn difference(&self, expected: &Self) -> Option<String> {
        if self == expected {
            return None;
        }
        let mut words = String::new();
        for (name, value) in &expected.aspects {
            let found = self.aspects.iter().find(|(other, _)| other == name);
            let found = found.map_or("nothing", |(_, found)| found);
            if found != value {
                let separator = if words.is_empty() { "" } else { ", " };
                // Writing to a string does not fail.
                let _ = write!(words, "{separator}{name} {found}, expected {value}");
            }
        }
        if words.is_empty() {
            words.push_str("it depends on more than expected");
        }
        Some(words)
    }
}

impl fmt::Display for PictureIdentity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, (name, value)) in self.aspects.iter().enumerate() {
            let separator = if index == 0 { "" } else { "\n" };
            write!(f, "{separator}{name}: {value}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn identity(aspects: &[(&str, &str)]) -> PictureIdentity {
        PictureIdentity::new(
            aspects
                .iter()
                .map(|&(name, value)| (name, value.to_owned())),
        )
    }

    #[test]
    fn text_and_back() {
        let identity = identity(&[("seed", "3"), ("view", "4 x 5: all")]);
        assert_eq!(identity.to_string(), "seed: 3\nview: 4 x 5: all", "lines");
        assert_eq!(
            PictureIdentity::parse(&identity.to_string()),
            Some(identity),
            "back"
        );
        assert_eq!(PictureIdentity::parse("seed 3"), None, "no value");
    }

    #[test]
    fn differences_are_named() {
        let one = identity(&[("seed", "3"), ("lights", "ab")]);
        assert_eq!(one.difference(&one), None, "the same");
        let difference = |aspects: &[(&str, &str)]| identity(aspects).difference(&one);
        let words = |text: &str| Some(text.to_owned());
        let seed = difference(&[("seed", "4"), ("lights", "ab")]);
        assert_eq!(seed, words("seed 4, expected 3"), "one");
        let both = difference(&[("lights", "cd")]);
        let expected = "seed nothing, expected 3, lights cd, expected ab";
        assert_eq!(both, words(expected), "both");
        let more = difference(&[("seed", "3"), ("lights", "ab"), ("fog", "x")]);
        assert_eq!(more, words("it depends on more than expected"), "more");
        assert!(
            difference(&[("lights", "ab"), ("seed", "3")]).is_some(),
            "order"
        );
    }
}
