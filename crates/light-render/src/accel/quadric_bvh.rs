use lights::glam::{DVec3, Vec2, Vec3};
use lights::math::octahedral;
use lights::sources::shape::{Shape, Sphere};
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::ray::{Ray as ObvhsRay, RayHit};

use super::build::{boxed, over_boxes};
use super::bvh_hit::BvhHit;
use crate::Ray;

/// A binary hierarchy of boxes over spheres that are stored leaf by leaf.
#[derive(Default)]
pub(super) struct SphereBvh {
    bvh: Bvh2,
    /// Spheres in leaf order.
    leaves: Vec<Leaf>,
}

#[derive(Clone, Copy)]
struct Leaf {
    center: Vec3,
    radius: f32,
}

/// The part of a line inside of a sphere, in double precision: differences of squares lose digits
/// for large or distant spheres.
struct Chord {
    direction: DVec3,
    /// From the centre to the middle of the chord.
    middle: DVec3,
    /// Distance along the ray to the middle, and from there to both ends.
    t: f64,
    half: f64,
}

impl SphereBvh {
    /// A hierarchy over `spheres`, whose numbers are the positions in the slice.
    pub(super) fn new(spheres: &[Sphere]) -> Self {
        if spheres.is_empty() {
            return Self::default();
        }
        let boxes: Vec<_> = spheres.iter().map(|s| boxed(&s.bounds())).collect();
        let params = BvhBuildParams::medium_build();
        let bvh = over_boxes(&boxes, params);
        let leaf = |&i: &u32| {
            let sphere = &spheres[i as usize];
            Leaf {
                center: sphere.center(),
                radius: sphere.radius(),
            }
        };
        let leaves = bvh.primitive_indices.iter().map(leaf).collect();
        Self { bvh, leaves }
    }

    #[inline]
    pub(super) fn is_empty(&self) -> bool {
        self.leaves.is_empty()
    }

    /// The first hit of `ray` nearer than `t_max` that `any_hit` accepts, by sphere and octahedral
    /// coordinates. Of the sphere `from`, on which the ray starts, only the opposite side is hit.
    // Not inlined: most scenes have no spheres.
    #[inline(never)]
    pub(super) fn closest(
        &self,
        ray: &Ray,
        t_max: f32,
        from: Option<u32>,
        any_hit: impl Fn(u32, Vec2) -> bool,
    ) -> Option<BvhHit> {
        let bare = ObvhsRay::new(ray.origin.into(), ray.direction.into(), 0.0, t_max);
        let mut hit = RayHit::none();
        self.bvh.ray_traverse(bare, &mut hit, |bare, slot| {
            self.distance(ray, bare.tmax, slot, from, &any_hit)
        });
        let leaf = self.leaves.get(hit.primitive_id as usize)?;
        Some(BvhHit {
            number: self.bvh.primitive_indices[hit.primitive_id as usize],
            t: hit.t,
            coords: leaf.chord(ray)?.coords(hit.t),
        })
    }

    /// Whether any hit that [`closest`](Self::closest) could return is nearer than `t_max`.
    #[inline(never)]
    pub(super) fn occluded(
        &self,
        ray: &Ray,
        t_max: f32,
        from: Option<u32>,
        any_hit: impl Fn(u32, Vec2) -> bool,
    ) -> bool {
        let bare = ObvhsRay::new(ray.origin.into(), ray.direction.into(), 0.0, t_max);
        !self.bvh.ray_traverse_miss(bare, |_, slot| {
            self.distance(ray, t_max, slot, from, &any_hit)
        })
    }

    /// The distance to the sphere in `slot`, infinite without an accepted hit before `t_max`.
    #[inline(always)]
    fn distance(
        &self,
        ray: &Ray,
        t_max: f32,
        slot: usize,
        from: Option<u32>,
        any_hit: impl Fn(u32, Vec2) -> bool,
    ) -> f32 {
        let Some(chord) = self.leaves[slot].chord(ray) else {
            return f32::INFINITY;
        };
        let number = self.bvh.primitive_indices[slot];
        let [enters, leaves] = chord.ends();
        let starts_here = from == Some(number);
        // Rounding decides where a ray enters that starts there; whether it goes inward is certain.
        let accepts = |t: f32| t > 0.0 && t < t_max && any_hit(number, chord.coords(t));
        if !starts_here && accepts(enters) {
            enters
        } else if !(starts_here && chord.t <= 0.0) && accepts(leaves) {
            leaves
        } else {
            f32::INFINITY
        }
    }
}

impl Leaf {
    /// The chord of the line of `ray` in the sphere.
    #[inline]
    fn chord(&self, ray: &Ray) -> Option<Chord> {
        let [origin, direction] = [ray.origin, ray.direction].map(|v| v.as_dvec3());
        let to_center = self.center.as_dvec3() - origin;
        let length_sq = direction.length_squared();
        let t = to_center.dot(direction) / length_sq;
        let middle = direction * t - to_center;
        let radius = f64::from(self.radius);
        let half_sq = radius * radius - middle.length_squared();
        (half_sq >= 0.0).then(|| Chord {
            direction,
            middle,
            t,
            half: (half_sq / length_sq).sqrt(),
        })
    }
}

impl Chord {
    /// Where the ray enters the sphere and where it leaves it.
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "distances are single")]
    fn ends(&self) -> [f32; 2] {
        [(self.t - self.half) as f32, (self.t + self.half) as f32]
    }

    /// The octahedral coordinates of the end at distance `t`, seen from the centre.
    #[inline]
    fn coords(&self, t: f32) -> Vec2 {
        let half = if t == self.ends()[0] {
            -self.half
        } else {
            self.half
        };
        let from_center = self.middle + self.direction * half;
        octahedral::to_square(from_center.normalize_or_zero().as_vec3())
    }
}
