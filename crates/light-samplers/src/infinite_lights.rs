use core::fmt;

#[cfg(feature = "alloc")]
use light_bounds::LightExtent;
use light_bounds::{
    InfiniteBounds, InfiniteBoundsError, LightGroups, LightId, LightSampleContext, ReceiverKind,
    ReceiverSides, SampledLight,
};
#[cfg(feature = "alloc")]
use light_math::{direction, glam::Vec3};
use light_math::{discrete, float};

use crate::first_choice::{FirstChoice, FirstPmf};

/// Least cosine while any light may arrive, and the rounding margin of the test that none arrives.
pub const HORIZON_SLACK: f32 = 1e-5;

/// The place of the tree among the weights of the first choice; the lights at infinity follow.
const TREE: usize = 0;

/// A light at infinity, as a sampler stores it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StoredInfiniteLight {
    /// Its id.
    pub light: LightId,
    /// Its bounds.
    pub bounds: InfiniteBounds,
    /// Its groups.
    pub groups: LightGroups,
}

/// The lights at infinity in ascending order of ids.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct InfiniteLights<'a> {
    lights: &'a [StoredInfiniteLight],
}

/// The infinite ones of `lights` that emit, by id.
///
/// Lights beyond the end of `groups` are in all groups.
#[cfg(feature = "alloc")]
pub(crate) fn emitting<'a>(
    lights: &'a [LightExtent],
    groups: &'a [LightGroups],
) -> impl Iterator<Item = StoredInfiniteLight> + use<'a> {
    let infinite = (0..)
        .map(LightId)
        .zip(lights)
        .filter_map(|(id, extent)| Some((id, *extent.infinite()?)));
    infinite.filter_map(|(light, bounds)| {
        let groups = groups.get(light.index()).copied().unwrap_or_default();
        StoredInfiniteLight::emitting(light, bounds, groups)
    })
}

impl StoredInfiniteLight {
    /// A light with valid bounds, if it emits.
    #[cfg(feature = "alloc")]
    pub(crate) fn emitting(
        light: LightId,
        mut bounds: InfiniteBounds,
        groups: LightGroups,
    ) -> Option<Self> {
        // Valid bounds have an axis of about length one: too rough for the test against the horizon.
        bounds.cone.w = direction(bounds.cone.w).unwrap_or(Vec3::Z);
        (bounds.fluence > 0.0).then_some(Self {
            light,
            bounds,
            groups,
        })
    }

    /// What counts where there is no receiver.
    pub(crate) const fn fluence(&self) -> f32 {
        self.bounds.fluence
    }
}

impl<'a> InfiniteLights<'a> {
    /// Of lights that were stored before.
    pub(crate) fn new(lights: &'a [StoredInfiniteLight]) -> Result<Self, InfiniteLightsError> {
        if !lights.is_sorted_by(|a, b| a.light < b.light) {
            return Err(InfiniteLightsError::Order);
        }
        for &StoredInfiniteLight { light, bounds, .. } in lights {
            let bad = |reason| InfiniteLightsError::Bounds { light, reason };
            bounds.validate().map_err(bad)?;
        }
        Ok(Self { lights })
    }

    /// Of lights that are in order, with valid bounds.
    #[cfg(feature = "alloc")]
    pub(crate) const fn of_valid(lights: &'a [StoredInfiniteLight]) -> Self {
        Self { lights }
    }

    pub(crate) const fn lights(&self) -> &'a [StoredInfiniteLight] {
        self.lights
    }

    pub(crate) const fn is_empty(&self) -> bool {
        self.lights.is_empty()
    }

    /// The choice between these and the lights of a tree, whose weight is `in_tree`; `None` if
    /// nothing has weight.
    #[inline]
    pub(crate) fn first(
        &self,
        u: u64,
        in_tree: f32,
        weight: impl Fn(&StoredInfiniteLight) -> f32,
    ) -> Option<FirstChoice> {
        let weights = self.weights(in_tree, weight);
        // By reference as in `first_pmf`, so that both share one instance of the code.
        let chosen = discrete::sample_by(self.count(), &weights, u)?;
        let (pmf, u) = (chosen.pmf, chosen.u);
        Some(match chosen.index.checked_sub(TREE + 1) {
            None => FirstChoice::Others { pmf, u },
            Some(index) => {
                let light = self.lights[index].light;
                FirstChoice::Infinite(SampledLight { light, pmf, u })
            }
        })
    }

    /// The probability of the first choice that leads to `light`.
    #[inline]
    pub(crate) fn first_pmf(
        &self,
        light: LightId,
        in_tree: f32,
        weight: impl Fn(&StoredInfiniteLight) -> f32,
    ) -> FirstPmf {
        let found = self
            .lights
            .binary_search_by_key(&light, |light| light.light);
        let index = found.map_or(TREE, |index| TREE + 1 + index);
        let weights = self.weights(in_tree, weight);
        let pmf = discrete::pmf_by(self.count(), &weights, index);
        match found {
            Ok(_) => FirstPmf::Infinite(pmf),
            Err(_) => FirstPmf::Others(pmf),
        }
    }

    /// Of the tree and these.
    const fn count(&self) -> usize {
        TREE + 1 + self.lights.len()
    }

    /// The weights of the tree and of these.
    fn weights(
        &self,
        in_tree: f32,
        weight: impl Fn(&StoredInfiniteLight) -> f32,
    ) -> impl Fn(usize) -> f32 {
        let lights = self.lights;
        move |index| match index.checked_sub(TREE + 1) {
            None => in_tree,
            Some(index) => weight(&lights[index]),
        }
    }
}

/// Why lights at infinity cannot be sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum InfiniteLightsError {
    /// They are not in ascending order of their ids.
    Order,
    /// The bounds of a light are not valid.
    Bounds {
        /// Which light.
        light: LightId,
        /// Why.
        reason: InfiniteBoundsError,
    },
}

impl fmt::Display for InfiniteLightsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Order => f.write_str("lights at infinity: not in ascending order of ids"),
            Self::Bounds { light, reason } => write!(f, "light {}: {reason}", light.0),
        }
    }
}

impl core::error::Error for InfiniteLightsError {}

/// Estimated irradiance at `ctx` from a light at infinity; 0 only if all of it is below the
/// horizon, or if it is in none of the groups of `ctx`.
pub(crate) fn irradiance(light: &StoredInfiniteLight, ctx: &LightSampleContext) -> f32 {
    if light.groups.is_wanted(ctx.groups) {
        float::positive_product(light.bounds.fluence, mean_cosine(&light.bounds, ctx))
    } else {
        0.0
    }
}

fn mean_cosine(bounds: &InfiniteBounds, ctx: &LightSampleContext) -> f32 {
    let ReceiverKind::Surface { ns, sides, .. } = *ctx.kind() else {
        return 1.0;
    };
    if sides == ReceiverSides::Both {
        let height = ns.dot(bounds.mean).abs();
        return height
            .max(0.5 * float::safe_sqrt(1.0 - bounds.mean.length_squared()))
            .max(HORIZON_SLACK);
    }
    let cone = &bounds.cone;
    if cone.cos_theta >= 0.0 {
        let sin = float::safe_sqrt((1.0 - cone.cos_theta) * (1.0 + cone.cos_theta));
        if ns.dot(cone.w) + sin < -HORIZON_SLACK {
            return 0.0;
        }
    }
    let height = ns.dot(bounds.mean);
    let variance = (1.0 - bounds.mean.length_squared()).max(0.0);
    // Of a uniform sky a quarter arrives, of a distant light the cosine.
    let expected = 0.5 * (height + float::sqrt(height * height + 0.25 * variance));
    expected.max(HORIZON_SLACK)
}

#[cfg(all(test, feature = "alloc"))]
mod tests;
