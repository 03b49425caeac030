use light_math::glam::Vec3;
use light_sets::{SetKind, SetLight};

use crate::sampler_case::CONTEXTS;
use crate::{Emitter, Rng, SamplerCase};

impl SamplerCase {
    /// Cases on which light hierarchies have failed, each with about `n` lights.
    #[must_use]
    pub fn adversarial(n: usize) -> Vec<Self> {
        vec![
            Self::empty(),
            Self::single(),
            Self::generated(SetKind::OnePoint, n, 3),
            Self::generated(SetKind::Line, n, 4),
            Self::generated(SetKind::Nested, n, 5),
            Self::generated(SetKind::LargeWorld, n, 6),
            Self::generated(SetKind::Magnitudes, n, 7),
            Self::generated(SetKind::TwinPlaces, n, 8),
            Self::generated(SetKind::FarLamp, n, 8),
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
        let light = panel(Vec3::Y, 0.5, 2.0);
        Self::new("single", vec![light], CONTEXTS, 2)
    }

    /// Every other light is switched off.
    #[must_use]
    pub fn some_without_power(n: usize) -> Self {
        let mut case = Self::generated(SetKind::Uniform, n, 9);
        for light in case.emitters.iter_mut().step_by(2) {
            if let Emitter::Set(SetLight::Triangle { radiance, .. }) = light {
                *radiance = 0.0;
            }
        }
        Self {
            name: "some without power",
            ..case
        }
    }

    /// All lights are switched off.
    #[must_use]
    pub fn none_with_power(n: usize) -> Self {
        let off = Emitter::Set(SetLight::Point {
            p: Vec3::ONE,
            intensity: 0.0,
        });
        Self::new("none with power", vec![off; n], CONTEXTS, 10)
    }

    /// One light that is a billion times stronger than the others and encloses them.
    #[must_use]
    pub fn one_huge(n: usize) -> Self {
        let mut case = Self::generated(SetKind::Uniform, n, 11);
        if let Some(light) = case.emitters.last_mut() {
            *light = panel(Vec3::splat(0.5), 50.0, 1e9);
        }
        Self {
            name: "one huge",
            ..case
        }
    }

    /// Pairs of triangles at one place that face opposite ways: the cone of each pair is the whole
    /// sphere.
    #[must_use]
    pub fn back_to_back(n: usize) -> Self {
        let front = Self::generated(SetKind::Uniform, n.div_ceil(2), 12).emitters;
        let emitters = front.into_iter().flat_map(|light| [light, turned(light)]);
        Self::new("back to back", emitters.collect(), CONTEXTS, 12)
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

/// A triangle about `center` that faces down: half of a square of sides of twice `half`.
fn panel(center: Vec3, half: f32, radiance: f32) -> Emitter {
    let corner = |x: f32, y: f32| center + Vec3::new(x, y, 0.0) * half;
    Emitter::Set(SetLight::Triangle {
        vertices: [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, -1.0)],
        radiance,
        two_sided: false,
    })
}

/// The triangle in the same place that faces the other way.
fn turned(light: Emitter) -> Emitter {
    match light {
        Emitter::Set(SetLight::Triangle {
            vertices: [a, b, c],
            radiance,
            two_sided,
        }) => Emitter::Set(SetLight::Triangle {
            vertices: [a, c, b],
            radiance,
            two_sided,
        }),
        other => other,
    }
}
