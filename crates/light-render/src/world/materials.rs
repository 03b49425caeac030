use light_scene::{Color, ColorImage, Surface as Finish, UvSet};
use lights::bounds::{Gloss, LightSampleContext};
use lights::glam::{Vec2, Vec3};

use super::World;
use crate::Surface;
use crate::bsdf::{
    Bsdf, CoatedConductor, CoatedDiffuse, Conductor, Dielectric, Lambert, MetallicRoughness,
    MetallicRoughnessParameters, Microfacets, Mirror, Scattering, ThinDielectric,
};

impl World {
    /// The scattering function of the material at `surface`.
    #[inline]
    #[must_use]
    pub fn scattering(&self, surface: &Surface) -> Scattering {
        let uv = surface.uvs();
        let bsdf = match self.finish(surface) {
            Finish::Diffuse { reflectance } => {
                let reflectance = self.color(reflectance, uv) * surface.color;
                Bsdf::Lambert(Lambert::opaque(reflectance))
            }
            Finish::DiffuseTransmission {
                reflectance,
                transmittance,
            } => Bsdf::Lambert(Lambert {
                reflectance: self.color(reflectance, uv),
                transmittance: self.color(transmittance, uv),
            }),
            Finish::Mirror { reflectance } => Bsdf::Mirror(Mirror {
                reflectance: *reflectance,
            }),
            Finish::Conductor { eta, k, alpha } => Bsdf::Conductor(Conductor {
                eta: *eta,
                k: *k,
                facets: Microfacets::new(*alpha),
            }),
            Finish::Dielectric { eta, alpha } => Bsdf::Dielectric(Dielectric {
                eta: *eta,
                facets: Microfacets::new(*alpha),
            }),
            Finish::ThinDielectric { eta } => Bsdf::ThinDielectric(ThinDielectric { eta: *eta }),
            Finish::CoatedDiffuse {
                reflectance,
                eta,
                alpha,
            } => Bsdf::CoatedDiffuse(CoatedDiffuse::new(
                self.color(reflectance, uv) * surface.color,
                *eta,
                Microfacets::new(*alpha),
            )),
            Finish::MetallicRoughness(finish) => {
                Bsdf::MetallicRoughness(self.metallic_roughness(finish, surface))
            }
            Finish::CoatedConductor {
                eta,
                k,
                alpha,
                coat_eta,
                coat_alpha,
            } => {
                let base = Conductor {
                    eta: *eta,
                    k: *k,
                    facets: Microfacets::new(*alpha),
                };
                let coat = Microfacets::new(*coat_alpha);
                Bsdf::CoatedConductor(CoatedConductor::new(base, *coat_eta, coat))
            }
            // A boundary between equal indices neither refracts nor reflects.
            Finish::Interface => Bsdf::ThinDielectric(ThinDielectric { eta: 1.0 }),
            _ => unreachable!("every kind of surface is handled above"),
        };
        Scattering::new(bsdf, surface)
    }

    /// The context for light samplers and lights at `surface`, seen from `wo`.
    #[inline]
    #[must_use]
    pub fn light_context(
        &self,
        surface: &Surface,
        scattering: &Scattering,
        wo: Vec3,
    ) -> LightSampleContext {
        if scattering.bsdf().transmits() {
            // Light counts from both sides, as in a medium.
            return LightSampleContext::medium(surface.p).with_error(surface.p_error);
        }
        let ctx = surface.light_context(wo);
        match scattering.bsdf().gloss() {
            Some((alpha, diffuse)) => ctx.with_gloss(Gloss { wo, alpha, diffuse }),
            None => ctx,
        }
    }

    // Not inlined: few scenes have such materials.
    #[inline(never)]
    fn metallic_roughness(
        &self,
        finish: &light_scene::MetallicRoughness,
        surface: &Surface,
    ) -> MetallicRoughness {
        let uv = surface.uvs();
        let Vec3 {
            y: roughness,
            z: metallic,
            ..
        } = self.color(&finish.roughness_metallic, uv);
        let coat = finish.clearcoat.as_ref();
        let clearcoat = coat.map(|coat| {
            let weight = self.color(&coat.weight, uv).x;
            [weight, self.color(&coat.roughness, uv).y]
        });
        MetallicRoughness::new(&MetallicRoughnessParameters {
            base_color: self.color(&finish.base_color, uv) * surface.color,
            metallic,
            roughness,
            f0: finish.f0,
            f90: finish.f90,
            clearcoat,
        })
    }

    /// A colour at the given first and second texture coordinates.
    pub(super) fn color(&self, color: &Color, uvs: [Vec2; 2]) -> Vec3 {
        match color {
            Color::Constant(color) => *color,
            Color::Image(image) => self.texel(image, uvs),
        }
    }

    /// An image at the given first and second texture coordinates.
    pub(super) fn texel(&self, shown: &ColorImage, [first, second]: [Vec2; 2]) -> Vec3 {
        let uv = match shown.uv_set {
            UvSet::First => first,
            UvSet::Second => second,
        };
        self.images[shown.image.0 as usize].on_surface(uv, &shown.mapping) * shown.scale
    }
}
