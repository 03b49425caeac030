use crate::ray::Span;

/// The step length of a march through a medium, in scene units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepSize(f32);

/// Why a step size is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum StepSizeError {
    /// It is not a finite number above zero.
    NotPositive,
}

impl StepSize {
    /// The most steps of a march; the part of an unbounded ray beyond them is ignored.
    pub const MAX_STEPS: u32 = 1 << 16;

    /// Steps of the given length.
    ///
    /// # Errors
    /// The length is not finite and above zero.
    pub fn new(length: f32) -> Result<Self, StepSizeError> {
        if length > 0.0 && length.is_finite() {
            Ok(Self(length))
        } else {
            Err(StepSizeError::NotPositive)
        }
    }

    /// The length.
    #[must_use]
    pub const fn length(self) -> f32 {
        self.0
    }

    /// `span` in equal steps no longer than this one; a bounded span that would need more than
    /// [`MAX_STEPS`](Self::MAX_STEPS) is divided into as many.
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a whole number from 1 to MAX_STEPS"
    )]
    pub fn march(self, span: Span) -> March {
        let wanted = light_math::float::ceil(span.length() / self.0).max(1.0);
        let n = wanted.min(Self::MAX_STEPS as f32);
        March {
            t0: span.t0,
            step: if span.t1.is_finite() {
                span.length() / n
            } else {
                self.0
            },
            n: n as u32,
        }
    }
}

/// Equal steps along a ray, in scene units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct March {
    /// The distance at which the first step begins.
    pub t0: f32,
    /// The length of a step.
    pub step: f32,
    /// The number of steps.
    pub n: u32,
}

impl March {
    /// The step with the given number, from 0.
    #[inline]
    #[must_use]
    pub fn segment(&self, i: u32) -> Span {
        Span {
            t0: self.t0 + self.step * i as f32,
            t1: self.t0 + self.step * (i + 1) as f32,
        }
    }
}

impl core::fmt::Display for StepSizeError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("the step of a march must be finite and above zero")
    }
}

impl core::error::Error for StepSizeError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_equal_and_no_longer_than_requested() {
        let march = StepSize::new(0.3)
            .expect("positive")
            .march(Span { t0: 1.0, t1: 2.0 });
        assert_eq!((march.n, march.step), (4, 0.25), "four quarters");
        assert_eq!(march.segment(3), Span { t0: 1.75, t1: 2.0 }, "the last one");
    }

    #[test]
    fn a_long_span_gets_longer_steps() {
        let march = StepSize::new(1.0).expect("positive").march(Span {
            t0: 0.0,
            t1: 131_072.0,
        });
        assert_eq!(
            (march.n, march.step),
            (StepSize::MAX_STEPS, 2.0),
            "all of it"
        );
    }

    #[test]
    fn a_ray_without_end_is_left_at_some_point() {
        let march = StepSize::new(0.5).expect("positive").march(Span {
            t0: 0.0,
            t1: f32::INFINITY,
        });
        assert_eq!((march.n, march.step), (StepSize::MAX_STEPS, 0.5), "bounded");
    }

    #[test]
    fn nonsense_is_refused() {
        for length in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            assert_eq!(
                StepSize::new(length),
                Err(StepSizeError::NotPositive),
                "{length}"
            );
        }
    }
}
