use alloc::vec::Vec;
use core::f32::consts::FRAC_1_PI;

use crate::environment_table::EnvironmentTable;
use crate::glam::{Vec2, Vec3};
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
    /// The unit direction.
    pub(crate) w: Vec3,
    /// Its density in sr^-1, above 0.
    pub(crate) pdf: f32,
    /// Column and row of the texel.
    pub(crate) texel: [usize; 2],
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

    pub(crate) fn sample(&self, u: Vec2) -> Option<SphereSample> {
        let Sample2D { p: uv, pdf, texel } = self.0.as_ref()?.sample(u);
        let pdf = pdf * PER_STERADIAN;
        // The least of all densities is none in another unit.
        (pdf > 0.0).then(|| SphereSample {
            uv,
            w: square_to_sphere(uv),
            pdf,
            texel,
        })
    }

    pub(crate) fn pdf(&self, w: Vec3) -> f32 {
        self.0
            .as_ref()
            .map_or(0.0, |table| table.pdf(sphere_to_square(w)) * PER_STERADIAN)
    }
}
