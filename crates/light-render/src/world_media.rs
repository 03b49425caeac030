use light_scene::{Material, NamedMedium, Surface as Finish};
use lights::glam::Vec3;
use lights::media::{self, AnyMedium, Flight, Span, delta_tracking, transmittance};
use lights::sources::{MediumId, Rgb};

use crate::Ray;

/// The media of a world: transmittance and tracking along rays.
#[derive(Debug)]
pub(crate) struct WorldMedia {
    media: Vec<AnyMedium<Rgb>>,
    /// The medium around the camera.
    pub(crate) camera: Option<MediumId>,
    /// Whether rays can pass through any surface unchanged.
    pub(crate) have_interfaces: bool,
}

impl WorldMedia {
    pub(crate) fn new(
        media: Vec<NamedMedium>,
        camera: Option<MediumId>,
        materials: &[Material],
    ) -> Self {
        let is_interface = |material: &Material| material.surface == Finish::Interface;
        Self {
            media: media.into_iter().map(|named| named.medium).collect(),
            camera,
            have_interfaces: materials.iter().any(is_interface),
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.media.is_empty()
    }

    /// The medium with this id; absent for vacuum, and for an id that no medium has.
    #[inline]
    pub(crate) fn get(&self, id: Option<MediumId>) -> Option<&AnyMedium<Rgb>> {
        self.media.get(id?.index() as usize)
    }

    /// An unbiased estimate of the transmittance over `distance` along `ray`.
    #[inline]
    pub(crate) fn transmittance(
        &self,
        id: Option<MediumId>,
        ray: &Ray,
        distance: f32,
        next_u: &mut impl FnMut() -> f32,
    ) -> Vec3 {
        match (self.get(id), Span::new(0.0, distance)) {
            (Some(medium), Some(span)) => {
                transmittance::unbiased::<Rgb, _>(medium, &ray.into(), span, &(), next_u)
            }
            _ => Vec3::ONE,
        }
    }

    /// Follows a path of throughput `beta` over `distance` along `ray`; `None` in vacuum.
    #[inline]
    pub(crate) fn flight(
        &self,
        id: Option<MediumId>,
        ray: &Ray,
        distance: f32,
        beta: Vec3,
        next_u: &mut impl FnMut() -> f32,
    ) -> Option<Flight<Vec3>> {
        let medium = self.get(id)?;
        let span = Span::new(0.0, distance)?;
        let ray = ray.into();
        Some(delta_tracking::<Rgb, _>(
            medium,
            &ray,
            span,
            beta,
            &(),
            next_u,
        ))
    }
}

impl From<&Ray> for media::Ray {
    fn from(ray: &Ray) -> Self {
        Self {
            o: ray.origin,
            d: ray.direction,
        }
    }
}
