use light_scene::{Alpha, BackFaces, Material};
use lights::bounds::{LightId, LightSampleContext};
use lights::glam::{Vec2, Vec3};
use lights::sources::shape::{AnyShape, Shape};
use lights::sources::{AreaLight, Light, LightLiSample, LightRef, PdfCoverage, Rgb, SurfacePoint};

use super::World;
use crate::surface_emission::AlphaMaskedLights;
use crate::{PrimitiveId, Ray, Surface, sobol};

impl World {
    /// Any-hit test: whether `ray` hits a primitive at `coords`, or passes through its alpha mask,
    /// a back face that is culled, or what a part of a quadric lacks.
    ///
    /// A surface of fractional opacity is hit by that share of the rays, chosen by a hash of ray
    /// and primitive, so that the same ray always gets the same answer. A ray may cross a quadric
    /// twice, so that the hash of a quadric includes the coordinates.
    pub(super) fn any_hit(&self, ray: &Ray, primitive: PrimitiveId, coords: Vec2) -> bool {
        let (_, material) = self.material(primitive);
        let is_culled = material.back_faces == BackFaces::Culled;
        if is_culled && self.is_seen_from_behind(ray, primitive) {
            return false;
        }
        if !self.is_there(primitive, coords) {
            return false;
        }
        if material.alpha.is_none() {
            return true;
        }
        let opacity = self.opacity(material, self.uvs(primitive, coords));
        let coords = if self.quadric(primitive).is_some() {
            coords
        } else {
            Vec2::ZERO
        };
        opacity >= 1.0 || chance(ray, primitive, coords) < opacity
    }

    /// The share of rays, in `[0, 1]`, that a surface of `material` stops at the texture
    /// coordinates `uvs`.
    fn opacity(&self, material: &Material, uvs: [Vec2; 2]) -> f32 {
        let Some(Alpha { opacity, cutoff }) = &material.alpha else {
            return 1.0;
        };
        let opacity = self.color(opacity, uvs).x;
        match cutoff {
            Some(cutoff) => f32::from(u8::from(opacity >= *cutoff)),
            None => opacity.clamp(0.0, 1.0),
        }
    }

    /// The lights with an alpha mask that `id` is one of.
    #[inline]
    fn masked(&self, LightId(id): LightId) -> Option<&AlphaMaskedLights> {
        let after = self
            .masked_lights
            .partition_point(|lights| lights.ids.start <= id);
        let lights = self.masked_lights.get(after.checked_sub(1)?)?;
        lights.ids.contains(&id).then_some(lights)
    }

    /// The radiance along a ray that hit the light `id`, of which the mean radiance is `l`: the
    /// any-hit test has already removed the rays that pass through the mask.
    #[inline]
    pub(super) fn radiance_at_hit(&self, id: LightId, surface: &Surface, l: Vec3) -> Vec3 {
        match self.masked(id) {
            Some(lights) => {
                let opacity = self.opacity(&self.materials[lights.material], surface.uvs());
                if opacity > 0.0 {
                    l / opacity
                } else {
                    Vec3::ZERO
                }
            }
            None => l,
        }
    }

    /// Samples a direction toward the light `id` with the light's own strategy; radiance is zero
    /// where the light's alpha mask is.
    #[inline]
    pub(crate) fn sample_light(
        &self,
        id: LightId,
        ctx: &LightSampleContext,
        u: Vec2,
        coverage: PdfCoverage,
    ) -> Option<LightLiSample<Vec3>> {
        let light = self.lights.get(id)?;
        match self.masked(id) {
            Some(_) => sample_masked(&light, ctx, u, coverage),
            None => light.sample_li(ctx, u, &(), coverage),
        }
    }
}

// Not inlined: most scenes have no masked lights.
#[inline(never)]
fn sample_masked(
    light: &LightRef<'_, Rgb>,
    ctx: &LightSampleContext,
    u: Vec2,
    coverage: PdfCoverage,
) -> Option<LightLiSample<Vec3>> {
    let sample = match light {
        LightRef::Area(area) if matches!(area.shape(), AnyShape::Sphere(_)) => {
            let toward = area.shape().sample_toward(ctx, u)?;
            let (near, wi) = (toward.at, toward.wi);
            let mut sample = LightLiSample {
                l: area.l(&near, -wi, &()),
                wi,
                pdf: toward.pdf,
                p_light: near.p,
                n_light: near.n,
                uv: near.uv,
            };
            // Through the mask of the near side, the inside of the far side is visible.
            if let Some(far) = far_side(area.shape(), &near, wi) {
                let l = area.l(&far, -wi, &());
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
        _ => light.sample_li(ctx, u, &(), coverage)?,
    };
    (sample.l != Vec3::ZERO).then_some(sample)
}

/// Where a ray that enters a sphere at `near` leaves it; `None` for a ray from inside.
fn far_side(sphere: &AnyShape, near: &SurfacePoint, wi: Vec3) -> Option<SurfacePoint> {
    if near.n.dot(wi) >= 0.0 {
        return None;
    }
    let to_middle = (sphere.bounds().center() - near.p).dot(wi);
    sphere.hit(near.p + wi * to_middle, wi)
}

/// One pseudorandom bit, a hash of a direction.
fn coin(w: Vec3) -> bool {
    let bits = w.to_array().map(f32::to_bits);
    sobol::hash(bits[0] ^ sobol::hash(bits[1] ^ sobol::hash(bits[2]))) & 1 == 1
}

/// A pseudorandom number in `[0, 1)`, a hash of ray, primitive and coordinates.
fn chance(ray: &Ray, primitive: PrimitiveId, coords: Vec2) -> f32 {
    let parts = [ray.origin, ray.direction].map(|v| v.to_array());
    let bits = parts.as_flattened().iter().map(|x| x.to_bits());
    let instance = primitive.instance().map_or(0, sobol::hash);
    let start = primitive.number() ^ instance ^ coords_bits(coords);
    let hash = bits.fold(start, |hash, bits| sobol::hash(hash.rotate_left(9) ^ bits));
    (hash >> 8) as f32 / (1u32 << 24) as f32
}

/// The bits of both coordinates; 0 for the origin.
fn coords_bits(Vec2 { x, y }: Vec2) -> u32 {
    x.to_bits().rotate_left(16) ^ y.to_bits()
}
