use alloc::vec::Vec;

use crate::glam::Vec3;
use crate::shape::{Shape, Triangle, UvArea};
use crate::surface_texture::SurfaceTexture;

/// Means of triangles that were asked for lately: often many triangles show the same part of an image.
#[derive(Debug, Default)]
pub(crate) struct KnownMeans(Vec<Option<(UvArea, Vec3)>>);

impl KnownMeans {
    /// How many are known at once.
    const COUNT: usize = 1 << 10;

    /// The mean of `texture` over `triangle`.
    pub(crate) fn mean(&mut self, texture: &SurfaceTexture, triangle: &Triangle) -> Vec3 {
        let area = triangle.uv_area();
        self.0.resize(Self::COUNT, None);
        let place = &mut self.0[Self::place(&area)];
        match place {
            Some((known, mean)) if *known == area => *mean,
            _ => {
                let mean = texture.mean(triangle);
                *place = Some((area, mean));
                mean
            }
        }
    }

    /// Where the mean over an area is kept.
    fn place(area: &UvArea) -> usize {
        let UvArea::Triangle(corners) = area else {
            return 0;
        };
        let bits = corners
            .iter()
            .flat_map(|uv| uv.to_array().map(f32::to_bits));
        // The multiplier of Fibonacci hashing: two to the power of 64 over the golden ratio.
        let mix = |hash: u64, bits: u32| {
            (hash.rotate_left(5) ^ u64::from(bits)).wrapping_mul(0x9e37_79b9_7f4a_7c15)
        };
        let hash = bits.fold(0, mix) >> (64 - Self::COUNT.ilog2());
        usize::try_from(hash).unwrap_or(0)
    }
}
