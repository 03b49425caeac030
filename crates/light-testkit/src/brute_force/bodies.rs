use alloc::sync::Arc;

use light_math::glam::{Affine3A, Mat3, Vec2, Vec3};
use light_sources::shape::{ShapeDesc, Triangle};
use light_sources::{AreaLightDesc, DiffuseEmissionDesc, LightSetBuilder, MeshLightDesc, SourceId};

use super::kind::Kind;
use super::model::Model;
use super::placement::Placement;
use super::shapes::random_shape;
use super::surface::Surface;
use crate::Rng;

/// What emits, without its emission.
#[derive(Clone, Debug)]
pub(super) struct Body {
    pub(super) desc: BodyDesc,
    /// The triangle that is compared, of a mesh.
    pub(super) triangle: u32,
    /// The same in double precision.
    pub(super) surface: Surface,
    /// All surfaces of the description, of which an amount that is a power is the sum.
    pub(super) described: Vec<Surface>,
    /// Points around it.
    pub(super) points: Vec<Vec3>,
}

/// How the body is described.
#[derive(Clone, Debug)]
pub(super) enum BodyDesc {
    Shape(ShapeDesc),
    /// Vertices, surface parameters or none, and where a prototype is placed.
    Mesh(Vec<Vec3>, Option<Vec<Vec2>>, Option<Affine3A>),
}

impl Body {
    pub(super) fn random(kind: Kind, rng: &mut Rng, placement: &Placement) -> Self {
        if !matches!(kind, Kind::Mesh | Kind::PlacedMesh) {
            let (shape, surface, points) = random_shape(kind, rng, placement);
            return Self {
                desc: BodyDesc::Shape(shape),
                triangle: 0,
                surface,
                described: vec![surface],
                points,
            };
        }
        let triangle = rng.below(TRIANGLES);
        let (local, uvs) = random_mesh(rng);
        let (positions, to_scene) = if kind == Kind::Mesh {
            let positions = local.iter().map(|&p| placement.point(p));
            (positions.collect(), None)
        } else {
            (local, Some(sheared(rng, placement)))
        };
        let surface = |i: usize, to_scene: Affine3A| {
            let [a, mut b, mut c] = INDICES[i].map(|i| i as usize);
            if to_scene.matrix3.determinant() < 0.0 {
                (b, c) = (c, b);
            }
            let uv = |k: usize, vertex: usize| match &uvs {
                Some(uvs) => uvs[vertex],
                None => Triangle::DEFAULT_UV[k],
            };
            let corners = [a, b, c].map(|i| to_scene.transform_point3(positions[i]).as_dvec3());
            Surface::Triangle(
                corners,
                [uv(0, a), uv(1, b), uv(2, c)].map(|uv| uv.as_dvec2()),
            )
        };
        let affine = to_scene.unwrap_or(Affine3A::IDENTITY);
        Self {
            triangle: triangle as u32,
            surface: surface(triangle, affine),
            described: (0..TRIANGLES)
                .map(|i| surface(i, Affine3A::IDENTITY))
                .collect(),
            points: positions
                .iter()
                .map(|&p| affine.transform_point3(p))
                .collect(),
            desc: BodyDesc::Mesh(positions, uvs, to_scene),
        }
    }

    /// Adds the body with an emission.
    pub(super) fn add<M: Model>(
        &self,
        builder: &mut LightSetBuilder<M>,
        emission: &DiffuseEmissionDesc<M>,
    ) -> Result<SourceId, String> {
        let (positions, uvs, to_scene) = match &self.desc {
            BodyDesc::Shape(shape) => {
                let added = builder.add(AreaLightDesc::new(*shape, emission.clone()));
                return added.map_err(|e| e.to_string());
            }
            BodyDesc::Mesh(positions, uvs, to_scene) => (positions.clone(), uvs.clone(), to_scene),
        };
        let desc = MeshLightDesc {
            uvs: uvs.map(Arc::from),
            ..MeshLightDesc::new(positions, INDICES.to_vec(), emission.clone())
        };
        let Some(to_scene) = to_scene else {
            return builder.add(desc).map_err(|e| e.to_string());
        };
        let mesh = builder
            .add_mesh_prototype(desc)
            .map_err(|e| e.to_string())?;
        let placed = builder.place_mesh(mesh, to_scene);
        placed.map_err(|e| e.to_string())
    }
}

const TRIANGLES: usize = 3;

const INDICES: [[u32; 3]; TRIANGLES] = [[0, 1, 2], [2, 1, 3], [4, 0, 3]];

/// Vertices, and surface parameters or none.
fn random_mesh(rng: &mut Rng) -> (Vec<Vec3>, Option<Vec<Vec2>>) {
    let positions = (0..5).map(|_| rng.vec3() * 2.0 - 1.0).collect();
    let size = [1.0, rng.log_range(1e-3, 30.0)][rng.below(2)];
    let uvs: Vec<Vec2> = (0..5).map(|_| (rng.vec2() - 0.3) * size).collect();
    (positions, (rng.below(3) > 0).then_some(uvs))
}

/// Any affine transform: scaled by different factors, sheared, perhaps mirrored.
fn sheared(rng: &mut Rng, placement: &Placement) -> Affine3A {
    let scales = [(); 3].map(|()| rng.log_range(0.2, 5.0));
    let mut shear = Mat3::from_diagonal(scales.into());
    shear.y_axis.x = rng.range(-1.0, 1.0);
    shear.z_axis.y = rng.range(-1.0, 1.0);
    Affine3A::from_mat3_translation(
        placement.turn * shear * placement.unit,
        placement.offset * placement.unit,
    )
}
