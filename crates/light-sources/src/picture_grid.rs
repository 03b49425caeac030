use alloc::vec::Vec;

use crate::glam::{DVec2, DVec3, Vec2};

/// The texels of a picture on the plane z = 1, seen from the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PictureGrid {
    size: [u32; 2],
    /// Half width and half height of the picture.
    half: DVec2,
}

/// A texel, or a part of one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PicturePart {
    /// Column and row of the texel.
    pub(crate) texel: [u32; 2],
    /// The middle of the texel on the plane, or of the angles of its part.
    pub(crate) center: Vec2,
    /// In sr.
    pub(crate) solid_angle: f64,
}

/// The least number of parts of a picture along each axis.
const PARTS: f64 = 32.0;

impl PictureGrid {
    pub(crate) fn new(size: [u32; 2], half: Vec2) -> Self {
        let half = half.as_dvec2();
        Self { size, half }
    }

    /// The texels, row by row.
    pub(crate) fn texels(&self) -> impl Iterator<Item = PicturePart> + use<> {
        let grid = *self;
        let [width, height] = self.size;
        (0..height).flat_map(move |y| {
            (0..width).map(move |x| {
                let (low, high) = (grid.corner([x, y]), grid.corner([x + 1, y + 1]));
                PicturePart {
                    texel: [x, y],
                    center: (0.5 * (low + high)).as_vec2(),
                    solid_angle: solid_angle(low, high),
                }
            })
        })
    }

    /// The texels, divided where they are wide, so that a part has nearly one direction.
    pub(crate) fn parts(&self) -> impl Iterator<Item = PicturePart> + use<> {
        let columns = self.intervals(0);
        self.intervals(1).into_iter().flat_map(move |row| {
            let parts = columns.clone().into_iter();
            parts.map(move |column| {
                let [low, high] = [0, 1].map(|i| DVec2::new(column.ends[i], row.ends[i]));
                PicturePart {
                    texel: [column.texel, row.texel],
                    center: DVec2::new(column.middle, row.middle).as_vec2(),
                    solid_angle: solid_angle(low, high),
                }
            })
        })
    }

    /// The columns (`axis` 0) or rows (1) of the picture, divided into parts of equal angles: on the
    /// plane those of a wide picture are long beside the edges.
    fn intervals(&self, axis: usize) -> Vec<Interval> {
        let angle = |x: f64| DVec2::new(1.0, x).to_angle();
        let widest = 2.0 * angle(self.half[axis]) / PARTS;
        let place = |i: u32| self.corner([i, i])[axis];
        let divide = |texel: u32| {
            let ends = [place(texel), place(texel + 1)];
            let [low, high] = ends.map(angle);
            // A little more is rounding.
            let count = (1..1 << 16).find(|&n| high - low <= widest * f64::from(n) * 1.001);
            let count = count.unwrap_or(1);
            let at = move |part: f64| {
                let direction = DVec2::from_angle(low + (high - low) * part / f64::from(count));
                direction.y / direction.x
            };
            let cut = move |k: u32| match k {
                0 => ends[0],
                k if k == count => ends[1],
                k => at(k.into()),
            };
            (0..count).map(move |k| Interval {
                texel,
                ends: [cut(k), cut(k + 1)],
                middle: at(f64::from(k) + 0.5),
            })
        };
        (0..self.size[axis]).flat_map(divide).collect()
    }

    /// A corner of the grid of texels.
    fn corner(&self, [x, y]: [u32; 2]) -> DVec2 {
        let count = DVec2::new(self.size[0].into(), self.size[1].into());
        (2.0 * DVec2::new(x.into(), y.into()) / count - 1.0) * self.half
    }
}

/// A part of a column or a row on the plane.
#[derive(Clone, Copy, Debug)]
struct Interval {
    texel: u32,
    ends: [f64; 2],
    /// The middle of its angles.
    middle: f64,
}

/// The solid angle in sr of a rectangle on the plane z = 1.
fn solid_angle(low: DVec2, high: DVec2) -> f64 {
    /// The square of the angle below which the solid angle by the middle of a rectangle has an
    /// error below 1e-7.
    const SMALL: f64 = 1e-7;
    let (size, middle) = (high - low, 0.5 * (low + high));
    let dist_sq = 1.0 + middle.length_squared();
    if size.length_squared() < SMALL * dist_sq {
        return size.x * size.y / (dist_sq * middle.extend(1.0).length());
    }
    // Of the rectangle from the axis to a corner; its sign is that of x y.
    let corner = |x: f64, y: f64| DVec2::new(DVec3::new(1.0, x, y).length(), x * y).to_angle();
    corner(high.x, high.y) - corner(low.x, high.y) - corner(high.x, low.y) + corner(low.x, low.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;

    #[test]
    fn a_face_of_a_cube_is_a_sixth_of_the_sphere() {
        for size in [[1, 1], [2, 2], [4, 6], [5, 1], [2000, 3]] {
            let grid = PictureGrid::new(size, Vec2::ONE);
            let sum: f64 = grid.texels().map(|texel| texel.solid_angle).sum();
            assert!(
                (sum / (4.0 * PI / 6.0) - 1.0).abs() < 1e-9,
                "{size:?}: {sum}"
            );
            let parts: f64 = grid.parts().map(|part| part.solid_angle).sum();
            assert!((parts / sum - 1.0).abs() < 1e-6, "{size:?}: {parts}");
            assert!(
                grid.parts().count() >= 1024,
                "{size:?}: fine enough for its directions"
            );
        }
    }

    /// The field of view of 178 degrees.
    #[test]
    fn the_middle_of_a_wide_picture_is_divided() {
        for n in [1, 2, 64] {
            let grid = PictureGrid::new([n, n], Vec2::splat(57.0));
            let z = |part: PicturePart| {
                let w = part.center.as_dvec2().extend(1.0).normalize();
                w.z * part.solid_angle
            };
            let mean = grid.parts().map(z).sum::<f64>() / (2.0 * PI);
            assert!((mean - 0.5).abs() < 2e-3, "{n} texels: {mean}");
        }
    }

    /// Texels a little above and a little below the size limit of the approximation by the middle.
    #[test]
    fn the_middle_of_a_texel_stands_for_little_ones() {
        for at in [DVec2::ZERO, DVec2::new(0.7, -0.2), DVec2::new(-3.0, 8.0)] {
            let dist_sq = 1.0 + at.length_squared();
            for size in [2e-4, 3e-4, 4e-4] {
                let half = DVec2::splat(0.5 * size * dist_sq.sqrt());
                let whole = solid_angle(at - half, at + half);
                // Cut into texels that are certainly small.
                let sixteenth = half / 16.0;
                let parts = (0..256).map(|i| {
                    let cell = DVec2::new(f64::from(i % 16), f64::from(i / 16));
                    let center = at + (2.0 * cell - 15.0) * sixteenth;
                    solid_angle(center - sixteenth, center + sixteenth)
                });
                let parts: f64 = parts.sum();
                assert!(
                    (whole / parts - 1.0).abs() < 1e-7,
                    "{at}, {size}: {whole}, {parts}"
                );
            }
        }
    }
}
