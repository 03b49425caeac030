use core::fmt;

/// Why weights cannot be made into a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TableError {
    /// There is no weight at all.
    Empty,
    /// There are more weights than indices can address: 2^24 along an axis, 2^32 in an alias table.
    TooLarge,
    /// The storage has another length than the table needs.
    SizeMismatch {
        /// The length that is needed.
        expected: usize,
        /// The length that was given.
        found: usize,
    },
    /// A weight is NaN or infinite.
    NotFinite {
        /// The position of the first such weight.
        index: usize,
    },
    /// A weight is negative.
    Negative {
        /// The position of the first such weight.
        index: usize,
    },
    /// No weight is positive, so there is nothing to sample in proportion to.
    AllZero,
    /// The integral over the domain is above the range of `f32`.
    Overflow,
    /// The domain is empty, inverted, or not finite.
    Domain,
    /// The stored numbers were not written by the builder of this type.
    Malformed,
}

impl fmt::Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("there are no weights"),
            Self::TooLarge => f.write_str("there are more weights than indices can address"),
            Self::SizeMismatch { expected, found } => {
                write!(
                    f,
                    "the storage holds {found} elements, the table needs {expected}"
                )
            }
            Self::NotFinite { index } => write!(f, "weight {index} is not finite"),
            Self::Negative { index } => write!(f, "weight {index} is negative"),
            Self::AllZero => f.write_str("no weight is positive"),
            Self::Overflow => f.write_str("the integral of the weights is too large for f32"),
            Self::Domain => f.write_str("the domain is empty or not finite"),
            Self::Malformed => f.write_str("the stored numbers are no table of this type"),
        }
    }
}

impl core::error::Error for TableError {}

/// The sum of `weights`, after the rules that all tables share.
pub(super) const fn total(weights: &[f32]) -> Result<f64, TableError> {
    if weights.is_empty() {
        return Err(TableError::Empty);
    }
    let mut total = 0.0;
    let mut index = 0;
    while index < weights.len() {
        let weight = weights[index];
        if !weight.is_finite() {
            return Err(TableError::NotFinite { index });
        }
        if weight < 0.0 {
            return Err(TableError::Negative { index });
        }
        total += weight as f64;
        index += 1;
    }
    Ok(total)
}

/// Like [`total`]; an error if all weights are zero.
pub(super) const fn positive_total(weights: &[f32]) -> Result<f64, TableError> {
    match total(weights) {
        Ok(total) if total > 0.0 => Ok(total),
        Ok(_) => Err(TableError::AllZero),
        Err(error) => Err(error),
    }
}

/// Whether the storage has the length that the table needs.
pub(super) const fn check_len(expected: usize, found: usize) -> Result<(), TableError> {
    if expected == found {
        Ok(())
    } else {
        Err(TableError::SizeMismatch { expected, found })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_the_culprit() {
        assert_eq!(total(&[]), Err(TableError::Empty), "empty");
        assert_eq!(
            total(&[1.0, f32::NAN]),
            Err(TableError::NotFinite { index: 1 }),
            "NaN"
        );
        assert_eq!(
            total(&[f32::INFINITY]),
            Err(TableError::NotFinite { index: 0 }),
            "infinite"
        );
        assert_eq!(
            total(&[0.0, 0.0, -1.0]),
            Err(TableError::Negative { index: 2 }),
            "negative"
        );
        assert_eq!(
            positive_total(&[0.0, -0.0]),
            Err(TableError::AllZero),
            "zero"
        );
        assert_eq!(
            total(&[f32::MAX; 3]).map(|t| t > 1e39),
            Ok(true),
            "no overflow"
        );
    }
}
