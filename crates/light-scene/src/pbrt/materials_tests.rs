use std::path::Path;

use ::lights::sources::LightDesc;

use super::tests::read;
use crate::glam::{Vec2, Vec3};
use crate::{Color, Diagnostic, Surface};

#[test]
fn alpha_is_the_opacity() {
    let opacity = |alpha: &str| {
        let text = format!("WorldBegin Shape \"disk\" {alpha}");
        let scene = read("pbrt_alpha", &text).expect("a scene");
        let alpha = scene.material(scene.quadrics[0].material).alpha;
        alpha.map(|alpha| (alpha.opacity, alpha.cutoff))
    };
    let half = Color::Constant(Vec3::splat(0.5));
    assert_eq!(opacity("\"float alpha\" 0.5"), Some((half, None)), "half");
    assert_eq!(opacity("\"float alpha\" 1"), None, "all of it");
    assert_eq!(opacity(""), None, "nothing said");
}

#[test]
fn spectra_come_from_files_and_by_name() {
    fn table(path: &Path) -> Result<Vec<u8>, Diagnostic> {
        match path.to_str() {
            Some("dir/grey.spd") => Ok(b"# nm value\n300 3\n900 3 # flat\n".to_vec()),
            Some("dir/odd.spd") => Ok(b"300 3 900".to_vec()),
            _ => Err(Diagnostic::file(path, "cannot be read")),
        }
    }
    let text = |light: &str| {
        format!(
            "WorldBegin LightSource \"point\" \"spectrum I\" \"{light}\" \
             Material \"conductor\" \"spectrum eta\" \"grey.spd\" \"spectrum k\" [300 4 900 4] \
             Shape \"disk\""
        )
    };
    let read = |light: &str| {
        let scene = super::parse_pbrt(
            Path::new("dir/a.pbrt"),
            &text(light),
            crate::Files::new(&table),
        );
        scene.map_err(|error| error.to_string())
    };
    let scene = read("stdillum-D65").expect("a scene");
    let LightDesc::Point(light) = &scene.lights[0] else {
        panic!("a point light");
    };
    assert!(
        light.emission.abs_diff_eq(Vec3::ONE, 0.01),
        "white: {}",
        light.emission
    );
    let Surface::Conductor { eta, k, .. } = scene.material(scene.quadrics[0].material).surface
    else {
        panic!("a metal");
    };
    assert!(
        eta.abs_diff_eq(Vec3::splat(3.0), 0.02),
        "of the file: {eta}"
    );
    assert!(k.abs_diff_eq(Vec3::splat(4.0), 0.03), "above 1: {k}");
    let error = read("odd.spd").expect_err("three numbers");
    let expected = "dir/a.pbrt:1: dir/odd.spd: expected pairs of a wavelength and a value";
    assert_eq!(error, expected, "pairs");
    let unknown = read("stdillum-X").expect("a scene");
    let warning = &unknown.warnings[0].message;
    assert_eq!(
        warning, "the spectrum of `I` is not understood and was taken as white",
        "named"
    );
}

#[test]
fn mixtures_hold_their_parts() {
    let of = |materials: &str, amount: &str| {
        let text = format!(
            "WorldBegin MakeNamedMaterial \"a\" \"string type\" \"diffuse\" \
             MakeNamedMaterial \"b\" \"string type\" \"interface\" \
             Material \"mix\" {materials} {amount} Shape \"disk\""
        );
        let scene = read("pbrt_mix", &text)?;
        assert_eq!(scene.warnings, [], "none");
        Ok::<_, String>(scene.material(scene.quadrics[0].material).surface.clone())
    };
    let both = "\"string materials\" [\"a\" \"b\"]";
    for (amount, expected) in [("\"float amount\" 0.2", 0.2), ("", 0.5)] {
        let mix = Surface::Mix {
            materials: [crate::MaterialId(0), crate::MaterialId(1)],
            amount: Color::Constant(Vec3::splat(expected)),
        };
        assert_eq!(of(both, amount), Ok(mix), "{amount}");
    }
    for (materials, expected) in [
        ("", "a.pbrt:1: expected \"string materials\" with two names"),
        (
            "\"string materials\" [\"a\"]",
            "a.pbrt:1: expected \"string materials\" with two names",
        ),
        (
            "\"string materials\" [\"a\" \"c\"]",
            "a.pbrt:1: expected a named material, found \"c\"; the file names \"a\", \"b\"",
        ),
    ] {
        assert_eq!(of(materials, ""), Err(expected.to_owned()), "{materials}");
    }
}

#[test]
fn no_mixture_is_made_of_itself() {
    let of = |parts: &[(&str, &str)]| {
        let named = parts.iter().map(|(name, part)| {
            format!(
                "MakeNamedMaterial \"{name}\" \"string type\" \"mix\" \
                 \"string materials\" [\"{part}\" \"{part}\"]\n"
            )
        });
        let text = format!("WorldBegin\n{}", named.collect::<String>());
        read("pbrt_cycle", &text).map(|_| ())
    };
    let error = |line: usize, name: &str| {
        let what = "not to be made of itself";
        Err(format!(
            "a.pbrt:{line}: expected the mixture \"{name}\" {what}"
        ))
    };
    assert_eq!(of(&[("a", "a")]), error(2, "a"));
    assert_eq!(of(&[("a", "b"), ("b", "a")]), error(2, "b"));
    let last = [("a", "c"), ("b", "a"), ("c", "b")];
    assert_eq!(of(&last), error(2, "c"), "by way of another");
}

#[test]
fn coated_metals_have_two_layers() {
    let of = |parameters: &str| {
        let text = format!(
            "WorldBegin Material \"coatedconductor\" {parameters} Shape \"trianglemesh\" \
             \"point3 P\" [0 0 0 1 0 0 0 1 0]"
        );
        let scene = read("pbrt_coated", &text).expect("a scene");
        assert_eq!(scene.warnings, [], "all read");
        let material = scene.meshes[0].material;
        scene.material(material).surface.clone()
    };
    let written = "\"float conductor.roughness\" .25 \"float interface.roughness\" .04
        \"float interface.eta\" 1.4 \"spectrum conductor.eta\" \"metal-Ag-eta\"
        \"spectrum conductor.k\" \"metal-Ag-k\" \"float thickness\" .1";
    let expected = Surface::CoatedConductor {
        eta: Vec3::new(0.155, 0.117, 0.138),
        k: Vec3::new(4.828, 3.122, 2.147),
        alpha: Vec2::splat(0.5),
        coat_eta: 1.4,
        coat_alpha: Vec2::splat(0.2),
    };
    assert_eq!(of(written), expected, "silver");
    let Surface::CoatedConductor { eta, coat_eta, .. } = of("\"rgb reflectance\" [.5 .5 .5]")
    else {
        panic!("a coated metal");
    };
    assert_eq!((eta, coat_eta), (Vec3::ONE, 1.5), "of a reflectance");
}
