use lights::glam::DVec3;
use lights::sources::shape::Shape;
use lights::sources::{Light, LightRef, LightSet, Rgb};

/// All lights of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightInventory {
    /// The kind's name.
    pub kind: &'static str,
    /// How many there are.
    pub count: usize,
    /// Their power in W, a channel.
    pub power: DVec3,
    /// The area that emits light, each side of a two-sided light once; 0 for lights without a
    /// surface, and for own lights, whose area is unknown.
    pub area: f64,
}

/// The lights of a set by kind, one entry for each kind that occurs.
#[must_use]
pub fn inventory(lights: &LightSet<Rgb>) -> Vec<LightInventory> {
    let mut kinds: Vec<LightInventory> = Vec::new();
    for (_, light) in lights.iter() {
        let (kind, area) = (kind(&light), area(&light));
        let power = light.phi(&()).as_dvec3();
        match kinds.iter_mut().find(|entry| entry.kind == kind) {
            Some(entry) => {
                entry.count += 1;
                entry.power += power;
                entry.area += f64::from(area);
            }
            None => kinds.push(LightInventory {
                kind,
                count: 1,
                power,
                area: area.into(),
            }),
        }
    }
    kinds
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
    use light_scene::{Emission, Material, Mesh, Scene};
    use lights::glam::Vec3;
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
