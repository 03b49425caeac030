mod agglomerate;
mod build;
mod bvh_hit;
mod geometry;
mod hit;
mod instance_transform;
mod instances;
mod quadric_bvh;
mod quadric_leaf;
mod quadric_shape;
#[cfg(test)]
mod tests;
mod triangle_bvh;

use core::fmt;
use core::ops::Range;

use lights::glam::{Vec2, Vec3};

use crate::{PrimitiveId, Ray};
use geometry::{Geometry, Numbers};
pub use hit::Hit;
pub use instance_transform::InstanceTransform;
use instances::Instances;
pub use instances::Prototype;
pub use quadric_shape::QuadricShape;

/// Intersects rays with triangles and quadrics: geometry in world space, and instances of
/// prototypes.
///
/// All triangles have smaller numbers than all quadrics. Among each, primitives in world space come
/// before those of prototypes.
#[derive(Default)]
pub struct Accel {
    world: Geometry,
    instances: Instances,
}

impl Accel {
    /// A hierarchy over the corners of `triangles`; their numbers are the positions in the slice.
    ///
    /// # Panics
    /// Panics at 2^32 triangles.
    #[must_use]
    pub fn new(triangles: &[[Vec3; 3]]) -> Self {
        Self::with_quadrics_and_prototypes(triangles, &[], Vec::new())
    }

    /// As [`new`](Self::new), with quadrics, and with instances of prototypes.
    ///
    /// # Panics
    /// Panics at 2^32 primitives.
    #[must_use]
    pub(crate) fn with_quadrics_and_prototypes(
        triangles: &[[Vec3; 3]],
        quadrics: &[QuadricShape],
        prototypes: Vec<Prototype>,
    ) -> Self {
        let instanced = prototypes.iter().map(|prototype| prototype.triangles.len());
        let count = triangles.len() + instanced.sum::<usize>();
        let mut next = Numbers {
            triangle: 0,
            quadric: u32::try_from(count).expect("fewer than 2^32 triangles"),
        };
        let world = Geometry::new(triangles, quadrics, &mut next);
        let instances = Instances::new(prototypes, next);
        Self { world, instances }
    }

    /// The first hit of `ray`, leaving out the primitive `from` that the ray starts on; `None` if
    /// it hits nothing.
    #[inline]
    #[must_use]
    pub fn closest(&self, ray: &Ray, from: Option<PrimitiveId>) -> Option<Hit> {
        self.closest_where(ray, from, |_, _| true)
    }

    /// [`closest`](Self::closest) among the hits that `any_hit` accepts. It receives the primitive
    /// and the coordinates on it, as [`Hit::coords`] defines them.
    #[inline]
    #[must_use]
    pub(crate) fn closest_where(
        &self,
        ray: &Ray,
        from: Option<PrimitiveId>,
        any_hit: impl Fn(PrimitiveId, Vec2) -> bool,
    ) -> Option<Hit> {
        let filter = |number, coords| any_hit(PrimitiveId::new(number), coords);
        let hit = self
            .world
            .closest(ray, f32::INFINITY, from_in_world(from), filter);
        let hit = hit.map(|hit| Hit {
            primitive: PrimitiveId::new(hit.number),
            t: hit.t,
            coords: hit.coords,
        });
        if self.instances.is_empty() {
            return hit;
        }
        let t_max = hit.map_or(f32::INFINITY, |hit| hit.t);
        self.instances.closest(ray, t_max, from, &any_hit).or(hit)
    }

    /// Whether anything but the primitive `from` lies between the start of `ray` and the distance
    /// `t_max` along it, in scene units.
    #[inline]
    #[must_use]
    pub fn occluded(&self, ray: &Ray, t_max: f32, from: Option<PrimitiveId>) -> bool {
        self.occluded_where(ray, t_max, from, |_, _| true)
    }

    /// [`occluded`](Self::occluded) by a hit that `any_hit` accepts. It receives the primitive and
    /// the coordinates on it, as [`Hit::coords`] defines them.
    #[inline]
    #[must_use]
    pub(crate) fn occluded_where(
        &self,
        ray: &Ray,
        t_max: f32,
        from: Option<PrimitiveId>,
        any_hit: impl Fn(PrimitiveId, Vec2) -> bool,
    ) -> bool {
        let filter = |number, coords| any_hit(PrimitiveId::new(number), coords);
        self.world.occluded(ray, t_max, from_in_world(from), filter)
            || (!self.instances.is_empty() && self.instances.occluded(ray, t_max, from, &any_hit))
    }

    /// The transform of an instance.
    ///
    /// # Panics
    /// Panics if there is no such instance.
    #[inline]
    #[must_use]
    pub(crate) fn instance_transform(&self, instance: u32) -> &InstanceTransform {
        self.instances.transform(instance)
    }

    /// The position of an instance among the transforms of all prototypes, in the order in which
    /// they were given: the hierarchy has another.
    ///
    /// # Panics
    /// Panics if there is no such instance.
    #[inline]
    #[must_use]
    pub(crate) fn instance_position(&self, instance: u32) -> u32 {
        self.instances.position(instance)
    }

    /// The numbers of the triangles and of the quadrics in world space.
    #[must_use]
    pub(crate) fn world(&self) -> [Range<u32>; 2] {
        self.world.numbers()
    }

    /// The numbers of the triangles and of the quadrics in every instance.
    #[must_use]
    pub(crate) fn instances(&self) -> impl ExactSizeIterator<Item = [Range<u32>; 2]> {
        self.instances.geometry().map(Geometry::numbers)
    }

    /// How many prototypes there are.
    #[must_use]
    pub fn prototype_count(&self) -> usize {
        self.instances.prototype_count()
    }
}

/// The number of the primitive that a ray starts on, if it is one in world space.
#[inline]
fn from_in_world(from: Option<PrimitiveId>) -> Option<u32> {
    from.filter(|from| from.instance().is_none())
        .map(PrimitiveId::number)
}

impl fmt::Debug for Accel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Accel")
            .field("world", &self.world.count())
            .field("instances", &self.instances.geometry().len())
            .finish_non_exhaustive()
    }
}
