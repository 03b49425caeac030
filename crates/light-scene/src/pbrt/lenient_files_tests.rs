//! What a file asks for that no picture depends on, and what it names that is not there.

use std::path::Path;

use super::parse_pbrt;
use crate::glam::Vec3;
use crate::{Color, Diagnostic, Files, Scene, Surface};

const TRIANGLE: &str = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]";

fn read(text: &str) -> Result<Scene, String> {
    fn read_sibling(path: &Path) -> Result<Vec<u8>, Diagnostic> {
        match path.to_str() {
            Some("broken.png") => Ok(b"no image".to_vec()),
            _ => Err(Diagnostic::file(path, "cannot be read: not found")),
        }
    }
    let scene = parse_pbrt(Path::new("a"), text, Files::new(&read_sibling));
    scene.map_err(|error| error.to_string())
}

fn warnings(text: &str) -> Vec<String> {
    let scene = read(text).expect("a scene");
    scene.warnings.into_iter().map(|w| w.message).collect()
}

#[test]
fn samplers_say_how_many_samples_a_pixel_has() {
    let samples = |text: &str| {
        let scene = read(&format!("{text} WorldBegin {TRIANGLE}"));
        scene.map(|scene| scene.samples_per_pixel)
    };
    assert_eq!(samples(""), Ok(None), "nothing said");
    assert_eq!(samples("Sampler \"zsobol\""), Ok(None), "nothing said");
    let named = "Sampler \"halton\" \"string randomization\" \"owen\" \"integer pixelsamples\"";
    assert_eq!(samples(&format!("{named} [ 512 ]")), Ok(Some(512)), "named");
    let strata = "Sampler \"stratified\" \"integer xsamples\" 3 \"integer ysamples\" 5";
    assert_eq!(samples(strata), Ok(Some(15)), "a grid");
    let error = "a:1: expected `pixelsamples` from 1 to 2147483647, found 0";
    assert_eq!(
        samples(&format!("{named} 0")),
        Err(error.to_owned()),
        "none"
    );
}

#[test]
fn what_no_picture_depends_on_is_not_named() {
    for quiet in [
        "Sampler \"zsobol\" \"integer pixelsamples\" 16 \"integer seed\" 3",
        "Accelerator \"bvh\" \"string splitmethod\" \"hlbvh\"",
        "PixelFilter \"gaussian\" \"float xradius\" 2 \"float sigma\" .5",
        "ColorSpace \"srgb\"",
        "Film \"rgb\" \"float diagonal\" 35 \"bool savefp16\" false \"float maxcomponentvalue\" 9",
        "Film \"gbuffer\" \"string coordinatesystem\" \"world\"",
        "Film \"spectral\" \"integer nbuckets\" 8 \"float lambdamin\" 400 \"float lambdamax\" 700",
    ] {
        let found = warnings(&format!("{quiet} WorldBegin {TRIANGLE}"));
        assert!(found.is_empty(), "{quiet}: {found:?}");
    }
    // These change the picture.
    for (named, expected) in [
        ("ColorSpace \"rec2020\"", "`ColorSpace` was ignored"),
        (
            "Film \"rgb\" \"float iso\" 200",
            "Film \"rgb\": parameter `iso` was ignored",
        ),
    ] {
        let found = warnings(&format!("{named} WorldBegin {TRIANGLE}"));
        assert_eq!(found, [expected], "{named}");
    }
}

#[test]
fn textures_whose_file_is_missing_are_grey() {
    let textured = |name: &str| {
        let image = format!("\"imagemap\" \"string filename\" \"{name}\"");
        read(&format!(
            "WorldBegin Texture \"t\" \"spectrum\" {image} Texture \"s\" \"spectrum\" {image} \
             Material \"diffuse\" \"texture reflectance\" \"t\" {TRIANGLE}"
        ))
    };
    let scene = textured("no.png").expect("a scene");
    let material = scene.material(scene.meshes[0].material);
    let reflectance = Color::Constant(Vec3::splat(0.5));
    assert_eq!(material.surface, Surface::Diffuse { reflectance }, "grey");
    let found: Vec<_> = scene.warnings.iter().map(ToString::to_string).collect();
    let expected = "a:1: no.png: cannot be read: not found; the texture was taken as grey \
                    (and 1 more like it)";
    assert_eq!(found, [expected], "named");
    assert!(
        textured("broken.png").is_err(),
        "one that is there but broken"
    );
}

#[test]
fn alphas_whose_texture_was_not_read_are_opaque() {
    let missing = "\"imagemap\" \"string filename\" \"no.png\"";
    let made_of_it = "Texture \"b\" \"float\" \"scale\" \"texture tex\" \"a\" \
                      \"float scale\" .5";
    let opaque = "an `alpha` whose texture was not read was taken as opaque";
    for (textures, alpha) in [
        (format!("Texture \"a\" \"float\" {missing}"), "a"),
        (
            format!("Texture \"a\" \"float\" {missing} {made_of_it}"),
            "b",
        ),
        ("Texture \"a\" \"float\" \"fbm\"".into(), "a"),
        (String::new(), "nowhere"),
    ] {
        let shape = TRIANGLE.to_owned() + &format!(" \"texture alpha\" \"{alpha}\"");
        let text = format!("WorldBegin {textures} {shape}");
        let scene = read(&text).expect("a scene");
        let material = scene.material(scene.meshes[0].material);
        assert_eq!(material.alpha, None, "{text}");
        let found = warnings(&text);
        assert!(found.contains(&opaque.into()), "{text}: {found:?}");
    }
    // One that was read after another of its name counts.
    let again = format!(
        "WorldBegin Texture \"a\" \"float\" {missing} Texture \"a\" \"float\" \"constant\" \
         \"float value\" .5 {TRIANGLE} \"texture alpha\" \"a\""
    );
    let scene = read(&again).expect("a scene");
    let material = scene.material(scene.meshes[0].material);
    assert!(material.alpha.is_some(), "half of it");
}

#[test]
fn lights_of_no_light_are_left_out() {
    for (kind, name) in [
        ("point", "I"),
        ("spot", "I"),
        ("distant", "L"),
        ("infinite", "L"),
    ] {
        let light = |rgb: &str| {
            format!("LightSource \"{kind}\" \"rgb {name}\" [ {rgb} ] \"float scale\" 2\n")
        };
        let text = format!("WorldBegin {}{}{TRIANGLE}", light("0 0 0"), light("0 0 1"));
        let scene = read(&text).expect("a scene");
        assert_eq!(scene.lights.len(), 1, "{kind}");
        let expected = format!("LightSource \"{kind}\" gives no light and was left out");
        assert_eq!(warnings(&text), [expected], "{kind}");
    }
    let lamp = format!("WorldBegin AreaLightSource \"diffuse\" \"rgb L\" [ 0 0 0 ] {TRIANGLE}");
    let scene = read(&lamp).expect("a scene");
    assert_eq!(scene.emissive_triangle_count(), 0, "a surface alone");
    assert!(scene.is_lit(), "dark on purpose: no sky replaces the light");
    let black = format!("WorldBegin LightSource \"point\" \"rgb I\" [ 0 0 0 ] {TRIANGLE}");
    assert!(read(&black).expect("a scene").is_lit(), "as this one");
    let unlit = read(&format!("WorldBegin {TRIANGLE}")).expect("a scene");
    assert!(!unlit.is_lit(), "a scene without lights");
    let expected = "AreaLightSource \"diffuse\" gives no light and was left out";
    assert_eq!(warnings(&lamp), [expected], "named");
}

/// The image guides how pbrt samples a patch; what emits is the image of its area light.
#[test]
fn patches_may_name_an_image_for_their_sampling() {
    let patch = "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]";
    let named = format!("WorldBegin {patch} \"string emissionfilename\" \"no.png\"");
    let expected = ["Shape \"bilinearmesh\" was taken as two triangles a patch"];
    assert_eq!(warnings(&named), expected, "nothing of the picture");
}
