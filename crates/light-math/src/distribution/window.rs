use glam::Vec2;

/// An axis-aligned rectangle of the unit square: the part of a table that a query is restricted to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Lower corner.
    pub min: Vec2,
    /// Upper corner.
    pub max: Vec2,
}

impl Window {
    /// The whole unit square.
    pub const UNIT: Self = Self::new(Vec2::ZERO, Vec2::ONE);

    /// The rectangle between two corners.
    #[must_use]
    pub const fn new(min: Vec2, max: Vec2) -> Self {
        Self { min, max }
    }

    /// Whether `p` lies in the closed rectangle.
    #[inline]
    #[must_use]
    pub fn contains(&self, p: Vec2) -> bool {
        self.min.cmple(p).all() && p.cmple(self.max).all()
    }

    /// The part in the unit square; `None` if that is empty or a corner is NaN.
    #[inline]
    pub(super) fn clip(&self) -> Option<Self> {
        let clipped = Self::new(self.min.max(Vec2::ZERO), self.max.min(Vec2::ONE));
        let valid = !(self.min.is_nan() || self.max.is_nan());
        (valid && clipped.min.cmplt(clipped.max).all()).then_some(clipped)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clipping() {
        let wide = Window::new(Vec2::splat(-1.0), Vec2::splat(2.0));
        assert_eq!(wide.clip(), Some(Window::UNIT), "to the unit square");
        assert!(wide.contains(Vec2::splat(-1.0)), "closed");
        let outside = Window::new(Vec2::splat(1.5), Vec2::splat(2.0));
        let flat = Window::new(Vec2::splat(0.5), Vec2::new(0.5, 1.0));
        let nan = Window::new(Vec2::new(f32::NAN, 0.0), Vec2::ONE);
        assert!(
            [outside, flat, nan].iter().all(|w| w.clip().is_none()),
            "nothing left"
        );
    }
}
