use light_scene::{Color, ColorImage, Surface as Finish};
use lights::bounds::{Gloss, LightSampleContext};
use lights::glam::{Vec2, Vec3};

use super::World;
use crate::Surface;
use crate::bsdf::{
    Bsdf, CoatedDiffuse, Conductor, Dielectric, Lambert, Microfacets, Mirror, Scattering,
    ThinDielectric,
};

impl World {
    /// The scattering function of the material at `surface`.
    #[inline]
    #[must_use]
    pub fn scattering(&self, surface: &Surface) -> Scattering {
        let uv = surface.uv;
        let bsdf = match self.finish(surface) {
            Finish::Diffuse { reflectance } => {
                Bsdf::Lambert(Lambert::opaque(self.color(reflectance, uv)))
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
                self.color(reflectance, uv),
                *eta,
                Microfacets::new(*alpha),
            )),
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

    pub(super) fn color(&self, color: &Color, uv: Vec2) -> Vec3 {
        match color {
            Color::Constant(color) => *color,
            Color::Image(ColorImage {
                image,
                scale,
                mapping,
            }) => self.images[image.0 as usize].on_surface(uv, mapping) * *scale,
        }
    }
}
