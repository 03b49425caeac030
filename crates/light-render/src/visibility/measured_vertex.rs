use lights::bounds::{LightSampleContext, SampledLight};
use lights::glam::{Vec2, Vec3};
use lights::math::fraction::stratum;
use lights::samplers::{BvhLightSampler, LightChoices, LightSampler};
use lights::sources::Light;

use super::choice_plan::ChoicePlan;
use crate::bsdf::Scattering;
use crate::integrator::{Estimator, is_in_the_surface};
use crate::{SampleStream, Surface, World};

/// A vertex where lights are sampled.
pub(super) struct MeasuredVertex {
    pub(super) surface: Surface,
    pub(super) scattering: Scattering,
    pub(super) wo: Vec3,
    /// The share of the vertex's light that the path carries to the camera.
    pub(super) throughput: Vec3,
}

/// Moments of one light sample at a vertex: each is a mean of unbiased estimates. Light is the sum
/// of the channels.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct VertexMoments {
    /// Light samples that would arrive without occlusion.
    pub(super) asked: f64,
    /// Those that arrive.
    pub(super) seen: f64,
    /// What arrives, and what would without occlusion.
    pub(super) arriving: f64,
    pub(super) unoccluded: f64,
    /// The square of what arrives.
    pub(super) arriving_sq: f64,
    /// The mean square of one sample by each of the two choices, and of the sum of two by the
    /// second if each is tested.
    pub(super) first: f64,
    pub(super) second: f64,
    pub(super) pair: f64,
}

impl MeasuredVertex {
    /// The receiver there.
    pub(super) fn context(&self, world: &World) -> LightSampleContext {
        world.light_context(&self.surface, &self.scattering, self.wo)
    }

    /// The moments of `count` light samples, half of them by each of the two `choices` at
    /// `ctx`. A light's probability is that of all of them together, so that each sample tells of
    /// both choices. Random numbers are those of vertex `number` of `stream`.
    pub(super) fn moments(
        &self,
        world: &World,
        ctx: &LightSampleContext,
        choices: &[LightChoices<'_>; 2],
        stream: &SampleStream,
        (number, count): (u32, u32),
    ) -> VertexMoments {
        let u = stream.vertex(number).light;
        let mut sum = VertexMoments::default();
        let mut squares = 0.0;
        for i in 0..count {
            // One from each in turn.
            let u = stratum(i / 2, count / 2, u);
            let choice = choices[i as usize % 2].sample(u);
            let point = stream.light_point(number, i, count);
            if let Some(sample) =
                choice.and_then(|choice| self.sample(world, ctx, choices, choice, point))
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
        let [first, second] = choices.each_ref().map(|c| c.pmf(choice.light));
        if !(light > 0.0 && first > 0.0 && second > 0.0) {
            return None;
        }
        let kind = world.lights().get(choice.light)?.light_type();
        let bsdf = self.scattering.pdf(self.wo, li.wi);
        let weighted = |expected: f32| {
            light * f64::from(estimator.light_weight(kind, expected * li.pdf, || bsdf))
        };
        let of_pair = weighted(2.0 * second);
        let is_seen = !world.occluded(&self.surface, li.wi, li.p_light);
        let seen = f64::from(u8::from(is_seen));
        let [by_first, by_second] = [weighted(first), weighted(second)];
        let [first, second] = [first, second].map(f64::from);
        let all = 0.5 * (first + second);
        Some(VertexMoments {
            asked: 1.0,
            seen,
            arriving: seen * of_pair / all,
            unoccluded: of_pair / all,
            arriving_sq: 0.0,
            first: seen * by_first * by_first / (all * first),
            second: seen * by_second * by_second / (all * second),
            pair: seen * of_pair * of_pair / (all * second),
        })
    }
}

/// The choices of a plan for one light at `ctx`.
pub(super) fn choices_of<'a>(
    plan: ChoicePlan,
    lights: &'a BvhLightSampler,
    ctx: &LightSampleContext,
) -> LightChoices<'a> {
    let [asked, made] = plan.counts(1);
    lights.at(ctx, asked).with_count(made)
}

impl VertexMoments {
    /// The variance of one sample by each [`ChoicePlan`], the first choice being from the root and
    /// the second by a cut.
    pub(super) fn variances(&self) -> [f64; 3] {
        // Of two candidates `a` and `b`, one is tested with a probability in proportion to its
        // light, and stands for their sum: the mean of `(a + b) (a v_a + b v_b)`, each half.
        let two = 0.5 * (self.pair + self.unoccluded * self.arriving);
        [self.first, self.second, two].map(|square| square - self.arriving_sq)
    }

    fn add(&mut self, other: &Self) {
        self.asked += other.asked;
        self.seen += other.seen;
        self.arriving += other.arriving;
        self.unoccluded += other.unoccluded;
        self.first += other.first;
        self.second += other.second;
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
            first: self.first / count,
            second: self.second / count,
            pair: self.pair / count,
            ..self
        }
    }
}
