use lights::bounds::{LightId, LightSampleContext};
use lights::glam::{Vec2, Vec3};
use lights::math::fraction::to_f32;
use lights::sources::PdfCoverage;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::variance_split::LightMoments;
use crate::bsdf::Scattering;
use crate::integrator::is_in_the_surface;
use crate::{SampleStream, Surface, View, World};

/// A point of a surface that scatters light, and from where it is seen.
pub(super) struct SceneReceiver {
    surface: Surface,
    scattering: Scattering,
    wo: Vec3,
    pub(super) ctx: LightSampleContext,
    /// Chooses the points of lights.
    pub(super) key: u64,
}

/// The receiver of each pixel that shows one.
pub(super) fn receivers(world: &World, view: &View, seed: u32) -> Vec<SceneReceiver> {
    let (width, height) = view.resolution();
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
    pixels
        .filter_map(|pixel| receiver_at(world, view, pixel, seed))
        .collect()
}

/// The receiver that a pixel shows; `None` where it shows nothing, light, or a mirror, and outside
/// of the picture.
pub(super) fn receiver_at(
    world: &World,
    view: &View,
    [x, y]: [u32; 2],
    seed: u32,
) -> Option<SceneReceiver> {
    let (width, height) = view.resolution();
    if x >= width || y >= height {
        return None;
    }
    let numbers = SampleStream::new(seed, (x, y), 0).camera();
    let film = Vec2::new(x as f32, y as f32) + numbers.film;
    let ray = view.ray(film, numbers.lens);
    let surface = world.closest(&ray, None)?;
    let key = (u64::from(seed) << 32) ^ (u64::from(y) << 16) ^ u64::from(x);
    SceneReceiver::new(world, surface, -ray.direction, key)
}

/// One random point in each of `strata` times `strata` equal parts of the unit square.
pub(super) fn points(strata: u16, key: u64) -> Vec<Vec2> {
    let mut rng = Pcg64Mcg::seed_from_u64(key);
    let mut within = |k: u16| (f32::from(k) + to_f32(rng.next_u64())) / f32::from(strata);
    let parts = (0..strata).flat_map(|y| (0..strata).map(move |x| (x, y)));
    parts
        .map(|(x, y)| Vec2::new(within(x), within(y)).min(Vec2::splat(1.0 - f32::EPSILON)))
        .collect()
}

/// Whether surfaces of the scene are in the way of light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shadows {
    /// They are not.
    #[default]
    Off,
    /// They are.
    Cast,
}

impl SceneReceiver {
    /// The receiver at `surface`, seen from the unit vector `wo`; `None` where it emits light, or
    /// scatters it into single directions alone.
    pub(super) fn new(world: &World, surface: Surface, wo: Vec3, key: u64) -> Option<Self> {
        let scattering = world.scattering(&surface);
        if world.emitted(&surface, wo).is_some() || scattering.bsdf().is_dirac() {
            return None;
        }
        Some(Self {
            ctx: world.light_context(&surface, &scattering, wo),
            surface,
            scattering,
            wo,
            key,
        })
    }

    /// The lights that would give something if nothing were in the way.
    pub(super) fn moments(&self, world: &World, points: &[Vec2]) -> Vec<(LightId, LightMoments)> {
        let lights = world.lights().iter();
        let moments = lights.map(|(id, _)| (id, self.moments_of(world, id, points)));
        moments
            .filter(|(_, light)| light.unoccluded > 0.0)
            .collect()
    }

    /// What the points of a light give.
    pub(super) fn moments_of(&self, world: &World, id: LightId, points: &[Vec2]) -> LightMoments {
        let gives = |&u: &Vec2| self.gives(world, id, u, Shadows::Cast);
        LightMoments::over(points.iter().map(gives))
    }

    /// The contribution of the point `u` of a light, unoccluded and with occlusion.
    pub(super) fn gives(
        &self,
        world: &World,
        light: LightId,
        u: Vec2,
        shadows: Shadows,
    ) -> [f64; 2] {
        let sample = world.sample_light(light, &self.ctx, u, PdfCoverage::Complete);
        let Some(li) = sample.filter(|li| !is_in_the_surface(&self.ctx, li.p_light)) else {
            return [0.0; 2];
        };
        let scattered = self.scattering.eval(self.wo, li.wi) * li.l / (3.0 * li.pdf);
        let unoccluded = f64::from(scattered.element_sum());
        let is_tested = unoccluded > 0.0 && shadows == Shadows::Cast;
        if is_tested && world.occluded(&self.surface, li.wi, li.p_light) {
            [unoccluded, 0.0]
        } else {
            [unoccluded; 2]
        }
    }
}
