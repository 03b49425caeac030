//! The same laws in the spectral colour model: one implementation of every light serves both.

use light_sources::glam::{Affine3A, Vec3};
use light_sources::light_math::spectrum::{Blackbody, SampledWavelengths};
use light_sources::shape::{Rectangle, Shape};
use light_sources::*;
use light_testkit::laws::light::*;

use crate::laws::{SCENE_RADIUS, scene};

type S4 = Spectral<4>;

#[test]
fn an_incandescent_ceiling() {
    let shape = Rectangle::new(Vec3::ZERO, [Vec3::X, Vec3::Y]).expect("a square");
    let desc = DiffuseEmissionDesc::<S4>::new(
        SurfaceColor::Uniform(Blackbody::new(2856.0).expect("a lamp").into()),
        RadianceAmount::Radiometric(3.0),
    );
    let emission = DiffuseEmission::new(desc, [&shape]).expect("an emission");
    let light = DiffuseAreaLight::new(&shape, &emission);
    let center = shape.bounds().center();
    let mut case = LightCase::<S4, _>::around("spectral rectangle", &light, center, 1.0, 3);
    case.wavelengths = SampledWavelengths::visible(0.3);
    le_adds_up_to_phi(&case);
    le_has_no_variance(&case);
    flux_is_phi(&case);
    rays_and_samples_light_alike(&case, center, 1.2);
    bounds_hold(&case);
    edges_are_survived(&case);
}

#[test]
fn a_grey_sky() {
    let texels: Vec<f32> = (0..64u8).map(|i| f32::from(i % 9)).collect();
    let image = Image::from_f32([8, 8], Channels::Gray, texels).expect("an image");
    let light = ImageInfiniteLight::<S4>::new(
        ImageInfiniteLightDesc {
            map: EnvironmentMap::EqualArea(image),
            transform: Affine3A::from_rotation_x(0.4),
            amount: RadianceAmount::Radiometric(2.0),
        },
        scene(),
    )
    .expect("an environment");
    let case = LightCase::<S4, _>::around("spectral sky", &light, Vec3::ZERO, 1.0, 2);
    le_adds_up_to_phi(&case);
    le_has_no_variance(&case);
    infinite_flux_is_phi(&case, SCENE_RADIUS);
    rays_and_samples_light_alike(&case, Vec3::ZERO, 2.0);
    bounds_hold(&case);
    edges_are_survived(&case);
}
