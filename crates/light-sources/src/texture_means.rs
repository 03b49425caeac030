use alloc::vec::Vec;

use crate::glam::{Vec2, Vec3};
use crate::shape::Shape;

/// A texture in ever coarser sizes, each texel the mean of four finer ones: how bright a shape is on which it lies.
#[derive(Clone, Debug)]
pub(crate) struct TextureMeans(Vec<Level>);

#[derive(Clone, Debug)]
struct Level {
    size: [u32; 2],
    texels: Vec<Vec3>,
}

/// Rows and columns of the points at which a shape looks at its texture.
const POINTS: u16 = 8;

impl TextureMeans {
    /// The means of the texture of the given size with these texels, row by row.
    pub(crate) fn new(size: [u32; 2], texels: Vec<Vec3>) -> Self {
        let mut levels = alloc::vec![Level { size, texels }];
        while let Some(coarser) = levels.last().and_then(Level::coarser) {
            levels.push(coarser);
        }
        Self(levels)
    }

    /// The mean of the texture over the area of `shape`; row 0 lies at v = 1.
    ///
    /// The shape's surface parameters at 64 points spread over its area say how much of the texture it covers, and so
    /// which texels are as large as the points are apart.
    pub(crate) fn over(&self, shape: &impl Shape) -> Vec3 {
        let mut points = Vec::new();
        let (mut min, mut max) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        for i in 0..POINTS * POINTS {
            let u = Vec2::new(f32::from(i % POINTS), f32::from(i / POINTS)) + 0.5;
            let Some(sample) = shape.sample(u / f32::from(POINTS)) else {
                continue;
            };
            let uv = Vec2::new(sample.at.uv.x, 1.0 - sample.at.uv.y);
            (min, max) = (min.min(uv), max.max(uv));
            points.push((uv, 1.0 / sample.pdf));
        }
        // From the first to the last point it is one step less than there are points.
        let spacing = (max - min) / f32::from(POINTS - 1);
        let level = self.level_of(spacing);
        let total: f32 = points.iter().map(|(_, weight)| weight).sum();
        let sum: Vec3 = points
            .iter()
            .map(|&(uv, weight)| level.at(uv) * weight)
            .sum();
        if total > 0.0 { sum / total } else { Vec3::ZERO }
    }

    /// The coarsest level whose texels are not larger than the given distance in the unit square, by a rounding.
    fn level_of(&self, spacing: Vec2) -> &Level {
        let is_fine = |level: &&Level| {
            let texel = 1.0 / level.extent();
            texel.cmple(spacing * 1.01).all()
        };
        self.0.iter().rev().find(is_fine).unwrap_or(&self.0[0])
    }
}

impl Level {
    fn extent(&self) -> Vec2 {
        Vec2::new(self.size[0] as f32, self.size[1] as f32)
    }

    /// The colour at `uv`, interpolated between the centres of the four texels around it.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "saturates, which is the clamp that is wanted"
    )]
    fn at(&self, uv: Vec2) -> Vec3 {
        let t = (uv * self.extent() - 0.5).max(Vec2::ZERO);
        let (x, y, f) = (t.x as u32, t.y as u32, t.fract());
        let (x1, y1) = (x.saturating_add(1), y.saturating_add(1));
        let top = self.texel(x, y).lerp(self.texel(x1, y), f.x);
        let bottom = self.texel(x, y1).lerp(self.texel(x1, y1), f.x);
        top.lerp(bottom, f.y)
    }

    fn texel(&self, x: u32, y: u32) -> Vec3 {
        let [width, height] = self.size;
        let (x, y) = (x.min(width - 1), y.min(height - 1));
        self.texels[y as usize * width as usize + x as usize]
    }

    /// The level of half the size; `None` for a single texel.
    fn coarser(&self) -> Option<Self> {
        if self.size == [1, 1] {
            return None;
        }
        let [width, height] = self.size.map(|n| n.div_ceil(2));
        let mean = |x: u32, y: u32| {
            // A side of odd length ends in a texel that counts twice.
            let sum = self.texel(2 * x, 2 * y)
                + self.texel(2 * x + 1, 2 * y)
                + self.texel(2 * x, 2 * y + 1)
                + self.texel(2 * x + 1, 2 * y + 1);
            0.25 * sum
        };
        let rows = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        Some(Self {
            size: [width, height],
            texels: rows.map(|(x, y)| mean(x, y)).collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Rectangle, Triangle};

    /// Left half black, right half white, 64 by 32.
    fn halves() -> TextureMeans {
        let texels = (0..64 * 32).map(|i| Vec3::splat(if i % 64 < 32 { 0.0 } else { 1.0 }));
        TextureMeans::new([64, 32], texels.collect())
    }

    #[test]
    fn the_whole_texture_has_its_mean() {
        let square = Rectangle::new(Vec3::ZERO, [Vec3::X, Vec3::Y]).expect("a square");
        assert_eq!(halves().over(&square), Vec3::splat(0.5), "half");
        let texels = (0..64 * 64u16).map(|i| Vec3::splat(f32::from(i % 97 * 31 % 89)));
        let texels: Vec<Vec3> = texels.collect();
        let mean = texels.iter().sum::<Vec3>() / 4096.0;
        let means = TextureMeans::new([64, 64], texels);
        assert!(means.over(&square).distance(mean) < 1e-3, "each texel once");
    }

    #[test]
    fn a_triangle_sees_its_part() {
        let p = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let part = |uv: [[f32; 2]; 3]| {
            let triangle = Triangle::new(p, uv.map(Vec2::from)).expect("a triangle");
            halves().over(&triangle).x
        };
        assert_eq!(part([[0.0, 0.0], [0.4, 0.0], [0.0, 1.0]]), 0.0, "left");
        assert_eq!(
            part([[0.6, 0.1], [0.61, 0.1], [0.6, 0.11]]),
            1.0,
            "right, tiny"
        );
        // The half of a triangle beyond its middle line has a quarter of the area.
        let quarter = part([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
        assert!((quarter - 0.25).abs() < 0.03, "{quarter}");
    }
}
