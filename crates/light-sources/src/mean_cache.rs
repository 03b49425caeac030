use alloc::vec::Vec;

use crate::glam::Vec3;
use crate::shape::Triangle;
use crate::surface_texture::{Footprint, SurfaceTexture};

/// A cache of means over triangles: often many triangles show the same part of an image.
#[derive(Debug, Default)]
pub(crate) struct MeanCache(Vec<Option<(Footprint, Vec3)>>);

impl MeanCache {
    /// Entries of the cache.
    const COUNT: usize = 1 << 10;

    /// The mean of `texture` over `triangle`.
    pub(crate) fn mean(&mut self, texture: &SurfaceTexture, triangle: &Triangle) -> Vec3 {
        let footprint = texture.footprint(triangle.uvs());
        self.0.resize(Self::COUNT, None);
        let place = &mut self.0[Self::place(&footprint)];
        match place {
            Some((known, mean)) if *known == footprint => *mean,
            _ => {
                let mean = texture.mean(triangle);
                *place = Some((footprint, mean));
                mean
            }
        }
    }

    /// The entry for a footprint.
    fn place(footprint: &Footprint) -> usize {
        // The multiplier of Fibonacci hashing: two to the power of 64 over the golden ratio.
        let mix = |hash: u64, number: &i64| {
            let bits = u64::from_ne_bytes(number.to_ne_bytes());
            (hash.rotate_left(5) ^ bits).wrapping_mul(0x9e37_79b9_7f4a_7c15)
        };
        let hash = footprint.0.iter().fold(0, mix) >> (64 - Self::COUNT.ilog2());
        usize::try_from(hash).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::amount::RadianceAmount;
    use crate::channels::Channels;
    use crate::diffuse_emission_desc::{DiffuseEmissionDesc, SurfaceColor};
    use crate::glam::Vec2;
    use crate::image::Image;
    use crate::rgb::Rgb;
    use crate::texture_mapping::{TextureMapping, Wrap};

    /// A cached mean is that of the queried triangle, in any order of queries.
    #[test]
    fn what_is_known_is_right() {
        let texels: Vec<f32> = (0..64u16).map(|i| f32::from(i * 7 % 11)).collect();
        let image = Image::from_f32([8, 8], Channels::Gray, texels).expect("an image");
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp, Wrap::Black] {
            let color = SurfaceColor::<Rgb>::Image {
                texture: image.clone().into(),
                tint: Vec3::ONE,
            };
            let desc = DiffuseEmissionDesc {
                mapping: TextureMapping {
                    wrap: [wrap; 2],
                    ..TextureMapping::REPEAT
                },
                ..DiffuseEmissionDesc::new(color, RadianceAmount::default())
            };
            let texture = SurfaceTexture::new(&desc).expect("an image");
            let mut known = MeanCache::default();
            let corners = [[0.0, 0.0], [1.0, 0.0], [0.25, 1.5]].map(Vec2::from);
            for shift in (0..40u8).map(|i| Vec2::new(f32::from(i % 8) - 3.0, f32::from(i / 8))) {
                for size in [1.0, 0.5] {
                    let uv = corners.map(|corner| corner * size + shift);
                    let triangle = Triangle::from_corners([Vec3::ZERO, Vec3::X, Vec3::Y], uv);
                    let (ours, exact) = (known.mean(&texture, &triangle), texture.mean(&triangle));
                    let near = ours.abs_diff_eq(exact, 1e-5 * exact.max_element());
                    assert!(near, "{wrap:?}, {uv:?}: {ours}, {exact}");
                }
            }
            // Two sizes of triangles, at three distances at which single precision has steps of its
            // own.
            let count = known.0.iter().flatten().count();
            let repeats = wrap == Wrap::Repeat;
            assert_eq!(count <= 6, repeats, "{wrap:?}: {count} known");
        }
    }
}
