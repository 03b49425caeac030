use std::path::Path;

use lights::sources::Wrap;

use super::parse_pbrt;
use crate::glam::{Vec2, Vec3};
use crate::image::tests::png;
use crate::{Alpha, Color, ColorImage, Diagnostic, Files, Scene, Surface};

/// A disk whose reflectance and alpha are the textures `t` of colours and of numbers, beside images
/// of one and of two texels.
fn read(text: &str) -> Result<Scene, String> {
    fn read_sibling(path: &Path) -> Result<Vec<u8>, Diagnostic> {
        let texel = |color| image::RgbImage::from_pixel(1, 1, image::Rgb(color));
        match path.to_str() {
            Some("dir/grey.png") => Ok(png(texel([51; 3]))),
            Some("dir/red.png") => Ok(png(texel([255, 0, 0]))),
            Some("dir/wide.png") => Ok(png(image::GrayImage::new(2, 1))),
            _ => Err(Diagnostic::file(path, "cannot be read")),
        }
    }
    let shape = "Shape \"trianglemesh\" \"point3 P\" [0 0 0  1 0 0  0 1 0] \"texture alpha\" \"t\"";
    let text =
        format!("WorldBegin\n{text}\nMaterial \"diffuse\" \"texture reflectance\" \"t\" {shape}");
    let scene = parse_pbrt(Path::new("dir/a.pbrt"), &text, Files::new(&read_sibling));
    scene.map_err(|error| error.to_string())
}

/// The reflectance and the share that is there.
fn colors(scene: &Scene) -> [Color; 2] {
    let material = scene.material(scene.meshes[0].material);
    let Surface::Diffuse { reflectance } = material.surface else {
        panic!("a matt surface");
    };
    let whole = Color::Constant(Vec3::ONE);
    let share = material
        .alpha
        .map_or(whole, |Alpha { opacity, .. }| opacity);
    [reflectance, share]
}

fn reflectance(text: &str) -> (Scene, ColorImage) {
    let scene = read(text).expect("a scene");
    assert_eq!(scene.warnings, [], "{text}");
    match colors(&scene)[0] {
        Color::Image(shown) => (scene, shown),
        Color::Constant(color) => panic!("{text}: an image, not {color}"),
    }
}

/// What a texture of one texel shows.
fn shown(parameters: &str) -> Vec3 {
    let (scene, shown) = reflectance(&format!("Texture \"t\" \"spectrum\" {parameters}"));
    shown.scale * scene.images[shown.image.0 as usize].texel(0, 0)
}

#[test]
fn images_are_scaled_inverted_and_decoded_as_files_say() {
    let grey = "\"imagemap\" \"string filename\" \"grey.png\"";
    for (parameters, expected) in [
        ("\"string encoding\" \"linear\"", 0.2),
        ("\"string encoding\" \"gamma 2\"", 0.04),
        ("", 0.033_104_77),
        ("\"string encoding\" \"linear\" \"float scale\" 3", 0.6),
        (
            "\"string encoding\" \"linear\" \"float scale\" 3 \"bool invert\" true",
            0.4,
        ),
        (
            "\"string encoding\" \"linear\" \"float scale\" 6 \"bool invert\" [ true ]",
            0.0,
        ),
    ] {
        let found = shown(&format!("{grey} {parameters}"));
        assert!(
            found.abs_diff_eq(Vec3::splat(expected), 1e-6),
            "{parameters}: {found}"
        );
    }
    let error = read(&format!(
        "Texture \"t\" \"float\" {grey} \"string encoding\" \"log\""
    ))
    .map(|_| ());
    let expected = "dir/a.pbrt:2: expected an `encoding` of \"sRGB\", \"linear\" or \"gamma\" and \
                    a number, found \"log\"";
    assert_eq!(error, Err(expected.to_owned()), "unknown");
}

#[test]
fn images_lie_where_the_mapping_puts_them() {
    let (_, shown) = reflectance(
        "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"grey.png\" \
         \"string filter\" \"ewa\"
        \"string wrap\" \"black\" \"float uscale\" 2 \"float vscale\" 3 \"float udelta\" .5 \
          \"float vdelta\" -1",
    );
    let place = shown.mapping.transform.transform_point2(Vec2::ONE);
    assert_eq!(place, Vec2::new(2.5, 2.0), "scaled, then moved");
    assert_eq!(shown.mapping.wrap, [Wrap::Black; 2], "nothing around it");
}

#[test]
fn numbers_and_colors_have_names_of_their_own() {
    let scene = read(
        "Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [.1 .2 .3]
        Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"red.png\"",
    );
    let scene = scene.expect("a scene");
    let [reflectance, share] = colors(&scene);
    let expected = Color::Constant(Vec3::new(0.1, 0.2, 0.3));
    assert_eq!(reflectance, expected, "a colour");
    let Color::Image(share) = share else {
        panic!("an image");
    };
    let third = scene.images[share.image.0 as usize].texel(0, 0);
    assert!(
        third.abs_diff_eq(Vec3::splat(1.0 / 3.0), 1e-6),
        "the mean of the channels: {third}"
    );
}

#[test]
fn textures_are_put_together() {
    let images = "\"constant\" \"rgb value\" [.5 .5 .5]
        Texture \"red\" \"spectrum\" \"imagemap\" \"string filename\" \"red.png\"
        Texture \"grey\" \"float\" \"imagemap\" \"string filename\" \"grey.png\" \
        \"string encoding\" \"linear\"
        Texture \"t\" \"spectrum\"";
    for (texture, expected) in [
        (
            "\"scale\" \"texture tex\" \"red\" \"float scale\" .5",
            Vec3::new(0.5, 0.0, 0.0),
        ),
        (
            "\"scale\" \"rgb tex\" [.5 1 1] \"texture scale\" \"red\"",
            Vec3::new(0.5, 0.0, 0.0),
        ),
        (
            "\"scale\" \"texture tex\" \"red\" \"texture scale\" \"grey\"",
            Vec3::new(0.2, 0.0, 0.0),
        ),
        (
            "\"mix\" \"texture tex1\" \"red\" \"rgb tex2\" [0 1 0] \"texture amount\" \"grey\"",
            Vec3::new(0.8, 0.2, 0.0),
        ),
        ("\"mix\" \"texture tex1\" \"red\"", Vec3::new(1.0, 0.5, 0.5)),
    ] {
        let found = shown(&format!("{images} {texture}"));
        assert!(found.abs_diff_eq(expected, 1e-6), "{texture}: {found}");
    }
    let scene = read(
        "Texture \"a\" \"spectrum\" \"imagemap\" \"string filename\" \"red.png\"
        Texture \"b\" \"float\" \"imagemap\" \"string filename\" \"wide.png\" \"bool invert\" true
        Texture \"t\" \"spectrum\" \"scale\" \"texture tex\" \"a\" \"texture scale\" \"b\"",
    );
    let scene = scene.expect("a scene");
    assert_eq!(
        colors(&scene)[0],
        Color::Constant(Vec3::X),
        "of other sizes"
    );
    let message = &scene.warnings[0].message;
    let expected = "the images of a Texture \"scale\" do not lie alike and count by their means";
    assert_eq!(message, expected, "named");
}

#[test]
fn what_is_not_understood_is_named() {
    let warnings = |text: &str| {
        let scene = read(&format!("Texture \"t\" {text}")).expect("a scene");
        scene
            .warnings
            .iter()
            .map(ToString::to_string)
            // The scene has it as an alpha, too.
            .filter(|warning| !warning.ends_with("was taken as opaque"))
            .collect::<Vec<_>>()
    };
    let map = "\"spectrum\" \"imagemap\" \"string filename\" \"grey.png\"";
    for (text, expected) in [
        (
            format!("{map} \"string filter\" \"point\""),
            "the filter \"point\" was taken as \"bilinear\"",
        ),
        (
            format!("{map} \"string wrap\" \"octahedralsphere\""),
            "the wrap mode \"octahedralsphere\" was taken as \"repeat\"",
        ),
        (
            format!("{map} \"string mapping\" \"planar\" \"vector3 v1\" [1 0 0]"),
            "the mapping \"planar\" was taken as \"uv\"",
        ),
        (
            "\"spectrum\" \"fbm\"".to_owned(),
            "Texture \"fbm\" was taken as grey",
        ),
        (
            "\"spectrum\" \"imagemap\" \"string filename\" \"a.dds\"".to_owned(),
            "the image \"a.dds\" was taken as grey: expected .exr, .hdr, .pfm, .png, .tga or .jpg",
        ),
        (
            format!("{map} Material \"conductor\" \"texture roughness\" \"t\""),
            "the texture of `roughness` was taken as its mean",
        ),
    ] {
        assert_eq!(
            warnings(&text),
            [format!("dir/a.pbrt:2: {expected}")],
            "{text}"
        );
    }
    let error = read("Texture \"t\" \"color\" \"constant\"").map(|_| ());
    let expected = "dir/a.pbrt:2: expected \"float\" or \"spectrum\", found \"color\"";
    let expected = format!("{expected}; {}", super::upgrade::UPGRADE);
    assert_eq!(error, Err(expected), "a type of older files");
}
