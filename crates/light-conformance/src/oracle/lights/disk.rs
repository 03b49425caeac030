use super::super::warp::concentric_disk;
use super::area::{At, Shape, per_solid_angle};
use super::azimuth::azimuth;
use super::exact_light::Receiver;
use super::fields::{number, transform};
use crate::oracle::Jitter;
use crate::{Case, Malformed};
use glam::{DMat3, DVec2, DVec3};
use std::f64::consts::PI;

/// A disk, or a ring: points are chosen by area, and the circles of the disk move outward to where
/// they keep theirs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disk {
    to_scene: DMat3,
    center: DVec3,
    radius: f64,
    inner: f64,
}

impl Disk {
    pub(super) fn read(case: &Case<'_>) -> Result<Self, Malformed> {
        let (to_scene, origin) = transform(&case.get("render_from_object")?)?;
        Ok(Self {
            to_scene,
            center: origin + to_scene.z_axis * number(case, "height")?,
            radius: number(case, "radius")?,
            inner: number(case, "inner_radius")?,
        })
    }

    fn at(&self, local: DVec2) -> At {
        let v = (self.radius - local.length()) / (self.radius - self.inner);
        At {
            p: self.center + self.to_scene * local.extend(0.0),
            n: self.to_scene.z_axis.normalize(),
            uv: DVec2::new(azimuth(local.extend(0.0)), v.clamp(0.0, 1.0)),
        }
    }
}

impl Shape for Disk {
    fn area(&self) -> f64 {
        PI * (self.radius * self.radius - self.inner * self.inner)
    }

    fn bounds(&self) -> [DVec3; 2] {
        let n = self.to_scene.z_axis.normalize();
        let reach = (DVec3::ONE - n * n).max(DVec3::ZERO).map(f64::sqrt) * self.radius;
        [self.center - reach, self.center + reach]
    }

    fn normals(&self) -> (DVec3, f64) {
        (self.to_scene.z_axis.normalize(), 1.0)
    }

    fn sample(&self, u: DVec2, jitter: &mut Jitter) -> Option<At> {
        let on_disk = concentric_disk(jitter.numbers(u));
        let inner_sq = self.inner * self.inner;
        let ring = self.radius * self.radius - inner_sq;
        let r = (inner_sq + ring * on_disk.length_squared()).sqrt();
        Some(self.at(on_disk.normalize_or(DVec2::X) * r))
    }

    fn toward(&self, from: &Receiver, u: DVec2, jitter: &mut Jitter) -> Option<(At, f64)> {
        let at = self.sample(u, jitter)?;
        Some((at, per_solid_angle(1.0 / self.area(), from, &at, jitter)?))
    }

    fn pdf_toward(&self, from: &Receiver, wi: DVec3, jitter: &mut Jitter) -> f64 {
        let n = self.to_scene.z_axis.normalize();
        let wi = jitter.vector(wi, 1.0);
        let t = (self.center - from.p).dot(n) / wi.dot(n);
        let local = (self.to_scene.transpose() * (from.p + wi * t - self.center)).truncate();
        let r = local.length();
        if !(t > 0.0 && r <= self.radius && r >= self.inner) {
            return 0.0;
        }
        per_solid_angle(1.0 / self.area(), from, &self.at(local), jitter).unwrap_or(0.0)
    }
}
