//! Spherical triangles and rectangles in double precision, by the formulas of the papers: the judge where the
//! reference's single precision is in doubt.

use lights::math::glam::{Vec2, Vec3};

type Real3 = [f64; 3];

fn real3(v: Vec3) -> Real3 {
    v.to_array().map(f64::from)
}

fn plus(a: Real3, b: Real3, times: f64) -> Real3 {
    core::array::from_fn(|i| a[i] + b[i] * times)
}

fn minus(a: Real3, b: Real3) -> Real3 {
    plus(a, b, -1.0)
}

fn dot(a: Real3, b: Real3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Real3, b: Real3) -> Real3 {
    core::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}

fn normalize(a: Real3) -> Real3 {
    a.map(|x| x / dot(a, a).sqrt())
}

/// The unit vector at right angles to `axis` in the plane of both.
fn across(v: Real3, axis: Real3) -> Real3 {
    normalize(plus(v, axis, -dot(v, axis)))
}

/// The angle between two vectors.
fn angle(a: Real3, b: Real3) -> f64 {
    let n = cross(a, b);
    f64::atan2(dot(n, n).sqrt(), dot(a, b))
}

/// A triangle seen from a point: Arvo 1995.
pub(super) struct ExactTriangle {
    /// Corners from the point, and their directions.
    r: [Real3; 3],
    d: [Real3; 3],
}

impl ExactTriangle {
    pub(super) fn new(v: [Vec3; 3], p: Vec3) -> Self {
        let r = v.map(|v| minus(real3(v), real3(p)));
        Self {
            r,
            d: r.map(normalize),
        }
    }

    pub(super) fn solid_angle(&self) -> f64 {
        let [a, b, c] = self.d;
        area(a, b, c)
    }

    /// Barycentric coordinates for `u`.
    pub(super) fn sample(&self, u: Vec2) -> Vec3 {
        let [a, b, c] = self.d;
        let (cut_area, u1) = (f64::from(u.x) * self.solid_angle(), f64::from(u.y));
        let alpha = angle(cross(a, b), cross(a, c));
        let (sin_alpha, cos_alpha) = alpha.sin_cos();
        let (s, t) = (cut_area - alpha).sin_cos();
        let u = t - cos_alpha;
        let v = s + sin_alpha * dot(a, b);
        let cos_cut = ((v * t - u * s) * cos_alpha - v) / ((v * s + u * t) * sin_alpha);
        let cos_cut = if u.abs() < 1e-15 {
            1.0
        } else {
            cos_cut.clamp(-1.0, 1.0)
        };
        let sin_cut = (1.0 - cos_cut * cos_cut).sqrt();
        let cut = plus(a.map(|x| x * cos_cut), across(c, a), sin_cut);
        let z = 1.0 - u1 * (1.0 - dot(cut, b));
        let w = plus(
            b.map(|x| x * z),
            across(cut, b),
            (1.0 - z * z).max(0.0).sqrt(),
        );

        let (e1, e2) = (minus(self.r[1], self.r[0]), minus(self.r[2], self.r[0]));
        let p = cross(w, e2);
        let q = cross(e1, self.r[0]);
        let scale = 1.0 / dot(e1, p);
        let (b1, b2) = (-dot(self.r[0], p) * scale, dot(w, q) * scale);
        Vec3::new((1.0 - b1 - b2) as f32, b1 as f32, b2 as f32)
    }

    /// The `u` of barycentric coordinates, not clamped.
    pub(super) fn invert(&self, b: Vec3) -> Vec2 {
        let weights = real3(b);
        let q: Real3 = core::array::from_fn(|i| (0..3).map(|k| weights[k] * self.r[k][i]).sum());
        let [a, b, c] = self.d;
        let w = normalize(q);
        let cut = normalize(cross(cross(b, w), cross(c, a)));
        let cut = if dot(cut, a) + dot(cut, c) < 0.0 {
            cut.map(|x| -x)
        } else {
            cut
        };
        let chord_sq = |a: Real3, b: Real3| dot(minus(a, b), minus(a, b));
        let x = area(a, b, cut) / self.solid_angle();
        Vec2::new(x as f32, (chord_sq(w, b) / chord_sq(cut, b)) as f32)
    }
}

/// The area of a spherical triangle.
fn area(a: Real3, b: Real3, c: Real3) -> f64 {
    let volume = dot(a, cross(minus(b, a), minus(c, a)));
    2.0 * f64::atan2(volume.abs(), 1.0 + dot(a, b) + dot(b, c) + dot(c, a))
}

/// A rectangle seen from a point.
pub(super) struct ExactRectangle {
    low: [f64; 2],
    size: [f64; 2],
    height: f64,
}

impl ExactRectangle {
    pub(super) fn new(corner: Vec3, ex: Vec3, ey: Vec3, p: Vec3) -> Self {
        let (d, ex, ey) = (minus(real3(corner), real3(p)), real3(ex), real3(ey));
        let (x, y) = (normalize(ex), normalize(ey));
        Self {
            low: [dot(d, x), dot(d, y)],
            size: [dot(ex, x), dot(ey, y)],
            height: dot(d, cross(x, y)).abs(),
        }
    }

    pub(super) fn solid_angle(&self) -> f64 {
        self.area_up_to(1.0)
    }

    /// The place for `u`: both coordinates by bisection.
    pub(super) fn sample(&self, u: Vec2) -> Vec2 {
        let x = bisect(|x| self.area_up_to(x) - f64::from(u.x) * self.solid_angle());
        let y = bisect(|y| self.share(x, y) - f64::from(u.y) * self.share(x, 1.0));
        Vec2::new(x as f32, y as f32)
    }

    pub(super) fn invert(&self, at: Vec2) -> Vec2 {
        let (x, y) = (f64::from(at.x), f64::from(at.y));
        let u = self.area_up_to(x) / self.solid_angle();
        Vec2::new(u as f32, (self.share(x, y) / self.share(x, 1.0)) as f32)
    }

    fn area_up_to(&self, x: f64) -> f64 {
        let [x0, y0] = self.low;
        let (x1, y1) = (x0 + x * self.size[0], y0 + self.size[1]);
        let z = self.height;
        let corner = |x: f64, y: f64| f64::atan2(x * y, z * (x * x + y * y + z * z).sqrt());
        corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0)
    }

    fn share(&self, x: f64, y: f64) -> f64 {
        let x = self.low[0] + x * self.size[0];
        let sine = |y: f64| y / (x * x + y * y + self.height * self.height).sqrt();
        sine(self.low[1] + y * self.size[1]) - sine(self.low[1])
    }
}

/// The zero in `[0, 1]` of a rising function.
fn bisect(f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}
