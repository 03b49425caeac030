use lights::bounds::{LightSampleContext, SampledLight};
use lights::glam::{Vec2, Vec3};
use lights::math::fraction::stratum;
use lights::samplers::{BvhLightSampler, LightChoices, LightSampler};
use lights::sources::Light;

use super::choice_plan::ChoicePlan;
use crate::bsdf::Scattering;
use crate::integrator::{Estimator, is_in_the_surface};
use crate::{SampleStream, Surface, View, World};

/// Vertices of a path that are looked at: later ones hardly count.
const MAX_VERTICES: u32 = 3;

/// Light samples at the first vertex, half of them from the root and half by a cut.
const FIRST_SAMPLES: u32 = 8;

/// The same at each later vertex.
const LATER_SAMPLES: u32 = 4;

/// The seed of their random numbers.
const SEED: u32 = 0x5e8a_11d3;

/// What light samples along one path tell of a pixel. Light is the sum of the channels.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PixelMoments {
    /// Light samples at the first vertex that would arrive without occlusion.
    pub(super) asked: f64,
    /// Those that arrive.
    pub(super) seen: f64,
    /// Vertices where light is sampled.
    pub(super) vertices: f64,
    /// The light of the pixel.
    pub(super) mean: f64,
    /// The variance of that light by one sample, by the plan.
    pub(super) variances: [f64; 3],
}

/// The pixel's path with so many vertices at most, from the middle of the pixel, by numbers that
/// depend on the pixel alone.
pub(super) fn pixel_moments(
    world: &World,
    view: &View,
    lights: &BvhLightSampler,
    (x, y): (u32, u32),
    vertices: u32,
) -> PixelMoments {
    let stream = SampleStream::new(SEED, (x, y), 0);
    let corner = Vec2::new(x as f32, y as f32);
    let mut ray = view.ray(corner + 0.5, Vec2::splat(0.5));
    let (mut from, mut throughput) = (None, Vec3::ONE);
    let mut pixel = PixelMoments::default();
    for number in 0..vertices.min(MAX_VERTICES) {
        let Some(surface) = world.closest(&ray, from) else {
            break;
        };
        let vertex = MeasuredVertex {
            surface,
            scattering: world.scattering(&surface),
            wo: -ray.direction,
            throughput,
        };
        if !vertex.scattering.bsdf().is_dirac() {
            pixel.add(vertex.moments(world, lights, &stream, number), number);
        }
        let numbers = stream.vertex(number);
        let scattered = vertex
            .scattering
            .sample(vertex.wo, numbers.lobe, numbers.direction);
        let Some(scattered) = scattered else {
            break;
        };
        throughput *= scattered.weight;
        ray = surface.spawn(scattered.wi);
        from = Some(surface.primitive);
    }
    pixel
}

/// A vertex where lights are sampled.
struct MeasuredVertex {
    surface: Surface,
    scattering: Scattering,
    wo: Vec3,
    /// The share of the vertex's light that the path carries to the camera.
    throughput: Vec3,
}

/// Moments of one light sample at a vertex: each is a mean of unbiased estimates.
#[derive(Clone, Copy, Debug, Default)]
struct VertexMoments {
    asked: f64,
    seen: f64,
    /// What arrives, and what would without occlusion.
    arriving: f64,
    unoccluded: f64,
    /// The square of what arrives.
    arriving_sq: f64,
    /// The mean square of one sample from the root, of one by a cut, and of the sum of two by a cut
    /// if each is tested.
    root: f64,
    cut: f64,
    pair: f64,
}

impl PixelMoments {
    fn add(&mut self, vertex: VertexMoments, number: u32) {
        self.vertices += 1.0;
        self.mean += vertex.arriving;
        if number > 0 {
            // The mean over all paths of the pixel is not known, and small against the squares.
            let later = [vertex.root, vertex.cut, vertex.root];
            self.variances = core::array::from_fn(|plan| self.variances[plan] + later[plan]);
            return;
        }
        self.asked += vertex.asked;
        self.seen += vertex.seen;
        // Of two candidates `a` and `b`, one is tested with a probability in proportion to its
        // light, and stands for their sum: the mean of `(a + b) (a v_a + b v_b)`, each half.
        let two = 0.5 * (vertex.pair + vertex.unoccluded * vertex.arriving);
        for (plan, square) in [
            (ChoicePlan::OneFromRoot, vertex.root),
            (ChoicePlan::OneByCut, vertex.cut),
            (ChoicePlan::AsAsked, two),
        ] {
            self.variances[plan as usize] += square - vertex.arriving_sq;
        }
    }
}

impl MeasuredVertex {
    /// Half of the samples are from the root and half by a cut; a light's probability is that of
    /// all of them together, so that each sample tells of both.
    fn moments(
        &self,
        world: &World,
        lights: &BvhLightSampler,
        stream: &SampleStream,
        number: u32,
    ) -> VertexMoments {
        let ctx = world.light_context(&self.surface, &self.scattering, self.wo);
        let of_plan = |plan: ChoicePlan| {
            let [asked, made] = plan.counts(1);
            lights.at(&ctx, asked).with_count(made)
        };
        let choices = [ChoicePlan::OneFromRoot, ChoicePlan::OneByCut].map(of_plan);
        let count = match number {
            0 => FIRST_SAMPLES,
            _ => LATER_SAMPLES,
        };
        let u = stream.vertex(number).light;
        let mut sum = VertexMoments::default();
        let mut squares = 0.0;
        for i in 0..count {
            // One from each in turn.
            let u = stratum(i / 2, count / 2, u);
            let choice = choices[i as usize % 2].sample(u);
            let point = stream.light_point(number, i, count);
            if let Some(sample) =
                choice.and_then(|choice| self.sample(world, &ctx, &choices, choice, point))
            {
                sum.add(&sample);
                squares += sample.arriving * sample.arriving;
            }
        }
        sum.over(f64::from(count), squares)
    }

    /// One light sample.
    fn sample(
        &self,
        world: &World,
        ctx: &LightSampleContext,
        choices: &[LightChoices<'_>; 2],
        choice: SampledLight,
        point: Vec2,
    ) -> Option<VertexMoments> {
        let estimator = Estimator::Mis;
        let li = world.sample_light(choice.light, ctx, point, estimator.coverage())?;
        if is_in_the_surface(ctx, li.p_light) {
            return None;
        }
        let scattered = self.scattering.eval(self.wo, li.wi) * li.l * self.throughput;
        let light = f64::from(scattered.element_sum() / li.pdf);
        let [root, cut] = choices.each_ref().map(|c| c.pmf(choice.light));
        if !(light > 0.0 && root > 0.0 && cut > 0.0) {
            return None;
        }
        let kind = world.lights().get(choice.light)?.light_type();
        let bsdf = self.scattering.pdf(self.wo, li.wi);
        let weighted = |expected: f32| {
            light * f64::from(estimator.light_weight(kind, expected * li.pdf, || bsdf))
        };
        let of_pair = weighted(2.0 * cut);
        let is_seen = !world.occluded(&self.surface, li.wi, li.p_light);
        let seen = f64::from(u8::from(is_seen));
        let [from_root, by_cut] = [weighted(root), weighted(cut)];
        let [root, cut] = [root, cut].map(f64::from);
        let all = 0.5 * (root + cut);
        Some(VertexMoments {
            asked: 1.0,
            seen,
            arriving: seen * of_pair / all,
            unoccluded: of_pair / all,
            arriving_sq: 0.0,
            root: seen * from_root * from_root / (all * root),
            cut: seen * by_cut * by_cut / (all * cut),
            pair: seen * of_pair * of_pair / (all * cut),
        })
    }
}

impl VertexMoments {
    fn add(&mut self, other: &Self) {
        self.asked += other.asked;
        self.seen += other.seen;
        self.arriving += other.arriving;
        self.unoccluded += other.unoccluded;
        self.root += other.root;
        self.cut += other.cut;
        self.pair += other.pair;
    }

    /// The means of sums over so many samples, of whose arriving light the sum of squares is
    /// `squares`.
    fn over(self, count: f64, squares: f64) -> Self {
        // The mean product of two different samples: its mean is the square of the mean.
        let products = self.arriving * self.arriving - squares;
        Self {
            arriving: self.arriving / count,
            unoccluded: self.unoccluded / count,
            arriving_sq: (products / (count * (count - 1.0))).max(0.0),
            root: self.root / count,
            cut: self.cut / count,
            pair: self.pair / count,
            ..self
        }
    }
}
