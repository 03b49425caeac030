use core::error::Error;
use core::fmt;

use super::{
    BilinearPatch, BilinearPatchError, Cylinder, CylinderError, Disk, DiskError, Rectangle,
    RectangleError, Shape, ShapeDirectionSample, ShapeSample, Sphere, SphereError, Triangle,
    TriangleError, UvArea,
};
use crate::glam::{Affine3A, Vec2, Vec3};
use crate::rigid_transform::{RigidTransform, RigidTransformError};
use crate::surface_point::SurfacePoint;
use light_bounds::LightSampleContext;
use light_math::{Aabb, DirectionCone};

/// The description of a shape. It is not validated.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum ShapeDesc {
    /// Vertices, counter-clockwise on the front. Many triangles are better described as a mesh.
    Triangle([Vec3; 3]),
    /// One corner and the two edges from there, perpendicular to each other; the front is the side
    /// of their cross product.
    Rectangle {
        /// The corner.
        corner: Vec3,
        /// The edges along u and v.
        edges: [Vec3; 2],
    },
    /// Corners at (u, v) = (0, 0), (1, 0), (0, 1), (1, 1) of a quadrilateral, planar or not: row by
    /// row as pbrt's bilinear meshes, not around it as the corners of a portal.
    Quad([Vec3; 4]),
    /// A sphere around the origin of its transform.
    Sphere {
        /// From the sphere's space to the scene.
        transform: Affine3A,
        /// Its radius.
        radius: f32,
    },
    /// A disk in the xy-plane of its transform, its front toward +z.
    Disk {
        /// From the disk's space to the scene.
        transform: Affine3A,
        /// Its radius.
        radius: f32,
        /// The radius of the hole, 0 for none.
        inner_radius: f32,
    },
    /// An open cylinder around the axis z of its transform, half of it on each side of the origin.
    Cylinder {
        /// From the cylinder's space to the scene.
        transform: Affine3A,
        /// Its radius.
        radius: f32,
        /// Its length.
        length: f32,
    },
}

/// One shape of any kind: a closed enum next to the trait.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum AnyShape {
    /// A triangle.
    Triangle(Triangle),
    /// A rectangle.
    Rectangle(Rectangle),
    /// A quadrilateral that is no rectangle.
    BilinearPatch(BilinearPatch),
    /// A sphere.
    Sphere(Sphere),
    /// A disk or an annulus.
    Disk(Disk),
    /// The wall of a cylinder.
    Cylinder(Cylinder),
}

/// Why a description is invalid: the kind of shape, and its rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ShapeError {
    /// `transform` is not rigid.
    Transform(RigidTransformError),
    /// Of a triangle.
    Triangle(TriangleError),
    /// Of a rectangle.
    Rectangle(RectangleError),
    /// Of a quadrilateral.
    Quad(BilinearPatchError),
    /// Of a sphere.
    Sphere(SphereError),
    /// Of a disk.
    Disk(DiskError),
    /// Of a cylinder.
    Cylinder(CylinderError),
}

impl ShapeDesc {
    /// A sphere around `center`, which is not turned.
    ///
    /// ```
    /// use light_sources::glam::{Affine3A, Vec3};
    /// use light_sources::shape::ShapeDesc;
    ///
    /// let transform = Affine3A::from_translation(Vec3::X);
    /// let radius = 0.5;
    /// assert_eq!(ShapeDesc::sphere(Vec3::X, radius), ShapeDesc::Sphere { transform, radius });
    /// ```
    #[must_use]
    pub fn sphere(center: Vec3, radius: f32) -> Self {
        let transform = Affine3A::from_translation(center);
        Self::Sphere { transform, radius }
    }

    /// Builds the shape. A quadrilateral with right angles becomes a [`Rectangle`].
    ///
    /// # Errors
    /// When it is invalid.
    pub fn build(self) -> Result<AnyShape, ShapeError> {
        let rigid = |transform| RigidTransform::new(transform).map_err(ShapeError::Transform);
        Ok(match self {
            Self::Triangle(p) => AnyShape::Triangle(
                Triangle::new(p, Triangle::DEFAULT_UV).map_err(ShapeError::Triangle)?,
            ),
            Self::Rectangle { corner, edges } => {
                AnyShape::Rectangle(Rectangle::new(corner, edges).map_err(ShapeError::Rectangle)?)
            }
            Self::Quad(corners) => match rectangle(corners) {
                Some(rectangle) => AnyShape::Rectangle(rectangle),
                None => {
                    AnyShape::BilinearPatch(BilinearPatch::new(corners).map_err(ShapeError::Quad)?)
                }
            },
            Self::Sphere { transform, radius } => AnyShape::Sphere(
                Sphere::new(rigid(transform)?, radius).map_err(ShapeError::Sphere)?,
            ),
            Self::Disk {
                transform,
                radius,
                inner_radius,
            } => AnyShape::Disk(
                Disk::new(rigid(transform)?, radius, inner_radius).map_err(ShapeError::Disk)?,
            ),
            Self::Cylinder {
                transform,
                radius,
                length,
            } => AnyShape::Cylinder(
                Cylinder::new(rigid(transform)?, radius, length).map_err(ShapeError::Cylinder)?,
            ),
        })
    }
}

impl From<Sphere> for ShapeDesc {
    fn from(Sphere { transform, radius }: Sphere) -> Self {
        let transform = transform.into();
        Self::Sphere { transform, radius }
    }
}

/// The rectangle with the corners of a quadrilateral, if it is one.
fn rectangle([p00, p10, p01, p11]: [Vec3; 4]) -> Option<Rectangle> {
    const TOLERANCE: f32 = 1e-5;
    let edges = [p10 - p00, p01 - p00];
    let off = p11 - (p00 + edges[0] + edges[1]);
    let is_parallelogram = off.length() <= TOLERANCE * (edges[0] + edges[1]).length();
    if is_parallelogram {
        Rectangle::new(p00, edges).ok()
    } else {
        None
    }
}

/// Evaluates an expression for the shape inside.
macro_rules! for_each_shape {
    ($shape:expr, $it:ident => $answer:expr) => {
        match $shape {
            AnyShape::Triangle($it) => $answer,
            AnyShape::Rectangle($it) => $answer,
            AnyShape::BilinearPatch($it) => $answer,
            AnyShape::Sphere($it) => $answer,
            AnyShape::Disk($it) => $answer,
            AnyShape::Cylinder($it) => $answer,
        }
    };
}

impl Shape for AnyShape {
    fn area(&self) -> f32 {
        for_each_shape!(self, shape => shape.area())
    }

    fn bounds(&self) -> Aabb {
        for_each_shape!(self, shape => shape.bounds())
    }

    fn normal_cone(&self) -> DirectionCone {
        for_each_shape!(self, shape => shape.normal_cone())
    }

    fn uv_area(&self) -> UvArea {
        for_each_shape!(self, shape => shape.uv_area())
    }

    fn sample(&self, u: Vec2) -> Option<ShapeSample> {
        for_each_shape!(self, shape => shape.sample(u))
    }

    fn pdf(&self, at: &SurfacePoint) -> f32 {
        for_each_shape!(self, shape => shape.pdf(at))
    }

    fn sample_toward(&self, ctx: &LightSampleContext, u: Vec2) -> Option<ShapeDirectionSample> {
        for_each_shape!(self, shape => shape.sample_toward(ctx, u))
    }

    fn pdf_toward(&self, ctx: &LightSampleContext, wi: Vec3) -> f32 {
        for_each_shape!(self, shape => shape.pdf_toward(ctx, wi))
    }

    fn hit(&self, origin: Vec3, direction: Vec3) -> Option<SurfacePoint> {
        for_each_shape!(self, shape => shape.hit(origin, direction))
    }
}

impl fmt::Display for ShapeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Transform(error) => error.fmt(f),
            Self::Triangle(error) => write!(f, "triangle, {error}"),
            Self::Rectangle(error) => write!(f, "rectangle, {error}"),
            Self::Quad(error) => write!(f, "quad, {error}"),
            Self::Sphere(error) => write!(f, "sphere, {error}"),
            Self::Disk(error) => write!(f, "disk, {error}"),
            Self::Cylinder(error) => write!(f, "cylinder, {error}"),
        }
    }
}

impl Error for ShapeError {}
