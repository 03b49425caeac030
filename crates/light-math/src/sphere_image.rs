use core::f32::consts::PI;
use core::ops::{Add, Mul};

use glam::{Vec2, Vec3};

use crate::float::floor;
use crate::{equal_area, lat_long};

/// The map from an image to the sphere.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum SphereMap {
    /// Rows of latitude: [`lat_long`].
    LatLong,
    /// Equal areas: [`equal_area`].
    EqualArea,
}

impl SphereMap {
    /// The unit vector of the point `p` in `[0, 1]^2`.
    #[inline]
    #[must_use]
    pub fn direction(self, p: Vec2) -> Vec3 {
        match self {
            Self::LatLong => lat_long::direction(p),
            Self::EqualArea => equal_area::square_to_sphere(p),
        }
    }

    /// The point in `[0, 1]^2` of the unit vector `d`.
    #[inline]
    #[must_use]
    pub fn point(self, d: Vec3) -> Vec2 {
        match self {
            Self::LatLong => lat_long::uv(d),
            Self::EqualArea => equal_area::sphere_to_square(d),
        }
    }

    /// The solid angle in sr per unit of area of the square at `p`.
    #[inline]
    #[must_use]
    pub fn solid_angle_per_area(self, p: Vec2) -> f32 {
        match self {
            Self::LatLong => lat_long::solid_angle_per_area(p.y),
            Self::EqualArea => 4.0 * PI,
        }
    }

    /// The texel of an image of the given columns and rows at `(x, y)`, which lies at most one
    /// texel outside.
    #[inline]
    #[must_use]
    pub(crate) fn wrap_texel(self, x: i32, y: i32, size: [u32; 2]) -> (u32, u32) {
        match self {
            Self::LatLong => lat_long::wrap_texel(x, y, size),
            Self::EqualArea => equal_area::wrap_texel(x, y, size[0]),
        }
    }
}

/// An image of the sphere, with texels in the storage of the caller.
///
/// `F` returns the texel at column `x` and row `y`, counted from the top left: for a slice,
/// `|x, y| texels[(y * columns + x) as usize]`.
#[derive(Clone, Copy, Debug)]
pub struct SphereImage<F> {
    map: SphereMap,
    size: [u32; 2],
    texel: F,
}

impl<F> SphereImage<F> {
    /// The image of `size[0]` columns and `size[1]` rows.
    ///
    /// # Errors
    /// If there are no texels, or if an equal-area image is not square.
    pub fn new<T>(map: SphereMap, size: [u32; 2], texel: F) -> Result<Self, SphereImageError>
    where
        F: Fn(u32, u32) -> T,
    {
        check(map, size)?;
        Ok(Self { map, size, texel })
    }

    /// The map of the image.
    #[inline]
    #[must_use]
    pub const fn map(&self) -> SphereMap {
        self.map
    }

    /// Columns and rows.
    #[inline]
    #[must_use]
    pub const fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The value in the direction of the unit vector `d`, bilinear between the centres of texels,
    /// across edges and poles too.
    #[inline]
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "between -1 and the size")]
    pub fn bilinear<T>(&self, d: Vec3) -> T
    where
        F: Fn(u32, u32) -> T,
        T: Add<Output = T> + Mul<f32, Output = T>,
    {
        let p = self.map.point(d) * extent(self.size) - 0.5;
        let (x, y) = (floor(p.x), floor(p.y));
        let (s, t) = (p.x - x, p.y - y);
        let (x, y) = (x as i32, y as i32);
        let at = |x: i32, y: i32| {
            let (x, y) = self.map.wrap_texel(x, y, self.size);
            (self.texel)(x, y)
        };
        (at(x, y) * (1.0 - s) + at(x + 1, y) * s) * (1.0 - t)
            + (at(x, y + 1) * (1.0 - s) + at(x + 1, y + 1) * s) * t
    }
}

/// Why an image of the sphere is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SphereImageError {
    /// A side is zero.
    Empty,
    /// The image is to be an equal-area map, and its sides differ.
    NotSquare,
}

impl core::fmt::Display for SphereImageError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Empty => "an image of the sphere has at least one texel",
            Self::NotSquare => "an equal-area image of the sphere is square",
        })
    }
}

impl core::error::Error for SphereImageError {}

/// Checks the size of an image.
pub(crate) fn check(map: SphereMap, size: [u32; 2]) -> Result<(), SphereImageError> {
    if size.contains(&0) {
        return Err(SphereImageError::Empty);
    }
    if map == SphereMap::EqualArea && size[0] != size[1] {
        return Err(SphereImageError::NotSquare);
    }
    Ok(())
}

/// Columns and rows as floats.
#[inline]
pub(crate) fn extent(size: [u32; 2]) -> Vec2 {
    Vec2::new(size[0] as f32, size[1] as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    /// Something smooth without symmetry.
    fn sky(d: Vec3) -> f32 {
        2.0 + d.y + (3.0 * d.x).sin() * d.z + d.x * d.y
    }

    fn render(map: SphereMap, size: [u32; 2]) -> Vec<f32> {
        let center = |x: u32, y: u32| Vec2::new(x as f32 + 0.5, y as f32 + 0.5) / extent(size);
        (0..size[1])
            .flat_map(|y| (0..size[0]).map(move |x| (x, y)))
            .map(|(x, y)| sky(map.direction(center(x, y))))
            .collect()
    }

    #[test]
    fn interpolation_crosses_edges_and_poles() {
        for (map, size) in [
            (SphereMap::LatLong, [64, 32]),
            (SphereMap::EqualArea, [40, 40]),
        ] {
            let texels = render(map, size);
            let texel = |x, y| texels[(y * size[0] + x) as usize];
            let image = SphereImage::new(map, size, texel).expect("valid");
            for d in [Vec3::Y, -Vec3::Y, Vec3::Z, -Vec3::Z, Vec3::X, -Vec3::X] {
                let near = (d + Vec3::new(1e-3, 2e-3, -1e-3)).normalize();
                let value = image.bilinear(near);
                assert!((value - sky(near)).abs() < 0.02, "{map:?} at {d}: {value}");
            }
        }
    }

    #[test]
    fn every_rule_is_checked() {
        let new = |map, size| SphereImage::new(map, size, |_, _| 0.0f32).err();
        use SphereImageError::{Empty, NotSquare};
        assert_eq!(new(SphereMap::LatLong, [0, 4]), Some(Empty), "columns");
        assert_eq!(new(SphereMap::LatLong, [4, 0]), Some(Empty), "rows");
        assert_eq!(new(SphereMap::EqualArea, [4, 2]), Some(NotSquare), "square");
        assert_eq!(new(SphereMap::LatLong, [4, 2]), None, "fine");
    }
}
