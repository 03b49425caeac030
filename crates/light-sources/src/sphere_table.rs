use alloc::vec::Vec;
use core::f32::consts::FRAC_1_PI;

use crate::environment_table::{EnvironmentTable, INSETS, NUDGES, ROUNDING};
use crate::glam::{Vec2, Vec3};
use crate::rigid_transform::RigidTransform;
use light_math::SphereMap;
use light_math::distribution::{PiecewiseConstant2D, Sample2D};
use light_math::equal_area::{sphere_to_square, square_to_sphere};

/// Directions of the sphere in proportion to the texels of an equal-area image; `None` when it is
/// black.
#[derive(Clone, Debug)]
pub(crate) struct SphereTable(Option<PiecewiseConstant2D<Vec<f32>>>);

/// A direction that a [`SphereTable`] chose.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SphereSample {
    /// The point of the image.
    pub(crate) uv: Vec2,
    /// The unit direction in the scene.
    pub(crate) w: Vec3,
    /// Its density in sr^-1, above 0.
    pub(crate) pdf: f32,
    /// Column and row of the texel.
    pub(crate) texel: [u32; 2],
}

/// The whole square is the whole sphere.
const PER_STERADIAN: f32 = 0.25 * FRAC_1_PI;

impl SphereTable {
    /// The table for `weights`, `n` rows of as many finite numbers, none negative.
    pub(crate) fn new(weights: &[f32], n: u32) -> Self {
        // The only remaining error is that all weights are zero.
        Self(PiecewiseConstant2D::new(weights, n as usize, n as usize).ok())
    }

    pub(crate) fn bytes(&self) -> usize {
        let table = self.0.as_ref();
        table.map_or(0, |table| size_of_val(table.table()))
    }

    /// The numbers of [`sample`](Self::sample), for samplers elsewhere; `None` if all weights are
    /// zero.
    pub(crate) fn table(&self) -> Option<EnvironmentTable> {
        let table = self.0.as_ref()?;
        let [width, height] = table.resolution();
        let (densities, sums) = table.table().split_at(width * height);
        let (columns, rows) = sums.split_at((width + 1) * height);
        let columns = columns.chunks_exact(width + 1);
        #[expect(clippy::cast_possible_truncation, reason = "sizes are u32")]
        Some(EnvironmentTable {
            map: SphereMap::EqualArea,
            size: [width as u32, height as u32],
            // Each row ends with 1, as the rows themselves do.
            columns: columns.flat_map(|row| &row[..width]).copied().collect(),
            rows: rows[..height].to_vec(),
            densities: densities.iter().map(|d| d * PER_STERADIAN).collect(),
            caps: Vec::new(),
        })
    }

    /// A direction in the scene, to which `transform` leads; `None` if the image is black.
    ///
    /// The direction is one of the texel that was chosen, after all rounding, so that queries
    /// return for it the values of the sample, unless the texel is smaller than rounding.
    pub(crate) fn sample(&self, u: Vec2, transform: &RigidTransform) -> Option<SphereSample> {
        let table = self.0.as_ref()?;
        let Sample2D { p, pdf, texel } = table.sample(u);
        let pdf = pdf * PER_STERADIAN;
        let n = table.resolution()[0] as f32;
        let (mut uv, mut w) = (p, transform.vector(square_to_sphere(p)));
        let corner = Vec2::new(texel[0] as f32, texel[1] as f32);
        let from_middle = uv * n - corner - 0.5;
        // Rounding of a direction moves it by a part of the sphere, not of a texel.
        let reach = from_middle.abs() + ROUNDING * n;
        if reach.max_element() >= 0.5 {
            // By the least that suffices, on the square: then as in a lat-long map.
            let nudges = NUDGES.map(|nudge| {
                let most = Vec2::splat((0.5 - nudge * n).max(0.0));
                from_middle.clamp(-most, most)
            });
            let insets = INSETS.map(|inset| from_middle * inset);
            for place in nudges.into_iter().chain(insets) {
                let back = sphere_to_square(transform.inverse_vector(w));
                if table.texel_at(back) == Some(texel) {
                    break;
                }
                uv = (corner + 0.5 + place) / n;
                w = transform.vector(square_to_sphere(uv));
            }
        }
        // The least of all densities is none in another unit.
        (pdf > 0.0).then(|| SphereSample {
            uv,
            w,
            pdf,
            texel: texel.map(saturated),
        })
    }

    pub(crate) fn pdf(&self, w: Vec3) -> f32 {
        self.0
            .as_ref()
            .map_or(0.0, |table| table.pdf(sphere_to_square(w)) * PER_STERADIAN)
    }
}

/// The index of a texel, of an image whose sides are `u32`.
fn saturated(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(u32::MAX)
}
