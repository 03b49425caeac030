use light_sources::glam::{Affine3A, Quat, Vec2, Vec3};
use light_sources::light_bounds::LightSampleContext;
use light_sources::light_math::equal_area::sphere_to_square;
use light_sources::*;
use light_testkit::laws::light::*;
use light_testkit::{Cap, Rng};

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
    le_directions_follow_their_density(&case, &Cap::sphere(), position);
    rays_and_samples_light_alike(&case, position, 1.0);
    bounds_hold(&case);
    edges_are_survived(&case);
}

#[test]
fn spot() {
    let transform = tilted();
    for (angle, falloff_start) in [(0.6f32, 0.3f32), (0.5, 0.5), (2.5, 0.0), (0.05, 0.02)] {
        let light = SpotLight::<Rgb>::new(SpotLightDesc {
            transform,
            angle,
            falloff_start,
            emission: Vec3::ONE,
            amount: IntensityAmount::Radiometric(3.0),
            media: MediumInterface::default(),
        })
        .expect("a spot light");
        let mut case = LightCase::<Rgb, _>::around("spot", &light, POSITION, 1.0, 12);
        case.contexts.extend(in_the_beam(transform, angle));
        let [start, end] = [falloff_start, angle].map(|angle| f64::from(angle).cos());
        dirac_li_is(&case, |p| {
            let [x, y, z] = local(transform, p);
            let dist_sq = x * x + y * y + z * z;
            let t = ((z / dist_sq.sqrt() - end) / (start - end).max(1e-12)).clamp(0.0, 1.0);
            3.0 * t * t * (3.0 - 2.0 * t) / dist_sq
        });
        le_adds_up_to_phi(&case);
        le_has_no_variance(&case);
        let beam = Cap::new(
            transform.transform_vector3(Vec3::Z),
            1.02 * f64::from(angle),
        );
        le_directions_follow_their_density(&case, &beam, POSITION);
        rays_and_samples_light_alike(&case, POSITION, 1.0);
        bounds_hold(&case);
        edges_are_survived(&case);
        if angle > 0.1 {
            flux_is_phi(&case);
        }
    }
}

#[test]
fn goniometric() {
    let texels: Vec<f32> = (0..64u8).map(|i| f32::from(i % 5)).collect();
    let image = Image::from_f32([8, 8], Channels::Gray, texels).expect("an image");
    let transform = tilted();
    let light = GoniometricLight::<Rgb>::new(GoniometricLightDesc {
        transform,
        distribution: image.clone(),
        emission: Vec3::ONE,
        amount: IntensityAmount::Radiometric(3.0),
        media: MediumInterface::default(),
    })
    .expect("a goniometric light");
    let case = LightCase::<Rgb, _>::around("goniometric", &light, POSITION, 1.0, 24);
    dirac_li_is(&case, |p| {
        let w = Vec3::from_array(local(transform, p).map(|c| c as f32));
        let intensity = 3.0 * image.nearest(sphere_to_square(w.normalize())).x;
        f64::from(intensity / w.length_squared())
    });
    le_adds_up_to_phi(&case);
    le_has_no_variance(&case);
    flux_is_phi(&case);
    le_directions_follow_their_density(&case, &Cap::sphere(), POSITION);
    rays_and_samples_light_alike(&case, POSITION, 1.0);
    bounds_hold(&case);
    edges_are_survived(&case);
}

#[test]
fn projection() {
    let [width, height] = [48u16, 32];
    let texels = (0..width * height).flat_map(|i| [f32::from(i % 11); 3]);
    let size = [u32::from(width), u32::from(height)];
    let image = Image::from_f32(size, Channels::Rgb, texels.collect::<Vec<_>>());
    let image = image.expect("an image");
    let transform = tilted();
    for fov in [0.3f32, 1.2] {
        let light = ProjectionLight::<Rgb>::new(ProjectionLightDesc {
            transform,
            image: image.clone(),
            fov,
            amount: IntensityAmount::Radiometric(3.0),
            media: MediumInterface::default(),
        })
        .expect("a projection light");
        let mut case = LightCase::<Rgb, _>::around("projection", &light, POSITION, 1.0, 12);
        case.contexts.extend(in_the_beam(transform, 0.5 * fov));
        dirac_li_is(&case, |p| {
            let [x, y, z] = local(transform, p);
            let half = f64::from(0.5 * fov).tan();
            let uv = [x / (1.5 * half * z), y / (half * z)].map(|c| (0.5 + 0.5 * c) as f32);
            if z <= 0.0 || uv.iter().any(|c| !(0.0..1.0).contains(c)) {
                return 0.0;
            }
            3.0 * f64::from(image.nearest(uv.into()).x) / (x * x + y * y + z * z)
        });
        le_adds_up_to_phi(&case);
        flux_is_phi(&case);
        // The half diagonal of a picture that is half as wide again as it is high.
        let corner = ((0.5 * f64::from(fov)).tan() * 1.5f64.hypot(1.0)).atan();
        let beam = Cap::new(transform.transform_vector3(Vec3::Z), 1.02 * corner);
        le_directions_follow_their_density(&case, &beam, POSITION);
        rays_and_samples_light_alike(&case, POSITION, 1.0);
        bounds_hold(&case);
        edges_are_survived(&case);
    }
}

const POSITION: Vec3 = Vec3::new(1.0, 2.0, -1.0);

/// A translation and a rotation without special values.
fn tilted() -> Affine3A {
    let rotation = Quat::from_rotation_x(0.7) * Quat::from_rotation_y(-1.9);
    Affine3A::from_rotation_translation(rotation, POSITION)
}

/// A point of the scene in light space.
fn local(transform: Affine3A, p: Vec3) -> [f64; 3] {
    transform
        .inverse()
        .transform_point3(p)
        .to_array()
        .map(f64::from)
}

/// Points within `angle` of the axis +z of a light.
fn in_the_beam(transform: Affine3A, angle: f32) -> Vec<LightSampleContext> {
    let mut rng = Rng::new(3);
    let points = (0..24).map(|_| {
        let around =
            Vec2::from_angle(rng.range(0.0, core::f32::consts::TAU)) * rng.range(0.0, 1.0) * angle;
        let w = Vec3::new(around.x, around.y, 1.0) * rng.range(0.5, 3.0);
        LightSampleContext::medium(transform.transform_point3(w))
    });
    points.collect()
}
