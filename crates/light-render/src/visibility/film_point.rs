use lights::glam::Vec2;

/// The middle of a pixel, or of a quarter of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct FilmPoint {
    pub(super) pixel: u32,
    /// The number of the quarter, from 0 to 3; [`WHOLE`](Self::WHOLE) for the pixel.
    part: u8,
}

impl FilmPoint {
    /// Quarters of a pixel.
    pub(super) const QUARTERS: usize = 4;
    const WHOLE: u8 = 4;

    pub(super) const fn of_pixel(pixel: u32) -> Self {
        let part = Self::WHOLE;
        Self { pixel, part }
    }

    pub(super) fn quarters_of(pixel: u32) -> impl Iterator<Item = Self> {
        (0..Self::WHOLE).map(move |part| Self { pixel, part })
    }

    /// How many quarters of a pixel it stands for.
    pub(super) const fn quarters(self) -> usize {
        match self.part {
            Self::WHOLE => Self::QUARTERS,
            _ => 1,
        }
    }

    /// Where in its pixel it is.
    pub(super) fn at(self) -> Vec2 {
        match self.part {
            Self::WHOLE => Vec2::splat(0.5),
            part => 0.25 + 0.5 * Vec2::new(f32::from(part % 2), f32::from(part / 2)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarters_cover_their_pixel() {
        let quarters: Vec<_> = FilmPoint::quarters_of(7).collect();
        let all: usize = quarters.iter().map(|point| point.quarters()).sum();
        assert_eq!(all, FilmPoint::of_pixel(7).quarters(), "as many as a pixel");
        let middle: Vec2 = quarters.iter().map(|point| 0.25 * point.at()).sum();
        assert_eq!(middle, FilmPoint::of_pixel(7).at(), "around the middle");
        for (i, a) in quarters.iter().enumerate() {
            for b in &quarters[..i] {
                assert!(a.at().distance(b.at()) >= 0.5, "{a:?} and {b:?}");
            }
        }
    }
}
