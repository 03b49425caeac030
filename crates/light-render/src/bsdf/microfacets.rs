use core::f32::consts::{PI, TAU};

use lights::glam::{Vec2, Vec3};

/// A microfacet surface with the GGX (Trowbridge-Reitz) distribution of normals.
///
/// # Source
/// `[PBRT4]`, section 9.6; visible normals as in `[Heitz2018]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Microfacets {
    alpha: Vec2,
}

impl Microfacets {
    /// Roughness `alpha` along x and y; below 0.001 on both axes the surface counts as smooth.
    #[must_use]
    pub fn new(alpha: Vec2) -> Self {
        Self {
            alpha: alpha.max(Vec2::splat(1e-4)),
        }
    }

    /// Whether the surface counts as perfectly smooth.
    #[inline]
    #[must_use]
    pub(crate) fn is_smooth(&self) -> bool {
        self.alpha.max_element() < 1e-3
    }

    /// The larger of both roughnesses.
    #[inline]
    pub(super) fn alpha(&self) -> f32 {
        self.alpha.max_element()
    }

    /// Area of facets with normal `wm` per area of surface and solid angle.
    #[inline]
    pub(super) fn d(&self, wm: Vec3) -> f32 {
        let cos_squared = wm.z * wm.z;
        let slope = Vec2::new(wm.x, wm.y) / self.alpha;
        let e = slope.length_squared() + cos_squared;
        // As cos^4 (1 + tan^2 ...)^2, with the cosine multiplied in: no division by a grazing
        // cosine.
        1.0 / (PI * self.alpha.x * self.alpha.y * e * e)
    }

    /// Lambda, the auxiliary function of Smith's masking.
    #[inline]
    fn lambda(&self, w: Vec3) -> f32 {
        let stretched = Vec2::new(w.x, w.y) * self.alpha;
        let tan_squared = stretched.length_squared() / (w.z * w.z);
        if tan_squared.is_finite() {
            0.5 * ((1.0 + tan_squared).sqrt() - 1.0)
        } else {
            f32::INFINITY
        }
    }

    /// Smith's masking function: the share of facets visible from `w`.
    #[inline]
    #[must_use]
    pub(crate) fn g1(&self, w: Vec3) -> f32 {
        1.0 / (1.0 + self.lambda(w))
    }

    /// Height-correlated masking and shadowing: the share of facets visible from `wo` and `wi`.
    #[inline]
    pub(super) fn g(&self, wo: Vec3, wi: Vec3) -> f32 {
        1.0 / (1.0 + self.lambda(wo) + self.lambda(wi))
    }

    /// Density in sr^-1 of the normal `wm` among those that are seen from `w`.
    #[inline]
    pub(super) fn visible_pdf(&self, w: Vec3, wm: Vec3) -> f32 {
        self.g1(w) / w.z.abs() * self.d(wm) * w.dot(wm).abs()
    }

    /// A normal among those that are seen from `w`, which is above the surface.
    #[inline]
    pub(super) fn sample_visible(&self, w: Vec3, u: Vec2) -> Vec3 {
        let stretch = self.alpha.extend(1.0);
        // Seen from the hemisphere that the stretched surface is, each normal is as likely as its
        // projected area.
        let wh = (w * stretch).normalize();
        let t1 = Vec3::Z.cross(wh).try_normalize().unwrap_or(Vec3::X);
        let t2 = wh.cross(t1);
        let (sin, cos) = (TAU * u.y).sin_cos();
        let r = u.x.sqrt();
        let (x, y) = (r * cos, r * sin);
        let h = (1.0 - x * x).max(0.0).sqrt();
        let s = 0.5 * (1.0 + wh.z);
        let y = h + (y - h) * s;
        let z = (1.0 - x * x - y * y).max(0.0).sqrt();
        let nh = t1 * x + t2 * y + wh * z;
        (nh * stretch).with_z(nh.z.max(1e-6)).normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_projected_area_of_all_facets_is_that_of_the_surface() {
        for alpha in [Vec2::splat(0.3), Vec2::new(0.1, 0.7)] {
            let facets = Microfacets::new(alpha);
            let n = 400;
            let mut sum = 0.0;
            for i in 0..n {
                for j in 0..n {
                    let cos = (i as f32 + 0.5) / n as f32;
                    let phi = (j as f32 + 0.5) / n as f32 * TAU;
                    let sin = (1.0 - cos * cos).sqrt();
                    let wm = Vec3::new(sin * phi.cos(), sin * phi.sin(), cos);
                    sum += facets.d(wm) * cos * TAU / (n * n) as f32;
                }
            }
            assert!((sum - 1.0).abs() < 5e-3, "{sum} for {alpha}");
        }
    }

    #[test]
    fn visible_normals_face_the_viewer() {
        let facets = Microfacets::new(Vec2::new(0.2, 0.6));
        let w = Vec3::new(0.9, 0.1, 0.2).normalize();
        for k in 0..256u16 {
            let u = Vec2::new(f32::from(k) / 256.0, (f32::from(k) * 0.618).fract());
            let wm = facets.sample_visible(w, u);
            assert!(wm.is_normalized() && wm.z > 0.0, "a normal: {wm}");
            assert!(w.dot(wm) > -1e-5, "that is seen");
        }
    }
}
