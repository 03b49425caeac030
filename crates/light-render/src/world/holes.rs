use light_scene::{Alpha, Material};
use lights::bounds::{LightId, LightSampleContext};
use lights::glam::{Vec2, Vec3};
use lights::sources::shape::{AnyShape, Shape};
use lights::sources::{AreaLight, Light, LightLiSample, LightRef, PdfCoverage, Rgb, SurfacePoint};

use super::World;
use crate::surface_emission::{HoledLights, Holes};
use crate::{PrimitiveId, Ray, sobol};

impl World {
    /// Whether `ray` meets a primitive at a place of it, or passes through a hole.
    ///
    /// A surface that is partly there is met by its share of the rays, chosen by a hash of ray and
    /// primitive: the same ray always gets the same answer. A sphere, which it may meet twice, is
    /// asked about each place for itself.
    pub(super) fn is_there(&self, ray: &Ray, primitive: PrimitiveId, place: Vec2) -> bool {
        let (_, material) = self.material(primitive);
        if material.alpha.is_none() {
            return true;
        }
        let share = self.share(material, self.uv(primitive, place));
        let place = if self.is_sphere(primitive) {
            place
        } else {
            Vec2::ZERO
        };
        share >= 1.0 || chance(ray, primitive, place) < share
    }

    /// How much of the rays a surface of `material` meets where the texture coordinates are `uv`,
    /// in `[0, 1]`.
    fn share(&self, material: &Material, uv: Vec2) -> f32 {
        let Some(Alpha { share, cutoff }) = &material.alpha else {
            return 1.0;
        };
        let share = self.color(share, uv).x;
        match cutoff {
            Some(cutoff) => f32::from(u8::from(share >= *cutoff)),
            None => share.clamp(0.0, 1.0),
        }
    }

    /// The lights with holes that `id` is one of.
    #[inline]
    fn holed(&self, LightId(id): LightId) -> Option<&HoledLights> {
        let after = self
            .holed_lights
            .partition_point(|lights| lights.ids.start <= id);
        let lights = self.holed_lights.get(after.checked_sub(1)?)?;
        lights.ids.contains(&id).then_some(lights)
    }

    /// The radiance that a ray finds where it meets the light `id`, of which the radiance is `l`:
    /// it meets only what is there.
    #[inline]
    pub(super) fn where_met(&self, id: LightId, uv: Vec2, l: Vec3) -> Vec3 {
        match self.holed(id) {
            Some(&HoledLights {
                material,
                holes: Holes::InRadiance,
                ..
            }) => {
                let share = self.share(&self.materials[material], uv);
                if share > 0.0 { l / share } else { Vec3::ZERO }
            }
            _ => l,
        }
    }

    /// A direction in which the light `id` arrives, by its own sampling; holes of its surface send
    /// none.
    #[inline]
    pub(crate) fn sample_light(
        &self,
        id: LightId,
        ctx: &LightSampleContext,
        u: Vec2,
        coverage: PdfCoverage,
    ) -> Option<LightLiSample<Vec3>> {
        let light = self.lights.get(id)?;
        match self.holed(id) {
            Some(holed) => self.sample_holed(holed, &light, ctx, u, coverage),
            None => light.sample_li(ctx, u, &(), coverage),
        }
    }

    // Kept out of the code that scenes without holes run.
    #[inline(never)]
    fn sample_holed(
        &self,
        holed: &HoledLights,
        light: &LightRef<'_, Rgb>,
        ctx: &LightSampleContext,
        u: Vec2,
        coverage: PdfCoverage,
    ) -> Option<LightLiSample<Vec3>> {
        let there = |uv, l: Vec3| match holed.holes {
            Holes::InRadiance => l,
            Holes::OnlyInSurface => l * self.share(&self.materials[holed.material], uv),
        };
        let sample = match light {
            LightRef::Area(area) if matches!(area.shape(), AnyShape::Sphere(_)) => {
                let toward = area.shape().sample_toward(ctx, u)?;
                let (near, wi) = (toward.at, toward.wi);
                let mut sample = LightLiSample {
                    l: there(near.uv, area.l(&near, -wi, &())),
                    wi,
                    pdf: toward.pdf,
                    p_light: near.p,
                    n_light: near.n,
                    uv: near.uv,
                };
                // Through a hole of the near side the far side is seen from within.
                if let Some(far) = far_side(area.shape(), &near, wi) {
                    let l = there(far.uv, area.l(&far, -wi, &()));
                    let is_far = sample.l == Vec3::ZERO || (l != Vec3::ZERO && coin(wi));
                    let is_one_of_two = sample.l != Vec3::ZERO && l != Vec3::ZERO;
                    if is_far {
                        (sample.l, sample.p_light) = (l, far.p);
                        (sample.n_light, sample.uv) = (far.n, far.uv);
                    }
                    if is_one_of_two {
                        sample.l *= 2.0;
                    }
                }
                sample
            }
            _ => {
                let sample = light.sample_li(ctx, u, &(), coverage)?;
                let l = there(sample.uv, sample.l);
                LightLiSample { l, ..sample }
            }
        };
        (sample.l != Vec3::ZERO).then_some(sample)
    }
}

/// Where a ray that enters a sphere at `near` leaves it; `None` for a ray from inside.
fn far_side(sphere: &AnyShape, near: &SurfacePoint, wi: Vec3) -> Option<SurfacePoint> {
    if near.n.dot(wi) >= 0.0 {
        return None;
    }
    let to_middle = (sphere.bounds().center() - near.p).dot(wi);
    sphere.hit(near.p + wi * to_middle, wi)
}

/// Heads or tails, as a direction decides.
fn coin(w: Vec3) -> bool {
    let bits = w.to_array().map(f32::to_bits);
    sobol::hash(bits[0] ^ sobol::hash(bits[1] ^ sobol::hash(bits[2]))) & 1 == 1
}

/// A number in `[0, 1)` that ray, primitive and place decide.
fn chance(ray: &Ray, primitive: PrimitiveId, place: Vec2) -> f32 {
    let parts = [ray.origin, ray.direction].map(|v| v.to_array());
    let bits = parts.as_flattened().iter().map(|x| x.to_bits());
    let placement = primitive.placement().map_or(0, sobol::hash);
    let start = primitive.number() ^ placement ^ place_bits(place);
    let hash = bits.fold(start, |hash, bits| sobol::hash(hash.rotate_left(9) ^ bits));
    (hash >> 8) as f32 / (1u32 << 24) as f32
}

/// Bits of a place; those of the origin are 0.
fn place_bits(Vec2 { x, y }: Vec2) -> u32 {
    x.to_bits().rotate_left(16) ^ y.to_bits()
}
