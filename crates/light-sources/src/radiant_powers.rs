use core::ptr;

use light_bounds::LightExtent;

use crate::color::{ColorModel, Radiance};
use crate::glam::Vec3;
use crate::light::Light;
use crate::light_power::PowerColor;
use crate::light_ref::LightRef;
use crate::scaled_emission::ScaledEmission;
use crate::scene_sphere::SceneSphere;

/// Radiant powers of lights. Neighbours that share an emission, as the triangles of a mesh do, share
/// its integral.
#[derive(Debug)]
pub(crate) struct RadiantPowers<'a, C: ColorModel> {
    scene: SceneSphere,
    last: Option<(&'a ScaledEmission<C>, f32)>,
}

impl<'a, C: ColorModel> RadiantPowers<'a, C> {
    pub(crate) const fn new(scene: SceneSphere) -> Self {
        Self { scene, last: None }
    }

    /// The power in W; above 0 unless the light is black.
    pub(crate) fn of(&mut self, light: &LightRef<'a, C>) -> f32 {
        // Without wavelengths one query sees all of the light.
        if size_of::<C::Wavelengths>() == 0 {
            let all = C::reference_wavelengths();
            return C::mean(light.phi(&all), &all);
        }
        let power = match light {
            LightRef::Point(light) => light.light_power(),
            LightRef::Spot(light) => light.light_power(),
            LightRef::Projection(light) => light.light_power(),
            LightRef::Goniometric(light) => light.light_power(),
            LightRef::Area(light) => light.light_power(),
            LightRef::Triangle(light) => light.light_power(),
            LightRef::Own(own) => return self.of_own(*own),
            LightRef::Distant(light) => light.light_power(),
            LightRef::Sun(light) => light.light_power(),
            LightRef::UniformInfinite(light) => light.light_power(),
            LightRef::ImageInfinite(light) => light.light_power(),
            LightRef::PortalInfinite(light) => light.light_power(),
        };
        let radiant = match power.color {
            PowerColor::Emission(emission) => self.radiant(emission),
            PowerColor::Texel(rgb) => C::flux_of_texel(rgb).radiant,
        };
        radiant * power.scale * power.etendue
    }

    fn radiant(&mut self, emission: &'a ScaledEmission<C>) -> f32 {
        match self.last {
            Some((last, radiant)) if ptr::eq(last, emission) => radiant,
            _ => {
                let radiant = emission.radiant();
                self.last = Some((emission, radiant));
                radiant
            }
        }
    }

    /// Of a light whose spectrum is only known at the wavelengths of a query: an estimate in
    /// proportion to white, or what its extent says if it is black at those.
    fn of_own(&self, light: &impl Light<C>) -> f32 {
        let wavelengths = C::reference_wavelengths();
        let mean = |value| C::mean(value, &wavelengths);
        let phi = light.phi(&wavelengths);
        if !phi.is_black() {
            let white = mean(C::emit_texel(Vec3::ONE, &wavelengths));
            return mean(phi) * (C::flux_of_texel(Vec3::ONE).radiant / white);
        }
        match light.extent() {
            LightExtent::Bounded(bounds) | LightExtent::Lobe(bounds, _) => bounds.phi,
            LightExtent::Infinite(bounds) => bounds.fluence * self.scene.disk_area(),
        }
    }
}
