//! Values that are known without an integral: what lights say of themselves, and the edges of their
//! samples.

use light_sources::glam::{Affine3A, Quat, Vec2, Vec3};
use light_sources::light_bounds::{InfiniteBounds, LightId};
use light_sources::shape::{Cylinder, Shape, ShapeDesc};
use light_sources::*;

fn scene() -> SceneSphere {
    SceneSphere::new(Vec3::ZERO, 3.0).expect("a sphere")
}

fn set(descs: impl IntoIterator<Item = LightDesc<Rgb>>) -> LightSet<Rgb> {
    let mut builder = LightSetBuilder::new(scene());
    for desc in descs {
        builder.add(desc).expect("a light");
    }
    builder.build()
}

fn gray(size: [u32; 2], texel: impl Fn(u32) -> f32) -> Image {
    let texels: Vec<f32> = (0..size[0] * size[1]).map(texel).collect();
    Image::from_f32(size, Channels::Gray, texels).expect("an image")
}

fn at_infinity(light: &impl Light<Rgb>) -> InfiniteBounds {
    *light.extent().infinite().expect("at infinity")
}

#[test]
fn a_point_beyond_the_scene_is_a_diameter_away() {
    let p = Vec3::new(1.0, 0.0, 0.0);
    let beyond = scene().beyond(p, Vec3::NEG_X);
    assert_eq!(beyond, Vec3::new(-5.0, 0.0, 0.0), "6 away");
}

/// A cap of 0.5 around its middle: 2 pi (1 - cos 0.5) sr.
#[test]
fn a_sun_gives_its_radiance_times_its_solid_angle() {
    let desc = SunLightDesc {
        direction: Vec3::Y,
        angular_diameter: 1.0,
        emission: Vec3::ONE,
        amount: SunAmount::Radiance(RadianceAmount::Radiometric(3.0)),
    };
    let sun = SunLight::<Rgb>::new(desc, scene()).expect("a sun");
    let bounds = at_infinity(&sun);
    let cos = 0.5f32.cos();
    let fluence = 3.0 * core::f32::consts::TAU * (1.0 - cos);
    assert!((bounds.fluence / fluence - 1.0).abs() < 1e-5, "{bounds:?}");
    let mean = Vec3::Y * (0.5 * (1.0 + cos));
    assert!(bounds.mean.distance(mean) < 1e-6, "{bounds:?}");
}

/// Each quarter of an equal-area square shows a slice of all directions from pole to pole.
#[test]
fn a_bright_quarter_of_the_sky_is_on_its_side() {
    for (bright, toward) in [
        (0, Vec3::new(-1.0, -1.0, 0.0)),
        (1, Vec3::new(1.0, -1.0, 0.0)),
        (2, Vec3::new(-1.0, 1.0, 0.0)),
        (3, Vec3::new(1.0, 1.0, 0.0)),
    ] {
        let image = gray([2, 2], |i| f32::from(u8::from(i == bright)));
        let desc = ImageInfiniteLightDesc {
            transform: Affine3A::IDENTITY,
            map: EnvironmentMap::EqualArea(image),
            amount: RadianceAmount::Radiometric(1.0),
        };
        let sky = ImageInfiniteLight::<Rgb>::new(desc, scene()).expect("a sky");
        let bounds = at_infinity(&sky);
        let angle = bounds.mean.angle_between(toward);
        assert!(angle < 1e-3, "{bright}: {bounds:?}");
        let pi = core::f32::consts::PI;
        assert!(
            (bounds.fluence / pi - 1.0).abs() < 1e-5,
            "{bright}: {bounds:?}"
        );
    }
}

#[test]
fn rays_meet_the_wall_of_a_cylinder_or_pass_it() {
    let transform = RigidTransform::new(Affine3A::IDENTITY).expect("rigid");
    let cylinder = Cylinder::new(transform, 0.5, 1.0).expect("a cylinder");
    for (origin, wall) in [
        (Vec3::new(2.0, 0.0, 0.25), Some(Vec3::new(0.5, 0.0, 0.25))),
        (Vec3::new(0.0, 0.0, 0.25), Some(Vec3::new(-0.5, 0.0, 0.25))),
        (Vec3::new(-2.0, 0.0, 0.25), None),
        (Vec3::new(2.0, 0.6, 0.25), None),
        (Vec3::new(2.0, 0.0, 0.75), None),
    ] {
        let hit = cylinder.hit(origin, Vec3::NEG_X).map(|at| at.p);
        assert_eq!(hit.is_some(), wall.is_some(), "from {origin}: {hit:?}");
        let distance = hit.zip(wall).map_or(0.0, |(hit, wall)| hit.distance(wall));
        assert!(distance < 1e-6, "from {origin}: {hit:?}");
    }
}

/// A ray that rounding lays along the surface has no density, though a surface that emits on both
/// sides emits there as well.
#[test]
fn no_ray_leaves_along_a_surface() {
    let color = SurfaceColor::Uniform(Vec3::ONE);
    let emission = DiffuseEmissionDesc {
        sides: Sides::Both,
        ..DiffuseEmissionDesc::<Rgb>::new(color, RadianceAmount::Radiometric(1.0))
    };
    let mut left_out = 0;
    for i in 0..64u8 {
        let turn = Quat::from_rotation_x(f32::from(i)) * Quat::from_rotation_y(0.7);
        let shape = ShapeDesc::Rectangle {
            corner: Vec3::ZERO,
            edges: [turn * Vec3::X, turn * Vec3::Y],
        };
        let emission = emission.clone();
        let set = set([LightDesc::Area(AreaLightDesc { shape, emission })]);
        let (_, light) = set.iter().next().expect("one");
        for k in 0..64u8 {
            let rim = Vec2::new(0.0, f32::from(k) / 64.0);
            match light.sample_le(Vec2::splat(0.5), rim, &()) {
                Some(sample) => assert!(sample.pdf.dir > 0.0, "{i}, {k}: {sample:?}"),
                None => left_out += 1,
            }
        }
    }
    assert!(left_out > 0, "some are along the surface");
}

/// The outer rings of a disk are longer: a picture that brightens outward shows 2/3, not 1/2,
/// however fine it is.
#[test]
fn a_fine_picture_on_a_disk_counts_by_area() {
    const N: u32 = 2048;
    let image = gray([N, N], |i| ((i / N) as f32 + 0.5) / N as f32);
    let color = SurfaceColor::<Rgb>::Image {
        texture: image.into(),
        tint: Vec3::ONE,
    };
    let emission = DiffuseEmissionDesc::new(color, RadianceAmount::Radiometric(1.0));
    let shape = ShapeDesc::Disk {
        transform: Affine3A::IDENTITY,
        radius: 1.0,
        inner_radius: 0.0,
    };
    let set = set([LightDesc::Area(AreaLightDesc { shape, emission })]);
    let (_, light) = set.iter().next().expect("one");
    let pi = core::f32::consts::PI;
    let mean = light.phi(&()).x / (pi * pi);
    // The last row blends with the first, as of a picture that is repeated.
    assert!((1.5 * mean - 1.0).abs() < 1e-3, "{mean}");
}

/// Lights of one image hold it once, and each a table of its own.
#[test]
fn each_light_of_an_image_adds_its_table() {
    let image = gray([8, 8], |i| 1.0 + i as f32);
    let image = || image.clone();
    let goniometric = || {
        let amount = IntensityAmount::Radiometric(1.0);
        GoniometricLightDesc::new(Affine3A::IDENTITY, image(), Vec3::ONE, amount).into()
    };
    let projection = || {
        let amount = IntensityAmount::Radiometric(1.0);
        ProjectionLightDesc::new(Affine3A::IDENTITY, image(), 1.0, amount).into()
    };
    let sky = || {
        LightDesc::ImageInfinite(ImageInfiniteLightDesc {
            transform: Affine3A::IDENTITY,
            map: EnvironmentMap::EqualArea(image()),
            amount: RadianceAmount::Radiometric(1.0),
        })
    };
    let lat_long = || {
        LightDesc::ImageInfinite(ImageInfiniteLightDesc {
            transform: Affine3A::IDENTITY,
            map: EnvironmentMap::LatLong(image()),
            amount: RadianceAmount::Radiometric(1.0),
        })
    };
    let kinds: [(&str, &dyn Fn() -> LightDesc<Rgb>); 4] = [
        ("goniometric", &goniometric),
        ("projection", &projection),
        ("sky", &sky),
        ("lat-long sky", &lat_long),
    ];
    for (name, desc) in kinds {
        let bytes = |n| set((0..n).map(|_| desc())).bytes().images;
        let [none, one, two, three] = [0, 1, 2, 3].map(bytes);
        assert_eq!(none, 0, "{name}: no light");
        let (table, next) = (two - one, three - two);
        assert!(table > 0 && table == next, "{name}: {one}, {two}, {three}");
        let texels = 8 * 8 * size_of::<f32>();
        let image = one - table;
        assert!((texels..2 * texels).contains(&image), "{name}: {image}");
    }
}

/// Samplers compare strengths: a colour counts as much from an image as without one.
#[test]
fn an_image_of_one_color_is_as_strong_as_the_color() {
    let red = Vec3::new(2.0, 0.25, 0.0);
    let texels = red.to_array().repeat(64 * 64);
    let image = Image::from_f32([64, 64], Channels::Rgb, texels).expect("an image");
    let texture = Texture::new(image.clone());
    let tint = Vec3::ONE;
    let lamp = |color| {
        let emission = DiffuseEmissionDesc::new(color, RadianceAmount::default());
        AreaLightDesc::new(ShapeDesc::sphere(Vec3::ZERO, 1.0), emission).into()
    };
    let color = SurfaceColor::Image { texture, tint };
    let lamps = set([lamp(SurfaceColor::Uniform(red)), lamp(color)]);
    let [uniform, image_lamp] = [0, 1].map(|i| {
        let light = lamps.get(LightId(i)).expect("a lamp");
        light.bounds().expect("bounds").phi
    });
    assert!((image_lamp / uniform - 1.0).abs() < 1e-6, "{image_lamp}");

    let amount = RadianceAmount::default();
    let map = || EnvironmentMap::EqualArea(image.clone());
    let window = [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y];
    let skies = [
        UniformInfiniteLightDesc::new(red, amount).into(),
        ImageInfiniteLightDesc::new(map()).into(),
        ImageInfiniteLightDesc::new(EnvironmentMap::LatLong(image.clone())).into(),
        PortalInfiniteLightDesc::new(map(), window).into(),
    ];
    let skies = set(skies);
    let strength = |i| at_infinity(&skies.get(LightId(i)).expect("a sky")).fluence;
    for (i, part) in [(1, 1.0), (2, 1.0), (3, 0.5)] {
        let found = strength(i) / strength(0) / part;
        assert!((found - 1.0).abs() < 0.02, "sky {i}: {found}");
    }
}
