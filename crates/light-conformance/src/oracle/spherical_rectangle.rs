use super::ExactTriangle;
use super::warp::bisect;
use glam::{DVec2, DVec3};

/// A rectangle seen from a point, as Urena et al. 2013 cut it: across by area, then along by the
/// sine of the elevation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ExactRectangle {
    low: DVec2,
    size: DVec2,
    height: f64,
}

impl ExactRectangle {
    pub(crate) fn new(corner: DVec3, ex: DVec3, ey: DVec3, p: DVec3) -> Self {
        let d = corner - p;
        let (x, y) = (ex.normalize(), ey.normalize());
        Self {
            low: DVec2::new(d.dot(x), d.dot(y)),
            size: DVec2::new(ex.length(), ey.length()),
            height: d.dot(x.cross(y)).abs(),
        }
    }

    pub(crate) fn solid_angle(&self) -> f64 {
        self.area_up_to(1.0)
    }

    /// The place for `u`, both coordinates in [0, 1].
    pub(crate) fn sample(&self, u: DVec2) -> DVec2 {
        let area = u.x * self.solid_angle();
        let x = bisect(|x| self.area_up_to(x) - area);
        let share = u.y * self.share(x, 1.0);
        DVec2::new(x, bisect(|y| self.share(x, y) - share))
    }

    /// The `u` of a place.
    pub(crate) fn invert(&self, at: DVec2) -> DVec2 {
        DVec2::new(
            self.area_up_to(at.x) / self.solid_angle(),
            self.share(at.x, at.y) / self.share(at.x, 1.0),
        )
    }

    fn area_up_to(&self, x: f64) -> f64 {
        let corner = |x: f64, y: f64| (self.low + DVec2::new(x, y) * self.size).extend(self.height);
        let triangle = |a, b, c| ExactTriangle::new([a, b, c], DVec3::ZERO).solid_angle();
        let [a, b, c, d] = [
            corner(0.0, 0.0),
            corner(x, 0.0),
            corner(x, 1.0),
            corner(0.0, 1.0),
        ];
        triangle(a, b, c) + triangle(a, c, d)
    }

    /// The difference of the sines of the elevation between the lower end of the line at `x` and
    /// the place `y` on it.
    fn share(&self, x: f64, y: f64) -> f64 {
        let x = self.low.x + x * self.size.x;
        let dist_sq = x * x + self.height * self.height;
        let (low, high) = (self.low.y, self.low.y + y * self.size.y);
        let [l, h] = [low, high].map(|y| (dist_sq + y * y).sqrt());
        if low * high > 0.0 {
            (high - low) * (low + high) * dist_sq / (l * h * (high * l + low * h))
        } else {
            high / h - low / l
        }
    }
}
