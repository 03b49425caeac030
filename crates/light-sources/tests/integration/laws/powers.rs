//! Powers are integrals, to one part in ten thousand, however coarse the pictures are and however
//! they lie.

use light_sources::glam::{Affine2, Affine3A, Quat, Vec2, Vec3};
use light_sources::shape::{AnyShape, Rectangle, ShapeDesc};
use light_sources::*;
use light_testkit::Rng;
use light_testkit::laws::light::*;

use crate::laws::scene;

#[test]
fn textured_triangles() {
    let mut rng = Rng::new(71);
    for round in 0..24 {
        let mut corner = || (rng.vec2() - 0.3) * 1.6;
        let uvs = [corner(), corner(), corner()];
        let emission = emission(&mut rng, round);
        mesh(&format!("{round}: {uvs:?}"), uvs, emission);
    }
}

/// Whatever has no area in the image shows a line or a point of it.
#[test]
fn triangles_without_an_area_in_the_image() {
    let mut rng = Rng::new(72);
    let (a, b) = (Vec2::new(0.2, 0.1), Vec2::new(0.7, 1.4));
    let uvs = [
        [a; 3],
        [Vec2::ZERO; 3],
        [a, b, a.lerp(b, 0.4)],
        [Vec2::ZERO, Vec2::X, Vec2::new(0.5, 0.0)],
        [Vec2::Y, Vec2::ZERO, Vec2::ZERO],
    ];
    for (round, uvs) in (0..).zip(uvs) {
        for _ in 0..2 {
            let emission = emission(&mut rng, round);
            mesh(&format!("{uvs:?}"), uvs, emission);
        }
    }
}

#[test]
fn textured_shapes() {
    let mut rng = Rng::new(73);
    let shapes = [
        ShapeDesc::Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]),
        ShapeDesc::Rectangle {
            corner: Vec3::ZERO,
            edges: [Vec3::X, Vec3::Y * 2.0],
        },
        ShapeDesc::Quad([Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.6, 1.2, 0.0)]),
        ShapeDesc::Quad([Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(0.9, 1.4, 0.8)]),
        ShapeDesc::Sphere {
            transform: tilted(),
            radius: 0.7,
        },
        ShapeDesc::Disk {
            transform: tilted(),
            radius: 0.8,
            inner_radius: 0.0,
        },
        ShapeDesc::Disk {
            transform: tilted(),
            radius: 0.8,
            inner_radius: 0.5,
        },
        ShapeDesc::Cylinder {
            transform: tilted(),
            radius: 0.4,
            length: 1.4,
        },
    ];
    for shape in shapes {
        for round in 0..3 {
            let emission = emission(&mut rng, round);
            let name = format!("{shape:?}, {}", what(&emission));
            check(&name, LightDesc::Area(AreaLightDesc { shape, emission }));
        }
    }
}

/// A mask of which no texel lies in the centre of a texel of the image.
#[test]
fn masks_finer_than_their_image() {
    for (n, bright) in [
        (1, [3, 5]),
        (2, [0, 15]),
        (4, [7, 7]),
        (16, [9, 2]),
        (50, [0, 0]),
    ] {
        let white = Image::from_f32([n, n], Channels::Gray, vec![1.0; (n * n) as usize]);
        let mut mask = vec![0.0; 256];
        mask[16 * bright[1] + bright[0]] = 1.0;
        let mask = Image::from_f32([16, 16], Channels::Gray, mask).expect("a mask");
        let color = SurfaceColor::<Rgb>::Image {
            texture: white.expect("an image").into(),
            tint: Vec3::ONE,
        };
        let emission = DiffuseEmission::new(
            DiffuseEmissionDesc {
                mask: EmissionMask::Alpha(mask.into()),
                ..DiffuseEmissionDesc::new(color, RadianceAmount::Radiometric(2560.0))
            },
            [] as [AnyShape; 0],
        );
        let emission = emission.expect("an emission");
        let square = Rectangle::new(Vec3::ZERO, [Vec3::X, Vec3::Y]).expect("a square");
        let light = DiffuseAreaLight::new(square, &emission);
        let power = light.phi(&()).x / (10.0 * core::f32::consts::PI);
        assert!((power - 1.0).abs() < 1e-5, "{n}, {bright:?}: {power}");
        let bounds = light.bounds().expect("somewhere");
        assert_eq!(bounds.phi, light.phi(&()).x, "what samplers compare");
    }
}

#[test]
fn projections() {
    let mut rng = Rng::new(74);
    for (size, fov) in [
        ([1, 1], 1.2),
        ([4, 4], 2.6),
        ([2, 5], 0.4),
        ([7, 3], 2.0),
        ([64, 48], 1.5),
    ] {
        let image = image(&mut rng, size, Channels::Rgb, 1.0);
        let desc = ProjectionLightDesc {
            transform: tilted(),
            image,
            fov,
            amount: IntensityAmount::Radiometric(3.0),
            media: MediumInterface::default(),
        };
        check(&format!("{size:?}, {fov}"), LightDesc::Projection(desc));
    }
}

#[test]
fn goniometric_distributions() {
    let mut rng = Rng::new(75);
    for n in [1, 2, 5, 33] {
        let desc = GoniometricLightDesc {
            transform: tilted(),
            distribution: image(&mut rng, [n, n], Channels::Gray, 1.0),
            emission: Vec3::new(0.3, 1.0, 2.0),
            amount: IntensityAmount::Radiometric(3.0),
            media: MediumInterface::default(),
        };
        check(&format!("{n}"), LightDesc::Goniometric(desc));
    }
}

#[test]
fn skies() {
    let mut rng = Rng::new(76);
    for n in [1, 3, 16] {
        let square = EnvironmentMap::EqualArea(image(&mut rng, [n, n], Channels::Rgb, 1.0));
        let panorama = EnvironmentMap::LatLong(image(&mut rng, [2 * n, n], Channels::Rgb, 1.0));
        for map in [square, panorama] {
            let amount = RadianceAmount::Radiometric(2.0);
            let transform = tilted();
            let desc = ImageInfiniteLightDesc {
                map: map.clone(),
                transform,
                amount,
            };
            check(&format!("sky of {n}"), LightDesc::ImageInfinite(desc));
            let desc = PortalInfiniteLightDesc {
                map,
                transform,
                amount,
                portal: [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y],
            };
            check(&format!("portal of {n}"), LightDesc::PortalInfinite(desc));
        }
    }
}

/// An image, a mask, or both, at resolutions that have nothing to do with each other.
fn emission(rng: &mut Rng, round: u32) -> DiffuseEmissionDesc<Rgb> {
    let wraps = [Wrap::Clamp, Wrap::Repeat, Wrap::Mirror, Wrap::Black];
    let mut below = |n: u32| rng.below(n as usize) as u32;
    let wrap = [0, 1].map(|_| wraps[below(4) as usize]);
    let sizes = [[1 + below(6), 1 + below(6)], [1 + below(20), 1 + below(20)]];
    let color = if round % 3 == 1 {
        SurfaceColor::Uniform(Vec3::new(1.0, 0.5, 0.25))
    } else {
        SurfaceColor::Image {
            texture: image(rng, sizes[0], Channels::Rgb, 2.0).into(),
            tint: Vec3::new(1.0, 0.5, 0.25),
        }
    };
    let mask = if round % 3 == 2 {
        EmissionMask::Opaque
    } else {
        EmissionMask::Alpha(image(rng, sizes[1], Channels::Gray, 1.0).into())
    };
    let scale = Vec2::new(rng.range(0.5, 1.5), -rng.range(0.5, 1.5));
    let turn = rng.range(0.0, 6.0);
    let offset = (rng.vec2() - 0.5) * 0.6;
    DiffuseEmissionDesc {
        mask,
        mapping: TextureMapping {
            transform: Affine2::from_scale_angle_translation(scale, turn, offset),
            wrap,
        },
        ..DiffuseEmissionDesc::new(color, RadianceAmount::Radiometric(0.5))
    }
}

/// Few bright texels among black ones.
fn image(rng: &mut Rng, size: [u32; 2], channels: Channels, brightest: f32) -> Image {
    let count = channels.count() * size[0] as usize * size[1] as usize;
    let texel = |_| (2.0 * rng.range(0.0, brightest) - brightest).max(0.0);
    let mut texels: Vec<f32> = (0..count).map(texel).collect();
    texels[0] = brightest;
    Image::from_f32(size, channels, texels).expect("an image")
}

/// The parts of an emission that a failure prints.
fn what(emission: &DiffuseEmissionDesc<Rgb>) -> String {
    let color = match &emission.color {
        SurfaceColor::Image { texture, .. } => Some(texture.image().size()),
        SurfaceColor::Uniform(_) => None,
    };
    let mask = match &emission.mask {
        EmissionMask::Alpha(mask) => Some((
            mask.texture.image().size(),
            mask.scale,
            mask.cutoff,
            mask.mapping,
        )),
        _ => None,
    };
    format!("image {color:?}, mask {mask:?}, {:?}", emission.mapping)
}

fn mesh(name: &str, uvs: [Vec2; 3], emission: DiffuseEmissionDesc<Rgb>) {
    let name = format!("{name}, {}", what(&emission));
    let desc = MeshLightDesc {
        positions: [Vec3::ZERO, Vec3::X, Vec3::Y].into(),
        indices: [[0, 1, 2]].into(),
        uvs: Some(uvs.into()),
        emission,
    };
    check(&name, LightDesc::Mesh(desc));
}

fn check(name: &str, desc: LightDesc<Rgb>) {
    let mut builder = LightSetBuilder::new(scene());
    builder.add(desc).expect("a light");
    let set = builder.build();
    let (_, light) = set.iter().next().expect("one");
    let case = LightCase::<Rgb, _>::around(name, &light, Vec3::ZERO, 1.0, 1);
    phi_is_exact(&case);
}

fn tilted() -> Affine3A {
    Affine3A::from_quat(Quat::from_rotation_x(0.7) * Quat::from_rotation_y(-1.9))
}
