use core::f64::consts::TAU;

use lights::glam::{Affine3A, DVec3, Vec2, Vec3};
use lights::math::octahedral;
use lights::sources::RigidTransform;

use super::quadric_shape::QuadricShape;
use crate::Ray;

/// A quadric as rays meet it.
#[derive(Clone, Copy)]
pub(super) enum QuadricLeaf {
    Sphere {
        center: Vec3,
        radius: f32,
    },
    Disk {
        frame: Frame,
        radius: f32,
        inner_radius: f32,
    },
    Cylinder {
        frame: Frame,
        radius: f32,
        half_length: f32,
    },
}

/// Three axes at right angles, and where they start.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    origin: Vec3,
    axes: [Vec3; 3],
}

/// Where the line of a ray meets a quadric, or the surface that continues it. In double precision:
/// differences of squares lose digits for large or distant quadrics.
pub(super) enum Crossing {
    /// The part of a line inside of a sphere.
    Sphere {
        direction: DVec3,
        /// From the centre to the middle of the chord.
        middle: DVec3,
        half: Half,
    },
    /// The place in the plane of a disk.
    Disk { t: f32, p: DVec3, radii: [f64; 2] },
    /// The part of a line inside of an endless tube.
    Cylinder {
        origin: DVec3,
        direction: DVec3,
        half_length: f64,
        half: Half,
    },
}

/// Distances along a ray to the middle of a chord, and from there to both ends.
#[derive(Clone, Copy)]
pub(super) struct Half {
    t: f64,
    half: f64,
}

impl Half {
    /// That of the line from `from_center` on along `direction`, in a circle or ball of a radius;
    /// and the middle, seen from the centre.
    #[inline]
    fn of_chord(from_center: DVec3, direction: DVec3, radius: f32) -> Option<(Self, DVec3)> {
        let length_sq = direction.length_squared();
        let t = -from_center.dot(direction) / length_sq;
        let middle = direction * t + from_center;
        let radius = f64::from(radius);
        let half_sq = radius * radius - middle.length_squared();
        let half = (half_sq / length_sq).sqrt();
        (half_sq >= 0.0 && t.is_finite()).then_some((Self { t, half }, middle))
    }

    /// Where the ray enters and where it leaves.
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "distances are single")]
    fn ends(self) -> [f32; 2] {
        [(self.t - self.half) as f32, (self.t + self.half) as f32]
    }

    /// From the middle to the end at distance `t`.
    #[inline]
    fn to_end(self, t: f32) -> f64 {
        if t == self.ends()[0] {
            -self.half
        } else {
            self.half
        }
    }
}

impl Frame {
    fn new(transform: &RigidTransform) -> Self {
        let Affine3A {
            matrix3,
            translation,
        } = (*transform).into();
        Self {
            origin: translation.into(),
            axes: [matrix3.x_axis, matrix3.y_axis, matrix3.z_axis].map(Vec3::from),
        }
    }

    /// A vector of the scene along the axes.
    #[inline]
    fn vector(&self, v: DVec3) -> DVec3 {
        let [x, y, z] = self.axes.map(|axis| axis.as_dvec3().dot(v));
        DVec3::new(x, y, z)
    }

    /// The origin and the direction of a ray along the axes.
    #[inline]
    fn ray(&self, ray: &Ray) -> [DVec3; 2] {
        let origin = ray.origin.as_dvec3() - self.origin.as_dvec3();
        [origin, ray.direction.as_dvec3()].map(|v| self.vector(v))
    }
}

impl QuadricLeaf {
    /// Where the line of `ray` meets it; `None` if it passes by.
    #[inline]
    pub(super) fn crossing(&self, ray: &Ray) -> Option<Crossing> {
        match self {
            Self::Sphere { center, radius } => {
                let direction = ray.direction.as_dvec3();
                let from_center = ray.origin.as_dvec3() - center.as_dvec3();
                let (half, middle) = Half::of_chord(from_center, direction, *radius)?;
                Some(Crossing::Sphere {
                    direction,
                    middle,
                    half,
                })
            }
            Self::Disk {
                frame,
                radius,
                inner_radius,
            } => {
                let [origin, direction] = frame.ray(ray);
                let t = -origin.z / direction.z;
                #[expect(clippy::cast_possible_truncation, reason = "distances are single")]
                t.is_finite().then(|| Crossing::Disk {
                    t: t as f32,
                    p: origin + direction * t,
                    radii: [*inner_radius, *radius].map(f64::from),
                })
            }
            Self::Cylinder {
                frame,
                radius,
                half_length,
            } => {
                let [origin, direction] = frame.ray(ray);
                let across = |v: DVec3| v.truncate().extend(0.0);
                let (half, _) = Half::of_chord(across(origin), across(direction), *radius)?;
                Some(Crossing::Cylinder {
                    origin,
                    direction,
                    half_length: (*half_length).into(),
                    half,
                })
            }
        }
    }
}

impl Crossing {
    /// Distances along the ray to where it enters and where it leaves. It leaves a disk nowhere:
    /// NaN.
    #[inline]
    pub(super) fn ends(&self) -> [f32; 2] {
        match self {
            Self::Sphere { half, .. } | Self::Cylinder { half, .. } => half.ends(),
            Self::Disk { t, .. } => [*t, f32::NAN],
        }
    }

    /// Whether a ray that starts on the quadric does not come back to it.
    #[inline]
    pub(super) fn leads_away(&self) -> bool {
        match self {
            Self::Sphere { half, .. } | Self::Cylinder { half, .. } => half.t <= 0.0,
            Self::Disk { .. } => true,
        }
    }

    /// Whether the end at distance `t` is on the quadric itself.
    #[inline]
    pub(super) fn is_on(&self, t: f32) -> bool {
        match self {
            Self::Sphere { .. } => true,
            Self::Disk { p, radii, .. } => {
                let [inner, outer] = radii;
                let r_sq = p.truncate().length_squared();
                r_sq >= inner * inner && r_sq <= outer * outer
            }
            Self::Cylinder { half_length, .. } => self.end(t).z.abs() <= *half_length,
        }
    }

    /// The coordinates of the end at distance `t`, as [`QuadricShape`] defines them.
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "coordinates are single")]
    pub(super) fn coords(&self, t: f32) -> Vec2 {
        let end = self.end(t);
        let around = || (end.y.atan2(end.x) / TAU).rem_euclid(1.0);
        let uv = match self {
            Self::Sphere { .. } => {
                return octahedral::to_square(end.normalize_or_zero().as_vec3());
            }
            Self::Disk { radii, .. } => {
                let [inner, outer] = radii;
                [
                    around(),
                    (outer - end.truncate().length()) / (outer - inner),
                ]
            }
            Self::Cylinder { half_length, .. } => [around(), 0.5 + 0.5 * end.z / half_length],
        };
        Vec2::from_array(uv.map(|x| x as f32)).clamp(Vec2::ZERO, Vec2::ONE)
    }

    /// The end at distance `t`, seen from the centre: of disks and cylinders along their axes.
    #[inline]
    fn end(&self, t: f32) -> DVec3 {
        match self {
            Self::Sphere {
                direction,
                middle,
                half,
            } => *middle + *direction * half.to_end(t),
            Self::Disk { p, .. } => *p,
            Self::Cylinder {
                origin,
                direction,
                half,
                ..
            } => *origin + *direction * (half.t + half.to_end(t)),
        }
    }
}

impl From<&QuadricShape> for QuadricLeaf {
    fn from(shape: &QuadricShape) -> Self {
        match shape {
            QuadricShape::Sphere(sphere) => Self::Sphere {
                center: sphere.center(),
                radius: sphere.radius(),
            },
            QuadricShape::Disk(disk) => Self::Disk {
                frame: Frame::new(disk.transform()),
                radius: disk.radius(),
                inner_radius: disk.inner_radius(),
            },
            QuadricShape::Cylinder(cylinder) => Self::Cylinder {
                frame: Frame::new(cylinder.transform()),
                radius: cylinder.radius(),
                half_length: 0.5 * cylinder.length(),
            },
        }
    }
}
