use alloc::vec::Vec;

use crate::glam::{Vec2, Vec3};
use crate::image::Image;
use crate::shape::Shape;
use crate::texture_mapping::TextureMapping;

/// An image in ever coarser sizes: how bright a shape is on which a part of it lies.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TextureMeans {
    /// The first is the image itself, and all have its mean; the last is a single texel.
    levels: Vec<Image>,
    /// The largest value of each channel.
    brightest: Vec3,
}

/// A part of the plane in which an image lies.
struct Part {
    min: Vec2,
    max: Vec2,
}

/// Most rows and columns of the points at which a shape looks at its texture.
const POINTS: u16 = 8;

/// As many where all of them see the same few texels.
const FEW_POINTS: u16 = 3;

/// Rows and columns of points that are less than a texel apart on a part so many texels wide, if there are enough of them.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to what there is"
)]
fn points_for(texels: f32) -> u16 {
    // NaN, of a mapping to nowhere, becomes the least.
    (texels + 2.0).clamp(f32::from(FEW_POINTS), f32::from(POINTS)) as u16
}

impl TextureMeans {
    pub(crate) fn new(image: Image) -> Self {
        let brightest = image.texels().fold(Vec3::ZERO, Vec3::max);
        let mut levels = alloc::vec![image];
        while let Some(coarser) = levels.last().and_then(Image::halved) {
            levels.push(coarser);
        }
        Self { levels, brightest }
    }

    pub(crate) fn image(&self) -> &Image {
        &self.levels[0]
    }

    pub(crate) fn levels(&self) -> &[Image] {
        &self.levels
    }

    pub(crate) const fn brightest(&self) -> Vec3 {
        self.brightest
    }

    pub(crate) fn bytes(&self) -> usize {
        self.levels.iter().map(Image::bytes).sum()
    }

    /// The mean of the texture over the area of `shape`.
    ///
    /// The shape's surface parameters at points spread over its area say how much of the texture it covers, and so which
    /// texels are as large as the points are apart.
    pub(crate) fn over(&self, shape: &impl Shape, mapping: &TextureMapping) -> Vec3 {
        let points = points_for(Part::of(shape, mapping).texels(self.image()));
        let mut places = [(Vec2::ZERO, 0.0); (POINTS * POINTS) as usize];
        let (mut min, mut max) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        for (i, place) in (0..points * points).zip(&mut places) {
            let u = Vec2::new(f32::from(i % points), f32::from(i / points)) + 0.5;
            let Some(sample) = shape.sample(u / f32::from(points)) else {
                continue;
            };
            let at = mapping.place(sample.at.uv);
            (min, max) = (min.min(at), max.max(at));
            *place = (at, 1.0 / sample.pdf);
        }
        // From the first to the last point it is one step less than there are points.
        let level = self.level_of((max - min) / f32::from(points - 1));
        let (mut sum, mut total) = (Vec3::ZERO, 0.0);
        for (at, weight) in places.into_iter().take((points * points).into()) {
            if weight > 0.0 {
                sum += level.bilinear_wrapped(at, mapping.wrap) * weight;
                total += weight;
            }
        }
        if total > 0.0 { sum / total } else { Vec3::ZERO }
    }

    /// A mean over the surroundings of what `shape` shows: above 0 wherever the shape is, in any point of it.
    ///
    /// On a level where the shape fits into a texel, the corners of the part that it covers see each texel that any of its
    /// points sees.
    pub(crate) fn around(&self, shape: &impl Shape, mapping: &TextureMapping) -> Vec3 {
        let part = Part::of(shape, mapping);
        let Some(level) = self.levels.iter().find(|level| part.fits_in_texel(level)) else {
            // Larger than the image: it may show all of it.
            return self.levels[self.levels.len() - 1].texel(0, 0);
        };
        let sum: Vec3 = part
            .corners()
            .map(|corner| level.bilinear_wrapped(corner, mapping.wrap))
            .iter()
            .sum();
        0.25 * sum
    }

    /// The coarsest level whose texels are not larger than the given distance in the unit square, by a rounding.
    fn level_of(&self, spacing: Vec2) -> &Image {
        // An axis that is not coarser than the image's own loses nothing.
        let whole = self.image().extent();
        let is_fine = |level: &&Image| {
            let texels = level.extent();
            let is_small = (1.0 / texels).cmple(spacing * 1.01);
            (is_small | texels.cmpeq(whole)).all()
        };
        let finest_that_is = self.levels.iter().rev().find(is_fine);
        finest_that_is.unwrap_or(&self.levels[0])
    }
}

impl Part {
    /// The part that holds what `shape` shows.
    fn of(shape: &impl Shape, mapping: &TextureMapping) -> Self {
        let [low, high] = shape.uv_bounds();
        let corners = [
            low,
            Vec2::new(high.x, low.y),
            Vec2::new(low.x, high.y),
            high,
        ];
        let corners = corners.map(|corner| mapping.place(corner));
        Self {
            min: corners.into_iter().reduce(Vec2::min).unwrap_or(low),
            max: corners.into_iter().reduce(Vec2::max).unwrap_or(high),
        }
    }

    fn corners(&self) -> [Vec2; 4] {
        let Self { min, max } = *self;
        [min, Vec2::new(max.x, min.y), Vec2::new(min.x, max.y), max]
    }

    /// Whether a texel of the image is as wide and as high.
    fn fits_in_texel(&self, image: &Image) -> bool {
        self.texels(image) <= 1.0
    }

    /// How many texels of the image it is wide or high, whichever is more.
    fn texels(&self, image: &Image) -> f32 {
        ((self.max - self.min) * image.extent()).max_element()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glam::Affine2;
    use crate::image::Channels;
    use crate::shape::{Rectangle, Triangle};
    use crate::texture_mapping::Wrap;

    fn gray(size: [u32; 2], texel: impl Fn(u32) -> f32) -> TextureMeans {
        let texels: Vec<f32> = (0..size[0] * size[1]).map(texel).collect();
        TextureMeans::new(Image::from_f32(size, Channels::Gray, texels).expect("an image"))
    }

    /// Left half black, right half white, 64 by 32.
    fn halves() -> TextureMeans {
        gray([64, 32], |i| if i % 64 < 32 { 0.0 } else { 1.0 })
    }

    fn square() -> Rectangle {
        Rectangle::new(Vec3::ZERO, [Vec3::X, Vec3::Y]).expect("a square")
    }

    fn triangle(uv: [[f32; 2]; 3]) -> Triangle {
        let p = [Vec3::ZERO, Vec3::X, Vec3::Y];
        Triangle::new(p, uv.map(Vec2::from)).expect("a triangle")
    }

    const ONCE: TextureMapping = TextureMapping {
        transform: Affine2::IDENTITY,
        wrap: [Wrap::Clamp; 2],
    };

    #[test]
    fn the_whole_texture_has_its_mean() {
        assert_eq!(halves().over(&square(), &ONCE), Vec3::splat(0.5), "half");
        for size in [[64, 64], [61, 37], [1, 301]] {
            let means = gray(size, |i| (i % 97 * 31 % 89) as f32);
            let mean = means.image().mean();
            for level in &means.levels {
                let ratio = level.mean() / mean;
                assert!(
                    ratio.abs_diff_eq(Vec3::ONE, 1e-5),
                    "{:?}: {ratio}",
                    level.size()
                );
            }
            let seen = means.over(&square(), &ONCE) / mean;
            assert!(
                seen.abs_diff_eq(Vec3::ONE, 0.02),
                "{size:?}, each texel once: {seen}"
            );
        }
    }

    #[test]
    fn a_triangle_sees_its_part() {
        let part = |uv| halves().over(&triangle(uv), &ONCE).x;
        assert_eq!(part([[0.0, 0.0], [0.4, 0.0], [0.0, 1.0]]), 0.0, "left");
        let tiny = [[0.6, 0.1], [0.61, 0.1], [0.6, 0.11]];
        assert_eq!(part(tiny), 1.0, "right, tiny");
        // The half of a triangle beyond its middle line has a quarter of the area.
        let quarter = part([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
        assert!((quarter - 0.25).abs() < 0.03, "{quarter}");
    }

    #[test]
    fn a_mapping_moves_the_part() {
        let right = [[0.6, 0.1], [0.9, 0.1], [0.6, 0.9]];
        let by = |transform, wrap| {
            let wrap = [wrap; 2];
            halves()
                .over(&triangle(right), &TextureMapping { transform, wrap })
                .x
        };
        let left = Affine2::from_translation(Vec2::new(-0.5, 0.0));
        assert_eq!(by(left, Wrap::Repeat), 0.0, "to the left half");
        let beyond = Affine2::from_translation(Vec2::new(0.5, 0.0));
        assert_eq!(by(beyond, Wrap::Repeat), 0.0, "the left half again");
        assert_eq!(by(beyond, Wrap::Mirror), 1.0, "the right half, mirrored");
        assert_eq!(by(beyond, Wrap::Clamp), 1.0, "the edge goes on");
        assert_eq!(by(beyond, Wrap::Black), 0.0, "nothing");
        let many = Affine2::from_scale(Vec2::splat(50.0));
        assert_eq!(by(many, Wrap::Repeat), 0.5, "many halves of both kinds");
    }

    /// One bright texel that no triangle may lose, however its part of the texture is shaped.
    #[test]
    fn the_surroundings_hold_every_texel_that_a_triangle_shows() {
        let size = [301, 257];
        let bright = 140 * 301 + 150;
        let means = gray(size, |i| if i == bright { 1.0 } else { 0.0 });
        let at = [150.5 / 301.0, 1.0 - 140.5 / 257.0];
        let mut missed = 0;
        for (dx, dy) in [
            (0.45, 0.001),
            (0.002, 0.4),
            (0.2, 0.2),
            (1e-4, 1e-4),
            (30.0, 0.1),
        ] {
            let [x, y] = at;
            let sliver = [[x - dx, y - dy], [x + dx, y + dy], [x + dx, y + dy * 0.98]];
            let (sliver, repeat) = (triangle(sliver), TextureMapping::REPEAT);
            assert!(means.around(&sliver, &repeat).x > 0.0, "{dx}, {dy}");
            missed += u32::from(means.over(&sliver, &repeat) == Vec3::ZERO);
        }
        assert!(missed > 0, "points alone would have missed it");
        let black = triangle([[0.1, 0.1], [0.2, 0.1], [0.1, 0.2]]);
        assert_eq!(means.around(&black, &ONCE), Vec3::ZERO, "black stays black");
    }
}
