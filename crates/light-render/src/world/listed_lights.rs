use lights::bounds::LightId;

use super::World;
use crate::{PrimitiveId, Ray, Surface};

impl World {
    /// The first point nearer than `t_max` where `ray` hits a light of the scene's list that is no
    /// mesh: each says itself where, one after the other.
    // Not inlined: most scenes have no such lights.
    #[inline(never)]
    pub(super) fn closest_listed(&self, ray: &Ray, mut t_max: f32) -> Option<Surface> {
        let mut closest = None;
        let first = u32::try_from(self.triangles.len() + self.quadrics.len()).ok()?;
        for (number, &id) in (first..).zip(&self.listed_lights) {
            let light = self.lights.get(id)?;
            let Some(at) = light.hit(ray.origin, ray.direction) else {
                continue;
            };
            let t = (at.p - ray.origin).dot(ray.direction);
            if t > 0.0 && t < t_max {
                t_max = t;
                closest = Some(Surface::on_light(PrimitiveId::new(number), &at));
            }
        }
        closest
    }

    /// The light of the surface with this number behind those of triangles and quadrics.
    pub(super) fn listed_light(&self, number: usize) -> Option<LightId> {
        self.listed_lights.get(number).copied()
    }
}
