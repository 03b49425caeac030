use core::ops::Range;
use std::collections::HashMap;

use lights::bounds::LightId;
use lights::bvh::Placement;
use lights::glam::{Affine3A, DVec3};
use lights::sources::shape::Shape;
use lights::sources::{Light, LightRef, LightSet, MeshPrototypeId, Rgb};

use crate::shape_counts::ShapeCounts;
use crate::source_ids::source_ids;

/// All lights of one kind.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LightInventory {
    /// The kind's name.
    pub kind: &'static str,
    /// How many there are.
    pub count: usize,
    /// Of area lights, how many have which shape; none of others.
    pub shapes: ShapeCounts,
    /// Their power in W, a channel.
    pub power: DVec3,
    /// The area that emits light, each side of a two-sided light once; 0 for lights without a
    /// surface, and for own lights, whose area is unknown.
    pub area: f64,
}

/// The lights of a set by kind, one entry for each kind that occurs. Linear in the lights that are
/// stored and in the places of placed meshes; where a mesh is stretched or sheared, in its triangles
/// as well.
#[must_use]
pub fn inventory(lights: &LightSet<Rgb>) -> Vec<LightInventory> {
    let mut kinds = Vec::new();
    let mut of_prototypes: HashMap<MeshPrototypeId, LightInventory> = HashMap::new();
    for (source, ids) in source_ids(lights) {
        let placed = lights.placement(source);
        let placed = placed.and_then(|(id, to_scene)| Some((id, growth_of_areas(to_scene)?)));
        let Some((prototype, growth)) = placed else {
            all_of(lights, ids).for_each(|light| add(&mut kinds, light));
            continue;
        };
        let unscaled = of_prototypes.entry(prototype).or_insert_with(|| {
            let mut all = Vec::new();
            all_of(lights, ids).for_each(|light| add(&mut all, light));
            all.pop().unwrap_or_default().scaled(1.0 / growth)
        });
        if unscaled.count > 0 {
            add(&mut kinds, unscaled.scaled(growth));
        }
    }
    kinds
}

/// By what a transform that scales all axes alike multiplies areas; `None` for others, and where
/// powers may vanish.
fn growth_of_areas(to_scene: &Affine3A) -> Option<f64> {
    Placement::from_matrix(0, to_scene).ok()?;
    let x_axis = to_scene.matrix3.x_axis.as_dvec3();
    Some(x_axis.length_squared()).filter(|growth| (1e-8..1e8).contains(growth))
}

/// The lights of these ids, each as the only one of its kind.
fn all_of(lights: &LightSet<Rgb>, ids: Range<u32>) -> impl Iterator<Item = LightInventory> + '_ {
    let lights = ids.filter_map(|id| lights.get(LightId(id)));
    lights.map(|light| LightInventory {
        kind: kind(&light),
        count: 1,
        shapes: shapes(&light),
        power: light.phi(&()).as_dvec3(),
        area: area(&light).into(),
    })
}

/// Adds lights of a kind to the entry of their kind.
fn add(kinds: &mut Vec<LightInventory>, lights: LightInventory) {
    match kinds.iter_mut().find(|entry| entry.kind == lights.kind) {
        Some(entry) => {
            entry.count += lights.count;
            entry.shapes += lights.shapes;
            entry.power += lights.power;
            entry.area += lights.area;
        }
        None => kinds.push(lights),
    }
}

impl LightInventory {
    /// The same lights with areas that are larger by `growth`, and powers that grow with them.
    fn scaled(&self, growth: f64) -> Self {
        Self {
            power: self.power * growth,
            area: self.area * growth,
            ..*self
        }
    }
}

/// The name of a light's kind.
pub(crate) fn kind(light: &LightRef<'_, Rgb>) -> &'static str {
    match light {
        LightRef::Point(_) => "point",
        LightRef::Spot(_) => "spot",
        LightRef::Projection(_) => "projection",
        LightRef::Goniometric(_) => "goniometric",
        LightRef::Area(_) => "area",
        LightRef::Triangle(_) => "triangle",
        LightRef::Own(_) => "own",
        LightRef::Distant(_) => "distant",
        LightRef::Sun(_) => "sun",
        LightRef::UniformInfinite(_) => "uniform sky",
        LightRef::ImageInfinite(_) => "image sky",
        LightRef::PortalInfinite(_) => "portal",
        // The kinds are not exhaustive for other crates; those of today are all above.
        _ => "other",
    }
}

/// The shape of an area light; none of others.
fn shapes(light: &LightRef<'_, Rgb>) -> ShapeCounts {
    match light {
        LightRef::Area(light) => ShapeCounts::of(light.shape()),
        _ => ShapeCounts::default(),
    }
}

/// The area of a light's surface; 0 for lights without one.
fn area(light: &LightRef<'_, Rgb>) -> f32 {
    match light {
        LightRef::Area(light) => light.shape().area(),
        LightRef::Triangle(light) => light.shape().area(),
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::World;
    use light_scene::{Emission, Instance, Material, Mesh, Prototype, Scene};
    use lights::glam::{Quat, Vec3};
    use lights::sources::{LightDesc, RadianceAmount, SunAmount, SunLightDesc};

    #[test]
    fn a_sun_is_named() {
        let mut scene = Scene::default();
        scene.lights.push(LightDesc::Sun(SunLightDesc {
            direction: Vec3::Y,
            angular_diameter: 0.01,
            emission: Vec3::ONE,
            amount: SunAmount::Radiance(RadianceAmount::default()),
        }));
        let world = World::new(scene).expect("a valid sun");
        let [entry] = inventory(world.lights())[..] else {
            panic!("one kind");
        };
        assert_eq!((entry.kind, entry.count), ("sun", 1), "the sun");
    }

    /// Of instances that are turned and scaled the lamp is looked at once, of one that is
    /// stretched again.
    #[test]
    fn placed_lights_are_counted_as_copies_are() {
        let mut scene = Scene::default();
        let mut lamp = |name: &str, radiance| {
            let material = scene.add_material(Material {
                emission: Some(Emission::two_sided(radiance)),
                ..Material::diffuse(name, Vec3::ZERO)
            });
            let mut mesh = Mesh::new(name, material);
            for x in [0.0, 3.0] {
                let corners = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y];
                mesh.push_quad(corners.map(|p| p * (1.0 + x) + x * Vec3::Z));
            }
            mesh
        };
        let meshes = [lamp("red", Vec3::X), lamp("blue", Vec3::new(0.1, 0.2, 3.0))];
        let prototype = scene.add_prototype(Prototype::new("lamps", meshes.into()));
        let turn = Quat::from_rotation_x(0.7);
        for scale in [0.5, 1.0, -2.0, 3.0] {
            scene.instances.push(Instance {
                prototype,
                transform: Affine3A::from_scale_rotation_translation(
                    Vec3::splat(scale),
                    turn,
                    Vec3::X * 50.0 * scale,
                ),
            });
        }
        scene.instances.push(Instance {
            prototype,
            transform: Affine3A::from_scale(Vec3::new(1.0, 7.0, 1.0)),
        });
        let world = World::new(scene).expect("valid lights");
        let lights = world.lights();
        assert_eq!(lights.placed_counts().placements, 10, "none is copied");
        let mut expected = Vec::new();
        let count = u32::try_from(lights.len()).expect("few");
        all_of(lights, 0..count).for_each(|light| add(&mut expected, light));
        let ([found], [expected]) = (&inventory(lights)[..], &expected[..]) else {
            panic!("one kind");
        };
        assert_eq!((found.kind, found.count), ("triangle", 40), "all of them");
        assert_eq!(expected.count, 40, "all of them");
        assert!((found.area / expected.area - 1.0).abs() < 1e-6, "{found:?}");
        let ratio = found.power / expected.power;
        assert!(
            (ratio - 1.0).abs().max_element() < 1e-6,
            "{found:?} {expected:?}"
        );
    }

    #[test]
    fn lights_are_counted_with_their_power_and_area() {
        let mut scene = Scene::default();
        let lamp = scene.add_material(Material {
            emission: Some(Emission::two_sided(Vec3::new(1.0, 2.0, 3.0))),
            ..Material::diffuse("lamp", Vec3::ZERO)
        });
        let corners = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y].map(|p| p * 2.0);
        scene.meshes.push(Mesh::quad("lamp", lamp, corners));
        let world = World::new(scene).expect("valid lights");
        let [entry] = inventory(world.lights())[..] else {
            panic!("one kind");
        };
        assert_eq!((entry.kind, entry.count), ("triangle", 2), "a quad");
        assert!((entry.area - 4.0).abs() < 1e-6, "two by two");
        let power = DVec3::new(1.0, 2.0, 3.0) * 8.0 * core::f64::consts::PI;
        assert!(entry.power.distance(power) < 1e-4, "pi L A on both sides");
    }
}
