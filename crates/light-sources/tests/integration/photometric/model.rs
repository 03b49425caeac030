use light_sources::glam::Vec3;
use light_sources::light_math::spectrum::{Blackbody, SampledWavelengths, cie};
use light_sources::*;

/// A colour model whose answers can be weighed as the eye does.
pub(crate) trait Model: ColorModel {
    /// The colour of a lamp, of no particular strength.
    fn lamp() -> Self::Emission;

    /// What a quantity amounts to in photometric units.
    fn luminous(quantity: impl Fn(&Self::Wavelengths) -> Self::Radiance) -> f32;

    /// What a quantity amounts to in watts.
    fn radiant(quantity: impl Fn(&Self::Wavelengths) -> Self::Radiance) -> f32;
}

impl Model for Rgb {
    fn lamp() -> Vec3 {
        Vec3::new(3.0, 2.0, 0.5)
    }

    fn luminous(quantity: impl Fn(&()) -> Vec3) -> f32 {
        683.0 * quantity(&()).dot(Vec3::new(0.212_639, 0.715_169, 0.072_192))
    }

    fn radiant(quantity: impl Fn(&()) -> Vec3) -> f32 {
        quantity(&()).element_sum() / 3.0
    }
}

impl Model for Spectral<4> {
    fn lamp() -> SpectralEmission {
        Blackbody::new(2700.0).expect("a temperature").into()
    }

    fn luminous(quantity: impl Fn(&Self::Wavelengths) -> <Self as ColorModel>::Radiance) -> f32 {
        683.0 * integral(quantity, |lambda| cie::matching(lambda).y)
    }

    fn radiant(quantity: impl Fn(&Self::Wavelengths) -> <Self as ColorModel>::Radiance) -> f32 {
        integral(quantity, |_| 1.0)
    }
}

/// The integral over all wavelengths of the visible spectrum, four at a time.
fn integral(
    quantity: impl Fn(&SampledWavelengths<4>) -> <Spectral<4> as ColorModel>::Radiance,
    weight: impl Fn(f32) -> f32,
) -> f32 {
    let mut sum = 0.0;
    for i in 0..118u16 {
        let lambda = [0, 1, 2, 3].map(|k| 360.0 + f32::from(4 * i + k));
        let values = quantity(&SampledWavelengths::from_lambda(lambda));
        for (value, lambda) in values.values().iter().zip(lambda) {
            // The last block reaches beyond 830 nm.
            if lambda <= cie::LAMBDA_MAX {
                // Trapezoids: the ends of the range are half of a nanometre.
                let is_end = lambda == cie::LAMBDA_MIN || lambda == cie::LAMBDA_MAX;
                let width = if is_end { 0.5 } else { 1.0 };
                sum += f64::from(value * weight(lambda) * width);
            }
        }
    }
    #[expect(clippy::cast_possible_truncation, reason = "rounded once")]
    {
        sum as f32
    }
}

/// The light that `desc` describes in a scene of radius 3, and what it is asked by.
pub(crate) fn light_set<C: ColorModel>(desc: LightDesc<C>) -> LightSet<C> {
    let scene = SceneSphere::new(Vec3::ZERO, 3.0).expect("a sphere");
    let mut builder = LightSetBuilder::new(scene);
    builder.add(desc).expect("a light");
    builder.build()
}

/// The luminous power of all lights, in lm.
pub(crate) fn lumens<M: Model>(set: &LightSet<M>) -> f32 {
    let power = |(_, light): (_, LightRef<'_, M>)| M::luminous(|w| light.phi(w));
    set.iter().map(power).sum()
}

pub(crate) fn near(value: f32, expected: f32, what: &str) {
    assert!(
        (value / expected - 1.0).abs() < 1e-4,
        "{what}: {value} for {expected}"
    );
}
