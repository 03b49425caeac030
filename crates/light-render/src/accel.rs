use core::fmt;
use core::time::Duration;

use lights::glam::{Vec2, Vec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::ray::{Ray as ObvhsRay, RayHit};
use obvhs::rt_triangle::RtTriangle;
use obvhs::triangle::Triangle;

use crate::Ray;

/// The number of a triangle, in the order in which they were given to [`Accel::new`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TriangleId(pub u32);

/// Where a ray meets the scene first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The triangle.
    pub triangle: TriangleId,
    /// Distance along the ray, in scene units.
    pub t: f32,
    /// Weights of the triangle's second and third corner; the first has the rest.
    pub barycentric: Vec2,
}

/// Answers where rays meet triangles: a binary hierarchy of boxes, with the triangles stored leaf by leaf.
pub struct Accel {
    bvh: Bvh2,
    /// Triangles in leaf order; one that was split stands in several leaves.
    leaves: Vec<RtTriangle>,
}

impl Accel {
    /// A hierarchy over the corners of `triangles`; [`TriangleId`] is the position in the slice.
    #[must_use]
    pub fn new(triangles: &[[Vec3; 3]]) -> Self {
        let triangles: Vec<Triangle> = triangles
            .iter()
            .map(|&[a, b, c]| Triangle {
                v0: a.into(),
                v1: b.into(),
                v2: c.into(),
            })
            .collect();
        if triangles.is_empty() {
            return Self {
                bvh: Bvh2::default(),
                leaves: Vec::new(),
            };
        }
        // Splitting pays most for the long triangles of buildings, but its memory does not suit the largest scenes.
        let params = if triangles.len() < 1 << 20 {
            BvhBuildParams::slow_build()
        } else {
            BvhBuildParams::medium_build()
        };
        let mut bvh = build_bvh2_from_tris(&triangles, params, &mut Duration::default());
        pad(&mut bvh);
        let leaves = bvh
            .primitive_indices
            .iter()
            .map(|&i| (&triangles[i as usize]).into())
            .collect();
        Self { bvh, leaves }
    }

    /// The first hit of `ray`, leaving out the triangle `from` that the ray starts on.
    #[inline]
    #[must_use]
    pub fn closest(&self, ray: &Ray, from: Option<TriangleId>) -> Option<Hit> {
        self.closest_where(ray, from, |_, _| true)
    }

    /// [`closest`](Self::closest), where only those hits count of which `is_there` says so, by triangle and barycentric coordinates.
    #[inline]
    #[must_use]
    pub fn closest_where(
        &self,
        ray: &Ray,
        from: Option<TriangleId>,
        is_there: impl Fn(TriangleId, Vec2) -> bool,
    ) -> Option<Hit> {
        let ray = ObvhsRay::new(ray.origin.into(), ray.direction.into(), 0.0, f32::INFINITY);
        let mut hit = RayHit::none();
        self.bvh.ray_traverse(ray, &mut hit, |ray, slot| {
            self.distance(ray, slot, from, &is_there)
        });
        let leaf = self.leaves.get(hit.primitive_id as usize)?;
        Some(Hit {
            triangle: self.triangle(hit.primitive_id as usize),
            t: hit.t,
            barycentric: leaf.compute_barycentric(&ray),
        })
    }

    /// Whether anything but the triangle `from` lies between the start of `ray` and the distance `t_max` along it.
    #[inline]
    #[must_use]
    pub fn occluded(&self, ray: &Ray, t_max: f32, from: Option<TriangleId>) -> bool {
        self.occluded_where(ray, t_max, from, |_, _| true)
    }

    /// [`occluded`](Self::occluded), where only those hits count of which `is_there` says so, by triangle and barycentric coordinates.
    #[inline]
    #[must_use]
    pub fn occluded_where(
        &self,
        ray: &Ray,
        t_max: f32,
        from: Option<TriangleId>,
        is_there: impl Fn(TriangleId, Vec2) -> bool,
    ) -> bool {
        let ray = ObvhsRay::new(ray.origin.into(), ray.direction.into(), 0.0, t_max);
        !self
            .bvh
            .ray_traverse_miss(ray, |ray, slot| self.distance(ray, slot, from, &is_there))
    }

    /// The distance to the triangle in `slot`, infinite for a miss, for the triangle that the ray starts on, and for a hit that does not
    /// count.
    #[inline(always)]
    fn distance(
        &self,
        ray: &ObvhsRay,
        slot: usize,
        from: Option<TriangleId>,
        is_there: impl Fn(TriangleId, Vec2) -> bool,
    ) -> f32 {
        let leaf = &self.leaves[slot];
        let t = leaf.intersect(ray);
        if t < f32::INFINITY {
            let triangle = self.triangle(slot);
            if from == Some(triangle) || !is_there(triangle, leaf.compute_barycentric(ray)) {
                return f32::INFINITY;
            }
        }
        t
    }

    #[inline]
    fn triangle(&self, slot: usize) -> TriangleId {
        TriangleId(self.bvh.primitive_indices[slot])
    }
}

impl fmt::Debug for Accel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Accel")
            .field("nodes", &self.bvh.nodes.len())
            .field("leaves", &self.leaves.len())
            .finish()
    }
}

/// Enlarges each box by its rounding error, so that a ray along an edge of a box cannot slip past what is inside.
fn pad(bvh: &mut Bvh2) {
    for node in &mut bvh.nodes {
        let mut aabb = *node.aabb();
        let margin = aabb.min.abs().max(aabb.max.abs()) * Vec3A::splat(2.0 * f32::EPSILON);
        aabb.min -= margin;
        aabb.max += margin;
        node.set_aabb(aabb);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The square `[0, 1]^2` at height `z` as two triangles.
    fn square(z: f32) -> [[Vec3; 3]; 2] {
        let [a, b, c, d] =
            [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vec3::new(x, y, z));
        [[a, b, c], [a, c, d]]
    }

    fn two_squares() -> Accel {
        Accel::new(&[square(1.0), square(2.0)].concat())
    }

    fn down_z(x: f32, y: f32) -> Ray {
        Ray {
            origin: Vec3::new(x, y, 0.0),
            direction: Vec3::Z,
        }
    }

    #[test]
    fn the_closest_hit_knows_its_triangle_and_place() {
        let hit = two_squares()
            .closest(&down_z(0.75, 0.25), None)
            .expect("a hit");
        assert_eq!(
            (hit.triangle, hit.t),
            (TriangleId(0), 1.0),
            "the first square"
        );
        let [a, b, c] = square(1.0)[0];
        let Vec2 { x, y } = hit.barycentric;
        let p = a * (1.0 - x - y) + b * x + c * y;
        assert!(
            p.distance(Vec3::new(0.75, 0.25, 1.0)) < 1e-6,
            "weights of the corners"
        );
    }

    #[test]
    fn the_triangle_left_out_is_not_hit() {
        let hit = two_squares().closest(&down_z(0.75, 0.25), Some(TriangleId(0)));
        assert_eq!(
            hit.expect("a hit").triangle,
            TriangleId(2),
            "the one behind"
        );
    }

    #[test]
    fn occlusion_ends_at_its_limit() {
        let accel = two_squares();
        let ray = down_z(0.25, 0.75);
        assert!(accel.occluded(&ray, 1.5, None), "a square between");
        assert!(
            !accel.occluded(&ray, 0.5, None),
            "nothing before the square"
        );
        assert!(!accel.occluded(&ray, 1.5, Some(TriangleId(1))), "left out");
        assert!(accel.closest(&down_z(1.5, 0.5), None).is_none(), "beside");
    }

    #[test]
    fn an_empty_scene_is_missed() {
        let accel = Accel::new(&[]);
        assert!(
            accel.closest(&down_z(0.0, 0.0), None).is_none(),
            "nothing to hit"
        );
        assert!(
            !accel.occluded(&down_z(0.0, 0.0), 1.0, None),
            "nothing in the way"
        );
    }

    #[test]
    fn no_ray_slips_through_the_edges_of_a_mesh() {
        // A fan of triangles around odd numbers: rays at shared edges and corners must hit something.
        let corner = |i: u32, j: u32| Vec3::new(i as f32 * 0.1 + 0.37, j as f32 * 0.1 - 12.3, 7.0);
        let triangles: Vec<_> = (0..64u32)
            .flat_map(|k| {
                let (i, j) = (k % 8, k / 8);
                let [a, b, c, d] = [
                    corner(i, j),
                    corner(i + 1, j),
                    corner(i + 1, j + 1),
                    corner(i, j + 1),
                ];
                [[a, b, c], [a, c, d]]
            })
            .collect();
        let accel = Accel::new(&triangles);
        for k in 0..4096u32 {
            let [i, j] = [k % 64, k / 64].map(|n| (n as f32 + 0.5) / 64.0 * 0.7 + 0.05);
            let target = corner(0, 0) + Vec3::new(i, j, 0.0);
            let origin = Vec3::new(0.7, -11.9, 0.0);
            let ray = Ray {
                origin,
                direction: (target - origin).normalize(),
            };
            assert!(
                accel.closest(&ray, None).is_some(),
                "ray {k} towards {target}"
            );
        }
    }
}
