//! How far rounding moves a cone that unions in single precision have made.

use super::cone::ExactCone;
use std::f64::consts::PI;

/// How far each step of a union may round its result: an angle, a cosine or a unit vector.
const STEP: f64 = 4.0 * f32::EPSILON as f64;

/// What our unions subtract from the cosine, so that a parent holds its children.
const WIDENED: f64 = 4.0 * f32::EPSILON as f64;

/// The distance of a cone in single precision from the exact one; none for a light's own cone.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ConeRounding {
    /// Angle between the two axes.
    pub(crate) axis: f64,
    cos_theta: f64,
}

impl ConeRounding {
    /// That of the union of two cones which are as far from exact as `moved` says.
    ///
    /// The union turns the first axis by half of `between + b - a` in the plane of both axes. Half
    /// of the errors of these three angles is one part of the error. The other is the plane's: an
    /// axis that is moved by `e` turns the plane by `e / sin(between)`, which is large where the
    /// axes are almost opposite, and that moves the new axis by the sine of the turn times as much.
    pub(crate) fn of_union([v, w]: [ExactCone; 2], moved: [Self; 2]) -> Self {
        let [a, b] = [v, w].map(|cone| half_angle(cone.cos_theta));
        let cross = v.w.normalize().cross(w.w.normalize()).length();
        let between = f64::atan2(cross, v.w.dot(w.w));
        // One cone holds the other.
        if (between + b).min(PI) <= a {
            return moved[0];
        }
        if (between + a).min(PI) <= b {
            return moved[1];
        }
        let axes = moved[0].axis + moved[1].axis;
        let half = (0.5 * (a + between + b)).min(PI);
        let half_error = 0.5 * (moved[0].spread(v) + moved[1].spread(w) + axes + STEP);
        let plane = (axes / cross + STEP).min(PI);
        let turn = 0.5 * (between + b - a);
        Self {
            axis: moved[0].axis + half_error + turn.sin() * plane + STEP,
            cos_theta: half.sin() * half_error + WIDENED + STEP,
        }
    }

    /// How far the half angle moves with its cosine.
    fn spread(self, cone: ExactCone) -> f64 {
        let [most, exact, least] =
            [-1.0, 0.0, 1.0].map(|side| half_angle(cone.cos_theta + side * self.cos_theta));
        (most - exact).max(exact - least) + STEP
    }
}

fn half_angle(cos_theta: f64) -> f64 {
    cos_theta.clamp(-1.0, 1.0).acos()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn the_error_grows_with_the_inverse_sine_between_the_axes() {
        let cone = |angle: f64| ExactCone {
            w: DVec3::new(angle.sin(), 0.0, angle.cos()),
            cos_theta: 1.0,
        };
        let moved = ConeRounding {
            axis: 1e-6,
            cos_theta: 0.0,
        };
        let error = |angle: f64| ConeRounding::of_union([cone(0.0), cone(angle)], [moved; 2]).axis;
        assert!(error(0.5 * PI) < 1e-5, "{}", error(0.5 * PI));
        let opposite = error(PI - 0.02);
        assert!((1e-4..1.2e-4).contains(&opposite), "{opposite}");
    }

    #[test]
    fn a_cone_that_holds_the_other_is_kept() {
        let [wide, narrow] = [0.5, 0.9].map(|cos_theta| ExactCone {
            w: DVec3::Z,
            cos_theta,
        });
        let moved = [1.0, 2.0].map(|axis| ConeRounding {
            axis,
            cos_theta: 0.0,
        });
        let first = ConeRounding::of_union([wide, narrow], moved);
        let second = ConeRounding::of_union([narrow, wide], moved);
        assert_eq!([first.axis, second.axis], [1.0, 2.0], "the wide one");
    }
}
