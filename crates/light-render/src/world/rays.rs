use lights::glam::Vec3;

use super::World;
use crate::{Hit, PrimitiveId, Ray, Surface};

impl World {
    /// The first point of a surface along `ray`, which starts on the primitive `from`.
    #[inline]
    #[must_use]
    pub fn closest(&self, ray: &Ray, from: Option<PrimitiveId>) -> Option<Surface> {
        let hit = if self.has_any_hits {
            let any_hit = |primitive, coords| self.any_hit(ray, primitive, coords);
            self.accel.closest_where(ray, from, any_hit)
        } else {
            self.accel.closest(ray, from)
        };
        let surface = |hit: Hit| {
            let surface = self.surface(hit.primitive, hit.coords);
            if self.has_normal_maps {
                self.with_normal_map(surface, hit.coords, -ray.direction)
            } else {
                surface
            }
        };
        if self.listed_lights.is_empty() {
            return hit.map(surface);
        }
        let t_max = hit.map_or(f32::INFINITY, |hit| hit.t);
        self.closest_listed(ray, t_max).or_else(|| hit.map(surface))
    }

    /// Whether anything but the primitive `from` lies within `distance` along `ray`.
    #[inline]
    pub(crate) fn blocked(&self, ray: &Ray, distance: f32, from: Option<PrimitiveId>) -> bool {
        let is_blocked = if self.has_any_hits {
            let any_hit = |primitive, coords| self.any_hit(ray, primitive, coords);
            self.accel.occluded_where(ray, distance, from, any_hit)
        } else {
            self.accel.occluded(ray, distance, from)
        };
        is_blocked
            || (!self.listed_lights.is_empty() && self.closest_listed(ray, distance).is_some())
    }

    /// Whether nothing lies between two points; a surface through the second is ignored.
    #[inline]
    pub(crate) fn sees(&self, from: Vec3, to: Vec3) -> bool {
        let way = to - from;
        let distance = way.length();
        let ray = Ray {
            origin: from,
            direction: way / distance,
        };
        !(distance > 0.0 && self.blocked(&ray, distance * (1.0 - 1e-4), None))
    }

    /// Whether anything lies between `surface` and the point `p_light`, which lies in the direction
    /// `wi`.
    #[inline]
    #[must_use]
    pub fn occluded(&self, surface: &Surface, wi: Vec3, p_light: Vec3) -> bool {
        /// The tested part of the way: it ends before the light itself.
        const PART: f32 = 1.0 - 1e-4;
        let origin = surface.spawn(wi).origin;
        let way = p_light - origin;
        let distance = way.length();
        let ray = Ray {
            origin,
            direction: way / distance,
        };
        distance > 0.0 && self.blocked(&ray, distance * PART, Some(surface.primitive))
    }
}
