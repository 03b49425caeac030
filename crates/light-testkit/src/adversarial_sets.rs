use light_math::glam::Vec3;

use crate::generated_sets::triangle;
use crate::{Emitter, LightSet, Rng};

/// Contexts at random positions in a set; more are added at its bounds.
const CONTEXTS: usize = 8;

impl LightSet {
    /// Sets on which light hierarchies have failed, each with about `n` lights.
    #[must_use]
    pub fn adversarial(n: usize) -> Vec<Self> {
        vec![
            Self::empty(),
            Self::single(),
            Self::one_point(n),
            Self::collinear(n),
            Self::nested_clusters(n),
            Self::large_world(n),
            Self::all_magnitudes(n),
            Self::some_without_power(n),
            Self::none_with_power(n),
            Self::one_huge(n),
            Self::back_to_back(n),
            Self::lanterns(n),
            Self::only_infinite(),
        ]
    }

    /// No light at all.
    #[must_use]
    pub fn empty() -> Self {
        Self::new("empty", Vec::new(), CONTEXTS, 1)
    }

    /// One light, one choice.
    #[must_use]
    pub fn single() -> Self {
        let light = triangle(&mut Rng::new(2), Vec3::Y, Vec3::NEG_Y, 0.5, 1.0);
        Self::new("single", vec![light], CONTEXTS, 2)
    }

    /// Points and spots at one position, which no split by position separates.
    #[must_use]
    pub fn one_point(n: usize) -> Self {
        let mut rng = Rng::new(3);
        let position = Vec3::new(1.0, 2.0, 3.0);
        let light = |i: usize| match i % 3 {
            0 => Emitter::Point {
                position,
                intensity: rng.log_range(0.01, 1.0),
            },
            _ => Emitter::Spot {
                position,
                axis: rng.direction(),
                intensity: 1.0,
                cos_start: 0.9,
                cos_end: 0.5,
            },
        };
        Self::new("one point", (0..n).map(light).collect(), CONTEXTS, 3)
    }

    /// Points along an axis: no box of them has a surface.
    #[must_use]
    pub fn collinear(n: usize) -> Self {
        let mut rng = Rng::new(4);
        let light = |_| Emitter::Point {
            position: Vec3::X * rng.range(-1.0, 1.0),
            intensity: rng.log_range(0.01, 1.0),
        };
        Self::new("collinear", (0..n).map(light).collect(), CONTEXTS, 4)
    }

    /// Clusters within clusters, each eight times smaller, over 24 scales: a tree of binary splits
    /// grows deep.
    #[must_use]
    pub fn nested_clusters(n: usize) -> Self {
        let mut rng = Rng::new(5);
        let light = |i| {
            let scale = f32::powi(0.125, (i % 24) as i32);
            let (p, w) = (rng.vec3() * scale, rng.direction());
            triangle(&mut rng, p, w, 0.05 * scale, scale)
        };
        let emitters = (0..n).map(light).collect();
        let mut set = Self::new("nested clusters", emitters, CONTEXTS, 5);
        for (i, ctx) in set.contexts.iter_mut().enumerate() {
            ctx.p *= f32::powi(0.125, 2 * i as i32);
        }
        set
    }

    /// Lights of 2 cm in a world of 10 km.
    #[must_use]
    pub fn large_world(n: usize) -> Self {
        let mut rng = Rng::new(6);
        let light = |i| {
            let town = Vec3::new((i % 5) as f32, (i % 3) as f32, 0.0) * 2500.0;
            let (p, w) = (town + rng.vec3() * 20.0, rng.direction());
            triangle(&mut rng, p, w, 0.02, 1.0)
        };
        let emitters = (0..n).map(light).collect();
        let mut set = Self::new("large world", emitters, CONTEXTS, 6);
        // Most contexts in the towns: between them every light is a point.
        for ctx in set.contexts.iter_mut().skip(2) {
            ctx.p = Vec3::new(2500.0, 2500.0, 0.0) + rng.vec3() * 20.0;
        }
        set
    }

    /// Coordinates from 1e-20 to 1e18, with powers to match, and contexts of the same magnitudes.
    #[must_use]
    pub fn all_magnitudes(n: usize) -> Self {
        let mut rng = Rng::new(7);
        let mut magnitude = |i: usize| {
            f32::powf(10.0, -20.0 + 38.0 * ((i * 7) % 39) as f32 / 38.0) * rng.range(0.5, 1.0)
        };
        let scales: Vec<f32> = (0..n.max(CONTEXTS)).map(&mut magnitude).collect();
        let mut rng = Rng::new(8);
        let light = |i: usize| Emitter::Point {
            position: rng.direction() * scales[i],
            intensity: f32::min(scales[i] * scales[i], 1e30),
        };
        let emitters = (0..n).map(light).collect();
        let mut set = Self::new("all magnitudes", emitters, CONTEXTS, 7);
        for (ctx, scale) in set.contexts.iter_mut().take(CONTEXTS).zip(&scales) {
            ctx.p = Vec3::new(0.3, -0.2, 0.6) * *scale;
        }
        set
    }

    /// Every other light is switched off.
    #[must_use]
    pub fn some_without_power(n: usize) -> Self {
        let mut set = Self::uniform(n, 9);
        for light in set.emitters.iter_mut().step_by(2) {
            if let Emitter::Triangle { radiance, .. } = light {
                *radiance = 0.0;
            }
        }
        Self {
            name: "some without power",
            ..set
        }
    }

    /// All lights are switched off.
    #[must_use]
    pub fn none_with_power(n: usize) -> Self {
        let off = Emitter::Point {
            position: Vec3::ONE,
            intensity: 0.0,
        };
        Self::new("none with power", vec![off; n], CONTEXTS, 10)
    }

    /// One light that is a billion times stronger than the others and encloses them.
    #[must_use]
    pub fn one_huge(n: usize) -> Self {
        let mut set = Self::uniform(n, 11);
        if let Some(light) = set.emitters.last_mut() {
            *light = triangle(&mut Rng::new(11), Vec3::splat(0.5), Vec3::NEG_Z, 50.0, 1e12);
        }
        Self {
            name: "one huge",
            ..set
        }
    }

    /// Pairs of triangles at one place that face opposite ways: the cone of each pair is the whole
    /// sphere.
    #[must_use]
    pub fn back_to_back(n: usize) -> Self {
        let mut rng = Rng::new(12);
        let pair = |_| {
            let (p, w) = (rng.vec3(), rng.direction());
            let front = triangle(&mut rng, p, w, 0.05, 1.0);
            [front, triangle(&mut rng, p, -w, 0.05, 1.0)]
        };
        let emitters = (0..n.div_ceil(2)).flat_map(pair).collect();
        Self::new("back to back", emitters, CONTEXTS, 12)
    }

    /// Beams of all widths, with a little stray light outside of them.
    #[must_use]
    pub fn lanterns(n: usize) -> Self {
        let mut rng = Rng::new(14);
        let light = |i: usize| Emitter::Lantern {
            position: rng.vec3(),
            axis: rng.direction(),
            beam: rng.log_range(0.1, 10.0),
            stray: rng.log_range(1e-6, 1e-2),
            cos_beam: [0.9999, 0.9, 0.0, -0.9][i % 4],
        };
        let emitters = (0..n).map(light).collect();
        Self::new("lanterns", emitters, CONTEXTS, 14)
    }

    /// A sky and two suns.
    #[must_use]
    pub fn only_infinite() -> Self {
        let sun = |wi| Emitter::Sun {
            wi,
            irradiance: 1.0,
        };
        let sky = Emitter::Sky { radiance: 0.5 };
        Self::new(
            "only infinite",
            vec![sun(Vec3::Z), sky, sun(Vec3::NEG_X)],
            CONTEXTS,
            13,
        )
    }
}
