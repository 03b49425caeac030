//! What is stored once, what is copied, and what is refused.

use light_render::{World, WorldError};
use light_scene::glam::{Affine3A, Vec3};
use light_scene::{Alpha, Color, Emission, Instance, Material, Prototype, Quadric, QuadricPart};

use super::{flattened, green, grove, world};
use crate::support::{Shot, agree, cornell};

#[test]
fn objects_are_stored_once_lamps_among_them() {
    let tree = grove(green());
    let own = tree.prototype(tree.instances[0].prototype).triangle_count();
    let room: usize = tree.meshes.iter().map(|mesh| mesh.indices.len()).sum();
    let dark = world(&tree);
    assert_eq!(dark.stored_triangle_count(), room + own, "stored once");
    assert_eq!(dark.triangle_count(), room + 4 * own, "seen four times");
    assert_eq!(
        (dark.prototype_count(), dark.instance_count()),
        (1, 4),
        "counted"
    );

    let emissive = grove(Material {
        emission: Some(Emission::one_sided(Vec3::ONE)),
        ..green()
    });
    let (instanced, flat) = (world(&emissive), world(&flattened(&emissive)));
    assert_eq!(
        instanced.lights().len(),
        flat.lights().len(),
        "all its lights"
    );
    assert_eq!(instanced.stored_triangle_count(), room + own, "lamps too");
    assert_eq!(instanced.triangle_count(), room + 4 * own, "in each place");
    let means = [&emissive, &flattened(&emissive)].map(|scene| Shot::default().mean(scene));
    assert!(agree(means[0], means[1]), "{means:?}");
}

#[test]
fn a_forest_takes_the_memory_of_a_tree() {
    let mut scene = grove(green());
    let stored = world(&scene).stored_triangle_count();
    let prototype = scene.instances[0].prototype;
    scene.instances.extend((0..10_000u16).map(|i| {
        let at = Vec3::new(f32::from(i % 100), 0.0, f32::from(i / 100));
        let transform = Affine3A::from_translation(at) * Affine3A::from_scale(Vec3::splat(0.3));
        Instance {
            prototype,
            transform,
        }
    }));
    let forest = world(&scene);
    assert_eq!(forest.stored_triangle_count(), stored, "none more");
    assert_eq!(forest.instance_count(), 10_004, "all are there");
    let count = forest.triangle_count();
    assert!(count > 2_000_000, "{count} triangles to be seen");
    let last = forest.primitive(count - 1).expect("there");
    assert!(last.instance().is_some(), "the last one is instanced");
    assert_eq!(forest.primitive(count), None, "no more");
}

/// Instances with exactly the same transform are stored once, so that a ray does not visit all of
/// them, unless their opacity is fractional.
#[test]
fn copies_in_the_same_place_are_one() {
    let count = |crown: Material, copies: usize| {
        let mut scene = grove(crown);
        let first = scene.instances[0];
        let others = scene.instances.len();
        scene.instances.extend(vec![first; copies]);
        let world = World::new(scene).expect("a world");
        (world.instance_count(), others)
    };
    let (found, others) = count(green(), 20_000);
    assert_eq!(found, others, "those that were there");
    let half = Some(Alpha {
        opacity: Color::Constant(Vec3::splat(0.5)),
        cutoff: None,
    });
    let lace = || Material {
        alpha: half,
        ..green()
    };
    let (found, others) = count(lace(), 10);
    assert_eq!(found, others + 10, "each of them");
}

#[test]
fn impossible_objects_are_refused() {
    let mut scene = grove(green());
    scene.instances[1].transform = Affine3A::from_scale(Vec3::new(1.0, 0.0, 1.0));
    let error = World::new(scene).err().map(|error| error.to_string());
    let flat = "object tree: expected transforms that do not make it flat";
    assert_eq!(error.as_deref(), Some(flat), "flat");

    // Quadrics that emit are copied for each instance, parts of them as triangles.
    let chandeliers = |part: Option<QuadricPart>, bulbs: usize, instances: usize| {
        let mut scene = cornell();
        let lamp = scene.add_material(Material {
            emission: Some(Emission::one_sided(Vec3::ONE)),
            ..green()
        });
        let mut chandelier = Prototype::new("chandelier", Vec::new());
        let bulb = Quadric::sphere("bulb", lamp, Affine3A::IDENTITY);
        chandelier.quadrics = vec![Quadric { part, ..bulb }; bulbs];
        let prototype = scene.add_prototype(chandelier);
        let instance = Instance {
            prototype,
            transform: Affine3A::IDENTITY,
        };
        scene.instances.resize(instances, instance);
        World::new(scene).err()
    };
    let error = Some(WorldError::Copies {
        name: "chandelier".into(),
        most: 1 << 25,
    });
    assert_eq!(
        chandeliers(None, 1_000, 40_000),
        error,
        "1,000 spheres 40,000 times"
    );
    let half = Some(QuadricPart {
        turn: 0.5,
        v: [0.0, 1.0],
    });
    assert_eq!(
        chandeliers(half, 10, 820),
        error,
        "10 halves of spheres, of 4,096 triangles each, 820 times"
    );
}
