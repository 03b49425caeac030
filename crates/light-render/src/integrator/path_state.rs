use lights::bounds::{LightId, LightSampleContext};
use lights::glam::{Vec2, Vec3};
use lights::samplers::LightSampler;

use super::PathSettings;
use super::direct::{Arrived, DirectLight, LightQuery, Scatters, Unshadowed, Vertex};
use super::light_sum::LightSum;
use super::sky::sky;
use crate::bsdf::BsdfSample;
use crate::{Ray, SampleStream, Surface, World};

/// A point at which a path scatters.
pub(super) trait PathVertex: Scatters {
    /// Whether all light is scattered into single directions, so that light samples cannot
    /// contribute.
    fn is_dirac(&self) -> bool;

    /// The context for light samplers and lights, seen from `wo`.
    fn light_context(&self, world: &World, wo: Vec3) -> LightSampleContext;

    /// Samples the direction of the next segment; `None` where nothing is scattered.
    fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample>;
}

/// The state of a path, with the rules that all path integrators share: multiple importance
/// sampling and Russian roulette.
#[derive(Debug)]
pub(super) struct PathState<'a, S, L> {
    /// The radiance that arrives along the first segment.
    sum: &'a mut L,
    /// The number of rays traced, shadow rays included.
    pub(super) rays: u32,
    /// Weight of the radiance that arrives along the current segment.
    pub(super) throughput: Vec3,
    direct: DirectLight<'a, S>,
    /// The light query of the vertex that the current segment leaves.
    query: Option<LightQuery<'a>>,
    /// Density in sr^-1 of the direction of the current segment; `None` for camera rays and Dirac
    /// scattering, where light samples cannot find the same light.
    pdf: Option<f32>,
    /// How many lights the next vertex chooses.
    count: u32,
}

impl<'a, S: LightSampler, L: LightSum> PathState<'a, S, L> {
    /// Paths of fewer vertices are never ended at random.
    const SURE_VERTICES: u32 = 4;

    /// A path at the camera, the light of which goes into `sum`.
    #[inline]
    pub(super) fn new(
        world: &'a World,
        sampler: &'a S,
        settings: &PathSettings,
        sum: &'a mut L,
    ) -> Self {
        Self {
            sum,
            rays: 0,
            throughput: Vec3::ONE,
            direct: DirectLight::new(world, sampler, settings.estimator),
            query: None,
            pdf: None,
            count: settings.first_choices(world),
        }
    }

    /// Adds the infinite lights along a segment that leaves the scene.
    #[inline]
    pub(super) fn add_sky(&mut self, ray: &Ray) {
        for (light, le) in sky(self.direct.world, ray) {
            let weight = self.light_weight(light, ray.direction);
            self.sum.add(Some(light), self.throughput * (le * weight));
        }
    }

    /// Adds the emission of the medium along the current segment.
    #[inline]
    pub(super) fn add_medium(&mut self, emitted: Vec3) {
        self.sum.add(None, self.throughput * emitted);
    }

    /// Adds the emission of the surface that a segment in the direction `wi` hits.
    #[inline]
    pub(super) fn add_emission(&mut self, surface: &Surface, wi: Vec3) {
        if let Some((light, l)) = self.direct.world.emitted(surface, -wi) {
            let weight = self.light_weight(light, wi);
            self.sum.add(Some(light), self.throughput * l * weight);
        }
    }

    /// Scatters the path at `vertex`, which has the given number: adds direct light, and samples
    /// the next direction. `None` where the path ends.
    ///
    /// `arrived` returns the transmittance of an unshadowed light sample.
    #[inline]
    pub(super) fn scatter<V: PathVertex>(
        &mut self,
        vertex: &V,
        wo: Vec3,
        number: u32,
        stream: &SampleStream,
        arrived: impl FnOnce(&Unshadowed) -> Arrived,
    ) -> Option<Vec3> {
        let numbers = stream.vertex(number);
        let is_dirac = vertex.is_dirac();
        let chosen = if !is_dirac && self.direct.estimator.samples_lights() {
            let ctx = vertex.light_context(self.direct.world, wo);
            let query = self.query.insert(self.direct.query(ctx, self.count));
            let chosen = self.direct.choose(query, &numbers);
            Some((&*query, chosen))
        } else {
            None
        };
        // Before the lights are read, which the choice has prefetched.
        let sample = vertex.sample(wo, numbers.lobe, numbers.direction);
        if let Some((query, chosen)) = &chosen {
            let at = Vertex {
                scattering: vertex,
                wo,
                number,
            };
            let lit = self
                .direct
                .sample(query, chosen, &at, &numbers, stream, arrived);
            self.sum.add(lit.light, self.throughput * lit.radiance);
            self.rays += lit.rays;
        }
        if !is_dirac {
            self.count = 1;
        }
        let sample = sample?;
        self.throughput *= sample.weight;
        if number + 1 >= Self::SURE_VERTICES {
            let survival = self.throughput.max_element().min(0.95);
            if !(numbers.roulette < survival) {
                return None;
            }
            self.throughput /= survival;
        }
        self.pdf = sample.pdf;
        Some(sample.wi)
    }

    /// The weight of the light `light` that the current segment finds in the direction `wi`.
    #[inline]
    fn light_weight(&self, light: LightId, wi: Vec3) -> f32 {
        let (Some(pdf), Some(query)) = (self.pdf, &self.query) else {
            return 1.0;
        };
        let density = || self.direct.density(query, light, wi);
        self.direct.estimator.bsdf_weight(pdf, density)
    }
}
