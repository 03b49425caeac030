use light_scene::{Color, ColorImage, Image, Surface as Finish};
use lights::bounds::{Gloss, LightSampleContext};
use lights::glam::{Vec2, Vec3};

use super::World;
use crate::Surface;
use crate::bsdf::{
    Bsdf, CoatedDiffuse, Conductor, Dielectric, Lambert, Microfacets, Mirror, Scattering,
    ThinDielectric,
};

impl World {
    /// How the material at `surface` scatters light.
    #[inline]
    #[must_use]
    pub fn scattering(&self, surface: &Surface) -> Scattering {
        let (mesh, _) = self.mesh(surface.triangle);
        let uv = surface.uv;
        let bsdf = match &self.materials[mesh.material].surface {
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
            // A boundary between equal indices bends and reflects nothing.
            Finish::Interface => Bsdf::ThinDielectric(ThinDielectric { eta: 1.0 }),
            _ => unreachable!("every kind of surface is handled above"),
        };
        Scattering::new(bsdf, surface)
    }

    /// The question that light samplers and lights answer at `surface`, seen from `wo`.
    #[inline]
    #[must_use]
    pub fn light_context(
        &self,
        surface: &Surface,
        scattering: &Scattering,
        wo: Vec3,
    ) -> LightSampleContext {
        if scattering.bsdf().transmits() {
            // Light counts from both sides, as it does in a medium.
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
            Color::Image(ColorImage { image, scale }) => {
                bilinear(&self.images[image.0 as usize], uv) * *scale
            }
        }
    }
}

/// The colour of a repeating image at `uv`, whose (0, 0) is the lower left corner.
fn bilinear(image: &Image, uv: Vec2) -> Vec3 {
    let (width, height) = (image.width(), image.height());
    let x = uv.x * width as f32 - 0.5;
    let y = (1.0 - uv.y) * height as f32 - 0.5;
    let (x0, y0) = (x.floor(), y.floor());
    let at = |dx: f32, dy: f32| image.texel(wrapped(x0 + dx, width), wrapped(y0 + dy, height));
    let top = at(0.0, 0.0).lerp(at(1.0, 0.0), x - x0);
    let bottom = at(0.0, 1.0).lerp(at(1.0, 1.0), x - x0);
    top.lerp(bottom, y - y0)
}

/// The whole number `i` modulo `n`; 0 where `i` is no number.
fn wrapped(i: f32, n: u32) -> u32 {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "below n, saturating otherwise"
    )]
    let index = i.rem_euclid(n as f32) as u32;
    index.min(n - 1)
}
