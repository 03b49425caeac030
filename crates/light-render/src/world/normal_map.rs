use lights::glam::{Vec2, Vec3};

use super::World;
use crate::Surface;

impl World {
    /// `surface`, at the coordinates `coords` of its primitive and seen from `wo`, with the shading
    /// normal of the material's normal map.
    // Not inlined: few scenes have normal maps.
    #[inline(never)]
    pub(super) fn with_normal_map(&self, surface: Surface, coords: Vec2, wo: Vec3) -> Surface {
        let (_, material) = self.material(surface.primitive);
        let Some(map) = &material.normal_map else {
            return surface;
        };
        let Some([t, b]) = self.tangents(&surface, coords, map.uv_set) else {
            return surface;
        };
        // The scale is that of the vector, not of the colour.
        let unscaled = light_scene::ColorImage {
            scale: Vec3::ONE,
            ..*map
        };
        let m = (2.0 * self.texel(&unscaled, surface.uvs()) - 1.0) * map.scale;
        let mapped = t * m.x + b * m.y + surface.ns * m.z;
        let side = if wo.dot(surface.n) < 0.0 { -1.0 } else { 1.0 };
        let mapped = mapped.normalize_or(surface.ns) * side;
        let ns = reflecting_upward(mapped, surface.n * side, wo) * side;
        Surface { ns, ..surface }
    }
}

/// The normal nearest to the unit vector `ns`, between it and the geometric normal `n`, that
/// mirrors the viewer's direction `wo` to the outer side of the surface: the viewer sees the front
/// of all facets, and no mirror image is black. `wo` is above the surface.
fn reflecting_upward(ns: Vec3, n: Vec3, wo: Vec3) -> Vec3 {
    /// The least cosine to `n` of the mirrored direction, unless `wo` itself is lower.
    const LEAST: f32 = 0.01;
    let Some(x) = ns.reject_from_normalized(n).try_normalize() else {
        return n;
    };
    // All in the plane of both normals, by angles from `n` toward `ns`. The mirrored direction has
    // the height `reach * cos(2 angle - of_viewer)`.
    let angle = ns.dot(x).atan2(ns.dot(n));
    let (along, height) = (wo.dot(x), wo.dot(n).max(0.0));
    let reach = along.hypot(height).max(f32::MIN_POSITIVE);
    let of_viewer = along.atan2(height);
    let widest = (LEAST.min(0.9 * height) / reach).clamp(0.0, 1.0).acos();
    let most = 0.5 * (of_viewer + widest);
    if angle <= most {
        return ns;
    }
    let (sin, cos) = most.max(0.0).sin_cos();
    n * cos + x * sin
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f32::consts::TAU;

    #[test]
    fn mirrored_directions_leave_the_surface_and_good_normals_stay() {
        let n = Vec3::Z;
        let mut kept = 0;
        for k in 0..4096u16 {
            let part = |by: f32| (f32::from(k) * by).fract();
            let toward = |height: f32, turn: f32| {
                let flat = (1.0 - height * height).sqrt();
                let (sin, cos) = (TAU * turn).sin_cos();
                Vec3::new(flat * cos, flat * sin, height)
            };
            let ns = toward(2.0 * part(0.618_034) - 1.0, part(0.754_878));
            let wo = toward(part(0.569_84).max(1e-3), part(0.819_173));
            let bent = reflecting_upward(ns, n, wo);
            assert!((bent.length() - 1.0).abs() < 1e-4, "a unit vector");
            assert!(wo.dot(bent) > 0.0, "{ns} from {wo}: the viewer sees {bent}");
            let mirrored = 2.0 * wo.dot(bent) * bent - wo;
            assert!(mirrored.z > 0.0, "{ns} from {wo}: {mirrored}");
            let before = 2.0 * wo.dot(ns) * ns - wo;
            if before.z > 0.011 && wo.dot(ns) > 0.0 {
                assert_eq!(bent, ns, "{ns} from {wo}: it was good");
                kept += 1;
            }
        }
        assert!(kept > 500, "{kept} normals stayed");
    }
}
