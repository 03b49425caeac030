use super::tests::read;
use crate::MAX_EMISSIVE_PRIMITIVES;
use crate::glam::{Affine3A, Vec3};

const TRIANGLE: &str = "Shape \"trianglemesh\" \"point3 P\" [0 0 0  1 0 0  0 1 0]";

#[test]
fn transforms_of_instances_are_applied_after_those_of_objects() {
    let text = format!(
        "Scale 9 9 9 WorldBegin
        ObjectInstance \"later\"
        Translate 5 0 0
        ObjectBegin \"later\" Translate 1 0 0 {TRIANGLE} ObjectEnd
        AttributeBegin Scale 2 2 -2 ObjectInstance \"later\" AttributeEnd
        ObjectInstance \"later\""
    );
    let scene = read("pbrt_places", &text).expect("a scene");
    assert!(scene.meshes.is_empty(), "no mesh in world space");
    let own = scene.prototypes[0].meshes[0].positions[1];
    assert_eq!(own, Vec3::X * 7.0, "moved where it is described");
    let transforms: Vec<_> = scene.instances.iter().map(|i| i.transform).collect();
    let moved = Affine3A::from_translation(Vec3::X * 5.0);
    let mirrored = moved * Affine3A::from_scale(Vec3::new(2.0, 2.0, -2.0));
    assert_eq!(
        transforms,
        [Affine3A::IDENTITY, mirrored, moved],
        "the state of the object ended with it"
    );
    assert_eq!(scene.triangle_count(), 3, "three instances of one");
    assert_eq!(
        scene.bounds().max,
        Vec3::new(19.0, 2.0, 0.0),
        "the mirrored"
    );
}

#[test]
fn empty_objects_can_be_instanced() {
    let text = "WorldBegin ObjectBegin \"n\" ObjectEnd ObjectInstance \"n\"";
    let scene = read("pbrt_nothing", text).expect("a scene");
    assert_eq!((scene.instances.len(), scene.triangle_count()), (1, 0), "n");
    assert!(scene.bounds().is_empty(), "it is nowhere");
}

#[test]
fn misplaced_objects_give_one_clear_line() {
    let cases = [
        (
            "WorldBegin\nObjectInstance \"a\"\nObjectInstance \"a\"",
            "a.pbrt:2: expected an object's name, found \"a\"",
        ),
        (
            "WorldBegin ObjectBegin \"a\"\nObjectBegin \"b\"",
            "a.pbrt:2: expected `ObjectEnd` before another `ObjectBegin`",
        ),
        (
            "WorldBegin ObjectBegin \"a\"\nObjectInstance \"b\"",
            "a.pbrt:2: expected `ObjectEnd` before `ObjectInstance`",
        ),
        (
            "WorldBegin ObjectBegin \"a\" ObjectEnd\nObjectBegin \"a\"",
            "a.pbrt:2: expected one object \"a\", found another",
        ),
        (
            "WorldBegin\nObjectBegin \"a\"\nTranslate 1 0 0",
            "a.pbrt:2: expected `ObjectEnd` after `ObjectBegin`",
        ),
        (
            "WorldBegin AttributeBegin ObjectBegin \"a\"\nAttributeEnd",
            "a.pbrt:2: expected `AttributeBegin` before",
        ),
        (
            "WorldBegin ObjectBegin \"a\" AttributeBegin\nObjectEnd",
            "a.pbrt:2: expected `AttributeEnd` before",
        ),
    ];
    for (text, expected) in cases {
        let error = read("pbrt_objects", text).expect_err(text);
        assert_eq!(error, expected, "{text}");
    }
}

#[test]
fn too_many_placed_lights_are_refused_at_their_instance() {
    let object = "WorldBegin ObjectBegin \"lamp\" AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]
        Shape \"sphere\" \"float zmax\" .5 ObjectEnd\n";
    let instance = "Translate 1 0 0 ObjectInstance \"lamp\"\n";
    let one = read("pbrt_lamp", &format!("{object}{instance}")).expect("a scene");
    let most = MAX_EMISSIVE_PRIMITIVES / one.emissive_triangle_count();
    let scene = read("pbrt_lamps", &format!("{object}{}", instance.repeat(most)));
    assert_eq!(
        scene.expect("a scene").instances.len(),
        most,
        "as many as may be"
    );

    let error = read(
        "pbrt_lamps",
        &format!("{object}{}", instance.repeat(most + 9)),
    );
    let error = error.expect_err("too many").to_string();
    let line = format!(
        "a.pbrt:{}: expected at most 4294967295 emissive triangles",
        most + 3
    );
    assert!(error.contains(&line), "{error}");
    // Defined after its instances.
    let error = read(
        "pbrt_lamps",
        &format!("WorldBegin {}{}", instance.repeat(most + 1), &object[10..]),
    );
    let error = error.expect_err("too many").to_string();
    let line = format!("a.pbrt:{}: expected at most", most + 3);
    assert!(error.contains(&line), "{error}");
}
