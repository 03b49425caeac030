use alloc::vec::Vec;

use light_bounds::{
    InfiniteBounds, LightExtent, LightId, LightSampleContext, ReceiverSides, SampledLight,
};
use light_math::glam::Vec3;
use light_math::{direction, float};

use crate::first_choice::{FirstChoice, FirstPmf, share};

/// Least cosine while any light may arrive, and the rounding margin of the test that none arrives.
const SLACK: f32 = 1e-5;

/// The lights at infinity.
#[derive(Clone, Debug, Default)]
pub(crate) struct InfiniteLights {
    /// In ascending order of ids, without lights of zero fluence.
    lights: Vec<(LightId, InfiniteBounds)>,
}

impl InfiniteLights {
    /// The infinite ones of `lights`.
    pub(crate) fn new(lights: &[LightExtent]) -> Self {
        let mut infinite = Self::default();
        infinite.replace(lights);
        infinite
    }

    /// Takes the infinite ones of `lights` instead; allocates only if they are more than before.
    pub(crate) fn replace(&mut self, lights: &[LightExtent]) {
        let infinite = (0..)
            .map(LightId)
            .zip(lights)
            .filter_map(|(id, extent)| Some((id, *extent.infinite()?)))
            .filter(|(_, bounds)| bounds.fluence > 0.0);
        // Valid bounds have an axis of about length one: too rough for the test against the
        // horizon.
        let with_unit_axis = |(id, mut bounds): (LightId, InfiniteBounds)| {
            bounds.cone.w = direction(bounds.cone.w).unwrap_or(Vec3::Z);
            (id, bounds)
        };
        self.lights.clear();
        self.lights.extend(infinite.map(with_unit_axis));
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.lights.is_empty()
    }

    /// The bounds of `light`, if it is at infinity.
    fn get(&self, light: LightId) -> Option<&InfiniteBounds> {
        let at = self.lights.binary_search_by_key(&light, |(id, _)| *id);
        at.ok().map(|index| &self.lights[index].1)
    }

    /// The choice between these and the lights of a tree, whose weight is `in_tree`.
    pub(crate) fn first(
        &self,
        u: f64,
        in_tree: f64,
        weight: impl Fn(&InfiniteBounds) -> f64,
    ) -> FirstChoice {
        let total = in_tree + self.total(&weight);
        let target = u * total;
        if target < in_tree {
            return FirstChoice::Others {
                pmf: share(in_tree, total),
                u: SampledLight::clamp_u(target / in_tree),
            };
        }
        let pmf = |weight| share(weight, total);
        FirstChoice::Infinite(self.choose(target - in_tree, &weight, pmf))
    }

    /// The probability of the first choice that leads to `light`.
    pub(crate) fn first_pmf(
        &self,
        light: LightId,
        in_tree: f64,
        weight: impl Fn(&InfiniteBounds) -> f64,
    ) -> FirstPmf {
        let total = in_tree + self.total(&weight);
        match self.get(light) {
            Some(bounds) => FirstPmf::Infinite(share(weight(bounds), total)),
            None => FirstPmf::Others(share(in_tree, total)),
        }
    }

    /// The sum of `weight` over all lights.
    fn total(&self, weight: impl Fn(&InfiniteBounds) -> f64) -> f64 {
        self.lights.iter().map(|(_, bounds)| weight(bounds)).sum()
    }

    /// The light whose interval of `[0, total)` contains `target`, with the same probability as
    /// `pmf`.
    fn choose(
        &self,
        target: f64,
        weight: impl Fn(&InfiniteBounds) -> f64,
        pmf: impl Fn(f64) -> f32,
    ) -> Option<SampledLight> {
        let mut below = 0.0;
        let mut chosen = None;
        for (light, bounds) in &self.lights {
            let weight = weight(bounds);
            if weight > 0.0 {
                chosen = Some((*light, below, weight));
                if target < below + weight {
                    break;
                }
                below += weight;
            }
        }
        let (light, start, weight) = chosen?;
        Some(SampledLight {
            light,
            pmf: pmf(weight),
            u: SampledLight::clamp_u((target - start) / weight),
        })
    }
}

/// Estimated irradiance at `ctx` from a light at infinity; 0 only if all of it is below the
/// horizon.
pub(crate) fn irradiance(bounds: &InfiniteBounds, ctx: &LightSampleContext) -> f64 {
    f64::from(bounds.fluence) * f64::from(mean_cosine(bounds, ctx))
}

fn mean_cosine(bounds: &InfiniteBounds, ctx: &LightSampleContext) -> f32 {
    let Some(ns) = ctx.unit_ns() else {
        return 1.0;
    };
    if ctx.sides == ReceiverSides::Both {
        let height = ns.dot(bounds.mean).abs();
        return height
            .max(0.5 * float::safe_sqrt(1.0 - bounds.mean.length_squared()))
            .max(SLACK);
    }
    let cone = &bounds.cone;
    if cone.cos_theta >= 0.0 {
        let sin = float::safe_sqrt((1.0 - cone.cos_theta) * (1.0 + cone.cos_theta));
        if ns.dot(cone.w) + sin < -SLACK {
            return 0.0;
        }
    }
    let height = ns.dot(bounds.mean);
    let variance = (1.0 - bounds.mean.length_squared()).max(0.0);
    // Of a uniform sky a quarter arrives, of a distant light the cosine.
    let expected = 0.5 * (height + float::sqrt(height * height + 0.25 * variance));
    expected.max(SLACK)
}

#[cfg(test)]
mod tests;
