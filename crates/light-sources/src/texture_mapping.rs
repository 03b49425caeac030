use crate::floor::floor as whole;
use crate::glam::{Affine2, Vec2};
use light_math::float::floor;

/// The mapping of an image to a surface: from surface parameters to image coordinates, with the
/// rule beyond its edges.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TextureMapping {
    /// From surface parameters (u, v) to those of the image, of which (0, 0) is the lower left
    /// corner; finite.
    pub transform: Affine2,
    /// The rule beyond the left and right edges, and beyond the upper and lower.
    pub wrap: [Wrap; 2],
}

/// The rule beyond the edges of an image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Wrap {
    /// The texel at the edge.
    #[default]
    Clamp,
    /// The image is repeated.
    Repeat,
    /// The image is repeated, every second time mirrored.
    Mirror,
    /// Black.
    Black,
}

impl TextureMapping {
    /// The image is repeated over each unit square of surface parameters.
    pub const REPEAT: Self = Self {
        transform: Affine2::IDENTITY,
        wrap: [Wrap::Repeat; 2],
    };

    pub(crate) fn is_valid(&self) -> bool {
        self.transform.is_finite()
    }

    /// The image coordinates, with (0, 0) at the upper left corner, where row 0 is.
    #[inline]
    #[must_use]
    pub fn place(&self, uv: Vec2) -> Vec2 {
        let place = self.transform.transform_point2(uv);
        Vec2::new(place.x, 1.0 - place.y)
    }
}

/// The two texels of a row around a position, and the weight of linear interpolation between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Neighbours {
    /// `None` where there is no texel.
    pub(crate) texels: [Option<u32>; 2],
    pub(crate) part: f32,
}

impl Wrap {
    /// The texels around the position `s` in a row of `n` texels over `[0, 1]`.
    #[inline]
    pub(crate) fn around(self, s: f32, n: u32) -> Neighbours {
        let count = n as f32;
        let s = if s.is_finite() { s } else { 0.0 };
        let folded = match self {
            Self::Clamp => s.clamp(0.0, 1.0),
            Self::Repeat => s - floor(s),
            Self::Mirror => {
                let turn = s - 2.0 * floor(0.5 * s);
                turn.min(2.0 - turn)
            }
            // The next line of texels has none.
            Self::Black => s.clamp(-1.0, 2.0),
        };
        let t = folded * count - 0.5;
        let first = floor(t);
        Neighbours {
            texels: [first, first + 1.0].map(|i| self.texel_nearby(i, n)),
            part: t - first,
        }
    }

    /// The texel for the whole number `i`, at any distance from a row of `n`.
    #[inline]
    pub(crate) fn texel_anywhere(self, i: f64, n: u32) -> Option<u32> {
        let count = f64::from(n);
        let folded = match self {
            Self::Clamp | Self::Black => i,
            Self::Repeat => i - count * whole(i / count),
            Self::Mirror => {
                let turn = i - 2.0 * count * whole(0.5 * i / count);
                turn.min(2.0 * count - 1.0 - turn)
            }
        };
        self.texel(folded, n)
    }

    /// The texel for the whole number `i`, which is less than `n` away from a row of `n`.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a whole number below n"
    )]
    pub(crate) fn texel(self, i: f64, n: u32) -> Option<u32> {
        if i >= 0.0 && i < f64::from(n) {
            return Some(i as u32);
        }
        self.texel_beyond(i < 0.0, n)
    }

    /// The same in single precision, for queries.
    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a whole number, and the cast saturates"
    )]
    fn texel_nearby(self, i: f32, n: u32) -> Option<u32> {
        if i >= 0.0 && (i as u32) < n {
            return Some(i as u32);
        }
        self.texel_beyond(i < 0.0, n)
    }

    /// The texel for a place before a row of `n`, or behind it.
    #[inline]
    const fn texel_beyond(self, is_before: bool, n: u32) -> Option<u32> {
        match self {
            Self::Clamp | Self::Mirror => Some(if is_before { 0 } else { n - 1 }),
            Self::Repeat => Some(if is_before { n - 1 } else { 0 }),
            Self::Black => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The weight of each of four texels at `s`.
    fn weights(wrap: Wrap, s: f32) -> [f32; 4] {
        let Neighbours { texels, part } = wrap.around(s, 4);
        let mut weights = [0.0; 4];
        for (texel, weight) in texels.into_iter().zip([1.0 - part, part]) {
            if let Some(texel) = texel {
                weights[texel as usize] += weight;
            }
        }
        weights
    }

    #[test]
    fn edges_go_on_as_they_are_told() {
        for wrap in [Wrap::Clamp, Wrap::Repeat, Wrap::Mirror, Wrap::Black] {
            assert_eq!(weights(wrap, 0.5), [0.0, 0.5, 0.5, 0.0], "{wrap:?}: inside");
            assert_eq!(
                weights(wrap, 0.625),
                [0.0, 0.0, 1.0, 0.0],
                "{wrap:?}: a centre"
            );
        }
        for (wrap, at_0, at_1, below, above) in [
            (
                Wrap::Clamp,
                [1., 0., 0., 0.],
                [0., 0., 0., 1.],
                [1., 0., 0., 0.],
                [0., 0., 0., 1.],
            ),
            (
                Wrap::Repeat,
                [0.5, 0., 0., 0.5],
                [0.5, 0., 0., 0.5],
                [0., 0., 1., 0.],
                [0., 1., 0., 0.],
            ),
            (
                Wrap::Mirror,
                [1., 0., 0., 0.],
                [0., 0., 0., 1.],
                [0., 1., 0., 0.],
                [0., 0., 1., 0.],
            ),
            (
                Wrap::Black,
                [0.5, 0., 0., 0.],
                [0., 0., 0., 0.5],
                [0.; 4],
                [0.; 4],
            ),
        ] {
            assert_eq!(weights(wrap, 0.0), at_0, "{wrap:?} at 0");
            assert_eq!(weights(wrap, 1.0), at_1, "{wrap:?} at 1");
            assert_eq!(weights(wrap, -0.375), below, "{wrap:?} below");
            assert_eq!(weights(wrap, 1.375), above, "{wrap:?} above");
        }
        for wrap in [Wrap::Repeat, Wrap::Mirror] {
            assert_eq!(
                weights(wrap, 6.625),
                weights(wrap, 0.625),
                "{wrap:?}: a period"
            );
        }
        for s in [f32::NAN, f32::INFINITY, -1e38, 1e38] {
            for wrap in [Wrap::Clamp, Wrap::Repeat, Wrap::Mirror, Wrap::Black] {
                let sum: f32 = weights(wrap, s).iter().sum();
                assert!((0.0..=1.0).contains(&sum), "{wrap:?} at {s}: {sum}");
            }
        }
    }

    #[test]
    fn row_0_lies_on_top() {
        let twice = TextureMapping {
            transform: Affine2::from_scale(Vec2::new(2.0, 1.0)),
            ..TextureMapping::REPEAT
        };
        assert_eq!(
            twice.place(Vec2::new(0.5, 0.25)),
            Vec2::new(1.0, 0.75),
            "v runs up"
        );
    }
}
