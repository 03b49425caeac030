use lights::sources::{TextureMapping, Wrap};

use super::data_uri::tests::data_uri;
use super::tests::read;
use crate::glam::{Vec2, Vec3};
use crate::image::tests::png;
use crate::{Color, Image, Scene, Surface, write_png};

/// A square with a texture of one texel in its base colour; `info` goes into the reference,
/// `texture` into the texture, `wrap` into its sampler.
fn shown(info: &str, texture: &str, wrap: u32) -> Result<Scene, String> {
    let image = data_uri(&png(image::GrayImage::new(1, 1)));
    read(&format!(
        r#""scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}], "meshes": [{{"primitives": [
            {{"attributes": {{"POSITION": 0, "TEXCOORD_0": 1}}, "indices": 2, "material": 0}}]}}],
        "materials": [{{"pbrMetallicRoughness": {{"metallicFactor": 0,
        "baseColorTexture": {{"index": 0 {info}}}}}}}],
        "textures": [{{{texture}, "sampler": 0}}], "samplers": [{{"wrapS": {wrap}}}],
        "images": [{{"uri": "{image}"}}]"#
    ))
}

fn mapping(info: &str) -> TextureMapping {
    let scene = shown(info, r#""source": 0"#, 10497).expect("a scene");
    assert_eq!(scene.warnings, [], "all understood");
    let Surface::MetallicRoughness(surface) = &scene.material(scene.meshes[0].material).surface
    else {
        panic!("a base colour");
    };
    let Color::Image(shown) = surface.base_color else {
        panic!("an image");
    };
    shown.mapping
}

#[test]
fn transforms_move_texture_coordinates_as_the_extension_says() {
    assert_eq!(mapping(""), TextureMapping::REPEAT, "none");
    // Its first example: the lower left quarter of the image, turned clockwise by a right angle.
    let quarter = mapping(
        r#", "extensions": {"KHR_texture_transform": {"offset": [0, 1], "rotation": 1.57079632679,
        "scale": [0.5, 0.5]}}"#,
    );
    // Corners by our texture coordinates, and the places that they show, of which (0, 0) is the
    // upper left corner.
    for (corner, place) in [
        (Vec2::Y, Vec2::Y),
        (Vec2::ONE, Vec2::new(0.0, 0.5)),
        (Vec2::ZERO, Vec2::new(0.5, 1.0)),
        (Vec2::X, Vec2::splat(0.5)),
    ] {
        let found = quarter.place(corner);
        assert!(found.abs_diff_eq(place, 1e-6), "{corner}: {found}");
    }
    // Its second example: v runs up.
    let turned = mapping(
        r#", "extensions": {"KHR_texture_transform": {"offset": [0, 1], "scale": [1, -1]}}"#,
    );
    let place = turned.place(Vec2::new(0.25, 0.125));
    assert_eq!(place, Vec2::new(0.25, 0.125), "upside down");
}

#[test]
fn what_is_no_image_that_is_read_is_named() {
    let basis = shown(
        "",
        r#""extensions": {"KHR_texture_basisu": {"source": 0}}"#,
        10497,
    )
    .expect("a scene");
    let messages: Vec<_> = basis.warnings.iter().map(|w| w.message.as_str()).collect();
    let expected = [
        "textures[0]: was ignored: it has no PNG or JPEG image",
        "textures[0].extensions.KHR_texture_basisu: was ignored",
    ];
    for message in &expected {
        assert!(messages.contains(message), "{message} in {messages:?}");
    }
    let other = shown(
        r#", "extensions": {"KHR_texture_transform": {"texCoord": 1}}"#,
        r#""source": 0"#,
        33071,
    );
    let other = other.expect("a scene");
    assert_eq!(other.meshes[0].uvs, None, "there is no second set");
    let error = shown("", r#""source": 0"#, 7).map(|_| ());
    let expected = "a.gltf: samplers[0].wrapS: expected 10497 (repeat), 33071 (clamp) or 33648 \
                    (mirror), found 7";
    assert_eq!(error, Err(expected.to_owned()), "a mode");
}

/// Files often travel without their images.
#[test]
fn a_texture_whose_file_is_missing_is_left_out_and_named() {
    let scene = read(
        r#""scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [{"primitives": [
            {"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.25, 0.5, 0.75, 1],
            "baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1}}}],
        "textures": [{"source": 0}, {"source": 1}],
        "images": [{"uri": "color.png"}, {"uri": "metal.png"}]"#,
    )
    .expect("a scene");
    let messages: Vec<_> = scene.warnings.iter().map(|w| w.message.as_str()).collect();
    let expected = [
        "images[0].uri: was left out: color.png: cannot be read: not allowed",
        "images[1].uri: was left out: metal.png: cannot be read: not allowed",
    ];
    for message in &expected {
        assert!(messages.contains(message), "{message} in {messages:?}");
    }
    assert_eq!(messages.len(), expected.len(), "{messages:?}");
    let Surface::MetallicRoughness(surface) = &scene.material(scene.meshes[0].material).surface
    else {
        panic!("a base colour");
    };
    let color = Color::Constant(Vec3::new(0.25, 0.5, 0.75));
    assert_eq!(surface.base_color, color, "the factor");
    let rough = Color::Constant(Vec3::new(1.0, 1.0, 0.0));
    assert_eq!(
        surface.roughness_metallic, rough,
        "no metal without its texture"
    );
}

#[test]
fn textures_are_decoded_once_and_their_alpha_masks() {
    let folder = crate::test_folder::TestFolder::new("gltf_textures");
    let path = folder.path("a.png");
    let texels = vec![Vec3::X, Vec3::Y, Vec3::Z, Vec3::ONE];
    write_png(&path, &Image::new(2, 2, texels.clone()).expect("an image")).expect("written");
    let opaque = data_uri(&std::fs::read(&path).expect("read"));
    let mut mask = image::RgbaImage::from_pixel(2, 1, image::Rgba([255, 0, 0, 255]));
    mask.put_pixel(1, 0, image::Rgba([0, 0, 0, 51]));
    mask.save(&path).expect("written");
    let mask = data_uri(&std::fs::read(&path).expect("read"));
    let scene = read(
        &format!(
            r#""scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}], "meshes": [{{"primitives": [
            {{"attributes": {{"POSITION": 0, "TEXCOORD_0": 1}}, "material": 0}},
            {{"attributes": {{"POSITION": 0, "TEXCOORD_0": 1}}, "indices": 2, "material": 1}}]}}],
        "materials": [{{"emissiveTexture": {{"index": 0}}, "emissiveFactor": [1, 1, 1],
            "pbrMetallicRoughness": {{"baseColorTexture": {{"index": 0}}, "metallicFactor": 0}},
            "extensions": {{"KHR_materials_specular": {{"specularFactor": 0}}}}}},
            {{"alphaMode": "MASK", "alphaCutoff": 0.3, "pbrMetallicRoughness": {{
                "baseColorTexture": {{"index": 1}}, "metallicRoughnessTexture": {{"index": 0}}}}}}],
        "textures": [{{"source": 0}}, {{"source": 1, "sampler": 0}}],
        "samplers": [{{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728, "minFilter": 9987}}],
        "images": [{{"uri": "{opaque}"}}, {{"uri": "{mask}"}}]"#
        )
        .replace(r#""material": 0"#, r#""indices": 2, "material": 0"#),
    )
    .expect("a scene");
    assert_eq!(
        scene.images.len(),
        4,
        "colours of two images, the alpha of one, and the data of the other"
    );
    let glow = scene.material(scene.meshes[0].material);
    let Surface::Diffuse {
        reflectance: Color::Image(base),
    } = glow.surface
    else {
        panic!("diffuse, not {:?}", glow.surface);
    };
    let Some(Color::Image(emission)) = glow.emission.map(|e| e.radiance) else {
        panic!("an emissive texture");
    };
    assert_eq!(base.image, emission.image, "one image for both");
    assert_eq!(
        scene.images[base.image.0 as usize].texels(),
        texels,
        "linear"
    );
    let metal = scene.material(scene.meshes[1].material);
    let alpha = metal.alpha.expect("mask");
    assert_eq!(alpha.cutoff, Some(0.3), "a mask");
    let Color::Image(share) = alpha.opacity else {
        panic!("an image");
    };
    assert_eq!(share.mapping.wrap, [Wrap::Clamp, Wrap::Mirror], "edges");
    let share = scene.images[share.image.0 as usize].texels();
    assert_eq!(share, [Vec3::ONE, Vec3::splat(0.2)], "as it is written");
    let messages: Vec<_> = scene.warnings.iter().map(|w| w.message.as_str()).collect();
    let expected = ["samplers[0].magFilter: was ignored: images are smooth"];
    assert_eq!(messages, expected, "nothing else");
}

#[test]
fn an_image_that_is_listed_twice_is_decoded_once() {
    let image = data_uri(&png(image::GrayImage::new(1, 1)));
    let primitive = |material: u32| {
        format!(
            r#"{{"attributes": {{"POSITION": 0, "TEXCOORD_0": 1}}, "indices": 2,
            "material": {material}}}"#
        )
    };
    let material = |texture: u32| {
        format!(
            r#"{{"pbrMetallicRoughness": {{"metallicFactor": 0,
            "baseColorTexture": {{"index": {texture}}}}}}}"#
        )
    };
    let scene = read(&format!(
        r#""scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
        "meshes": [{{"primitives": [{}, {}]}}],
        "materials": [{}, {}], "textures": [{{"source": 0}}, {{"source": 1}}],
        "images": [{{"uri": "{image}"}}, {{"uri": "{image}"}}]"#,
        primitive(0),
        primitive(1),
        material(0),
        material(1)
    ))
    .expect("a scene");
    assert_eq!(
        (scene.materials.len(), scene.images.len()),
        (2, 1),
        "shared"
    );
}

#[test]
fn shares_lie_between_0_and_1() {
    let refusal = |material: &str| {
        let scene = read(&format!(
            r#""scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}], "meshes": [{{"primitives": [
                {{"attributes": {{"POSITION": 0}}, "indices": 2, "material": 0}}]}}],
            "materials": [{{{material}}}]"#
        ));
        scene.map(|_| ()).expect_err(material)
    };
    for (material, expected) in [
        (
            r#""pbrMetallicRoughness": {"metallicFactor": 1.5}"#,
            "materials[0].pbrMetallicRoughness.metallicFactor: expected a number from 0 to 1, \
             found 1.5",
        ),
        (
            r#""pbrMetallicRoughness": {"baseColorFactor": [1, 1, 2, 1]}"#,
            "materials[0].pbrMetallicRoughness: expected a `baseColorFactor` from 0 to 1",
        ),
        (
            r#""extensions": {"KHR_materials_transmission": {"transmissionFactor": -1}}"#,
            "materials[0].extensions.KHR_materials_transmission.transmissionFactor: expected a \
             number from 0 to 1, found -1",
        ),
    ] {
        let found = refusal(material);
        assert!(found.ends_with(expected), "{found}");
    }
}
