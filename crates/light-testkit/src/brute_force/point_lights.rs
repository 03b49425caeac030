use light_math::glam::{Affine3A, DVec2, DVec3, Vec3};
use light_sources::{
    Channels, GoniometricLightDesc, IntensityAmount, Light, LightDesc, LightRef, LightSetBuilder,
    MediumInterface, PointLightDesc, ProjectionLightDesc, SpotLightDesc,
};

use super::amounts::{Quantities, intensities_hold};
use super::arrival::arrival_holds;
use super::kind::Kind;
use super::lobes::lobe_holds;
use super::model::Model;
use super::picture::random_image;
use super::placement::{Placement, any_scene};
use super::point_truth::{Beam, PointTruth};
use super::power::{Power, power_holds};
use super::rays::leaving_holds;
use super::receiver::Receiver;
use super::surface::RigidFrame;
use crate::Rng;

/// Receivers of each light.
const RECEIVERS: u32 = 12;

/// A light in a point, anywhere, against its description.
pub(super) fn check<M: Model>(kind: Kind, rng: &mut Rng) -> Result<(), String> {
    let wavelengths = M::random_wavelengths(rng);
    let emission = M::random_emission(rng);
    let placement = Placement::random(rng);
    let scale = rng.log_range(1e-3, 1e3);
    let amount = IntensityAmount::Radiometric(scale);
    let transform = placement.transform();
    let media = MediumInterface::default();
    let mut values = M::values_of(&emission, &wavelengths).map(|value| value * f64::from(scale));
    let mut frame = RigidFrame::new(transform);
    let mut color = M::radiant(&emission);
    let (desc, beam): (LightDesc<M>, Beam) = match kind {
        Kind::Point => {
            let position = transform.translation.into();
            let desc = PointLightDesc::new(position, emission.clone(), amount);
            frame = RigidFrame::new(Affine3A::from_translation(position));
            (desc.into(), Beam::Even)
        }
        Kind::Spot => {
            let angle = [rng.range(0.01, 3.1), rng.log_range(1e-4, 1.0)][rng.below(2)];
            let falloff_start = angle * [0.0, 1.0, rng.f32()][rng.below(3)];
            let desc = SpotLightDesc {
                falloff_start,
                ..SpotLightDesc::new(transform, angle, emission.clone(), amount)
            };
            (
                desc.into(),
                Beam::Spot([falloff_start, angle].map(f64::from)),
            )
        }
        Kind::Projection => {
            let size = [1 + rng.below(6) as u32, 1 + rng.below(6) as u32];
            let channels = if M::is_linear() {
                Channels::Rgb
            } else {
                Channels::Gray
            };
            let image = random_image(rng, size, channels);
            let fov = [rng.range(0.1, 3.0), rng.log_range(1e-4, 1.0)][rng.below(2)];
            let texel = |texel: Vec3| {
                M::values(M::emit_texel(texel, &wavelengths)).map(|value| value * f64::from(scale))
            };
            let texels = image.texels().map(texel).collect();
            let [width, height] = size.map(f64::from);
            let half =
                DVec2::new(width, height) * ((0.5 * f64::from(fov)).tan() / width.min(height));
            (values, color) = M::white(&wavelengths);
            values = values.map(|value| value * f64::from(scale));
            let desc = ProjectionLightDesc {
                transform,
                image,
                fov,
                amount,
                media,
            };
            (
                LightDesc::Projection(desc),
                Beam::Projection(half, size, texels),
            )
        }
        _ => {
            let n = 1 + rng.below(12) as u32;
            let distribution = random_image(rng, [n, n], Channels::Gray);
            let desc = GoniometricLightDesc {
                transform,
                distribution: distribution.clone(),
                emission: emission.clone(),
                amount,
                media,
            };
            (
                LightDesc::Goniometric(desc),
                Beam::Goniometric(distribution),
            )
        }
    };
    let described = format!("{desc:?}");
    let mut builder = LightSetBuilder::<M>::new(any_scene());
    let source = builder
        .add(desc.clone())
        .map_err(|e| format!("{e}: {described}"))?;
    let set = builder.build();
    let id = set.first_id(source).ok_or("no id")?;
    let light = set.get(id).ok_or("no light")?;
    let truth = PointTruth {
        frame,
        beam,
        values,
        coordinates: transform.translation.abs().max_element().into(),
    };
    let power = Power {
        phi: M::values(light.phi(&wavelengths)),
        radiant: set.powers()[id.0 as usize].into(),
    };
    let color = color.map(|c| c * f64::from(scale));
    power_holds(power, color, values, rng, |side, rng| {
        truth.leaving(side, rng)
    })
    .and_then(|leaving| {
        compare(&light, &wavelengths, &truth, placement.unit, rng)?;
        let is_picture = matches!(desc, LightDesc::Projection(_));
        let scale = f64::from(scale);
        let beam = if M::is_linear() && is_picture {
            let [r, g, b, _] = leaving.phi;
            DVec3::new(r, g, b)
        } else {
            DVec3::splat(scale * leaving.etendue)
        };
        let [radiant, error] = color;
        let of_color = [M::luminous(&emission), radiant / scale];
        let [luminous, power] = if is_picture {
            [M::flux_of(DVec3::ONE), M::flux_of(beam)]
        } else {
            [of_color, of_color.map(|of_color| of_color * beam.x)]
        };
        let quantities = Quantities {
            luminous: luminous[0] * scale,
            luminous_power: power[0],
            radiant_power: power[1],
            chance: leaving.chance,
        };
        if error > 5e-3 * radiant {
            return Ok(());
        }
        let phi = M::values(light.phi(&wavelengths));
        intensities_hold(&quantities, phi, rng, |amount| {
            let mut desc = desc.clone();
            match &mut desc {
                LightDesc::Point(light) => light.amount = amount,
                LightDesc::Spot(light) => light.amount = amount,
                LightDesc::Projection(light) => light.amount = amount,
                LightDesc::Goniometric(light) => light.amount = amount,
                other => unreachable!("{other:?} is no light in a point"),
            }
            let mut builder = LightSetBuilder::<M>::new(any_scene());
            let source = builder.add(desc).map_err(|e| e.to_string())?;
            let set = builder.build();
            let id = set.first_id(source).ok_or("no id")?;
            Ok(M::values(set.get(id).ok_or("no light")?.phi(&wavelengths)))
        })
    })
    .map_err(|fault| format!("{fault}\n  {described}"))
}

/// All but the power.
fn compare<M: Model>(
    light: &LightRef<'_, M>,
    wavelengths: &M::Wavelengths,
    truth: &PointTruth,
    unit: f32,
    rng: &mut Rng,
) -> Result<(), String> {
    let origin = truth.frame.origin;
    let coordinates = truth.coordinates;
    leaving_holds(light, wavelengths, coordinates, origin, rng, |side, rng| {
        truth.leaving(side, rng)
    })?;
    lobe_holds(light, truth, &mut Rng::new(rng.clone().u64()))?;
    for _ in 0..RECEIVERS {
        let on = origin.as_vec3();
        let ray = light.sample_le(rng.vec2(), rng.vec2(), wavelengths);
        // Most receivers are where the light goes.
        let toward = match (ray, rng.below(4)) {
            (Some(sample), 1..) => sample.ray.direction,
            _ => rng.direction(),
        };
        let p = on + toward * (unit * rng.log_range(0.01, 100.0));
        if p == on {
            continue;
        }
        let receiver = Receiver::random(rng, p, on);
        arrival_holds(light, wavelengths, truth, &receiver, rng)?;
    }
    Ok(())
}
