use super::super::warp::{frame, polar, uniform_sphere};
use super::area::{At, Shape, per_solid_angle};
use super::azimuth::azimuth;
use super::exact_light::Receiver;
use super::fields::{number, transform};
use crate::oracle::Jitter;
use crate::{Case, Malformed};
use glam::{DMat3, DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// A sphere: from outside the cone that it fills is sampled evenly, from inside its area.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sphere {
    to_scene: DMat3,
    center: DVec3,
    radius: f64,
}

impl Sphere {
    pub(super) fn read(case: &Case<'_>) -> Result<Self, Malformed> {
        let (to_scene, center) = transform(&case.get("render_from_object")?)?;
        Ok(Self {
            to_scene,
            center,
            radius: number(case, "radius")?,
        })
    }

    fn at(&self, n: DVec3, jitter: &mut Jitter) -> At {
        let local = jitter.vector(self.to_scene.transpose() * n, 1.0);
        let polar = f64::atan2(local.truncate().length(), local.z);
        At {
            p: self.center + self.radius * n,
            n,
            uv: DVec2::new(azimuth(local), 1.0 - polar / PI),
        }
    }

    /// From the receiver to the centre, as rounding has it.
    fn center_from(&self, from: &Receiver, jitter: &mut Jitter) -> DVec3 {
        let magnitude = from.p.abs().max(self.center.abs()).max_element();
        jitter.vector(self.center - from.p, magnitude)
    }

    /// The sine, squared, of half the cone's angle, and one minus its cosine; none from inside.
    fn cone(&self, to_center: DVec3) -> Option<(f64, f64)> {
        let sin = self.radius / to_center.length();
        (sin < 1.0).then(|| (sin, sin * sin / (1.0 + (1.0 - sin * sin).sqrt())))
    }
}

impl Shape for Sphere {
    fn area(&self) -> f64 {
        4.0 * PI * self.radius * self.radius
    }

    fn bounds(&self) -> [DVec3; 2] {
        [self.center - self.radius, self.center + self.radius]
    }

    fn normals(&self) -> (DVec3, f64) {
        (DVec3::Z, -1.0)
    }

    fn sample(&self, u: DVec2, jitter: &mut Jitter) -> Option<At> {
        Some(self.at(self.to_scene * uniform_sphere(jitter.numbers(u)), jitter))
    }

    fn toward(&self, from: &Receiver, u: DVec2, jitter: &mut Jitter) -> Option<(At, f64)> {
        let to_center = self.center_from(from, jitter);
        let Some((_, one_minus_cos_max)) = self.cone(to_center) else {
            let at = self.sample(u, jitter)?;
            return Some((at, per_solid_angle(1.0 / self.area(), from, &at, jitter)?));
        };
        let u = jitter.numbers(u);
        let local = polar(one_minus_cos_max * u.x, u.y);
        let [x, y, z] = frame(to_center.normalize());
        // The reference's azimuth runs on the sphere, so it is the opposite of that of the
        // direction.
        let w = z * local.z - x * local.x - y * local.y;
        let along = to_center.dot(w);
        let across_sq = (to_center - w * along).length_squared();
        // Near the rim the root magnifies what is rounded below it.
        let radius_sq = self.radius * self.radius;
        let half_chord = jitter.at_scale(radius_sq - across_sq, 2.0 * radius_sq);
        let half_chord = half_chord.max(0.0).sqrt();
        let n = (w * (along - half_chord) - to_center) / self.radius;
        Some((
            self.at(n.normalize(), jitter),
            1.0 / (TAU * one_minus_cos_max),
        ))
    }

    fn pdf_toward(&self, from: &Receiver, wi: DVec3, jitter: &mut Jitter) -> f64 {
        let to_center = self.center_from(from, jitter);
        let wi = jitter.vector(wi, 1.0);
        let along = to_center.dot(wi);
        let across = (to_center - wi * along).length();
        match self.cone(to_center) {
            Some((_, one_minus_cos_max)) if along > 0.0 && across <= self.radius => {
                1.0 / (TAU * one_minus_cos_max)
            }
            Some(_) => 0.0,
            None => {
                let t = along
                    + (self.radius * self.radius - across * across)
                        .max(0.0)
                        .sqrt();
                let at = self.at(((wi * t - to_center) / self.radius).normalize(), jitter);
                per_solid_angle(1.0 / self.area(), from, &at, jitter).unwrap_or(0.0)
            }
        }
    }
}
