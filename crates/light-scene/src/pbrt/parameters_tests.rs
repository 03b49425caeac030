use std::path::Path;

use super::parse_pbrt;
use crate::Files;

/// The line that refuses a file, without its name.
fn refusal(text: &str) -> String {
    let scene = parse_pbrt(Path::new("a"), text, Files::NONE);
    let error = scene.map(|_| ()).expect_err(text).to_string();
    error.strip_prefix("a:").unwrap_or(&error).to_owned()
}

fn assert_refused(cases: &[(&str, &str)]) {
    for (text, expected) in cases {
        let is_option = text.starts_with("Camera") || text.starts_with("Film");
        let text = format!("{}\n{text}", if is_option { "" } else { "WorldBegin" });
        assert_eq!(refusal(&text), format!("2: expected {expected}"), "{text}");
    }
}

#[test]
fn sizes_of_films_are_whole_and_in_range() {
    for (size, expected) in [
        ("0", "`xresolution` from 1 to 65536, found 0"),
        ("-16", "`xresolution` from 1 to 65536, found -16"),
        (
            "2000000000",
            "`xresolution` from 1 to 65536, found 2000000000",
        ),
        (
            "16.5",
            "a whole number below 2^31 as a value of `xresolution`, found `16.5`",
        ),
        ("2e9", "`xresolution` from 1 to 65536, found 2000000000"),
        (
            "3e9",
            "a whole number below 2^31 as a value of `xresolution`, found `3e9`",
        ),
        ("[]", "1 number for `xresolution`, found 0"),
        ("[16 16]", "1 number for `xresolution`, found 2"),
        (
            "\"16\"",
            "a whole number below 2^31 as a value of `xresolution`, found \"16\"",
        ),
        (
            "true",
            "a whole number below 2^31 as a value of `xresolution`, found `true`",
        ),
    ] {
        let film = format!("Film \"rgb\" \"integer xresolution\" {size}");
        assert_refused(&[(&film, expected)]);
    }
    assert_refused(&[
        (
            "Film \"rgb\" \"float xresolution\" 16",
            "\"integer xresolution\", found \"float xresolution\"",
        ),
        (
            "Film \"rgb\" \"integer pixelbounds\" [0 1 2]",
            "4 numbers for `pixelbounds`, found 3",
        ),
    ]);
}

#[test]
fn values_are_of_their_type_and_as_many_as_belong_together() {
    assert_refused(&[
        (
            "LightSource \"point\" \"rgb I\" [5 5]",
            "a multiple of 3 numbers for `I`, found 2",
        ),
        (
            "LightSource \"point\" \"rgb I\" []",
            "3 numbers for `I`, found 0",
        ),
        (
            "LightSource \"point\" \"rgb I\" [1 1 1 2 2 2]",
            "3 numbers for `I`, found 6",
        ),
        (
            "LightSource \"point\" \"rgb I\" [1 -1 1]",
            "a colour of at least 0 for `I`",
        ),
        (
            "LightSource \"point\" \"rgb I\" \"red\"",
            "a number as a value of `I`, found \"red\"",
        ),
        (
            "LightSource \"point\" \"rgb I\" [1 1 nan]",
            "a number as a value of `I`, found `nan`",
        ),
        (
            "LightSource \"point\" \"rgb I\" [1 1 1e39]",
            "a number as a value of `I`, found `1e39`",
        ),
        (
            "LightSource \"point\" \"float I\" 5",
            "\"rgb I\" or \"blackbody I\" or \"spectrum I\", found \"float I\"",
        ),
        (
            "LightSource \"point\" \"colour I\" [1 1 1]",
            "a type for `I`, found `colour`; types are bool, integer, float, point2, vector2, \
             point3, vector3, normal, rgb, blackbody, spectrum, string and texture",
        ),
        (
            "LightSource \"point\" \"blackbody I\" -1",
            "a temperature in kelvin for `I`, found -1",
        ),
        (
            "LightSource \"point\" \"spectrum I\" [400 1 500]",
            "a multiple of 2 numbers for `I`, found 3",
        ),
        (
            "LightSource \"point\" \"spectrum I\" [500 1 400 1]",
            "ascending wavelengths for `I`, each with its value, not all 0",
        ),
        (
            "LightSource \"point\" \"spectrum I\" [400 -1 500 1]",
            "values of at least 0 for `I`, found -1",
        ),
        (
            "LightSource \"point\" \"spectrum I\" [400 \"x\"]",
            "numbers or a name for `I`, found both",
        ),
        (
            "LightSource \"point\" \"point3 from\" [0 0]",
            "a multiple of 3 numbers for `from`, found 2",
        ),
        (
            "LightSource \"point\" \"point3 from\" [0 0 0 1 1 1]",
            "3 numbers for `from`, found 6",
        ),
        (
            "LightSource \"point\" \"float scale\" 1 \"float scale\" 2",
            "one `scale`, found another",
        ),
        (
            "AreaLightSource \"diffuse\" \"bool twosided\" 1",
            "`true` or `false` as a value of `twosided`, found `1`",
        ),
        (
            "AreaLightSource \"diffuse\" \"string twosided\" \"true\"",
            "\"bool twosided\", found \"string twosided\"",
        ),
        (
            "Shape \"plymesh\" \"string filename\" [\"a\" \"b\"]",
            "1 name for `filename`, found 2",
        ),
        (
            "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 -2]",
            "`indices` of at least 0, found -2",
        ),
        (
            "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1]",
            "a multiple of 3 numbers for `P`, found 8",
        ),
        (
            "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"point2 uv\" [0 0 1]",
            "a multiple of 2 numbers for `uv`, found 3",
        ),
        (
            "Texture \"t\" \"float\" \"constant\" \"rgb value\" [1 1 1]",
            "\"float value\", found \"rgb value\"",
        ),
        (
            "MakeNamedMaterial \"a\"",
            "\"string type\" of a named material",
        ),
    ]);
}

#[test]
fn values_lie_in_their_domains() {
    assert_refused(&[
        (
            "LightSource \"point\" \"float scale\" -1",
            "`scale` of at least 0, found -1",
        ),
        (
            "LightSource \"point\" \"float power\" 0",
            "`power` above 0, found 0",
        ),
        (
            "LightSource \"spot\" \"float coneangle\" 190",
            "`coneangle` above 0, and up to 180 degrees, found 190",
        ),
        (
            "LightSource \"spot\" \"float conedeltaangle\" 40",
            "`conedeltaangle` from 0 to `coneangle`, found 40",
        ),
        (
            "LightSource \"distant\" \"point3 from\" [0 0 1]",
            "`from` and `to` apart",
        ),
        (
            "LightSource \"infinite\" \"float illuminance\" -3",
            "`illuminance` above 0, found -3",
        ),
        (
            "Shape \"sphere\" \"float radius\" 0",
            "`radius` above 0, found 0",
        ),
        (
            "Shape \"disk\" \"float radius\" -1",
            "`radius` above 0, found -1",
        ),
        (
            "Shape \"disk\" \"float innerradius\" 1",
            "`innerradius` from 0 to below `radius`, found 1",
        ),
        (
            "Shape \"cylinder\" \"float phimax\" 0",
            "`phimax` above 0, found 0",
        ),
        (
            "Camera \"perspective\" \"float lensradius\" -1",
            "`lensradius` of at least 0, found -1",
        ),
        (
            "Camera \"perspective\" \"float focaldistance\" 0",
            "`focaldistance` above 0, found 0",
        ),
        (
            "Material \"dielectric\" \"float eta\" 0",
            "`eta` above 0, found 0",
        ),
        (
            "Material \"conductor\" \"float roughness\" -1",
            "`roughness` of at least 0, found -1",
        ),
        (
            "Material \"diffuse\" \"rgb reflectance\" [.5 .5 1.5]",
            "a colour of at most 1 for `reflectance`",
        ),
        (
            "Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 2]",
            "a transform whose last row is 0 0 0 1",
        ),
    ]);
}

#[test]
fn blocks_are_ended() {
    for (text, expected) in [
        ("AttributeBegin", "`AttributeEnd` after `AttributeBegin`"),
        (
            "AttributeBegin AttributeBegin AttributeEnd",
            "`AttributeEnd` after `AttributeBegin`",
        ),
        ("TransformBegin", "`TransformEnd` after `TransformBegin`"),
        ("ObjectBegin \"a\"", "`ObjectEnd` after `ObjectBegin`"),
    ] {
        assert_refused(&[(text, expected)]);
    }
}

/// An invalid parameter of an `Attribute` is refused at its own location.
#[test]
fn attributes_are_refused_where_they_stand() {
    let text = "WorldBegin\nAttribute \"light\" \"rgb I\" [1 -1 1]\n\nLightSource \"point\"";
    assert_eq!(
        refusal(text),
        "2: expected a colour of at least 0 for `I`",
        "its line"
    );
}

#[test]
fn a_metal_takes_what_it_lacks_from_copper() {
    let text = "WorldBegin Material \"conductor\" \"rgb eta\" [1 2 3] Shape \"sphere\"";
    let scene = parse_pbrt(Path::new("a"), text, Files::NONE).expect("a scene");
    let crate::Surface::Conductor { eta, k, .. } = scene.materials[0].surface else {
        panic!("a metal");
    };
    assert_eq!(eta.to_array(), [1.0, 2.0, 3.0], "as given");
    assert_eq!(k.to_array(), [3.912, 2.452, 2.142], "as in pbrt");
}
