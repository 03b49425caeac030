use core::time::Duration;

use lights::glam::Vec3A;
use lights::math;
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::builder::{build_bvh2, build_bvh2_from_tris};
use obvhs::bvh2::leaf_collapser::collapse;
use obvhs::bvh2::{Bvh2, DEFAULT_MAX_STACK_DEPTH};
use obvhs::triangle::Triangle;

use super::agglomerate::{agglomerate, is_chained};

/// A box as the builders take it.
pub(super) fn boxed(bounds: &math::Aabb) -> Aabb {
    Aabb::new(bounds.min.into(), bounds.max.into())
}

/// A hierarchy over triangles, padded.
pub(super) fn over_triangles(triangles: &[Triangle], params: BvhBuildParams) -> Bvh2 {
    let boxes: Vec<Aabb> = triangles.iter().map(Triangle::aabb).collect();
    finished(if is_chained(&boxes) {
        plain(&boxes, params)
    } else {
        build_bvh2_from_tris(triangles, params, &mut Duration::default())
    })
}

/// A hierarchy over boxes, padded.
pub(super) fn over_boxes(boxes: &[Aabb], params: BvhBuildParams) -> Bvh2 {
    finished(if is_chained(boxes) {
        plain(boxes, params)
    } else {
        build_bvh2(boxes, params, &mut Duration::default())
    })
}

/// A hierarchy over boxes for which the default builder takes quadratic time and a depth linear in
/// the number of boxes.
fn plain(boxes: &[Aabb], params: BvhBuildParams) -> Bvh2 {
    let mut bvh = agglomerate(boxes);
    let most = params.max_prims_per_leaf;
    if most > 1 {
        collapse(&mut bvh, most, params.collapse_traversal_cost);
    }
    bvh
}

/// Enlarges each box by its rounding error, so that a ray along an edge of a box cannot miss its
/// content, and sets the depth of the traversal stack.
fn finished(mut bvh: Bvh2) -> Bvh2 {
    for node in &mut bvh.nodes {
        let mut aabb = *node.aabb();
        let margin = aabb.min.abs().max(aabb.max.abs()) * Vec3A::splat(2.0 * f32::EPSILON);
        aabb.min -= margin;
        aabb.max += margin;
        node.set_aabb(aabb);
    }
    bvh.max_depth = DEFAULT_MAX_STACK_DEPTH.max(depth(&bvh) + 1);
    bvh
}

/// The depth of the tree: the largest number of nodes on a path from the root.
fn depth(bvh: &Bvh2) -> usize {
    let mut deepest = 0;
    let mut waiting = vec![(0, 1)];
    while let Some((index, depth)) = waiting.pop() {
        let Some(node) = bvh.nodes.get(index as usize) else {
            continue;
        };
        deepest = deepest.max(depth);
        if !node.is_leaf() {
            waiting.extend([node.first_index, node.first_index + 1].map(|i| (i, depth + 1)));
        }
    }
    deepest
}

#[cfg(test)]
mod tests {
    use super::*;

    const COUNT: u16 = 5000;

    fn boxes(of: impl Fn(f32) -> (Vec3A, Vec3A)) -> Vec<Aabb> {
        let corners = (0..COUNT).map(|i| of(f32::from(i)));
        corners.map(|(min, max)| Aabb::new(min, max)).collect()
    }

    /// Sets whose nearest neighbours form chains: coincident, in a row, pairs in a row, around one
    /// corner.
    fn chains() -> [(&'static str, Vec<Aabb>); 4] {
        let at = |x: f32| (Vec3A::X * x, Vec3A::X * x + Vec3A::splat(0.5));
        let rim = |i: f32| {
            let (sin, cos) = (i / f32::from(COUNT) * core::f32::consts::TAU).sin_cos();
            Vec3A::new(cos, sin, 0.0)
        };
        let sliver = |i: f32| {
            let corners = [Vec3A::X, rim(i + 1.0), rim(i + 2.0)];
            let min = corners.into_iter().fold(Vec3A::X, Vec3A::min);
            (min, corners.into_iter().fold(Vec3A::X, Vec3A::max))
        };
        [
            ("alike", boxes(|_| at(0.0))),
            ("a row", boxes(at)),
            ("pairs", boxes(|i| at(i + 0.25 * (i % 2.0)))),
            ("a fan", boxes(sliver)),
        ]
    }

    fn scattered() -> Vec<Aabb> {
        boxes(|i| {
            let min = (Vec3A::new(0.618_034, 0.754_878, 0.569_840) * i).fract();
            (min, min + 0.01)
        })
    }

    #[test]
    fn chains_make_no_deep_hierarchies() {
        for (name, boxes) in chains() {
            assert!(is_chained(&boxes), "{name}: a chain");
            for params in [BvhBuildParams::medium_build(), BvhBuildParams::slow_build()] {
                let bvh = over_boxes(&boxes, params);
                let depth = depth(&bvh);
                assert!(depth < 40, "{name}: {depth} levels of {COUNT} boxes");
                let mut found = bvh.primitive_indices.clone();
                found.sort_unstable();
                assert!(
                    found.into_iter().eq(0..u32::from(COUNT)),
                    "{name}: each once"
                );
                let root = bvh.nodes[0].aabb();
                let is_inside =
                    |b: &Aabb| b.min.cmpge(root.min).all() && b.max.cmple(root.max).all();
                assert!(boxes.iter().all(is_inside), "{name}: within the root");
            }
        }
    }

    #[test]
    fn what_is_scattered_is_no_chain() {
        assert!(!is_chained(&scattered()), "built as ever");
    }

    #[test]
    fn children_lie_within_their_parents() {
        for boxes in chains()
            .into_iter()
            .map(|(_, boxes)| boxes)
            .chain([scattered()])
        {
            let bvh = agglomerate(&boxes);
            for node in bvh.nodes.iter().filter(|node| !node.is_leaf()) {
                let first = node.first_index as usize;
                let [a, b] = [first, first + 1].map(|i| *bvh.nodes[i].aabb());
                assert_eq!(a.union(&b), *node.aabb(), "as small as can be");
            }
        }
    }
}
