use crate::Diagnostic;
use crate::text::{Line, shown};

/// How many positions, texture coordinates and normals there are so far.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Counts {
    pub(super) positions: usize,
    pub(super) uvs: usize,
    pub(super) normals: usize,
}

/// What a corner of a face has besides its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Attributes {
    pub(super) uv: bool,
    pub(super) normal: bool,
}

/// A corner of a face: indices from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Corner {
    pub(super) position: usize,
    pub(super) uv: Option<usize>,
    /// A normal, or a number although there is none at all.
    pub(super) normal: Option<Option<usize>>,
}

impl Corner {
    /// The corner of a word `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    ///
    /// # Errors
    /// When the word is another, or names what is not there; but a normal may be named where there
    /// is none at all.
    pub(super) fn parse(word: &str, counts: Counts, line: &Line<'_>) -> Result<Self, Diagnostic> {
        let mut parts = word.as_bytes().split(|&byte| byte == b'/');
        let broken = || {
            let word = shown(word);
            line.diagnostic(format!(
                "expected v, v/vt, v//vn or v/vt/vn, found `{word}`"
            ))
        };
        let mut number = || match parts.next() {
            None | Some([]) => Ok(None),
            Some(digits) => whole_number(digits).map(Some).ok_or_else(broken),
        };
        let (position, uv, normal) = (number()?, number()?, number()?);
        if parts.next().is_some() {
            return Err(broken());
        }
        let found = |number: i64, count, what| {
            resolve(number, count).ok_or_else(|| {
                line.diagnostic(format!("{what} {number} of {count} does not exist"))
            })
        };
        let position = found(position.ok_or_else(broken)?, counts.positions, "vertex")?;
        let uv = uv.map(|uv| found(uv, counts.uvs, "texture coordinate"));
        let normal = normal.map(|normal| match counts.normals {
            0 => Ok(None),
            count => found(normal, count, "normal").map(Some),
        });
        Ok(Self {
            position,
            uv: uv.transpose()?,
            normal: normal.transpose()?,
        })
    }

    /// Whether it names a normal although there is none.
    pub(super) fn lacks_normal(&self) -> bool {
        self.normal == Some(None)
    }

    /// The word of it without a normal.
    pub(super) fn without_normal(&self) -> String {
        let position = self.position + 1;
        match self.uv {
            Some(uv) => format!("{position}/{}", uv + 1),
            None => position.to_string(),
        }
    }

    pub(super) fn attributes(&self) -> Attributes {
        Attributes {
            uv: self.uv.is_some(),
            normal: self.normal.flatten().is_some(),
        }
    }
}

/// So many digits fit into 64 bits.
const MOST_DIGITS: usize = 18;

/// The number that `digits` are, with or without a sign; `None` if they are none, or too many.
fn whole_number(digits: &[u8]) -> Option<i64> {
    let (is_negative, digits) = match digits {
        [b'-', digits @ ..] => (true, digits),
        [b'+', digits @ ..] | digits => (false, digits),
    };
    if digits.is_empty() || digits.len() > MOST_DIGITS {
        return None;
    }
    let mut number = 0;
    for digit in digits {
        let digit = digit.wrapping_sub(b'0');
        if digit > 9 {
            return None;
        }
        number = number * 10 + i64::from(digit);
    }
    Some(if is_negative { -number } else { number })
}

/// The index from 0 that `number` means: 1 is the first of `count`, -1 the last.
fn resolve(number: i64, count: usize) -> Option<usize> {
    let index = if number > 0 {
        usize::try_from(number).ok()?.checked_sub(1)?
    } else {
        count.checked_sub(usize::try_from(number.checked_neg()?).ok()?)?
    };
    (index < count).then_some(index)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_have_digits_and_a_sign() {
        let most = "9".repeat(MOST_DIGITS);
        let good = ["0", "-0", "+7", "-12", "0031", &most];
        for text in good {
            let number = whole_number(text.as_bytes());
            assert_eq!(number, text.parse().ok(), "{text}");
        }
        for text in [
            "",
            "-",
            "+",
            "--1",
            "1.0",
            " 1",
            "1e3",
            "9223372036854775808",
        ] {
            assert_eq!(whole_number(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn indices_count_from_one_or_backwards() {
        assert_eq!(resolve(1, 3), Some(0), "first");
        assert_eq!(resolve(3, 3), Some(2), "last");
        assert_eq!(resolve(-1, 3), Some(2), "last");
        assert_eq!(resolve(-3, 3), Some(0), "first");
        for bad in [0, 4, -4, i64::MIN, i64::MAX] {
            assert_eq!(resolve(bad, 3), None, "{bad} of 3");
        }
    }
}
