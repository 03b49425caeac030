use core::f32::consts::PI;

use crate::glam::{Vec2, Vec3};
use light_math::SphereMap;
use light_math::float::sin;

/// A rectangle of texels, at least one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TexelRegion {
    /// The first column and row.
    pub min: [u32; 2],
    /// The column and row after the last.
    pub max: [u32; 2],
}

/// Chords in the measured length of a line across a region.
const CHORDS: u8 = 8;

impl TexelRegion {
    /// All texels of an image.
    pub(super) const fn whole(size: [u32; 2]) -> Self {
        Self {
            min: [0, 0],
            max: size,
        }
    }

    /// Both parts, cut before column (`axis` 0) or row (1) `at`.
    pub(super) const fn parts(&self, axis: usize, at: u32) -> [Self; 2] {
        let (mut low, mut high) = (*self, *self);
        low.max[axis] = at;
        high.min[axis] = at;
        [low, high]
    }

    /// The direction in the middle of the rectangle.
    pub(super) fn direction(&self, map: SphereMap, size: [u32; 2]) -> Vec3 {
        let [min, max] = self.corners(size);
        map.direction(0.5 * (min + max))
    }

    /// Width and height through the middle, as angles on the sphere, in rad.
    pub(super) fn sides(&self, map: SphereMap, size: [u32; 2]) -> [f32; 2] {
        let [min, max] = self.corners(size);
        let middle = 0.5 * (min + max);
        let length = |from: Vec2, to: Vec2| {
            let at = |i: u8| map.direction(from.lerp(to, f32::from(i) / f32::from(CHORDS)));
            let chords = (0..CHORDS).map(|i| at(i).distance(at(i + 1)));
            chords.sum::<f32>()
        };
        [
            length(Vec2::new(min.x, middle.y), Vec2::new(max.x, middle.y)),
            length(Vec2::new(middle.x, min.y), Vec2::new(middle.x, max.y)),
        ]
    }

    /// The corners in the unit square.
    fn corners(&self, size: [u32; 2]) -> [Vec2; 2] {
        [self.min, self.max].map(|p| point(p) / point(size))
    }
}

/// The direction of the middle of a texel.
pub(super) fn center(map: SphereMap, size: [u32; 2], texel: [u32; 2]) -> Vec3 {
    map.direction((point(texel) + 0.5) / point(size))
}

/// The solid angle of a texel in row `y`, in sr; together they are `4 pi`.
pub(super) fn texel_solid_angle(map: SphereMap, [width, height]: [u32; 2], y: u32) -> f32 {
    match map {
        SphereMap::EqualArea => 4.0 * PI / (width as f32 * height as f32),
        SphereMap::LatLong => {
            // From the nearer pole, where the sine keeps its digits; a row lies between two
            // cosines.
            let row = y.min(height - 1 - y);
            let half = 0.5 * PI / height as f32;
            let cosines = 2.0 * sin(half) * sin(half * (2.0 * row as f32 + 1.0));
            2.0 * PI / width as f32 * cosines
        }
    }
}

fn point([x, y]: [u32; 2]) -> Vec2 {
    Vec2::new(x as f32, y as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texels_cover_the_sphere() {
        for (map, size) in [
            (SphereMap::LatLong, [64, 31]),
            (SphereMap::EqualArea, [9, 9]),
            (SphereMap::LatLong, [1, 1]),
        ] {
            let rows = (0..size[1]).map(|y| texel_solid_angle(map, size, y) * size[0] as f32);
            assert!((rows.sum::<f32>() - 4.0 * PI).abs() < 1e-4, "{map:?}");
        }
    }

    #[test]
    fn sides_are_measured_on_the_sphere() {
        let size = [360, 180];
        let sides = |min, max| TexelRegion { min, max }.sides(SphereMap::LatLong, size);
        let [width, height] = sides([0, 90 - 10], [20, 90 + 10]);
        assert!(
            (width / height - 1.0).abs() < 0.02,
            "a square at the equator"
        );
        let [width, height] = sides([0, 0], [60, 20]);
        assert!(
            width < height,
            "a wide strip of texels is narrow at the pole"
        );
    }

    #[test]
    fn parts_meet() {
        let [low, high] = TexelRegion::whole([4, 2]).parts(0, 3);
        assert_eq!((low.min, low.max), ([0, 0], [3, 2]), "left");
        assert_eq!((high.min, high.max), ([3, 0], [4, 2]), "right");
    }
}
