use light_math::equal_area::sphere_to_square;
use light_sources::glam::{Affine3A, Vec3};
use light_sources::light_math;
use light_sources::*;
use light_testkit::Cap;
use light_testkit::laws::light::*;

use crate::laws::{SCENE_RADIUS, scene};

/// A sphere well inside of the scene, off its middle.
const INNER: (Vec3, f32) = (Vec3::new(0.5, -1.0, 0.7), 3.0);

#[test]
fn distant() {
    let light = DistantLight::<Rgb>::new(
        DistantLightDesc {
            direction: Vec3::new(1.0, 2.0, 3.0),
            emission: Vec3::ONE,
            amount: IrradianceAmount::Radiometric(2.5),
        },
        scene(),
    )
    .expect("a distant light");
    let case = LightCase::<Rgb, _>::around("distant", &light, Vec3::ZERO, 1.0, 12);
    dirac_li_is(&case, |_| 2.5);
    le_adds_up_to_phi(&case);
    le_has_no_variance(&case);
    rays_and_samples_light_alike(&case, INNER.0, INNER.1);
    bounds_hold(&case);
    edges_are_survived(&case);
}

#[test]
fn sun() {
    for angular_diameter in [0.0093, 0.5, 3.0] {
        let direction = Vec3::new(1.0, 2.0, 3.0);
        let light = SunLight::<Rgb>::new(
            SunLightDesc {
                direction,
                angular_diameter,
                emission: Vec3::ONE,
                amount: SunAmount::Radiance(RadianceAmount::Radiometric(2.5)),
            },
            scene(),
        )
        .expect("a sun");
        let case = LightCase::<Rgb, _>::around("sun", &light, Vec3::ZERO, 1.0, 3);
        let half = f64::from(0.5 * angular_diameter);
        let cap = |_| Cap::new(direction, 1.05 * half);
        let axis = direction.normalize();
        let radiance = |_, wi: Vec3| {
            let is_inside = axis.cross(wi).length() < (0.5 * angular_diameter).sin();
            2.5 * f64::from(u8::from(is_inside && axis.dot(wi) > 0.0))
        };
        li_follows_its_density(&case, cap, radiance);
        li_adds_up(&case, cap, radiance);
        le_adds_up_to_phi(&case);
        le_has_no_variance(&case);
        let travel = Cap::new(-direction, 1.05 * half);
        le_directions_follow_their_density(&case, &travel, Vec3::ZERO);
        rays_and_samples_light_alike(&case, INNER.0, INNER.1);
        bounds_hold(&case);
        edges_are_survived(&case);
    }
}

#[test]
fn uniform_infinite() {
    let light = UniformInfiniteLight::<Rgb>::new(
        UniformInfiniteLightDesc {
            emission: Vec3::ONE,
            amount: RadianceAmount::Radiometric(0.7),
        },
        scene(),
    )
    .expect("a sky");
    let case = LightCase::<Rgb, _>::around("uniform infinite", &light, Vec3::ZERO, 1.0, 3);
    let (cap, radiance) = (|_| Cap::sphere(), |_, _| 0.7f32.into());
    li_follows_its_density(&case, cap, radiance);
    li_adds_up(&case, cap, radiance);
    le_adds_up_to_phi(&case);
    le_has_no_variance(&case);
    infinite_flux_is_phi(&case, SCENE_RADIUS);
    le_directions_follow_their_density(&case, &Cap::sphere(), Vec3::ZERO);
    rays_and_samples_light_alike(&case, INNER.0, INNER.1);
    bounds_hold(&case);
    edges_are_survived(&case);
}

#[test]
fn image_infinite() {
    // Half of the texels black, a few bright.
    let texel = |i: u16| f32::from(i % 2) * (1.0 + f32::from(i * 7 % 13));
    let texels: Vec<f32> = (0..64).flat_map(|i| [texel(i); 3]).collect();
    let image = Image::from_f32([8, 8], Channels::Rgb, texels).expect("an image");
    let light = ImageInfiniteLight::<Rgb>::new(
        ImageInfiniteLightDesc {
            map: EnvironmentMap::EqualArea(image.clone()),
            transform: Affine3A::from_rotation_x(0.4),
            amount: RadianceAmount::Radiometric(2.0),
        },
        scene(),
    )
    .expect("an environment");
    let case = LightCase::<Rgb, _>::around("image infinite", &light, Vec3::ZERO, 1.0, 2);
    let to_map = Affine3A::from_rotation_x(-0.4);
    let radiance = |_, wi| {
        let uv = sphere_to_square(to_map.transform_vector3(wi));
        2.0 * f64::from(image.nearest(uv).x)
    };
    li_follows_its_density(&case, |_| Cap::sphere(), radiance);
    li_adds_up(&case, |_| Cap::sphere(), radiance);
    le_adds_up_to_phi(&case);
    infinite_flux_is_phi(&case, SCENE_RADIUS);
    le_directions_follow_their_density(&case, &Cap::sphere(), Vec3::ZERO);
    rays_and_samples_light_alike(&case, INNER.0, INNER.1);
    bounds_hold(&case);
    edges_are_survived(&case);
}
