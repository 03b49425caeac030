use core::f64::consts::{PI, TAU};

use light_math::glam::{Affine3A, DMat3, DVec2, DVec3};

/// A surface in double precision, as its description defines it.
#[derive(Clone, Copy, Debug)]
pub(super) enum Surface {
    /// Vertices, and surface parameters at them.
    Triangle([DVec3; 3], [DVec2; 3]),
    /// Corners at (u, v) = (0, 0), (1, 0), (0, 1), (1, 1).
    Quad([DVec3; 4]),
    /// A radius.
    Sphere(RigidFrame, f64),
    /// The radii of the rim and of the hole.
    Disk(RigidFrame, [f64; 2]),
    /// A radius and a length.
    Cylinder(RigidFrame, [f64; 2]),
}

/// An orthonormal frame, which may be left-handed, and its origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct RigidFrame {
    axes: DMat3,
    pub(super) origin: DVec3,
}

/// A point of a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) p: DVec3,
    /// Unit normal of the front.
    pub(super) n: DVec3,
    /// Area per area of the unit square.
    pub(super) density: f64,
    pub(super) uv: DVec2,
}

impl RigidFrame {
    /// The axes of a transform, made exact as those of a light: its axis z is kept.
    pub(super) fn new(transform: Affine3A) -> Self {
        let m = transform.matrix3;
        let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis].map(|axis| axis.as_dvec3());
        let z = z.normalize();
        let x = (x - z * z.dot(x)).normalize();
        let side = z.cross(x).dot(y).signum();
        Self {
            axes: DMat3::from_cols(x, z.cross(x) * side, z),
            origin: transform.translation.as_dvec3(),
        }
    }

    pub(super) fn vector(&self, v: DVec3) -> DVec3 {
        self.axes * v
    }

    pub(super) fn inverse_vector(&self, v: DVec3) -> DVec3 {
        self.axes.transpose() * v
    }

    fn inverse_point(&self, p: DVec3) -> DVec3 {
        self.inverse_vector(p - self.origin)
    }
}

impl Surface {
    /// The point at `(s, t)` of the unit square, which covers the surface once.
    pub(super) fn at(&self, [s, t]: [f64; 2]) -> Place {
        match self {
            Self::Triangle([a, b, c], uvs) => {
                let normal = (*b - *a).cross(*c - *a);
                // Lines from the first vertex to the opposite edge.
                let weights = [1.0 - s, s * (1.0 - t), s * t];
                Place {
                    p: *a * weights[0] + *b * weights[1] + *c * weights[2],
                    n: normal.normalize(),
                    density: normal.length() * s,
                    uv: uvs[0] * weights[0] + uvs[1] * weights[1] + uvs[2] * weights[2],
                }
            }
            Self::Quad([a, b, c, d]) => {
                let du = (*b - *a).lerp(*d - *c, t);
                let dv = (*c - *a).lerp(*d - *b, s);
                let normal = du.cross(dv);
                Place {
                    p: a.lerp(*b, s).lerp(c.lerp(*d, s), t),
                    n: normal.normalize(),
                    density: normal.length(),
                    uv: DVec2::new(s, t),
                }
            }
            Self::Sphere(frame, radius) => {
                let (sin_phi, cos_phi) = (TAU * s).sin_cos();
                let (sin_theta, cos_theta) = (PI * t).sin_cos();
                let n = DVec3::new(sin_theta * cos_phi, sin_theta * sin_phi, -cos_theta);
                let n = frame.vector(n);
                Place {
                    p: frame.origin + n * *radius,
                    n,
                    density: TAU * PI * radius * radius * sin_theta,
                    uv: DVec2::new(s, t),
                }
            }
            Self::Disk(frame, [outer, inner]) => {
                let r = outer + (inner - outer) * t;
                let around = DVec2::from_angle(TAU * s);
                Place {
                    p: frame.origin + frame.vector((around * r).extend(0.0)),
                    n: frame.vector(DVec3::Z),
                    density: TAU * r * (outer - inner),
                    uv: DVec2::new(s, t),
                }
            }
            Self::Cylinder(frame, [radius, length]) => {
                let around = DVec2::from_angle(TAU * s).extend(0.0);
                let p = around * *radius + DVec3::Z * ((t - 0.5) * length);
                Place {
                    p: frame.origin + frame.vector(p),
                    n: frame.vector(around),
                    density: TAU * radius * length,
                    uv: DVec2::new(s, t),
                }
            }
        }
    }

    /// Whether no other part of the surface is between `from` and `place`.
    pub(super) fn is_seen(&self, from: DVec3, place: &Place) -> bool {
        /// A part of the line, or of a side, at which the crossing is the point itself.
        const END: f64 = 1e-12;
        let to = place.p - from;
        match self {
            Self::Triangle(..) | Self::Disk(..) => true,
            // The other crossing is before this one where the line goes out.
            Self::Sphere(frame, radius) => {
                let is_inside = from.distance_squared(frame.origin) < radius * radius;
                is_inside || to.dot(place.n) < 0.0
            }
            Self::Cylinder(frame, [radius, length]) => {
                let (o, d) = (frame.inverse_point(from), frame.inverse_vector(to));
                let (o_xy, d_xy) = (o.truncate(), d.truncate());
                // One crossing of the endless tube is at 1; the product of both is c / a.
                let other = (o_xy.length_squared() - radius * radius) / d_xy.length_squared();
                let is_before = other > 0.0 && other < 1.0 - END;
                !(is_before && (o.z + d.z * other).abs() <= 0.5 * length)
            }
            Self::Quad(corners) => {
                let [a, b, c, d] = corners.map(|corner| corner - from);
                // The line through the points at s of two sides meets the ray where this is 0.
                let side = |s: f64| (a.lerp(b, s), c.lerp(d, s));
                let volume = |s: f64| {
                    let (low, high) = side(s);
                    low.dot(to.cross(high - low))
                };
                let [at_0, middle, at_1] = [volume(0.0), volume(0.5), volume(1.0)];
                let square = 2.0 * (at_0 + at_1) - 4.0 * middle;
                let linear = at_1 - at_0 - square;
                // One root is that of the point itself; the sum of both is -linear / square.
                let other = -linear / square - place.uv.x;
                if !(0.0..=1.0).contains(&other) || (other - place.uv.x).abs() < END {
                    return true;
                }
                let (low, high) = side(other);
                let across = (high - low).cross(to);
                let v = to.cross(low).dot(across) / across.length_squared();
                let met = low.lerp(high, v);
                let along = met.dot(to) / to.length_squared();
                !((0.0..=1.0).contains(&v) && along > 0.0 && along < 1.0 - END)
            }
        }
    }
}
