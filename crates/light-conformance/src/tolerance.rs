/// How far two numbers may be apart: `absolute + relative * |reference|`.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Part that grows with the reference.
    pub relative: f32,
    /// Part that does not.
    pub absolute: f32,
}

impl Tolerance {
    /// The tolerance that the vectors state in general: a relative 1e-5.
    pub const GENERAL: Self = Self::new(1e-5, 1e-6);

    /// A tolerance of `relative * |reference| + absolute`.
    #[must_use]
    pub const fn new(relative: f32, absolute: f32) -> Self {
        Self { relative, absolute }
    }

    /// Whether `ours` is near enough to `theirs`; not-a-number and the infinities are near to
    /// themselves alone.
    #[must_use]
    pub fn accepts(self, ours: f32, theirs: f32) -> bool {
        if !(ours.is_finite() && theirs.is_finite()) {
            return ours == theirs || (ours.is_nan() && theirs.is_nan());
        }
        (ours - theirs).abs() <= self.absolute + self.relative * theirs.abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tolerance_keeps_oddities_apart() {
        let t = Tolerance::GENERAL;
        assert!(
            t.accepts(f32::NAN, f32::NAN) && !t.accepts(f32::NAN, 0.0),
            "NaN"
        );
        assert!(t.accepts(f32::INFINITY, f32::INFINITY), "same infinity");
        assert!(
            !t.accepts(f32::NEG_INFINITY, f32::INFINITY),
            "opposite infinities"
        );
        assert!(
            !t.accepts(1e38, f32::INFINITY),
            "finite is not near infinite"
        );
        assert!(
            t.accepts(1.000_005, 1.0) && !t.accepts(1.000_02, 1.0),
            "relative"
        );
    }
}
