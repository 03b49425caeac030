use core::f32::consts::{PI, TAU};
use std::path::Path;

use lights::math::spectrum::rec709_luminance;
use lights::sources::{EnvironmentMap, IntensityAmount, LightDesc, RadianceAmount, Rgb};

use super::parse_pbrt;
use crate::glam::Vec3;
use crate::image::tests::png;
use crate::{Diagnostic, Files, Scene};

/// The scene of a file beside a white image.
fn scene(text: &str) -> Scene {
    fn read_sibling(path: &Path) -> Result<Vec<u8>, Diagnostic> {
        assert_eq!(path, Path::new("white.png"), "the image");
        Ok(png(image::GrayImage::from_pixel(
            64,
            64,
            image::Luma([255]),
        )))
    }
    let text = format!("WorldBegin {text}");
    let scene = parse_pbrt(Path::new("a"), &text, Files::new(&read_sibling)).expect("a scene");
    assert_eq!(scene.warnings, [], "{text}");
    scene
}

fn light(text: &str) -> LightDesc<Rgb> {
    scene(&format!("LightSource {text}")).lights[0].clone()
}

/// The power in W of a triangle of area 1/2 that emits.
fn area_power(light: &str) -> f32 {
    let text = format!(
        "AreaLightSource \"diffuse\" {light} \
         Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"point2 uv\" [0 0 1 0 0 1]"
    );
    let scene = scene(&text);
    let emission = scene.material(scene.meshes[0].material).emission;
    let mean = scene.mean(&emission.expect("a lamp").radiance);
    0.5 * PI * rec709_luminance(mean)
}

fn scale(amount: RadianceAmount) -> f32 {
    match amount {
        RadianceAmount::Radiometric(scale) => scale,
        other => panic!("a scale, not {other:?}"),
    }
}

#[test]
fn skies_give_the_illuminance_that_is_asked_for() {
    let LightDesc::UniformInfinite(sky) =
        light("\"infinite\" \"rgb L\" [2 2 2] \"float illuminance\" 5")
    else {
        panic!("a sky of one colour");
    };
    let of_uniform = PI * sky.emission;
    assert!(
        of_uniform.abs_diff_eq(Vec3::splat(10.0), 1e-4),
        "{of_uniform}"
    );
    let LightDesc::ImageInfinite(sky) = light(
        "\"infinite\" \"string filename\" \"white.png\" \"float illuminance\" 10 \"float scale\" 3",
    ) else {
        panic!("an image");
    };
    let found = scale(sky.amount) * PI;
    assert!(
        (found / 30.0 - 1.0).abs() < 1e-3,
        "as the sky of one colour: {found}"
    );
}

#[test]
fn a_sky_of_one_color_may_have_a_portal() {
    let portal = "\"point3 portal\" [0 0 0  1 0 0  1 1 0  0 1 0]";
    let sky = light(&format!(
        "\"infinite\" \"rgb L\" [1 2 3] \"float scale\" 2 {portal}"
    ));
    let LightDesc::PortalInfinite(sky) = sky else {
        panic!("a portal");
    };
    assert_eq!(scale(sky.amount), 2.0, "scaled");
    let EnvironmentMap::EqualArea(map) = sky.map else {
        panic!("an equal-area map");
    };
    assert!(
        map.texels().all(|texel| texel == Vec3::new(1.0, 2.0, 3.0)),
        "one colour"
    );
}

#[test]
fn projections_have_the_power_that_is_asked_for() {
    let watts = |power: &str| {
        let text =
            format!("\"projection\" \"string filename\" \"white.png\" \"float scale\" 2 {power}");
        match light(&text) {
            LightDesc::Projection(light) => light.amount,
            other => panic!("a projection, not {other:?}"),
        }
    };
    assert_eq!(watts(""), IntensityAmount::Radiometric(2.0), "a scale");
    let IntensityAmount::LuminousPower(power) = watts("\"float power\" 3") else {
        panic!("a power");
    };
    assert!(
        (power.0 / 683.0 - 6.0).abs() < 1e-3,
        "{power:?}: six watts of green light"
    );
}

#[test]
fn a_scale_multiplies_the_power_of_an_area_light() {
    for color in ["\"rgb L\" [1 1 1]", "\"string filename\" \"white.png\""] {
        let power = area_power(&format!("{color} \"float power\" 20 \"float scale\" 3"));
        assert!((power - 60.0).abs() < 1e-3, "{color}: {power} W");
    }
}

/// pbrt divides by the luminance of the illuminant alone, by which an RGB is multiplied.
#[test]
fn an_rgb_multiplies_stated_powers_and_illuminances() {
    let emission = |text: &str| match light(text) {
        LightDesc::Point(light) => light.emission * 4.0 * PI,
        LightDesc::Spot(light) => light.emission * TAU * (1.0 - light.angle.cos()),
        LightDesc::Distant(light) => light.emission,
        LightDesc::UniformInfinite(light) => light.emission * PI,
        other => panic!("not {other:?}"),
    };
    for stated in [
        "\"point\" \"float power\" 7 \"rgb I\"",
        "\"spot\" \"float conedeltaangle\" 0 \"float power\" 7 \"rgb I\"",
        "\"distant\" \"float illuminance\" 7 \"rgb L\"",
        "\"infinite\" \"float illuminance\" 7 \"rgb L\"",
    ] {
        let found = emission(&format!("{stated} [3 2 1]"));
        let expected = Vec3::new(21.0, 14.0, 7.0);
        assert!(found.abs_diff_eq(expected, 1e-3), "{stated}: {found}");
    }
    let white = area_power("\"rgb L\" [3 3 3] \"float power\" 7");
    assert!((white - 21.0).abs() < 1e-3, "{white} W");
    for color in ["\"blackbody L\" 3000", "\"spectrum L\" \"stdillum-A\""] {
        let power = area_power(&format!("{color} \"float power\" 7"));
        assert!((power - 7.0).abs() < 1e-3, "{color}: {power} W");
    }
}

/// Whether a sky is too strong depends on its picture and on the scene; the renderer, which finds
/// the same later, knows no file.
#[test]
fn image_skies_beyond_all_numbers_name_file_and_line() {
    fn picture(texel: f32) -> Vec<u8> {
        let texels = [texel; 16].map(f32::to_le_bytes);
        [b"Pf 4 4 -1\n", texels.as_flattened()].concat()
    }
    fn read(path: &Path) -> Result<Vec<u8>, Diagnostic> {
        match path.to_str() {
            Some("strong.pfm") => Ok(picture(1e38)),
            Some("weak.pfm") => Ok(picture(1e20)),
            _ => Err(Diagnostic::file(path, "cannot be read")),
        }
    }
    let fault = |light: &str, shape: &str| {
        let text = format!("WorldBegin\nLightSource \"infinite\" {light}\n{shape}");
        let scene = parse_pbrt(Path::new("a.pbrt"), &text, Files::new(&read));
        scene.err().map(|error| error.to_string())
    };
    let portal = "\"point3 portal\" [0 0 0 1 0 0 1 1 0 0 1 0]";
    let strong = "\"string filename\" \"strong.pfm\"";
    let weak = "\"string filename\" \"weak.pfm\"";
    let [ball, planet] = ["1", "1e12"].map(|r| format!("Shape \"sphere\" \"float radius\" {r}"));
    let sum = "map: too bright, its sum over all directions is not finite";
    let amount = "amount: must be finite, not negative, and leave what the map gives finite";
    let size = "expected a light of finite power in a scene of this size";
    for (light, shape, expected) in [
        (
            strong.to_owned(),
            &ball,
            Some(format!("strong.pfm: image infinite light, {sum}")),
        ),
        (
            format!("{strong} {portal}"),
            &ball,
            Some(format!("strong.pfm: portal infinite light, {sum}")),
        ),
        (format!("{strong} \"float scale\" 0.01"), &ball, None),
        (
            format!("{weak} \"float scale\" 1e18"),
            &ball,
            Some(format!("weak.pfm: image infinite light, {amount}")),
        ),
        (format!("{weak} \"float scale\" 1e16"), &ball, None),
        (weak.to_owned(), &planet, Some(size.to_owned())),
        (format!("{weak} {portal}"), &planet, None),
    ] {
        let expected = expected.map(|expected| format!("a.pbrt:2: {expected}"));
        assert_eq!(fault(&light, shape), expected, "{light} {shape}");
    }
}
