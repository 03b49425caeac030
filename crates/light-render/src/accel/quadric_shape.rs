use lights::glam::{Vec2, Vec3};
use lights::math::{Aabb, octahedral};
use lights::sources::SurfacePoint;
use lights::sources::shape::{AnyShape, Cylinder, Disk, Shape, Sphere};

/// A round shape that rays are intersected with as such.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum QuadricShape {
    /// A sphere. Coordinates on it: the outward normal, as a point of the
    /// [octahedral square](octahedral::to_square).
    Sphere(Sphere),
    /// A disk or an annulus. Coordinates on it: its surface parameters.
    Disk(Disk),
    /// The wall of a cylinder. Coordinates on it: its surface parameters.
    Cylinder(Cylinder),
}

impl QuadricShape {
    /// The shape, if it is one of these.
    pub(crate) fn new(shape: AnyShape) -> Option<Self> {
        match shape {
            AnyShape::Sphere(sphere) => Some(Self::Sphere(sphere)),
            AnyShape::Disk(disk) => Some(Self::Disk(disk)),
            AnyShape::Cylinder(cylinder) => Some(Self::Cylinder(cylinder)),
            _ => None,
        }
    }

    /// The box around it.
    pub(crate) fn bounds(&self) -> Aabb {
        match self {
            Self::Sphere(sphere) => sphere.bounds(),
            Self::Disk(disk) => disk.bounds(),
            Self::Cylinder(cylinder) => cylinder.bounds(),
        }
    }

    /// The point at `coords`.
    #[inline]
    pub(crate) fn at(&self, coords: Vec2) -> SurfacePoint {
        match self {
            Self::Sphere(sphere) => sphere.at(octahedral::from_square(coords)),
            Self::Disk(disk) => disk.at_uv(coords),
            Self::Cylinder(cylinder) => cylinder.at_uv(coords),
        }
    }

    /// The largest numbers along each axis of the scene that the coordinates of the point with the
    /// outward normal `n` are sums of.
    #[inline]
    pub(crate) fn magnitude(&self, n: Vec3) -> Vec3 {
        match self {
            Self::Sphere(sphere) => sphere.center().abs() + n.abs() * sphere.radius(),
            Self::Disk(disk) => disk.transform().origin().abs() + disk.radius(),
            Self::Cylinder(cylinder) => {
                cylinder.transform().origin().abs() + cylinder.radius() + 0.5 * cylinder.length()
            }
        }
    }
}

impl From<QuadricShape> for AnyShape {
    fn from(shape: QuadricShape) -> Self {
        match shape {
            QuadricShape::Sphere(sphere) => Self::Sphere(sphere),
            QuadricShape::Disk(disk) => Self::Disk(disk),
            QuadricShape::Cylinder(cylinder) => Self::Cylinder(cylinder),
        }
    }
}
