use super::super::warp::{SPHERE_PDF, around, concentric_disk, uniform_sphere};
use super::exact_light::{Arriving, ExactBounds, ExactLight, Leaving, RayPdf, Receiver};
use super::fields::{number, point, transform};
use crate::oracle::Jitter;
use crate::{Case, Malformed};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// The sphere around the scene.
#[derive(Clone, Copy)]
pub(super) struct Scene {
    pub(super) center: DVec3,
    pub(super) radius: f64,
}

impl Scene {
    pub(super) fn read(case: &Case<'_>) -> Result<Self, Malformed> {
        Ok(Self {
            center: point(&case.get("scene_center")?)?,
            radius: number(case, "scene_radius")?,
        })
    }

    /// The area that the sphere shows.
    pub(super) fn disk(&self) -> f64 {
        PI * self.radius * self.radius
    }

    /// Light from direction `wi`.
    pub(super) fn arriving(
        &self,
        at: &Receiver,
        wi: DVec3,
        uv: DVec2,
        pdf: f64,
        l: DVec3,
    ) -> Arriving {
        Arriving {
            wi,
            p: at.p + 2.0 * self.radius * wi,
            n: DVec3::ZERO,
            uv,
            pdf,
            l,
        }
    }

    /// The ray from direction `wi` through a disk around the centre.
    pub(super) fn leaving(&self, wi: DVec3, u: DVec2, jitter: &mut Jitter) -> Leaving {
        let disk = concentric_disk(jitter.numbers(u));
        let on_disk = around(wi, disk.extend(1.0) * self.radius, jitter);
        Leaving {
            o: self.center + on_disk,
            d: -wi,
            n: DVec3::ZERO,
            uv: DVec2::ZERO,
        }
    }
}

/// One direction.
pub(super) struct Distant {
    scene: Scene,
    w: DVec3,
    scale: f64,
}

impl Distant {
    pub(super) fn new(case: &Case<'_>) -> Result<Self, Malformed> {
        let (to_scene, _) = transform(&case.get("render_from_light")?)?;
        Ok(Self {
            scene: Scene::read(case)?,
            w: to_scene.z_axis.normalize(),
            scale: number(case, "scale")?,
        })
    }
}

impl ExactLight for Distant {
    fn phi(&self) -> DVec3 {
        DVec3::splat(self.scale * self.scene.disk())
    }

    fn bounds(&self) -> Option<ExactBounds> {
        None
    }

    fn sample_li(&self, at: &Receiver, _u: DVec2, _jitter: &mut Jitter) -> Option<Arriving> {
        let l = DVec3::splat(self.scale);
        Some(self.scene.arriving(at, self.w, DVec2::ZERO, 1.0, l))
    }

    fn pdf_li(&self, _at: &Receiver, _wi: DVec3, _jitter: &mut Jitter) -> f64 {
        0.0
    }

    fn sample_le(&self, u1: DVec2, _u2: DVec2, jitter: &mut Jitter) -> Option<Leaving> {
        Some(self.scene.leaving(self.w, u1, jitter))
    }

    fn sent(&self, _ray: &Leaving, _jitter: &mut Jitter) -> (DVec3, RayPdf) {
        (DVec3::splat(self.scale), [1.0 / self.scene.disk(), 1.0])
    }

    fn pdf_le(&self, _ray: &Leaving, _jitter: &mut Jitter) -> RayPdf {
        [1.0 / self.scene.disk(), 0.0]
    }

    fn radiance(&self, _ray: &Leaving, _jitter: &mut Jitter) -> DVec3 {
        DVec3::ZERO
    }
}

/// The same from everywhere.
pub(super) struct Uniform {
    scene: Scene,
    scale: f64,
}

impl Uniform {
    pub(super) fn new(case: &Case<'_>) -> Result<Self, Malformed> {
        Ok(Self {
            scene: Scene::read(case)?,
            scale: number(case, "scale")?,
        })
    }
}

impl ExactLight for Uniform {
    fn phi(&self) -> DVec3 {
        DVec3::splat(4.0 * PI * self.scale * self.scene.disk())
    }

    fn bounds(&self) -> Option<ExactBounds> {
        None
    }

    fn sample_li(&self, at: &Receiver, u: DVec2, jitter: &mut Jitter) -> Option<Arriving> {
        if at.is_incomplete {
            return None;
        }
        let wi = uniform_sphere(jitter.numbers(u));
        let l = DVec3::splat(self.scale);
        Some(self.scene.arriving(at, wi, DVec2::ZERO, SPHERE_PDF, l))
    }

    fn pdf_li(&self, at: &Receiver, _wi: DVec3, _jitter: &mut Jitter) -> f64 {
        if at.is_incomplete { 0.0 } else { SPHERE_PDF }
    }

    fn sample_le(&self, u1: DVec2, u2: DVec2, jitter: &mut Jitter) -> Option<Leaving> {
        let d = uniform_sphere(jitter.numbers(u1));
        Some(self.scene.leaving(-d, u2, jitter))
    }

    fn sent(&self, _ray: &Leaving, _jitter: &mut Jitter) -> (DVec3, RayPdf) {
        (
            DVec3::splat(self.scale),
            [1.0 / self.scene.disk(), SPHERE_PDF],
        )
    }

    fn radiance(&self, _ray: &Leaving, _jitter: &mut Jitter) -> DVec3 {
        DVec3::splat(self.scale)
    }
}
