//! Shapes of area lights, one per file.

mod any;
mod azimuth;
mod bilinear_patch;
mod bilinear_patch_error;
mod constants;
mod cylinder;
mod cylinder_view;
mod disk;
mod flat_quad;
mod normal;
mod patch_area;
mod patch_ray;
mod receiver_cosine;
mod rectangle;
mod rounding;
mod shape_trait;
mod solid_angle;
mod sphere;
mod triangle;
mod triangle_error;
mod uv_area;

pub use any::{AnyShape, ShapeDesc, ShapeError};
pub use bilinear_patch::BilinearPatch;
pub use bilinear_patch_error::BilinearPatchError;
pub use constants::SHAPE_CONSTANTS;
pub use cylinder::{Cylinder, CylinderError};
pub use disk::{Disk, DiskError};
pub use rectangle::{Rectangle, RectangleError};
pub use shape_trait::{Shape, ShapeDirectionSample, ShapeSample};
pub use sphere::{Sphere, SphereError};
pub use triangle::Triangle;
pub use triangle_error::TriangleError;
pub use uv_area::{UvArea, UvDensity};
