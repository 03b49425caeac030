use lights::math::Aabb;
use lights::sources::shape::Shape;
use lights::sources::{EmissionMask, LightDesc, OwnLight, Rgb};

use crate::{MaterialId, Prototype, Scene};

impl Scene {
    /// A box around the scene, empty for a scene without geometry. It is tight around meshes and
    /// quadrics; an instance counts by the transformed corners of the boxes of its prototype, an
    /// own light that rays hit by its bounds; an invisible area or mesh light counts not at all.
    #[must_use]
    pub fn bounds(&self) -> Aabb {
        let mut all = Aabb::EMPTY;
        self.for_each_part(|_, bounds| all = all.union(bounds));
        all
    }

    /// The name of the mesh, quadric, object or light that reaches farthest from the origin: that
    /// of its material, if it has none itself; empty where that has none either.
    #[must_use]
    pub fn farthest_part(&self) -> &str {
        let mut farthest = ("", 0.0);
        self.for_each_part(|name, bounds| {
            let reach = bounds.min.abs().max(bounds.max.abs()).max_element();
            // A box that is not finite is the farthest.
            if !(reach <= farthest.1) && !bounds.is_empty() {
                farthest = (name, reach);
            }
        });
        farthest.0
    }

    /// Hands out all that takes room in the scene.
    fn for_each_part<'a>(&'a self, mut part: impl FnMut(&'a str, Aabb)) {
        for mesh in &self.meshes {
            part(self.name_of(&mesh.name, mesh.material), mesh.bounds());
        }
        for quadric in &self.quadrics {
            let name = self.name_of(&quadric.name, quadric.material);
            part(name, quadric.bounds());
        }
        for (number, light) in self.lights.iter().enumerate() {
            if let Some(bounds) = light_box(light) {
                let name = self.light_names.get(number);
                part(name.map_or("", String::as_str), bounds);
            }
        }
        let boxes: Vec<Vec<Aabb>> = self.prototypes.iter().map(Prototype::boxes).collect();
        for instance in &self.instances {
            let prototype = instance.prototype.0 as usize;
            let name = &self.prototypes[prototype].name;
            part(name, instance.bounds(&boxes[prototype]));
        }
    }

    /// `name`, or that of the material where it is empty.
    fn name_of<'a>(&'a self, name: &'a str, material: MaterialId) -> &'a str {
        if name.is_empty() {
            &self.material(material).name
        } else {
            name
        }
    }
}

/// The box of a light that rays hit. A surface that is not valid has none: building the lights
/// refuses it, and names it.
fn light_box(light: &LightDesc<Rgb>) -> Option<Aabb> {
    let is_visible = |mask: &EmissionMask| *mask != EmissionMask::Invisible;
    match light {
        LightDesc::Own(OwnLight::Area(light)) => Some(light.bounds()?.bounds),
        LightDesc::Area(light) if is_visible(&light.emission.mask) => {
            Some(light.shape.build().ok()?.bounds())
        }
        LightDesc::Mesh(light) if is_visible(&light.emission.mask) => {
            let corners = light.indices.iter().flatten();
            let corners = corners.filter_map(|vertex| light.positions.get(vertex as usize));
            let corners = corners.filter(|p| p.is_finite());
            Some(corners.fold(Aabb::EMPTY, |all, &p| all.union(Aabb::new(p, p))))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glam::{Affine3A, Vec3};
    use crate::{Instance, Material, Mesh};

    #[test]
    fn what_reaches_farthest_has_a_name() {
        let mut scene = Scene::default();
        assert_eq!(scene.farthest_part(), "", "nothing");
        let wood = scene.add_material(Material::diffuse("wood", Vec3::ONE));
        let mesh = |name: &str, size: f32| {
            let mut mesh = Mesh::new(name, wood);
            let corners = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y];
            mesh.push_quad(corners.map(|p| p * size));
            mesh
        };
        scene.meshes = vec![mesh("near", 1.0), mesh("", -2.0)];
        assert_eq!(scene.farthest_part(), "wood", "of its material");
        let prototype = scene.add_prototype(Prototype::new("far", vec![mesh("", 0.5)]));
        scene.instances.push(Instance {
            prototype,
            transform: Affine3A::from_scale(Vec3::splat(9.0)),
        });
        assert_eq!(scene.farthest_part(), "far", "where it is placed");
        scene.meshes[0] = mesh("endless", f32::MAX);
        assert_eq!(
            scene.farthest_part(),
            "endless",
            "as far as there are numbers"
        );
    }
}
