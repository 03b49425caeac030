mod place;
mod placements;
#[cfg(test)]
mod tests;
mod triangle_bvh;

use core::fmt;
use core::ops::Range;

use lights::glam::{Vec2, Vec3};

use crate::{PrimitiveId, Ray};
pub use place::Place;
use placements::Placements;
pub use placements::Prototype;
use triangle_bvh::TriangleBvh;

/// Where a ray meets the scene first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// What it meets.
    pub primitive: PrimitiveId,
    /// Distance along the ray, in scene units.
    pub t: f32,
    /// Weights of the triangle's second and third corner; the first has the rest.
    pub barycentric: Vec2,
}

/// Answers where rays meet triangles: those that stand where they are stored, and those that stand in several places.
#[derive(Default)]
pub struct Accel {
    world: TriangleBvh,
    placements: Placements,
}

impl Accel {
    /// A hierarchy over the corners of `triangles`; their numbers are the positions in the slice.
    ///
    /// # Panics
    /// Panics at 2^32 triangles.
    #[must_use]
    pub fn new(triangles: &[[Vec3; 3]]) -> Self {
        Self::with_prototypes(triangles, [])
    }

    /// As [`new`](Self::new), with prototypes in their places; their triangles are numbered on, one prototype after the other.
    ///
    /// # Panics
    /// Panics at 2^32 triangles.
    #[must_use]
    pub fn with_prototypes(
        triangles: &[[Vec3; 3]],
        prototypes: impl IntoIterator<Item = Prototype>,
    ) -> Self {
        let world = TriangleBvh::new(triangles);
        let placements = Placements::new(prototypes, world.triangle_count());
        Self { world, placements }
    }

    /// The first hit of `ray`, leaving out the primitive `from` that the ray starts on.
    #[inline]
    #[must_use]
    pub fn closest(&self, ray: &Ray, from: Option<PrimitiveId>) -> Option<Hit> {
        self.closest_where(ray, from, |_, _| true)
    }

    /// [`closest`](Self::closest), where only those hits count of which `is_there` says so, by primitive and barycentric coordinates.
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
            barycentric: hit.barycentric,
        });
        if self.placements.is_empty() {
            return hit;
        }
        let t_max = hit.map_or(f32::INFINITY, |hit| hit.t);
        self.placements.closest(ray, t_max, from, &is_there).or(hit)
    }

    /// Whether anything but the primitive `from` lies between the start of `ray` and the distance `t_max` along it.
    #[inline]
    #[must_use]
    pub fn occluded(&self, ray: &Ray, t_max: f32, from: Option<PrimitiveId>) -> bool {
        self.occluded_where(ray, t_max, from, |_, _| true)
    }

    /// [`occluded`](Self::occluded), where only those hits count of which `is_there` says so, by primitive and barycentric coordinates.
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

    /// The numbers of the triangles in every placement.
    #[must_use]
    pub fn placements(&self) -> impl ExactSizeIterator<Item = Range<u32>> {
        self.placements.numbers()
    }

    /// How many prototypes there are.
    #[must_use]
    pub fn prototype_count(&self) -> usize {
        self.placements.prototype_count()
    }

    /// How many triangles stand where they are stored.
    #[must_use]
    pub const fn world_triangle_count(&self) -> u32 {
        self.world.triangle_count()
    }
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
            .field("triangles", &self.world.triangle_count())
            .field("placements", &self.placements.numbers().len())
            .finish_non_exhaustive()
    }
}
