//! What of a thin slanted sheet of lights is above a horizon.

use light_math::float;

use crate::importance::child_importance::Displacement;
use crate::importance::child_view::{ChildView, Sheet};
use crate::importance::horizon::{HalfHeight, Horizon};
use crate::lane_math::{dot, larger};

/// How far the mean position counts as moved toward that of what is above the horizon, for the
/// distance. Chosen by V: see `docs/light-bvh-study.md`.
pub(crate) const NEARER: f32 = 0.3;

/// The least variance along a normal, over that of the box without correlations.
pub(crate) const LEAST_THICKNESS: f32 = 0.05;

impl Horizon {
    /// From the point to what of the child is above the horizon, and its [`lift`](Self::lift).
    ///
    /// Of lights whose heights vary by `sigma^2`, evenly filling `root(3) sigma` on either side of
    /// their mean, those above the horizon have their mean higher by
    /// `raised = (root(3) sigma - height) / 2`. Regression on the height moves it by
    /// `covariance n / sigma^2` times that.
    #[inline(always)]
    pub(crate) fn above(
        &self,
        child: &ChildView,
        height: &HalfHeight,
        sheet: &Sheet,
    ) -> (Displacement, f32) {
        let n = self.normal().to_array();
        let [hx, hy, hz] = child.extent;
        let [tx, ty, tz] = [n[0] * hx, n[1] * hy, n[2] * hz];
        let [xy, yz, zx] = sheet.correlations;
        // Three times the covariance of height and position, and the variance of height.
        let ux = hx * (tx + xy * ty + zx * tz);
        let uy = hy * (ty + xy * tx + yz * tz);
        let uz = hz * (tz + zx * tx + yz * ty);
        let of_box = dot(&[tx, ty, tz], &[tx, ty, tz]);
        let variance = dot(&n, &[ux, uy, uz]);
        let variance = larger(
            f32::MIN_POSITIVE,
            larger(LEAST_THICKNESS * of_box, variance),
        );
        let [vx, vy, vz] = child.mean;
        let above = 0.5 * (float::sqrt(variance) - dot(&n, &child.mean));
        let raised = larger(0.0, above) / variance;
        let lift = raised * dot(&child.axis, &[ux, uy, uz]);
        let nearer = NEARER * raised;
        let (sx, sy, sz) = (nearer * ux, nearer * uy, nearer * uz);
        // The squared length of `mean + shift` less that of `mean`.
        let farther = sx * (2.0 * vx + sx) + sy * (2.0 * vy + sy) + sz * (2.0 * vz + sz);
        let dist_sq = sheet.is_sheet.select(
            larger(child.dist_sq + farther, LEAST_THICKNESS * child.dist_sq),
            child.dist_sq,
        );
        let from = Displacement {
            axis_dot_mean: child.axis_dot_mean,
            dist: float::sqrt(dist_sq),
            dist_sq,
        };
        let lift = sheet.is_sheet.select(lift, self.lift(child, height));
        (from, lift)
    }
}

#[cfg(all(test, feature = "alloc"))]
mod tests;
