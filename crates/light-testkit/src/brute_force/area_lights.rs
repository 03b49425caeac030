use light_math::glam::Vec3;
use light_sources::{
    Channels, DiffuseEmissionDesc, EmissionMask, Light, LightSetBuilder, RadianceAmount, Sides,
    SurfaceColor,
};

use super::amounts::surface_amounts_hold;
use super::area::{EmittingSurface, largest};
use super::area_checks::check_surface;
use super::bodies::Body;
use super::kind::Kind;
use super::model::Model;
use super::picture::{random_image, random_mapping, random_mask};
use super::placement::{Placement, any_scene};
use crate::Rng;

/// An area light or one triangle of a mesh, anywhere, against its description.
pub(super) fn check<M: Model>(kind: Kind, rng: &mut Rng) -> Result<(), String> {
    let wavelengths = M::random_wavelengths(rng);
    let emission = random_emission::<M>(rng);
    let placement = Placement::random(rng);
    let body = Body::random(kind, rng, &placement);
    let describe = |fault| format!("{fault}\n  {:?}\n  {}", body.desc, what(&emission));
    let mut builder = LightSetBuilder::<M>::new(any_scene());
    let source = body.add(&mut builder, &emission).map_err(describe)?;
    let set = builder.build();
    let id = set.id_of(source, body.triangle).ok_or("no id")?;
    let light = set.get(id).ok_or("no light")?;
    let emitting = |surface| EmittingSurface {
        surface,
        emission: &emission,
        wavelengths: &wavelengths,
        coordinates: largest(&body.points),
    };
    let power = set.powers()[id.0 as usize];
    let truth = emitting(body.surface);
    check_surface(&light, power, &truth, placement.unit, rng)
        .and_then(|()| {
            let phi = M::values(light.phi(&wavelengths));
            let all: Vec<_> = body.described.iter().copied().map(emitting).collect();
            surface_amounts_hold(&all, phi, rng, |emission| {
                let mut builder = LightSetBuilder::<M>::new(any_scene());
                let source = body.add(&mut builder, &emission)?;
                let set = builder.build();
                let id = set.id_of(source, body.triangle).ok_or("no id")?;
                Ok(M::values(set.get(id).ok_or("no light")?.phi(&wavelengths)))
            })
        })
        .map_err(describe)
}

fn random_emission<M: Model>(rng: &mut Rng) -> DiffuseEmissionDesc<M> {
    let channels = if M::is_linear() {
        [Channels::Gray, Channels::Rgb][rng.below(2)]
    } else {
        Channels::Gray
    };
    let color = if rng.below(2) == 0 {
        SurfaceColor::Uniform(M::random_emission(rng))
    } else {
        let size = [1 + rng.below(8) as u32, 1 + rng.below(8) as u32];
        SurfaceColor::Image {
            texture: random_image(rng, size, channels).into(),
            tint: [Vec3::ONE, rng.vec3() + 0.01][rng.below(2)],
        }
    };
    let mask = match rng.below(4) {
        0 => EmissionMask::Alpha(random_mask(rng)),
        1 => EmissionMask::Invisible,
        _ => EmissionMask::Opaque,
    };
    let amount = RadianceAmount::Radiometric(rng.log_range(1e-3, 1e3));
    DiffuseEmissionDesc {
        sides: [Sides::Front, Sides::Back, Sides::Both][rng.below(3)],
        mask,
        mapping: random_mapping(rng),
        ..DiffuseEmissionDesc::new(color, amount)
    }
}

/// The parts of an emission that a fault is printed with.
fn what<M: Model>(emission: &DiffuseEmissionDesc<M>) -> String {
    let color = match &emission.color {
        SurfaceColor::Uniform(color) => format!("{color:?}"),
        SurfaceColor::Image { texture, tint } => {
            format!("image {:?} times {tint}", texture.image())
        }
    };
    let mask = match &emission.mask {
        EmissionMask::Alpha(mask) => format!(
            "mask {:?} times {}, cutoff {:?}, {:?}",
            mask.texture.image(),
            mask.scale,
            mask.cutoff,
            mask.mapping
        ),
        other => format!("{other:?}"),
    };
    format!(
        "{color}, {mask}, {:?}, {:?}, {:?}",
        emission.sides, emission.amount, emission.mapping
    )
}
