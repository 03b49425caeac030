use core::f32::consts::PI;

use light_bounds::{InfiniteBounds, LightGroups, LightId};
use light_math::DirectionCone;
use light_math::distribution::PiecewiseConstant2D;
use light_math::equal_area::{sphere_to_square, square_to_sphere};
use light_math::glam::{Vec2, Vec3};
use light_samplers::StoredInfiniteLight;

use crate::scene_records::SkyRecord;

/// A sky in flash: an equal-area picture, and a table of its texels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sky {
    pub(crate) record: SkyRecord,
    pub(crate) texels: &'static [[f32; 3]],
    pub(crate) table: PiecewiseConstant2D<&'static [f32]>,
}

/// A direction toward the sky.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SkySample {
    pub(crate) l: Vec3,
    pub(crate) wi: Vec3,
    pub(crate) pdf: f32,
}

/// The whole square is the whole sphere.
const PER_STERADIAN: f32 = 0.25 / PI;

impl Sky {
    /// A direction in proportion to the radiance that arrives from it.
    pub(crate) fn sample(&self, u: Vec2) -> SkySample {
        let sample = self.table.sample(u);
        let [x, y] = sample.texel;
        SkySample {
            l: Vec3::from_array(self.texels[y * self.record.size as usize + x]),
            wi: square_to_sphere(sample.p),
            pdf: sample.pdf * PER_STERADIAN,
        }
    }

    /// The density in sr^-1 with which [`sample`](Self::sample) chooses `wi`.
    pub(crate) fn pdf(&self, wi: Vec3) -> f32 {
        self.table.pdf(sphere_to_square(wi)) * PER_STERADIAN
    }

    /// What the sampler knows of it.
    pub(crate) fn infinite_light(&self) -> StoredInfiniteLight {
        StoredInfiniteLight {
            light: LightId(self.record.id),
            bounds: InfiniteBounds {
                fluence: self.record.fluence,
                mean: Vec3::from_array(self.record.direction),
                cone: DirectionCone::WHOLE_SPHERE,
            },
            groups: LightGroups::default(),
        }
    }
}
