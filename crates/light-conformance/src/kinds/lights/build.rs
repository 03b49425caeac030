//! From a line of the vectors to the light that it describes.

use crate::{Case, Malformed};
use lights::math::glam::{Affine3A, Mat3, Vec3};
use lights::sources::shape::ShapeDesc;
use lights::sources::{
    AreaLightDesc, Channels, DiffuseEmissionDesc, DistantLightDesc, EnvironmentMap,
    GoniometricLightDesc, Image, ImageInfiniteLightDesc, IntensityAmount, IrradianceAmount,
    LightDesc, LightSet, LightSetBuilder, MediumInterface, PointLightDesc, PortalInfiniteLightDesc,
    ProjectionLightDesc, RadianceAmount, Rgb, SceneSphere, Sides, SpotLightDesc, SurfaceColor,
    UniformInfiniteLightDesc,
};

/// The light of a line, alone in its set.
pub(super) fn light_set(case: &Case<'_>) -> Result<LightSet<Rgb>, Malformed> {
    let mut builder = LightSetBuilder::new(scene(case)?);
    let desc = desc(case)?;
    builder.add(desc).map_err(|e| Malformed(e.to_string()))?;
    Ok(builder.build())
}

/// The scene's sphere; any, for lights that do not need it.
pub(super) fn scene(case: &Case<'_>) -> Result<SceneSphere, Malformed> {
    let (center, radius) = match case.find("scene_center") {
        Some(center) => (center.vec3()?, case.get("scene_radius")?.float()?),
        None => (Vec3::ZERO, 1.0),
    };
    SceneSphere::new(center, radius).map_err(|e| Malformed(e.to_string()))
}

fn desc(case: &Case<'_>) -> Result<LightDesc<Rgb>, Malformed> {
    let scale = case.get("scale")?.float()?;
    let intensity = IntensityAmount::Radiometric(scale);
    let radiance = RadianceAmount::Radiometric(scale);
    let transform = || transform(case.get("render_from_light")?);
    let degrees = |name| Ok(case.get(name)?.float()?.to_radians());
    let emission = Vec3::ONE;
    let media = MediumInterface::default();
    Ok(match case.get("type")?.text().unwrap_or_default() {
        "point" => LightDesc::Point(PointLightDesc {
            position: transform()?.translation.into(),
            emission,
            amount: intensity,
            media,
        }),
        "spot" => LightDesc::Spot(SpotLightDesc {
            transform: transform()?,
            angle: degrees("total_width_deg")?,
            falloff_start: degrees("falloff_start_deg")?,
            emission,
            amount: intensity,
            media,
        }),
        "projection" => LightDesc::Projection(ProjectionLightDesc {
            transform: transform()?,
            image: image(case)?,
            fov: degrees("fov_deg")?,
            amount: intensity,
            media,
        }),
        "goniometric" => LightDesc::Goniometric(GoniometricLightDesc {
            transform: transform()?,
            distribution: image(case)?,
            emission,
            amount: intensity,
            media,
        }),
        "distant" => LightDesc::Distant(DistantLightDesc {
            direction: transform()?.transform_vector3(Vec3::Z),
            emission,
            amount: IrradianceAmount::Radiometric(scale),
        }),
        "uniform_infinite" => LightDesc::UniformInfinite(UniformInfiniteLightDesc {
            emission,
            amount: radiance,
        }),
        "image_infinite" => LightDesc::ImageInfinite(ImageInfiniteLightDesc {
            transform: transform()?,
            map: EnvironmentMap::EqualArea(image(case)?),
            amount: radiance,
        }),
        "portal_infinite" => LightDesc::PortalInfinite(PortalInfiniteLightDesc {
            transform: transform()?,
            map: EnvironmentMap::EqualArea(image(case)?),
            amount: radiance,
            portal: corners(case.get("portal")?)?,
        }),
        _ => LightDesc::Area(AreaLightDesc {
            shape: shape(case)?,
            emission: DiffuseEmissionDesc {
                sides: sides(case)?,
                ..DiffuseEmissionDesc::new(SurfaceColor::Uniform(emission), radiance)
            },
        }),
    })
}

fn shape(case: &Case<'_>) -> Result<ShapeDesc, Malformed> {
    let transform = || transform(case.get("render_from_object")?);
    let float = |name| case.get(name)?.float();
    let corner = |name| case.get(name)?.vec3();
    Ok(match case.get("type")?.text().unwrap_or_default() {
        "area_triangle" => ShapeDesc::Triangle(corners(case.get("v")?)?),
        "area_patch" => ShapeDesc::Quad([
            corner("p00")?,
            corner("p10")?,
            corner("p01")?,
            corner("p11")?,
        ]),
        "area_sphere" => ShapeDesc::Sphere {
            transform: transform()?,
            radius: float("radius")?,
        },
        "area_disk" => ShapeDesc::Disk {
            transform: transform()? * Affine3A::from_translation(Vec3::Z * float("height")?),
            radius: float("radius")?,
            inner_radius: float("inner_radius")?,
        },
        other => return Err(Malformed(format!("unknown light type {other}"))),
    })
}

/// The reference turns normals over where we name the side.
pub(super) fn sides(case: &Case<'_>) -> Result<Sides, Malformed> {
    Ok(match case.get("two_sided")?.flag()? {
        true => Sides::Both,
        false if is_reversed(case)? => Sides::Back,
        false => Sides::Front,
    })
}

/// Whether the reference's normals are the opposite of ours.
pub(super) fn is_reversed(case: &Case<'_>) -> Result<bool, Malformed> {
    let flag = case.find("reverse_orientation").map(|flag| flag.flag());
    flag.unwrap_or(Ok(false))
}

fn transform(matrix: Case<'_>) -> Result<Affine3A, Malformed> {
    let m = matrix.float_array::<16>()?;
    let column = |i| Vec3::new(m[i], m[4 + i], m[8 + i]);
    let linear = Mat3::from_cols(column(0), column(1), column(2));
    Ok(Affine3A::from_mat3_translation(linear, column(3)))
}

fn image(case: &Case<'_>) -> Result<Image, Malformed> {
    let image = case.get("image")?;
    let side = |name| {
        let side = image.get(name)?.index()?;
        u32::try_from(side).map_err(|e| Malformed(e.to_string()))
    };
    let channels = match image.get("channels")?.index()? {
        1 => Channels::Gray,
        _ => Channels::Rgb,
    };
    let texels = image.get("texels")?.floats()?;
    let image = Image::from_f32([side("nx")?, side("ny")?], channels, texels);
    image.map_err(|e| Malformed(e.to_string()))
}

fn corners<const N: usize>(points: Case<'_>) -> Result<[Vec3; N], Malformed> {
    let points: Result<Vec<_>, _> = points.items()?.map(|p| p.vec3()).collect();
    let points = <[Vec3; N]>::try_from(points?);
    points.map_err(|_| Malformed(format!("{N} points expected")))
}
