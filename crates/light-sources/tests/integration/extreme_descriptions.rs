//! Descriptions at the ends of what a float holds: directions of any length, points that nearly
//! meet, rays along a portal.

use light_sources::glam::{Affine3A, Vec2, Vec3};
use light_sources::light_bounds::{LightExtent, LightSampleContext};
use light_sources::shape::{Rectangle, ShapeDesc};
use light_sources::*;

fn scene() -> SceneSphere {
    SceneSphere::new(Vec3::ZERO, 1.0).expect("a sphere")
}

#[test]
fn directions_to_lights_have_any_length() {
    for length in [1e-40, 1e-23, 1.0, 1e25] {
        let direction = Vec3::new(0.36, 0.48, 0.8) * length;
        let amount = IrradianceAmount::Radiometric(1.0);
        let distant = DistantLight::<Rgb>::new(
            DistantLightDesc {
                direction,
                emission: Vec3::ONE,
                amount,
            },
            scene(),
        );
        let sun = SunLight::<Rgb>::new(
            SunLightDesc {
                direction,
                angular_diameter: 0.01,
                emission: Vec3::ONE,
                amount: SunAmount::Irradiance(amount),
            },
            scene(),
        );
        let extents = [
            distant.expect("a distant light").extent(),
            sun.expect("a sun").extent(),
        ];
        for extent in extents {
            let LightExtent::Infinite(bounds) = extent else {
                panic!("{extent:?} is not at infinity");
            };
            assert_eq!(bounds.validate(), Ok(()), "length {length}: {bounds:?}");
        }
    }
}

#[test]
fn a_point_light_gives_no_more_than_a_float_holds() {
    let light = PointLight::<Rgb>::new(PointLightDesc {
        position: Vec3::ZERO,
        emission: Vec3::ONE,
        amount: IntensityAmount::Radiometric(1e8),
        media: MediumInterface::default(),
    });
    let light = light.expect("a point light");
    for distance in [1e-25, 1e-19, 1e-15, 1e-12, 1.0] {
        let ctx = LightSampleContext::medium(Vec3::X * distance);
        let sample = light.sample_li(&ctx, Vec2::ZERO, &(), PdfCoverage::Complete);
        let l = sample.map_or(Vec3::ZERO, |sample| sample.l);
        assert!(l.is_finite(), "{l} at {distance}");
    }
}

/// Samplers refuse bounds of infinite power.
#[test]
fn lights_of_infinite_power_are_refused() {
    let build = |desc: LightDesc<Rgb>| {
        let mut lights = LightSetBuilder::<Rgb>::new(scene());
        lights.add(desc).map_err(|error| error.to_string())?;
        let extents = lights.build().extents();
        let (LightExtent::Bounded(bounds) | LightExtent::Lobe(bounds, _)) = extents[0] else {
            panic!("a light at a point");
        };
        assert_eq!(bounds.validate(), Ok(()), "{bounds:?}");
        Ok::<(), String>(())
    };
    let web = Image::from_f32([1, 1], Channels::Gray, [1.0]).expect("an image");
    for (intensity, is_valid) in [(2e37, true), (3e37, false), (3e38, false)] {
        let amount = IntensityAmount::Radiometric(intensity);
        let at = Affine3A::IDENTITY;
        let descs: [LightDesc<Rgb>; 3] = [
            PointLightDesc::new(Vec3::ZERO, Vec3::ONE, amount).into(),
            SpotLightDesc::new(at, 1e-3, Vec3::ONE, amount).into(),
            GoniometricLightDesc::new(at, web.clone(), Vec3::ONE, amount).into(),
        ];
        for desc in descs {
            let refused = build(desc.clone()).err();
            assert_eq!(refused.is_none(), is_valid, "{desc:?}: {refused:?}");
            assert!(refused.is_none_or(|e| e.contains("amount: too large")));
        }
    }
}

#[test]
fn no_ray_leaves_along_a_portal() {
    let texels = Image::from_f32([1, 1], Channels::Gray, [1.0]).expect("an image");
    let light = PortalInfiniteLight::<Rgb>::new(
        PortalInfiniteLightDesc {
            transform: Affine3A::IDENTITY,
            map: EnvironmentMap::EqualArea(texels),
            amount: RadianceAmount::Radiometric(1.0),
            portal: [Vec3::ZERO, Vec3::Y, Vec3::Y + Vec3::X, Vec3::X],
        },
        scene(),
    );
    let light = light.expect("a portal");
    let ends = [0.0, 0.25, light_math::float::ONE_MINUS_EPSILON];
    for (x, y) in ends.into_iter().flat_map(|x| ends.map(|y| (x, y))) {
        let Some(sample) = light.sample_le(Vec2::new(x, y), Vec2::splat(0.5), &()) else {
            continue;
        };
        let asked = light.pdf_le(&sample.ray);
        let LePdf { pos, .. } = sample.pdf;
        assert!(
            pos < 1e6 && (asked.pos - pos).abs() <= 1e-3 * pos,
            "{sample:?}, queried {asked:?} at {x}, {y}"
        );
    }
}

#[test]
fn rays_leave_a_tiny_sphere_with_finite_densities() {
    for radius in [1e-20, 1e-19, 1e-10, 1.0] {
        let shape = ShapeDesc::Sphere {
            transform: Affine3A::IDENTITY,
            radius,
        };
        let shape = shape.build().expect("a sphere");
        let desc = DiffuseEmissionDesc::<Rgb>::new(
            SurfaceColor::Uniform(Vec3::ONE),
            RadianceAmount::Radiometric(1.0),
        );
        let emission = DiffuseEmission::new(desc, [&shape]).expect("an emission");
        let light = DiffuseAreaLight::new(&shape, &emission);
        let sample = light.sample_le(Vec2::splat(0.5), Vec2::splat(0.3), &());
        let is_finite = sample.is_none_or(|s| s.pdf.pos.is_finite() && s.pdf.dir.is_finite());
        assert!(is_finite, "radius {radius}: {sample:?}");
        assert!(sample.is_some() || radius < 1e-18, "radius {radius}: none");
    }
}

#[test]
fn a_power_that_no_float_holds_is_infinite_and_refused_by_samplers() {
    for (side, is_held) in [(1.0, true), (1e3, false)] {
        let shape = ShapeDesc::Rectangle {
            corner: Vec3::ZERO,
            edges: [Vec3::X * side, Vec3::Y * side],
        };
        let shape = shape.build().expect("a rectangle");
        let desc = DiffuseEmissionDesc::<Rgb>::new(
            SurfaceColor::Uniform(Vec3::ONE),
            RadianceAmount::Radiometric(1e37),
        );
        let emission = DiffuseEmission::new(desc, [&shape]).expect("an emission");
        let light = DiffuseAreaLight::new(&shape, &emission);
        assert_eq!(light.phi(&()).is_finite(), is_held, "side {side}");
        let LightExtent::Bounded(bounds) = light.extent() else {
            panic!("a rectangle has bounds");
        };
        assert_eq!(bounds.validate().is_ok(), is_held, "{bounds:?}");
    }
}

#[test]
fn a_tiny_bright_surface_has_a_finite_strength() {
    let edges = [Vec3::X, Vec3::Y].map(|edge| edge * 1e-18);
    let shape = Rectangle::new(Vec3::ZERO, edges).expect("an area");
    let amount = RadianceAmount::Radiometric(2e38);
    let desc = DiffuseEmissionDesc::<Rgb>::new(SurfaceColor::Uniform(Vec3::ONE), amount);
    let emission = DiffuseEmission::new(desc, [&shape]).expect("an emission");
    let strength = emission.strength(&shape);
    assert!((strength / 6.283_185e2 - 1.0).abs() < 1e-5, "{strength}");
}

fn refusal(desc: impl Into<LightDesc<Rgb>>) -> String {
    let error = LightSetBuilder::new(scene()).add(desc).err();
    error.map_or("accepted".to_owned(), |error| error.to_string())
}

#[test]
fn a_set_refuses_surfaces_whose_power_no_float_holds() {
    let lamp = |length, radiance| {
        let shape = ShapeDesc::Cylinder {
            transform: Affine3A::IDENTITY,
            radius: 5e4,
            length,
        };
        let amount = RadianceAmount::Radiometric(radiance);
        let red = SurfaceColor::Uniform(Vec3::X);
        AreaLightDesc::new(shape, DiffuseEmissionDesc::<Rgb>::new(red, amount))
    };
    let message = "area light, amount: too large, the power of the light is not finite";
    assert_eq!(refusal(lamp(1e30, 1.0)), "accepted", "long");
    assert_eq!(refusal(lamp(1e30, 1e3)), message, "long and bright");
    // Black channels of it had the power 0 times infinity.
    assert_eq!(refusal(lamp(8e32, 1e-9)), message, "longer");
    let mesh = |size, radiance| {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y].map(|p| p * size);
        let amount = RadianceAmount::Radiometric(radiance);
        let white = SurfaceColor::Uniform(Vec3::ONE);
        let emission = DiffuseEmissionDesc::<Rgb>::new(white, amount);
        MeshLightDesc::new(corners, [[0, 1, 2]], emission)
    };
    assert_eq!(refusal(mesh(1e15, 1e7)), "accepted", "a mesh");
    assert_eq!(refusal(mesh(1e15, 1e9)), message.replace("area", "mesh"));
}

#[test]
fn a_spot_has_a_density() {
    let spot = |angle| {
        let amount = IntensityAmount::Radiometric(1.0);
        SpotLightDesc::new(Affine3A::IDENTITY, angle, Vec3::ONE, amount)
    };
    for angle in [1e-22, 1e-20, 4e-20] {
        let said = refusal(spot(angle));
        assert!(said.starts_with("spot light, angle: "), "{angle}: {said}");
    }
    for angle in [5e-20, 1e-18, 1e-9] {
        let light = SpotLight::<Rgb>::new(spot(angle)).expect("a spot");
        let ray = light.sample_le(Vec2::splat(0.3), Vec2::splat(0.6), &());
        let ray = ray.expect("a ray");
        let queried = light.pdf_le(&ray.ray).dir;
        assert!(ray.pdf.dir.is_finite() && queried.is_finite(), "{ray:?}");
    }
}
