//! Cones of directions and the importance of bounds, by trigonometric functions.

use super::Jitter;
use glam::{DQuat, DVec3};
use lights::bounds::LightBounds;
use lights::math::glam::Vec3;
use std::f64::consts::PI;

/// An axis and the cosine of the half angle; above 1 for no direction at all.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ExactCone {
    pub(crate) w: DVec3,
    pub(crate) cos_theta: f64,
}

const WHOLE: ExactCone = ExactCone {
    w: DVec3::Z,
    cos_theta: -1.0,
};

impl ExactCone {
    pub(crate) fn new(w: Vec3, cos_theta: f32) -> Self {
        Self {
            w: w.as_dvec3(),
            cos_theta: f64::from(cos_theta),
        }
    }

    /// The smallest cone around both, with its axis in the plane of theirs.
    pub(crate) fn union(self, other: Self, jitter: &mut Jitter) -> Self {
        if self.cos_theta > 1.0 || other.cos_theta > 1.0 {
            return if self.cos_theta > 1.0 { other } else { self };
        }
        let [a, b] = [self, other].map(|c| c.cos_theta.clamp(-1.0, 1.0).acos());
        let (v, w) = (self.w.normalize(), other.w.normalize());
        let turn = v.cross(w);
        let between = jitter.at_scale(f64::atan2(turn.length(), v.dot(w)), 1.0);
        if (between + b).min(PI) <= a {
            return self;
        }
        if (between + a).min(PI) <= b {
            return other;
        }
        let half = 0.5 * (a + between + b);
        let is_turned = turn.length_squared() > 0.0;
        if half >= PI || !is_turned && v.dot(w) < 0.0 {
            return WHOLE;
        }
        if !is_turned {
            return if a >= b { self } else { other };
        }
        // The direction in which to turn is lost where the axes are opposite.
        let turn = jitter.vector(turn, 1.0).normalize();
        Self {
            w: DQuat::from_axis_angle(turn, half - a) * v,
            cos_theta: half.cos(),
        }
    }
}

/// The importance of `lb` at `p` with normal `n`, zero in a medium.
pub(crate) fn importance(lb: &LightBounds, [p, n]: [Vec3; 2], jitter: &mut Jitter) -> f64 {
    let [min, max, w, n] = [lb.bounds.min, lb.bounds.max, lb.w, n].map(|v| v.as_dvec3());
    let magnitude = p.abs().as_dvec3().max(min.abs()).max(max.abs());
    let center = 0.5 * (min + max);
    let to_p = jitter.vector(p.as_dvec3() - center, magnitude.max_element());
    let (dist, radius) = (to_p.length(), 0.5 * (max - min).length());
    let radius = jitter.relative(radius);
    let scale = f64::from(lb.phi) / (dist * dist).max(radius);
    if dist <= radius {
        return scale;
    }
    let theta_b = (radius / dist).asin();
    let cos_w = to_p.normalize().dot(w) / w.length();
    let theta_w = if lb.two_sided { cos_w.abs() } else { cos_w };
    let theta_w = theta_w.clamp(-1.0, 1.0).acos();
    let theta_o = f64::from(lb.cos_theta_o).clamp(-1.0, 1.0).acos();
    let cos_emission = (theta_w - theta_o - theta_b).max(0.0).cos();
    // Light at the very edge of the emission counts, and beside it may.
    let margin = cos_emission - f64::from(lb.cos_theta_e);
    if margin < -BESIDE || (margin < 0.0 && jitter.either(true, false)) {
        return 0.0;
    }
    let cos_incidence = if n == DVec3::ZERO {
        1.0
    } else {
        let theta_i = (n.dot(to_p) / dist).abs().min(1.0).acos();
        (theta_i - theta_b).max(0.0).cos()
    };
    // Light that may arrive matters, however little is left of its cosines.
    scale * cos_emission.max(LEAST_COSINE) * cos_incidence.max(LEAST_COSINE)
}

/// What bounds promise to take for a cosine of light that may arrive, so that rounding drops none.
const LEAST_COSINE: f64 = 2e-6;

/// How far beyond it light may count: bounds promise so much, as their axis may be too short by
/// rounding.
const BESIDE: f64 = 2e-5;
