use light_math::glam::{DVec3, Vec3};
use light_sources::{
    Channels, DistantLightDesc, EnvironmentMap, Image, ImageInfiniteLightDesc, IrradianceAmount,
    Light, LightDesc, LightDescError, LightRef, LightSetBuilder, PortalInfiniteLightDesc,
    PortalInfiniteLightError, RadianceAmount, SceneSphere, SunAmount, SunLightDesc,
    UniformInfiniteLightDesc,
};

use super::arrival::arrival_holds;
use super::kind::Kind;
use super::model::Model;
use super::picture::random_image;
use super::placement::Placement;
use super::power::{Power, power_holds};
use super::rays::leaving_holds;
use super::receiver::Receiver;
use super::sky_amounts::amounts_hold;
use super::sky_checks::{bounds_hold, density_holds};
use super::sky_truth::{Map, Sky, SkyTruth, Texels, Window};
use super::surface::RigidFrame;
use crate::Rng;

/// Receivers of each light.
const RECEIVERS: u32 = 4;

/// A light at infinity over a scene anywhere, against its description.
pub(super) fn check<M: Model>(kind: Kind, rng: &mut Rng) -> Result<(), String> {
    let wavelengths = M::random_wavelengths(rng);
    let emission = M::random_emission(rng);
    let placement = Placement::random(rng);
    let center = placement.point(Vec3::ZERO);
    let radius = placement.unit * rng.range(1.0, 5.0);
    let scene = SceneSphere::new(center, radius).map_err(|e| e.to_string())?;
    let scale = rng.log_range(1e-3, 1e3);
    let amount = RadianceAmount::Radiometric(scale);
    let direction = rng.direction() * rng.log_range(1e-3, 1e3);
    let axis = direction.as_dvec3().normalize();
    let transform = placement.transform();
    let mut color = M::radiant(&emission).map(|c| c * f64::from(scale));
    let mut values = M::values_of(&emission, &wavelengths).map(|value| value * f64::from(scale));
    let white = |values: &mut _, color: &mut [f64; 2]| {
        let (white, radiant) = M::white(&wavelengths);
        *values = white.map(|value| value * f64::from(scale));
        *color = radiant.map(|value| value * f64::from(scale));
    };
    let window = random_window(rng, &placement);
    let (desc, sky): (LightDesc<M>, Option<Sky>) = match kind {
        Kind::Distant => {
            let amount = IrradianceAmount::Radiometric(scale);
            let desc = DistantLightDesc::new(direction, emission.clone(), amount);
            (desc.into(), Some(Sky::Distant(axis, values)))
        }
        Kind::Sun => {
            let angular_diameter = [rng.range(0.01, 3.1), rng.log_range(1e-4, 0.1)][rng.below(2)];
            let half = 0.5 * f64::from(angular_diameter);
            let mut amount = SunAmount::Radiance(amount);
            if rng.below(2) == 0 {
                amount = SunAmount::Irradiance(IrradianceAmount::Radiometric(scale));
                let inverse = 1.0 / (core::f64::consts::PI * half.sin().powi(2));
                values = values.map(|value| value * inverse);
                color = color.map(|value| value * inverse);
            }
            let desc = SunLightDesc {
                angular_diameter,
                ..SunLightDesc::new(direction, emission.clone(), amount)
            };
            (desc.into(), Some(Sky::Sun(axis, half, values)))
        }
        Kind::UniformInfinite => {
            let desc = UniformInfiniteLightDesc::new(emission.clone(), amount);
            (desc.into(), Some(Sky::Uniform(values)))
        }
        _ => {
            white(&mut values, &mut color);
            let channels = if M::is_linear() {
                Channels::Rgb
            } else {
                Channels::Gray
            };
            let n = 1 + rng.below(8) as u32;
            let (map, kind_of_map, image) = if rng.below(2) == 0 {
                let image = random_image(rng, [n, n], channels);
                (
                    EnvironmentMap::EqualArea(image.clone()),
                    Map::EqualArea,
                    image,
                )
            } else {
                let size = [1 + rng.below(8) as u32, n];
                let image = random_image(rng, size, channels);
                (EnvironmentMap::LatLong(image.clone()), Map::LatLong, image)
            };
            if kind == Kind::ImageInfinite {
                let texels = texels::<M>(&image, scale, &wavelengths);
                let desc = ImageInfiniteLightDesc {
                    transform,
                    map,
                    amount,
                };
                let frame = RigidFrame::new(transform);
                (desc.into(), Some(Sky::Image(frame, kind_of_map, texels)))
            } else {
                let desc = PortalInfiniteLightDesc {
                    transform,
                    map,
                    amount,
                    portal: window,
                };
                (desc.into(), None)
            }
        }
    };
    let described = format!("{scene:?}, {desc:?}");
    let mut builder = LightSetBuilder::<M>::new(scene);
    let source = match builder.add(desc.clone()) {
        // A window so small that rounding of its corners bends it is refused.
        Err(LightDescError::PortalInfinite(PortalInfiniteLightError::Portal)) => return Ok(()),
        result => result.map_err(|e| format!("{e}: {described}"))?,
    };
    let set = builder.build();
    let id = set.first_id(source).ok_or("no id")?;
    let light = set.get(id).ok_or("no light")?;
    let sky = match (sky, &light) {
        (Some(sky), _) => sky,
        (None, LightRef::PortalInfinite(portal)) => {
            let texels = texels::<M>(portal.rectified(), scale, &wavelengths);
            Sky::Portal(exact_window(window), texels)
        }
        (None, _) => return Err("not a portal".into()),
    };
    let mut coordinates = f64::from(radius);
    if kind == Kind::PortalInfinite {
        coordinates += window
            .map(|p| f64::from(p.length()))
            .into_iter()
            .fold(0.0, f64::max);
    }
    let truth = SkyTruth {
        sky,
        scene: (center.as_dvec3(), radius.into()),
        coordinates,
    };
    let power = Power {
        phi: M::values(light.phi(&wavelengths)),
        radiant: set.powers()[id.0 as usize].into(),
    };
    compare(&light, &wavelengths, &truth, rng)
        .and_then(|()| {
            power_holds(power, color, values, rng, |side, rng| {
                truth.leaving(side, rng)
            })
        })
        .and_then(|_| {
            let phi = M::values(light.phi(&wavelengths));
            amounts_hold::<M>(&desc, scene, phi, &wavelengths, rng)
        })
        .map_err(|fault| format!("{fault}\n  {described}"))
}

/// All but the power.
fn compare<M: Model>(
    light: &LightRef<'_, M>,
    wavelengths: &M::Wavelengths,
    truth: &SkyTruth,
    rng: &mut Rng,
) -> Result<(), String> {
    let (center, radius) = truth.scene;
    let size = center.length() + truth.coordinates;
    leaving_holds(light, wavelengths, size, center, rng, |side, rng| {
        truth.leaving(side, rng)
    })?;
    bounds_hold(light, wavelengths, truth, rng)?;
    for _ in 0..RECEIVERS {
        let p = center.as_vec3() + rng.direction() * (radius as f32 * rng.f32());
        let toward = match &truth.sky {
            Sky::Portal(window, _) => window.corner + (window.edges[0] + window.edges[1]) * 0.5,
            Sky::Distant(axis, _) | Sky::Sun(axis, ..) => p.as_dvec3() + *axis * radius,
            Sky::Uniform(_) | Sky::Image(..) => (p + rng.direction()).as_dvec3(),
        };
        let receiver = Receiver::random(rng, p, toward.as_vec3());
        arrival_holds(light, wavelengths, truth, &receiver, rng)?;
        density_holds(light, wavelengths, truth, &receiver, rng)?;
    }
    Ok(())
}

fn texels<M: Model>(image: &Image, scale: f32, wavelengths: &M::Wavelengths) -> Texels {
    let value =
        |texel| M::values(M::emit_texel(texel, wavelengths)).map(|value| value * f64::from(scale));
    Texels {
        size: image.size(),
        values: image.texels().map(value).collect(),
    }
}

/// Corners of a portal, one after the other.
fn random_window(rng: &mut Rng, placement: &Placement) -> [Vec3; 4] {
    let corner = rng.vec3() * 2.0 - 1.0;
    let [x, y] = [rng.log_range(0.05, 2.0), rng.log_range(0.05, 2.0)];
    let corners = [(0.0, 0.0), (0.0, y), (x, y), (x, 0.0)];
    corners.map(|(x, y)| placement.point(corner + Vec3::new(x, y, 0.0)))
}

/// The rectangle with these corners.
fn exact_window(corners: [Vec3; 4]) -> Window {
    let [corner, last, _, first] = corners.map(|p| p.as_dvec3());
    let edges = [first - corner, last - corner];
    let z = edges[0].cross(edges[1]).normalize();
    let x = edges[0].normalize();
    let axes: [DVec3; 3] = [x, z.cross(x), z];
    Window {
        corner,
        edges,
        axes,
    }
}
