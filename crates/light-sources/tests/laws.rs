//! The laws that every light obeys: densities against samples, estimates against integrals, power, bounds.

use light_math::equal_area::sphere_to_square;
use light_sources::glam::{Affine3A, Vec3};
use light_sources::light_math;
use light_sources::shape::Triangle;
use light_sources::*;
use light_testkit::laws::light::*;
use light_testkit::{Cap, naive};

const SCENE_RADIUS: f32 = 5.0;

fn scene() -> SceneSphere {
    SceneSphere::new(Vec3::ZERO, SCENE_RADIUS).expect("a sphere")
}

#[test]
fn point() {
    let position = Vec3::new(1.0, 2.0, -1.0);
    let light = PointLight::<Rgb>::new(PointLightDesc {
        position,
        emission: Vec3::ONE,
        amount: IntensityAmount::Radiometric(3.0),
        media: MediumInterface::default(),
    })
    .expect("a point light");
    let case = LightCase::<Rgb, _>::around("point", &light, position, 1.0, 12);
    dirac_li_is(&case, |p| 3.0 / f64::from(p.distance_squared(position)));
    le_adds_up_to_phi(&case);
    le_has_no_variance(&case);
    flux_is_phi(&case);
    bounds_hold(&case);
    edges_are_survived(&case);
}

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
    bounds_hold(&case);
    edges_are_survived(&case);
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
    bounds_hold(&case);
    edges_are_survived(&case);
}

#[test]
fn triangle() {
    let corners = [
        Vec3::ZERO,
        Vec3::new(2.0, 0.0, 0.3),
        Vec3::new(0.4, 1.5, 0.0),
    ];
    for sides in [Sides::Front, Sides::Back, Sides::Both] {
        let mut desc = DiffuseEmissionDesc::<Rgb>::new(
            SurfaceColor::Uniform(Vec3::ONE),
            RadianceAmount::Radiometric(1.5),
        );
        desc.sides = sides;
        let emission = DiffuseEmission::new(desc).expect("an emission");
        let shape = Triangle::new(corners, Triangle::DEFAULT_UV).expect("a triangle");
        let light = DiffuseAreaLight::new(shape, &emission);
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        let case = LightCase::<Rgb, _>::around("triangle", &light, middle, 1.0, 6);
        let radiance = |p, wi| match (naive::hit_triangle(p, wi, corners), sides) {
            (Some(cos), Sides::Front) if cos > 0.0 => 1.5,
            (Some(cos), Sides::Back) if cos < 0.0 => 1.5,
            (Some(_), Sides::Both) => 1.5,
            _ => 0.0,
        };
        li_follows_its_density(&case, |p| cap_around(p, &corners), radiance);
        li_adds_up(&case, |p| cap_around(p, &corners), radiance);
        le_adds_up_to_phi(&case);
        le_has_no_variance(&case);
        flux_is_phi(&case);
        bounds_hold(&case);
        edges_are_survived(&case);
    }
}

/// A cap around all directions from `p` to a convex shape with these corners.
fn cap_around(p: Vec3, corners: &[Vec3]) -> Cap {
    let to = |corner: &Vec3| (*corner - p).normalize();
    let axis: Vec3 = corners.iter().map(to).sum();
    let angles = corners.iter().map(|c| f64::from(to(c).angle_between(axis)));
    let angle = angles.fold(1e-3, f64::max);
    // Beyond a hemisphere the sides of the shape bulge out of the cap through its corners.
    if angle < 1.5 {
        Cap::new(axis, angle + 1e-3)
    } else {
        Cap::sphere()
    }
}
