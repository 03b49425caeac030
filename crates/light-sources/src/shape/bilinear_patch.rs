use super::bilinear_patch_error::BilinearPatchError;
use super::flat_quad::FlatQuad;
use super::normal::{normal_length, unit_normal};
use super::patch_area;
use super::rounding::{is_in_plane, is_within_rounding};
use super::solid_angle::{LEAST_DENSITY, area_to_solid_angle};
use super::{Shape, ShapeDirectionSample, ShapeSample, UvArea, UvDensity};
use crate::glam::{Vec2, Vec3};
use crate::surface_point::SurfacePoint;
use light_bounds::LightSampleContext;
use light_math::warp::bilinear;
use light_math::{Aabb, DirectionCone};

/// A bilinear patch: the surface that a straight line sweeps while its ends run along two opposite
/// sides of any quadrilateral, planar or not. Its front is the side of the cross product of the
/// derivatives along u and v.
///
/// A flat convex patch is sampled as two triangles; of others points are sampled by area, nearly
/// uniformly. Where a patch covers a direction twice, only the first hit is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BilinearPatch {
    pub(super) p00: Vec3,
    /// Derivative along u at v = 0.
    pub(super) du: Vec3,
    /// Derivative along v at u = 0.
    pub(super) dv: Vec3,
    /// How both change along the other parameter; 0 for a parallelogram.
    pub(super) duv: Vec3,
    area: f32,
    bend: Bend,
}

/// Whether a patch is a part of a plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Bend {
    /// A flat convex quadrilateral.
    Flat,
    /// Any other patch.
    Twisted,
}

impl BilinearPatch {
    /// The patch with the corners at (u, v) = (0, 0), (1, 0), (0, 1), (1, 1).
    ///
    /// # Errors
    /// When a corner is not finite, the patch has no area, or it is flat and two sides cross.
    pub fn new([p00, p10, p01, p11]: [Vec3; 4]) -> Result<Self, BilinearPatchError> {
        const ROUNDED: f32 = 1.0 + 1e-3;
        if ![p00, p10, p01, p11].iter().all(|p| p.is_finite()) {
            return Err(BilinearPatchError::Corner);
        }
        let mut patch = Self {
            p00,
            du: p10 - p00,
            dv: p01 - p00,
            duv: (p11 - p01) - (p10 - p00),
            area: 0.0,
            bend: Bend::Twisted,
        };
        patch.area = patch_area::integrate(|uv| patch.area_density(uv));
        patch.bend = patch.measure_bend();
        // Normals are means of those at the corners and not longer than them: any excess is the
        // rounding error of a patch without area.
        let most = patch.weights().into_iter().fold(0.0, f32::max);
        let is_area = patch.area.is_finite() && (1.0 / patch.area).is_finite();
        if !(is_area && patch.area <= ROUNDED * most) {
            return Err(BilinearPatchError::Area);
        }
        if patch.is_crossed() {
            return Err(BilinearPatchError::Crossed);
        }
        Ok(patch)
    }

    /// The corners at (u, v) = (0, 0), (1, 0), (0, 1), (1, 1).
    #[must_use]
    pub fn corners(&self) -> [Vec3; 4] {
        CORNERS.map(|uv| self.point(uv))
    }

    /// The patch in another unit of length, for rays only: its area stays as it is.
    pub(super) fn scaled(&self, scale: f32) -> Self {
        Self {
            p00: self.p00 * scale,
            du: self.du * scale,
            dv: self.dv * scale,
            duv: self.duv * scale,
            ..*self
        }
    }

    fn point(&self, uv: Vec2) -> Vec3 {
        self.p00 + self.du * uv.x + (self.dv + self.duv * uv.x) * uv.y
    }

    /// The normal at `uv`, as long as the area per area of the parameters. It is affine in u and in
    /// v.
    fn scaled_normal(&self, uv: Vec2) -> Vec3 {
        (self.du + self.duv * uv.y).cross(self.dv + self.duv * uv.x)
    }

    /// Area per area of the parameters at `uv`.
    fn area_density(&self, uv: Vec2) -> f32 {
        normal_length(self.scaled_normal(uv))
    }

    fn at(&self, uv: Vec2) -> Option<SurfacePoint> {
        Some(SurfacePoint {
            p: self.point(uv),
            n: unit_normal(self.scaled_normal(uv))?,
            uv,
        })
    }

    /// Area per area of the parameters at the corners, by which points are chosen.
    fn weights(&self) -> [f32; 4] {
        CORNERS.map(|uv| self.area_density(uv))
    }

    fn pdf_at(&self, uv: Vec2) -> f32 {
        bilinear::pdf(uv, self.weights()) / self.area_density(uv)
    }

    /// Unit direction and density of the point at `uv`, which is chosen by area.
    fn by_area(&self, uv: Vec2, to_light: Vec3) -> Option<(Vec3, f32)> {
        let (wi, pdf) = area_to_solid_angle(self.pdf_at(uv), to_light, self.at(uv)?.n)?;
        let least = match self.bend {
            Bend::Flat => LEAST_DENSITY,
            Bend::Twisted => 0.0,
        };
        Some((wi, pdf.max(least)))
    }

    /// Flat where all normals at the corners are the same, up to rounding of the corners.
    fn measure_bend(&self) -> Bend {
        let normals = CORNERS.map(|uv| unit_normal(self.scaled_normal(uv)));
        let tolerance = self.normal_rounding();
        let is_same = |n: Option<Vec3>| {
            let pair = n.zip(normals[0]);
            pair.is_some_and(|(a, b)| a.distance(b) <= tolerance)
        };
        if normals.into_iter().all(is_same) {
            Bend::Flat
        } else {
            Bend::Twisted
        }
    }

    /// How far the rounding of the corners turns a unit normal, at most a hundredth.
    fn normal_rounding(&self) -> f32 {
        let corners = CORNERS.map(|uv| self.point(uv).abs().max_element());
        let sides = [self.du, self.dv, self.du + self.duv, self.dv + self.duv].map(normal_length);
        let largest = |of: [f32; 4]| of.into_iter().fold(0.0, f32::max);
        let height = self.weights().into_iter().fold(f32::MAX, f32::min) / largest(sides);
        (1e-6 + 4.0 * f32::EPSILON * largest(corners) / height).min(0.01)
    }

    /// Whether the patch is flat and two opposite sides cross: around a flat quadrilateral all
    /// corners turn the same way, or all but one, or those beside a crossing one way and the others
    /// the other.
    fn is_crossed(&self) -> bool {
        const TOLERANCE: f32 = 1e-3;
        let [Some(n), others @ ..] = CORNERS.map(|uv| unit_normal(self.scaled_normal(uv))) else {
            return false;
        };
        let turns = |n: Vec3| {
            others
                .into_iter()
                .flatten()
                .filter(move |other| other.distance(n) <= TOLERANCE)
        };
        turns(n).count() == 1 && turns(-n).count() == 2
    }

    /// Whether the receiver may be a point of the plane of a flat patch.
    fn is_own(&self, ctx: &LightSampleContext) -> bool {
        let normal = || unit_normal(self.scaled_normal(Vec2::ZERO));
        self.bend == Bend::Flat && normal().is_some_and(|n| is_in_plane(ctx, self.p00, n))
    }

    /// The view of a flat patch that is not small.
    fn flat(&self, ctx: &LightSampleContext) -> Option<FlatQuad> {
        match self.bend {
            Bend::Flat => FlatQuad::new(ctx, self.corners()),
            Bend::Twisted => None,
        }
    }
}

impl Shape for BilinearPatch {
    fn area(&self) -> f32 {
        self.area
    }

    fn bounds(&self) -> Aabb {
        Aabb::from_points(self.corners())
    }

    /// The normals lie in the cone of those at the corners: they are their means.
    fn normal_cone(&self) -> DirectionCone {
        let normals = CORNERS.map(|uv| unit_normal(self.scaled_normal(uv)));
        let normals = normals.into_iter().flatten();
        let sum = normals.clone().sum::<Vec3>();
        // A sum of opposite normals is rounding error, not an axis.
        if !(sum.length() > 1e-3) {
            return DirectionCone::WHOLE_SPHERE;
        }
        let axis = sum.normalize();
        let cos_theta = normals.map(|n| n.dot(axis)).fold(1.0, f32::min);
        // A cone wider than a half space is not convex and gives no bound.
        if cos_theta > 0.0 {
            DirectionCone::new(axis, cos_theta)
        } else {
            DirectionCone::WHOLE_SPHERE
        }
    }

    fn uv_area(&self) -> UvArea {
        let n = self.scaled_normal(Vec2::ZERO);
        let along = [Vec2::X, Vec2::Y].map(|uv| self.scaled_normal(uv) - n);
        UvArea::Square(UvDensity::Length([n, along[0], along[1]]))
    }

    fn sample(&self, u: Vec2) -> Option<ShapeSample> {
        let uv = bilinear::sample(u, self.weights());
        let at = self.at(uv)?;
        let pdf = self.pdf_at(uv);
        (pdf > 0.0 && pdf.is_finite()).then_some(ShapeSample { at, pdf })
    }

    fn pdf(&self, at: &SurfacePoint) -> f32 {
        self.pdf_at(at.uv)
    }

    /// Of a patch that is not flat, a point by area, unless another part of the patch hides it, or
    /// it is at such a grazing angle that a ray toward it misses.
    fn sample_toward(&self, ctx: &LightSampleContext, u: Vec2) -> Option<ShapeDirectionSample> {
        if self.is_own(ctx) {
            return None;
        }
        if let Some(flat) = self.flat(ctx) {
            let sample = flat.sample(ctx, u)?;
            let (uv, _) = self.intersect(ctx.p, sample.wi)?;
            let at = SurfacePoint { uv, ..sample.at };
            return Some(ShapeDirectionSample { at, ..sample });
        }
        let ShapeSample { at, .. } = self.sample(u)?;
        // Not by way of `at.p`, whose rounding grows with the coordinates of the scene.
        let to_light = self.along(self.p00 - ctx.p, at.uv);
        let (wi, pdf) = self.by_area(at.uv, to_light)?;
        if self.bend == Bend::Twisted || is_within_rounding(wi, to_light, &at) {
            let (met, t) = self.intersect(ctx.p, wi)?;
            // A ray that meets the patch twice meets it from both sides, even in a flat patch that
            // folds over itself, where both are as far away.
            if self.scaled_normal(met).dot(wi) * at.n.dot(wi) < 0.0 {
                return None;
            }
            // At the silhouette a rounding of the direction changes the density by much.
            let (_, pdf) = self.by_area(met, wi * t)?;
            return Some(ShapeDirectionSample { at, wi, pdf });
        }
        Some(ShapeDirectionSample { at, wi, pdf })
    }

    fn pdf_toward(&self, ctx: &LightSampleContext, wi: Vec3) -> f32 {
        if self.is_own(ctx) {
            return 0.0;
        }
        if let Some(flat) = self.flat(ctx) {
            return flat.pdf(ctx, wi);
        }
        let pdf = || {
            let (uv, t) = self.intersect(ctx.p, wi)?;
            self.by_area(uv, wi * t)
        };
        pdf().map_or(0.0, |(_, pdf)| pdf)
    }

    fn hit(&self, origin: Vec3, direction: Vec3) -> Option<SurfacePoint> {
        let (uv, _) = self.intersect(origin, direction)?;
        self.at(uv)
    }
}

/// The corners in the order of the weights of [`bilinear`].
const CORNERS: [Vec2; 4] = [Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::ONE];
