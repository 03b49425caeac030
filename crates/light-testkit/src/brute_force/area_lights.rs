use alloc::sync::Arc;

use light_math::glam::{Affine3A, Mat3, Vec2, Vec3};
use light_sources::shape::{ShapeDesc, Triangle};
use light_sources::{
    AreaLightDesc, Channels, DiffuseEmissionDesc, EmissionMask, Light, LightSetBuilder,
    MeshLightDesc, RadianceAmount, Sides, SurfaceColor,
};

use super::amounts::surface_amounts_hold;
use super::area::{EmittingSurface, largest};
use super::area_checks::check_surface;
use super::kind::Kind;
use super::model::Model;
use super::picture::{random_image, random_mapping, random_mask};
use super::placement::{Placement, any_scene};
use super::surface::{RigidFrame, Surface};
use crate::Rng;

/// An area light or one triangle of a mesh, anywhere, against its description.
pub(super) fn check<M: Model>(kind: Kind, rng: &mut Rng) -> Result<(), String> {
    let wavelengths = M::random_wavelengths(rng);
    let emission = random_emission::<M>(rng);
    let placement = Placement::random(rng);
    let mut builder = LightSetBuilder::<M>::new(any_scene());
    // A shape that is no part of a mesh, whose power is that of the whole mesh.
    let mut alone = None;
    let (surface, points, id, shape) = match kind {
        Kind::Mesh | Kind::PlacedMesh => {
            let triangle = rng.below(TRIANGLES);
            let (local, uvs) = random_mesh(rng);
            let to_scene = match kind {
                Kind::Mesh => Affine3A::IDENTITY,
                _ => sheared(rng, &placement),
            };
            let positions: Vec<Vec3> = match kind {
                Kind::Mesh => local.iter().map(|&p| placement.point(p)).collect(),
                _ => local.clone(),
            };
            let desc = MeshLightDesc {
                uvs: uvs.clone().map(Arc::from),
                ..MeshLightDesc::new(positions.clone(), INDICES.to_vec(), emission.clone())
            };
            let source = match kind {
                Kind::Mesh => builder.add(desc).map_err(|e| e.to_string())?,
                _ => {
                    let mesh = builder
                        .add_mesh_prototype(desc)
                        .map_err(|e| e.to_string())?;
                    let placed = builder.place_mesh(mesh, &to_scene);
                    placed.map_err(|e| e.to_string())?
                }
            };
            let scene_points: Vec<Vec3> = positions
                .iter()
                .map(|&p| to_scene.transform_point3(p))
                .collect();
            let [a, mut b, mut c] = INDICES[triangle].map(|i| i as usize);
            if to_scene.matrix3.determinant() < 0.0 {
                (b, c) = (c, b);
            }
            let uv = |k: usize, vertex: usize| match &uvs {
                Some(uvs) => uvs[vertex],
                None => Triangle::DEFAULT_UV[k],
            };
            let corners = [a, b, c].map(|i| scene_points[i].as_dvec3());
            let uvs = [uv(0, a), uv(1, b), uv(2, c)].map(|uv| uv.as_dvec2());
            (
                Surface::Triangle(corners, uvs),
                scene_points,
                (source, triangle as u32),
                format!("{to_scene:?} of triangle {triangle} of {positions:?}, {uvs:?}"),
            )
        }
        _ => {
            let (shape, surface, points) = random_shape(kind, rng, &placement);
            let desc = AreaLightDesc::new(shape, emission.clone());
            alone = Some(shape);
            let source = builder.add(desc).map_err(|e| format!("{shape:?}: {e}"))?;
            (surface, points, (source, 0), format!("{shape:?}"))
        }
    };
    let set = builder.build();
    let id = set.id_of(id.0, id.1).ok_or("no id")?;
    let light = set.get(id).ok_or("no light")?;
    let truth = EmittingSurface {
        surface,
        emission: &emission,
        wavelengths: &wavelengths,
        coordinates: largest(&points),
    };
    let power = set.powers()[id.0 as usize];
    check_surface(&light, power, &truth, placement.unit, rng)
        .and_then(|()| {
            let Some(shape) = alone else {
                return Ok(());
            };
            let phi = M::values(light.phi(&wavelengths));
            surface_amounts_hold(&truth, phi, rng, |emission| {
                let mut builder = LightSetBuilder::<M>::new(any_scene());
                let desc = AreaLightDesc::new(shape, emission);
                let source = builder.add(desc).map_err(|e| e.to_string())?;
                let set = builder.build();
                let id = set.first_id(source).ok_or("no id")?;
                Ok(M::values(set.get(id).ok_or("no light")?.phi(&wavelengths)))
            })
        })
        .map_err(|fault| format!("{fault}\n  {shape}\n  {}", what(&emission)))
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

/// A shape of about unit size in its unit, the same in double precision, and points around it.
fn random_shape(
    kind: Kind,
    rng: &mut Rng,
    placement: &Placement,
) -> (ShapeDesc, Surface, Vec<Vec3>) {
    let transform = placement.transform();
    let frame = || RigidFrame::new(transform);
    let mut length = |low| rng.log_range(low, 1.0) * placement.unit;
    let around = |reach: f32| {
        let origin = Vec3::from(transform.translation);
        vec![origin - reach, origin + reach]
    };
    match kind {
        Kind::Sphere => {
            let radius = length(0.3);
            let desc = ShapeDesc::Sphere { transform, radius };
            (
                desc,
                Surface::Sphere(frame(), radius.into()),
                around(radius),
            )
        }
        Kind::Disk => {
            let radius = length(0.3);
            let inner_radius = [0.0, rng.range(0.01, 0.99) * radius][rng.below(2)];
            let desc = ShapeDesc::Disk {
                transform,
                radius,
                inner_radius,
            };
            let radii = [radius, inner_radius].map(f64::from);
            (desc, Surface::Disk(frame(), radii), around(radius))
        }
        Kind::Cylinder => {
            let (radius, length) = (length(0.02), length(0.02));
            let desc = ShapeDesc::Cylinder {
                transform,
                radius,
                length,
            };
            let sizes = [radius, length].map(f64::from);
            (
                desc,
                Surface::Cylinder(frame(), sizes),
                around(radius + length),
            )
        }
        Kind::Triangle => {
            let points = [(); 3].map(|()| placement.point(rng.vec3() * 2.0 - 1.0));
            let uvs = Triangle::DEFAULT_UV.map(|uv| uv.as_dvec2());
            let corners = points.map(|p| p.as_dvec3());
            (
                ShapeDesc::Triangle(points),
                Surface::Triangle(corners, uvs),
                points.to_vec(),
            )
        }
        Kind::Rectangle => {
            let corner = placement.point(Vec3::new(-0.5, -0.5, 0.0));
            let edges = [Vec3::X * length(0.05), Vec3::Y * length(0.05)];
            let edges = edges.map(|edge| placement.turn * edge);
            let desc = ShapeDesc::Rectangle { corner, edges };
            let [a, x, y] = [corner, edges[0], edges[1]].map(|p| p.as_dvec3());
            let y = y - x * (x.dot(y) / x.length_squared());
            let points = vec![corner, corner + edges[0] + edges[1]];
            (desc, Surface::Quad([a, a + x, a + y, a + x + y]), points)
        }
        _ => {
            let bend = [0.0, rng.log_range(1e-4, 2.0)][rng.below(2)];
            // A flat one that folds over itself has two layers that no rounding keeps apart.
            let slant = if bend < 0.1 { 0.24 } else { 0.45 };
            let near = |x: f32, y: f32, rng: &mut Rng| {
                let flat = Vec2::new(x, y) + slant * (rng.vec2() * 2.0 - 1.0);
                flat.extend(bend * rng.range(-1.0, 1.0))
            };
            let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)];
            let corners = corners.map(|(x, y)| placement.point(near(x, y, rng)));
            let exact = corners.map(|p| p.as_dvec3());
            (
                ShapeDesc::Quad(corners),
                Surface::Quad(exact),
                corners.to_vec(),
            )
        }
    }
}

fn random_emission<M: Model>(rng: &mut Rng) -> DiffuseEmissionDesc<M> {
    let channels = if M::is_linear() {
        [Channels::Gray, Channels::Rgb][rng.below(2)]
    } else {
        Channels::Gray
    };
    let color = if rng.below(2) == 0 {
        SurfaceColor::Uniform(M::random_emission(rng))
    } else {
        let size = [1 + rng.below(8) as u32, 1 + rng.below(8) as u32];
        SurfaceColor::Image {
            texture: random_image(rng, size, channels).into(),
            tint: [Vec3::ONE, rng.vec3() + 0.01][rng.below(2)],
        }
    };
    let mask = match rng.below(4) {
        0 => EmissionMask::Alpha(random_mask(rng)),
        1 => EmissionMask::Invisible,
        _ => EmissionMask::Opaque,
    };
    let amount = RadianceAmount::Radiometric(rng.log_range(1e-3, 1e3));
    DiffuseEmissionDesc {
        sides: [Sides::Front, Sides::Back, Sides::Both][rng.below(3)],
        mask,
        mapping: random_mapping(rng),
        ..DiffuseEmissionDesc::new(color, amount)
    }
}

/// The parts of an emission that a fault is printed with.
fn what<M: Model>(emission: &DiffuseEmissionDesc<M>) -> String {
    let color = match &emission.color {
        SurfaceColor::Uniform(color) => format!("{color:?}"),
        SurfaceColor::Image { texture, tint } => {
            format!("image {:?} times {tint}", texture.image())
        }
    };
    let mask = match &emission.mask {
        EmissionMask::Alpha(mask) => format!(
            "mask {:?} times {}, cutoff {:?}, {:?}",
            mask.texture.image(),
            mask.scale,
            mask.cutoff,
            mask.mapping
        ),
        other => format!("{other:?}"),
    };
    format!(
        "{color}, {mask}, {:?}, {:?}, {:?}",
        emission.sides, emission.amount, emission.mapping
    )
}
