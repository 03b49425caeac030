//! Directions toward a rectangle, uniform in solid angle.

use crate::float::{atan2, inverse_power_of_two, sin, sqrt};
use glam::{Vec2, Vec3};

/// A rectangle projected to the unit sphere around a point.
///
/// Samples are places on the rectangle, from `(0, 0)` at its corner to `(1, 1)` at the opposite
/// one; the direction is from the point to the place. The density is the same everywhere, so the
/// pdf needs no argument.
///
/// # Source
/// `[Urena2013]`: `u.x` cuts off a part of the area by a line across, `u.y` walks along that line.
/// Differences of nearly equal angles cost the paper's formulas their digits where the rectangle is
/// small; a step or two of Newton's method, on areas computed without such differences, gives them
/// back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphericalRectangle {
    /// Lower corner in the frame of the rectangle, with the point as origin, and lengths of the
    /// edges, in a unit near the largest of all lengths.
    low: Vec2,
    size: Vec2,
    /// Distance of the point from the plane.
    height: f32,
    solid_angle: f32,
}

impl SphericalRectangle {
    /// The rectangle with the given `corner` and perpendicular edges `ex`, `ey`, seen from `p`;
    /// none if it covers no solid angle there.
    #[must_use]
    pub fn new(corner: Vec3, ex: Vec3, ey: Vec3, p: Vec3) -> Option<Self> {
        let d = corner - p;
        // All results are ratios: in a unit near the largest length no product of four overflows,
        // and none vanishes that is not small beside the others.
        let largest = d.abs().max(ex.abs()).max(ey.abs()).max_element();
        let scale = inverse_power_of_two(largest);
        let (d, ex, ey) = (d * scale, ex * scale, ey * scale);
        let size = Vec2::new(ex.length(), ey.length());
        let (x, y) = (ex / size.x, ey / size.y);
        let low = Vec2::new(d.dot(x), d.dot(y));
        let height = d.dot(x.cross(y)).abs();
        let mut this = Self {
            low,
            size,
            height,
            solid_angle: 0.0,
        };
        this.solid_angle = this.area_up_to(1.0);
        (this.solid_angle > 0.0 && height > 0.0).then_some(this)
    }

    /// The solid angle in steradians, above 0 and at most `2 pi`.
    #[inline]
    #[must_use]
    pub fn solid_angle(&self) -> f32 {
        self.solid_angle
    }

    /// The place on the rectangle, in `[0, 1]^2`, for `u`.
    #[must_use]
    pub fn sample(&self, u: Vec2) -> Vec2 {
        let area = u.x * self.solid_angle;
        let x = newton(self.cut(area), |x| {
            let line = self.line(x);
            let slope = self.size.x * self.height * line.share(1.0) / line.dist_sq;
            // From the nearer end, so that what is subtracted is small.
            let excess = if u.x <= 0.5 {
                self.area_between(0.0, x) - area
            } else {
                (1.0 - u.x) * self.solid_angle - self.area_between(x, 1.0)
            };
            (excess / slope, sqrt(line.dist_sq) / self.size.x)
        });

        let line = self.line(x);
        let share = line.share(1.0);
        let y = newton(line.place(u.y), |y| {
            let dist = line.dist(self.low.y + y * self.size.y);
            let slope = self.size.y * line.dist_sq / (dist * dist * dist);
            let excess = if u.y <= 0.5 {
                line.share(y) - u.y * share
            } else {
                (1.0 - u.y) * share - line.share_between(y, 1.0)
            };
            (excess / slope, dist / self.size.y)
        });
        Vec2::new(x, y)
    }

    /// The density per solid angle of all samples, `1 / solid_angle`.
    #[inline]
    #[must_use]
    pub fn pdf(&self) -> f32 {
        1.0 / self.solid_angle
    }

    /// The `u` in `[0, 1]^2` that [`sample`](Self::sample) takes to the place `at` on the
    /// rectangle.
    #[must_use]
    pub fn invert(&self, at: Vec2) -> Vec2 {
        let line = self.line(at.x);
        let u = Vec2::new(
            self.area_up_to(at.x) / self.solid_angle,
            line.share(at.y) / line.share(1.0),
        );
        if u.is_finite() {
            u.clamp(Vec2::ZERO, Vec2::ONE)
        } else {
            at
        }
    }

    /// The solid angle of the part from the lower end to the place `x`.
    fn area_up_to(&self, x: f32) -> f32 {
        self.area_between(0.0, x)
    }

    /// The solid angle of the part between two places of x.
    fn area_between(&self, from: f32, to: f32) -> f32 {
        let columns = halves(self.low.x + from * self.size.x, (to - from) * self.size.x);
        let rows = halves(self.low.y, self.size.y);
        let mut sum = 0.0;
        for column in columns.into_iter().flatten() {
            for row in rows.into_iter().flatten() {
                sum += quadrant(column, row, self.height);
            }
        }
        sum
    }

    /// The place of the cut with the given area below it.
    ///
    /// The area from the foot of the point to `x` is `asin(sin y1 sin x) - asin(sin y0 sin x)` in
    /// angles seen from the point; this is `[Urena2013]`, solved for the tangent of x, with
    /// differences of cosines as products of sines. The second one belongs to the supplement of the
    /// sum of y0 and y1.
    fn cut(&self, area: f32) -> f32 {
        let (h, x, y0) = (self.height, self.low.x, self.low.y);
        let y1 = y0 + self.size.y;
        let difference = atan2(h * self.size.y, h * h + y0 * y1);
        let sum = atan2(h * (y0 + y1).abs(), y0 * y1 - h * h);

        let line = self.line(0.0);
        let (r0, r1) = (line.dist(y0), line.dist(y1));
        let before = atan2(
            x * h * line.share(1.0) * r0 * r1,
            h * h * r0 * r1 + x * x * y0 * y1,
        );
        let angle = before + area;
        // Half of cos(angle) - cos(other).
        let excess = |other: f32| sin(0.5 * (other + angle)) * sin(0.5 * (other - angle));
        let squared = (4.0 * excess(difference) * excess(sum)).max(f32::MIN_POSITIVE);
        let x = h * sin(angle) / sqrt(squared);
        unit((x - self.low.x) / self.size.x)
    }

    /// The line across the rectangle at the place `x`.
    fn line(&self, x: f32) -> Line {
        let x = self.low.x + x * self.size.x;
        Line {
            low: self.low.y,
            size: self.size.y,
            dist_sq: x * x + self.height * self.height,
        }
    }
}

/// A line segment seen from a point: from `low` to `low + size` along it, `dist_sq` from the point.
struct Line {
    low: f32,
    size: f32,
    dist_sq: f32,
}

impl Line {
    /// The difference of the sines of the elevation between the lower end and the place `y`.
    fn share(&self, y: f32) -> f32 {
        self.share_between(0.0, y)
    }

    /// The difference of the sines of the elevation between two places.
    fn share_between(&self, from: f32, to: f32) -> f32 {
        let (low, width) = (self.low + from * self.size, (to - from) * self.size);
        let high = low + width;
        let (r0, r1) = (self.dist(low), self.dist(high));
        if low * high > 0.0 {
            width * (low + high) * self.dist_sq / (r0 * r1 * (high * r0 + low * r1))
        } else {
            high / r1 - low / r0
        }
    }

    /// The place with the share `u` of the whole below it, as `[Urena2013]` finds it.
    fn place(&self, u: f32) -> f32 {
        let share = self.share(1.0);
        let sine = self.low / self.dist(self.low) + u * share;
        // 1 + sine from the lower end and 1 - sine from the upper one, where they are smallest.
        let below = self.one_minus_sine(-self.low) + u * share;
        let above = self.one_minus_sine(self.low + self.size) + (1.0 - u) * share;
        let y = sine * sqrt(self.dist_sq / (below * above).max(f32::MIN_POSITIVE));
        unit((y - self.low) / self.size)
    }

    /// One minus the sine of the elevation at the distance `y` from the foot.
    fn one_minus_sine(&self, y: f32) -> f32 {
        let r = self.dist(y);
        if y > 0.0 {
            self.dist_sq / (r * (r + y))
        } else {
            1.0 - y / r
        }
    }

    fn dist(&self, y: f32) -> f32 {
        sqrt(self.dist_sq + y * y)
    }
}

/// The parts of an interval on both sides of 0, each as its distance from 0 and its width.
fn halves(low: f32, width: f32) -> [Option<[f32; 2]>; 2] {
    let high = low + width;
    if low >= 0.0 {
        [Some([low, width]), None]
    } else if high <= 0.0 {
        [None, Some([-high, width])]
    } else {
        [Some([0.0, high]), Some([0.0, -low])]
    }
}

/// The solid angle of a rectangle within one quadrant around the foot of the point: nothing here is
/// subtracted, since no two directions are more than a right angle apart.
fn quadrant([x, width]: [f32; 2], [y, length]: [f32; 2], height: f32) -> f32 {
    let r = [
        (x, y),
        (x + width, y),
        (x + width, y + length),
        (x, y + length),
    ];
    let r = r.map(|(x, y)| Vec3::new(x, y, height));
    let l = r.map(Vec3::length);
    // Half the solid angles of the two triangles beside the diagonal, which span the same volume
    // with the point.
    let sin = height * width * length;
    let diagonal = l[0] * l[2] + r[0].dot(r[2]);
    let cos = |i: usize| diagonal * l[i] + r[i].dot(r[0]) * l[2] + r[i].dot(r[2]) * l[0];
    2.0 * (atan2(sin, cos(1)) + atan2(sin, cos(3)))
}

/// The part of the reach below which a step of Newton's method is taken.
pub(super) const NEWTON_REACH: f32 = 0.25;

/// The square of a step, over the reach, below which the next step would change nothing.
pub(super) const NEWTON_PRECISION: f32 = 1e-6;

/// Newton's method within `[0, 1]` from `x` on, for the step at a place and its reach, the scale on
/// which slopes change: a step that is not well within it means that `x` is as good as `u` allows
/// already. One step does, unless it is so long that the slope changed on its way.
fn newton(mut x: f32, step_and_reach: impl Fn(f32) -> (f32, f32)) -> f32 {
    for _ in 0..2 {
        let (step, reach) = step_and_reach(x);
        if !(step.abs() < NEWTON_REACH * reach) {
            break;
        }
        x = unit(x - step);
        if step * step < NEWTON_PRECISION * reach {
            break;
        }
    }
    x
}

/// `x` forced into `[0, 1]`; 1/2 for NaN.
fn unit(x: f32) -> f32 {
    if x.is_nan() { 0.5 } else { x.clamp(0.0, 1.0) }
}
