//! Materials and vertex attributes of glTF files.

use std::path::Path;

use super::data_uri::tests::data_uri;
use super::parse_gltf;
use crate::glam::{Vec2, Vec3, Vec4};
use crate::image::tests::png;
use crate::{BackFaces, Color, Files, Material, MetallicRoughness, Scene, Surface, UvSet};

/// A square of two triangles whose vertices have further `attributes` of so many numbers each, and
/// the members `rest` of the document.
fn square(attributes: &[(&str, usize, &[f32])], rest: &str) -> Scene {
    let corners = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0];
    let mut all = vec![("POSITION", 3, &corners[..])];
    all.extend(attributes);
    let (mut bytes, mut views, mut accessors) = (Vec::new(), Vec::new(), Vec::new());
    let mut names = Vec::new();
    for (i, (name, width, numbers)) in all.iter().enumerate() {
        let (start, length) = (bytes.len(), 4 * numbers.len());
        bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
        views.push(format!(
            r#"{{"buffer": 0, "byteOffset": {start}, "byteLength": {length}}}"#
        ));
        accessors.push(format!(
            r#"{{"bufferView": {i}, "componentType": 5126, "count": {}, "type": "VEC{width}"}}"#,
            numbers.len() / width
        ));
        names.push(format!(r#""{name}": {i}"#));
    }
    let json = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0]}}],
        "nodes": [{{"mesh": 0, "scale": [2, 1, 1]}}], "bufferViews": [{}], "accessors": [{}],
        "buffers": [{{"byteLength": {}, "uri": "{}"}}], "meshes": [{{"primitives": [
        {{"mode": 6, "attributes": {{{}}}, "material": 0}}]}}], {rest}}}"#,
        views.join(","),
        accessors.join(","),
        bytes.len(),
        data_uri(&bytes),
        names.join(",")
    );
    parse_gltf(Path::new("a.gltf"), json.as_bytes(), Files::NONE).expect("a scene")
}

/// Textures 0 and 1 of one texel each: the colours (51, 102, 204) and (128, 128, 255).
fn textures() -> String {
    let image = |texel| data_uri(&png(image::RgbImage::from_pixel(1, 1, image::Rgb(texel))));
    format!(
        r#""textures": [{{"source": 0}}, {{"source": 1}}], "images": [{{"uri": "{}"}},
        {{"uri": "{}"}}]"#,
        image([51, 102, 204]),
        image([128, 128, 255])
    )
}

fn material(scene: &Scene) -> &Material {
    scene.material(scene.meshes[0].material)
}

fn surface(scene: &Scene) -> &MetallicRoughness {
    match &material(scene).surface {
        Surface::MetallicRoughness(surface) => surface,
        other => panic!("not {other:?}"),
    }
}

fn messages(scene: &Scene) -> Vec<&str> {
    scene.warnings.iter().map(|w| w.message.as_str()).collect()
}

const UVS: [f32; 8] = [0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0];

#[test]
fn metalness_and_roughness_by_texel() {
    let rest = format!(
        r#""materials": [{{"pbrMetallicRoughness": {{"metallicFactor": 0.5,
        "roughnessFactor": 0.25, "metallicRoughnessTexture": {{"index": 0}},
        "baseColorTexture": {{"index": 0}}}}}}], {}"#,
        textures()
    );
    let scene = square(&[("TEXCOORD_0", 2, &UVS)], &rest);
    let Color::Image(shown) = surface(&scene).roughness_metallic else {
        panic!("an image");
    };
    let texel = scene.images[shown.image.0 as usize].texel(0, 0) * shown.scale;
    let expected = Vec3::new(0.2, 0.4 * 0.25, 0.8 * 0.5);
    assert!(texel.abs_diff_eq(expected, 1e-4), "as written: {texel}");
    let base = scene.mean(&surface(&scene).base_color);
    assert!(base.z < 0.65, "but colours are decoded: {base}");
    assert_eq!(
        messages(&scene),
        ["images[1]: was ignored", "textures[1]: was ignored"],
        "the second texture"
    );
}

#[test]
fn the_dielectric_has_the_index_and_the_strength_that_extensions_say() {
    let of = |extensions: &str| {
        let rest = format!(
            r#""materials": [{{"pbrMetallicRoughness": {{"metallicFactor": 0}},
            "extensions": {{{extensions}}}}}]"#
        );
        square(&[], &rest)
    };
    let plain = of("");
    let surface_of = |scene: &Scene| (surface(scene).f0.x, surface(scene).f90);
    let near = |(a, b): (f32, f32), c: f32, d: f32| (a - c).abs() < 1e-6 && (b - d).abs() < 1e-6;
    assert!(near(surface_of(&plain), 0.04, 1.0), "1.5");
    let water = of(r#""KHR_materials_ior": {"ior": 1.333}"#);
    assert!(near(surface_of(&water), 0.020_374, 1.0), "water");
    let weak = of(r#""KHR_materials_specular": {"specularFactor": 0.5,
        "specularColorFactor": [0.5, 1, 30]}"#);
    assert!(near(surface_of(&weak), 0.01, 0.5), "weak and tinted");
    assert_eq!(surface(&weak).f0.z, 0.5, "clamped before it is weakened");
    let none = of(r#""KHR_materials_specular": {"specularFactor": 0}"#);
    let reflectance = Color::Constant(Vec3::ONE);
    let matt = Surface::Diffuse { reflectance };
    assert_eq!(material(&none).surface, matt, "no dielectric");
}

#[test]
fn a_clear_coat_is_read_with_its_textures() {
    let rest = format!(
        r#""materials": [{{"extensions": {{"KHR_materials_clearcoat": {{"clearcoatFactor": 0.5,
        "clearcoatRoughnessFactor": 0.75, "clearcoatRoughnessTexture": {{"index": 0}}}}}}}}], {}"#,
        textures()
    );
    let scene = square(&[("TEXCOORD_0", 2, &UVS)], &rest);
    let coat = surface(&scene).clearcoat.as_ref().expect("a coat");
    assert_eq!(scene.mean(&coat.weight).x, 0.5, "its share");
    let roughness = scene.mean(&coat.roughness).y;
    assert!((roughness - 0.3).abs() < 1e-4, "in green: {roughness}");
}

#[test]
fn emission_comes_first_among_texture_coordinates() {
    let second: [f32; 8] = [0.5; 8];
    let rest = format!(
        r#""materials": [{{"emissiveFactor": [1, 1, 1],
        "emissiveTexture": {{"index": 0, "texCoord": 1}},
        "normalTexture": {{"index": 1, "texCoord": 2}},
        "pbrMetallicRoughness": {{"baseColorTexture": {{"index": 0}}}}}}], {}"#,
        textures()
    );
    let sets = [("TEXCOORD_0", 2, &UVS[..]), ("TEXCOORD_1", 2, &second)];
    let scene = square(&sets, &rest);
    let mesh = &scene.meshes[0];
    assert_eq!(mesh.uvs, Some(vec![Vec2::splat(0.5); 4]), "of emission");
    let base = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y].to_vec();
    assert_eq!(mesh.second_uvs, Some(base), "of the base colour");
    let Some(Color::Image(emission)) = material(&scene).emission.map(|e| e.radiance) else {
        panic!("an image");
    };
    assert_eq!(emission.uv_set, UvSet::First, "lights know no other");
    let Color::Image(base) = surface(&scene).base_color else {
        panic!("an image");
    };
    assert_eq!(base.uv_set, UvSet::Second, "the other");
    assert_eq!(material(&scene).normal_map, None, "a third one is too many");
    let expected = "materials[0].normalTexture: was ignored: a material uses two sets of texture \
                    coordinates at most";
    assert!(
        messages(&scene).contains(&expected),
        "{:?}",
        messages(&scene)
    );
}

#[test]
fn normal_maps_bring_tangents_and_colors_come_with_vertices() {
    let rest = format!(
        r#""materials": [{{"alphaMode": "BLEND",
        "normalTexture": {{"index": 1, "scale": 0.5}}}}], {}"#,
        textures()
    );
    let tangents = [0.6, 0.8, 0.0, -1.0].repeat(4);
    let colors = [0.25, 0.5, 2.0, 0.5].repeat(4);
    let attributes = [
        ("TEXCOORD_0", 2, &UVS[..]),
        ("TANGENT", 4, &tangents[..]),
        ("COLOR_0", 4, &colors[..]),
    ];
    let scene = square(&attributes, &rest);
    let map = material(&scene).normal_map.expect("a normal map");
    assert_eq!(
        map.scale,
        Vec3::new(0.5, 0.5, 1.0),
        "weaker along the surface"
    );
    let mesh = &scene.meshes[0];
    let moved = Vec2::new(1.2, 0.8).normalize();
    let tangent = mesh.tangents.as_ref().expect("tangents")[2];
    let expected = Vec4::new(moved.x, moved.y, 0.0, -1.0);
    assert!(
        tangent.abs_diff_eq(expected, 1e-6),
        "under the scale: {tangent}"
    );
    let color = Vec3::new(0.25, 0.5, 1.0);
    assert_eq!(mesh.colors, Some(vec![color; 4]), "clamped");
    let expected = "meshes[0].primitives[0].attributes.COLOR_0: has opacities that were ignored";
    assert!(
        messages(&scene).contains(&expected),
        "{:?}",
        messages(&scene)
    );

    // Those of MikkTSpace instead, which follow u.
    let up = [0.0, 0.0, 1.0].repeat(4);
    let smooth = [("TEXCOORD_0", 2, &UVS[..]), ("NORMAL", 3, &up[..])];
    let generated = square(&smooth, &rest);
    let tangents = generated.meshes[0].tangents.as_ref();
    let tangent = tangents.expect("made of the coordinates")[0];
    assert!(tangent.is_finite() && tangent.z == 0.0, "{tangent}");
    assert!(
        (tangent.truncate().length() - 1.0).abs() < 1e-6,
        "{tangent}"
    );

    let plain = square(&attributes, r#""materials": [{}]"#);
    assert_eq!(plain.meshes[0].tangents, None, "nothing needs them");
    let warned = messages(&plain);
    assert!(!warned.iter().any(|w| w.contains("TANGENT")), "{warned:?}");
    assert!(!warned.iter().any(|w| w.contains("COLOR_0")), "{warned:?}");
}

#[test]
fn back_faces_are_culled_unless_light_passes_them() {
    let back_faces = |material_json: &str| {
        let scene = square(&[], &format!(r#""materials": [{{{material_json}}}]"#));
        material(&scene).back_faces
    };
    assert_eq!(back_faces(""), BackFaces::Culled, "as glTF says");
    let both = r#""doubleSided": true"#;
    assert_eq!(back_faces(both), BackFaces::Visible, "both sides");
    let glass = r#""pbrMetallicRoughness": {"metallicFactor": 0},
        "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}"#;
    assert_eq!(back_faces(glass), BackFaces::Visible, "glass");
}

#[test]
fn what_only_affects_looks_never_refuses_a_file_and_is_counted() {
    let rest = r#""materials": [{"extensions": {"KHR_materials_sheen": {}},
            "occlusionTexture": {"index": 0, "strength": 0.5}},
        {"extensions": {"KHR_materials_sheen": {}}}],
        "textures": [{"source": 0}], "images": [{"uri": "there_is_no_such.png"}],
        "extensionsUsed": ["KHR_materials_sheen", "KHR_materials_iridescence"],
        "extensionsRequired": ["KHR_materials_sheen", "KHR_materials_iridescence"]"#;
    let scene = square(&[], rest);
    let expected = [
        "extensionsRequired[0]: names an extension that is not read: the picture may look \
         different (2 of this kind)",
        "materials[0].extensions.KHR_materials_sheen: was ignored",
        "materials[1]: was ignored",
    ];
    assert_eq!(messages(&scene), expected, "and nothing about occlusion");
}
