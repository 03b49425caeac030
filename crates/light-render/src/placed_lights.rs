use light_scene::Material;
use lights::sources::{LightDesc, LightSet, LightSetBuilder, MeshPrototypeId, Rgb, SourceId};

use crate::SceneLightsError;
use crate::emitter_ids::EmitterIds;
use crate::surface_emission::{AlphaMaskedLights, Textures};
use crate::world_object::WorldObject;

/// The lights of objects with instances: each emissive mesh is stored once, and each instance has
/// lights of its own.
#[derive(Debug, Default)]
pub(crate) struct PlacedLights {
    /// For each instance of all objects the source of its first emissive mesh; those of dark
    /// objects behind the last have no entry.
    first: Vec<Option<SourceId>>,
    /// The number of each source's mesh, in the order of adding.
    pub(crate) meshes: Vec<usize>,
    /// For each emissive mesh its number, and how many lights of its instance come before it.
    offsets: Vec<(usize, u32)>,
    masked: Vec<MaskedSource>,
}

/// An emissive mesh of an object.
#[derive(Clone, Copy, Debug)]
struct EmissiveMesh {
    mesh: usize,
    prototype: MeshPrototypeId,
    is_masked: bool,
}

#[derive(Clone, Copy, Debug)]
struct MaskedSource {
    source: SourceId,
    count: u32,
    material: usize,
}

impl PlacedLights {
    /// Adds the lights of all instances to a set; the first mesh of the objects has the number
    /// `first_mesh`.
    pub(crate) fn add(
        builder: &mut LightSetBuilder<Rgb>,
        objects: &[WorldObject],
        first_mesh: usize,
        materials: &[Material],
        textures: &mut Textures<'_>,
    ) -> Result<Self, SceneLightsError> {
        let mut this = Self::default();
        let (mut next_mesh, mut position) = (first_mesh, 0);
        for object in objects {
            let mut emissive = Vec::new();
            let mut count = 0;
            for (mesh, stored) in (next_mesh..).zip(&object.meshes) {
                let material = &materials[stored.material];
                let Some((LightDesc::Mesh(desc), is_masked)) =
                    textures.mesh_light(stored, material)
                else {
                    continue;
                };
                let prototype = builder.add_mesh_prototype(desc);
                let prototype =
                    prototype.map_err(|error| SceneLightsError::light(&material.name, error))?;
                emissive.push(EmissiveMesh {
                    mesh,
                    prototype,
                    is_masked,
                });
                this.offsets.push((mesh, count));
                count += triangles(stored.indices.len());
            }
            for (position, transform) in (position..).zip(&object.transforms) {
                let to_world = transform.to_world();
                for EmissiveMesh {
                    mesh,
                    prototype,
                    is_masked,
                } in &emissive
                {
                    let stored = &object.meshes[mesh - next_mesh];
                    let source = builder.place_mesh(*prototype, &to_world);
                    let source = source.map_err(|error| SceneLightsError::Placement {
                        name: materials[stored.material].name.clone(),
                        error,
                    })?;
                    if this.first.len() <= position {
                        this.first.resize(position, None);
                        this.first.push(Some(source));
                    }
                    this.meshes.push(*mesh);
                    if *is_masked {
                        this.masked.push(MaskedSource {
                            source,
                            count: triangles(stored.indices.len()),
                            material: stored.material,
                        });
                    }
                }
            }
            next_mesh += object.meshes.len();
            position += object.transforms.len();
        }
        Ok(this)
    }

    /// Sets the ids in `lights`, the set that was built, of all emissive meshes of objects, and
    /// adds those with an alpha mask to `masked`.
    pub(crate) fn set_ids(
        &self,
        lights: &LightSet<Rgb>,
        emitters: &mut EmitterIds,
        masked: &mut Vec<AlphaMaskedLights>,
    ) {
        for &(mesh, offset) in &self.offsets {
            emitters.set_mesh_of_object(mesh, offset);
        }
        let first_id = |source: &Option<SourceId>| lights.first_id((*source)?);
        emitters.set_instances(self.first.iter().map(first_id).collect());
        masked.extend(self.masked.iter().filter_map(|placed| {
            let first = lights.first_id(placed.source)?.0;
            Some(AlphaMaskedLights {
                ids: first..first + placed.count,
                material: placed.material,
            })
        }));
    }
}

/// A number of triangles of a mesh. One that ids cannot count is refused where it is placed.
fn triangles(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::World;
    use light_scene::glam::{Affine3A, Vec2, Vec3};
    use light_scene::{Emission, Instance, Mesh, Prototype, Scene};
    use lights::sources::LightRef;

    /// Every triangle of every instance finds its own light, also behind dark meshes and objects,
    /// and where a transform mirrors.
    #[test]
    fn triangles_of_instances_find_their_lights() {
        let mut scene = Scene::default();
        let wood = scene.add_material(Material::diffuse("wood", Vec3::ONE));
        let lamp = scene.add_material(Material {
            emission: Some(Emission::two_sided(Vec3::ONE)),
            ..Material::diffuse("lamp", Vec3::ZERO)
        });
        let strip = |material, x: f32| {
            let mut mesh = Mesh::new("strip", material);
            for y in 0..3u8 {
                let corner = Vec3::new(x, f32::from(y), 0.0);
                let corners = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y];
                mesh.push_quad(corners.map(|p| corner + 0.9 * p));
            }
            mesh
        };
        let dark = Prototype::new("dark", vec![strip(wood, 0.0)]);
        let parts = [(lamp, 0.0), (wood, 1.0), (lamp, 2.0), (lamp, 3.0)];
        let parts = parts.map(|(material, x)| strip(material, x));
        let lit = Prototype::new("lit", parts.into());
        let objects = [dark.clone(), lit.clone(), dark, lit];
        let objects = objects.map(|object| scene.add_prototype(object));
        scene.meshes.push(strip(lamp, -9.0));
        for i in 0..7u8 {
            for (j, prototype) in (0u8..).zip(objects) {
                let place = Vec3::new(f32::from(i) * 10.0, f32::from(j) * 10.0, 1.0);
                let side = if i % 2 == 0 { 1.0 } else { -2.0 };
                let transform = Affine3A::from_translation(place)
                    * Affine3A::from_scale(Vec3::new(side, 1.0, 1.0));
                scene.instances.push(Instance {
                    prototype,
                    transform,
                });
            }
        }
        let world = World::new(scene).expect("a scene");
        assert_eq!(world.instance_count(), 28, "none is copied");
        let mut found = vec![false; world.lights().len()];
        assert_eq!(found.len(), 6 + 14 * 18, "six triangles a strip");
        for primitive in world.primitives() {
            let surface = world.surface(primitive, Vec2::new(0.2, 0.3));
            let Some((id, _)) = world.emitted(&surface, surface.n) else {
                continue;
            };
            let Some(LightRef::Triangle(light)) = world.lights().get(id) else {
                panic!("{id:?} is a triangle");
            };
            let [a, b, c] = light.shape().vertices();
            let expected = a * 0.5 + b * 0.2 + c * 0.3;
            let swapped = a * 0.5 + b * 0.3 + c * 0.2;
            let off = |at: Vec3| at.distance(surface.p);
            assert!(
                off(expected).min(off(swapped)) < 1e-4,
                "{primitive:?} {id:?}"
            );
            assert!(
                !core::mem::replace(&mut found[id.index()], true),
                "{id:?} twice"
            );
        }
        assert!(
            found.iter().all(|&found| found),
            "each light has its triangle"
        );
    }
}
