//! Emissive faces that a file lists twice. Rays hit one of the two, and light samples find both, so
//! that the second is left out.

use std::collections::{HashMap, HashSet};
use std::path::Path;

use crate::glam::Affine3A;
use crate::{
    Diagnostic, EmissionSides, Instance, Material, MaterialId, Mesh, Quadric, QuadricFront,
    QuadricKind, QuadricPart, Scene,
};

impl Scene {
    /// Leaves out emissive faces that have the very vertices of an earlier one and emit on a side
    /// on which that emits, quadrics of the same kind and transform likewise, and instances of
    /// emissive objects with the same transform. Those with an alpha mask stay: light may pass one
    /// where the other is opaque.
    ///
    /// One warning names the first of their shapes.
    pub(crate) fn drop_coincident_emitters(&mut self, path: &Path) {
        let materials = &self.materials;
        let mut found = Found::default();
        found.drop(materials, &mut self.meshes, &mut self.quadrics);
        for prototype in &mut self.prototypes {
            found.drop(materials, &mut prototype.meshes, &mut prototype.quadrics);
        }
        let is_lit = |material| emitting_sides(materials, material) != 0;
        let emissive: Vec<bool> = self
            .prototypes
            .iter()
            .map(|prototype| {
                prototype.meshes.iter().any(|mesh| is_lit(mesh.material))
                    || prototype
                        .quadrics
                        .iter()
                        .any(|quadric| is_lit(quadric.material))
            })
            .collect();
        let mut seen = HashSet::new();
        let prototypes = &self.prototypes;
        self.instances.retain(
            |Instance {
                 prototype,
                 transform,
             }| {
                let index = prototype.0 as usize;
                let stays = !emissive[index] || seen.insert((index, bits(transform)));
                if !stays {
                    found.add(&prototypes[index].name, 1);
                }
                stays
            },
        );
        self.warnings.extend(found.warning(path));
    }
}

/// What coincides, as it is found.
#[derive(Default)]
struct Found {
    first: Option<String>,
    shapes: usize,
    faces: usize,
}

impl Found {
    /// Drops what coincides among the faces of one space.
    fn drop(
        &mut self,
        materials: &[Material],
        meshes: &mut Vec<Mesh>,
        quadrics: &mut Vec<Quadric>,
    ) {
        let name_of = |name: &str, material: MaterialId| match name {
            "" => materials[material.0 as usize].name.clone(),
            name => name.into(),
        };
        let mut seen: HashMap<[[u32; 3]; 3], u8> = HashMap::new();
        meshes.retain_mut(|mesh| {
            let sides = emitting_sides(materials, mesh.material);
            if sides == 0 {
                return true;
            }
            let before = mesh.indices.len();
            let positions = &mesh.positions;
            mesh.indices.retain(|triangle| {
                let corners = triangle.map(|i| positions[i as usize] + 0.0);
                let mut place = corners.map(|p| p.to_array().map(f32::to_bits));
                let swaps = [(0, 1), (0, 2), (1, 2)]
                    .into_iter()
                    .filter(|&(i, j)| place[i] > place[j]);
                let sides = if swaps.count() % 2 == 1 {
                    turned(sides)
                } else {
                    sides
                };
                place.sort_unstable();
                add_sides(seen.entry(place).or_default(), sides)
            });
            let dropped = before - mesh.indices.len();
            if dropped > 0 {
                self.add(&name_of(&mesh.name, mesh.material), dropped);
            }
            dropped == 0 || !mesh.indices.is_empty()
        });
        type Shape = (QuadricKind, Option<QuadricPart>);
        let mut seen: HashMap<[u32; 12], Vec<(Shape, u8)>> = HashMap::new();
        quadrics.retain(|quadric| {
            let sides = match (emitting_sides(materials, quadric.material), quadric.front) {
                (0, _) => return true,
                (sides, QuadricFront::Outside) => sides,
                (sides, QuadricFront::Inside) => turned(sides),
            };
            let shape = (quadric.kind, quadric.part);
            let here = seen.entry(bits(&quadric.transform)).or_default();
            let stays = match here.iter_mut().find(|(other, _)| *other == shape) {
                Some((_, all)) => add_sides(all, sides),
                None => {
                    here.push((shape, sides));
                    true
                }
            };
            if !stays {
                self.add(&name_of(&quadric.name, quadric.material), 1);
            }
            stays
        });
    }

    fn add(&mut self, name: &str, faces: usize) {
        self.first.get_or_insert_with(|| name.into());
        self.shapes += 1;
        self.faces += faces;
    }

    fn warning(self, path: &Path) -> Option<Diagnostic> {
        let others = match self.shapes - usize::from(self.first.is_some()) {
            0 => String::new(),
            1 => " and of another shape".into(),
            n => format!(" and of {n} other shapes"),
        };
        let (first, faces) = (self.first?, self.faces);
        let message = format!(
            "emissive faces of \"{first}\"{others} coincide with earlier ones: {faces} left out"
        );
        Some(Diagnostic::file(path, message))
    }
}

/// The sides on which a material emits light that no mask holds back: 1 for the front, 2 for the
/// back.
fn emitting_sides(materials: &[Material], material: MaterialId) -> u8 {
    let Material {
        emission, alpha, ..
    } = &materials[material.0 as usize];
    match (emission, alpha) {
        (None, _) | (_, Some(_)) => 0,
        (Some(emission), None) => match emission.sides {
            EmissionSides::Front => 1,
            EmissionSides::Both => 3,
        },
    }
}

/// The sides of a face that is turned over.
fn turned(sides: u8) -> u8 {
    sides >> 1 | (sides & 1) << 1
}

/// Adds `sides` to those on which faces of one place emit; whether none was there.
fn add_sides(all: &mut u8, sides: u8) -> bool {
    let is_free = *all & sides == 0;
    if is_free {
        *all |= sides;
    }
    is_free
}

/// The numbers of a transform, of which 0 and -0 are the same.
fn bits(transform: &Affine3A) -> [u32; 12] {
    transform.to_cols_array().map(|x| (x + 0.0).to_bits())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glam::Vec3;
    use crate::{Alpha, Color, Emission, Prototype, PrototypeId};

    fn scene() -> (Scene, [MaterialId; 4]) {
        let mut scene = Scene::default();
        let front = Some(Emission::one_sided(Vec3::ONE));
        let both = front.map(|front| Emission {
            sides: EmissionSides::Both,
            ..front
        });
        let mask = Alpha {
            opacity: Color::Constant(Vec3::splat(0.5)),
            cutoff: None,
        };
        let ids = [
            ("matt", None, None),
            ("front", front, None),
            ("both", both, None),
            ("masked", front, Some(mask)),
        ]
        .map(|(name, emission, alpha)| {
            scene.add_material(Material {
                emission,
                alpha,
                ..Material::diffuse(name, Vec3::ONE)
            })
        });
        (scene, ids)
    }

    const CORNERS: [Vec3; 3] = [Vec3::ZERO, Vec3::X, Vec3::new(-0.0, 1.0, 0.0)];

    fn triangle(name: &str, material: MaterialId, order: [usize; 3]) -> Mesh {
        let mut mesh = Mesh::new(name, material);
        mesh.push_triangle(order.map(|i| CORNERS[i]));
        mesh
    }

    /// How many of two triangles of these materials stay, the second with this order of vertices.
    #[test]
    fn what_emits_where_another_does_is_left_out() {
        let (_, [matt, front, both, masked]) = scene();
        for (first, second, order, stay) in [
            (front, front, [0, 1, 2], 1),
            (front, front, [1, 2, 0], 1),
            (front, front, [1, 0, 2], 2),
            (both, front, [1, 0, 2], 1),
            (front, both, [0, 2, 1], 1),
            (both, both, [2, 1, 0], 1),
            (matt, matt, [0, 1, 2], 2),
            (matt, front, [0, 1, 2], 2),
            (masked, masked, [0, 1, 2], 2),
        ] {
            let (mut scene, _) = scene();
            scene.meshes = vec![
                triangle("first", first, [0, 1, 2]),
                triangle("second", second, order),
            ];
            scene.drop_coincident_emitters(Path::new("a.obj"));
            let what = format!("{first:?}, {second:?}, {order:?}");
            assert_eq!(scene.meshes.len(), stay, "{what}");
            let warnings: Vec<String> = scene.warnings.iter().map(|w| w.to_string()).collect();
            let expected =
                "a.obj: emissive faces of \"second\" coincide with earlier ones: 1 left out";
            match stay {
                1 => assert_eq!(warnings, [expected], "{what}"),
                _ => assert_eq!(warnings, [""; 0], "{what}"),
            }
        }
    }

    #[test]
    fn quadrics_and_instances_count_by_their_transforms() {
        let (mut scene, [_, front, both, _]) = scene();
        let at = |x: f32| Affine3A::from_translation(Vec3::X * x);
        let inside = Quadric {
            front: QuadricFront::Inside,
            ..Quadric::sphere("inside", front, at(0.0))
        };
        scene.quadrics = vec![
            Quadric::sphere("a", front, at(0.0)),
            Quadric::sphere("b", front, at(1.0)),
            Quadric::new(
                "tube",
                front,
                QuadricKind::Cylinder { length: 1.0 },
                at(0.0),
            ),
            inside.clone(),
            Quadric::sphere("", both, at(-0.0)),
            inside,
        ];
        let lamp = triangle("lamp", front, [0, 1, 2]);
        let object = Prototype::new("object", vec![lamp.clone(), lamp]);
        scene.prototypes.push(object);
        scene.instances = [0.0, 1.0, 0.0]
            .map(|x| Instance {
                prototype: PrototypeId(0),
                transform: at(x),
            })
            .to_vec();
        scene.drop_coincident_emitters(Path::new("a.pbrt"));
        let names: Vec<&str> = scene.quadrics.iter().map(|q| q.name.as_str()).collect();
        assert_eq!(names, ["a", "b", "tube", "inside"]);
        assert_eq!(scene.prototypes[0].meshes.len(), 1, "of the object");
        assert_eq!(scene.instances.len(), 2, "instances");
        let warning = scene.warnings[0].to_string();
        let expected = "a.pbrt: emissive faces of \"both\" and of 3 other shapes coincide with \
                        earlier ones: 4 left out";
        assert_eq!(warning, expected, "the first by its material");
    }
}
