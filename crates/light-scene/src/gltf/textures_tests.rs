use super::data_uri::tests::data_uri;
use super::tests::read;
use crate::glam::Vec3;
use crate::{Color, Image, Surface, write_png};

#[test]
fn textures_are_decoded_once_and_their_alpha_masks() {
    let folder = crate::test_folder::TestFolder::new("gltf_textures");
    let path = folder.path("a.png");
    let texels = vec![Vec3::X, Vec3::Y, Vec3::Z, Vec3::ONE];
    write_png(&path, &Image::new(2, 2, texels.clone()).expect("an image")).expect("written");
    let opaque = data_uri(&std::fs::read(&path).expect("read"));
    let mut holes = image::RgbaImage::from_pixel(2, 1, image::Rgba([255, 0, 0, 255]));
    holes.put_pixel(1, 0, image::Rgba([0, 0, 0, 51]));
    holes.save(&path).expect("written");
    let holes = data_uri(&std::fs::read(&path).expect("read"));
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
        "samplers": [{{"wrapS": 33071, "wrapT": 10497, "minFilter": 9987}}],
        "images": [{{"uri": "{opaque}"}}, {{"uri": "{holes}"}}]"#
        )
        .replace(r#""material": 0"#, r#""indices": 2, "material": 0"#),
    )
    .expect("a scene");
    assert_eq!(
        scene.images.len(),
        3,
        "colours of two images, and the alpha of one"
    );
    let glow = scene.material(scene.meshes[0].material);
    let Surface::Diffuse {
        reflectance: Color::Image(base),
    } = glow.surface
    else {
        panic!("diffuse, not {:?}", glow.surface);
    };
    let Some(Color::Image(shine)) = glow.emission.map(|e| e.radiance) else {
        panic!("a shining texture");
    };
    assert_eq!(base.image, shine.image, "one image for both");
    assert_eq!(
        scene.images[base.image.0 as usize].texels(),
        texels,
        "linear"
    );
    let metal = scene.material(scene.meshes[1].material);
    let alpha = metal.alpha.expect("holes");
    assert_eq!(alpha.cutoff, Some(0.3), "a mask");
    let Color::Image(share) = alpha.share else {
        panic!("an image");
    };
    let share = scene.images[share.image.0 as usize].texels();
    assert_eq!(share, [Vec3::ONE, Vec3::splat(0.2)], "as it is written");
    let messages: Vec<_> = scene.warnings.iter().map(|w| w.message.as_str()).collect();
    let expected = [
        "samplers[0].wrapS: was ignored: images repeat",
        "materials[1].pbrMetallicRoughness.metallicRoughnessTexture: was taken as its mean",
        "materials[1]: is partly metallic and was taken as the nearer of metal and none",
    ];
    for message in expected {
        assert!(messages.contains(&message), "{message} in {messages:?}");
    }
}
