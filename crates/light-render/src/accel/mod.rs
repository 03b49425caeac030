mod agglomerate;
mod build;
mod bvh_hit;
mod place;
mod placements;
mod solids;
mod sphere_bvh;
#[cfg(test)]
mod tests;
mod triangle_bvh;

use core::fmt;
use core::ops::Range;

use lights::glam::{Vec2, Vec3};
use lights::math::Aabb;
use lights::sources::shape::Sphere;
use obvhs::aabb::Aabb as ObvhsAabb;

use crate::{PrimitiveId, Ray};
pub use place::Place;
use placements::Placements;
pub use placements::Prototype;
use solids::{Numbers, Solids};

/// Where a ray meets the scene first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// What it meets.
    pub primitive: PrimitiveId,
    /// Distance along the ray, in scene units.
    pub t: f32,
    /// Where on it: of a triangle the weights of its second and third corner, the first has the
    /// rest; of a sphere the place of its outward normal, before it was placed, on the
    /// [octahedral square](lights::math::octahedral::to_square).
    pub place: Vec2,
}

/// Answers where rays meet triangles and spheres: those that stand where they are stored, and those
/// that stand in several places.
///
/// All triangles have numbers before all spheres; among each, those that stand where they are
/// stored come first.
#[derive(Default)]
pub struct Accel {
    world: Solids,
    placements: Placements,
}

impl Accel {
    /// A hierarchy over the corners of `triangles`; their numbers are the positions in the slice.
    ///
    /// # Panics
    /// Panics at 2^32 triangles.
    #[must_use]
    pub fn new(triangles: &[[Vec3; 3]]) -> Self {
        Self::with_spheres_and_prototypes(triangles, &[], Vec::new())
    }

    /// As [`new`](Self::new), with spheres, and with prototypes in their places.
    ///
    /// # Panics
    /// Panics at 2^32 primitives.
    #[must_use]
    pub fn with_spheres_and_prototypes(
        triangles: &[[Vec3; 3]],
        spheres: &[Sphere],
        prototypes: Vec<Prototype>,
    ) -> Self {
        let placed = prototypes.iter().map(|prototype| prototype.triangles.len());
        let count = triangles.len() + placed.sum::<usize>();
        let mut next = Numbers {
            triangle: 0,
            sphere: u32::try_from(count).expect("fewer than 2^32 triangles"),
        };
        let world = Solids::new(triangles, spheres, &mut next);
        let placements = Placements::new(prototypes, next);
        Self { world, placements }
    }

    /// The first hit of `ray`, leaving out the primitive `from` that the ray starts on.
    #[inline]
    #[must_use]
    pub fn closest(&self, ray: &Ray, from: Option<PrimitiveId>) -> Option<Hit> {
        self.closest_where(ray, from, |_, _| true)
    }

    /// [`closest`](Self::closest), where only those hits count of which `is_there` says so, by
    /// primitive and place.
    #[inline]
    #[must_use]
    pub fn closest_where(
        &self,
        ray: &Ray,
        from: Option<PrimitiveId>,
        is_there: impl Fn(PrimitiveId, Vec2) -> bool,
    ) -> Option<Hit> {
        let there = |number, place| is_there(PrimitiveId::new(number), place);
        let hit = self
            .world
            .closest(ray, f32::INFINITY, in_the_world(from), there);
        let hit = hit.map(|hit| Hit {
            primitive: PrimitiveId::new(hit.number),
            t: hit.t,
            place: hit.place,
        });
        if self.placements.is_empty() {
            return hit;
        }
        let t_max = hit.map_or(f32::INFINITY, |hit| hit.t);
        self.placements.closest(ray, t_max, from, &is_there).or(hit)
    }

    /// Whether anything but the primitive `from` lies between the start of `ray` and the distance
    /// `t_max` along it.
    #[inline]
    #[must_use]
    pub fn occluded(&self, ray: &Ray, t_max: f32, from: Option<PrimitiveId>) -> bool {
        self.occluded_where(ray, t_max, from, |_, _| true)
    }

    /// [`occluded`](Self::occluded), where only those hits count of which `is_there` says so, by
    /// primitive and place.
    #[inline]
    #[must_use]
    pub fn occluded_where(
        &self,
        ray: &Ray,
        t_max: f32,
        from: Option<PrimitiveId>,
        is_there: impl Fn(PrimitiveId, Vec2) -> bool,
    ) -> bool {
        let there = |number, place| is_there(PrimitiveId::new(number), place);
        self.world.occluded(ray, t_max, in_the_world(from), there)
            || (!self.placements.is_empty()
                && self.placements.occluded(ray, t_max, from, &is_there))
    }

    /// Where a placement stands.
    ///
    /// # Panics
    /// Panics if there is no such placement.
    #[inline]
    #[must_use]
    pub fn place(&self, placement: u32) -> &Place {
        self.placements.place(placement)
    }

    /// The numbers of the triangles and of the spheres that stand where they are stored.
    #[must_use]
    pub fn world(&self) -> [Range<u32>; 2] {
        self.world.numbers()
    }

    /// The numbers of the triangles and of the spheres in every placement.
    #[must_use]
    pub fn placements(&self) -> impl ExactSizeIterator<Item = [Range<u32>; 2]> {
        self.placements.solids().map(Solids::numbers)
    }

    /// How many prototypes there are.
    #[must_use]
    pub fn prototype_count(&self) -> usize {
        self.placements.prototype_count()
    }
}

fn boxed(bounds: &Aabb) -> ObvhsAabb {
    ObvhsAabb::new(bounds.min.into(), bounds.max.into())
}

/// The number of what a ray starts on, if that stands where it is stored.
#[inline]
fn in_the_world(from: Option<PrimitiveId>) -> Option<u32> {
    from.filter(|from| from.placement().is_none())
        .map(PrimitiveId::number)
}

impl fmt::Debug for Accel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Accel")
            .field("world", &self.world.count())
            .field("placements", &self.placements.solids().len())
            .finish_non_exhaustive()
    }
}
