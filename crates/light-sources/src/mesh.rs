use alloc::sync::Arc;
use core::error::Error;
use core::fmt;

use crate::area::DiffuseAreaLight;
use crate::color::ColorModel;
use crate::diffuse_emission::{DiffuseEmission, DiffuseEmissionError};
use crate::diffuse_emission_desc::DiffuseEmissionDesc;
use crate::glam::{Vec2, Vec3};
use crate::mean_cache::MeanCache;
use crate::mesh_indices::MeshIndices;
use crate::shape::{Shape, Triangle};
use crate::surface_texture::SurfaceTexture;
use light_math::Aabb;

/// A [`MeshLight`] as a user describes it.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize")
)]
pub struct MeshLightDesc<C: ColorModel> {
    /// Vertices in scene space, which may be shared.
    pub positions: Arc<[Vec3]>,
    /// The vertices of each triangle, counter-clockwise on the front.
    pub indices: MeshIndices,
    /// Surface parameters, one a vertex; by default those of [`Triangle::DEFAULT_UV`].
    pub uvs: Option<Arc<[Vec2]>>,
    /// The emission of all triangles.
    pub emission: DiffuseEmissionDesc<C>,
}

impl<C: ColorModel> MeshLightDesc<C> {
    /// A mesh of `positions` in scene space, of which `indices` names three a triangle,
    /// counter-clockwise on the front, without surface parameters.
    #[must_use]
    pub fn new(
        positions: impl Into<Arc<[Vec3]>>,
        indices: impl Into<MeshIndices>,
        emission: DiffuseEmissionDesc<C>,
    ) -> Self {
        Self {
            positions: positions.into(),
            indices: indices.into(),
            uvs: None,
            emission,
        }
    }
}

/// An emissive mesh: one source, whose triangles are area lights with consecutive ids.
///
/// Vertices are shared and the emission is stored once, so that a triangle needs no memory here, or
/// 12 bytes with an image or a mask. A triangle without area is a light without power.
#[derive(Clone, Debug)]
pub struct MeshLight<C: ColorModel> {
    positions: Arc<[Vec3]>,
    indices: MeshIndices,
    uvs: Option<Arc<[Vec2]>>,
    emission: DiffuseEmission<C>,
    /// The mean of the texture over each triangle; `None` without a texture.
    means: Option<Arc<[Vec3]>>,
}

/// Why the description of a mesh light is invalid; each variant names a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshLightError {
    /// A vertex of `positions` is not finite.
    Position {
        /// Its index.
        vertex: usize,
    },
    /// A triangle of `indices` names a vertex that does not exist.
    Index {
        /// Index of the triangle.
        triangle: usize,
    },
    /// A triangle of `indices` is so large that its area is no finite number.
    Area {
        /// Index of the triangle.
        triangle: usize,
    },
    /// The length of `uvs` is not the number of vertices.
    UvCount,
    /// One of `uvs` is not finite.
    Uv {
        /// Index of the vertex.
        vertex: usize,
    },
    /// `emission` is invalid.
    Emission(DiffuseEmissionError),
}

impl<C: ColorModel> MeshLight<C> {
    /// The light that `desc` describes.
    ///
    /// # Errors
    /// When a field of `desc` is invalid.
    pub fn new(desc: MeshLightDesc<C>) -> Result<Self, MeshLightError> {
        let count = desc.positions.len();
        if let Some(vertex) = desc.positions.iter().position(|p| !p.is_finite()) {
            return Err(MeshLightError::Position { vertex });
        }
        let is_inside = |t: [u32; 3]| t.iter().all(|&vertex| (vertex as usize) < count);
        let known = desc.indices.iter().take_while(|&t| is_inside(t)).count();
        if known < desc.indices.len() {
            return Err(MeshLightError::Index { triangle: known });
        }
        if let Some(uvs) = &desc.uvs {
            if uvs.len() != count {
                return Err(MeshLightError::UvCount);
            }
            if let Some(vertex) = uvs.iter().position(|uv| !uv.is_finite()) {
                return Err(MeshLightError::Uv { vertex });
            }
        }
        let uvs = desc.uvs.as_deref();
        let triangles = || {
            let triangles = desc.indices.iter();
            triangles.map(|vertices| triangle(&desc.positions, uvs, vertices))
        };
        let largest = largest_area(triangles())?;
        let texture = SurfaceTexture::new(&desc.emission);
        let means = texture.as_ref().map(|texture| {
            let mut known = MeanCache::default();
            let mean = |triangle: Triangle| known.mean(texture, &triangle);
            triangles().map(mean).collect::<Arc<[Vec3]>>()
        });
        let shapes = || {
            let mean = |k: usize| means.as_ref().map_or(Vec3::ONE, |means| means[k]);
            let areas = triangles().map(|triangle| triangle.area());
            areas.enumerate().map(move |(k, area)| (area, mean(k)))
        };
        let emission = DiffuseEmission::with_means(desc.emission, texture, shapes);
        let emission = emission.map_err(MeshLightError::Emission)?;
        let check = emission.check_power(largest);
        check.map_err(MeshLightError::Emission)?;
        Ok(Self {
            positions: desc.positions,
            indices: desc.indices,
            uvs: desc.uvs,
            emission,
            means,
        })
    }

    /// The number of triangles, each a light.
    #[must_use]
    pub fn len(&self) -> usize {
        self.indices.len()
    }

    /// Whether there is no triangle at all.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.indices.is_empty()
    }

    /// The emission of all triangles.
    #[must_use]
    pub const fn emission(&self) -> &DiffuseEmission<C> {
        &self.emission
    }

    pub(crate) fn vertices(&self) -> (&[Vec3], &MeshIndices, Option<&[Vec2]>) {
        (&self.positions, &self.indices, self.uvs.as_deref())
    }

    /// Means of the texture over each triangle.
    pub(crate) fn means(&self) -> Option<&[Vec3]> {
        self.means.as_deref()
    }

    /// The light of triangle `index`; `None` beyond the last.
    #[inline]
    #[must_use]
    pub fn triangle(&self, index: usize) -> Option<DiffuseAreaLight<'_, C, Triangle>> {
        self.triangle_by(index, |vertices| vertices, |corner| corner)
    }

    /// The light of triangle `index` with its vertices in the order of `turn`, each where `place`
    /// takes it; `None` beyond the last.
    #[inline]
    pub(crate) fn triangle_by(
        &self,
        index: usize,
        turn: impl Fn([u32; 3]) -> [u32; 3],
        place: impl Fn(Vec3) -> Vec3,
    ) -> Option<DiffuseAreaLight<'_, C, Triangle>> {
        let vertices = turn(self.indices.get(index)?);
        let triangle = triangle(&self.positions, self.uvs.as_deref(), vertices);
        let triangle = Triangle::from_corners(triangle.vertices().map(place), triangle.uvs());
        let mean = self.means.as_ref().and_then(|means| means.get(index));
        Some(DiffuseAreaLight::with_mean(triangle, &self.emission, mean))
    }

    /// The box of all vertices of triangles; empty without triangles.
    pub(crate) fn bounds(&self) -> Aabb {
        let corners = self.indices.iter().flatten();
        Aabb::from_points(corners.map(|vertex| self.positions[vertex as usize]))
    }

    /// The area of the largest triangle.
    pub(crate) fn largest_area(&self) -> f32 {
        self.check_areas(|corner| corner).unwrap_or(f32::INFINITY)
    }

    /// Refuses to place the mesh where [`new`](Self::new) would refuse it. `growth` is an upper
    /// bound of the factor between areas, `largest` the [`largest_area`](Self::largest_area).
    pub(crate) fn check_placed(
        &self,
        largest: f32,
        growth: f32,
        place: impl Fn(Vec3) -> Vec3,
    ) -> Result<(), MeshLightError> {
        // Nearly always the bound is enough.
        if self.emission.check_power(largest * growth).is_ok() {
            return Ok(());
        }
        let check = self.emission.check_power(self.check_areas(place)?);
        check.map_err(MeshLightError::Emission)
    }

    /// The area of the largest triangle where `place` takes it.
    fn check_areas(&self, place: impl Fn(Vec3) -> Vec3) -> Result<f32, MeshLightError> {
        let placed = self.indices.iter().map(|vertices| {
            let triangle = triangle(&self.positions, None, vertices);
            Triangle::from_corners(triangle.vertices().map(&place), Triangle::DEFAULT_UV)
        });
        largest_area(placed)
    }

    /// The corners of a triangle, if no index list has to be read for them.
    #[inline]
    pub(crate) fn corners(&self, index: usize) -> Option<&[Vec3; 3]> {
        match self.indices {
            MeshIndices::Consecutive(_) => {
                let first = index.checked_mul(3)?;
                self.positions.get(first..)?.first_chunk()
            }
            MeshIndices::List(_) => None,
        }
    }
}

/// The area of the largest triangle, if all are finite.
fn largest_area(triangles: impl Iterator<Item = Triangle>) -> Result<f32, MeshLightError> {
    let mut largest = 0.0f32;
    for (k, triangle) in triangles.enumerate() {
        let area = triangle.area();
        if !area.is_finite() {
            return Err(MeshLightError::Area { triangle: k });
        }
        largest = largest.max(area);
    }
    Ok(largest)
}

#[inline]
fn triangle(positions: &[Vec3], uvs: Option<&[Vec2]>, [a, b, c]: [u32; 3]) -> Triangle {
    let [a, b, c] = [a as usize, b as usize, c as usize];
    let uv = match uvs {
        Some(uvs) => [uvs[a], uvs[b], uvs[c]],
        None => Triangle::DEFAULT_UV,
    };
    Triangle::from_corners([positions[a], positions[b], positions[c]], uv)
}

impl fmt::Display for MeshLightError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Position { vertex } => write!(f, "positions: vertex {vertex} is not finite"),
            Self::Index { triangle } => {
                write!(
                    f,
                    "indices: triangle {triangle} names a vertex that is not there"
                )
            }
            Self::Area { triangle } => {
                write!(f, "indices: triangle {triangle} must have a finite area")
            }
            Self::UvCount => f.write_str("uvs: there must be one a vertex"),
            Self::Uv { vertex } => write!(f, "uvs: that of vertex {vertex} is not finite"),
            Self::Emission(error) => error.fmt(f),
        }
    }
}

impl Error for MeshLightError {}

#[cfg(test)]
mod tests;
