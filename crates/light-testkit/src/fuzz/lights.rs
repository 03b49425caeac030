use alloc::sync::Arc;
use core::f32::consts::PI;

use light_math::glam::{Affine2, Affine3A, Quat, Vec2, Vec3};
use light_sources::shape::ShapeDesc;
use light_sources::{
    AlphaMask, AreaLightDesc, Channels, DiffuseEmissionDesc, DistantLightDesc, EmissionMask,
    GoniometricLightDesc, ImageInfiniteLightDesc, LightDesc, MediumInterface, MeshIndices,
    MeshLightDesc, PointLightDesc, PortalInfiniteLightDesc, ProjectionLightDesc, Rgb, SceneSphere,
    Sides, SpotLightDesc, SunAmount, SunLightDesc, SurfaceColor, Texture, TextureMapping,
    UniformInfiniteLightDesc, Wrap,
};

use super::amounts::{BRIGHTEST, intensity, irradiance, radiance, surface_amount};
use super::images::{environment, image, square};
use super::input::Input;

/// The largest coordinate and size of a described light.
const LARGEST: f32 = 1e6;

/// Any description of a light, valid or not.
pub(super) fn light(input: &mut Input<'_>) -> LightDesc<Rgb> {
    let media = MediumInterface::default();
    match input.byte() % 11 {
        0 => LightDesc::Point(PointLightDesc {
            position: place(input),
            emission: color(input),
            amount: intensity(input),
            media,
        }),
        1 => {
            let angle = input.unit() * PI;
            LightDesc::Spot(SpotLightDesc {
                transform: transform(input),
                angle,
                falloff_start: match input.byte() % 4 {
                    0 => 0.0,
                    1 => angle,
                    2 => input.number(),
                    _ => input.unit() * angle,
                },
                emission: color(input),
                amount: intensity(input),
                media,
            })
        }
        2 => LightDesc::Projection(ProjectionLightDesc {
            transform: transform(input),
            image: image(input),
            fov: input.unit() * PI,
            amount: intensity(input),
            media,
        }),
        3 => LightDesc::Goniometric(GoniometricLightDesc {
            transform: transform(input),
            distribution: square(input, Channels::Gray),
            emission: color(input),
            amount: intensity(input),
            media,
        }),
        4 | 5 => LightDesc::Area(AreaLightDesc {
            shape: shape(input),
            emission: diffuse(input),
        }),
        6 => mesh(input),
        7 => LightDesc::Distant(DistantLightDesc {
            direction: input.place(),
            emission: color(input),
            amount: irradiance(input),
        }),
        8 => LightDesc::Sun(SunLightDesc {
            direction: input.axis(),
            angular_diameter: input.unit() * PI,
            emission: color(input),
            amount: if input.byte() % 2 == 0 {
                SunAmount::Radiance(radiance(input))
            } else {
                SunAmount::Irradiance(irradiance(input))
            },
        }),
        9 => match input.byte() % 3 {
            0 => LightDesc::UniformInfinite(UniformInfiniteLightDesc {
                emission: color(input),
                amount: radiance(input),
            }),
            _ => LightDesc::ImageInfinite(ImageInfiniteLightDesc {
                transform: transform(input),
                map: environment(input),
                amount: radiance(input),
            }),
        },
        _ => {
            let [a, b, size] = [input.axis(), input.axis(), Vec3::splat(length(input))];
            let (corner, b) = (place(input), a.cross(b).normalize_or(Vec3::X));
            let (x, y) = (a * size, b * length(input));
            LightDesc::PortalInfinite(PortalInfiniteLightDesc {
                transform: transform(input),
                map: environment(input),
                amount: radiance(input),
                portal: [corner, corner + y, corner + x + y, corner + x],
            })
        }
    }
}

/// The sphere around a scene.
pub(super) fn scene(input: &mut Input<'_>) -> SceneSphere {
    let center = place(input);
    let radius = length(input).max(1e-6);
    SceneSphere::new(center, radius).expect("a sphere of a finite radius above zero")
}

fn place(input: &mut Input<'_>) -> Vec3 {
    let largest = Vec3::splat(LARGEST);
    input.place().clamp(-largest, largest)
}

fn length(input: &mut Input<'_>) -> f32 {
    input.amount(LARGEST)
}

fn color(input: &mut Input<'_>) -> Vec3 {
    match input.byte() % 4 {
        0 => Vec3::new(input.unit(), input.unit(), input.unit()),
        1 => Vec3::new(input.number().min(BRIGHTEST), 1.0, 0.0),
        _ => Vec3::ONE,
    }
}

/// A rotation, sometimes with a reflection, and a translation.
fn transform(input: &mut Input<'_>) -> Affine3A {
    let kind = input.byte();
    let rotation = match kind % 4 {
        0 => Quat::IDENTITY,
        _ => Quat::from_rotation_arc(Vec3::Z, input.axis()),
    };
    let mirror = if kind & 4 == 0 {
        Vec3::ONE
    } else {
        Vec3::new(-1.0, 1.0, 1.0)
    };
    Affine3A::from_scale_rotation_translation(mirror, rotation, place(input))
}

fn shape(input: &mut Input<'_>) -> ShapeDesc {
    match input.byte() % 6 {
        0 => ShapeDesc::Triangle([place(input), place(input), place(input)]),
        1 => {
            let (a, b) = (input.axis(), input.axis());
            let b = a.cross(b).normalize_or(Vec3::X);
            ShapeDesc::Rectangle {
                corner: place(input),
                edges: [a * length(input), b * length(input)],
            }
        }
        2 => {
            let corner = place(input);
            let near = |input: &mut Input<'_>| corner + place(input);
            ShapeDesc::Quad([corner, near(input), near(input), near(input)])
        }
        3 => ShapeDesc::Sphere {
            transform: transform(input),
            radius: length(input),
        },
        4 => {
            let radius = length(input);
            ShapeDesc::Disk {
                transform: transform(input),
                radius,
                inner_radius: radius * input.unit() * f32::from(input.byte() & 1),
            }
        }
        _ => ShapeDesc::Cylinder {
            transform: transform(input),
            radius: length(input),
            length: length(input),
        },
    }
}

fn diffuse(input: &mut Input<'_>) -> DiffuseEmissionDesc<Rgb> {
    let kind = input.byte();
    let color = if kind & 1 == 0 {
        SurfaceColor::Uniform(color(input))
    } else {
        SurfaceColor::Image {
            texture: Texture::new(image(input)),
            tint: Vec3::ONE,
        }
    };
    let mapping = mapping(input, kind);
    DiffuseEmissionDesc {
        color,
        amount: surface_amount(input),
        sides: [Sides::Front, Sides::Back, Sides::Both][input.below(3)],
        mask: mask(input),
        mapping,
        media: MediumInterface::default(),
    }
}

/// How an image lies on a surface: the lowest bits of `kind` are not read.
fn mapping(input: &mut Input<'_>, kind: u8) -> TextureMapping {
    let wrap =
        |kind: u8| [Wrap::Clamp, Wrap::Repeat, Wrap::Mirror, Wrap::Black][usize::from(kind & 3)];
    let (scale, shift) = if kind & 8 == 0 {
        (Vec2::ONE, Vec2::ZERO)
    } else {
        let scale = Vec2::new(input.number(), input.number());
        (
            scale.clamp(Vec2::splat(-20.0), Vec2::splat(20.0)),
            Vec2::new(input.unit(), input.unit()),
        )
    };
    TextureMapping {
        transform: Affine2::from_scale_angle_translation(scale, 0.0, shift),
        wrap: [wrap(kind >> 4), wrap(kind >> 6)],
    }
}

/// Mostly none; an image of alpha, with or without a mapping of its own, a scale and a cutoff.
fn mask(input: &mut Input<'_>) -> EmissionMask {
    let kind = input.byte();
    match kind % 4 {
        0 => {
            let texture = square(input, Channels::Gray).into();
            let own = (kind & 16 != 0).then(|| input.byte());
            EmissionMask::Alpha(AlphaMask {
                texture,
                scale: if kind & 4 == 0 { 1.0 } else { input.number() },
                mapping: own.map(|kind| mapping(input, kind)),
                cutoff: (kind & 8 != 0).then(|| input.number()),
            })
        }
        1 => EmissionMask::Invisible,
        _ => EmissionMask::Opaque,
    }
}

/// A few triangles with shared corners.
fn mesh(input: &mut Input<'_>) -> LightDesc<Rgb> {
    let count = input.below(4) + 3;
    let positions: Arc<[Vec3]> = (0..count).map(|_| place(input)).collect();
    let triangles = input.below(3) + 1;
    let corner = |input: &mut Input<'_>| input.below(count) as u32;
    let indices: Vec<[u32; 3]> = (0..triangles)
        .map(|_| [corner(input), corner(input), corner(input)])
        .collect();
    let uvs = (input.byte() % 2 == 0).then(|| {
        (0..count)
            .map(|_| Vec2::new(input.unit(), input.unit()))
            .collect()
    });
    LightDesc::Mesh(MeshLightDesc {
        positions,
        indices: MeshIndices::List(indices.into()),
        uvs,
        emission: diffuse(input),
    })
}
