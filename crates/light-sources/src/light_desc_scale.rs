use crate::color::ColorModel;
use crate::light_desc::LightDesc;
use crate::sun_desc::SunAmount;

impl<C: ColorModel> LightDesc<C> {
    /// Whether it is a sky or a sun: light from all around that has a radiance. A distant light is
    /// none; an own light is none either, since nothing but its set asks what it is.
    #[must_use]
    pub const fn is_sky(&self) -> bool {
        match self {
            Self::Sun(_)
            | Self::UniformInfinite(_)
            | Self::ImageInfinite(_)
            | Self::PortalInfinite(_) => true,
            Self::Point(_)
            | Self::Spot(_)
            | Self::Projection(_)
            | Self::Goniometric(_)
            | Self::Area(_)
            | Self::Mesh(_)
            | Self::Own(_)
            | Self::Distant(_) => false,
        }
    }

    /// Makes it `factor` times as bright; `false` for an own light, which stays as it is.
    pub fn scale(&mut self, factor: f32) -> bool {
        match self {
            Self::Point(light) => light.amount = light.amount.scaled(factor),
            Self::Spot(light) => light.amount = light.amount.scaled(factor),
            Self::Projection(light) => light.amount = light.amount.scaled(factor),
            Self::Goniometric(light) => light.amount = light.amount.scaled(factor),
            Self::Area(light) => light.emission.amount = light.emission.amount.scaled(factor),
            Self::Mesh(light) => light.emission.amount = light.emission.amount.scaled(factor),
            Self::Own(_) => return false,
            Self::Distant(light) => light.amount = light.amount.scaled(factor),
            Self::Sun(light) => {
                light.amount = match light.amount {
                    SunAmount::Radiance(amount) => SunAmount::Radiance(amount.scaled(factor)),
                    SunAmount::Irradiance(amount) => SunAmount::Irradiance(amount.scaled(factor)),
                }
            }
            Self::UniformInfinite(light) => light.amount = light.amount.scaled(factor),
            Self::ImageInfinite(light) => light.amount = light.amount.scaled(factor),
            Self::PortalInfinite(light) => light.amount = light.amount.scaled(factor),
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::amount::{IntensityAmount, RadianceAmount};
    use crate::glam::Vec3;
    use crate::light::Light;
    use crate::light_set_builder::LightSetBuilder;
    use crate::point::PointLightDesc;
    use crate::rgb::Rgb;
    use crate::scene_sphere::SceneSphere;
    use crate::sun_desc::SunLightDesc;
    use crate::uniform_infinite::UniformInfiniteLightDesc;
    use light_math::spectrum::photometric::{Candela, Lumen, Lux, Nit, Watt};

    fn power(light: &LightDesc<Rgb>) -> f32 {
        let sphere = SceneSphere::new(Vec3::ZERO, 1.0).expect("a sphere");
        let mut builder = LightSetBuilder::new(sphere);
        builder.add(light.clone()).expect("a light");
        let set = builder.build();
        let (_, light) = set.iter().next().expect("one light");
        light.phi(&()).x
    }

    #[test]
    fn lights_of_all_units_become_brighter() {
        let point = |amount| {
            LightDesc::Point(PointLightDesc {
                position: Vec3::ZERO,
                emission: Vec3::ONE,
                amount,
                media: Default::default(),
            })
        };
        let sky =
            |amount| LightDesc::UniformInfinite(UniformInfiniteLightDesc::new(Vec3::ONE, amount));
        let sun = |amount| {
            LightDesc::Sun(SunLightDesc {
                direction: Vec3::Y,
                angular_diameter: 0.01,
                emission: Vec3::ONE,
                amount,
            })
        };
        let irradiance = crate::amount::IrradianceAmount::Illuminance(Lux(2.0));
        for (mut light, is_sky) in [
            (point(IntensityAmount::Radiometric(2.0)), false),
            (
                point(IntensityAmount::LuminousIntensity(Candela(2.0))),
                false,
            ),
            (point(IntensityAmount::LuminousPower(Lumen(2.0))), false),
            (point(IntensityAmount::RadiantPower(Watt(2.0))), false),
            (sky(RadianceAmount::Radiometric(2.0)), true),
            (sky(RadianceAmount::Luminance(Nit(2.0))), true),
            (
                sun(SunAmount::Radiance(RadianceAmount::Radiometric(2.0))),
                true,
            ),
            (sun(SunAmount::Irradiance(irradiance)), true),
        ] {
            let before = power(&light);
            assert!(light.scale(3.0), "not an own light");
            let after = power(&light);
            assert!(
                (after / before - 3.0).abs() < 1e-5,
                "{light:?}: {before}, {after}"
            );
            assert_eq!(light.is_sky(), is_sky, "{light:?}");
        }
    }
}
