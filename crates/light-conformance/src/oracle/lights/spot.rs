use super::super::warp::{polar, smoothstep, smoothstep_sample, uniform_cone};
use super::at_point::{AtPoint, Directional};
use super::fields::number;
use crate::oracle::Jitter;
use crate::{Case, Malformed};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Full intensity within a cone that falls off to a wider one, by the cubic step of the cosine.
pub(super) struct Spot {
    scale: f64,
    /// The angles at which the intensity starts to fall and is zero.
    start: f64,
    end: f64,
}

pub(super) fn spot(case: &Case<'_>) -> Result<AtPoint<Spot>, Malformed> {
    let spot = Spot {
        scale: number(case, "scale")?,
        start: number(case, "falloff_start_deg")?.to_radians(),
        end: number(case, "total_width_deg")?.to_radians(),
    };
    AtPoint::new(case, spot)
}

fn one_minus_cos(angle: f64) -> f64 {
    2.0 * (0.5 * angle).sin().powi(2)
}

impl Spot {
    fn falloff(&self, w: DVec3) -> f64 {
        let x = one_minus_cos(f64::atan2(w.truncate().length(), w.z));
        let (start, end) = (one_minus_cos(self.start), one_minus_cos(self.end));
        if x <= start {
            1.0
        } else if x >= end {
            0.0
        } else {
            smoothstep((end - x) / (end - start))
        }
    }

    /// The integral of the falloff: the cubic step has the mean 1/2.
    fn solid_angle(&self) -> f64 {
        PI * (one_minus_cos(self.start) + one_minus_cos(self.end))
    }
}

impl Directional for Spot {
    fn intensity(&self, w: DVec3) -> DVec3 {
        DVec3::splat(self.scale * self.falloff(w))
    }

    fn power(&self) -> DVec3 {
        DVec3::splat(self.scale * self.solid_angle())
    }

    /// The second pair chooses between the core and the rest, the first one the place there.
    fn sample(&self, u1: DVec2, u2: DVec2, jitter: &mut Jitter) -> Option<DVec3> {
        let (start, end) = (one_minus_cos(self.start), one_minus_cos(self.end));
        let core = TAU * start / self.solid_angle();
        let u1 = jitter.numbers(u1);
        if jitter.numbers(u2).x < core {
            return Some(uniform_cone(u1, start));
        }
        let x = end - (end - start) * smoothstep_sample(u1.x);
        Some(polar(jitter.at_scale(x, end).max(0.0), u1.y))
    }

    fn pdf(&self, w: DVec3) -> f64 {
        self.falloff(w) / self.solid_angle()
    }

    fn bounds(&self) -> ([f64; 3], bool) {
        let phi = 4.0 * PI * self.scale;
        ([phi, self.start.cos(), (self.end - self.start).cos()], true)
    }
}
